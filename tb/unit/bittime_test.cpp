// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit timing calculator against the formulas of the rule book and against can-utils' calculator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "harness/shell.hpp"
#include "timing/bittime.hpp"

namespace vericansim {
namespace {

TEST(BitTime, BT_01_EverySettingGivesTheRateItClaims) {
  BitTimingRequest request;
  request.clock_hz = 66'000'000;
  request.bitrate = 500'000;
  const auto results = find_bit_timings(request);
  ASSERT_FALSE(results.empty());
  for (const BitTimingResult &r : results) {
    const BitTiming &t = r.timing;
    const double bits = 66e6 / (t.prescaler * (1.0 + t.prop + t.ps1 + t.ps2));
    EXPECT_DOUBLE_EQ(r.bitrate, bits);
    EXPECT_NEAR(r.rate_error_ppm, (bits / 500e3 - 1) * 1e6, 1e-6);
    EXPECT_NEAR(r.sample_point, (1.0 + t.prop + t.ps1) / (1.0 + t.prop + t.ps1 + t.ps2), 1e-12);
  }
}

TEST(BitTime, BT_02_BT_03_EverySettingIsWithinTheLimits) {
  for (const std::uint32_t clock : {8'000'000U, 40'000'000U, 66'666'666U})
    for (const std::uint32_t rate : {10'000U, 125'000U, 1'000'000U})
      for (const BitTimingResult &r : find_bit_timings({.clock_hz = clock, .bitrate = rate})) {
        const BitTiming &t = r.timing;
        EXPECT_TRUE(t.prescaler >= 1 && t.prescaler <= 256 && t.prop >= 1 && t.prop <= 8);
        EXPECT_TRUE(t.ps1 >= 1 && t.ps1 <= 8 && t.ps2 >= 2 && t.ps2 <= 8);
        EXPECT_TRUE(t.sjw >= 1 && t.sjw <= 4 && t.sjw <= t.ps1 && t.sjw <= t.ps2);
        EXPECT_TRUE(t.quanta() >= 8 && t.quanta() <= 25);
      }
}

// The rule book's example: 1.58 % with PROP 1, PS1 = PS2 = SJW = 4, 10 tq: 4 / (2 (130 - 4)) =
// 0.01587.
TEST(BitTime, BT_08_OscillatorTolerance) {
  EXPECT_DOUBLE_EQ(oscillator_tolerance({1, 1, 4, 4, 4}), 4.0 / 252.0);
  EXPECT_DOUBLE_EQ(oscillator_tolerance({1, 1, 4, 4, 1}), 1.0 / 200.0);  // SJW is the limit
  EXPECT_DOUBLE_EQ(oscillator_tolerance({1, 5, 7, 2, 2}),
                   std::min(2.0 / (2 * (13 * 15 - 2)), 2.0 / 300.0));
}

// 1 Mbit/s at 40 m: 2 x (200 + 50) ns = 4 quanta of 125 ns.
TEST(BitTime, BT_07_PropCoversTheCable) {
  BitTimingRequest request{.clock_hz = 8'000'000,
                           .bitrate = 1'000'000,
                           .cable_m = 40,
                           .node_delay_ns = 50,
                           .controller_delay_ns = 0};
  const auto results = find_bit_timings(request);
  ASSERT_FALSE(results.empty());
  EXPECT_EQ(results.front().timing.prop, 4U);
  EXPECT_TRUE(results.front().usable());
  EXPECT_GE(results.front().cable_m, 40.0);
  request.cable_m = 200;
  for (const BitTimingResult &result : find_bit_timings(request)) EXPECT_FALSE(result.usable());
}

BitTimingResult rated(std::uint32_t clock, std::uint32_t rate, const BitTiming &timing,
                      std::optional<double> controller_ns = {}) {
  return rate_bit_timing(
      timing, {.clock_hz = clock, .bitrate = rate, .controller_delay_ns = controller_ns});
}

// docs/integration.md, "Clocks and delays", by hand: this core takes two clocks, which count twice.
// 8 MHz, 500 kbit/s: a quantum is 125 ns, the loop delay 2 x (100 + 250) ns or 5.6 quanta. With
// errors near the limit edges of the far end are 6 quanta late: three moves of SJW, four drifts of
// 320 quanta each, and 2 + 1 quanta for them.
TEST(BitTime, BT_07_TheCoreItselfTakesTime) {
  EXPECT_DOUBLE_EQ(core_delay_ns(8e6), 250);
  const BitTimingResult cia = rated(8'000'000, 500'000, {1, 6, 7, 2, 2});
  EXPECT_NEAR(cia.oscillator_tolerance, 3.0 / (4 * 320 - 1), 1e-9);
  // The loop may grow until they are 8 late.
  EXPECT_NEAR(cia.cable_m, (8 - 5.6 - 320 * 3.0 / 1279) * 12.5, 1e-3);
  // With crystals BT-07 is the limit: 13 quanta, less 5.6 and the one that SYNC_SEG gives back.
  ASSERT_TRUE(cia.crystal_cable_m);
  EXPECT_NEAR(*cia.crystal_cable_m, (13 - 4.6 - 1e-4 * 412) * 12.5, 1e-3);
  // Another controller of 250 ns gets nothing back: 12.5 m less.
  EXPECT_NEAR(*rated(8'000'000, 500'000, {1, 6, 7, 2, 2}, 250).crystal_cable_m,
              (13 - 5.6 - 1e-4 * 412) * 12.5, 1e-3);
  EXPECT_FALSE(rated(8'000'000, 1'000'000, {1, 2, 2, 3, 2}).usable());
  // One quantum is left for the clocks, and nothing for a cable.
  const BitTimingResult tight = rated(10'000'000, 1'000'000, {1, 3, 3, 3, 3});
  EXPECT_NEAR(tight.oscillator_tolerance, 1.0 / 254, 1e-9);
  EXPECT_NEAR(tight.cable_m, 0, 1e-3);
}

// Sixteen clocks a quantum: another node may be 14 of them early, so PS2 bears less. Edges are one
// quantum late with the drift of 160 quanta: 2 a - 1 + 0.875 <= 2.
TEST(BitTime, BT_08_QuantaAreWide) {
  EXPECT_NEAR(rated(16'000'000, 125'000, {16, 3, 2, 2, 2}).oscillator_tolerance,
              2.125 / (320 - 2 - 0.875), 1e-9);
}

// What 508 m at 125 kbit/s bear: 11 quanta late, five moves, six drifts, and 1.5 quanta for them.
TEST(BitTime, LongBusesNeedBetterClocks) {
  const BitTiming timing{4, 6, 7, 2, 2};
  const BitTimingRequest request{.clock_hz = 8'000'000, .bitrate = 125'000, .cable_m = 508};
  EXPECT_NEAR(rate_bit_timing(timing, request).oscillator_tolerance, 1.5 / (6 * 320 - 2.5), 1e-9);
}

TEST(BitTime, RatesThatNoClockMayHave) {
  EXPECT_TRUE(rated(8'000'000, 500'000, {1, 6, 7, 2, 2}).rate_fits());
  EXPECT_TRUE(rated(8'000'000, 499'000, {1, 6, 7, 2, 2}).rate_fits());   // 0.20 %
  EXPECT_FALSE(rated(8'000'000, 498'500, {1, 6, 7, 2, 2}).rate_fits());  // 0.30 %
  EXPECT_EQ(rate_mismatch({1, 6, 6, 3, 3}, 8e6, 503e3), "");
  EXPECT_NE(rate_mismatch({1, 6, 6, 3, 3}, 8e6, 505e3), "");
}

TEST(BitTime, CtrlRegisterHoldsEachValueMinusOne) {
  EXPECT_EQ((BitTiming{1, 1, 1, 1, 1}.ctrl_fields()), 0U);
  EXPECT_EQ((BitTiming{256, 8, 8, 8, 4}.ctrl_fields()), 0xFFFF0007U);
  EXPECT_EQ((BitTiming{1, 6, 7, 2, 1}.ctrl_fields()),
            0x00310005U);  // can-utils prints this for 8 MHz, 500 kbit/s
}

TEST(BitTime, ValuesOutOfRangeAreRefused) {
  EXPECT_THROW(static_cast<void>(find_bit_timings({.clock_hz = 0})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_bit_timings({.bitrate = 2'000'000})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_bit_timings({.sample_point = 0.95})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_bit_timings({.sjw = 5})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_bit_timings({.cable_m = -1})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(find_bit_timings({.controller_delay_ns = -1})),
               std::invalid_argument);
  EXPECT_TRUE(
      find_bit_timings({.clock_hz = 8'000'000, .bitrate = 999'000, .max_rate_error_ppm = 10})
          .empty());
}

/// What can-calc-bit-timing prints for flexcan's limits; nothing if it finds no setting.
std::optional<BitTiming> can_utils_choice(std::uint32_t clock, std::uint32_t rate,
                                          int sample_permille) {
  std::ostringstream command;
  command << "can-calc-bit-timing -q -c " << clock << " -b " << rate << " -s " << sample_permille
          << " flexcan 2> /dev/null";
  // Last line: rate, tq in ns, PropSeg, PhaseSeg1, PhaseSeg2, SJW, BRP, ...
  std::istringstream words{shell(command.str()).text};
  unsigned bit_rate = 0, quantum = 0;
  BitTiming t;
  if (!(words >> bit_rate >> quantum >> t.prop >> t.ps1 >> t.ps2 >> t.sjw >> t.prescaler))
    return std::nullopt;
  return t;
}

class CanUtils : public ::testing::TestWithParam<std::uint32_t> {};

// Same rate error and sample point as can-utils, everywhere; the same registers wherever a setting
// is exact. (Among inexact settings that are equal in both, can-utils takes the coarsest quantum
// and we take the finest.)
TEST_P(CanUtils, BT_01_BT_02_SameSettingAsTheKernelsCalculator) {
  if (!has_program("can-calc-bit-timing")) GTEST_SKIP() << "can-utils is not installed";
  const std::uint32_t clock = GetParam();
  for (const std::uint32_t rate : {10'000U, 20'000U, 33'333U, 50'000U, 83'333U, 100'000U, 125'000U,
                                   250'000U, 500'000U, 800'000U, 1'000'000U})
    for (const int point : {0, 750, 800, 875}) {
      BitTimingRequest request{.clock_hz = clock, .bitrate = rate, .sjw = 1};
      if (point != 0) request.sample_point = point / 1000.0;
      const auto theirs = can_utils_choice(clock, rate, point);
      const auto ours = find_bit_timings(request);
      ASSERT_EQ(theirs.has_value(), !ours.empty()) << clock << " " << rate << " " << point;
      if (!theirs) continue;
      const BitTimingResult judged = rate_bit_timing(*theirs, request);
      EXPECT_NEAR(judged.bitrate, ours.front().bitrate, 1.0)
          << clock << " " << rate << " " << point;
      EXPECT_NEAR(judged.sample_point, ours.front().sample_point, 0.001)
          << clock << " " << rate << " " << point;
      const double wanted = request.sample_point.value_or(recommended_sample_point(rate));
      if (judged.rate_error_ppm != 0 || std::abs(judged.sample_point - wanted) > 1e-9) continue;
      EXPECT_EQ(*theirs, ours.front().timing) << clock << " " << rate << " " << point;
    }
}
INSTANTIATE_TEST_SUITE_P(Clocks, CanUtils,
                         ::testing::Values(8'000'000, 16'000'000, 20'000'000, 24'000'000,
                                           30'000'000, 40'000'000, 49'875'000, 50'000'000,
                                           66'000'000, 66'666'666, 80'000'000, 100'000'000));

}  // namespace
}  // namespace vericansim
