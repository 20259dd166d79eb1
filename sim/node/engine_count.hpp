// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EngineCount: edges of a Verilated can_core that only count, done in closed form.
#pragma once

#include <cstdint>
#include <type_traits>

#include "bus/trace.hpp"
#include "bus/types.hpp"
#include "node/engine_edge.hpp"
#include "node/engine_judge.hpp"
#include "node/engine_level.hpp"
#include "node/engine_place.hpp"
#include "node/engine_time.hpp"

namespace vericansim {

/// What the registers of the model are behind such edges; what follows from them at once is left to
/// QuietEngine, which knows which edges they are.
class EngineCount {
 public:
  /// The level of the pin goes one flip-flop of u_sync on.
  template <typename Root>
  static void take_level(Root &root, Level rx) {
    root.can_core__DOT__u_sync__DOT__settled_q = root.can_core__DOT__u_sync__DOT__meta_q;
    root.can_core__DOT__u_sync__DOT__meta_q = static_cast<CData>(rx);
    root.can_rx_i = static_cast<CData>(rx);
  }

  /// No quantum ends, the level stays, no sample point is to be forgotten and no bit to be judged:
  /// what is combinational has nothing to follow.
  template <typename Root>
  static bool between_quanta(const Root &root) {
    return root.can_core__DOT__tq == 0 && root.can_core__DOT__first_q == 0 &&
           root.can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q == 0 &&
           root.can_core__DOT__u_sync__DOT__settled_q == root.can_core__DOT__u_sync__DOT__meta_q;
  }

  /// What is more at a boundary; `pos`: the position before.
  template <typename Engine>
  static void begin_bit(Engine &engine, unsigned pos) {
    auto &root = *engine.rootp;
    if constexpr (EngineEdge::kSends<Engine>) EngineLevel::send(root, trace_field(root.trace_o));
    root.can_core__DOT__u_bit_timing__DOT__pos_q = pos != root.pseg2_i + 1U;
    root.can_core__DOT__u_bit_timing__DOT__seg2_q = 0;
    root.can_core__DOT__u_bit_timing__DOT__hard_q = 0;
    root.can_core__DOT__first_q = 1;
    EnginePlace::mark(root);
  }

  /// Edges that count, without what is combinational in the one that shows something.
  template <typename Engine>
  static void count(Engine &engine, std::uint64_t edges) {
    if constexpr (EngineEdge::kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      auto &root = *engine.rootp;
      pass_time(engine, edges);
      forget_sample(root);
      if (root.can_core__DOT__active_q == 0) return;
      if constexpr (EngineEdge::kJudges<std::remove_reference_t<decltype(*engine.rootp)>>) {
        if (root.can_core__DOT__first_q != 0) EngineJudge::judge(root);
      }
      EnginePlace::count(root, edges);
    }
  }

 private:
  // The mark of the sample point; Verilator may make one register of two that are equal.
  template <typename Root>
  static void forget_sample(Root &root) {
    root.can_core__DOT__u_bsp__DOT__u_fault__DOT__decided_q = 0;
    if constexpr (requires { root.can_core__DOT__u_bsp__DOT__sampled_q; })
      root.can_core__DOT__u_bsp__DOT__sampled_q = 0;
  }
};

}  // namespace vericansim
