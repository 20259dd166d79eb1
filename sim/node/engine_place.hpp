// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EnginePlace: where in its bit a Verilated can_core is.
#pragma once

#include <bit>
#include <cstdint>

#include "bus/trace.hpp"
#include "verican/verican_regs.h"
#include "verilated.h"

namespace vericansim {

/// The prescaler and the position of the model (rtl/bit/can_tq_gen.sv, can_bit_timing.sv), read and
/// moved on in closed form. For QuietEngine, which knows when they are all that moves, and whether
/// the model has their members.
class EnginePlace {
 public:
  /// Clocks of a time quantum.
  template <typename Root>
  [[nodiscard]] static std::uint64_t clocks_of_tq(const Root &root) {
    return root.presdiv_i + 1U;
  }

  /// Edges until tq_o is 1; 0: it is.
  template <typename Root>
  [[nodiscard]] static std::uint64_t to_tick(const Root &root) {
    if (root.can_core__DOT__tq != 0) return 0;
    const std::uint64_t clocks = clocks_of_tq(root);
    const std::uint64_t count = root.can_core__DOT__u_tq_gen__DOT__gen_divide__DOT__count_q;
    return count >= clocks ? 1 : clocks - count;
  }

  /// Whole quanta from the next tick until the one at which more happens than counting.
  template <typename Root>
  [[nodiscard]] static std::uint64_t quanta(const Root &root) {
    // Of three samples the trace shows the majority, which changes with the levels before.
    const unsigned levels = level(root) ? 3 : 0;
    const bool following =
        root.smp_i != 0 && root.can_core__DOT__u_bit_timing__DOT__prev_q != levels;
    if (root.can_core__DOT__u_bit_timing__DOT__falling != 0 || following) return 0;
    const unsigned pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
    const unsigned last = root.can_core__DOT__u_bit_timing__DOT__seg2_q != 0
                              ? root.pseg2_i + 1U
                              : root.can_core__DOT__u_bit_timing__DOT__tseg1_q + 1U;
    return pos < last ? last - pos : 0;
  }

  /// `edges` pass, less than a bit, in which only quanta and positions count.
  template <typename Root>
  static void count(Root &root, std::uint64_t edges) {
    const std::uint32_t ticks = count_clocks(root, edges);
    if (ticks != 0) advance(root, ticks);
  }

  /// As count(), of the prescaler alone; the quanta that end.
  template <typename Root>
  static std::uint32_t count_clocks(Root &root, std::uint64_t edges) {
    const std::uint64_t before = to_tick(root);
    auto &count = root.can_core__DOT__u_tq_gen__DOT__gen_divide__DOT__count_q;
    if (edges < before) {
      count += static_cast<CData>(edges);
      return 0;
    }
    // 32 bits are enough, and divide faster.
    const auto clocks = static_cast<std::uint32_t>(clocks_of_tq(root));
    const auto ticks_and_rest = static_cast<std::uint32_t>(edges - before);
    const std::uint32_t ticks = (ticks_and_rest + clocks - 1) / clocks;
    const std::uint32_t rest = ticks * clocks - ticks_and_rest;  // to the next tick
    count = static_cast<CData>(clocks - rest);
    root.can_core__DOT__tq = rest == 0;
    return ticks;
  }

  /// Sets what follows from the position (can_bit_timing), in a quantum without an edge that
  /// synchronises.
  template <typename Root>
  static void mark(Root &root) {
    const unsigned pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
    const bool seg2 = root.can_core__DOT__u_bit_timing__DOT__seg2_q != 0;
    const bool hard = root.can_core__DOT__u_bit_timing__DOT__hard_q != 0;
    const bool edge = (root.can_core__DOT__u_bit_timing__DOT__armed_q &
                       root.can_core__DOT__u_bit_timing__DOT__prev_q & 1U) != 0;
    const bool due = !seg2 && pos > root.can_core__DOT__u_bit_timing__DOT__tseg1_q;
    const bool due_d = due && !(edge && (hard || root.can_core__DOT__tx_q != 0));
    const bool near =
        seg2 && edge && (hard || pos > root.can_core__DOT__u_bit_timing__DOT__reach_q);
    const bool end = seg2 && pos > root.pseg2_i;
    show(root, due, due_d, near, end);
  }

