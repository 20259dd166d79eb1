// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Counts of Verilated coverage: one file per process, written when it ends. Part of builds with
// VERICAN_COVERAGE alone; cmake/coverage_model.py writes who uses this.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vericansim {

/// A point: the place of its count, and its text as in Verilator's coverage files.
struct CoveragePoint {
  unsigned counter;
  const char *text;
};

/// The points of a model class. All models of a program are written to one new file
/// $VERICAN_COVERAGE_DIR/<program>-<process>.dat, in the format of `verilator_coverage`; points
/// that were not hit, too. Without that variable nothing is written. A file that cannot be written
/// ends the program with exit code 1 and a message.
class CoverageModel {
 public:
  /// Both arrays live as long as the program; each model is made once, before main().
  CoverageModel(const CoveragePoint *points, std::size_t size, const std::uint32_t *counts);

 private:
  friend void write_coverage();
  const CoveragePoint *points_;
  std::size_t size_;
  const std::uint32_t *counts_;
  const CoverageModel *next_;
};

}  // namespace vericansim
