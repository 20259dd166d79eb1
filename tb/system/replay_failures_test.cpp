// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A recording that does not come through, as a node of a scenario: what is reported, and that no
// node is asked for what it cannot have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "harness/scratch_test.hpp"
#include "session/runner.hpp"

namespace vericansim {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class ReplayFailures : public ScratchTest {
 protected:
  /// Four frames of `boat`, 5 ms between them, at 500 kbit/s and 8 clocks a bit; `node`: more of
  /// its settings, `rest`: other nodes and keys.
  [[nodiscard]] RunReport run(const std::string &node, const std::string &rest) const {
    file_with("boat.log",
              "(1.000) can0 120#01\n(1.005) can0 121#R\n(1.010) can0 122#\n(1.015) can0 123#04\n");
    return run_scenario(
        parse_scenario(in("bus.yaml"), "nodes:\n  - {name: boat, clock: 4 MHz, replay: boat.log" +
                                           node + "}\n  - {name: other, clock: 4 MHz}\n" + rest),
        500e3);
  }
  /// That of the recording.
  static const ReplayResult &replay_of(const RunReport &report) { return report.replays.at(0); }
};

/// Always wins, and leaves no room: one is in its buffer when the other ends.
const char *const kHog =
    "traffic: [{node: other, id: 1, data: FF FF FF FF FF FF FF FF, period: saturated},\n"
    "          {node: other, id: 2, data: FF FF FF FF FF FF FF FF, period: saturated}]\n";

// A million bits (2 s) without a frame of its own.
TEST_F(ReplayFailures, GivesUpWhereOthersHoldTheBus) {
  const RunReport report = run("", kHog);
  EXPECT_FALSE(report.ok());
  EXPECT_THAT(replay_of(report).failure,
              ContainsRegex("^gave up after 2[.]0[0-9]+ s with 0 of 4 frames sent: others hold the "
                            "bus$"));
  EXPECT_THAT(to_text(report), HasSubstr("NO: gave up after 2.0"));
}

// 20,000 bits without any frame (40 ms), looked at every 10 ms: no recovery from bus-off takes as
// long.
TEST_F(ReplayFailures, GivesUpWhereNobodyAnswers) {
  const RunReport report = run("", "faults: [{kind: cut, node: boat}]\n");
  EXPECT_THAT(
      replay_of(report).failure,
      ContainsRegex("^gave up after (4[0-9]|50)[.][0-9]+ ms with 0 of 4 frames sent: nobody "
                    "acknowledges$"));
}

TEST_F(ReplayFailures, GivesUpWhenTheNodeIsBusOff) {
  const RunReport report =
      run(", bus_off_recovery: never", "faults: [{kind: flip, at: {node: boat, field: DLC}}]\n");
  EXPECT_THAT(replay_of(report).failure,
              HasSubstr(" with 0 of 4 frames sent: the node is bus-off"));
}

// A bit error first, then 40 ms of missing acknowledgements.
TEST_F(ReplayFailures, GivesUpAfterErrorsOfSeveralKinds) {
  const RunReport report =
      run("",
          "faults: [{kind: flip, at: {node: boat, frame: 1, field: DLC}}, {kind: cut, node: boat, "
          "from: 50 us}]\n");
  EXPECT_THAT(replay_of(report).failure, ContainsRegex(" with 0 of 4 frames sent: [0-9]+ errors$"));
}

// What makes a reader of the recording doubt is told with the result: a file that is cut.
TEST_F(ReplayFailures, WarningsOfTheRecordingAreTold) {
  file_with("cut.log", "(1.000) can0 120#01\n(1.005) can0 121#0203");
  const RunReport report =
      run_scenario(parse_scenario(in("bus.yaml"),
                                  "nodes:\n  - {name: boat, clock: 4 MHz, replay: cut.log}\n"
                                  "  - {name: other, clock: 4 MHz}\n"),
                   500e3);
  const std::string warning = "line 2 has no line end; its frame may be cut short";
  EXPECT_TRUE(report.ok());
  EXPECT_THAT(to_text(report),
              HasSubstr("    warning: " + replay_of(report).file + ": " + warning));
  EXPECT_EQ(to_json(report)["replays"][0]["warnings"], nlohmann::ordered_json::array({warning}));
}

// The run is over with frames that were due and have not left; the last was not due yet.
TEST_F(ReplayFailures, WhatIsDueMustLeave) {
  const RunReport report = run("", "duration: 12 ms\ndrain: 0\n" + std::string(kHog));
  EXPECT_FALSE(report.ok());
  EXPECT_FALSE(replay_of(report).ok());
  EXPECT_EQ(replay_of(report).failure, "");
  EXPECT_EQ(replay_of(report).late, 3U);
  EXPECT_THAT(to_text(report), HasSubstr("NO: 3 were due and have not left"));
}

// Nothing was due when the run was over, so nothing was shown: with one pass and in a loop.
TEST_F(ReplayFailures, ARunThatEndsBeforeTheFirstFrameFails) {
  for (const char *const loop : {"", ", loop: true"}) {
    const RunReport report = run(std::string(", start: 10 s") + loop, "duration: 50 ms\n");
    EXPECT_FALSE(report.ok()) << loop;
    EXPECT_FALSE(replay_of(report).ok()) << loop;
    EXPECT_EQ(replay_of(report).failure,
              "none of its 4 frames was due: the first is at 10.000 s, and the run was over at "
              "50.000 ms");
    EXPECT_THAT(to_text(report), HasSubstr("NO: none of its 4 frames was due"));
  }
}

// An access to the buffer in which a frame waits: what is on the bus is no frame of the recording.
TEST_F(ReplayFailures, AnotherFrameThanThatOfTheRecordingIsNoticed) {
  const RunReport report =
      run("",
          "traffic: [{node: other, id: 1, data: FF FF FF FF FF FF FF FF}]\n"
          "accesses: [{node: boat, at: 60 us, do: [write MB63.CS 0x08000000, write MB63.DATA0 "
          "0xFF000000, write MB63.CS 0x0C010000]}]\n");
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(replay_of(report).failure, "frame 1 was on the bus as 120#FF, not 120#01");
}

// Nodes without software, with filters or in loop-back do not have every frame.
TEST_F(ReplayFailures, OnlyNodesThatTakeEveryFrameAreAsked) {
  const RunReport report =
      run("",
          "  - {name: bare, software: none}\n  - {name: picky, filters: [{id: 0x7FF}]}\n"
          "  - {name: alone, loop_back: true}\n");
  EXPECT_TRUE(report.ok()) << to_text(report);
  ASSERT_EQ(replay_of(report).receivers.size(), 1U);
  EXPECT_EQ(replay_of(report).receivers[0].node, "other");
  EXPECT_EQ(replay_of(report).receivers[0].received, 4U);  // the remote frame, too
}

// An hour and more is said; days are days.
TEST_F(ReplayFailures, LongGapsAreSaid) {
  const auto said = [&](double hours) {
    file_with("gap.log", fmt::format("(1.0) can0 001#\n({:.0f}.0) can0 002#\n", 1 + hours * 3600));
    return to_text(run_scenario(
        parse_scenario(in("gap.yaml"), "nodes: [{name: boat, replay: gap.log}, {name: other}]\n"),
        500e3));
  };
  EXPECT_THAT(said(1), HasSubstr("no frame for 1.0 hours before frame 2"));
  EXPECT_THAT(said(47), HasSubstr("no frame for 47.0 hours before frame 2"));
  EXPECT_THAT(said(60), HasSubstr("no frame for 2.5 days before frame 2"));
  EXPECT_THAT(said(0.999), ::testing::Not(HasSubstr("no frame for")));
}

// What classical CAN cannot carry is left out, and said; "every frame" counts the others.
TEST_F(ReplayFailures, WhatIsLeftOutIsSaid) {
  const auto said = [&](const std::string &lines) {
    file_with("fd.log", "(1.0) can0 001#\n" + lines);
    return to_text(run_scenario(
        parse_scenario(in("fd.yaml"), "nodes: [{name: boat, replay: fd.log}, {name: other}]\n"),
        500e3));
  };
  EXPECT_THAT(
      said("(1.1) can0 002##011\n(1.2) can0 20000004#0000080000000000\n"),
      HasSubstr("    left out of " + in("fd.log") + ", as no classical frames: 2 entries\n"));
  EXPECT_THAT(said("(1.1) can0 002##011\n"), HasSubstr("frames: 1 entry\n"));
  EXPECT_THAT(said(""), ::testing::Not(HasSubstr("left out")));
}

}  // namespace
}  // namespace vericansim
