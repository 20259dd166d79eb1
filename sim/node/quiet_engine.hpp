// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// QuietEngine: the clocks of a Verilated can_core in which only the place in the bit moves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "bus/trace.hpp"
#include "bus/types.hpp"
#include "node/engine_count.hpp"
#include "node/engine_edge.hpp"
#include "node/engine_place.hpp"
#include "node/engine_time.hpp"
#include "node/model_edge.hpp"

namespace vericansim {

/// Clocks of a bit, by the inputs of `engine` (BT-01).
template <typename Engine>
[[nodiscard]] std::uint64_t clocks_of_bit(const Engine &engine) {
  const unsigned quanta = 4U + engine.propseg_i + engine.pseg1_i + engine.pseg2_i;
  return std::uint64_t{quanta} * (engine.presdiv_i + 1U);
}

/// Watches an engine edge by edge, says how many edges to come only count quanta and positions, and
/// does them at once, up to the one that makes a sample point or a boundary show; up to the sample
/// point, if the boundary before it begins a bit of the frame in which the node keeps its level.
/// Everything but prescaler, position and the levels of the last quanta moves within kSettle edges
/// of a sample point or a bit boundary, within one of an edge that synchronises; after that, until
/// the next of them, these only count and follow (rtl/bit/can_tq_gen.sv, can_bit_timing.sv). After
/// a sample point that raised no pulse the second of its edges does no more than forget the sample
/// point, which pass() does; within a frame so it does what the first edge of a bit does, in which
/// the bit is judged (rtl/frame/can_error.sv). Proven bit by bit in tb/system/bus_rest_test.cpp,
/// member by member in bus_quiet_engine_test.cpp.
///
/// An engine with the time unit is quiet while that one only counts, too (TimedEngine).
///
/// Needs the members that Verilator 5.006 gives the model; without them (in_force() false) nothing
/// is ever quiet.
class QuietEngine {
 public:
  /// Edges from the clock that shows a sample point, a boundary or a synchronising edge until all
  /// has followed.
  static constexpr unsigned kSettle = 2;

  template <typename Engine>
  [[nodiscard]] static constexpr bool in_force() {
    return EngineEdge::kKnown<std::remove_reference_t<decltype(*std::declval<Engine &>().rootp)>>;
  }
  /// Whether the first edge of a bit, too, is done in closed form.
  template <typename Engine>
  [[nodiscard]] static constexpr bool judges() {
    return EngineEdge::kJudges<std::remove_reference_t<decltype(*std::declval<Engine &>().rootp)>>;
  }

  /// After each edge of `engine` that was evaluated, before what is disturbed() by it.
  template <typename Engine>
  void clocked(const Engine &engine) {
    clocked_(engine);
  }

  /// The engine's inputs may have changed, other than can_rx_i.
  void disturbed() {
    to_settle_ = kSettle;
    disturbed_ = true;
  }

  /// Edges to come that only count, as long as no input changes. The last one makes the sample
  /// point, the boundary or the edge show, at which more happens in the one after it; `watched`:
  /// that one is not among them, nor any boundary.
  template <typename Engine>
  [[nodiscard]] std::uint64_t edges(const Engine &engine, bool watched) const {
    const bool settled = EngineEdge::pin_settled(engine);
    std::uint64_t counting = settled ? counting_(engine) : watched ? 0 : while_settling(engine);
    if (counting == 0) return 0;
    if (!watched && settled) counting += beyond_boundary(engine);
    counting = std::min(counting, edges_of_time(engine));
    return watched && counting != 0 ? counting - 1 : counting;
  }

  /// Does `edges` of them.
  template <typename Engine>
  void pass(Engine &engine, std::uint64_t edges) {
    if (edges != 0) pass_(engine, edges);
  }

