// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes without a processor that share the time of a master on the bus: TM-106 to TM-109.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "Vcan_remote_whole.h"
#include "node/model_context.hpp"
#include "remote/clocked_remote.hpp"
#include "remote/frame_texts.hpp"

namespace vericansim {
namespace {

constexpr double kClock = 125;              // ns
constexpr double kMs = 1e6;                 // ns
constexpr Time kRound = 10 * kMillisecond;  // between two pairs
constexpr unsigned kLocked = 2;             // STATE

void lock(ClockBus &bus, unsigned pairs = 20) {
  const Time begin = bus.bus.now();
  for (unsigned i = 0; i < pairs; ++i) {
    bus.pair();
    bus.run(begin + (i + 1) * kRound);
  }
}

std::uint64_t word64(ClockBus &bus, std::size_t i, unsigned address) {
  const std::uint64_t low = bus.word(i, address);
  return std::uint64_t{bus.word(i, address + 4)} << 32 | low;
}

// How far a stamp is from the truth, ns.
double error(std::uint64_t stamp, Time at) {
  return static_cast<double>(static_cast<std::int64_t>(stamp - ClockBus::kEpoch)) -
         static_cast<double>(at) / 1000;
}

// The row as the bus reads it.
std::uint64_t number(const std::vector<std::uint8_t> &bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

// A cabinet: a set point and a TRIGGER each millisecond between the pairs, clocks +-100 ppm off.
// The pulses of all nodes rise with the master's milliseconds, and what each has done by one
// TRIGGER it has stamped with the time at which it did it, to three clocks.
TEST(RtlClock, ACabinetSharesTheTime) {
  const std::vector<double> errors{100, -100, 7};
  ClockBus bus{errors};
  lock(bus);
  (void)bus.send(frame_of(0x000, {1}));
  for (const auto &node : bus.nodes) {
    EXPECT_EQ(node->time_state(), kLocked);
    EXPECT_EQ(node->state(), RemoteState::kOperate);
    node->pulses.clear();
  }
  double worst = 0;
  unsigned triggers = 0;
  for (unsigned pair = 0; pair < 10; ++pair) {
    const Time begin = bus.bus.now();
    bus.pair();
    for (std::uint8_t ms = 1; ms < 10; ++ms) {
      bus.run(begin + ms * kMillisecond);
      (void)bus.send(frame_of(3U << 7 | 0x10, {ms, ms, ms, ms, ms, ms, ms, ms}));
      (void)bus.send(frame_of(0x001, {static_cast<std::uint8_t>(9 * pair + ms)}));
      for (std::size_t i = 0; i < bus.nodes.size(); ++i) {
        const double off = error(word64(bus, i, 0xFC8), bus.nodes[i]->applied.back());
        EXPECT_LT(std::abs(off), 3 * kClock) << i;
        worst = std::max(worst, std::abs(off));
      }
      ++triggers;
    }
    bus.run(begin + kRound);
  }
  for (std::size_t i = 0; i < bus.nodes.size(); ++i) {
    const ClockedRemote &node = *bus.nodes[i];
    EXPECT_EQ(node.applied.size(), triggers);
    ASSERT_GT(node.pulses.size(), 95U);
    double most = 0, least = 1e9;
    for (const Time pulse : node.pulses) {
      const double at = ClockBus::master(pulse), late = at - std::round(at / kMs) * kMs;
      most = std::max(most, late);
      least = std::min(least, late);
    }
    std::printf("%+.0f ppm: pulses %.0f to %.0f ns behind the master's\n", errors[i], least, most);
    EXPECT_GT(least, -kClock);
    EXPECT_LT(most, 3 * kClock);
  }
  std::printf("stamps of %u triggers within %.0f ns\n", triggers, worst);
}

// TM-108, over a real bus: state and pairs, the last offset, the time of the last TRIGGER.
TEST(RtlClock, TheHostReadsTheRow) {
  ClockBus bus{{50}};
  EXPECT_EQ(bus.read(3, 0xFC0, 4), std::vector<std::uint8_t>(4));
  lock(bus, 16);
  (void)bus.send(frame_of(0x000, {1}));
  (void)bus.send(frame_of(0x001, {1}));
  const std::uint64_t stat = number(bus.read(3, 0xFC0, 4));
  EXPECT_EQ(stat & 3, kLocked);
  EXPECT_EQ(stat >> 4 & 15, 15U);    // SC of the last pair
  EXPECT_EQ(stat >> 8 & 0xFF, 15U);  // pairs behind the first
  const auto offset = static_cast<std::int32_t>(number(bus.read(3, 0xFC4, 4)));
  EXPECT_LT(std::abs(offset), 200);
  const std::uint64_t low = number(bus.read(3, 0xFC8, 4)), high = number(bus.read(3, 0xFCC, 4));
  EXPECT_LT(std::abs(error(high << 32 | low, bus.nodes[0]->applied.back())), 3 * kClock);
}

// TM-109: user logic stamps an event of its own.
TEST(RtlClock, UserLogicTakesTheTime) {
  ClockBus bus{{-80}};
  lock(bus);
  for (unsigned event = 0; event < 12; ++event) {
    SCOPED_TRACE(event);
    bus.run(bus.bus.now() + 1'234'567'891 * (event + 1));
    bus.nodes[0]->take_time();
    const Time at = bus.bus.now();
    bus.run(at + 10 * ClockBus::kBit);
    const std::uint64_t taken = bus.nodes[0]->taken();
    EXPECT_LT(std::abs(error(taken, at)), 3 * kClock);
    bus.run(at + 100 * ClockBus::kBit);
    EXPECT_EQ(bus.nodes[0]->taken(), taken);
  }
}

// TM-103: another master may have any date; the node follows the second of its pairs.
TEST(RtlClock, TheDateMayBeAny) {
  ClockBus bus{{-80}};
  lock(bus);
  std::mt19937 random{20};
  for (unsigned master = 0; master < 12; ++master) {
    SCOPED_TRACE(master);
    bus.epoch = std::uint64_t{random()} * 1'000'000'000 + random() % 1'000'000'000;
    lock(bus, 3);
    bus.nodes[0]->take_time();
    const Time at = bus.bus.now();
    bus.run(at + 10 * ClockBus::kBit);
    const std::uint64_t wanted = bus.epoch + at / 1000;
    EXPECT_LT(std::abs(static_cast<std::int64_t>(bus.nodes[0]->taken() - wanted)), 2000);
  }
  bus.nodes[0]->reset();
  bus.nodes[0]->take_time();
  bus.run(bus.bus.now() + 10 * ClockBus::kBit);
  EXPECT_EQ(bus.nodes[0]->time_state(), 0U);
  EXPECT_LT(bus.nodes[0]->taken(), 2000U);
}

// TM-107: SYNC and FUP are no requests: they do not keep the watchdog quiet, nothing is counted,
// and no answer follows. The clock goes on in SAFE and behind a RESTART.
TEST(RtlClock, PairsAreNoRequests) {
  ClockBus bus{{20}};
  (void)bus.send(frame_of(3U << 7 | 0x7C, {1, 0, 0, 0, 0}));      // UNLOCK, serial number 0
  (void)bus.send(frame_of(3U << 7 | 0x79, {0x02, 0x0F, 50, 0}));  // WDT: 50 ms
  (void)bus.send(frame_of(0x000, {1}));
  ASSERT_EQ(bus.nodes[0]->state(), RemoteState::kOperate);
  const std::uint32_t counts = bus.word(0, 0xFF4) >> 8;  // accepted, refused
  bus.host.received().clear();
  lock(bus);  // 200 ms
  EXPECT_EQ(bus.nodes[0]->state(), RemoteState::kSafe);
  EXPECT_EQ(bus.word(0, 0xFF4) >> 8 & 0xFFFF, counts & 0xFFFF);
  EXPECT_EQ(bus.host.received().size(), 0U);
  EXPECT_EQ(bus.nodes[0]->time_state(), kLocked);
  (void)bus.send(frame_of(0x000, {0x81}));
  bus.run(bus.bus.now() + 2 * kMillisecond);
  EXPECT_EQ(bus.nodes[0]->state(), RemoteState::kSafe);
  EXPECT_EQ(bus.nodes[0]->time_state(), kLocked);
  bus.nodes[0]->pulses.clear();
  bus.run(bus.bus.now() + 10 * kMillisecond);
  ASSERT_GE(bus.nodes[0]->pulses.size(), 9U);
  for (const Time pulse : bus.nodes[0]->pulses) {
    const double at = ClockBus::master(pulse), late = at - std::round(at / kMs) * kMs;
    EXPECT_LT(std::abs(late - kClock), 2 * kClock);
  }
}

// TM-106: without the parameter there is no clock at the pins.
TEST(RtlClock, IsAnOption) {
  SerialContext context;
  Vcan_remote_whole top{&context, "without"};
  top.can_rx_i = 1;
  top.rst_ni = 0;
  rising_edge(top, top.clk_i);
  top.rst_ni = 1;
  top.time_take_i = 1;
  unsigned seen = 0;
  for (unsigned i = 0; i < 20'000; ++i) {
    rising_edge(top, top.clk_i);
    seen |= top.pps_o | top.time_state_o | (top.time_o != 0 ? 1U : 0U);
  }
  EXPECT_EQ(seen, 0U);
  top.final();
}

}  // namespace
}  // namespace vericansim
