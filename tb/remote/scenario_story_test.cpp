// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenarios with remote nodes: their frames in words, states and windows over time (RN-97).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "session/runner.hpp"
#include "simulation/simulation.hpp"
#include "simulation/station.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::UnorderedElementsAre;

constexpr const char *kScenario =
    "duration: 10 ms\n"
    "nodes:\n"
    "  - {name: host}\n"
    "  - {name: pfc, type: remote, number: 3, config: {tell_start: false}, memory: {0x77: 09}}\n"
    "  - {name: dab, type: remote, number: 5, config: {tell_start: false}}\n"
    "commands:\n"
    "  - {node: host, at: 1 ms, do: [write 3 0x20 5A 5B, operate, write all 0x10 11,\n"
    "     trigger 7, frame 12345678#, safe 5, trigger 8]}\n"
    "user: [{node: dab, at: 9 ms, write: {0x30: AB}}]\n";

std::vector<std::string> words_of(const RemoteReport &report) {
  std::vector<std::string> all;
  for (const RemoteFrameReport &frame : report.frames) all.push_back(frame.words);
  return all;
}

// RN-97.
TEST(ScenarioStory, ReportsTellEachFrameInWords) {
  const RunReport report = run_scenario(parse_scenario("s.yaml", kScenario), 500e3);
  EXPECT_THAT(words_of(report.remote),
              ElementsAre("3: write 020 <- 5A 5B", "OPERATE all", "all: write 010 <- 11",
                          MatchesRegex("TRIGGER 7, 2 nodes, skew [0-9]+ ns"), "", "SAFE 5",
                          "TRIGGER 8, 1 node"));
  EXPECT_EQ(report.remote.more_frames, 0U);
  const auto json = to_json(report.remote);
  ASSERT_EQ(json["frames"].size(), 7U);
  EXPECT_EQ(json["frames"][1]["words"], "OPERATE all");
  const Time start = json["frames"][0]["start_ps"];
  EXPECT_GE(start, kMillisecond);
  EXPECT_LT(start, kMillisecond + 100 * kMicrosecond);
  EXPECT_THAT(to_text(report), HasSubstr("ms  3: write 020 <- 5A 5B\n"));
}

// RN-97: the skew in words is that of the summary.
TEST(ScenarioStory, TheSkewIsThatOfTheCycle) {
  const RunReport report = run_scenario(parse_scenario("s.yaml", kScenario), 500e3);
  EXPECT_THAT(
      words_of(report.remote).at(3),
      HasSubstr("skew " + std::to_string((report.remote.skew_longest + 500) / 1000) + " ns"));
}

TEST(ScenarioStory, LongRunsTellTheirFirstFrames) {
  const RunReport report = run_scenario(
      parse_scenario("s.yaml",
                     "duration: 300 ms\nnodes:\n  - {name: host}\n  - {name: pfc, type: remote, "
                     "number: 3, config: {tell_start: false}}\n"
                     "commands: [{node: host, period: 200 us, count: 1200, do: [trigger]}]\n"),
      500e3);
  EXPECT_EQ(report.remote.frames.size(), 1000U);
  EXPECT_EQ(report.remote.more_frames, 200U);
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("TRIGGER 20, 0 nodes\n"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("TRIGGER 21")));
  EXPECT_THAT(text, HasSubstr("and 1180 more frames\n"));
}

/// The story of a run with a page, on its own.
struct Story {
  Scenario scenario = parse_scenario("s.yaml", kScenario);
  Simulation simulation{scenario, 500e3};
  std::vector<double> ends;  // of the frames, ns
  std::unique_ptr<RemoteStory> story;

  Story() {
    const RemoteConfig config = std::get<RemoteRole>(scenario.nodes[1].role).config;
    story = std::make_unique<RemoteStory>(
        simulation.bus(),
        std::vector<WatchedUnit>{{1, simulation.remote(1), config, 3, false},
                                 {2, simulation.remote(2), config, 5, false}},
        true);
    simulation.bus().add(*story);
    simulation.on_bus_frame = [this](const BusFrame &frame) {
      ends.push_back(static_cast<double>(frame.end - simulation.started()) / 1e3);
      story->on_frame(frame);
    };
    for (const NodeId id : {1U, 2U})
      simulation.remote(id)->on_pulse = [this, id](const RemotePulse &) { story->written(id - 1); };
    simulation.join();
    simulation.start(simulation.bus().now());
    story->begin();
    simulation.bus().run_for(scenario.duration);
    simulation.settle();
    story->finish();
  }

  /// Whether a frame did something at this time: from its sixth bit of EOF, where it is valid, to
  /// the next sample point behind its INT2 (RN-45). 2 us a bit.
  [[nodiscard]] bool in_time(double time, std::size_t frame) const {
    return time > ends.at(frame) - 4000 && time < ends.at(frame) + 5000;
  }
};

// RN-97.
TEST(ScenarioStory, PagesHaveTheWindowsOverTime) {
  const Story run;
  const RemoteColumns &columns = run.story->columns();
  ASSERT_EQ(run.ends.size(), 7U);
  using Change = std::tuple<int, int, int>;
  std::vector<Change> changes;
  for (std::size_t i = 0; i < columns.byte.size(); ++i)
    changes.emplace_back(columns.byte_node[i], columns.byte_address[i], columns.byte[i]);
  EXPECT_THAT(changes, UnorderedElementsAre(Change{1, 0x77, 9}, Change{1, 0x20, 0x5A},
                                            Change{1, 0x21, 0x5B}, Change{1, 0x10, 0x11},
                                            Change{2, 0x10, 0x11}, Change{2, 0x30, 0xAB}));
  const std::vector<double> &times = columns.byte_time;
  EXPECT_EQ(times.at(0), 0);
  for (const auto &[change, frame] : {std::pair{1, 0}, {2, 0}, {3, 3}, {4, 3}})
    EXPECT_TRUE(run.in_time(times.at(change), frame)) << change << " at " << times.at(change);
  EXPECT_EQ(times.at(5), 1e7) << "seen at the end: nobody has told of it";
  ASSERT_EQ(columns.units.size(), 2U);
  EXPECT_EQ(columns.units[1].node, 2U);
  EXPECT_EQ(columns.units[1].number, 5U);
  EXPECT_EQ(columns.units[1].window, 0x78U);
}

// RN-97.
TEST(ScenarioStory, PagesHaveTheStates) {
  const Story run;
  const RemoteColumns &columns = run.story->columns();
  std::vector<std::pair<int, int>> states;
  std::vector<double> times;
  for (std::size_t i = 0; i < columns.state.size(); ++i) {
    if (columns.state_time[i] < 5e5) continue;  // they join
    times.push_back(columns.state_time[i]);
    states.emplace_back(columns.state_node[i], columns.state[i]);
  }
  EXPECT_THAT(states, ElementsAre(std::pair{1, 3}, std::pair{2, 3}, std::pair{2, 2}));
  for (const auto &[change, frame] : {std::pair{0, 1}, {1, 1}, {2, 5}})
    EXPECT_TRUE(run.in_time(times.at(change), frame)) << change << " at " << times.at(change);
}

}  // namespace
}  // namespace vericansim
