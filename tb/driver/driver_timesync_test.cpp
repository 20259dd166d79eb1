// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Time domains with the whole driver on cores without RTL: master and followers, loss and change of
// the master, the delay measured.
#include <gtest/gtest.h>

#include "driver/clocked_core.hpp"

namespace vericansim {
namespace {

constexpr double kPeriod = 62.5;  // ns, 16 MHz

// Four masters, 0x010 to 0x013.
verican_tsyn_config_t config_of(std::uint8_t masters = 1, std::uint8_t rank = 0) {
  verican_tsyn_config_t config{};
  verican_tsyn_config_default(&config);
  config.servo.interval_us = 200'000;
  config.servo.filter = 8;
  for (std::uint8_t n = 0; n < masters; ++n) config.masters[n] = 0x010u + n;
  config.master_count = masters;
  config.rank = rank;
  config.delay_request = 0x020;
  config.delay_response = 0x021;
  return config;
}

// A master and followers that have locked.
void with_one_master(DomainBus &bus, const verican_tsyn_config_t &config, unsigned followers = 3) {
  bus.add().set_up(config, true);
  for (unsigned n = 0; n < followers; ++n) bus.add().set_up(config, false);
}

// Largest error of the nodes against node `to`.
double worst(DomainBus &bus, unsigned to = 0) {
  double max = 0;
  for (unsigned n = 0; n < bus.nodes.size(); ++n)
    max = std::max(max, static_cast<double>(std::abs(bus.error(n, to))));
  return max;
}

// TM-91: a master and three followers, from power-on to the bound of the filter.
TEST(TimeSync, FollowersFollow) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    DomainBus bus{seed};
    with_one_master(bus, config_of());
    bus.run(0.1);  // the first pair, which steps
    EXPECT_NE(bus.nodes[1]->status().shift_ns, 0) << seed;
    bus.run(4);
    double max = 0;
    bus.run(10, [&] { max = std::max(max, worst(bus)); });
    EXPECT_LE(max, 0.92 * kPeriod + 2) << seed;
    const auto status = bus.nodes[1]->status();
    EXPECT_EQ(status.state, VERICAN_SYNC_LOCKED);
    EXPECT_EQ(status.master, 0);
    EXPECT_EQ(status.filter, 8);
    EXPECT_LT(status.bound_ns, 60u);
    EXPECT_LE(std::abs(status.shift_ns), 100);
    EXPECT_FALSE(status.sending);
    EXPECT_TRUE(bus.nodes[0]->status().sending);
    for (const auto refused : status.refused) EXPECT_EQ(refused, 0);
  }
}

// TM-50: SYNC every interval, FUP with its counter behind it.
TEST(TimeSync, MasterKeepsItsInterval) {
  DomainBus bus{50};
  with_one_master(bus, config_of(), 1);
  unsigned frames = 0;
  bus.lost = [&frames](std::uint32_t id) {
    frames += id == 0x010 ? 1 : 0;
    return false;
  };
  bus.run(10);
  EXPECT_NEAR(frames, 2 * 10 / 0.2, 4);
}

// TM-50: a SYNC that does not get out within R is aborted, no FUP follows it, and the next goes on.
TEST(TimeSync, SyncThatDoesNotGetOut) {
  DomainBus bus{51};
  with_one_master(bus, config_of(), 1);
  bus.run(2);
  DomainNode &master = *bus.nodes[0];
  master.connected = false;
  bus.run(0.201);
  verican_stats_t before = master.dev.stats;
  unsigned waiting = 0;
  bus.run(1, [&] {
    std::uint8_t count = 0;
    verican_tx_waiting(&master.dev, &count);
    waiting = std::max<unsigned>(waiting, count);
  });
  EXPECT_EQ(waiting, 1u);
  EXPECT_NEAR(master.dev.stats.aborted - before.aborted, 5, 1);
  EXPECT_TRUE(master.status().sending);  // there is no other
  master.connected = true;
  bus.run(2);
  EXPECT_EQ(bus.nodes[1]->status().state, VERICAN_SYNC_LOCKED);
  EXPECT_LE(worst(bus), 1.5 * kPeriod + 2);
}

// TM-50: without a free mailbox SYNC waits, and no counter is left out.
TEST(TimeSync, NoMailboxForSync) {
  DomainBus bus{52};
  verican_tsyn_config_t config = config_of();
  config.rules.jump_width = 1;
  with_one_master(bus, config, 1);
  bus.run(2);
  DomainNode &master = *bus.nodes[0];
  master.connected = false;
  verican_frame_t frame{};
  frame.id = 0x700;
  while (verican_send(&master.dev, &frame, nullptr) == VERICAN_OK) continue;
  bus.run(0.5);
  master.connected = true;
  bus.run(2);
  EXPECT_EQ(bus.nodes[1]->status().state, VERICAN_SYNC_LOCKED);
  for (const auto refused : bus.nodes[1]->status().refused) EXPECT_EQ(refused, 0);
}

