// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of clock synchronisation: traffic, figures, goals, the published experiment.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "timesync/bus_traffic.hpp"
#include "timesync/p4_experiment.hpp"
#include "timesync/p4_loop.hpp"
#include "timesync/sync_axes.hpp"
#include "timesync/sync_goal.hpp"
#include "timesync/sync_loop.hpp"
#include "timesync/sync_way.hpp"

namespace vericansim {
namespace {

constexpr double kBit = 2000;       // ns at 500 kbit/s
constexpr double kLongest = 135;    // bits
constexpr std::size_t kSync = 120;  // bits, about

/// The base case, changed.
template <typename Change>
SyncCase base(Change change) {
  SyncCase setting;
  change(setting);
  return setting;
}

/// Mean wait of a SYNC, bits.
double mean_wait(const SyncCase &setting) {
  constexpr int kFrames = 200'000;
  BusTraffic traffic{setting, 1};
  double sum = 0;
  for (int n = 0; n < kFrames; ++n) sum += static_cast<double>(traffic.until_sof(kSync)) / kBit;
  return sum / kFrames;
}

// TM-121: half of what is on the bus; above the priority the M/D/1 queue, seen from below: the work
// ahead, L F / 2 / (1 - L), and what comes meanwhile, 1 / (1 - L) times as long.
TEST(BusTraffic, MeanWaits) {
  EXPECT_EQ(mean_wait({}), 0);
  EXPECT_NEAR(mean_wait(base([](SyncCase &c) { c.load = 1; })), kLongest / 2, 0.5);
  EXPECT_NEAR(mean_wait(base([](SyncCase &c) { c.load = 0.5; })), kLongest / 4, 0.5);
  for (const double load : {0.3, 0.9}) {
    const double work = load * kLongest / 2 / (1 - load);
    const double wait = mean_wait(base([load](SyncCase &c) { c.load_above = load; }));
    EXPECT_NEAR(wait / (work / (1 - load)), 1, 0.05) << load;
  }
}

// Each attempt fails with the probability that any of its bits does.
TEST(BusTraffic, ErrorFrames) {
  BusTraffic traffic{base([](SyncCase &c) { c.bit_errors = 1e-3; }), 1};
  constexpr int kFrames = 100'000;
  for (int n = 0; n < kFrames; ++n) (void)traffic.until_sof(kSync);
  const double fails = 1 - std::pow(1 - 1e-3, 120);
  EXPECT_NEAR(static_cast<double>(traffic.failed()) / kFrames, fails / (1 - fails), 0.003);
}

SyncReading locked(Time error_ps) { return {error_ps, VERICAN_SYNC_LOCKED}; }

// Only who is locked counts; the distance of two is that at one instant.
TEST(SyncFigures, OfSamples) {
  const SyncRun run{{{0, {locked(3000), {77'000, VERICAN_SYNC_ACQUIRING}}},
                     {1, {locked(-4000), locked(1000)}},
                     {2, {locked(8000), locked(7000)}}},
                    {},
                    0,
                    0,
                    0};
  SyncFigures figures;
  figures.add(run);
  EXPECT_EQ(figures.count(), 5u);
  EXPECT_DOUBLE_EQ(figures.mean(), 3);  // (3 - 4 + 1 + 8 + 7) / 5
  EXPECT_DOUBLE_EQ(figures.sd(), std::sqrt((0 + 49 + 4 + 25 + 16) / 5.0));
  EXPECT_DOUBLE_EQ(figures.max(), 8);
  EXPECT_DOUBLE_EQ(figures.between(), 5);
  EXPECT_TRUE(figures.locked());
  figures.add(SyncRun{{{0, {locked(0), {0, VERICAN_SYNC_HOLDOVER}}}}, {}, 0, 0, 0});
  EXPECT_FALSE(figures.locked());
}

SyncFigures figures_of(Time error_ps) {
  SyncFigures figures;
  figures.add(SyncRun{{{0, {locked(error_ps)}}, {1, {locked(-error_ps)}}}, {}, 0, 0, 0});
  return figures;
}

// Section 12: the table's rows, and B T + 2 ns where nothing else is said.
TEST(SyncGoal, OfACase) {
  const auto usual = goal_of({});
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->sd, 16);
  EXPECT_EQ(usual->max, 60);
  const auto fast = goal_of(base([](SyncCase &c) { c.clocks.frequency_hz = 40e6; }));
  ASSERT_TRUE(fast);
  EXPECT_FALSE(fast->sd);
  EXPECT_NEAR(fast->max, 0.92 * 25 + 2, 1e-9);
  const auto pin = goal_of(base([](SyncCase &c) {
    c.clocks.frequency_hz = 25e6;
    c.filter = 1;
    c.own_pin = true;
  }));
  ASSERT_TRUE(pin);
  EXPECT_NEAR(pin->max, 2 * 40 + 2, 1e-9);
  EXPECT_FALSE(goal_of(base([](SyncCase &c) { c.clocks.wander = 1e-8; })));
  EXPECT_FALSE(goal_of(base([](SyncCase &c) { c.displaced = 0.5; })));
}

TEST(SyncGoal, IsReachedWithinItsLimits) {
  const SyncGoal goal{16, 60};
  EXPECT_TRUE(goal.reached_by(figures_of(16'000)));
  EXPECT_FALSE(goal.reached_by(figures_of(16'001)));
  EXPECT_TRUE((SyncGoal{std::nullopt, 60}.reached_by(figures_of(60'000))));
  EXPECT_FALSE((SyncGoal{std::nullopt, 60}.reached_by(figures_of(60'001))));
  EXPECT_FALSE(goal.reached_by(SyncFigures{}));
}

// TM-124: one thing differs from the base; 1 to 8 followers whatever the base has.
TEST(SyncAxes, DifferInOneThing) {
  SyncCase few;
  few.followers = 2;
  few.seeds = 1;
  const std::vector<SyncTable> tables = sweep(few);
  ASSERT_EQ(tables.size(), 14u);
  EXPECT_EQ(tables[0].rows.size(), tables[1].rows.size());
  for (const SyncTable &table : tables)
    for (const SyncRow &row : table.rows) {
      EXPECT_EQ(row.setting.seeds, 1u);
      if (table.title != "Followers") {
        EXPECT_EQ(row.setting.followers, 2u);
      }
    }
}

// TM-89, TM-124: the master is cut half-way. For 3.5 R nobody sends, all hold over; then the first
// follower is the master, and nobody is ever 3 T away from the one there is.
TEST(SyncLoop, MasterIsCut) {
  const SyncCase setting = base([](SyncCase &c) { c.master_cut = true; });
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const SyncRun run = run_by_model(setting, seed);
    unsigned holding = 0;
    Time silent = 0, before = 0;
    for (const SyncLook &look : run.looks) {
      bool all = true;
      for (const SyncReading &reading : look.followers)
        all = all && reading.state == VERICAN_SYNC_HOLDOVER;
      holding += all ? 1 : 0;
    }
    for (const SyncAction &action : run.actions) {
      silent = std::max(silent, action.at - before);
      before = action.at;
    }
    EXPECT_EQ(holding, 1u) << seed;  // the look behind 3 R
    EXPECT_NEAR(static_cast<double>(silent) / kSecond, 3.5, 0.01) << seed;
    EXPECT_EQ(run.looks.back().followers[0].error, 0);
    EXPECT_TRUE(run.looks.back().followers[7].locked());
    SyncFigures locked, throughout{true};
    locked.add(run);
    throughout.add(run);
    EXPECT_GT(throughout.count(), locked.count()) << seed;
    EXPECT_LE(throughout.max(), 3 * 62.5) << seed;
    EXPECT_GE(throughout.max(), locked.max()) << seed;
  }
}

// TM-103, TM-124: followers in hardware: a step, twelve pairs, locked; their increments are the
// master's rate in the end.
TEST(SyncLoop, FollowersInHardware) {
  const SyncCase setting = base([](SyncCase &c) { c.hardware = true; });
  SyncLoop loop{setting, 5};
  const SyncRun &run = loop.run();
  unsigned steps = 0, locked = 0;
  for (const SyncAction &action : run.actions) {
    if (action.follower != 3) continue;
    steps += (action.events & VERICAN_SERVO_STEP) != 0 ? 1 : 0;
    locked += action.state == VERICAN_SYNC_LOCKED ? 1 : 0;
  }
  EXPECT_EQ(steps, 1u);
  EXPECT_EQ(locked, 260u - 12);
  const auto rate = [&loop](unsigned n) {
    const double seconds = 100;
    const auto ns = static_cast<double>(loop.nodes[n].oscillator.count(seconds * 1e9L));
    return ns * static_cast<double>(loop.nodes[n].increment()) / 4294967296.0 / seconds / 1e9;
  };
  for (unsigned n = 1; n <= 8; ++n) EXPECT_NEAR(rate(n) / rate(0), 1, 1e-7) << n;
}

// TM-124: other seeds are other runs.
TEST(SyncWay, FirstSeed) {
  SyncCase setting = base([](SyncCase &c) {
    c.seeds = 2;
    c.first_seed = 41;
    c.intervals = 20;
  });
  std::vector<Time> seen;
  const auto look = [&seen](const SyncRun &run) {
    seen.push_back(run.looks.back().followers[0].error);
  };
  (void)run_case(sync_way("model"), setting, look);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0], run_by_model(setting, 41).looks.back().followers[0].error);
  EXPECT_EQ(seen[1], run_by_model(setting, 42).looks.back().followers[0].error);
  EXPECT_NE(seen[0], run_by_model(setting, 1).looks.back().followers[0].error);
}

// TM-121: SYNC, FUP and the servo are the driver's; a lost pair is one that a follower has not.
TEST(SyncLoop, RunsTheCase) {
  SyncCase setting;
  setting.followers = 3;
  setting.intervals = 20;
  setting.bit_errors = 1e-3;
  const SyncRun run = run_by_model(setting, 1);
  EXPECT_EQ(run.frames, 40u);
  EXPECT_GT(run.repeated, 0u);
  EXPECT_EQ(run.refused, 0u);
  EXPECT_EQ(run.actions.size(), 60u);
  ASSERT_EQ(run.looks.size(), 60u);
  for (std::size_t n = 1; n < run.looks.size(); ++n)
    EXPECT_GT(run.looks[n].at, run.looks[n - 1].at);
  EXPECT_TRUE(run.looks.back().followers.back().locked());
  EXPECT_EQ(run_by_model(setting, 1).looks.back().followers.back().error,
            run.looks.back().followers.back().error);
  EXPECT_NE(run_by_model(setting, 2).looks.back().followers.back().error,
            run.looks.back().followers.back().error);
}

// TM-121: frames above SYNC's priority can keep SYNC and FUP waiting for longer than R. Pairs stay
// one behind the other then, and who is locked is within the bound of section 12.
TEST(SyncLoop, PairsThatWaitLongerThanTheyAreApart) {
  for (const double interval_s : {0.05, 0.1, 0.2}) {
    SyncCase setting;
    setting.load_above = 0.9;
    setting.interval_s = interval_s;
    const SyncRun run = run_by_model(setting, 1);
    unsigned locked = 0;
    for (std::size_t n = 1; n < run.looks.size(); ++n) {
      EXPECT_GT(run.looks[n].at, run.looks[n - 1].at);
      for (const SyncReading &reading : run.looks[n].followers) {
        if (!reading.locked()) continue;
        ++locked;
        EXPECT_LE(std::abs(static_cast<double>(reading.error)) / 1e3, *steady_bound(setting));
      }
    }
    EXPECT_GT(locked, 0u) << interval_s;
  }
}

// TM-50: a SYNC that is not sent within R is aborted, and no FUP goes out.
TEST(SyncLoop, SyncThatIsNotSentWithinRIsAborted) {
  SyncCase setting;
  setting.load_above = 0.95;
  setting.interval_s = 0.05;
  setting.bitrate = 100e3;  // a SYNC waits for a quarter of a second, on average
  setting.intervals = 100;
  const SyncRun run = run_by_model(setting, 1);
  EXPECT_GT(run.frames, 0u);
  EXPECT_LT(run.frames, 100u);
  EXPECT_EQ(run.frames % 2, 0u);
}

// TM-125: the samples are one behind the other in time, also where the first follower takes over.
TEST(SyncLoop, SamplesOfACutAreInOrder) {
  SyncCase setting;
  setting.master_cut = true;
  setting.intervals = 20;
  const SyncRun run = run_by_model(setting, 1);
  for (std::size_t n = 1; n < run.looks.size(); ++n)
    EXPECT_GT(run.looks[n].at, run.looks[n - 1].at);
}

// TM-87: a follower that hears nothing for more than three intervals holds over, and tells so.
TEST(SyncLoop, LosesAndFindsItsMaster) {
  SyncCase setting;
  setting.followers = 2;
  SyncLoop loop{setting, 1};
  for (int n = 0; n < 6; ++n) loop.sync(1);
  for (int n = 0; n < 4; ++n) loop.sync(1, [](unsigned follower) { return follower == 1; });
  EXPECT_EQ(loop.servos[0].state, VERICAN_SYNC_LOCKED);
  EXPECT_EQ(loop.servos[1].state, VERICAN_SYNC_HOLDOVER);
  for (int n = 0; n < 4; ++n) loop.sync(1);
  EXPECT_EQ(loop.servos[1].state, VERICAN_SYNC_LOCKED);
}

// TM-57: once a delay is known the offset alone is left. Without drift it is what the handlers add:
// 2 to 6 us each, in the stamps of this round and in the delay of the last one.
TEST(P4Loop, WithoutDrift) {
  SyncCase setting = p4_case();
  setting.clocks.spread_ppm = 0;
  setting.intervals = 200;
  P4Loop loop{setting, 1};
  SyncFigures figures;
  figures.add(loop.run());
  EXPECT_GT(figures.max(), 2e3);
  EXPECT_LE(figures.max(), 8e3);
  EXPECT_NEAR(figures.mean(), 0, 1e3);
}

}  // namespace
}  // namespace vericansim
