// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A flip of a follower's flip-flop while it is locked, and what came of it (TM-141).
#pragma once

#include <cstdint>

#include "softerror/flop_places.hpp"

namespace vericansim {

/// What was seen behind the flip.
struct FollowerOutcome {
  /// Pairs until its time is right, for the rest of the run. 0: it has never been wrong when a pair
  /// came.
  unsigned pairs = 0;
  bool hangs = false;        ///< at the end it was not, or the node was not locked
  bool babbled = false;      ///< dominant for longer than any rule allows
  bool lost_pulses = false;  ///< the pin did not pulse with the master, at the end
  double worst_ns = 0;       ///< largest error of TIME when a pair came
};

/// Clocks within which flips shall lie: two intervals in which the node is locked.
inline constexpr std::uint64_t kFlipFrom = 16 * 80'000, kFlipTo = 18 * 80'000;

/// All flip-flops of the node.
[[nodiscard]] const FlopPlaces &follower_flops();

/// Without a flip (flip.clock behind the end) nothing may be wrong.
[[nodiscard]] FollowerOutcome run_flip(const FlopFlip &flip);

}  // namespace vericansim
