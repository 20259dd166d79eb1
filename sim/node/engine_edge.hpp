// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EngineEdge: what moves at the next clock edge of a Verilated can_core.
#pragma once

#include <type_traits>
#include <utility>

#include "bus/trace.hpp"
#include "node/engine_judge.hpp"
#include "node/engine_level.hpp"
#include "node/engine_place.hpp"
#include "node/engine_time.hpp"
#include "node/model_edge.hpp"

namespace vericansim {

/// For QuietEngine, which does in closed form the edges at which little moves. Without the members
/// that Verilator 5.006 gives the model (kKnown false) none of them is known.
class EngineEdge {
 public:
  /// The model has the members that are looked at.
  template <typename Root>
  static constexpr bool kKnown = !kPlainEdges && requires(Root & root) {
    root.can_core__DOT__tq;
    root.can_core__DOT__active_q;
    root.can_core__DOT__first_q;
    root.can_core__DOT__tx_q;
    root.can_core__DOT__u_sync__DOT__meta_q;
    root.can_core__DOT__u_sync__DOT__settled_q;
    root.can_core__DOT__u_tq_gen__DOT__gen_divide__DOT__count_q;
    root.can_core__DOT__u_bit_timing__DOT__seg2_q;
    root.can_core__DOT__u_bit_timing__DOT__pos_q;
    root.can_core__DOT__u_bit_timing__DOT__hard_q;
    root.can_core__DOT__u_bit_timing__DOT__prev_q;
    root.can_core__DOT__u_bit_timing__DOT__armed_q;
    root.can_core__DOT__u_bit_timing__DOT__tseg1_q;
    root.can_core__DOT__u_bit_timing__DOT__reach_q;
    root.can_core__DOT__u_bit_timing__DOT__due_q;
    root.can_core__DOT__u_bit_timing__DOT__due_d_q;
    root.can_core__DOT__u_bit_timing__DOT__near_q;
    root.can_core__DOT__u_bit_timing__DOT__end_q;
    root.can_core__DOT__u_bit_timing__DOT__due;
    root.can_core__DOT__u_bit_timing__DOT__reached;
    root.can_core__DOT__u_bit_timing__DOT__sampling;
    root.can_core__DOT__u_bit_timing__DOT__ending;
    root.can_core__DOT__u_bit_timing__DOT__falling;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__boff_seen_q;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__plus8_q;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__plus1_q;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__minus1_q;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__sequence_q;
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__recovered_q;
  };

  /// Its judgement of a bit and the level that it sends next are known, too: an engine with
  /// ByteWise = 1 keeps the frame elsewhere.
  template <typename Root>
  static constexpr bool kJudges =
      kKnown<Root> &&EngineJudge::kKnown<Root> &&EngineLevel::kKnown<Root>;

  /// A level that it sends may change in closed form: no time unit looks at it.
  template <typename Engine>
  static constexpr bool kSends =
      kJudges<std::remove_reference_t<decltype(*std::declval<Engine &>().rootp)>> &&
      !kHasTimeUnit<Engine>;

  /// The level of the receive pin has got through u_sync.
  template <typename Engine>
  [[nodiscard]] static bool pin_settled(const Engine &engine) {
    if constexpr (kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      const auto &root = *engine.rootp;
      return root.can_core__DOT__u_sync__DOT__meta_q == root.can_rx_i &&
             root.can_core__DOT__u_sync__DOT__settled_q == root.can_rx_i;
    } else {
      return false;
    }
  }

  /// Only quanta and positions count.
  template <typename Engine>
  [[nodiscard]] static bool counts(const Engine &engine) {
    if constexpr (kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      const auto &root = *engine.rootp;
      return root.can_core__DOT__u_bsp__DOT__u_fault__DOT__boff_seen_q == root.boff_o &&
             (root.can_core__DOT__active_q == 0 || root.can_core__DOT__tq == 0 ||
              EnginePlace::quanta(root) != 0);
    } else {
      return false;
    }
  }

  /// The edge after this one clears nothing but the mark of the sample point.
  template <typename Engine>
  [[nodiscard]] static bool quiet_sample(const Engine &engine) {
    return engine.rootp->can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q != 0 && !pulses(engine);
  }

