// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The servo's decisions: states, outliers, leaps, holdover. 2 T of the rig's clock are 125 ns.
#include <gtest/gtest.h>

#include <memory>

#include "driver/servo_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kAccepted = VERICAN_SERVO_ACCEPTED, kOutlier = VERICAN_SERVO_OUTLIER,
                   kLeap = VERICAN_SERVO_LEAP, kStep = VERICAN_SERVO_STEP,
                   kState = VERICAN_SERVO_STATE;

// TM-87: one pair steps, four lock, three intervals of silence hold.
TEST(Servo, States) {
  for (const int filter : {1, 2, 4, 8, 16}) {
    ServoRig rig{static_cast<std::uint8_t>(filter)};
    EXPECT_EQ(rig.state(), VERICAN_SYNC_UNSYNCHRONISED);
    EXPECT_FALSE(rig.poll(1'000 * kSecondNs));
    const auto first = rig.pair(-5 * kSecondNs);
    EXPECT_EQ(first.events, kAccepted | kStep | kState);
    EXPECT_EQ(first.shift, 5 * kSecondNs);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING);
    EXPECT_EQ(rig.pair(20'000).events, kAccepted);
    EXPECT_EQ(rig.pair(10).events, kAccepted);
    EXPECT_EQ(rig.pair(0).events, kAccepted | kState);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
    EXPECT_FALSE(rig.poll(3 * kSecondNs - 1000));
    EXPECT_TRUE(rig.poll(3 * kSecondNs + 1000));
    EXPECT_EQ(rig.state(), VERICAN_SYNC_HOLDOVER);
    EXPECT_FALSE(rig.poll(4 * kSecondNs));
    const std::uint64_t rate = rig.increment;
    EXPECT_EQ(rig.pair(300, 100 * kSecondNs).events, kAccepted | kState);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING);
    EXPECT_EQ(rig.increment, rate);  // one pair says nothing of the rate
    for (int n = 0; n < 3; ++n) rig.pair(0);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
  }
}

// TM-87: a filter that has to be chosen locks with the twelfth pair, and once it is chosen with the
// fourth, as the others.
TEST(Servo, AutomaticLocksWhenItHasChosen) {
  ServoRig rig{0};
  for (int n = 1; n < 12; ++n) {
    rig.pair(n == 1 ? 1'000'000 : 0);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING) << n;
  }
  EXPECT_EQ(rig.pair(0).events, kAccepted | kState);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
  ASSERT_TRUE(rig.poll(4 * kSecondNs));
  for (int n = 1; n < 4; ++n) {
    rig.pair(0);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING) << n;
  }
  rig.pair(0);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
}

// TM-87: one who was away before it was locked knows nothing of the filter any more.
TEST(Servo, AutomaticBeginsAnewAfterSilence) {
  ServoRig rig{0};
  for (int n = 0; n < 11; ++n) rig.pair(0);
  ASSERT_TRUE(rig.poll(4 * kSecondNs));
  EXPECT_EQ(rig.state(), VERICAN_SYNC_UNSYNCHRONISED);
  for (int n = 0; n < 11; ++n) rig.pair(0);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING);
  rig.pair(0);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
}

