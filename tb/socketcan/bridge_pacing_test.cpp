// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge and real time: pacing, lag, waiting instead of spinning, signals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "node/model_edge.hpp"
#include "socketcan/bridge_rig.hpp"

namespace vericansim::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::SizeIs;

constexpr WallTime kMs = 1'000'000;  // ns
constexpr Frame kFrame{.id = 0x123, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};

// ---- Pacer

TEST(Pacer, TimesRunSideBySide) {
  Pacer pacer;
  pacer.start(5 * kMs, 2 * kMillisecond);
  EXPECT_EQ(pacer.due(5 * kMs), 2 * kMillisecond);
  EXPECT_EQ(pacer.due(8 * kMs), 5 * kMillisecond);
  EXPECT_EQ(pacer.wall_of(5 * kMillisecond), 8 * kMs);
  EXPECT_EQ(pacer.wall_of(5 * kMillisecond + 1), 8 * kMs + 1);  // not a moment too early
}

TEST(Pacer, SaysOnceThatItLags) {
  Pacer pacer;
  pacer.start(0, 0);
  EXPECT_FALSE(pacer.reached(10 * kMs, 10 * kMillisecond));
  EXPECT_EQ(pacer.lag(), 0);
  EXPECT_FALSE(pacer.reached(25 * kMs, 20 * kMillisecond));
  EXPECT_EQ(pacer.lag(), 5 * kMs);
  EXPECT_TRUE(pacer.reached(50 * kMs, 30 * kMillisecond));
  EXPECT_FALSE(pacer.reached(80 * kMs, 40 * kMillisecond));  // said
  EXPECT_TRUE(pacer.lagging());
  EXPECT_FALSE(pacer.reached(80 * kMs, 79 * kMillisecond));  // has caught up
  EXPECT_FALSE(pacer.lagging());
  EXPECT_FALSE(pacer.reached(110 * kMs, 90 * kMillisecond));  // lags again, said not long ago
  EXPECT_TRUE(pacer.lagging());
  EXPECT_FALSE(pacer.reached(11'000 * kMs, 11'000 * kMillisecond));
  EXPECT_TRUE(pacer.reached(11'100 * kMs, 11'070 * kMillisecond));
  EXPECT_EQ(pacer.largest_lag(), 40 * kMs);
}

TEST(Pacer, AheadIsNoLag) {
  Pacer pacer;
  pacer.start(0, 0);
  EXPECT_FALSE(pacer.reached(kMs, 2 * kMillisecond));
  EXPECT_EQ(pacer.lag(), 0);
}

// ---- Real time

// Simulated time is never ahead of real time and, on a computer that is fast enough, behind it by
// the bridge's tick at most.
TEST(BridgePacing, FollowsRealTime) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .fast = false}};
  const WallTime begin = rig.wall.time;
  for (unsigned i = 0; i < 100; ++i) rig.port(0).send(numbered_frame(2 * i));
  for (unsigned rounds = 0; rounds < 300; ++rounds) {
    rig.bridge().round();
    const Time wall = (rig.wall.time - begin) * kNanosecond;
    EXPECT_LE(rig.bridge().elapsed(), wall);
    EXPECT_GE(rig.bridge().elapsed(), wall - 5 * kMillisecond);
  }
  EXPECT_THAT(rig.port(1).frames(), SizeIs(100));
  EXPECT_EQ(rig.bridge().pacer().largest_lag(), 0);
  EXPECT_THAT(rig.said, IsEmpty());
  EXPECT_THAT(rig.wall.timeouts, Each(Le(5 * kMs)));
  EXPECT_EQ(rig.wall.endless_waits, 0U);
}

