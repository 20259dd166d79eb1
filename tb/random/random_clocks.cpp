// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random buses: clocks, bit timings, delays.
#include <algorithm>
#include <cmath>

#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

/// Share of the tolerance of BT-08 that is used, of which the formula itself needs all: what is
/// left is for the quantum in which an edge is seen.
constexpr double kUsed = 0.6;
/// The synchroniser and the quantum: clocks from an edge at the pin until it is known (BT-07).
constexpr double kInputClocks = 3;

/// `quanta` shared out: PHASE_SEG2 a quarter or so, PHASE_SEG1 like it, the rest PROP_SEG.
BitTiming draw_timing(Dice &dice, unsigned quanta) {
  BitTiming timing;
  timing.ps2 =
      std::clamp(static_cast<unsigned>(std::lround(quanta * dice.in_span(0.18, 0.30))), 2U, 8U);
  timing.ps1 = std::clamp(dice.in(timing.ps2 > 2 ? timing.ps2 - 1 : 2, timing.ps2 + 1), 2U, 8U);
  timing.prop = quanta - 1 - std::min(timing.ps1 + timing.ps2, quanta - 2);
  while (timing.prop > 8) {
    --timing.prop;
    ++(timing.ps1 < 8 ? timing.ps1 : timing.ps2);
  }
  const unsigned most = std::min({4U, timing.ps1, timing.ps2});
  timing.sjw = dice.per_cent(70) ? most : dice.in(1, most);
  return timing;
}

/// BT-08, as a part of 1.
double tolerance(const BitTiming &t) {
  const double bit = t.quanta();
  return std::min(std::min(t.ps1, t.ps2) / (2 * (13 * bit - t.ps2)), t.sjw / (20 * bit));
}

/// One clock for everybody: the fastest buses to simulate.
void draw_common(Dice &dice, Scenario &scenario) {
  const unsigned quanta = dice.per_cent(60) ? 8 : dice.in(8, 14);
  BitTiming timing = quanta == 8 ? BitTiming{} : draw_timing(dice, quanta);
  if (dice.per_cent(5)) timing.prescaler = 2;
  for (NodeSpec &node : scenario.nodes) {
    node.timing = timing;
    node.clock.frequency_hz = scenario.bitrates.front() * timing.clocks_per_bit();
  }
}

/// BT-07 for the worst pair: what is left of PROP_SEG for the wire, one way, in bits. Negative: the
/// timings do not go together.
double room_for_delay(const std::vector<BitTiming> &timings) {
  double prop = 1;
  double slowest = 0;
  for (const BitTiming &t : timings) {
    const double bit = t.quanta();
    prop = std::min(prop, t.prop / bit);
    slowest = std::max(slowest, kInputClocks / t.clocks_per_bit());
  }
  return (prop - 2 * slowest) / 2;
}

std::vector<BitTiming> draw_matching_timings(Dice &dice, std::size_t count) {
  for (;;) {
    std::vector<BitTiming> timings;
    const bool alike = dice.per_cent(40);
    for (std::size_t i = 0; i < count; ++i) {
      if (alike && i != 0) {
        timings.push_back(timings[0]);
        continue;
      }
      timings.push_back(draw_timing(dice, dice.per_cent(80) ? dice.in(12, 16) : dice.in(12, 25)));
      if (dice.per_cent(5)) timings.back().prescaler = 2;
    }
    if (room_for_delay(timings) >= 0) return timings;
  }
}

void draw_wander(Dice &dice, ClockConfig &clock, double ppm, Time bit) {
  clock.wander = dice.per_cent(50) ? Wander::kSine : Wander::kWalk;
  clock.wander_ppm = std::floor(ppm);
  clock.wander_period = bit * dice.in(500, 20'000);
}

void draw_own(Dice &dice, Scenario &scenario) {
  const Time bit = bit_time(scenario);
  const auto timings = draw_matching_timings(dice, scenario.nodes.size());
  double least = 1;
  for (const BitTiming &timing : timings) least = std::min(least, tolerance(timing));
  const double ppm = dice.per_cent(50) ? 100 : kUsed * least * 1e6;
  const double room = room_for_delay(timings) * static_cast<double>(bit);
  const bool delays = dice.per_cent(70);
  for (std::size_t i = 0; i < timings.size(); ++i) {
    NodeSpec &node = scenario.nodes[i];
    node.timing = timings[i];
    node.clock.frequency_hz = scenario.bitrates.front() * timings[i].clocks_per_bit();
    const bool wanders = dice.per_cent(30);
    const double constant = wanders ? ppm / 2 : ppm;
    node.clock.error_ppm = std::floor(dice.in_span(-constant, constant));
    if (wanders) draw_wander(dice, node.clock, ppm / 2, bit);
    node.clock.phase = static_cast<Time>(dice.below(static_cast<std::uint64_t>(bit)));
    if (!delays || room < 8) continue;
    // The way from one node to another: transmitter, two cables, receiver.
    const auto part = [&] { return static_cast<Time>(room / 4 * dice.part()); };
    node.link = {.cable = part(), .transmitter = part(), .receiver = part()};
  }
}

}  // namespace

void draw_clocks(Dice &dice, Scenario &scenario) {
  if (dice.per_cent(55)) {
    draw_common(dice, scenario);
  } else {
    draw_own(dice, scenario);
  }
}

}  // namespace vericansim
