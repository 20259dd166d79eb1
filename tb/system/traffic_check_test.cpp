// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Traffic that can never be sent: what is refused, and that nothing is refused that may be sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/input_error_of.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// What is said against a scenario; "no error" if nothing.
std::string refusal(const std::string &text) {
  return input_error_of([&] {
    const Simulation simulation{parse_scenario("s.yaml", text), 500e3};
    return 0;
  });
}

TEST(TrafficCheck, NodesThatOnlyListenSendNothing) {
  for (const std::string key : {"monitor", "listen_only"})
    EXPECT_EQ(refusal("nodes: [{name: a}, {name: ear, " + key +
                      ": true}]\ntraffic:\n  - {node: a, id: 1}\n  - {node: ear, id: 2}\n"),
              "s.yaml:4: traffic[1]: '002' can never be sent: node 'ear' only listens; allowed: "
              "nodes without 'listen_only' and 'monitor'");
}

TEST(TrafficCheck, NodesInLoopBackSendNothingToTheBus) {
  const std::string bus =
      "nodes: [{name: a}, {name: b}, {name: self, loop_back: true}]\n"
      "traffic: [{node: self, id: 2}]\n";
  EXPECT_EQ(refusal(bus),
            "s.yaml:2: traffic[0]: '002' can never be sent: node 'self' sends to itself alone; "
            "allowed: nodes without 'loop_back'");
  EXPECT_EQ(refusal(bus + "accesses: [{node: self, do: clear CTRL1 0x1000}]\n"), "no error");
}

// Software that the scenario plays may take the node out of this mode.
TEST(TrafficCheck, AccessesMayLetAListenerSend) {
  EXPECT_EQ(refusal("nodes: [{name: a}, {name: ear, listen_only: true}]\n"
                    "traffic: [{node: ear, id: 2}]\n"
                    "accesses: [{node: ear, do: clear CTRL1 0x8}]\n"),
            "no error");
}

TEST(TrafficCheck, MessagesBeginBeforeTheEnd) {
  const std::string bus = "nodes: [{name: a}, {name: b}]\nduration: 20 ms\n";
  EXPECT_EQ(refusal(bus + "traffic:\n  - {node: a, id: 1, name: late, offset: 20 ms}\n"),
            "s.yaml:4: traffic[0]: 'late' can never be sent: it begins at 20 ms, and nothing is "
            "queued from 20 ms on; allowed: 'offset' below the duration, 20 ms");
  EXPECT_THAT(refusal(bus + "traffic: [{node: a, id: 1, period: 1 ms, offset: 25 ms}]\n"),
              HasSubstr("it begins at 25 ms"));
  EXPECT_EQ(refusal(bus + "traffic: [{node: a, id: 1, offset: 19.999 ms}]\n"), "no error");
  EXPECT_EQ(refusal(bus + "traffic: [{node: a, id: 1, period: 1 s, offset: random}]\n"),
            "no error");
}

// A user may look at the beginning of a scenario alone.
TEST(TrafficCheck, AShorterRunIsNoMistake) {
  Scenario scenario = parse_scenario(
      "s.yaml", "nodes: [{name: a}, {name: b}]\ntraffic: [{node: a, id: 1, offset: 25 ms}]\n");
  scenario.duration = 20 * kMillisecond;
  const auto said = [&] {
    return input_error_of([&] {
      const Simulation simulation{scenario, 500e3};
      return 0;
    });
  };
  EXPECT_THAT(said(), HasSubstr("can never be sent"));
  scenario.cut_short = true;
  EXPECT_EQ(said(), "no error");
}

}  // namespace
}  // namespace vericansim