// A frame is not on the bus before the program has sent it.
TEST(BridgePacing, FrameIsNotEarly) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .fast = false}};
  const WallTime begin = rig.wall.time;
  unsigned rounds = 0;
  Time sent = 0;
  rig.wall.on_wait = [&] {
    if (++rounds != 10) return;
    rig.wall.time += 3 * kMs;  // it comes somewhere between two ticks
    rig.port(0).send({.id = 0x123});
    sent = (rig.wall.time - begin) * kNanosecond;
  };
  ASSERT_TRUE(rig.run_until([&] { return !rig.port(1).got.empty(); }));
  constexpr Time kShortest = 44 * 2 * kMicrosecond;  // FF-11, stuff bits apart
  const Time start = rig.port(1).got.front().time - rig.bridge().simulation().started() - kShortest;
  EXPECT_GE(start, sent);
  EXPECT_LE(start, sent + 7 * kMillisecond);
}

// On a slow computer the lag grows, is said once, and is in the report.
TEST(BridgePacing, LagIsSaidAndReported) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .fast = false}};
  rig.wall.cost = 5 * kMs;  // each look at the clock
  for (unsigned i = 0; i < 1'000; ++i) rig.port(0).send(kFrame);
  for (unsigned rounds = 0; rounds < 30; ++rounds) rig.bridge().round();
  EXPECT_THAT(rig.said, ElementsAre(HasSubstr("behind real time")));
  rig.wall.cost = 0;
  const BridgeReport report = rig.bridge().finish();
  EXPECT_GT(report.pace.largest_lag, 100 * kMs);
  EXPECT_THAT(to_text(report), HasSubstr("largest"));
  EXPECT_TRUE(report.ok());  // late is not lost
}

// A bus on which nothing happens, and a computer that has lost a second: what must be simulated is
// made up for bit by bit, with looks at the programs and at the user's wish between.
TEST(BridgePacing, QuietTimeThatMustBeSimulatedDoesNotShutOutThePrograms) {
  constexpr Time kLook = 2 * kMillisecond;
  constexpr Time kLookBehind = 500 * kMicrosecond;  // once it lags
  FaultSpec far;                                    // its clocks are always simulated
  far.window = {.from = 1'000 * kSecond, .to = 1'001 * kSecond};
  BridgeRig rig{{.nodes = 1, .fast = false, .faults = {far}}};
  for (unsigned rounds = 0; rounds < 20; ++rounds) rig.bridge().round();
  const Time before = rig.bridge().elapsed();
  rig.wall.time += kSecond / kNanosecond;
  ASSERT_TRUE(rig.bridge().round());
  EXPECT_GT(rig.bridge().elapsed(), before);
  EXPECT_LE(rig.bridge().elapsed(), before + kLook);
  rig.wall.stop = true;
  EXPECT_FALSE(rig.bridge().round());
  EXPECT_LE(rig.bridge().elapsed(), before + kLook + kLookBehind);
}

// Nodes without a processor do something each millisecond: that is simulated, 2 ms a round, and
// what lies between is passed over.
TEST(BridgePacing, QuietTimeOfNodesWithoutAProcessorIsPassedOverBetweenMilliseconds) {
  if (kPlainEdges) GTEST_SKIP() << "models without short cuts";
  constexpr double kNodes = 2, kClocksOfASecond = 8e6;
  BridgeRig rig{{.nodes = 0, .remotes = 1, .fast = false}};
  for (unsigned rounds = 0; rounds < 20; ++rounds) rig.bridge().round();
  const Time before = rig.bridge().elapsed();
  rig.wall.time += kSecond / kNanosecond;
  ASSERT_TRUE(rig.bridge().round());
  EXPECT_GT(rig.bridge().elapsed(), before + 20 * kMillisecond);
  EXPECT_LT(rig.bridge().elapsed(), before + kSecond);
  while (rig.bridge().elapsed() < before + kSecond) ASSERT_TRUE(rig.bridge().round());
  const RunReport report = rig.bridge().finish().bus;
  const double clocks = kNodes * kClocksOfASecond * static_cast<double>(report.duration) / kSecond;
  EXPECT_LT(static_cast<double>(report.node_cycles), clocks / 5);
}