  /// The next edge only counts and takes the level of the receive pin on.
  template <typename Engine>
  [[nodiscard]] bool counts(const Engine &engine) const {
    return to_settle_ == 0 && engine.rx_req_i == 0 && EngineEdge::counts(engine) &&
           edges_of_time(engine) != 0;
  }
  /// Does that one, with `rx` at the pin.
  template <typename Engine>
  void clock_lightly(Engine &engine, Level rx) {
    clock_lightly_(engine, rx, false);
  }

  /// The next edge begins a bit within a frame: nothing but the place in the bit and the level that
  /// the node sends move.
  template <typename Engine>
  [[nodiscard]] bool crosses_boundary(const Engine &engine) const {
    return to_settle_ == kSettle && !disturbed_ && edges_of_time(engine) != 0 &&
           EngineEdge::begins_bit(engine);
  }
  /// Does that one, with `rx` at the pin.
  template <typename Engine>
  void cross_boundary(Engine &engine, Level rx) {
    clock_lightly_(engine, rx, true);
  }

  /// The next edge does no more than synchronise.
  template <typename Engine>
  [[nodiscard]] bool synchronises(const Engine &engine) const {
    return to_settle_ == 1 && !disturbed_ && EngineEdge::synchronises(engine);
  }
  /// Does that one, with `rx` at the pin.
  template <typename Engine>
  void synchronise(Engine &engine, Level rx) {
    synchronise_(engine, rx);
  }

 private:
  template <typename Engine>
  void clocked_(const Engine &engine) {
    if constexpr (EngineEdge::kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      const auto &root = *engine.rootp;
      disturbed_ = false;
      const bool synchronises =
          root.can_core__DOT__u_bit_timing__DOT__falling != 0 && root.can_core__DOT__tq != 0;
      const bool was_stopped = std::exchange(stopped_, root.can_core__DOT__active_q == 0);
      const bool stops = stopped_ && !was_stopped;
      if (stops || (root.trace_o & (kTraceSample | kTraceBoundary)) != 0)
        to_settle_ = kSettle;
      else if (to_settle_ > 0)
        --to_settle_;
      else if (synchronises)
        to_settle_ = 1;
      if (to_settle_ == 1 && !synchronises &&
          (EngineEdge::quiet_sample(engine) || EngineEdge::only_judges(engine)))
        to_settle_ = 0;
    }
  }

  template <typename Engine>
  void synchronise_(Engine &engine, Level rx) {
    if constexpr (EngineEdge::kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      auto &root = *engine.rootp;
      EnginePlace::count_clocks(root, 1);
      EnginePlace::synchronise(root);
      EngineCount::take_level(root, rx);
      verican_follow(&root);
      clocked_(engine);
    }
  }

  // Edges from the boundary that counting_() goes up to on, to the sample point behind it, if
  // nothing else happens up to there.
  template <typename Engine>
  static std::uint64_t beyond_boundary(const Engine &engine) {
    using Root = std::remove_reference_t<decltype(*engine.rootp)>;
    if constexpr (EngineEdge::kJudges<Root>) {
      const auto &root = *engine.rootp;
      if (root.can_core__DOT__u_bit_timing__DOT__seg2_q == 0 ||
          trace_field(root.trace_o) > Field::kEof || EnginePlace::quanta(root) == 0 ||
          !EngineEdge::keeps_level(root) || EngineEdge::pulses(engine) ||
          (root.run_i & root.can_core__DOT__active_q) == 0 || root.rx_req_i != 0)
        return 0;
      return (root.can_core__DOT__u_bit_timing__DOT__tseg1_q + 2U) * (root.presdiv_i + 1U);
    } else {
      return 0;
    }
  }

