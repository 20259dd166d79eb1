// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeRest: clocks of a Verilated can_core in which the time unit does nothing but count.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "node/model_edge.hpp"

class Vcan_core_time;

namespace vericansim {

/// Whether a Verilated can_core has the time unit.
template <typename Engine>
inline constexpr bool kHasTimeUnit = std::is_same_v<Engine, Vcan_core_time>;

/// `time_out_o` of a whole core around `engine`, which is that of two of its flip-flops (TM-31).
template <typename Engine>
[[nodiscard]] bool time_out_of(const Engine &engine) {
  constexpr unsigned kStatOut = 2, kTctrlOuten = 12;  // can_pkg::TimeStatOut, TCTRL
  return (engine.time_stat_o >> kStatOut & engine.time_tctrl_i >> kTctrlOuten & 1U) != 0;
}

/// While nobody asks anything of the clock, nothing is slewed, no level changes and neither a
/// compare nor a launch is due, only the numbers of the clock change (TM-10), and any count of
/// clocks is a multiplication (rtl/time/can_clock.sv). An engine without the time unit is always at
/// rest here. Proven member by member in tb/system/bus_quiet_engine_test.cpp.
class TimeRest {
 public:
  static constexpr std::uint64_t kForever = std::numeric_limits<std::uint64_t>::max();

  /// Edges to come that only count, as long as no input of the engine and no field changes.
  template <typename Engine>
  [[nodiscard]] static std::uint64_t edges(const Engine &engine) {
    if constexpr (!kHasTimeUnit<Engine>) {
      return kForever;
    } else if constexpr (kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      return steady(engine) ? std::min(to_compare(engine), to_launch(engine)) : 0;
    } else {
      return 0;
    }
  }

  /// Does `count` of them.
  template <typename Root>
  static void pass(Root &root, std::uint64_t count) {
    if constexpr (kKnown<Root>)
      if (count != 0) pass_(root, count);
  }

  /// TIME. std::logic_error for a model that does not show its registers.
  template <typename Root>
  [[nodiscard]] static std::uint64_t time(const Root &root) {
    if constexpr (kKnown<Root>) {
      return root.can_core__DOT__gen_time__DOT__u_time__DOT__now;
    } else {
      throw std::logic_error("the clock of this model cannot be looked at");
    }
  }

 private:
  template <typename Root>
  static constexpr bool kKnown = !kPlainEdges && requires(Root & root) {
    root.can_core__DOT__rx;
    root.can_core__DOT__tx_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__lo;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__hi;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__lo_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__now;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__to_target;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__armed;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__held;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__slewing_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__incn_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__incf_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__slew_bit;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__bit_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__offset1_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__offset2_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__set1_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__set2_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__set3_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__data_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__upper2_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__upper3_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__addend_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__grow_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__changed_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__fraction_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__carry_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__carry2_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__carry3_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__target_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__reached_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__due_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__match;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__launch;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__point_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__txpin_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__rx_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__tx_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__fixed_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__told_q;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__field_q;
  };

  // The registers between the adders carry nothing but the increment.
  template <typename Root>
  static bool clock_steady(const Root &root) {
    const unsigned busy = root.can_core__DOT__gen_time__DOT__u_time__DOT__slewing_q |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__match |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__launch |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__offset1_q |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__offset2_q |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__set1_q |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__set2_q |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__set3_q |
                          root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__upper3_q;
    const std::uint64_t data = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__data_q;
    const std::uint32_t increment =
        root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__incn_q;
    return busy == 0 && root.time_left_o == 0 && data == root.time_data_i &&
           root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__upper2_q == data >> 32 &&
           root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__grow_q == increment &&
           root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__addend_q == increment;
  }

  // No level has changed, nothing is being captured or told.
  template <typename Engine>
  static bool stamp_steady(const Engine &engine) {
    const auto &root = *engine.rootp;
    constexpr unsigned kPointMask = 3, kTxpinBit = 2;  // TCTRL
    const unsigned busy = engine.time_stamp_we_o | engine.stamp_o | engine.rx_valid_o;
    const bool level = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__rx_q ==
                           root.can_core__DOT__rx &&
                       root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__tx_q ==
                           root.can_core__DOT__tx_q;
    if (busy != 0 || !level) return false;
    const bool between = root.can_core__DOT__u_bsp__DOT__u_field__DOT__field_q < 8;
    const unsigned fixed = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__fixed_q;
    const unsigned told = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__told_q;
    if (!between) return fixed == told;
    const unsigned point = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__point_q;
    const unsigned txpin = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__txpin_q;
    return fixed == 0 && told == 0 && point == (engine.time_tctrl_i & kPointMask) &&
           txpin == (engine.time_tctrl_i >> kTxpinBit & 1);
  }