  /// The quantum that ends has an edge that synchronises (SY-01 to SY-10), neither the sample point
  /// nor the end of the bit, and the level is dominant: the position moves by it.
  template <typename Root>
  static void synchronise(Root &root) {
    auto &pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
    const bool seg2 = root.can_core__DOT__u_bit_timing__DOT__seg2_q != 0;
    const bool hard = root.can_core__DOT__u_bit_timing__DOT__hard_q != 0;
    const bool late = root.can_core__DOT__tx_q != 0 && !seg2 && pos != 0;
    const bool clipped = late && pos <= root.rjw_i;
    const unsigned step = seg2 ? root.rjw_i + 1U : late ? ~static_cast<unsigned>(root.rjw_i) : 0U;
    const bool due = !hard && !seg2 &&
                     (late ? root.can_core__DOT__u_bit_timing__DOT__due_q != 0 && root.rjw_i == 0
                           : pos >= root.can_core__DOT__u_bit_timing__DOT__tseg1_q);
    const bool end = seg2 && pos >= root.can_core__DOT__u_bit_timing__DOT__reach_q;
    auto &prev = root.can_core__DOT__u_bit_timing__DOT__prev_q;
    prev = static_cast<CData>((prev << 1) & 3U);
    root.can_core__DOT__u_bit_timing__DOT__armed_q = 0;
    pos = static_cast<CData>(hard || clipped ? 1U : (pos + step + 1U) & kPositions);
    show(root, due, due, false, end);
  }

 private:
  // Quanta up to the sample point, as many as CTRL1 can say: SYNC_SEG, PROP_SEG, PHASE_SEG1.
  static constexpr unsigned kMostQuanta =
      1 + (VERICAN_CTRL1_PROPSEG_GET(VERICAN_CTRL1_PROPSEG_MASK) + 1) +
      (VERICAN_CTRL1_PSEG1_GET(VERICAN_CTRL1_PSEG1_MASK) + 1);
  // PosWidth of can_bit_timing; the model has a member of 8 bits for them.
  static constexpr unsigned kPosWidth = 5;
  static constexpr unsigned kPositions = (1U << kPosWidth) - 1;
  static_assert(std::bit_ceil(kMostQuanta) == 1U << kPosWidth, "the least that hold all quanta");

  // Sets the four flip-flops, and what follows from them at once.
  template <typename Root>
  static void show(Root &root, bool due, bool due_d, bool near, bool end) {
    root.can_core__DOT__u_bit_timing__DOT__due_q = due;
    root.can_core__DOT__u_bit_timing__DOT__due_d_q = due_d;
    root.can_core__DOT__u_bit_timing__DOT__near_q = near;
    root.can_core__DOT__u_bit_timing__DOT__end_q = end;
    const unsigned pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
    const bool seg2 = root.can_core__DOT__u_bit_timing__DOT__seg2_q != 0;
    const bool sampling = level(root) ? due : due_d;
    root.can_core__DOT__u_bit_timing__DOT__sampling = sampling;
    root.can_core__DOT__u_bit_timing__DOT__ending = end || (near && !level(root));
    root.can_core__DOT__u_bit_timing__DOT__due =
        !sampling && !seg2 && pos >= root.can_core__DOT__u_bit_timing__DOT__tseg1_q;
    root.can_core__DOT__u_bit_timing__DOT__reached =
        pos >= root.can_core__DOT__u_bit_timing__DOT__reach_q;
  }

 private:
  // What can_bit_timing sees: the settled pin, in loop-back what the node sends.
  template <typename Root>
  static bool level(const Root &root) {
    if (root.lpb_i != 0) return (root.trace_o & kTraceTx) != 0;
    return root.can_core__DOT__u_sync__DOT__settled_q != 0;
  }

  template <typename Root>
  static void advance(Root &root, std::uint32_t quanta) {
    auto &pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
    pos = static_cast<CData>(pos + quanta);
    const unsigned now = level(root) ? 1 : 0;
    auto &prev = root.can_core__DOT__u_bit_timing__DOT__prev_q;
    if (quanta == 1) prev = static_cast<CData>(((prev << 1) & 3U) | now);
    if (quanta > 1) prev = static_cast<CData>(3U * now);
    mark(root);
  }
};

}  // namespace vericansim
