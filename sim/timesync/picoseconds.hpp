// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulated time of this folder as that of the simulator.
#pragma once

#include <algorithm>
#include <cmath>

#include "bus/types.hpp"
#include "timesync/oscillator.hpp"

namespace vericansim {

/// To the nearest; beyond 104 days it saturates.
[[nodiscard]] inline Time to_picoseconds(Nanoseconds ns) {
  constexpr Nanoseconds kMost = 9e18L;
  return static_cast<Time>(std::llround(std::clamp(ns * 1e3L, -kMost, kMost)));
}

}  // namespace vericansim