// TM-85: from the fifth pair on one is dropped before LOCKED too, none sooner.
TEST(Servo, OutlierBeforeLocked) {
  for (unsigned pairs = 2; pairs < 11; ++pairs) {
    ServoRig rig{0};
    for (unsigned n = 0; n < pairs; ++n) rig.pair(0);
    EXPECT_EQ(rig.pair(5'000).events, pairs < 4 ? kAccepted : kOutlier) << pairs;
    EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING) << pairs;
  }
}

// TM-87: the number of intervals can be set; who was never locked has nothing to hold.
TEST(Servo, HoldsAfterSoManyIntervals) {
  verican_servo_config_t config = ServoRig::defaults();
  config.hold_after = 5;
  config.interval_us = 200'000;
  ServoRig rig{config};
  rig.pair(0);
  EXPECT_FALSE(rig.poll(kSecondNs));
  EXPECT_TRUE(rig.poll(kSecondNs + 1));
  EXPECT_EQ(rig.state(), VERICAN_SYNC_UNSYNCHRONISED);
  EXPECT_NE(rig.pair(7).events & kStep, 0u);
}

// TM-87: the bound in holdover: the last mean error, and the drift since.
TEST(Servo, HoldoverBound) {
  ServoRig rig;
  rig.lock();
  const auto bound = [&rig](std::int64_t behind) {
    return verican_servo_bound(&rig.servo, static_cast<std::uint64_t>(rig.master + behind));
  };
  EXPECT_EQ(bound(2 * kSecondNs), 0u);
  rig.servo.error = 1;
  EXPECT_EQ(bound(2 * kSecondNs), 1u);  // up to whole ns
  rig.servo.error = 0;
  ASSERT_TRUE(rig.poll(4 * kSecondNs));
  EXPECT_NEAR(static_cast<double>(bound(10 * kSecondNs)), 10 * 100, 2);  // 100 ppb
  EXPECT_NEAR(static_cast<double>(bound(3600 * kSecondNs)), 3600 * 100, 2);
  EXPECT_LE(bound(-5), 2u);  // a clock that was set back
  rig.servo.error = 256 * 40 + 1;
  EXPECT_NEAR(static_cast<double>(bound(10 * kSecondNs)), 41 + 10 * 100, 2);
}

// TM-85: one pair far away is dropped, and nothing is left of it.
TEST(Servo, OneOutlier) {
  ServoRig rig;
  rig.lock();
  EXPECT_EQ(rig.pair(125).events, kAccepted);  // the gate itself is let in
  rig = ServoRig{};
  rig.lock();
  const auto far = rig.pair(-126);
  EXPECT_EQ(far.events, kOutlier);
  EXPECT_EQ(far.shift, 0);
  EXPECT_EQ(far.increment, kIncrement16MHz);
  const auto next = rig.pair(0);
  EXPECT_EQ(next.events, kAccepted);
  EXPECT_EQ(next.shift, 0);
  EXPECT_EQ(next.increment, kIncrement16MHz);
}

// TM-85: two in a row mean it; then one may be dropped again.
TEST(Servo, TwoAreAccepted) {
  ServoRig rig{1};
  rig.lock();
  EXPECT_EQ(rig.pair(5'000).events, kOutlier);
  const auto second = rig.pair(5'000);
  EXPECT_EQ(second.events, kAccepted);
  EXPECT_LT(second.shift, -4'990);
  EXPECT_EQ(rig.pair(50'000).events, kOutlier);
}

// TM-85: E is the mean of |x| within the gate, from the third pair on, of dropped ones too; of the
// first eight evenly.
TEST(Servo, MeanError) {
  ServoRig rig{16};
  const auto error = [&rig] { return rig.servo.error; };
  rig.pair(0);
  rig.pair(80);
  EXPECT_EQ(error(), 0);
  std::int64_t sum = 0, expected = 0;
  for (const std::int64_t offset : {80, -40, 120, -16, 8, 64, -32, 24}) {
    sum += std::abs(offset);
    rig.pair(offset);
    const std::int64_t pairs = rig.servo.learned;
    EXPECT_NEAR(static_cast<double>(error()), 256.0 * static_cast<double>(sum / pairs), 256.0)
        << offset;
    expected = error();
  }
  rig.pair(-80);
  expected += (std::int64_t{256 * 80} - expected) / 8;
  EXPECT_EQ(error(), expected);
  const std::int64_t period = static_cast<std::int64_t>(rig.increment >> 24);
  const std::int64_t gate = 6 * expected + 2 * period;
  EXPECT_EQ(rig.pair(90'000).events, kOutlier);
  EXPECT_EQ(error(), expected + (gate - expected) / 8);
}

// TM-85: it goes on learning evenly, however many pairs there have been.
TEST(Servo, MeanErrorOfManyPairs) {
  for (const unsigned pairs : {40u, 255u, 256u, 257u, 258u, 259u, 600u}) {
    ServoRig rig{16};
    rig.lock(pairs);
    ASSERT_EQ(rig.servo.error, 0) << pairs;
    rig.pair(80);
    EXPECT_EQ(rig.servo.error, 256 * 80 / 8) << pairs;
  }
}

// TM-83: nothing behind the history is touched (the sanitizer would tell), in a servo by itself.
TEST(Servo, HistoryStaysInItsPlace) {
  for (const int filter : {0, 16}) {
    const auto servo = std::make_unique<verican_servo_t>();
    const verican_servo_config_t config = ServoRig::defaults(static_cast<std::uint8_t>(filter));
    ASSERT_EQ(verican_servo_init(servo.get(), &config), VERICAN_OK);
    verican_correction_t correction{};
    for (std::uint64_t n = 1; n <= 40; ++n) {
      const std::uint64_t time = n * kSecondNs;
      const verican_sync_pair_t pair{time, time, time, kIncrement16MHz, 0};
      ASSERT_EQ(verican_servo_pair(servo.get(), &pair, &correction), VERICAN_OK);
    }
    EXPECT_EQ(servo->count, VERICAN_SERVO_PAIRS);
  }
}

// TM-86, TM-89: leaps of one master say nothing of another's.
TEST(Servo, LeapsOfAnotherMaster) {
  ServoRig rig;
  rig.lock();
  for (int n = 0; n < 2; ++n) EXPECT_EQ(rig.pair(3 * kSecondNs).events, kLeap);
  ASSERT_EQ(verican_servo_forget(&rig.servo), VERICAN_OK);
  EXPECT_EQ(rig.pair(3 * kSecondNs).events, kLeap);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
}

// What a configuration may have, both ends of it.
TEST(Servo, EndsOfTheConfiguration) {
  const auto result = [](auto change) {
    verican_servo_config_t config = ServoRig::defaults();
    change(config);
    return ServoRig{config}.result;
  };
  for (const std::uint32_t us : {50'000u, 5'000'000u})
    EXPECT_EQ(result([us](auto &c) { c.interval_us = us; }), VERICAN_OK) << us;
  for (const std::uint32_t us : {49'999u, 5'000'001u})
    EXPECT_EQ(result([us](auto &c) { c.interval_us = us; }), VERICAN_ERR_RANGE) << us;
  EXPECT_EQ(result([](auto &c) { c.leap_ns = 10'000'000; }), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.leap_ns = 10'000'001; }), VERICAN_ERR_RANGE);
  EXPECT_EQ(result([](auto &c) { c.drift_ppb = 1'000'000; }), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.drift_ppb = 1'000'001; }), VERICAN_ERR_RANGE);
  EXPECT_EQ(result([](auto &c) { c.hold_after = 1; }), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.hold_after = 0; }), VERICAN_ERR_RANGE);
}

// TM-86: the master's time leaps: three pairs that agree, then a step.
TEST(Servo, LeapForward) {
  ServoRig rig;
  rig.lock();
  EXPECT_EQ(rig.pair(100'000).events, kOutlier);  // not beyond the leap
  EXPECT_EQ(rig.pair(0).events, kAccepted);
  for (int n = 0; n < 2; ++n) {
    const auto leap = rig.pair(-37 * kSecondNs);
    EXPECT_EQ(leap.events, kLeap);
    EXPECT_EQ(leap.shift, 0);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
  }
  const auto step = rig.pair(-37 * kSecondNs - 50);
  EXPECT_EQ(step.events, kAccepted | kStep | kState);
  EXPECT_EQ(step.shift, 37 * kSecondNs + 50);
  EXPECT_FALSE(step.slew);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING);
}

// TM-86: the same back, by a little more than the leap; leaps that do not agree are none.
TEST(Servo, LeapBack) {
  ServoRig rig;
  rig.lock();
  for (const std::int64_t offset : {100'001, 300'000, 500'000, 700'000, 700'001})
    EXPECT_EQ(rig.pair(offset).events, kLeap) << offset;
  const auto step = rig.pair(700'010);
  EXPECT_EQ(step.events, kAccepted | kStep | kState);
  EXPECT_EQ(step.shift, -700'010);
}

// TM-86: one wrong FUP, or two: an event, and time goes on.
TEST(Servo, SingleWrongFup) {
  ServoRig rig;
  rig.lock();
  for (const unsigned wrong : {1u, 2u, 1u}) {
    for (unsigned n = 0; n < wrong; ++n) EXPECT_EQ(rig.pair(3 * kSecondNs).events, kLeap);
    const auto good = rig.pair(0);
    EXPECT_EQ(good.events, kAccepted);
    EXPECT_EQ(good.shift, 0);
    EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
  }
}

// TM-86: before LOCKED the limit is 1 us a ms of the interval wider, and the clock steps at once.
TEST(Servo, LeapBeforeLocked) {
  ServoRig rig;
  rig.pair(0);
  EXPECT_EQ(rig.pair(1'100'000).events, kAccepted);
  rig = ServoRig{};
  rig.pair(0);
  const auto step = rig.pair(1'100'001);
  EXPECT_EQ(step.events, kAccepted | kStep);
  EXPECT_EQ(step.shift, -1'100'001);
  EXPECT_EQ(step.increment, kIncrement16MHz);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_ACQUIRING);
}

// TM-89: another master: the history goes, rate and state stay.
TEST(Servo, AnotherMaster) {
  ServoRig rig;
  rig.lock();
  ASSERT_EQ(verican_servo_forget(&rig.servo), VERICAN_OK);
  EXPECT_EQ(rig.state(), VERICAN_SYNC_LOCKED);
  const auto first = rig.pair(90);
  EXPECT_EQ(first.shift, -90);
  EXPECT_TRUE(first.slew);
  EXPECT_EQ(first.increment, kIncrement16MHz);
  EXPECT_EQ(rig.servo.count, 1);
}

TEST(Servo, Arguments) {
  verican_servo_config_t config = ServoRig::defaults();
  verican_servo_t servo{};
  verican_sync_pair_t pair{};
  verican_correction_t correction{};
  EXPECT_EQ(verican_servo_config_default(nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_servo_init(nullptr, &config), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_servo_init(&servo, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_servo_forget(nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_servo_pair(nullptr, &pair, &correction), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_servo_pair(&servo, nullptr, &correction), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_servo_pair(&servo, &pair, nullptr), VERICAN_ERR_NULL);
  const auto refused = [&servo](auto change) {
    verican_servo_config_t wrong = ServoRig::defaults();
    change(wrong);
    return verican_servo_init(&servo, &wrong) == VERICAN_ERR_RANGE;
  };
  EXPECT_TRUE(refused([](auto &c) { c.interval_us = 49'999; }));
  EXPECT_TRUE(refused([](auto &c) { c.interval_us = 5'000'001; }));
  EXPECT_TRUE(refused([](auto &c) { c.leap_ns = 10'000'001; }));
  EXPECT_TRUE(refused([](auto &c) { c.drift_ppb = 1'000'001; }));
  EXPECT_TRUE(refused([](auto &c) { c.filter = 3; }));
  EXPECT_TRUE(refused([](auto &c) { c.filter = 32; }));
  EXPECT_TRUE(refused([](auto &c) { c.hold_after = 0; }));
}

}  // namespace
}  // namespace vericansim
