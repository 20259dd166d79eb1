// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeRest: clocks of a Verilated can_core in which the time unit does nothing but count.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "node/model_edge.hpp"
#include "node/time_flops.hpp"
#include "verican/verican_regs.h"

class Vcan_core_time;

namespace vericansim {

/// Whether a Verilated can_core has the time unit.
template <typename Engine>
inline constexpr bool kHasTimeUnit = std::is_same_v<Engine, Vcan_core_time>;

/// `time_out_o` of a whole core around `engine`, which is that of two of its flip-flops (TM-31).
template <typename Engine>
[[nodiscard]] bool time_out_of(const Engine &engine) {
  constexpr unsigned kStatOut = 1U << 2;  // can_pkg::TimeStatOut
  return (engine.time_stat_o & kStatOut) != 0 &&
         (engine.time_tctrl_i & VERICAN_TCTRL_OUTEN_MASK) != 0;
}

/// While nobody asks anything of the clock, nothing is slewed, no level changes and neither a
/// compare nor a launch is due, only the numbers of the clock change (TM-10), and any count of
/// clocks is a multiplication (ClockLeap). An engine without the time unit is always at
/// rest here. Proven member by member in tb/system/bus_quiet_engine_test.cpp.
class TimeRest {
 public:
  static constexpr std::uint64_t kForever = TimeFlops::kForever;

  /// Edges to come that only count, as long as no input of the engine and no field changes.
  template <typename Engine>
  [[nodiscard]] static std::uint64_t edges(const Engine &engine) {
    if constexpr (!kHasTimeUnit<Engine>) {
      return kForever;
    } else if constexpr (kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      return steady(engine)
                 ? std::min(flops_of(*engine.rootp).clocks_before_compare(), to_launch(engine))
                 : 0;
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
    VERICAN_TIME_FLOPS(root, can_core__DOT__gen_time__DOT__u_time);
    root.can_core__DOT__gen_time__DOT__u_time__DOT__lo_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__now;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__to_target;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__held;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__slewing_q;
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

  template <typename Root>
  static TimeFlops flops_of(Root &root) {
    return VERICAN_TIME_FLOPS(root, can_core__DOT__gen_time__DOT__u_time);
  }

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

  // A level that was recessive a clock ago is dominant.
  template <typename Root>
  static bool falls(const Root &root) {
    const unsigned rx_before = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__rx_q;
    const unsigned tx_before = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__tx_q;
    return (rx_before & ~unsigned{root.can_core__DOT__rx}) != 0 ||
           (tx_before & ~unsigned{root.can_core__DOT__tx_q}) != 0;
  }

  // Nothing is being captured or told.
  template <typename Engine>
  static bool stamp_steady(const Engine &engine) {
    const auto &root = *engine.rootp;
    const unsigned busy = engine.time_stamp_we_o | engine.stamp_o | engine.rx_valid_o;
    if (busy != 0) return false;
    const bool between = root.can_core__DOT__u_bsp__DOT__u_field__DOT__field_q < 8;
    const unsigned fixed = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__fixed_q;
    const unsigned told = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__told_q;
    if (fixed == 0 && falls(root)) return false;  // its time may be taken
    if (!between) return fixed == told;
    const unsigned point = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__point_q;
    const unsigned txpin = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__txpin_q;
    return fixed == 0 && told == 0 && point == VERICAN_TCTRL_POINT_GET(engine.time_tctrl_i) &&
           (txpin != 0) == ((engine.time_tctrl_i & VERICAN_TCTRL_TXPIN_MASK) != 0);
  }

  template <typename Engine>
  static bool steady(const Engine &engine) {
    return engine.time_cmd_i == 0 && clock_steady(*engine.rootp) && stamp_steady(engine);
  }

  template <typename Engine>
  static std::uint64_t to_launch(const Engine &engine) {
    auto &root = *engine.rootp;
    if (root.can_core__DOT__gen_time__DOT__u_time__DOT__held == 0) return kForever;
    return flops_of(root).clocks_before(engine.time_ttx_i);
  }

  // The clock, and what follows its lower half: a clock behind it, or in the same.
  template <typename Root>
  static void pass_(Root &root, std::uint64_t count) {
    const TimeFlops flops = flops_of(root);
    const std::uint64_t increment = flops.increment();
    const unsigned bit = 13 - VERICAN_TCTRL_SLEWR_GET(root.time_tctrl_i);
    auto &slew_bit = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__slew_bit;
    auto &bit_q = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__bit_q;
    auto &changed = root.can_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__changed_q;
    ClockLeap clock = flops.clock();
    changed = slew_bit != bit_q;
    if (count > 1) {
      clock.pass(count - 2, increment);
      const std::uint32_t before = clock.lo;
      clock.step(increment);
      changed = ((before ^ clock.lo) >> bit & 1) != 0;
    }
    const std::uint32_t last = clock.lo;
    clock.step(increment);
    flops.set(clock);
    slew_bit = clock.lo >> bit & 1;
    bit_q = last >> bit & 1;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__rx_q = root.can_core__DOT__rx;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_stamp__DOT__tx_q = root.can_core__DOT__tx_q;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__lo_q = last;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__now = std::uint64_t{clock.hi} << 32 | last;
    const std::uint32_t target = flops.target;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__to_target = target + ~clock.lo;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__reached_q = (target + ~last) >> 31;
    root.can_core__DOT__gen_time__DOT__u_time__DOT__u_cmp__DOT__due_q =
        (root.time_ttx_i + ~last) >> 31;
  }
};

}  // namespace vericansim
