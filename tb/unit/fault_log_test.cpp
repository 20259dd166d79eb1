// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// How often faults took effect: the log by itself, and what each kind of fault notes in it.
#include "bus/fault_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"

namespace vericansim {
namespace {

using Times = std::vector<std::pair<Time, Time>>;

Times times(const FaultLog &log) {
  Times list;
  for (const Window &stretch : log.stretches()) list.emplace_back(stretch.from, stretch.to);
  return list;
}

/// Marks every 10 ps of [from, to).
void mark(FaultLog &log, Time from, Time to, unsigned receiver = 0) {
  for (Time t = from; t < to; t += 10) log.mark(t, receiver);
}

TEST(FaultLog, AStretchCountsItsLengthInBitTimes) {
  for (Time bits = 1; bits <= 20; ++bits) {
    FaultLog log{100};
    mark(log, 1000, 1000 + 100 * bits);
    EXPECT_EQ(log.hits(), static_cast<std::uint64_t>(bits));
    EXPECT_EQ(times(log), (Times{{1000, 1000 + 100 * bits - 10}}));
  }
}

TEST(FaultLog, ASingleEdgeCountsOnce) {
  FaultLog log{100};
  EXPECT_EQ(log.hits(), 0U);
  log.mark(5);
  EXPECT_EQ(log.hits(), 1U);
  EXPECT_EQ(times(log), (Times{{5, 5}}));
}

// A bit that a clock edge more or less sees is still one.
TEST(FaultLog, LengthsAreRounded) {
  for (const Time length : {80, 110, 140}) {
    FaultLog log{100};
    mark(log, 0, length);
    EXPECT_EQ(log.hits(), 1U) << length;
  }
  FaultLog log{100};
  mark(log, 0, 170);
  EXPECT_EQ(log.hits(), 2U);
}

TEST(FaultLog, MoreThanHalfABitWithoutEffectEndsAStretch) {
  FaultLog log{100};
  mark(log, 0, 100);    // last edge at 90
  mark(log, 140, 240);  // 50 later: the same
  EXPECT_EQ(times(log), (Times{{0, 230}}));
  mark(log, 290, 300);  // 60 later: another one
  EXPECT_EQ(times(log), (Times{{0, 230}, {290, 290}}));
  EXPECT_EQ(log.hits(), 3U);
}

TEST(FaultLog, WhatIsTooShortDoesNotCount) {
  FaultLog log{100, 25};
  mark(log, 0, 30);     // last edge at 20
  mark(log, 200, 240);  // at 230
  EXPECT_EQ(log.hits(), 1U);
  EXPECT_EQ(times(log), (Times{{200, 230}}));
}

TEST(FaultLog, ReceiversThatAreDisturbedForThemselvesCountForThemselves) {
  FaultLog log{100};
  for (Time t = 0; t < 200; t += 10)
    for (const unsigned receiver : {0, 3}) log.mark(t, receiver);
  EXPECT_EQ(log.hits(), 4U);
  EXPECT_EQ(times(log), (Times{{0, 190}, {0, 190}}));
}

TEST(FaultLog, KeepsTheTimesOfTheFirstStretches) {
  FaultLog log{100};
  const auto all = static_cast<Time>(FaultLog::kStretches);
  for (Time i = 0; i < all; ++i) log.mark(1000 * i);
  EXPECT_FALSE(log.more());
  log.mark(1000 * all);
  log.mark(1000 * all + 10);
  EXPECT_TRUE(log.more());
  EXPECT_EQ(log.stretches().size(), FaultLog::kStretches);
  EXPECT_EQ(log.stretches().back().to, 1000 * (all - 1));
  EXPECT_EQ(log.hits(), FaultLog::kStretches + 1);
}

constexpr ClockConfig kMegahertz{.frequency_hz = 1e6};

// Drives one character of a pattern an edge: '0' dominant, recessive afterwards.
class Driver : public Node {
 public:
  explicit Driver(const std::string &name, std::string pattern = "")
      : Node{name, kMegahertz}, pattern_{std::move(pattern)} {}
  void clock(Level) override {
    drive(edge_ < pattern_.size() && pattern_[edge_] == '0' ? Level::kDominant : Level::kRecessive);
    ++edge_;
  }

