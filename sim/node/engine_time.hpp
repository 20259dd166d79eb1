// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a node asks of an engine's time unit, of engines without one, too.
#pragma once

#include <cstdint>

#include "node/time_flops.hpp"
#include "verican/verican_regs.h"

namespace vericansim {

/// Whether an engine has the time unit (TimedEngine).
template <typename Engine>
inline constexpr bool kHasTimeUnit = requires(const Engine &engine) {
  engine.edges_of_time();
};

/// Edges to come in which the time unit only counts, as long as no input of the engine and no level
/// changes. A unit that is not there always does.
template <typename Engine>
[[nodiscard]] std::uint64_t edges_of_time(const Engine &engine) {
  if constexpr (kHasTimeUnit<Engine>) return engine.edges_of_time();
  return TimeFlops::kForever;
}

/// `edges` of them have passed, with the levels that the engine shows now.
template <typename Engine>
void pass_time([[maybe_unused]] Engine &engine, [[maybe_unused]] std::uint64_t edges) {
  if constexpr (kHasTimeUnit<Engine>) engine.pass_time(edges);
}

/// `time_out_o` of a whole core around `engine`, which is that of two of its flip-flops (TM-31).
template <typename Engine>
[[nodiscard]] bool time_out_of(const Engine &engine) {
  constexpr unsigned kStatOut = 1U << 2;  // can_pkg::TimeStatOut
  return (engine.time_stat_o & kStatOut) != 0 &&
         (engine.time_tctrl_i & VERICAN_TCTRL_OUTEN_MASK) != 0;
}

}  // namespace vericansim
