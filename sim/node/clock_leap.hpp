// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockLeap: the flip-flops of can_clock after any number of undisturbed clocks, in closed form.
#pragma once

#include <cstdint>

namespace vericansim {

/// What moves in rtl/time/can_clock.sv while there is neither a command nor a slew.
struct ClockLeap {
  std::uint32_t lo = 0, hi = 0;  ///< lo_o, hi_o
  std::uint32_t fraction = 0;    ///< fraction_q
  bool carry = false;            ///< carry_q: out of the fraction, in this clock
  bool carry2 = false;           ///< carry2_q: the same, of the clock before
  bool carry3 = false;           ///< carry3_q: out of the lower half, on its way to the upper one

  /// One clock later; `increment` in 2^-32 ns a clock, 40 bits (TM-10).
  void step(std::uint64_t increment) {
    const std::uint64_t lower = lo + (increment >> 32) + carry2;
    const std::uint64_t part = fraction + (increment & 0xFFFF'FFFF);
    hi += carry3;
    lo = static_cast<std::uint32_t>(lower);
    carry3 = (lower >> 32) != 0;
    carry2 = carry;
    fraction = static_cast<std::uint32_t>(part);
    carry = (part >> 32) != 0;
  }

  /// `clocks` later, any number of them.
  ///
  /// Whole and fraction grow as one number once carries on their way are counted as done; which
  /// carries are on their way then follows from the last sums, if there were three of them: one
  /// that is smaller than what was added has wrapped.
  void pass(std::uint64_t clocks, std::uint64_t increment) {
    if (clocks >= 3) return leap(clocks, increment);
    for (; clocks > 0; --clocks) step(increment);
  }

 private:
  void leap(std::uint64_t clocks, std::uint64_t increment) {
    __extension__ using Wide = unsigned __int128;
    const auto step = static_cast<std::uint32_t>(increment);
    const std::uint64_t whole =
        ((std::uint64_t{hi} + carry3) << 32) + lo + carry + std::uint64_t{carry2};
    const Wide total = (Wide{whole} << 32 | fraction) + Wide{increment} * clocks;
    const auto wrapped = [&](std::uint32_t ago) {
      return static_cast<std::uint32_t>(total) - ago * step < step;
    };
    fraction = static_cast<std::uint32_t>(total);
    carry = wrapped(0);
    carry2 = wrapped(1);
    const std::uint64_t now = static_cast<std::uint64_t>(total >> 32) - carry - carry2;
    lo = static_cast<std::uint32_t>(now);
    carry3 = lo < (increment >> 32) + std::uint64_t{wrapped(2)};
    hi = static_cast<std::uint32_t>(now >> 32) - carry3;
  }
};

}  // namespace vericansim
