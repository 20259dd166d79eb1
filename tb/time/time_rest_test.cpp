// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A core at rest whose TIME goes on in closed form is the core whose every clock is evaluated:
// TM-122 (a), of the RTL's own flip-flops.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "bus/bus.hpp"
#include "node/clock_leap.hpp"
#include "node/model_edge.hpp"
#include "time/time_rig.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

// One clock, as rtl/time/can_clock.sv is written.
ClockLeap stepped(const ClockLeap &now, std::uint64_t increment) {
  const std::uint64_t fraction = std::uint64_t{now.fraction} + (increment & 0xFFFFFFFF);
  const std::uint64_t lo = std::uint64_t{now.lo} + (increment >> 32) + now.carry2;
  return {static_cast<std::uint32_t>(lo), now.hi + now.carry3, static_cast<std::uint32_t>(fraction),
          (fraction >> 32) != 0,          now.carry,           (lo >> 32) != 0};
}

bool same(const ClockLeap &a, const ClockLeap &b) {
  return a.lo == b.lo && a.hi == b.hi && a.fraction == b.fraction && a.carry == b.carry &&
         a.carry2 == b.carry2 && a.carry3 == b.carry3;
}

// A state that the RTL can be in.
ClockLeap any_state(std::mt19937_64 &random, std::uint64_t increment) {
  ClockLeap state;
  state.hi = static_cast<std::uint32_t>(random());
  state.lo = static_cast<std::uint32_t>(random());
  state.fraction = static_cast<std::uint32_t>(random());
  for (int i = 0; i < 4; ++i) state = stepped(state, increment);
  return state;
}

ClockLeap after(ClockLeap state, std::uint64_t clocks, std::uint64_t increment) {
  for (std::uint64_t i = 0; i < clocks; ++i) state = stepped(state, increment);
  return state;
}

// Every other run ends where the lower half has just wrapped, or not, by one carry.
TEST(ClockLeap, EqualsSingleSteps) {
  std::mt19937_64 random{1};
  for (int run = 0; run < 100'000; ++run) {
    const std::uint64_t increment = random() >> (run % 16 == 0 ? 30 : 24);
    const std::uint64_t clocks = 3 + random() % 40;
    ClockLeap leap = any_state(random, increment);
    if (run % 2 == 0)
      leap.lo += static_cast<std::uint32_t>(increment >> 32) - after(leap, clocks, increment).lo;
    const ClockLeap steps = after(leap, clocks, increment);
    leap.pass(clocks, increment);
    ASSERT_TRUE(same(leap, steps)) << "run " << run << ", " << clocks << " clocks";
  }
}

TEST(ClockLeap, LongLeapsAddUp) {
  std::mt19937_64 random{2};
  for (int run = 0; run < 100'000; ++run) {
    const std::uint64_t increment = random() >> 24;
    ClockLeap once = any_state(random, increment);
    ClockLeap twice = once;
    const std::uint64_t first = 3 + (random() >> 25), second = 3 + random() % 1000;
    once.pass(first + second, increment);
    twice.pass(first, increment);
    twice.pass(second, increment);
    ASSERT_TRUE(same(once, twice)) << "run " << run;
  }
}

// Two cores, alone on a bus each, that get the same commands at the same times.
class TimeRest : public testing::Test {
 protected:
  TimeRest() {
    resting_.let_rest(true);
    buses_[0].add(resting_);
    buses_[1].add(awake_);
    run(1000);
  }
  void run(Time clocks) {
    for (Bus &bus : buses_) bus.run_for(clocks * static_cast<Time>(kTimeStep) * kNanosecond);
  }
  void write(std::uint32_t address, std::uint32_t data) {
    resting_.write32(address, data);
    awake_.write32(address, data);
  }
  std::uint32_t now() {
    (void)awake_.read32(kTimelo);
    return resting_.read32(kTimelo);
  }
  void expect_same(const char *what) {
    EXPECT_EQ(resting_.edges(), awake_.edges()) << what;
    for (const std::uint32_t address : {kTstat, kTimelo, kTimehi, kTslew, kTextlo, kTexthi})
      EXPECT_EQ(resting_.read32(address), awake_.read32(address)) << what << ", " << address;
    EXPECT_EQ(resting_.irq_time(), awake_.irq_time()) << what;
    EXPECT_EQ(resting_.pulses(), awake_.pulses()) << what;
  }

  TimeNode resting_{"resting"}, awake_{"awake"};
  Bus buses_[2];
};

TEST_F(TimeRest, RestsIndeed) {
  run(1'000'000);
  expect_same("after a second of an eighth");
  EXPECT_TRUE(kPlainEdges || buses_[0].edges_passed() > 990'000);
  EXPECT_EQ(buses_[1].edges_passed(), 0U);
}

TEST_F(TimeRest, RandomCommands) {
  std::mt19937_64 random{3};
  const auto word = [&] { return static_cast<std::uint32_t>(random()); };
  for (int round = 0; round < 300; ++round) {
    switch (random() % 7) {
      case 0:
        write(kTincn, 100 + word() % 50);
        write(kTincf, word());
        break;
      case 1:
        write(kTimelo, word() | 0xFFFC0000);
        write(kTimehi, word());
        break;
      case 2:
        write(kTshlo, word());
        write(kTshhi, word());
        break;
      case 3: write(kTslew, word() % 64 - 32); break;
      case 4:
        write(kTctrl, 0x00033331);
        write(kTcmph, 2000 + word() % 100'000);
        write(kTcmp, now() + word() % 1'000'000);
        break;
      case 5: write(kTstat, 0x3F); break;
      default:
        resting_.external((round & 1) != 0);
        awake_.external((round & 1) != 0);
        break;
    }
    run(static_cast<Time>(1 + random() % (round % 8 == 0 ? 60'000 : 300)));
    expect_same("random");
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(awake_.pulses().size(), 100U);
}

}  // namespace
}  // namespace vericansim
