// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Tally: what the runs of the campaign were and what they found, counted per axis.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "faults/section.hpp"

namespace vericansim {

/// Runs, and those of them in which RTL and judges differed.
struct Count {
  std::uint64_t runs = 0;
  std::uint64_t mismatches = 0;
  void add(const Count &other) {
    runs += other.runs;
    mismatches += other.mismatches;
  }
};

/// A run that failed.
struct Failure {
  std::string id;
  std::string report;
};

/// One thread's counts; merge() puts them together.
class Tally {
 public:
  /// section, role, state, position class, reaction
  using Key = std::array<std::string, 5>;
  static constexpr std::size_t kKeptFailures = 50;

  void add(const Grid &grid, std::size_t index, Outcome outcome);
  void merge(const Tally &other);
  /// Counts, or a failure, from a file.
  void add(const Key &key, const Count &count) { counts_[key].add(count); }
  void add(Failure failure);

  [[nodiscard]] const std::map<Key, Count> &counts() const { return counts_; }
  [[nodiscard]] const std::vector<Failure> &failures() const { return failures_; }
  [[nodiscard]] Count total() const;
  /// Sum over all but two parts of the key; pass the same number twice for one.
  [[nodiscard]] std::map<std::pair<std::string, std::string>, Count> by(std::size_t row,
                                                                        std::size_t column) const;

 private:
  std::map<Key, Count> counts_;
  std::vector<Failure> failures_;
};

}  // namespace vericansim