  template <typename Engine>
  static bool steady(const Engine &engine) {
    return engine.time_cmd_i == 0 && clock_steady(*engine.rootp) && stamp_steady(engine);
  }

  // Clocks that end before `target`, 32 bits of TIME, by a margin; 0 if it has come.
  template <typename Root>
  static std::uint64_t clocks_before(const Root &root, std::uint32_t target) {
    constexpr std::uint64_t kMargin = 4;
    const auto left =
        static_cast<std::int32_t>(target - root.can_core__DOT__gen_time__DOT__u_time__DOT__lo);
    if (left <= 0) return 0;
    const std::uint64_t most =
        root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__incn_q + 1U;
    const std::uint64_t clocks = static_cast<std::uint64_t>(left) / most;
    return clocks > kMargin ? clocks - kMargin : 0;
  }

  template <typename Engine>
  static std::uint64_t to_compare(const Engine &engine) {
    const auto &root = *engine.rootp;
    if (root.can_core__DOT__gen_time__DOT__u_time__DOT__armed == 0) return kForever;
    return clocks_before(root,
                         root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__target_q);
  }

  template <typename Engine>
  static std::uint64_t to_launch(const Engine &engine) {
    const auto &root = *engine.rootp;
    if (root.can_core__DOT__gen_time__DOT__u_time__DOT__held == 0) return kForever;
    return clocks_before(root, engine.time_ttx_i);
  }

  // The carry of a clock's fraction reaches the lower half two clocks later, that of the lower half
  // the upper one a clock later.
  template <typename Root>
  static void pass_(Root &root, std::uint64_t count) {
    auto &fraction = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__fraction_q;
    auto &carry = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__carry_q;
    auto &carry2 = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__carry2_q;
    auto &carry3 = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__carry3_q;
    auto &lo = root.can_core__DOT__gen_time__DOT__u_time__DOT__lo;
    auto &hi = root.can_core__DOT__gen_time__DOT__u_time__DOT__hi;
    const std::uint32_t whole =
        root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__incn_q;
    const std::uint64_t part = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__incf_q;
    const auto step = [&] {  // the fraction's clock
      carry2 = carry;
      const std::uint64_t sum = fraction + part;
      fraction = static_cast<std::uint32_t>(sum);
      carry = static_cast<std::uint8_t>(sum >> 32);
    };
    const std::uint64_t before_last = count - 1;
    std::uint64_t time = ((std::uint64_t{hi} + carry3) << 32 | lo) + before_last * whole;
    std::uint64_t in = carry2;  // the carry that the last clock but one has added
    if (before_last == 1) {
      time += carry2;
      step();
    } else if (before_last > 1) {
      // What comes in: two carries that are under way, and all that are made but for the last two.
      __extension__ using Wide = unsigned __int128;
      const Wide sum = Wide{fraction} + Wide{before_last - 2} * part;
      time += carry2 + carry + static_cast<std::uint64_t>(sum >> 32);
      in = before_last == 2 ? carry : static_cast<std::uint32_t>(sum) < part;
      fraction = static_cast<std::uint32_t>(sum);
      step();
      step();
    }
    const std::uint64_t last = time + whole + carry2;
    step();
    carry3 = (last >> 32) != (time >> 32);
    hi = static_cast<std::uint32_t>(time >> 32);
    lo = static_cast<std::uint32_t>(last);
    auto &slew_bit = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__slew_bit;
    constexpr unsigned kSlewrAt = 4;  // TCTRL
    const unsigned bit = 13 - (root.time_tctrl_i >> kSlewrAt & 3);
    auto &bit_q = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__bit_q;
    const auto bit_of = [bit](std::uint64_t ns) {
      return static_cast<std::uint8_t>(ns >> bit & 1);
    };
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__changed_q =
        before_last == 0 ? slew_bit != bit_q : bit_of(time) != bit_of(time - whole - in);
    slew_bit = bit_of(lo);
    bit_q = bit_of(time);
    root.can_core__DOT__gen_time__DOT__u_time__DOT__lo_q = static_cast<std::uint32_t>(time);
    root.can_core__DOT__gen_time__DOT__u_time__DOT__now =
        std::uint64_t{hi} << 32 | static_cast<std::uint32_t>(time);
    // What has been reached looks at the lower half that is a clock ahead.
    const auto to_go = [](std::uint32_t target, std::uint64_t ns) {
      return target + ~static_cast<std::uint32_t>(ns);
    };
    const std::uint32_t target =
        root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__target_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__to_target = to_go(target, lo);
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__reached_q =
        static_cast<std::uint8_t>(to_go(target, time) >> 31);
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__due_q =
        static_cast<std::uint8_t>(to_go(root.time_ttx_i, time) >> 31);
  }
};

}  // namespace vericansim