 private:
  std::string pattern_;
  std::size_t edge_ = 0;
};

using Edges = std::vector<Time>;

/// Edges that saw it, in us, of a log without bit time.
Edges edges(const FaultLog &log) {
  Edges list;
  for (const Window &each : log.stretches()) list.push_back(each.from / kMicrosecond);
  EXPECT_EQ(log.hits(), list.size());
  return list;
}

// Three nodes without delays; all see 1110011111, an edge a microsecond.
struct FaultHits : ::testing::Test {
  Bus bus;
  Driver a{"a", "110011"}, b{"b"}, c{"c"};
  FaultLog log;

  void SetUp() override {
    bus.add(a);
    bus.add(b);
    bus.add(c);
  }
  Edges run(Fault &fault) {
    fault.log_to(log);
    bus.add(fault);
    bus.run_until(9 * kMicrosecond);
    return edges(log);
  }
};

TEST_F(FaultHits, DominantOverDominantIsNone) {
  LevelFault fault{1, Effect::kDominant, {2 * kMicrosecond, 7 * kMicrosecond}};
  EXPECT_EQ(run(fault), (Edges{2, 5, 6}));
}

// Of all receivers at once an edge counts once, and the observation point is none.
TEST_F(FaultHits, RecessiveOverRecessiveIsNone) {
  LevelFault fault{kAllNodes, Effect::kRecessive, {}};
  EXPECT_EQ(run(fault), (Edges{3, 4}));
}

TEST_F(FaultHits, EveryFlippedLevelIsOne) {
  LevelFault fault{2, Effect::kFlip, {2 * kMicrosecond, 6 * kMicrosecond}};
  EXPECT_EQ(run(fault), (Edges{2, 3, 4, 5}));
}

TEST_F(FaultHits, ScheduledFaultsCountForThemselves) {
  FaultLog second, idle;
  ScheduledFaults faults;
  faults.add(1, Effect::kFlip, {kMicrosecond, 3 * kMicrosecond}, &log);
  faults.add(kAllNodes, Effect::kDominant, {4 * kMicrosecond, 6 * kMicrosecond}, &second);
  faults.add(0, Effect::kDominant, {3 * kMicrosecond, 5 * kMicrosecond}, &idle);
  bus.add(faults);
  bus.run_until(9 * kMicrosecond);
  EXPECT_EQ(edges(log), (Edges{1, 2}));
  EXPECT_EQ(edges(second), (Edges{5}));
  EXPECT_EQ(edges(idle), Edges{});
}

// b hears nothing of a; the others miss nothing of b.
TEST_F(FaultHits, ACutCountsWhatItWithholds) {
  CutFault fault{1, {}};
  EXPECT_EQ(run(fault), (Edges{3, 4}));
}

TEST_F(FaultHits, ACutThatWithholdsNothingIsNone) {
  CutFault fault{1, {5 * kMicrosecond, 9 * kMicrosecond}};
  EXPECT_EQ(run(fault), Edges{});
}

TEST_F(FaultHits, AShortCountsWhereTheBusWouldBeRecessive) {
  ShortFault fault{2, {kMicrosecond, 7 * kMicrosecond}};
  EXPECT_EQ(run(fault), (Edges{1, 2, 5, 6}));
}

// Only c hears the short of c, and nothing of the others.
TEST_F(FaultHits, AShortBehindACutCountsForItsNodeAlone) {
  CutFault cut{2, {}};
  FaultLog withheld;
  cut.log_to(withheld);
  bus.add(cut);
  ShortFault fault{2, {kMicrosecond, 3 * kMicrosecond}};
  EXPECT_EQ(run(fault), (Edges{1, 2}));
  EXPECT_EQ(edges(withheld), (Edges{1, 2, 3, 4}));
}

TEST_F(FaultHits, AClockCountsWhenItsTimeComes) {
  ClockFault fault{1, 4 * kMicrosecond, 500};
  EXPECT_EQ(run(fault), (Edges{4}));
}

TEST_F(FaultHits, AClockThatDoesNotChangeIsNone) {
  ClockFault fault{1, 4 * kMicrosecond, 0};
  EXPECT_EQ(run(fault), Edges{});
}

TEST_F(FaultHits, NoiseCountsWithinItsWindowAtItsVictimAlone) {
  NoiseConfig noise;
  noise.per_ns = 1;  // a glitch at every edge
  noise.victim = 1;
  noise.window = {2'900'000, 5 * kMicrosecond};
  noise.glitch = kMicrosecond;
  NoiseFault fault{noise};
  EXPECT_EQ(run(fault), (Edges{3, 4}));
}

}  // namespace
}  // namespace vericansim
