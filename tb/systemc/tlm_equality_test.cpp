// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Cycle-exact SystemC is the C++ simulator: every clock of each AHB and every change of the wire
// are the same, with drifting clocks, cable, arbitration and errors.
#include <gtest/gtest.h>

#include <ostream>
#include <random>
#include <string>

#include "systemc/both_worlds.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {
namespace {

// Three nodes with frames waiting all the time, and a spoiler that makes errors now and then.
Story story(unsigned frames) {
  Story story;
  const double ppm[] = {120.0, -90.0, 35.0};
  const Time phase[] = {1'000, 41'234, 77'777};
  const unsigned num_mb[] = {64, 32, 16};
  for (unsigned i = 0; i < 3; ++i) {
    ScenarioNode node;
    node.clock = {.error_ppm = ppm[i], .phase = phase[i]};
    node.link = {.cable = cable_delay(3.0 + 9.0 * i), .transmitter = 41'000, .receiver = 63'000};
    node.program = {.frames = frames, .number = i, .seed = 11 + i};
    node.num_mb = num_mb[i];
    story.nodes.push_back(node);
  }
  story.spoiler_clock = {.error_ppm = 7.0, .phase = 5'555};
  std::mt19937 random(4);
  for (std::uint64_t cycle = 40'000; cycle < 40'000'000; cycle += 16'000 + random() % 30'000)
    story.spoils.emplace_back(cycle, 3 + random() % 60);
  story.end = Time{frames} * 3 * 310 * kMicrosecond + 2 * kMillisecond;
  return story;
}

struct Case {
  const char *name;
  unsigned frames;  // of each node
  SystemcVariant variant;
};

void PrintTo(const Case &variant, std::ostream *out) { *out << variant.name; }

class Equality : public ::testing::TestWithParam<Case> {};

TEST_P(Equality, EveryClockOfAhbAndEveryChangeOfTheWireAreTheSame) {
  simulate([] {
    const unsigned frames = GetParam().frames;
    const Story both = story(frames);
    const Seen expected = run_in_simulator(both);
    const Seen found = run_in_systemc(both, GetParam().variant);
    EXPECT_EQ(first_difference(expected, found), "");
    // It was worth comparing: everybody has all frames of the others, and there were errors.
    std::size_t clocks = 0;
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_EQ(found.stats[i].sent, frames);
      EXPECT_EQ(found.received[i].size(), 2 * frames);
      EXPECT_GT(found.stats[i].error_events, 2u);
      clocks += found.ahb[i].size();
    }
    EXPECT_GT(clocks, 130 * frames);
    EXPECT_GT(found.level.size(), 100 * frames);
  });
}

INSTANTIATE_TEST_SUITE_P(Variants, Equality,
                         ::testing::Values(Case{"OwnClocks", 150, {}},
                                           Case{"ClkPorts", 60, {.clk_ports = true}},
                                           Case{"UnderADebugger", 60, {.debugger = true}}),
                         [](const auto &param) { return std::string{param.param.name}; });

// All edges at the same instants and no delay on the bus, but the clocks of the nodes come in
// different delta cycles: an edge still sees what was before the instant.
TEST(EqualityInStep, WhateverTheDeltaCyclesOfTheClocks) {
  simulate([] {
    Story both = story(40);
    for (ScenarioNode &node : both.nodes) {
      node.clock = {.phase = 1000};
      node.link = {};
    }
    both.spoiler_clock = {.phase = 1000};
    const Seen expected = run_in_simulator(both);
    const Seen found = run_in_systemc(both, {.clk_ports = true, .delta_lag = 7});
    EXPECT_EQ(first_difference(expected, found), "");
    EXPECT_EQ(found.received[0].size(), 80u);
  });
}

// The comparison can fail: software that starts one clock late is found out.
TEST(EqualityFails, WhenTheSoftwareIsOneClockLate) {
  simulate([] {
    const Story both = story(3);
    const Seen expected = run_in_simulator(both);
    const Seen found = run_in_systemc(both, {.shifted_start = 1});
    EXPECT_NE(first_difference(expected, found), "");
  });
}

}  // namespace
}  // namespace vericansim
