// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver on cores with the time unit: clock, stamps, launch times, a time domain.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "driver/driver_node.hpp"
#include "time/time_rig.hpp"
#include "verican/timesync.h"

namespace vericansim {
namespace {

/// Nodes with their driver and a time domain; software runs once in 200 us of the bus.
struct Domain {
  explicit Domain(const std::vector<double> &errors_ppm) {
    for (const double ppm : errors_ppm) {
      ClockConfig clock;
      clock.error_ppm = ppm;
      auto rtl = std::make_unique<TimeNode>("node" + std::to_string(nodes.size()), clock);
      nodes.push_back(std::make_unique<DriverNode>(std::move(rtl), clock));
      bus.add(nodes.back()->rtl());
    }
    for (const auto &node : nodes) EXPECT_EQ(node->up(), VERICAN_OK);
    tsyns.resize(nodes.size());
  }
  void run(Time duration) {
    const Time end = bus.now() + duration;
    for (Time next = bus.now(); bus.now() < end;) {
      bus.step();
      for (const auto &node : nodes) node->serve();
      if (bus.now() < next) continue;
      next = bus.now() + 200 * kMicrosecond;
      for (std::size_t n = 0; n < nodes.size(); ++n) software(n);
    }
  }
  void software(std::size_t n) {
    for (const verican_frame_t &frame : nodes[n]->received())
      if (verican_tsyn_on_frame(&tsyns[n], &frame) != VERICAN_OK) others.push_back(frame);
    verican_tsyn_poll(&tsyns[n]);
  }
  void start(const verican_tsyn_config_t &config) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      EXPECT_EQ(verican_tsyn_init(&tsyns[n], &nodes[n]->dev, &config), VERICAN_OK);
      EXPECT_EQ(
          n == 0 ? verican_tsyn_start_master(&tsyns[n]) : verican_tsyn_start_follower(&tsyns[n]),
          VERICAN_OK);
      verican_tsyn_t *tsyn = &tsyns[n];
      nodes[n]->when_sent = [tsyn](const verican_tx_event_t &event) {
        verican_tsyn_on_sent(tsyn, &event);
      };
    }
  }

  Bus bus;
  std::vector<std::unique_ptr<DriverNode>> nodes;
  std::vector<verican_tsyn_t> tsyns;
  std::vector<verican_frame_t> others;  ///< received, none of the domain
};

double apart(std::uint64_t a, std::uint64_t b) {
  return static_cast<double>(static_cast<std::int64_t>(a - b));
}

