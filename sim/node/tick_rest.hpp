// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TickRest: sample points that the host side of a node without a processor does not mind.
#pragma once

#include <utility>

#include "node/host_image.hpp"
#include "node/model_edge.hpp"

namespace vericansim {

/// The engine shows such a host side each sample point, for one clock (tick_o), and most of the
/// time all that follows is that it remembers the pulse for a clock (rtl/remote/can_rn_step.sv).
/// When a host side at rest was woken by nothing but such a pulse and two clocks later is bit by
/// bit what it was, with all other outputs of the engine as they were, it will be so at the next
/// pulse, too, as long as nothing else happens to it. Proven in every clock in
/// tb/remote/rtl_rest_test.cpp.
///
/// Needs the name of the pulse in the model; without it (in_force() false) none is ignored.
template <typename Root, typename Ports>
class TickRest {
 public:
  [[nodiscard]] static constexpr bool in_force() { return kKnown<Root>; }

  /// The host side rests and it is known that it does not mind the pulse.
  [[nodiscard]] bool learned() const { return in_force() && state_ == State::kLearned; }
  /// Something else happens to it.
  void forget() {
    if constexpr (in_force()) state_ = State::kNothing;
  }

  /// The pulse is all that `root`, at rest, has not seen of the engine, and it does not mind.
  template <typename Core>
  [[nodiscard]] bool ignores(const Core &core, Root &root) const {
    return learned() && else_unchanged(core, root);
  }

  /// Before an edge that is evaluated, and before `root` sees the engine's outputs; `rests`: it has
  /// rested up to now.
  template <typename Core>
  void begin(const Core &core, Root &root, bool rests) {
    if constexpr (in_force()) {
      const bool only_tick = else_unchanged(core, root);
      if (state_ == State::kPulse && only_tick && core.tick_o == 0) {
        state_ = State::kBehind;
      } else if (rests && only_tick && core.tick_o != 0) {
        before_.take(root);
        state_ = State::kWoken;
      } else {
        state_ = State::kNothing;
      }
    }
  }

  /// Behind that edge.
  template <typename Core>
  void end(const Core &core, const Root &root) {
    if constexpr (in_force()) {
      if (state_ == State::kWoken) {
        state_ = State::kPulse;
      } else if (state_ == State::kBehind) {
        // Data of the engine that mean nothing without a pulse may have changed; which processes
        // have run is not what they have left.
        Ports::to_host(core, before_.root());
        before_.root().__VnbaTriggered = root.__VnbaTriggered;
        state_ = before_.matches(root) ? State::kLearned : State::kNothing;
      }
    }
  }

  /// Shows `root` a pulse that was ignored, for an edge that is evaluated after all.
  static void show(Root &root) {
    if constexpr (in_force()) root.can_remote__DOT__u_core__DOT__tick_o_v = 1;
  }

 private:
  // Woken: the edge that shows the pulse comes. Pulse: it has been. Behind: the one after it comes.
  enum class State { kNothing, kWoken, kPulse, kBehind, kLearned };

  template <typename R>
  static constexpr bool kKnown = !kPlainEdges && requires(R & root) {
    root.can_remote__DOT__u_core__DOT__tick_o_v;
    root.__VnbaTriggered;
  };

  template <typename Core>
  [[nodiscard]] static bool else_unchanged(const Core &core, Root &root) {
    if constexpr (in_force()) {
      auto &shown = root.can_remote__DOT__u_core__DOT__tick_o_v;
      const auto before = std::exchange(shown, core.tick_o);
      const bool changed = Ports::wakes_host(core, root);
      shown = before;
      return !changed;
    } else {
      return false;
    }
  }

  HostImage<Root> before_;
  State state_ = State::kNothing;
};

}  // namespace vericansim
