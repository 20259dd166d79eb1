// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Recordings as nodes of a scenario, beside other nodes (docs/scenario.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "harness/scratch_test.hpp"
#include "session/runner.hpp"
#include "trace/log.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

// 120 is sent at 0, 10 and 20 ms, the extended frame at 5 ms.
constexpr const char *kLog =
    "(100.000000) can0 120#01\n(100.005000) can1 00000120#0203\n(100.010000) can0 120#04\n"
    "(100.020000) can0 120#05\n";

/// A log and a scenario beside it.
class ReplayNodes : public ScratchTest {
 protected:
  void SetUp() override { file_with("boat.log", kLog); }

  [[nodiscard]] Scenario scenario(const std::string &node, const std::string &rest = "") const {
    return parse_scenario(in("bus.yaml"), "nodes:\n  - {name: boat, replay: boat.log" + node +
                                              "}\n  - {name: other}\n" + rest);
  }
  /// Runs it and reads what was on the bus.
  RunReport run(const std::string &node, const std::string &rest = "") {
    Scenario wanted = scenario(node, rest);
    wanted.outputs.candump = in("out.log");
    const RunReport report = run_scenario(wanted, 500e3);
    seen_ = read_log(wanted.outputs.candump).entries;
    return report;
  }
  /// Distance of two frames on the bus in milliseconds, to 0.05 ms.
  [[nodiscard]] double distance(std::size_t from, std::size_t to) const {
    return static_cast<double>(seen_.at(to).time - seen_.at(from).time) / kMillisecond;
  }

  std::vector<LogEntry> seen_;
};

TEST_F(ReplayNodes, SendsTheRecordingAtItsTimesAndEndsWithIt) {
  const RunReport report = run("");
  EXPECT_TRUE(report.ok()) << to_text(report);
  ASSERT_EQ(seen_.size(), 4U);
  EXPECT_NEAR(distance(0, 1), 5, 0.05);
  EXPECT_NEAR(distance(0, 3), 20, 0.05);
  EXPECT_TRUE(seen_.at(1).frame.extended);
  EXPECT_EQ(seen_.at(1).frame.id, 0x120U);
  EXPECT_LT(report.duration, 21 * kMillisecond);
  ASSERT_EQ(report.replays.size(), 1U);
  EXPECT_EQ(report.replays.at(0).sent, 4U);
  EXPECT_EQ(report.replays.at(0).receivers.at(0).received, 4U);
}

TEST_F(ReplayNodes, StartAndRate) {
  const RunReport report = run(", start: 7 ms, rate: 2.0");
  EXPECT_TRUE(report.ok()) << to_text(report);
  EXPECT_NEAR(distance(0, 3), 10, 0.05);
  EXPECT_GE(report.duration, 17 * kMillisecond);
  EXPECT_LT(report.duration, 18 * kMillisecond);
}

TEST_F(ReplayNodes, AsFastAsTheBusAllows) {
  EXPECT_TRUE(run(", rate: saturated").ok());
  // Each is shorter than 0.2 ms, three bits lie between them.
  EXPECT_LT(distance(0, 3), 0.7);
}

TEST_F(ReplayNodes, ChoosesFrames) {
  const auto data = [this] {
    std::vector<unsigned> first;
    for (const LogEntry &entry : seen_) first.push_back(entry.frame.data[0]);
    return first;
  };
  EXPECT_TRUE(run(", filter: '120:80000FFF'").ok());
  EXPECT_THAT(data(), ::testing::ElementsAre(1, 4, 5));
  EXPECT_TRUE(run(", filter: [00000120:9FFFFFFF]").ok());
  EXPECT_THAT(data(), ::testing::ElementsAre(2));
  EXPECT_TRUE(run(", from: 5 ms, to: 10 ms").ok());
  EXPECT_THAT(data(), ::testing::ElementsAre(2, 4));
  EXPECT_TRUE(run(", channel: can1").ok());
  EXPECT_THAT(data(), ::testing::ElementsAre(2));
  EXPECT_TRUE(run(", frames: 3").ok());
  EXPECT_THAT(data(), ::testing::ElementsAre(1, 2, 4));
}

// A pass begins a mean distance (20 ms / 3) after the end of the one before: at 26.67 ms, 53.33 ms.
TEST_F(ReplayNodes, Loops) {
  const RunReport report = run(", loop: true", "duration: 60 ms\n");
  EXPECT_TRUE(report.ok()) << to_text(report);
  ASSERT_EQ(seen_.size(), 10U);  // the third pass has sent at 53.33 and 58.33 ms
  EXPECT_NEAR(distance(0, 4), 26.667, 0.05);
  EXPECT_EQ(report.replays.at(0).frames, 10U);
}

TEST_F(ReplayNodes, DurationEndsItEarly) {
  const RunReport report = run("", "duration: 12 ms\n");
  EXPECT_EQ(seen_.size(), 3U);
  EXPECT_TRUE(report.ok()) << to_text(report);
}