// TM-87: the master falls silent: holdover, and back.
TEST(TimeSync, Holdover) {
  DomainBus bus{87};
  verican_tsyn_config_t config = config_of();
  unsigned states = 0;
  config.user = &states;
  config.on_event = [](void *user, verican_tsyn_t *, std::uint8_t events) {
    *static_cast<unsigned *>(user) += (events & VERICAN_SERVO_STATE) != 0 ? 1 : 0;
  };
  with_one_master(bus, config, 1);
  bus.run(5);
  EXPECT_EQ(states, 2u);
  bus.lost = [](std::uint32_t) { return true; };
  bus.run(0.35);
  EXPECT_EQ(bus.nodes[1]->status().state, VERICAN_SYNC_LOCKED);
  bus.run(0.5);
  EXPECT_EQ(bus.nodes[1]->status().state, VERICAN_SYNC_HOLDOVER);
  EXPECT_EQ(states, 3u);
  bus.run(20);
  EXPECT_LE(worst(bus), static_cast<double>(bus.nodes[1]->status().bound_ns));
  bus.lost = {};
  bus.run(2);
  EXPECT_EQ(bus.nodes[1]->status().state, VERICAN_SYNC_LOCKED);
}

// TM-58: the delay of the bus, measured by eight exchanges, and then corrected.
TEST(TimeSync, DelayIsMeasured) {
  DomainBus bus{58};
  bus.delay = 750;
  verican_tsyn_config_t config = config_of();
  with_one_master(bus, config, 1);
  bus.run(5);
  EXPECT_NEAR(static_cast<double>(bus.error(1, 0)), -750, kPeriod);
  EXPECT_EQ(verican_tsyn_measure(&bus.nodes[1]->tsyn, 8), VERICAN_OK);
  bus.run(5);
  EXPECT_NEAR(bus.nodes[1]->status().delay_ns, 750, 0.3 * kPeriod);
  EXPECT_NEAR(static_cast<double>(bus.error(1, 0)), 0, kPeriod);
}

/// Three candidates and a follower, locked to the first.
void with_three_masters(DomainBus &bus) {
  for (std::uint8_t rank = 0; rank < 3; ++rank) bus.add().set_up(config_of(3, rank), true);
  bus.add().set_up(config_of(3), false);
}

unsigned masters_now(const DomainBus &bus) {
  unsigned mask = 0;
  for (unsigned n = 0; n < bus.nodes.size(); ++n)
    mask |= bus.nodes[n]->status().sending ? 1u << n : 0u;
  return mask;
}

// TM-89: all start together: the best becomes the master, the others never begin.
TEST(Redundancy, TwoStartTogether) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    DomainBus bus{seed};
    with_three_masters(bus);
    unsigned ever = 0;
    bus.run(3, [&] { ever |= masters_now(bus); });
    EXPECT_EQ(ever, 1u);
    double max = 0;
    bus.run(5, [&] { max = std::max(max, worst(bus)); });
    EXPECT_LE(max, 3 * kPeriod);
  }
}

// TM-89: the master is cut off: the next takes over with its clock as it stands; no jump anywhere.
// It returns, follows until it is locked, and is the master again.
TEST(Redundancy, MasterCutAndReturns) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    DomainBus bus{seed};
    with_three_masters(bus);
    bus.run(8);
    ASSERT_EQ(masters_now(bus), 1u);
    bus.nodes[0]->connected = false;
    // Of the three that are left, against the new master.
    const auto rest = [&bus] {
      return static_cast<double>(std::max(std::abs(bus.error(2, 1)), std::abs(bus.error(3, 1))));
    };
    double max = 0;
    bus.run(10, [&] { max = std::max(max, rest()); });
    EXPECT_LE(max, 3 * kPeriod) << seed;
    EXPECT_EQ(masters_now(bus) & 0xEu, 2u);
    EXPECT_EQ(bus.nodes[3]->status().master, 1);
    EXPECT_EQ(bus.nodes[3]->status().state, VERICAN_SYNC_LOCKED);
    EXPECT_FALSE(bus.nodes[0]->status().sending);  // it sees that nobody hears it
    bus.nodes[0]->connected = true;
    unsigned ever = 0;
    max = 0;
    bus.run(10, [&] {
      max = std::max(max, rest());
      ever |= masters_now(bus);
    });
    EXPECT_LE(max, 3 * kPeriod) << seed;
    EXPECT_EQ(ever & 0xCu, 0u);
    EXPECT_EQ(masters_now(bus), 1u) << seed;
    EXPECT_EQ(bus.nodes[3]->status().master, 0);
    EXPECT_LE(worst(bus), 3 * kPeriod);
  }
}

