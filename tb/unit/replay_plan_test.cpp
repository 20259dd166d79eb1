// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayPlan: which frames of a recording are sent, and when (docs/scenario.md). Times worked out
// by hand.
#include "session/replay_plan.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <set>

#include "harness/input_error_of.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

/// A role that takes its frames from `text`.
ReplayRole role_of(const std::string &text) {
  ReplayRole role;
  role.file = "a.log";
  role.log = std::make_shared<const CanLog>(parse_candump(text, "a.log"));
  return role;
}

/// Frames at 0, 5, 10 and 20 ms.
ReplayRole boat() {
  return role_of("(1.000) can0 100#\n(1.005) can0 101#\n(1.010) can0 102#\n(1.020) can0 103#\n");
}

/// When its frames are due, in microseconds.
std::vector<Time> due(const ReplayRole &role) {
  std::vector<Time> times;
  for (const PlannedFrame &frame : make_plan(role).frames)
    times.push_back(frame.due / kMicrosecond);
  return times;
}

// What is at `from` in the log comes at `start`, at any rate.
TEST(ReplayPlan, TimesOfTheFrames) {
  ReplayRole role = boat();
  EXPECT_THAT(due(role), ElementsAre(0, 5'000, 10'000, 20'000));
  role.start = 7 * kMillisecond;
  EXPECT_THAT(due(role), ElementsAre(7'000, 12'000, 17'000, 27'000));
  role.from = 4 * kMillisecond;
  EXPECT_THAT(due(role), ElementsAre(8'000, 13'000, 23'000));
  role.rate = 2;
  EXPECT_THAT(due(role), ElementsAre(7'500, 10'000, 15'000));
  role.rate = 0.5;
  EXPECT_THAT(due(role), ElementsAre(9'000, 19'000, 39'000));
  role.saturated = true;
  EXPECT_THAT(due(role), ElementsAre(7'000, 7'000, 7'000));
}

// A recorder's clock may be set back: no frame is left out, those from before the first are due
// with it, and the order is that of the log.
TEST(ReplayPlan, FramesFromBeforeTheFirstAreSentToo) {
  const ReplayRole role = role_of("(9.000) can0 100#\n(9.005) can0 101#\n(1.000) can0 102#\n");
  EXPECT_THAT(due(role), ElementsAre(0, 5'000, 0));
  EXPECT_EQ(make_plan(role).frames.back().frame.id, 0x102U);
  EXPECT_EQ(make_plan(role).recorded, 5 * kMillisecond);
}

TEST(ReplayPlan, BothEndsOfAPartBelongToIt) {
  ReplayRole role = boat();
  role.from = 5 * kMillisecond;
  role.to = 10 * kMillisecond;
  EXPECT_EQ(make_plan(role).frames.size(), 2U);
  EXPECT_EQ(make_plan(role).recorded, 5 * kMillisecond);
}

// 80,000 s at a thousandth of the speed are 926 days.
TEST(ReplayPlan, MoreThan90DaysAreRefused) {
  ReplayRole role = role_of("(1.0) can0 100#\n(80001.0) can0 101#\n");
  EXPECT_EQ(due(role).back(), 80'000'000'000);
  role.rate = 0.001;
  EXPECT_EQ(input_error_of([&] { return make_plan(role); }),
            "a.log: a frame is 80000000 s after the first; allowed: 90 days");
}

// The first of the longest; what lies before the first frame that is sent is none.
TEST(ReplayPlan, TheLongestGap) {
  ReplayRole role = boat();
  EXPECT_EQ(make_plan(role).longest_gap, 10 * kMillisecond);
  EXPECT_EQ(make_plan(role).after_gap, 4U);
  role.to = 10 * kMillisecond;
  EXPECT_EQ(make_plan(role).longest_gap, 5 * kMillisecond);
  EXPECT_EQ(make_plan(role).after_gap, 2U);
  role.from = role.to;
  EXPECT_EQ(make_plan(role).longest_gap, 0);
}

// Frames whose times go back are sent at once: the way back to the times before is no pause.
TEST(ReplayPlan, AStepBackMakesNoGap) {
  const ReplayRole role = role_of(
      "(100.000) can0 100#\n(100.005) can0 101#\n(7.000) can0 102#\n(7.020) can0 103#\n"
      "(100.008) can0 104#\n");
  EXPECT_EQ(make_plan(role).longest_gap, 5 * kMillisecond);
  EXPECT_EQ(make_plan(role).after_gap, 2U);
}

// A pass is as long as the recording and a mean distance; a millisecond where there is none.
TEST(ReplayPlan, LengthOfAPass) {
  EXPECT_EQ(make_plan(boat()).pass, 20 * kMillisecond + 20 * kMillisecond / 3);
  EXPECT_EQ(make_plan(role_of("(1.0) can0 100#\n")).pass, kMillisecond);
  EXPECT_EQ(make_plan(role_of("(1.0) can0 100#\n(1.0) can0 101#\n")).pass, kMillisecond);
}

TEST(ReplayPlan, SaysWhyThereIsNothingToSend) {
  EXPECT_EQ(make_plan(boat()).nothing, "");
  EXPECT_EQ(make_plan(role_of("")).nothing, "a.log holds no classical CAN frame");
  EXPECT_EQ(make_plan(role_of("(1.0) can0 100##1AA\n")).nothing,
            "a.log holds no classical CAN frame (1 entries are none)");
  ReplayRole role = boat();
  role.from = kSecond;
  EXPECT_EQ(make_plan(role).nothing,
            "none of the 4 frames of a.log is chosen by the settings of the node");
}

// Identifiers that follow each other come to different nodes, and none is left out.
TEST(ReplayPlan, SharesAreOfAboutEqualSize) {
  for (const bool extended : {false, true}) {
    std::vector<unsigned> sizes(64);
    for (std::uint32_t id = 0; id < 0x800; ++id) ++sizes.at(share_of({id, extended}, 64));
    for (const unsigned size : sizes) EXPECT_NEAR(size, 0x800 / 64, 8);
  }
}

}  // namespace
}  // namespace vericansim
