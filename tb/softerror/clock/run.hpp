// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Flips of flip-flops of the time unit in a scene, and what came of each (TM-141).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "softerror/clock/clock_world.hpp"

namespace vericansim {

/// What happens to which flip-flop, when.
struct ClockFlip {
  unsigned flop = 0;          ///< of FlopNode::flops()
  Time at = 0;                ///< bus time, ps
  std::optional<bool> stuck;  ///< at this level from then on
};

/// What it takes until the unit works.
enum class ClockCure : std::uint8_t {
  kNone,
  kRewrite,    ///< registers written anew, ClockWorld::rewrite()
  kSetUp,      ///< soft reset, and everything anew
  kHardReset,  ///< nothing that software can do helps
  kNever,      ///< not even that: the test bench is wrong
};

/// What was seen behind a flip; plain data, for it crosses a process boundary.
struct ClockOutcome {
  bool finished = false;
  bool gone = false;     ///< core and driver are what they would be without the flip
  bool seen = false;     ///< the CPU read, or was told, something else
  bool hangs = false;    ///< an access does not end
  bool babbled = false;  ///< dominant for longer than any rule allows
  ClockCure cure = ClockCure::kNone;
  char fails[12] = {};  ///< what did not work before the cure
  // Scene time.
  bool wrong = false;   ///< TIME was wrong by more than three clocks
  bool told = false;    ///< and the servo said so
  bool locked = true;   ///< at the end
  unsigned pairs = 0;   ///< that came until it was right again, for good
  double worst_ns = 0;  ///< largest error
  // Scene launch.
  bool lost = false;    ///< the frame was not sent within 2.2 s of a right increment
  double early_ms = 0;  ///< it began to be sent before it should have
  double late_ms = 0;   ///< or behind
};

/// Pairs until TIME is right again, at most: three that agree, and a filter's length (TM-141).
inline constexpr unsigned kMostPairs = 3 + 8;

/// Bus times within which flips may lie: two intervals of the locked node, or two launches.
struct FlipWindow {
  Time begin, period;  ///< two periods from begin on
  Time busy;           ///< within a period: frames are on the bus, or a launch is under way
};
[[nodiscard]] FlipWindow window_of(ClockScene scene);

/// Flip-flops of the time unit, numbers of FlopNode::flops().
[[nodiscard]] std::vector<unsigned> unit_flops();

/// What came of them, in their order; each in a process of its own, `jobs` at a time. They must be
/// in the order of time. std::runtime_error if the scene is not right without a flip.
[[nodiscard]] std::vector<ClockOutcome> run_flips(ClockScene scene,
                                                  const std::vector<ClockFlip> &flips,
                                                  unsigned jobs);

}  // namespace vericansim
