// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes with the time unit whose idle time is skipped are in the same state as those that have been
// clocked all the time (TM-121, TM-122).
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/host.hpp"
#include "node/model_edge.hpp"
#include "node/rtl_node.hpp"
#include "verican/verican_regs.h"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;  // 8 clocks of 8 MHz

std::vector<ClockConfig> steady() {
  return {{.error_ppm = 100}, {.error_ppm = -80, .phase = 20'000}, {.phase = 91'000}};
}

std::vector<ClockConfig> wandering() {
  auto clocks = steady();
  clocks[0].wander = Wander::kWalk;
  clocks[1].wander = Wander::kSine;
  clocks[0].wander_ppm = clocks[1].wander_ppm = 3;
  return clocks;
}

// A bus of three whose first node sends.
struct TimeBus {
  explicit TimeBus(const std::vector<ClockConfig> &clocks) {
    for (std::size_t n = 0; n < clocks.size(); ++n) {
      nodes[n] = RtlNode::create_with_time("node" + std::to_string(n), clocks[n]);
      bus.add(*nodes[n]);
      hosts[n] = std::make_unique<Host>(*nodes[n], HostConfig{});
    }
    for (auto &host : hosts) host->start_and_wait();
    for (auto &node : nodes) {
      node->write32(VERICAN_TINCN_OFFSET, 125);
      node->write32(VERICAN_TINCF_OFFSET, 0x1234'5678);
    }
    nodes[1]->write32(VERICAN_TCTRL_OFFSET,
                      VERICAN_TCTRL_RESET | VERICAN_TCTRL_CMPEN_MASK | VERICAN_TCTRL_OUTEN_MASK);
    nodes[1]->write32(VERICAN_TCMPH_OFFSET, 500'000'000);
    nodes[1]->write32(VERICAN_TCMP_OFFSET, 700'000'000);
  }
  /// Up to `until`, with as little work as is allowed; true if anything was left out.
  bool run(Time until, bool skips) {
    bool skipped = false;
    while (skips && bus.now() < until - 2 * kBit && bus.skip(until - 2 * kBit)) {
      skipped = true;
      bus.run_for(2 * kBit);
    }
    bus.run_until(until);
    return skipped;
  }
  std::uint64_t time(unsigned n) {
    const std::uint64_t low = nodes[n]->read32(VERICAN_TIMELO_OFFSET);
    return low | std::uint64_t{nodes[n]->read32(VERICAN_TIMEHI_OFFSET)} << 32;
  }

  std::array<std::unique_ptr<RtlNode>, 3> nodes;
  Bus bus;
  std::array<std::unique_ptr<Host>, 3> hosts;
};

void compare(TimeBus &skips, TimeBus &clocked) {
  ASSERT_EQ(skips.bus.now(), clocked.bus.now());
  for (unsigned n = 0; n < 3; ++n) {
    EXPECT_EQ(skips.nodes[n]->cycles(), clocked.nodes[n]->cycles());
    EXPECT_EQ(skips.nodes[n]->oscillator().next(), clocked.nodes[n]->oscillator().next());
    EXPECT_EQ(skips.nodes[n]->trace(), clocked.nodes[n]->trace());
    EXPECT_EQ(skips.nodes[n]->time_out(), clocked.nodes[n]->time_out());
    EXPECT_EQ(skips.time(n), clocked.time(n));
  }
}

void run_both(const std::vector<ClockConfig> &clocks) {
  TimeBus skips{clocks}, clocked{clocks};
  unsigned skipped = 0;
  for (unsigned i = 0; i < 12; ++i) {
    for (TimeBus *one : {&skips, &clocked}) {
      one->nodes[2]->write32(VERICAN_TSLEW_OFFSET, i * 5);
      ASSERT_TRUE(one->hosts[i % 3]->send_and_wait({.id = 0x100 + i, .dlc = 2}, kMillisecond));
      one->bus.run_for(20 * kBit);
    }
    const Time until = skips.bus.now() + 90 * kMillisecond + i * 1'234'567;
    skipped += skips.run(until, true);
    clocked.run(until, false);
    compare(skips, clocked);
    for (unsigned n = 0; n < 3; ++n)
      for (std::uint32_t row = 0; row < 64 * 8; row += 4)
        ASSERT_EQ(skips.nodes[n]->read32(VERICAN_STAMPLO_OFFSET(0) + row),
                  clocked.nodes[n]->read32(VERICAN_STAMPLO_OFFSET(0) + row));
  }
  EXPECT_EQ(skipped, 12u);
  for (unsigned n = 0; n < 3; ++n) {
    const auto &got = skips.hosts[n]->received(), &want = clocked.hosts[n]->received();
    ASSERT_GT(want.size(), 5u);
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t i = 0; i < want.size(); ++i) EXPECT_EQ(got[i].stamp, want[i].stamp);
  }
}

/// Models without short cuts (model_edge.hpp) are clocked all the time.
class BusTimeSkip : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kPlainEdges) GTEST_SKIP() << "a build without short cuts: no time is skipped";
  }
};

TEST_F(BusTimeSkip, IsAsIfClocked) { run_both(steady()); }

TEST_F(BusTimeSkip, ClocksMayWander) { run_both(wandering()); }

// A skip ends before an event of the compare unit, which would be missed.
TEST_F(BusTimeSkip, EndsBeforeAnEvent) {
  TimeBus bus{steady()};
  bus.bus.run_for(60 * kBit);  // the passes over the buffers are over
  ASSERT_TRUE(bus.bus.skip(kSecond));
  EXPECT_GT(bus.bus.now(), 690 * kMillisecond);
  EXPECT_FALSE(bus.nodes[1]->time_out());
  // Whole bits of all nodes end at different instants: who asks for the rest is told no some time.
  unsigned more = 0;
  while (more < 100 && bus.bus.skip(kSecond)) ++more;
  EXPECT_LT(more, 100u);
  bus.bus.run_until(701 * kMillisecond);
  EXPECT_TRUE(bus.nodes[1]->time_out());
}

}  // namespace
}  // namespace vericansim