  /// The edge after this one is the first of a bit of a frame: all that it does is to judge it.
  template <typename Engine>
  [[nodiscard]] static bool only_judges(const Engine &engine) {
    using Root = std::remove_reference_t<decltype(*engine.rootp)>;
    if constexpr (kJudges<Root>) {
      const auto &root = *engine.rootp;
      const Field field = trace_field(root.trace_o);
      return root.can_core__DOT__first_q != 0 && field >= Field::kSof && field <= Field::kEof &&
             (root.run_i & root.can_core__DOT__active_q) != 0 &&
             root.can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q == 0 && !pulses(engine);
    } else {
      return false;
    }
  }

  /// Something is to be cleared again.
  template <typename Engine>
  [[nodiscard]] static bool pulses(const Engine &engine) {
    const auto &root = *engine.rootp;
    const unsigned levels = root.tx_next_o | root.stamp_o | root.rx_hdr_o | root.rx_byte_we_o |
                            root.can_core__DOT__u_bsp__DOT__u_fault__DOT__plus8_q |
                            root.can_core__DOT__u_bsp__DOT__u_fault__DOT__plus1_q |
                            root.can_core__DOT__u_bsp__DOT__u_fault__DOT__minus1_q |
                            root.can_core__DOT__u_bsp__DOT__u_fault__DOT__sequence_q |
                            root.can_core__DOT__u_bsp__DOT__u_fault__DOT__recovered_q;
    return levels != 0 || (root.trace_o & kTraceEvents) != 0;
  }

  /// A bit within a frame, or a delimiter, begins, and nothing but the place in the bit and the
  /// level that is sent move (rtl/frame/can_tx_frame.sv); a frame allows no hard synchronisation
  /// (SY-05).
  template <typename Engine>
  [[nodiscard]] static bool begins_bit(const Engine &engine) {
    using Root = std::remove_reference_t<decltype(*engine.rootp)>;
    if constexpr (kKnown<Root>) {
      const auto &root = *engine.rootp;
      const bool boundary = (root.trace_o & kTraceBoundary) != 0;
      const unsigned busy = root.can_core__DOT__first_q |
                            root.can_core__DOT__u_bit_timing__DOT__falling |
                            root.can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q;
      return boundary && busy == 0 && (kSends<Engine> ? knows_level(root) : keeps_level(root)) &&
             !pulses(engine) && root.rx_req_i == 0 &&
             (root.run_i & root.can_core__DOT__active_q) != 0;
    } else {
      return false;
    }
  }

  /// It synchronises, and nothing looks at that but the bit timing: no receiver of CAN FD that
  /// integrates (IN-02), no time unit.
  template <typename Engine>
  [[nodiscard]] static bool synchronises(const Engine &engine) {
    using Root = std::remove_reference_t<decltype(*engine.rootp)>;
    if constexpr (kKnown<Root> && !kHasTimeUnit<Engine>) {
      const auto &root = *engine.rootp;
      const unsigned busy =
          root.can_core__DOT__first_q | root.lpb_i | root.rx_req_i |
          root.can_core__DOT__u_bit_timing__DOT__sampling |
          root.can_core__DOT__u_bit_timing__DOT__ending |
          root.can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q |
          (root.can_core__DOT__u_bsp__DOT__u_fault__DOT__boff_seen_q ^ root.boff_o);
      return (root.can_core__DOT__tq & root.can_core__DOT__u_bit_timing__DOT__falling &
              root.can_core__DOT__active_q & root.run_i) != 0 &&
             busy == 0 && trace_field(root.trace_o) != Field::kInteg && !pulses(engine);
    } else {
      return false;
    }
  }

  /// The next boundary is one of a frame and changes neither the level that the node sends nor the
  /// pin.
  template <typename Root>
  [[nodiscard]] static bool keeps_level(const Root &root) {
    const Field field = trace_field(root.trace_o);
    if (field < Field::kSof || field == Field::kErrFlag || field == Field::kOvlFlag) return false;
    const unsigned level = root.can_core__DOT__tx_q;
    if constexpr (kJudges<Root>) {
      return EngineLevel::next(root, field) == (level != 0) &&
             root.can_tx_o == (level | root.lom_i | root.lpb_i);
    } else {
      return root.transmitter_o == 0 && field != Field::kAck && level != 0;
    }
  }

 private:
  // The field is one of a frame or a delimiter, for which EngineLevel knows what is sent; in
  // loop-back the node would hear it.
  template <typename Root>
  static bool knows_level(const Root &root) {
    const Field field = trace_field(root.trace_o);
    return field >= Field::kSof && field != Field::kErrFlag && field != Field::kOvlFlag &&
           root.lpb_i == 0;
  }
};

}  // namespace vericansim
