// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Times and levels of the simulator and of SystemC; and what a level was before the present
// instant.
#pragma once

#include <cstdint>
#include <systemc>

#include "bus/types.hpp"

namespace vericansim {

/// SystemC's time as the simulator's. The time resolution must be SystemC's default, 1 ps, which
/// check_time_resolution() enforces.
inline Time to_ps(const sc_core::sc_time &time) { return static_cast<Time>(time.value()); }
/// The simulator's time, not negative, as SystemC's.
inline sc_core::sc_time to_sc_time(Time ps) {
  return sc_core::sc_time::from_value(static_cast<std::uint64_t>(ps));
}
/// Reports a fatal error if the time resolution is not 1 ps.
void check_time_resolution();

/// A pin is a bool: true is recessive.
constexpr bool to_bool(Level level) { return level == Level::kRecessive; }
constexpr Level to_level(bool pin) { return pin ? Level::kRecessive : Level::kDominant; }

/// Follows a signal and knows what it was strictly before the present instant, so that processes
/// that run at the same instant have no races, whatever delta cycle they are in.
class Settled {
 public:
  explicit Settled(bool value) : value_{value}, before_{value} {}

  /// The signal is `value` now. Call it at every change, and before before().
  void update(bool value) {
    if (value == value_) return;
    if (changed_ != sc_core::sc_time_stamp()) {
      changed_ = sc_core::sc_time_stamp();
      before_ = value_;
    }
    value_ = value;
  }
  [[nodiscard]] bool now() const { return value_; }
  [[nodiscard]] bool before() const {
    return changed_ == sc_core::sc_time_stamp() ? before_ : value_;
  }

 private:
  bool value_;
  bool before_;
  sc_core::sc_time changed_;
};

}  // namespace vericansim
