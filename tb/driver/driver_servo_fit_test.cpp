// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The servo's arithmetic: what it sees, its line, its correction and its history.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "driver/servo_reference.hpp"
#include "driver/servo_rig.hpp"

namespace vericansim {
namespace {

using Points = std::vector<verican_servo_point_t>;

// The servo has the newest first.
Points newest_first(const std::vector<ServoReference::Point> &points) {
  Points turned;
  for (auto it = points.rbegin(); it != points.rend(); ++it) turned.push_back({it->local, it->x});
  return turned;
}

verican_servo_line_t fit(const std::vector<ServoReference::Point> &points) {
  const Points turned = newest_first(points);
  return verican_servo_fit(turned.data(), static_cast<unsigned>(turned.size()));
}

// Pairs about `interval` apart, a clock that is `ppm` off, offsets that scatter by `noise` ns.
ServoReference random_history(std::mt19937_64 &dice, std::size_t pairs) {
  const auto real = [&dice](double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(dice);
  };
  const double interval = real(0.05e9, 5e9), slope = real(-200e-6, 200e-6), noise = real(1, 500);
  ServoReference history;
  double local = real(0, 4e18);
  const double last = local + interval * static_cast<double>(pairs);
  for (std::size_t i = 0; i < pairs; ++i, local += interval * real(0.7, 1.3)) {
    const double x = (local - last) * slope + real(-noise, noise);
    history.points.push_back({std::llround(local), std::llround(256 * x)});
  }
  return history;
}

// TM-81: the vectors of the rule.
TEST(Servo, FitVectors) {
  const auto straight = fit({{1'000'000'000, 0}, {2'000'000'000, 256}, {3'000'000'000, 512}});
  EXPECT_EQ(straight.offset, 512);
  EXPECT_EQ(straight.rate, 17592);
  const auto uneven =
      fit({{1000000000, -1000}, {2000000123, 3100}, {3000000456, -700}, {4000000001, 9000}});
  EXPECT_EQ(uneven.offset, 6530);
  EXPECT_EQ(uneven.rate, 180044);
  // The least D there is, 1: two pairs a tick apart.
  const auto shortest = fit({{0, 0}, {4096, 1}});
  EXPECT_EQ(shortest.offset, 1);
  EXPECT_EQ(shortest.rate, 1 << 24);
}

// TM-81: one pair is a line without a slope, two at the same time as well.
TEST(Servo, FitOfOnePoint) {
  const auto one = fit({{5, -300}});
  EXPECT_EQ(one.offset, -300);
  EXPECT_EQ(one.rate, 0);
  const auto same = fit({{5, 100}, {5, 300}});
  EXPECT_EQ(same.offset, 200);
  EXPECT_EQ(same.rate, 0);
}

// TM-81: bit by bit what 128-bit integers give, and in the end the line of least squares.
TEST(Servo, FitAgainstLongDouble) {
  std::mt19937_64 dice{81};
  for (int n = 0; n < 20'000; ++n) {
    const std::size_t pairs = std::uniform_int_distribution<std::size_t>{2, 17}(dice);
    const ServoReference history = random_history(dice, pairs);
    const auto line = fit(history.points);
    const ServoReference::Line expected = history.fit(pairs);
    ASSERT_EQ(line.offset, expected.a) << n;
    ASSERT_EQ(line.rate, expected.b) << n;
    const ServoReference::ExactLine exact = history.exact_fit(pairs);
    // Ticks of 4,096 ns make 0.82 ns at 200 ppm.
    ASSERT_NEAR(static_cast<double>(line.offset) / 256, static_cast<double>(exact.a), 1.0) << n;
    const double rate = std::ldexp(static_cast<double>(line.rate), -44);
    const double span = static_cast<double>(history.points.back().local - history.points[0].local);
    ASSERT_NEAR(rate, static_cast<double>(exact.b), 2.0 / span + 1e-12) << n;
  }
}

// TM-80: the offset of the first pair shows what the servo sees: it is shifted away.
TEST(Servo, InputExact) {
  std::mt19937_64 dice{80};
  for (int n = 0; n < 20'000; ++n) {
    verican_servo_config_t config = ServoRig::defaults();
    config.delay_ns = std::uniform_int_distribution<std::int32_t>{-1000, 100'000}(dice);
    ServoRig rig{config};
    verican_sync_pair_t pair{};
    pair.local = dice() >> 8;
    pair.master = pair.local + dice() % 2'000'000'000 - 1'000'000'000;
    pair.now = pair.local + 1'000'000;
    pair.increment = dice() % (std::uint64_t{1} << 38) + (std::uint64_t{1} << 33);
    pair.latency = static_cast<std::uint8_t>(dice() % 8);
    verican_correction_t correction{};
    ASSERT_EQ(verican_servo_pair(&rig.servo, &pair, &correction), VERICAN_OK);
    const std::int64_t x = ServoReference::input(pair.local, pair.master, config.delay_ns,
                                                 pair.latency, pair.increment);
    ASSERT_EQ(correction.shift, static_cast<std::int64_t>(-floor_of(Wide{x} + 128, 256))) << n;
    // What is left of it, less than 1 ns, is in the history.
    ASSERT_EQ(rig.servo.points[0].offset, x + 256 * correction.shift) << n;
    ASSERT_EQ(rig.servo.points[0].local, static_cast<std::int64_t>(pair.local) + correction.shift);
  }
}

// TM-80: far apart, as at power-on of a follower whose master has the time of day.
TEST(Servo, StepAcrossAllOf64Bits) {
  for (const std::uint64_t master :
       {std::uint64_t{1'700'000'000} * 1'000'000'000, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
    ServoRig rig;
    const verican_sync_pair_t pair{1234, master, 5678, kIncrement16MHz, 3};
    verican_correction_t correction{};
    verican_servo_pair(&rig.servo, &pair, &correction);
    // 3 half clocks of 62.5 ns are 93.75 ns: 94 ns beyond the difference.
    EXPECT_EQ(1234 + static_cast<std::uint64_t>(correction.shift), master + 94);
    EXPECT_FALSE(correction.slew);
  }
}

// TM-82: every correction of random runs is that of the reference, bit by bit.
TEST(Servo, CorrectionExact) {
  std::mt19937_64 dice{82};
  for (int run = 0; run < 300; ++run) {
    const std::uint8_t filter = static_cast<std::uint8_t>(1u << (run % 5));
    ServoRig rig{filter};
    ServoReference reference;
    std::uniform_int_distribution<std::int64_t> jitter{-400, 400}, wait{50'000'000, 2'000'000'000};
    const double ppm = std::uniform_real_distribution<double>{-200e-6, 200e-6}(dice);
    rig.pair(0);
    reference.points = {{rig.servo.points[0].local, rig.servo.points[0].offset}};
    for (int n = 0; n < 30; ++n) {
      const std::int64_t pause = wait(dice);
      const double drift = n == 0 ? ppm * static_cast<double>(pause) : 0;
      const std::int64_t offset = std::llround(drift) + jitter(dice);
      const std::uint64_t before = rig.increment;
      const auto correction = rig.pair(offset, pause);
      if ((correction.events & VERICAN_SERVO_ACCEPTED) == 0) continue;
      const std::int64_t local = rig.master + offset;
      reference.points.push_back({local, 256 * offset});
      const std::size_t points = std::min<std::size_t>(reference.points.size(), filter + 1u);
      const auto expected = reference.correct(points, local + 1'000'000, before);
      ASSERT_EQ(correction.shift, expected.shift) << run << " " << n;
      ASSERT_EQ(correction.increment, expected.increment) << run << " " << n;
    }
  }
}

// TM-82: in LOCKED 1 us and less is worked off, more jumps; before it, everything jumps.
TEST(Servo, SlewsOnlyInLocked) {
  const auto slews = [](unsigned pairs, std::int64_t offset) {
    ServoRig rig{1};
    rig.lock(pairs);
    rig.pair(offset);  // in LOCKED the first is an outlier
    return rig.pair(offset).slew;
  };
  EXPECT_FALSE(slews(1, 40));
  EXPECT_TRUE(slews(8, 40));
  EXPECT_TRUE(slews(8, 998));
  EXPECT_FALSE(slews(8, 1100));
}

// TM-82: each of the two corrections can be switched off.
TEST(Servo, OffsetOrRateAlone) {
  verican_servo_config_t config = ServoRig::defaults(1);
  config.keep_rate = true;
  ServoRig offset_alone{config};
  offset_alone.pair(0);
  const auto offset = offset_alone.pair(1000);
  EXPECT_EQ(offset.shift, -1001);  // 1 ms later the clock is 1 ns further
  EXPECT_EQ(offset.increment, kIncrement16MHz);
  config.keep_rate = false;
  config.keep_offset = true;
  ServoRig leaping{config};  // each step is on top of the last one
  leaping.pair(5'000'000'000);
  EXPECT_NE(leaping.pair(5'002'000'000).events & VERICAN_SERVO_STEP, 0u);
  EXPECT_EQ(leaping.pair(5'002'000'050).events, VERICAN_SERVO_ACCEPTED);
  ServoRig rate_alone{config};
  EXPECT_EQ(rate_alone.pair(5'000'000'000).shift, 0);
  const auto rate = rate_alone.pair(5'000'001'000);
  EXPECT_EQ(rate.shift, 0);
  // 1 ppm less: 62.5 ns less 62.5e-6 ns, in 2^-32 ns.
  EXPECT_NEAR(static_cast<double>(rate.increment),
              static_cast<double>(kIncrement16MHz) * (1 - 1e-6), 3e3);
}

// TM-83: right behind a correction the history says that nothing is wrong, but for the rounding of
// times to 4,096 ns while the rate was far off.
TEST(Servo, HistoryIsRereferenced) {
  std::mt19937_64 dice{83};
  std::uniform_int_distribution<std::int64_t> jitter{-60, 60};
  ServoRig rig{8};
  for (int n = 0; n < 200; ++n) {
    const double before = static_cast<double>(rig.increment);
    rig.pair(n == 1 ? 100'000 : jitter(dice));
    const double corrected = std::abs(static_cast<double>(rig.increment) / before - 1);
    const auto line = verican_servo_fit(rig.servo.points, rig.servo.count);
    const double now = 1'000'000;  // the correction was made 1 ms behind the stamp
    const double rate = std::ldexp(static_cast<double>(line.rate), -44);
    ASSERT_NEAR(static_cast<double>(line.offset) / 256 + rate * now, 0, 1.0) << n;
    ASSERT_NEAR(rate, 0, 0.05e-9 + 4.1e-6 * corrected) << n;
  }
}

// TM-81, TM-83: a pair that is too old for the fit is forgotten, and all before it; its age counts
// from the newest one on.
TEST(Servo, OldPairsAreForgotten) {
  verican_servo_config_t config = ServoRig::defaults();
  config.interval_us = 5'000'000;
  config.hold_after = 200;
  for (const std::int64_t seconds : {137, 138}) {
    ServoRig rig{config};
    rig.pair(0);
    rig.pair(0, kSecondNs / 2);
    rig.pair(0, 90 * kSecondNs);
    rig.pair(0, (seconds - 90) * kSecondNs);
    EXPECT_EQ(rig.servo.count, seconds == 137 ? 3 : 2);
  }
}

// TM-81: whatever comes, nothing exceeds 63 bits (the sanitizer would tell), and the increment
// stays one.
TEST(Servo, AnySequenceIsDefined) {
  std::mt19937_64 dice{63};
  for (int run = 0; run < 500; ++run) {
    verican_servo_config_t config = ServoRig::defaults(static_cast<std::uint8_t>(run % 2 ? 0 : 16));
    config.leap_ns = static_cast<std::uint32_t>(dice() % 10'000'001);
    config.interval_us = static_cast<std::uint32_t>(50'000 + dice() % 4'950'000);
    config.keep_offset = dice() % 4 == 0;
    config.keep_rate = dice() % 4 == 0;
    ServoRig rig{config};
    for (int n = 0; n < 100; ++n) {
      const unsigned scale = static_cast<unsigned>(dice() % 64);
      const std::int64_t offset = static_cast<std::int64_t>(dice()) >> scale;
      const std::int64_t wait = static_cast<std::int64_t>(dice() >> (dice() % 40 + 24));
      const auto correction = rig.pair(offset / 2, wait);
      ASSERT_LT(correction.increment, std::uint64_t{1} << 40);
    }
  }
}

}  // namespace
}  // namespace vericansim
