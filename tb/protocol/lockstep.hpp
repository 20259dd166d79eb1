// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Lockstep: the rule-based node model beside each DUT of a CoreBench; every bit is compared
// (rule 19.5).
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "judge/rule_follower.hpp"
#include "protocol/core_bench.hpp"

namespace vericansim {

/// Follows the DUTs of a bench from start() on. Use request(), cancel() and preset_counters() of
/// this class, so that DUT and model get the same.
///
/// Compared in each bit is what RuleFollower compares, and the content of each frame delivered.
class Lockstep {
 public:
  explicit Lockstep(CoreBench &bench);

  /// Starts the bench and compares from its first bit on.
  void start();
  /// `one_shot`: tried once (MO-09), as all later requests of that DUT must be.
  void request(unsigned dut, const Frame &frame, bool one_shot = false);
  void cancel(unsigned dut);
  /// Before start().
  void preset_counters(unsigned dut, std::uint8_t tec, std::uint8_t rec);
  [[nodiscard]] NodeModel &model(unsigned dut = 0) { return followers_[dut].rules.model(); }

  [[nodiscard]] bool agrees() const { return mismatches_.empty(); }
  /// One sentence for each difference, the first kMaxReports of them.
  [[nodiscard]] const std::vector<std::string> &mismatches() const { return mismatches_; }
  /// All of them in one text, with the levels seen up to the first one; empty if there is none.
  [[nodiscard]] std::string report() const;

 private:
  static constexpr std::size_t kMaxReports = 20;

  struct Follower {
    RuleFollower rules;
    std::deque<Frame> queue;  // requested, not yet the model's pending frame
  };

  void follow(unsigned i, const DutBit &bit);
  void mismatch(unsigned i, const BitPlace &at, const std::string &what);

  CoreBench &bench_;
  std::vector<Follower> followers_;
  std::vector<std::string> mismatches_;
  std::string history_;
};

}  // namespace vericansim
