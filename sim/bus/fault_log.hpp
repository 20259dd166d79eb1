// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FaultLog: how often and when a fault took effect.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// Half-open span of simulated time, [from, to).
struct Window {
  Time from = 0;
  Time to = std::numeric_limits<Time>::max();
  [[nodiscard]] constexpr bool contains(Time t) const { return t >= from && t < to; }
};

/// Counts the bit times in which receivers got another level than without a fault. Clock edges that
/// saw it and lie less than half a bit time apart form a stretch; a stretch counts as its length in
/// bit times, rounded, and at least once if it is not too short to count.
class FaultLog {
 public:
  /// Stretches that are kept with their times.
  static constexpr std::size_t kStretches = 10'000;

  /// `bit_time` in ps; 0: each clock edge counts. Stretches that last less than `least` (ps from
  /// the first clock edge to the last) do not count.
  explicit FaultLog(Time bit_time = 0, Time least = 0) : bit_time_{bit_time}, least_{least} {}

  /// A clock edge at `t` (ps, not before the last one) saw another level. Receivers that the fault
  /// disturbs each for itself have numbers of their own.
  void mark(Time t, unsigned receiver = 0);

  [[nodiscard]] std::uint64_t hits() const { return hits_; }
  /// The first kStretches stretches by their beginnings: first and last clock edge that saw it, ps.
  [[nodiscard]] const std::vector<Window> &stretches() const { return stretches_; }
  /// There were more stretches.
  [[nodiscard]] bool more() const { return more_; }

 private:
  struct Stretch {
    bool begun = false;
    Time from = 0, last = 0;
    Time bits = 0;  // counted so far
    std::size_t place = kStretches;
  };

  void count(Stretch &stretch);

  Time bit_time_, least_;
  std::uint64_t hits_ = 0;
  std::vector<Stretch> now_;  // of each receiver
  std::vector<Window> stretches_;
  bool more_ = false;
};

}  // namespace vericansim
