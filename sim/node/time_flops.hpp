// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeFlops: what counts in a Verilated can_time, wherever that lies in the model.
#pragma once

#include <cstdint>
#include <limits>

#include "node/clock_leap.hpp"

namespace vericansim {

/// The clock of rtl/time/can_time.sv in a model, by reference, and what decides how long it only
/// counts (TM-10). For VERICAN_TIME_FLOPS().
struct TimeFlops {
  static constexpr std::uint64_t kForever = std::numeric_limits<std::uint64_t>::max();
  /// Clocks in which what follows the lower half has followed it; clocks_before() keeps so many
  /// off its time.
  static constexpr std::uint64_t kFollow = 4;

  std::uint32_t &lo, &hi, &fraction;
  std::uint8_t &carry, &carry2, &carry3;
  // What follows the lower half.
  std::uint8_t &bit, &slew_bit, &changed, &reached, &due;
  std::uint32_t &lo_before, &to_target;
  std::uint64_t &now;  ///< TIME
  std::uint8_t incn, armed, held;
  std::uint32_t incf, target, left;

  [[nodiscard]] ClockLeap clock() const {
    return {lo, hi, fraction, carry != 0, carry2 != 0, carry3 != 0};
  }
  void set(const ClockLeap &clock) const {
    lo = clock.lo;
    hi = clock.hi;
    fraction = clock.fraction;
    carry = clock.carry;
    carry2 = clock.carry2;
    carry3 = clock.carry3;
  }
  /// `clocks` later; what follows the clock is right after kFollow edges of the model.
  void leap(std::uint64_t clocks) const {
    ClockLeap later = clock();
    later.pass(clocks, increment());
    set(later);
  }
  /// TIME `clocks` later.
  [[nodiscard]] std::uint64_t time_after(std::uint64_t clocks) const {
    if (clocks == 0) return now;
    ClockLeap later = clock();
    later.pass(clocks - 1, increment());
    const std::uint32_t lower = later.lo;
    later.step(increment());
    return std::uint64_t{later.hi} << 32 | lower;
  }
  /// 2^-32 ns a clock.
  [[nodiscard]] std::uint64_t increment() const { return std::uint64_t{incn} << 32 | incf; }

  /// Takes over all that moves while the clock only counts.
  void copy_moving(const TimeFlops &from) const {
    set(from.clock());
    bit = from.bit;
    slew_bit = from.slew_bit;
    changed = from.changed;
    reached = from.reached;
    due = from.due;
    lo_before = from.lo_before;
    to_target = from.to_target;
    now = from.now;
  }

  /// Clocks that end before `time`, 32 bits of TIME, by kFollow, whatever the fraction adds; 0 if
  /// it has come.
  [[nodiscard]] std::uint64_t clocks_before(std::uint32_t time) const {
    const auto to_go = static_cast<std::int32_t>(time - lo);
    if (to_go <= 0) return 0;
    const std::uint64_t clocks = static_cast<std::uint64_t>(to_go) / (incn + 1U);
    return clocks > kFollow ? clocks - kFollow : 0;
  }
  /// The same before the time of the compare unit; a slew leaves none (TM-15).
  [[nodiscard]] std::uint64_t clocks_before_compare() const {
    if (left != 0) return 0;
    return armed == 0 ? kForever : clocks_before(target);
  }
};

/// TimeFlops of a model; `time` is the path of can_time in its root, `slew` the member for TSLEW.
#define VERICAN_TIME_FLOPS(root, time, slew)                                                      \
  ::vericansim::TimeFlops {                                                                       \
    (root).time##__DOT__lo, (root).time##__DOT__hi, (root).time##__DOT__u_clock__DOT__fraction_q, \
        (root).time##__DOT__u_clock__DOT__carry_q, (root).time##__DOT__u_clock__DOT__carry2_q,    \
        (root).time##__DOT__u_clock__DOT__carry3_q, (root).time##__DOT__u_clock__DOT__bit_q,      \
        (root).time##__DOT__u_clock__DOT__slew_bit, (root).time##__DOT__u_clock__DOT__changed_q,  \
        (root).time##__DOT__u_cmp__DOT__reached_q, (root).time##__DOT__u_cmp__DOT__due_q,         \
        (root).time##__DOT__lo_q, (root).time##__DOT__u_cmp__DOT__to_target,                      \
        (root).time##__DOT__now, (root).time##__DOT__u_clock__DOT__incn_q,                        \
        (root).time##__DOT__armed, (root).time##__DOT__held,                                      \
        (root).time##__DOT__u_clock__DOT__incf_q, (root).time##__DOT__u_cmp__DOT__target_q,       \
        (root).slew                                                                               \
  }

}  // namespace vericansim