// TM-10, TM-91: what the functions of the clock do to the clock.
TEST(DriverTime, Clock) {
  Domain domain{{0}};
  verican_t *dev = &domain.nodes[0]->dev;
  const auto now = [&domain, dev] {
    domain.run(2 * kMicrosecond);  // a command acts some clocks later
    std::uint64_t time = 0;
    EXPECT_EQ(verican_clock_get(dev, &time), VERICAN_OK);
    return time;
  };
  std::uint64_t increment = 0;
  EXPECT_EQ(verican_clock_set(dev, 0xFFFF'FFF0), VERICAN_OK);
  const std::uint64_t before = now();
  EXPECT_LT(before - 0xFFFF'FFF0, 5'000u);
  EXPECT_EQ(verican_clock_shift(dev, -1'000'000'000), VERICAN_OK);
  EXPECT_LT(now() + 1'000'000'000 - before, 5'000u);
  EXPECT_EQ(verican_clock_increment(dev, &increment), VERICAN_OK);
  EXPECT_EQ(increment, kTimeStep << 32);
  EXPECT_EQ(verican_clock_rate(dev, 0), VERICAN_OK);
  const std::uint64_t stopped = now();
  EXPECT_EQ(now(), stopped);
}

// TM-15, TM-91: a time that is set is not changed by a slew that was ordered before, nor is that of
// a device that is set up anew; a shift adds to what the slew goes on to do.
TEST(DriverTime, SettingAndSettingUpEndASlew) {
  Domain domain{{0}};
  verican_t *dev = &domain.nodes[0]->dev;
  const auto passes = [&] {  // ns in 4 ms, in which a slew makes 3,906 steps
    std::uint64_t before = 0, behind = 0;
    domain.run(2 * kMicrosecond);
    EXPECT_EQ(verican_clock_get(dev, &before), VERICAN_OK);
    domain.run(4 * kMillisecond);
    EXPECT_EQ(verican_clock_get(dev, &behind), VERICAN_OK);
    return apart(behind, before);
  };
  const double usual = passes();
  ASSERT_EQ(verican_clock_slew(dev, 1'000'000), VERICAN_OK);
  EXPECT_NEAR(passes() - usual, 3'906, 400);
  ASSERT_EQ(verican_clock_shift(dev, -5'000), VERICAN_OK);
  EXPECT_NEAR(passes() - usual, 3'906, 400);
  ASSERT_EQ(verican_clock_set(dev, 0), VERICAN_OK);
  EXPECT_NEAR(passes() - usual, 0, 300);
  ASSERT_EQ(verican_clock_slew(dev, 1'000'000), VERICAN_OK);
  ASSERT_EQ(domain.nodes[0]->up(), VERICAN_OK);
  EXPECT_NEAR(passes() - usual, 0, 300);
}

// TM-31, TM-91: the pulses rise with the seconds of the time that the clock has jumped to, and not
// before.
TEST(DriverTime, PulsesAreThoseOfTheTime) {
  Domain domain{{0}};
  DriverNode &node = *domain.nodes[0];
  const auto rises_at = [&] {  // ns from the last second, by the clock; 0: it does not
    const Time end = domain.bus.now() + 4 * kMillisecond;
    while (domain.bus.now() < end && !node.rtl().time_out()) domain.bus.step();
    std::uint64_t now = 0;
    EXPECT_EQ(verican_clock_get(&node.dev, &now), VERICAN_OK);
    return node.rtl().time_out() ? now % 1'000'000'000 : 0;
  };
  constexpr std::uint64_t kSecond = 1'000'000'000;
  EXPECT_EQ(verican_clock_set(&node.dev, 998'000'000), VERICAN_OK);
  EXPECT_EQ(verican_clock_pps(&node.dev, true), VERICAN_OK);
  for (const std::uint64_t second : {1'700'000'000ULL, 1'600'000'000ULL, 5ULL}) {
    EXPECT_LT(rises_at() - 1, 3'000u) << second;
    EXPECT_EQ(verican_clock_set(&node.dev, second * kSecond + 998'000'000), VERICAN_OK);
    domain.bus.run_for(2 * kMicrosecond);  // a command acts some clocks later
    EXPECT_FALSE(node.rtl().time_out());
  }
  EXPECT_LT(rises_at() - 1, 3'000u);
  EXPECT_EQ(verican_clock_shift(&node.dev, 7 * kSecond + 998'000'000), VERICAN_OK);
  domain.bus.run_for(2 * kMicrosecond);
  EXPECT_LT(rises_at() - 1, 3'000u);
}

// TM-31, TM-91: a jump while the pin is high, and pulses that are asked for anew, lower it; it does
// not rise again before the next whole second.
TEST(DriverTime, AJumpLowersThePinOnce) {
  Domain domain{{0}};
  DriverNode &node = *domain.nodes[0];
  verican_t *dev = &node.dev;
  auto &rtl = dynamic_cast<TimeNode &>(node.rtl());
  const auto changes_by = [&](auto jump) {  // of the pin, which was high
    EXPECT_EQ(verican_clock_set(dev, 998'000'000), VERICAN_OK);
    EXPECT_EQ(verican_clock_pps(dev, true), VERICAN_OK);
    const Time end = domain.bus.now() + 4 * kMillisecond;
    while (domain.bus.now() < end && !rtl.time_out()) domain.bus.step();
    EXPECT_TRUE(rtl.time_out());
    const std::size_t before = rtl.pulses().size();
    EXPECT_EQ(jump(), VERICAN_OK);
    domain.bus.run_for(20 * kMicrosecond);
    EXPECT_FALSE(rtl.time_out());
    return rtl.pulses().size() - before;
  };
  EXPECT_EQ(changes_by([&] { return verican_clock_set(dev, 5'300'000'000); }), 1u);
  EXPECT_EQ(changes_by([&] { return verican_clock_shift(dev, 300'000'000); }), 1u);
  EXPECT_EQ(changes_by([&] { return verican_clock_shift(dev, -300'000'000); }), 1u);
  EXPECT_EQ(changes_by([&] { return verican_clock_pps(dev, true); }), 1u);
  EXPECT_EQ(changes_by([&] {
              (void)verican_clock_pps(dev, false);
              return verican_clock_pps(dev, true);
            }),
            1u);
}

// TM-91: a slew and an event of the compare unit that were over before somebody asked are not told;
// the next ones are.
TEST(DriverTime, EventsOfBeforeAreNotTold) {
  Domain domain{{0}};
  DriverNode &node = *domain.nodes[0];
  verican_t *dev = &node.dev;
  auto &rtl = dynamic_cast<TimeNode &>(node.rtl());
  std::vector<std::uint32_t> told;
  const auto on_event = [](void *user, verican_t *, std::uint32_t flags, std::uint64_t) {
    static_cast<std::vector<std::uint32_t> *>(user)->push_back(flags);
  };
  const auto run = [&](Time duration) {
    for (const Time end = domain.bus.now() + duration; domain.bus.now() < end;) {
      domain.bus.step();
      if (rtl.irq_time()) verican_clock_irq_handler(dev);
    }
  };
  EXPECT_EQ(verican_clock_set(dev, 998'000'000), VERICAN_OK);
  EXPECT_EQ(verican_clock_pps(dev, true), VERICAN_OK);
  EXPECT_EQ(verican_clock_slew(dev, 3), VERICAN_OK);
  run(3 * kMillisecond);
  const std::uint32_t events = VERICAN_CLOCK_SLEWED | VERICAN_CLOCK_COMPARE;
  EXPECT_EQ(verican_clock_on_event(dev, events, on_event, &told), VERICAN_OK);
  run(100 * kMicrosecond);
  EXPECT_EQ(told, std::vector<std::uint32_t>{});
  EXPECT_EQ(verican_clock_slew(dev, 3), VERICAN_OK);
  run(100 * kMicrosecond);
  EXPECT_EQ(told, std::vector<std::uint32_t>{VERICAN_TSTAT_SLEWD_MASK});
}

// TM-26 to TM-28, TM-91: sender and receiver tell the same time of the same edge, within a clock of
// the receiver.
TEST(DriverTime, StampsOfAFrame) {
  Domain domain{{0, 37}};
  const auto clocks = [&domain](unsigned n) {
    std::uint64_t time = 0;
    verican_clock_get(&domain.nodes[n]->dev, &time);
    return time;
  };
  for (int n = 0; n < 20; ++n) {
    const verican_frame_t frame = driver_frame(0x100);
    EXPECT_EQ(verican_send(&domain.nodes[0]->dev, &frame, nullptr), VERICAN_OK);
    domain.run(200 * kMicrosecond);
    domain.run(13 * kMicrosecond);
  }
  const auto &sent = domain.nodes[0]->events;
  ASSERT_EQ(sent.size(), 20u);
  ASSERT_EQ(domain.others.size(), 20u);
  EXPECT_LT(sent.back().time_ns, clocks(0));
  // Both clocks began together: what is left is the drift, and the phase of the clocks.
  const double start = apart(domain.others[0].time_ns, sent[0].time_ns);
  EXPECT_LE(std::abs(start), 2 * kTimeStep);
  for (std::size_t n = 1; n < sent.size(); ++n) {
    const double later = apart(sent[n].time_ns, sent[0].time_ns);
    EXPECT_NEAR(apart(domain.others[n].time_ns, sent[n].time_ns), start + later * 37e-6,
                kTimeStep + 1.0);
  }
}

// TM-40, TM-91: a frame goes out at its time, not earlier, and one to come lets others pass.
TEST(DriverTime, SendAt) {
  Domain domain{{0, 0}};
  verican_t *dev = &domain.nodes[0]->dev;
  std::uint64_t now = 0;
  verican_clock_get(dev, &now);
  const verican_frame_t at = driver_frame(0x001), other = driver_frame(0x700);
  const std::uint64_t launch = now + 1'000'000;
  ASSERT_EQ(verican_clock_point(dev, VERICAN_STAMP_SOF, false), VERICAN_OK);
  ASSERT_EQ(verican_send_at(dev, &at, launch, nullptr), VERICAN_OK);
  ASSERT_EQ(verican_send(dev, &other, nullptr), VERICAN_OK);
  EXPECT_EQ(verican_send_at(dev, &at, now + 5'000'000, nullptr), VERICAN_ERR_BUSY);
  domain.run(2 * kMillisecond);
  const auto &sent = domain.nodes[0]->events;
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_LT(sent[0].time_ns, launch);
  EXPECT_GE(sent[1].time_ns, launch);
  EXPECT_LE(sent[1].time_ns, launch + 2'000);  // two bits
}

// TM-91: a master and a follower 100 ppm away lock, and then tell the same time of the same edge.
TEST(DriverTime, FollowerLocks) {
  Domain domain{{-30, 70}};
  verican_clock_set(&domain.nodes[0]->dev, 1'700'000'000'000'000'000);
  verican_tsyn_config_t config{};
  verican_tsyn_config_default(&config);
  config.masters[0] = 0x010;
  config.servo.interval_us = 50'000;
  config.servo.filter = 8;
  domain.start(config);
  domain.run(420 * kMillisecond);
  verican_tsyn_status_t status{};
  ASSERT_EQ(verican_tsyn_status(&domain.tsyns[1], &status), VERICAN_OK);
  EXPECT_EQ(status.state, VERICAN_SYNC_LOCKED);
  const verican_frame_t frame = driver_frame(0x100);
  domain.nodes[0]->events.clear();
  EXPECT_EQ(verican_send(&domain.nodes[0]->dev, &frame, nullptr), VERICAN_OK);
  domain.run(kMillisecond);
  ASSERT_EQ(domain.others.size(), 1u);
  ASSERT_FALSE(domain.nodes[0]->events.empty());
  // The clock is within its bound, and the stamp within half a clock.
  EXPECT_LE(std::abs(apart(domain.others[0].time_ns, domain.nodes[0]->events.back().time_ns)),
            1.5 * kTimeStep + 2);
}

}  // namespace
}  // namespace vericansim
