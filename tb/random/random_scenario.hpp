// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random buses: from a seed to a scenario with judges.
#pragma once

#include <cstdint>

#include "random/dice.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// How much a random bus is disturbed.
enum class NoiseLevel : std::uint8_t { kNone, kLight, kNoisy, kStorm };

/// A bus of 2 to 16 nodes with everything random: clocks within the tolerance of BT-08, delays
/// within BT-07, timings that agree on the bit rate, buffers, filters, traffic, register accesses,
/// disturbances. A function of its arguments alone. `frames`: length of the run, in
/// frames of a busy bus of middle size; small buses get more of them, large or idle ones fewer.
[[nodiscard]] Scenario random_scenario(std::uint64_t seed, unsigned frames);

/// What random_scenario() has drawn for a seed.
[[nodiscard]] NoiseLevel noise_level(std::uint64_t seed);

// ---- Parts, each in a file of its own

/// Clocks, timings and delays for nodes that exist.
void draw_clocks(Dice &dice, Scenario &scenario);
/// Filters, buffers and messages of the nodes with software.
void draw_traffic(Dice &dice, Scenario &scenario, unsigned frames);
/// The whole life of the nodes without software, and reads at all the others.
void draw_accesses(Dice &dice, Scenario &scenario);
void draw_faults(Dice &dice, Scenario &scenario, NoiseLevel level);

/// Length of a bit, ps.
[[nodiscard]] Time bit_time(const Scenario &scenario);
/// An identifier that only this node sends.
[[nodiscard]] std::uint32_t draw_identifier(Dice &dice, NodeId node, bool extended);

}  // namespace vericansim
