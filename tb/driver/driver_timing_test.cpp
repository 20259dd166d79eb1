// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit timing: the driver's search against one that tries everything in floating point.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "verican/verican.h"

namespace vericansim {
namespace {

struct Best {
  double rate = 1e9;   // relative error of the bit rate, ppm
  double point = 1e9;  // distance of the sample point, per mille
};

// The best there is: every prescaler, every number of quanta, every place of the sample point that
// PROP, PS1 (1..8 tq each) and PS2 (2..8 tq) allow (flexcan.md 1.2).
Best best_of_all(double clock, double bitrate, double sample_point, double tolerance) {
  Best best;
  for (int prescaler = 1; prescaler <= 256; ++prescaler) {
    for (int quanta = 8; quanta <= 25; ++quanta) {
      const double rate = std::abs(clock / (prescaler * quanta) / bitrate - 1) * 1e6;
      if (rate > VERICAN_BITRATE_TOLERANCE || rate > best.rate + 1e-6) continue;
      for (int phase2 = 2; phase2 <= 8; ++phase2) {
        const int before = quanta - phase2;
        if (before < 3 || before > 17) continue;
        const double point = std::abs(1000.0 * before / quanta - sample_point);
        if (point > tolerance) continue;
        if (rate < best.rate - 1e-6) best = {rate, point};
        best.point = std::min(best.point, point);
      }
    }
  }
  return best;
}

void expect_valid(const verican_timing_t &timing) {
  EXPECT_GE(timing.prescaler, 1);
  EXPECT_LE(timing.prescaler, 256);
  for (const unsigned segment : {timing.prop, timing.phase1, timing.phase2}) {
    EXPECT_GE(segment, 1u);
    EXPECT_LE(segment, 8u);
  }
  EXPECT_GE(timing.phase2, 2);
  EXPECT_GE(timing.sjw, 1);
  EXPECT_LE(timing.sjw, std::min({4, int{timing.phase1}, int{timing.phase2}}));
  const int quanta = 1 + timing.prop + timing.phase1 + timing.phase2;
  EXPECT_GE(quanta, 8);
  EXPECT_LE(quanta, 25);
}

class EveryClock : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(EveryClock, TheSearchFindsTheBestThereIs) {  // BT-01, BT-02
  const std::uint32_t clock = GetParam();
  unsigned found = 0;
  for (const std::uint32_t bitrate :
       {1'000u, 5'000u, 10'000u, 20'000u, 33'333u, 50'000u, 83'333u, 100'000u, 125'000u, 250'000u,
        500'000u, 615'384u, 800'000u, 921'600u, 1'000'000u}) {
    for (const std::uint16_t wish : {0, 500, 600, 667, 750, 800, 875, 900}) {
      SCOPED_TRACE(std::to_string(bitrate) + " bit/s at " + std::to_string(wish));
      verican_timing_t timing{};
      const verican_result_t result = verican_timing_find(clock, bitrate, wish, &timing);
      const double usual = bitrate > 800'000 ? 750 : bitrate > 500'000 ? 800 : 875;
      const double point = wish != 0 ? wish : usual;
      const Best best = best_of_all(clock, bitrate, point,
                                    wish != 0 ? VERICAN_SAMPLE_POINT_TOLERANCE + 0.5 : 1000);
      if (result != VERICAN_OK) {
        EXPECT_EQ(result, VERICAN_ERR_TIMING);
        // Rounding of the limits leaves a little to either side.
        EXPECT_TRUE(best.rate > VERICAN_BITRATE_TOLERANCE - 30 ||
                    best.point > VERICAN_SAMPLE_POINT_TOLERANCE - 0.5)
            << best.rate << " ppm, " << best.point;
        EXPECT_EQ(timing.prescaler, 0) << "outputs stay";
        continue;
      }
      ++found;
      expect_valid(timing);
      const int quanta = 1 + timing.prop + timing.phase1 + timing.phase2;
      const double rate = clock / static_cast<double>(timing.prescaler * quanta);
      EXPECT_EQ(timing.bitrate, static_cast<std::uint32_t>(rate));
      const double ppm = std::abs(rate / bitrate - 1) * 1e6;
      EXPECT_NEAR(timing.error_ppm, ppm, 2 + ppm / 100);
      EXPECT_LE(ppm, best.rate + 2 + ppm / 100);
      const double achieved = 1000.0 * (quanta - timing.phase2) / quanta;
      EXPECT_NEAR(timing.sample_point, achieved, 0.5);
      if (ppm < best.rate + 1e-3) {
        EXPECT_LE(std::abs(achieved - point), best.point + 1);
      }
      // What was computed passes as an explicit timing and reports the same.
      verican_timing_t again = timing;
      EXPECT_EQ(verican_timing_check(clock, &again), VERICAN_OK);
      EXPECT_EQ(again.bitrate, timing.bitrate);
      EXPECT_EQ(again.sample_point, timing.sample_point);
    }
  }
  EXPECT_GT(found, clock == 8'000'000 ? 40u : 0u);
}

INSTANTIATE_TEST_SUITE_P(Clocks, EveryClock,
                         ::testing::Values(1'000'000u, 4'000'000u, 8'000'000u, 12'000'000u,
                                           16'000'000u, 20'000'000u, 24'000'000u, 25'000'000u,
                                           32'768'000u, 33'333'333u, 40'000'000u, 48'000'000u,
                                           50'000'000u, 66'000'000u, 80'000'000u, 100'000'000u,
                                           160'000'000u, 400'000'000u),
                         [](const auto &clock) { return std::to_string(clock.param) + "Hz"; });

TEST(DriverTiming, KnownSettings) {
  verican_timing_t timing{};
  // 8 quanta leave room for 75 % at most.
  ASSERT_EQ(verican_timing_find(8'000'000, 1'000'000, 0, &timing), VERICAN_OK);
  EXPECT_EQ(timing.prescaler, 1);
  EXPECT_EQ(timing.prop + timing.phase1, 5);
  EXPECT_EQ(timing.phase2, 2);
  EXPECT_EQ(timing.sample_point, 750);
  EXPECT_EQ(timing.bitrate, 1'000'000u);
  EXPECT_EQ(timing.error_ppm, 0u);
  // 16 quanta for 87.5 %, as CiA 301 has them for 500 kbit/s.
  ASSERT_EQ(verican_timing_find(16'000'000, 500'000, 875, &timing), VERICAN_OK);
  EXPECT_EQ(timing.prescaler, 2);
  EXPECT_EQ(timing.prop + timing.phase1, 13);
  EXPECT_EQ(timing.phase2, 2);
  EXPECT_EQ(timing.sample_point, 875);
}

TEST(DriverTiming, EachFieldOfAnExplicitTimingHasItsRange) {
  const verican_timing_t good{4, 3, 4, 4, 2, 0, 0, 0};
  verican_timing_t timing = good;
  ASSERT_EQ(verican_timing_check(24'000'000, &timing), VERICAN_OK);
  EXPECT_EQ(timing.bitrate, 500'000u);
  EXPECT_EQ(timing.sample_point, 667);
  EXPECT_EQ(verican_timing_check(VERICAN_CLOCK_MIN - 1, &timing), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_timing_check(VERICAN_CLOCK_MAX + 1, &timing), VERICAN_ERR_RANGE);
  const auto refused = [&](auto member, auto value) {
    verican_timing_t bad = good;
    bad.*member = value;
    return verican_timing_check(24'000'000, &bad) == VERICAN_ERR_RANGE;
  };
  EXPECT_TRUE(refused(&verican_timing_t::prescaler, 0));
  EXPECT_TRUE(refused(&verican_timing_t::prescaler, 257));
  EXPECT_TRUE(refused(&verican_timing_t::prop, 0));
  EXPECT_TRUE(refused(&verican_timing_t::prop, 9));
  EXPECT_TRUE(refused(&verican_timing_t::phase1, 0));
  EXPECT_TRUE(refused(&verican_timing_t::phase1, 9));
  EXPECT_TRUE(refused(&verican_timing_t::phase2, 1));
  EXPECT_TRUE(refused(&verican_timing_t::phase2, 9));
  EXPECT_TRUE(refused(&verican_timing_t::sjw, 0));
  EXPECT_TRUE(refused(&verican_timing_t::sjw, 5));
  verican_timing_t narrow{1, 1, 2, 4, 3, 0, 0, 0};
  EXPECT_EQ(verican_timing_check(24'000'000, &narrow), VERICAN_ERR_RANGE) << "SJW above PS1";
  verican_timing_t small{1, 1, 1, 4, 1, 0, 0, 0};
  EXPECT_EQ(verican_timing_check(24'000'000, &small), VERICAN_ERR_RANGE) << "7 tq";
}

}  // namespace
}  // namespace vericansim