// Time that costs nothing is passed over in one round, however long it is.
TEST(BridgePacing, QuietTimeThatCostsNothingIsMadeUpForAtOnce) {
  BridgeRig rig{{.nodes = 1, .fast = false}};
  for (unsigned rounds = 0; rounds < 20; ++rounds) rig.bridge().round();
  const Time before = rig.bridge().elapsed();
  rig.wall.time += kSecond / kNanosecond;
  ASSERT_TRUE(rig.bridge().round());
  EXPECT_GE(rig.bridge().elapsed(), before + kSecond);
}

// ---- As fast as possible

// With nothing to do a fast bridge waits for the programs without end, and simulated time stands
// still.
TEST(BridgePacing, FastWaitsForThePrograms) {
  BridgeRig rig{{.ports = 2, .nodes = 1}};
  rig.port(0).send(kFrame);
  ASSERT_TRUE(rig.run_until([&] { return rig.wall.endless_waits >= 2; }));
  EXPECT_THAT(rig.port(1).frames(), SizeIs(1));
  const Time still = rig.bridge().elapsed();
  for (unsigned rounds = 0; rounds < 10; ++rounds) rig.bridge().round();
  EXPECT_EQ(rig.bridge().elapsed(), still);
  EXPECT_EQ(rig.wall.endless_waits, 12U);
}

// Traffic of the scenario, or a port with something planned, lets time go on.
TEST(BridgePacing, FastGoesOnWithTraffic) {
  BridgeRig rig{{.traffic = {beat(10 * kMillisecond)}}};
  EXPECT_TRUE(rig.run_until([&] { return rig.port(0).frames().size() == 100; }));
  EXPECT_EQ(rig.wall.endless_waits, 0U);
  EXPECT_GE(rig.bridge().elapsed(), 990 * kMillisecond);

  BridgeRig waiting{{}};
  waiting.port(0).awaits = true;
  for (unsigned rounds = 0; rounds < 10; ++rounds) waiting.bridge().round();
  EXPECT_GT(waiting.bridge().elapsed(), 0);
  EXPECT_EQ(waiting.wall.endless_waits, 0U);
}

// Jobs of clients have times of their own, which bits of 100 us or more must not hold up.
TEST(BridgePacing, FastLooksAboutOnceAMillisecondWhileAPortAwaitsTime) {
  for (const double bitrate : {1e3, 10e3, 500e3}) {
    BridgeRig rig{{.nodes = 1, .bitrate = bitrate}};
    rig.port(0).awaits = true;
    for (unsigned i = 0; i < 20; ++i) {
      const Time before = rig.bridge().elapsed();
      ASSERT_TRUE(rig.bridge().round());
      EXPECT_GT(rig.bridge().elapsed(), before);
      EXPECT_LE(rig.bridge().elapsed(), before + 2 * kMillisecond) << bitrate;
    }
  }
}

// ---- Signals

TEST(BridgePacing, StopEndsTheRun) {
  BridgeRig rig{{.fast = false}};
  EXPECT_TRUE(rig.bridge().round());
  rig.wall.stop = true;
  EXPECT_FALSE(rig.bridge().round());
}

TEST(HostWall, SignalsAskForTheEndAndForARestart) {
  HostWall wall;
  EXPECT_FALSE(wall.stop_requested());
  ::raise(SIGUSR1);
  std::vector<pollfd> set;
  wall.wait(set, {});  // does not wait: the signal has been there
  EXPECT_TRUE(wall.restart_requested());
  EXPECT_FALSE(wall.restart_requested());
  EXPECT_FALSE(wall.stop_requested());
  ::raise(SIGTERM);
  wall.wait(set, {});
  EXPECT_TRUE(wall.stop_requested());
}

TEST(HostWallDeathTest, SecondSignalEndsAtOnce) {
  EXPECT_EXIT(
      {
        HostWall wall;
        ::raise(SIGINT);
        ::raise(SIGINT);
      },
      ::testing::ExitedWithCode(128 + SIGINT), "");
}

}  // namespace
}  // namespace vericansim::test
