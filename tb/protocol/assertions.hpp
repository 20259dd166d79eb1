// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Assertions: what must hold in every bit of every test, whatever the stimulus (rules TH-06,
// TH-07).
#pragma once

#include <string>
#include <vector>

#include "judge/node_assertions.hpp"
#include "protocol/core_bench.hpp"

namespace vericansim {

/// NodeAssertions on every DUT of a bench; hangs itself in front of what is in on_bit already, so
/// construct it after the Lockstep.
class Assertions {
 public:
  explicit Assertions(CoreBench &bench);

  [[nodiscard]] bool hold() const { return broken_.empty(); }
  /// One sentence for each broken assertion, the first kMaxReports of them; empty if none is.
  [[nodiscard]] std::string report() const;
  /// The counters of DUT `i` were set from outside: the next difference is no step.
  void counters_preset(unsigned i) { watched_[i].counters_preset(); }

 private:
  static constexpr std::size_t kMaxReports = 10;

  void broken(unsigned i, const std::string &what);

  CoreBench &bench_;
  std::vector<NodeAssertions> watched_;
  std::vector<std::string> broken_;
};

}  // namespace vericansim
