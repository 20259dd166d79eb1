// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clocks synchronised over a bus of cores in RTL, with the C driver on each of them.
#include <gtest/gtest.h>

#include <stdexcept>

#include "timesync/p4_experiment.hpp"
#include "timesync/rtl_p4.hpp"
#include "timesync/rtl_sync.hpp"
#include "timesync/sync_goal.hpp"
#include "timesync/sync_way.hpp"

namespace vericansim {
namespace {

SyncCase of(unsigned followers, double interval_s, unsigned intervals) {
  SyncCase setting;
  setting.followers = followers;
  setting.interval_s = interval_s;
  setting.intervals = intervals;
  return setting;
}

void expect_same(const SyncRun &skip, const SyncRun &rtl) {
  ASSERT_EQ(skip.looks.size(), rtl.looks.size());
  for (std::size_t i = 0; i < rtl.looks.size(); ++i) {
    ASSERT_EQ(skip.looks[i].at, rtl.looks[i].at);
    for (std::size_t n = 0; n < rtl.looks[i].followers.size(); ++n) {
      ASSERT_EQ(skip.looks[i].followers[n].error, rtl.looks[i].followers[n].error) << i;
      ASSERT_EQ(skip.looks[i].followers[n].state, rtl.looks[i].followers[n].state) << i;
    }
  }
  ASSERT_EQ(skip.actions.size(), rtl.actions.size());
  for (std::size_t i = 0; i < rtl.actions.size(); ++i) {
    const SyncAction &one = skip.actions[i], &other = rtl.actions[i];
    EXPECT_EQ(one.at, other.at);
    EXPECT_EQ(one.follower, other.follower);
    EXPECT_EQ(one.shift, other.shift);
    EXPECT_EQ(one.increment, other.increment);
    EXPECT_EQ(one.events, other.events);
  }
}

// TM-122 (b): corrections, readings and states are the same bit by bit.
TEST(TimeSkip, EqualsRtl) {
  const SyncCase setting = of(2, 0.1, 20);
  const SyncRun rtl = run_by_rtl(setting, 1);
  ASSERT_GT(rtl.actions.size(), 35u);
  expect_same(run_by_skip(setting, 1), rtl);
}

// With clocks that wander, and with the published messages.
TEST(TimeSkip, EqualsRtlWithWander) {
  SyncCase setting = of(2, 0.1, 8);
  setting.clocks.wander = 1e-7;
  const SyncRun rtl = run_by_rtl(setting, 2);
  ASSERT_GT(rtl.actions.size(), 10u);
  expect_same(run_by_skip(setting, 2), rtl);
}

TEST(TimeSkip, EqualsRtlInTheExperiment) {
  SyncCase setting = p4_case();
  setting.interval_s = 0.2;
  setting.intervals = 6;
  const SyncRun rtl = run_p4_by_rtl(setting, 3);
  ASSERT_EQ(rtl.actions.size(), 12u);
  expect_same(run_p4_by_skip(setting, 3), rtl);
}

// TM-130: the base case of section 12, in part, and its goal.
TEST(TimeSync, BaseCaseOnRtl) {
  SyncCase setting;
  setting.intervals = 60;
  setting.seeds = 2;
  const SyncFigures figures = run_case(sync_way("skip"), setting);
  EXPECT_TRUE(goal_of(setting)->reached_by(figures)) << figures.sd() << " " << figures.max();
  EXPECT_GT(figures.sd(), 5);  // what T = 62.5 ns leaves
}

// TM-123: what the paper predicts and measured: 152 us/s for R = 1 s, between the two 304.
TEST(TimeSync, P4OnRtl) {
  SyncCase setting = p4_case();
  setting.intervals = 20;
  setting.seeds = 2;
  const P4Result result = run_p4(sync_way("skip"), setting);
  ASSERT_EQ(result.checks.size(), 4u);
  for (const P4Check &check : result.checks)
    EXPECT_TRUE(check.ok) << check.what << ": " << check.seen << ", expected " << check.expected;
}

void expect_within_bound(const SyncRun &run, const SyncCase &setting) {
  SyncFigures figures;
  figures.add(run);
  EXPECT_TRUE(figures.locked());
  EXPECT_LE(figures.max(), *steady_bound(setting));
}

// TM-126, TM-130: other frames below and above SYNC, and errors, on RTL; the bound of section 12.
TEST(TimeSync, LoadOnRtl) {
  SyncCase setting = of(2, 0.05, 30);
  setting.load = 0.5;
  setting.load_above = 0.4;
  setting.bit_errors = 1e-3;
  const SyncRun run = run_by_skip(setting, 1);
  EXPECT_GT(run.repeated, 2u);
  EXPECT_GE(run.frames, 58u);
  expect_within_bound(run, setting);
}

// A bus that is full: frames wait behind each SYNC, so that it is delayed by up to a frame, and
// nothing but the stamps tells.
TEST(TimeSync, FullBusOnRtl) {
  SyncCase setting = of(1, 0.05, 20);
  setting.load = 1;
  const SyncRun run = run_by_rtl(setting, 4);
  EXPECT_EQ(run.repeated, 0u);
  expect_within_bound(run, setting);
}

// TM-122 (b) also with other frames and errors, and with edges that are early.
TEST(TimeSkip, EqualsRtlWithLoad) {
  SyncCase setting = of(2, 0.05, 8);
  setting.load = 0.3;
  setting.bit_errors = 1e-3;
  expect_same(run_by_skip(setting, 5), run_by_rtl(setting, 5));
}

TEST(TimeSkip, EqualsRtlWithDisplacedEdges) {
  SyncCase setting = of(2, 0.05, 12);
  setting.displaced = 0.3;
  expect_same(run_by_skip(setting, 6), run_by_rtl(setting, 6));
}

// Edges that are up to 300 ns early are seen as such, by the whole of it if the filter is short.
TEST(TimeSync, DisplacedEdgesOnRtl) {
  SyncCase setting = of(2, 0.05, 60);
  setting.filter = 1;
  SyncFigures as_wired, displaced;
  as_wired.add(run_by_skip(setting, 7));
  setting.displaced = 0.2;
  displaced.add(run_by_skip(setting, 7));
  EXPECT_LT(as_wired.max(), 100);
  EXPECT_GT(displaced.max(), 100);
}

void expect_unknown(const SyncCase &setting) {
  EXPECT_THROW((void)run_case(sync_way("rtl"), setting), std::invalid_argument);
  EXPECT_THROW((void)run_case(sync_way("skip"), setting), std::invalid_argument);
}

TEST(TimeSync, RtlKnowsNotAll) {
  SyncCase late, swinging, crowded;
  late.master_late_ns = 100;
  expect_unknown(late);
  swinging.clocks.wander = 1e-9;
  swinging.clocks.sine_ppm = 1;
  expect_unknown(swinging);
  crowded.displaced = 0.01;
  crowded.load = 0.5;
  expect_unknown(crowded);
}

}  // namespace
}  // namespace vericansim
