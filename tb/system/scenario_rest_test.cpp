// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The examples on a bus whose nodes may rest (Bus::let_rest()) and on one that clocks them every
// time: the same levels, bits, report, log, registers and memories.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "harness/bus_trail.hpp"
#include "node/model_edge.hpp"
#include "session/session.hpp"

namespace vericansim {
namespace {

struct Outcome {
  Trail trail;
  std::string report, log;
  std::uint64_t edges_passed = 0;
};

// Every word of the registers and buffers of a core, every byte of a remote node's memory.
void look(Simulation &simulation, NodeId id, Trail &trail) {
  constexpr std::uint32_t kCoreBytes = 0x980;
  constexpr unsigned kRemoteBytes = 0x1000;
  trail.push_back(fmt::format("node {} {:X}", id, simulation.bus().node(id).trace()));
  if (const RemoteUnit *remote = simulation.remote(id)) {
    for (unsigned at = 0; at < kRemoteBytes; ++at)
      trail.push_back(fmt::format("{} {:X} {:X}", id, at, remote->peek(at)));
    return;
  }
  RtlNode &core = simulation.node(id);
  trail.push_back(fmt::format("cycles {} irq {:X}", core.cycles(), core.irq_lines()));
  for (std::uint32_t at = 0; at < kCoreBytes; at += 4) {
    const AhbResult word = core.peek({.address = at});
    trail.push_back(fmt::format("{} {:X} {:X} {}", id, at, word.data, word.error));
  }
}

// What the wall clock says is another matter.
std::string report_text(const RunReport &report) {
  nlohmann::ordered_json json = to_json(report);
  json.erase("wall_seconds");
  return json.dump(1);
}

Outcome run(Scenario scenario, double bitrate, bool rest) {
  scenario.outputs.candump = ::testing::TempDir() + fmt::format("scenario_rest_{}.log", ::getpid());
  const std::string log = scenario.outputs.candump;
  Outcome result;
  {
    TrailRecorder recorder{result.trail};
    Session session{{{std::move(scenario), bitrate}}};
    Simulation &simulation = session.simulation();
    simulation.bus().let_rest(rest);
    simulation.bus().add(recorder);
    result.report = report_text(session.run().front());
    for (NodeId id = 0; id < simulation.bus().size(); ++id) look(simulation, id, result.trail);
    result.edges_passed = simulation.bus().edges_passed();
  }
  std::ostringstream text;
  text << std::ifstream{log}.rdbuf();
  result.log = text.str();
  return result;
}

class ScenarioRest : public ::testing::TestWithParam<const char *> {};

TEST_P(ScenarioRest, ChangesNothing) {
  Scenario scenario = read_scenario(std::string{"examples/"} + GetParam());
  scenario.duration = std::min(scenario.duration, 30 * kMillisecond);
  for (const double bitrate : scenario.bitrates) {
    const Outcome resting = run(scenario, bitrate, true), clocked = run(scenario, bitrate, false);
    EXPECT_TRUE(kPlainEdges || resting.edges_passed > 100) << bitrate;
    EXPECT_EQ(clocked.edges_passed, 0U) << bitrate;
    ASSERT_GT(clocked.trail.size(), 1000U) << bitrate;
    EXPECT_EQ(first_difference(resting.trail, clocked.trail), "") << bitrate;
    EXPECT_EQ(resting.report, clocked.report) << bitrate;
    EXPECT_FALSE(clocked.log.empty()) << bitrate;
    EXPECT_EQ(resting.log, clocked.log) << bitrate;
  }
}

// With faults on the bus every edge is clocked: those two rest until all nodes have joined.
INSTANTIATE_TEST_SUITE_P(Examples, ScenarioRest,
                         ::testing::Values("two-nodes.yaml", "arbitration.yaml",
                                           "sixteen-nodes.yaml", "sae-class-c.yaml", "signals.yaml",
                                           "bridge.yaml", "remote/cabinet.yaml", "faults.yaml",
                                           "retry.yaml"));

}  // namespace
}  // namespace vericansim
