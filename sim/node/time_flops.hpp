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
/// counts. For VERICAN_TIME_FLOPS().
struct TimeFlops {
  static constexpr std::uint64_t kForever = std::numeric_limits<std::uint64_t>::max();
  /// Clocks that clocks_before() keeps off its time: what follows the lower half is behind it by
  /// less.
  static constexpr std::uint64_t kMargin = 4;

  std::uint32_t &lo, &hi, &fraction;
  std::uint8_t &carry, &carry2, &carry3;
  std::uint8_t incn, armed;
  std::uint32_t incf, target;

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
  /// 2^-32 ns a clock.
  [[nodiscard]] std::uint64_t increment() const { return std::uint64_t{incn} << 32 | incf; }

  /// Clocks that end before `time`, 32 bits of TIME, by a margin, whatever the fraction adds; 0 if
  /// it has come.
  [[nodiscard]] std::uint64_t clocks_before(std::uint32_t time) const {
    const auto left = static_cast<std::int32_t>(time - lo);
    if (left <= 0) return 0;
    const std::uint64_t clocks = static_cast<std::uint64_t>(left) / (incn + 1U);
    return clocks > kMargin ? clocks - kMargin : 0;
  }
  /// The same before the time of the compare unit.
  [[nodiscard]] std::uint64_t clocks_before_compare() const {
    return armed == 0 ? kForever : clocks_before(target);
  }
};

}  // namespace vericansim

/// TimeFlops of a model; `time` is the path of can_time in its root.
#define VERICAN_TIME_FLOPS(root, time)                                                            \
  ::vericansim::TimeFlops {                                                                       \
    (root).time##__DOT__lo, (root).time##__DOT__hi, (root).time##__DOT__u_clock__DOT__fraction_q, \
        (root).time##__DOT__u_clock__DOT__carry_q, (root).time##__DOT__u_clock__DOT__carry2_q,    \
        (root).time##__DOT__u_clock__DOT__carry3_q, (root).time##__DOT__u_clock__DOT__incn_q,     \
        (root).time##__DOT__armed, (root).time##__DOT__u_clock__DOT__incf_q,                      \
        (root).time##__DOT__u_cmp__DOT__target_q                                                  \
  }