// TM-89: a worse master that is heard is followed, but not by who is master itself.
TEST(Redundancy, WorseMasterIsIgnored) {
  DomainBus bus{3};
  with_three_masters(bus);
  bus.run(3);
  verican_frame_t frame{};
  frame.id = 0x012;
  frame.dlc = 8;
  frame.data[0] = 0x10;
  frame.data[7] = 99;
  EXPECT_EQ(verican_tsyn_on_frame(&bus.nodes[0]->tsyn, &frame), VERICAN_OK);
  EXPECT_TRUE(bus.nodes[0]->status().sending);
  EXPECT_EQ(verican_tsyn_on_frame(&bus.nodes[3]->tsyn, &frame), VERICAN_OK);
  EXPECT_EQ(bus.nodes[3]->status().master, 0);
}

// TM-89: who is the only one sends from the start; of several nobody does, and one that was cut off
// and is started again has forgotten it.
TEST(TimeSync, Starts) {
  DomainBus alone{90};
  alone.add().set_up(config_of(), true);
  EXPECT_TRUE(alone.nodes[0]->status().sending);
  alone.add().set_up(config_of(), false);
  EXPECT_FALSE(alone.nodes[1]->status().sending);
  DomainBus bus{91};
  with_three_masters(bus);
  EXPECT_EQ(masters_now(bus), 0u);
  bus.run(8);
  DomainNode &first = *bus.nodes[0];
  first.connected = false;
  bus.run(5);
  ASSERT_TRUE(first.tsyn.cut);
  EXPECT_EQ(verican_tsyn_start_master(&first.tsyn), VERICAN_OK);
  EXPECT_FALSE(first.tsyn.cut);
  EXPECT_FALSE(first.status().sending);
}

TEST(TimeSync, Arguments) {
  Nanoseconds now = 1e6;
  const Oscillator oscillator{16e6, {}, 1};
  DomainNode node{ClockNode{oscillator, 5}, &now};
  verican_tsyn_config_t config = config_of();
  verican_tsyn_t tsyn{};
  const verican_frame_t frame{};
  const verican_tx_event_t event{};
  verican_tsyn_status_t status{};
  EXPECT_EQ(verican_tsyn_config_default(nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_init(nullptr, &node.dev, &config), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_init(&tsyn, nullptr, &config), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_init(&tsyn, &node.dev, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_start_master(nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_poll(nullptr), VERICAN_ERR_NULL);
  const auto refused = [&](auto change) {
    verican_tsyn_config_t wrong = config_of();
    change(wrong);
    return verican_tsyn_init(&tsyn, &node.dev, &wrong) == VERICAN_ERR_RANGE;
  };
  EXPECT_TRUE(refused([](auto &c) { c.master_count = 0; }));
  EXPECT_TRUE(refused([](auto &c) { c.master_count = 5; }));
  EXPECT_TRUE(refused([](auto &c) { c.rank = 1; }));
  EXPECT_TRUE(refused([](auto &c) { c.rules.domain = 16; }));
  EXPECT_TRUE(refused([](auto &c) { c.rules.jump_width = 0; }));
  EXPECT_TRUE(refused([](auto &c) { c.rules.jump_width = 16; }));
  EXPECT_TRUE(refused([](auto &c) { c.rules.crc = 4; }));
  EXPECT_TRUE(refused([](auto &c) { c.servo.filter = 5; }));
  // Before it is started.
  ASSERT_EQ(verican_tsyn_init(&tsyn, &node.dev, &config), VERICAN_OK);
  EXPECT_EQ(verican_tsyn_poll(&tsyn), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_tsyn_on_frame(&tsyn, &frame), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_tsyn_on_sent(&tsyn, &event), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_tsyn_status(&tsyn, &status), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_tsyn_measure(&tsyn, 8), VERICAN_ERR_STATE);
  ASSERT_EQ(verican_tsyn_start_follower(&tsyn), VERICAN_OK);
  EXPECT_EQ(verican_tsyn_on_frame(&tsyn, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_on_sent(&tsyn, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_status(&tsyn, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tsyn_measure(&tsyn, 0), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_tsyn_on_frame(&tsyn, &frame), VERICAN_ERR_EMPTY);
  EXPECT_EQ(verican_tsyn_on_sent(&tsyn, &event), VERICAN_ERR_EMPTY);
  // Without identifiers nothing can be measured; a device that is gone has no clock.
  tsyn.config.delay_request = tsyn.config.delay_response;
  EXPECT_EQ(verican_tsyn_measure(&tsyn, 8), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_tsyn_on_frame(&tsyn, &frame), VERICAN_ERR_EMPTY);
  node.dev.time_unit = false;
  EXPECT_EQ(verican_tsyn_init(&tsyn, &node.dev, &config), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_tsyn_start_master(&tsyn), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_tsyn_poll(&tsyn), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_tsyn_status(&tsyn, &status), VERICAN_ERR_UNSUPPORTED);
}

}  // namespace
}  // namespace vericansim
