// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clocks without a processor on a bus with a master: TM-100, and what section 12 asks of the
// follower, at its pin.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "Vcan_time_node_16.h"
#include "Vcan_time_node_4.h"
#include "model/frame_codec.hpp"
#include "time/follower_bus.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr double kPpm = 1e-6, kNs = 1e3, kMs = 1e9, kSecond = 1e12;

// TM-100: no pulse before the clock is set; then they rise with the master's seconds. 4 MHz, 8
// clocks a bit, 4 pairs a second; one clock fast, one slow.
TEST(TimeNode, PpsFromReset) {
  const std::uint64_t epoch = 1'700'000'123'900'000'000;  // 0.1 s before a second
  const double period = 250 * kNs;
  FollowerBus<Vcan_time_node_4> bus{8 * period, epoch};
  bus.add(period * (1 - 90 * kPpm), 10 * kNs);
  bus.add(period * (1 + 90 * kPpm), 130 * kNs);
  bus.run(0.15 * kSecond);
  EXPECT_TRUE(bus.node(0).pulses().empty());
  EXPECT_EQ(bus.node(0).state(), 0u);
  const double first = bus.now();
  for (unsigned i = 0; i < 14; ++i) {
    bus.pair();
    if (i == 0) {
      EXPECT_EQ(bus.node(0).state(), 1u);
    }
    bus.run(first + (i + 1) * 0.25 * kSecond);
  }
  for (unsigned n = 0; n < 2; ++n) {
    EXPECT_EQ(bus.node(n).state(), 2u);
    // Behind the first step the output catches up at once; the master's seconds follow.
    unsigned seconds = 0;
    for (const double at : bus.node(n).pulses()) {
      if (at < 1 * kSecond) continue;
      const double late = at - (static_cast<double>(++seconds) + 0.1) * kSecond;
      // One to two clocks to the pin; 90 ppm of an interval until the rate is right.
      EXPECT_LT(std::abs(late - 1.5 * period), seconds == 1 ? 30'000 * kNs : 3 * period)
          << n << ' ' << seconds;
    }
    EXPECT_EQ(seconds, 3u);
  }
}

// Section 12, hardware follower with KD 2 and PHALF 1 at 16 MHz: sd 20 ns, at most 62 ns; here with
// R = 10 ms, and a pin, which adds one clock, evenly. Clocks +-100 ppm and 3 ppm off.
TEST(TimeNode, Accuracy) {
  const double period = 62.5 * kNs;
  FollowerBus<Vcan_time_node_16> bus{16 * period, 1'700'000'000'000'000'000};
  const double errors[] = {100, -100, 3};
  for (const double ppm : errors) bus.add(period * (1 + ppm * kPpm), ppm * 100 + 12'000);
  for (unsigned i = 0; i < 60; ++i) {
    bus.pair();
    bus.run((i + 1) * 10 * kMs);
  }
  for (unsigned n = 0; n < 3; ++n) {
    double sum = 0, square = 0, most = 0;
    unsigned count = 0;
    for (const double at : bus.node(n).pulses()) {
      if (at < 150 * kMs) continue;  // 13 pairs and a few more
      const double late = (at - std::round(at / kMs) * kMs - 1.5 * period) / kNs;
      sum += late;
      square += late * late;
      most = std::max(most, std::abs(late));
      ++count;
    }
    ASSERT_GT(count, 400u);
    const double mean = sum / count, sd = std::sqrt(square / count - mean * mean);
    std::printf("%+.0f ppm: mean %.1f, sd %.1f, at most %.1f ns of %u pulses\n", errors[n], mean,
                sd, most, count);
    EXPECT_EQ(bus.node(n).state(), 2u);
    EXPECT_LT(most, 62 + 62.5 / 2);
    EXPECT_LT(sd, std::hypot(20, 62.5 / std::sqrt(12.0)));
  }
}

/// Pairs of the master, 10 ms from one's begin to the next one's.
void run_pairs(FollowerBus<Vcan_time_node_16> &bus, unsigned count) {
  for (; count != 0; --count) {
    const double begin = bus.now();
    bus.pair();
    bus.run(begin + 10 * kMs);
  }
}

// TM-103, TM-104: the state at the pins, with a master that falls silent for more than 2^TMO ns,
// here 2^25, comes back, and with a reset.
TEST(TimeNode, StateFollowsTheMaster) {
  const double period = 62.5 * kNs;
  FollowerBus<Vcan_time_node_16> bus{16 * period, 1'700'000'000'000'000'000};
  bus.add(period * (1 + 20 * kPpm), 1'000);
  const auto pairs = [&bus](unsigned count) {
    run_pairs(bus, count);
    return bus.node(0).state();
  };
  EXPECT_EQ(bus.node(0).state(), 0u);
  EXPECT_EQ(pairs(3), 1u);
  EXPECT_EQ(pairs(40), 2u);
  bus.run(bus.now() + 20 * kMs);
  EXPECT_EQ(bus.node(0).state(), 2u);
  bus.run(bus.now() + 20 * kMs);
  EXPECT_EQ(bus.node(0).state(), 3u);
  EXPECT_EQ(pairs(1), 1u);
  EXPECT_EQ(pairs(14), 2u);
  bus.node(0).reset();
  EXPECT_EQ(bus.node(0).state(), 0u);
  EXPECT_EQ(pairs(2), 1u);
}

// TM-104: a master that comes back while the output is 1 makes no edge of its own: a pair is in the
// clock half a ms behind its begin, and pulses are 1 for as long.
TEST(TimeNode, HoldoverLeavesThePulses) {
  const double period = 62.5 * kNs;
  FollowerBus<Vcan_time_node_16> bus{16 * period, 1'700'000'000'000'000'000};
  bus.add(period * (1 + 20 * kPpm), 1'000);
  run_pairs(bus, 16);
  bus.run(bus.now() + 40 * kMs);
  ASSERT_EQ(bus.node(0).state(), 3u);
  run_pairs(bus, 3);
  ASSERT_EQ(bus.node(0).state(), 1u);
  bus.run(bus.now() + 0.25 * kMs);
  unsigned ms = 20;  // the step of the first pair is over
  for (const double at : bus.node(0).pulses()) {
    if (at > 19.5 * kMs) {
      EXPECT_NEAR(at, ms++ * kMs, 3'000 * kNs);
    }
  }
  EXPECT_EQ(ms, 231u);
}

// Clocks from a start of frame to the node's ACK, if what follows the last edge to dominant before
// it comes `late` clocks late; 16 clocks, of one quantum each, a bit.
unsigned clocks_to_ack(unsigned late) {
  constexpr unsigned kBit = 16;
  const auto levels = levels_of(
      encode_frame({.id = 0x123, .dlc = 1, .data = {0x55}}, {.ack_slot = Level::kRecessive}).bits);
  std::size_t edge = levels.size() - 1;
  while (levels[edge] != Level::kDominant || levels[edge - 1] != Level::kRecessive) --edge;
  LeafModel<Vcan_time_node_16> node;
  node->can_rx_i = 1;
  node.reset();
  for (unsigned i = 0; i < 12 * kBit; ++i) node.clock();
  unsigned clocks = 0;
  for (std::size_t bit = 0; bit < levels.size(); ++bit) {
    node->can_rx_i = static_cast<std::uint8_t>(levels[bit]);
    for (unsigned n = bit + 1 == edge ? kBit + late : kBit; n > 0; --n, ++clocks) {
      node.clock();
      if (node->can_tx_o == 0) return clocks;
    }
  }
  return 0;
}

// SY-08, TM-100: its engine follows an edge by `Sjw` quanta at most, here two.
TEST(TimeNode, SynchronisesBySjw) {
  const unsigned in_time = clocks_to_ack(0);
  ASSERT_GT(in_time, 16u * 43);  // bits before the ACK, stuff bits apart
  for (const auto &[late, followed] : {std::pair{1u, 1u}, {2u, 2u}, {3u, 2u}, {5u, 2u}})
    EXPECT_EQ(clocks_to_ack(late) - in_time, followed) << late;
}

}  // namespace
}  // namespace vericansim