  // As edges(), if the level of the pin has got through.
  template <typename Engine>
  [[nodiscard]] std::uint64_t counting_(const Engine &engine) const {
    using Root = std::remove_reference_t<decltype(*engine.rootp)>;
    if constexpr (EngineEdge::kKnown<Root>) {
      const auto &root = *engine.rootp;
      // Bus-off begins a clock after its count.
      if (to_settle_ > 0 ||
          root.can_core__DOT__u_bsp__DOT__u_fault__DOT__boff_seen_q != root.boff_o)
        return 0;
      if (root.can_core__DOT__active_q == 0) return kStopped;
      return EnginePlace::to_tick(root) +
             EnginePlace::quanta(root) * EnginePlace::clocks_of_tq(root);
    } else {
      return 0;
    }
  }

  // As counting_(), while the pin's level has got as far as the first flip-flop of u_sync: the next
  // edge takes it on. A recessive one has no effect before the sample point, a dominant one may
  // synchronise with the next quantum.
  template <typename Engine>
  [[nodiscard]] std::uint64_t while_settling(const Engine &engine) const {
    using Root = std::remove_reference_t<decltype(*engine.rootp)>;
    if constexpr (EngineEdge::kKnown<Root> && !kHasTimeUnit<Engine>) {
      const auto &root = *engine.rootp;
      const unsigned looked_at = root.rx_req_i | root.lpb_i | root.smp_i;
      if (to_settle_ > 0 || looked_at != 0 || root.can_core__DOT__active_q == 0 ||
          root.can_core__DOT__u_sync__DOT__meta_q != root.can_rx_i || !EngineEdge::counts(engine))
        return 0;
      if (root.can_rx_i != 0) return counting_(engine);
      return root.can_core__DOT__tq != 0 ? EnginePlace::clocks_of_tq(root)
                                         : EnginePlace::to_tick(root);
    } else {
      return 0;
    }
  }

  template <typename Engine>
  void pass_(Engine &engine, std::uint64_t edges) {
    if constexpr (EngineEdge::kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      auto &root = *engine.rootp;
      if (!EngineEdge::pin_settled(engine)) {
        clock_lightly_(engine, static_cast<Level>(root.can_rx_i), false);
        if (--edges == 0) return;
      }
      if (root.can_core__DOT__u_bit_timing__DOT__seg2_q != 0) {
        // None before the boundary that shows already, where an earlier pass_() has ended.
        const std::uint64_t before = counting_(engine);
        if (edges > before) {
          if (before != 0) EngineCount::count(engine, before);
          const unsigned pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
          EngineCount::count(engine, 1);
          EngineCount::begin_bit(engine, pos);
          to_settle_ = 0;
          edges -= before + 1;
        }
      }
      const bool judges = root.can_core__DOT__first_q != 0;
      if (edges != 0) EngineCount::count(engine, edges);
      const bool shows =
          root.can_core__DOT__active_q != 0 && root.can_core__DOT__tq != 0 &&
          (root.can_core__DOT__u_bit_timing__DOT__falling != 0 || EnginePlace::quanta(root) == 0);
      if (shows || judges) verican_follow(&root);
      if (shows) clocked_(engine);
    }
  }

  template <typename Engine>
  void clock_lightly_(Engine &engine, Level rx, bool boundary) {
    if constexpr (EngineEdge::kKnown<std::remove_reference_t<decltype(*engine.rootp)>>) {
      auto &root = *engine.rootp;
      const unsigned pos = root.can_core__DOT__u_bit_timing__DOT__pos_q;
      const bool between = !boundary && to_settle_ == 0 && EngineCount::between_quanta(root);
      EngineCount::count(engine, 1);
      if (boundary) EngineCount::begin_bit(engine, pos);
      EngineCount::take_level(root, rx);
      if (between && root.can_core__DOT__tq == 0) return;
      verican_follow(&root);
      clocked_(engine);
    }
  }

  static constexpr std::uint64_t kStopped = ~0ULL >> 1;  // until an input changes
  bool stopped_ = false;
  unsigned to_settle_ = kSettle;  // edges to come that move more
  bool disturbed_ = true;         // inputs have changed since the last edge
};

}  // namespace vericansim
