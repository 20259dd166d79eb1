// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Pacer: holds simulated time to real time and says how far it is behind.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "bus/types.hpp"

namespace vericansim {

/// Simulated and real time run side by side from start() on. Knows no clock: it is told the time.
class Pacer {
 public:
  /// A lag from which on it says so, and below which it has caught up; ns.
  static constexpr WallTime kLagging = 20'000'000;
  static constexpr WallTime kCaughtUp = 2'000'000;
  /// It does not say so again for this time, ns.
  static constexpr WallTime kSayAgain = 10'000'000'000;

  /// From here on both times count.
  void start(WallTime wall, Time simulated) {
    wall_ = wall;
    simulated_ = simulated;
  }
  /// Simulated time that belongs to `wall`, ps.
  [[nodiscard]] Time due(WallTime wall) const { return simulated_ + (wall - wall_) * kNanosecond; }
  /// Real time at which `simulated` is due, rounded up, ns.
  [[nodiscard]] WallTime wall_of(Time simulated) const {
    return wall_ + (simulated - simulated_ + kNanosecond - 1) / kNanosecond;
  }
  /// The simulation has reached `simulated` at `wall`. True if it has just begun to lag, and this
  /// is worth a word.
  bool reached(WallTime wall, Time simulated) {
    lag_ = std::max<WallTime>(0, (due(wall) - simulated) / kNanosecond);
    largest_ = std::max(largest_, lag_);
    if (lag_ < kCaughtUp) lagging_ = false;
    if (lagging_ || lag_ < kLagging) return false;
    lagging_ = true;
    const bool say = !said_ || wall - *said_ >= kSayAgain;
    if (say) said_ = wall;
    return say;
  }

  /// How far simulated time is behind real time, ns; 0 if it is not.
  [[nodiscard]] WallTime lag() const { return lag_; }
  [[nodiscard]] WallTime largest_lag() const { return largest_; }
  [[nodiscard]] bool lagging() const { return lagging_; }

 private:
  WallTime wall_ = 0;
  Time simulated_ = 0;
  WallTime lag_ = 0, largest_ = 0;
  bool lagging_ = false;
  std::optional<WallTime> said_;
};

}  // namespace vericansim