// Shares of the identifiers: each frame once, from one of the nodes.
TEST_F(ReplayNodes, SharesAreDisjointAndWhole) {
  const RunReport report =
      run(", share: 1/2", "  - {name: second, replay: boat.log, share: 2/2}\n");
  EXPECT_TRUE(report.ok()) << to_text(report);
  EXPECT_EQ(seen_.size(), 4U);
  EXPECT_EQ(report.replays.at(0).sent + report.replays.at(1).sent, 4U);
}

// A share in which no frame falls is well only where other nodes send the recording.
TEST_F(ReplayNodes, AShareWithoutAFrameNeedsAnother) {
  file_with("boat.log", "(100.000000) can0 123#01\n");
  const std::string empty = ", share: 1/2";
  const auto alone = [&](const std::string &rest) {
    return to_text(run_scenario(scenario(empty, rest), 500e3));
  };
  EXPECT_THAT(alone(""), HasSubstr("boat.log is of share 1/2, and no other node sends"));
  const std::string second = "  - {name: second, replay: boat.log, share: ";
  EXPECT_THAT(alone(second + "1/2}\n"), HasSubstr("NO: no frame of "));
  const RunReport whole = run(empty, second + "2/2}\n");
  EXPECT_TRUE(whole.ok()) << to_text(whole);
  EXPECT_EQ(seen_.size(), 1U);
  EXPECT_THAT(to_text(whole), HasSubstr("  nothing to send: no frame is of its share\n"));
}

// The traffic of others, an error in the third frame: all arrive all the same.
TEST_F(ReplayNodes, AmongTrafficAndFaults) {
  const RunReport report =
      run("",
          "traffic: [{node: other, id: 0x055, data: counter, period: 1 ms}]\n"
          "faults: [{kind: flip, at: {node: boat, frame: 3, field: CRC, bit: 2}}]\n"
          "expect: {error_frames: 1, complete: true, nodes: {boat: {sent: 4}}}\n");
  EXPECT_TRUE(report.ok()) << to_text(report);
  EXPECT_EQ(report.replays.at(0).sent, 4U);
}

// A node that is cut off lacks a frame, and that fails the run without any expectation.
TEST_F(ReplayNodes, AMissingFrameFails) {
  const RunReport report =
      run("", "  - {name: third}\nfaults: [{kind: cut, node: third, from: 9 ms, for: 2 ms}]\n");
  EXPECT_FALSE(report.ok());
  const auto &receivers = report.replays.at(0).receivers;
  ASSERT_EQ(receivers.size(), 2U);
  EXPECT_EQ(receivers.at(0).first_difference, "");
  EXPECT_EQ(receivers.at(1).received, 2U);
  EXPECT_EQ(receivers.at(1).first_difference, "frame 3 of boat has not come: 120#04");
}

TEST_F(ReplayNodes, NothingToSendFails) {
  const RunReport report = run_scenario(scenario(", filter: '7FF:7FF'"), 500e3);
  EXPECT_FALSE(report.ok());
  EXPECT_THAT(to_text(report), HasSubstr("none of the 4 frames"));
}

TEST_F(ReplayNodes, BadSettingsAreRefused) {
  const auto refused = [this](const std::string &node, const std::string &rest,
                              const std::string &what) {
    EXPECT_THAT(input_error_of([&] { return scenario(node, rest); }), HasSubstr(what))
        << node << rest;
  };
  refused(", rate: 0", "", "rate: '0' is not allowed");
  for (const std::string share : {"3/2", "0/2", "1/65", "2"})
    refused(", share: " + share, "",
            "share: '" + share + "' is not allowed; allowed: a part of 1 to 64");
  refused(", filter: 12G:7", "", "'12G:7' is not allowed; allowed: ID:MASK");
  refused(", from: 5 ms, to: 4 ms", "", "to: '4 ms' is not allowed");
  refused(", loop: true", "", "needs a 'duration'");
  refused(", software: none", "", "unknown key 'software'");
  refused(", firmware: a.elf", "", "a node is of one kind");
  refused("", "traffic: [{node: boat, id: 1}]\n", "a node with 'replay' sends of its own");
  refused("", "end: soon\n", "'soon' is not allowed; allowed: time, done");
  refused("", "end: time\n", "needs a 'duration'");
  refused("", "pacing: slow\n", "'slow' is not allowed; allowed: real_time, fast");
  refused("", "  - {name: pc, interface: vcan0, echo: 3}\n", "echo: '3' is not allowed");
  const Scenario none = parse_scenario("x.yaml", "nodes: [{name: a, replay: no_such.log}]\n");
  EXPECT_THAT(input_error_of([&] { return run_scenario(none, 5e5); }),
              HasSubstr("no_such.log: no such file"));
}

// A program of the caller's own has no CAN interfaces unless it is given a factory.
TEST_F(ReplayNodes, InterfacesNeedAFactory) {
  EXPECT_THAT(input_error_of([&] { return run("", "  - {name: pc, interface: vcan0}\n"); }),
              HasSubstr("node 'pc': this program cannot make a node with "
                        "'interface'"));
}

}  // namespace
}  // namespace vericansim
