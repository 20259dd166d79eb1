// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clock: edge times against exact rational arithmetic, errors, wander, and bad settings.
#include "bus/clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vericansim {
namespace {

__extension__ using Wide = unsigned __int128;

// floor(n * 10^24 / (mHz * (10^9 + ppb))): the exact time of edge n, ps.
Time exact_edge(std::uint64_t n, std::uint64_t millihertz, std::int64_t ppb) {
  const Wide denominator = static_cast<Wide>(millihertz) * static_cast<Wide>(1'000'000'000 + ppb);
  const Wide tera = 1'000'000'000'000ULL;
  // n * 10^24 does not fit 128 bits for n = 10^9; split the quotient.
  const Wide whole = tera * tera / denominator;
  const Wide rest = tera * tera % denominator;
  return static_cast<Time>(n * whole + n * rest / denominator);
}

TEST(Clock, BillionEdgesWithoutCumulativeError) {
  // 3 MHz has a period of 333,333.33... ps; an error of 0.333 ppm makes it no nicer.
  Clock clock{{.frequency_hz = 3e6, .error_ppm = 0.333}};
  for (std::uint64_t i = 0; i < 1'000'000'000; ++i) clock.tick();
  const Time expected = exact_edge(1'000'000'000, 3'000'000'000, 333);
  EXPECT_LE(std::abs(clock.next() - expected), 1);
  EXPECT_EQ(clock.cycles(), 1'000'000'000u);
}

TEST(Clock, EveryEdgeIsWithinOnePicosecond) {
  Clock clock{{.frequency_hz = 7'372'800, .error_ppm = -41.5}};
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    ASSERT_LE(std::abs(clock.next() - exact_edge(i, 7'372'800'000, -41'500)), 1) << "edge " << i;
    clock.tick();
  }
}

TEST(Clock, PhaseIsTheTimeOfTheFirstEdge) {
  Clock clock{{.frequency_hz = 8e6, .phase = 31'250}};
  EXPECT_EQ(clock.next(), 31'250);
  clock.tick();
  EXPECT_EQ(clock.next(), 31'250 + 125'000);
}

TEST(Clock, PositiveErrorIsAFastClock) {
  Clock fast{{.frequency_hz = 10e6, .error_ppm = 1000}};
  for (int i = 0; i < 10'010; ++i) fast.tick();
  EXPECT_NEAR(static_cast<double>(fast.next()), 1e9, 2.0);
}

TEST(Clock, DriftStepChangesThePeriodFromNowOn) {
  Clock clock{{.frequency_hz = 10e6}};
  for (int i = 0; i < 1000; ++i) clock.tick();
  clock.set_error_ppm(-1000);
  EXPECT_EQ(clock.next(), 100'000'000);
  for (int i = 0; i < 999; ++i) clock.tick();
  EXPECT_NEAR(static_cast<double>(clock.next()), 100e6 + 100e6, 2.0);  // 999 / 0.999 periods
}

class Wandering : public ::testing::TestWithParam<Wander> {};

TEST_P(Wandering, ErrorStaysWithinItsBoundsAndMoves) {
  const ClockConfig config{.frequency_hz = 8e6,
                           .error_ppm = 20,
                           .wander = GetParam(),
                           .wander_ppm = 50,
                           .wander_period = kMillisecond,
                           .seed = 7};
  Clock clock{config};
  double low = 1e9;
  double high = -1e9;
  for (int i = 0; i < 8'000'000; ++i) {
    clock.tick();
    low = std::min(low, clock.error_ppm());
    high = std::max(high, clock.error_ppm());
  }
  EXPECT_GE(low, -30.0);
  EXPECT_LE(high, 70.0);
  EXPECT_LT(low, 0.0);
  EXPECT_GT(high, 40.0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Wandering, ::testing::Values(Wander::kSine, Wander::kWalk),
                         [](const auto &each) {
                           return each.param == Wander::kSine ? "Sine" : "Walk";
                         });

TEST(Clock, WalkIsGivenByItsSeed) {
  ClockConfig config{
      .wander = Wander::kWalk, .wander_ppm = 100, .wander_period = 100 * kMicrosecond};
  Clock a{config};
  Clock b{config};
  config.seed = 2;
  Clock c{config};
  for (int i = 0; i < 100'000; ++i) {
    a.tick();
    b.tick();
    c.tick();
  }
  EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(a.next(), c.next());
}

// TM-120: the error is kept to 10^-11: after 10^10 edges of 1 ns, 0.1 ns more or less each.
TEST(ClockWander, ErrorIsKeptToAHundredThousandthOfAPpm) {
  for (const double hundred_thousandths : {0.0, 1.0, -3.0, 123'456.0}) {
    Clock clock{{.frequency_hz = 1e9, .error_ppm = hundred_thousandths * 1e-5}};
    constexpr std::uint64_t kEdges = 10'000'000'000;
    EXPECT_NEAR(static_cast<double>(clock.after(kEdges)), 1e13 / (1 + hundred_thousandths * 1e-11),
                2);
  }
}

// TM-120: the frequency of a free walk moves with the square root of the time, steps are 10 ms.
TEST(ClockWander, FreeWalkHasItsDensity) {
  constexpr double kDensity = 1e-7;
  constexpr int kWalks = 2000;
  double squares = 0;
  for (int walk = 1; walk <= kWalks; ++walk) {
    Clock clock{{.frequency_hz = 1e3,
                 .wander = Wander::kFree,
                 .wander_density = kDensity,
                 .seed = static_cast<std::uint64_t>(walk) * 0x9E3779B97F4A7C15}};
    clock.pass(4000);
    squares += clock.error_ppm() * clock.error_ppm();
  }
  EXPECT_NEAR(std::sqrt(squares / kWalks), 1e6 * kDensity * 2, 0.01);  // 4 s
}

// TM-120: a clock that wanders is skipped piece by piece.
TEST(ClockWander, SkippedAsTicked) {
  for (const Wander kind : {Wander::kSine, Wander::kWalk, Wander::kFree}) {
    Clock ticked{{.frequency_hz = 1e6,
                  .error_ppm = 40,
                  .wander = kind,
                  .wander_ppm = 90,
                  .wander_density = 1e-5,
                  .wander_period = 3 * kSecond}};
    Clock skipped = ticked;
    for (Time until = 123'456'789; until < 5 * kSecond; until = until * 3 + 1) {
      while (ticked.next() <= until) ticked.tick();
      skipped.skip(until);
      EXPECT_EQ(skipped.next(), ticked.next());
      EXPECT_EQ(skipped.cycles(), ticked.cycles());
    }
    EXPECT_NE(ticked.error_ppm(), 40);
  }
}

TEST(ClockWander, DensityIsChecked) {
  EXPECT_THROW((Clock{{.wander = Wander::kFree, .wander_density = -1e-9}}), std::invalid_argument);
  EXPECT_THROW((Clock{{.wander = Wander::kFree, .wander_density = 2e-3}}), std::invalid_argument);
}

TEST(Clock, InStepOnlyIfAllEdgesCoincide) {
  EXPECT_TRUE(Clock{{}}.in_step_with(Clock{{}}));
  EXPECT_FALSE(Clock{{}}.in_step_with(Clock{{.error_ppm = 1}}));
  EXPECT_FALSE(Clock{{}}.in_step_with(Clock{{.phase = 1}}));
  EXPECT_FALSE((Clock{{.wander = Wander::kSine, .wander_ppm = 1}}.in_step_with(Clock{{}})));
}

// advance(), after() and edges_until() against edge by edge, with a clock that changes its period.
TEST(Clock, ManyEdgesAtOnceAreThoseOneByOne) {
  const ClockConfig config{.frequency_hz = 37.7e6,
                           .error_ppm = -321,
                           .wander = Wander::kWalk,
                           .wander_ppm = 500,
                           .wander_period = 64 * kMicrosecond};
  Clock many{config}, single{config};
  unsigned rounds = 0;
  for (std::uint64_t edges = 1; edges < 5000; edges = edges * 3 + 1) {
    const std::uint64_t steady = std::min(edges, many.steady_edges());
    const Time last = steady == 0 ? 0 : many.after(steady - 1);
    if (steady != 0) {
      EXPECT_EQ(many.edges_until(last), steady);
      EXPECT_EQ(many.edges_until(last - 1), steady - 1);
      ++rounds;
    }
    many.advance(steady);
    for (std::uint64_t i = 0; i < steady; ++i) {
      if (i == steady - 1) {
        EXPECT_EQ(single.next(), last);
      }
      single.tick();
    }
    ASSERT_EQ(many.next(), single.next());
    ASSERT_EQ(many.cycles(), single.cycles());
    many.tick();
    single.tick();
  }
  EXPECT_GE(rounds, 5u);
  EXPECT_EQ(many.error_ppm(), single.error_ppm());
}

TEST(Clock, RefusesWhatNoOscillatorCanDo) {
  EXPECT_THROW(Clock{{.frequency_hz = 0}}, std::invalid_argument);
  EXPECT_THROW(Clock{{.frequency_hz = 2e10}}, std::invalid_argument);
  EXPECT_THROW(Clock{{.error_ppm = 2e5}}, std::invalid_argument);
  EXPECT_THROW(Clock{{.phase = -1}}, std::invalid_argument);
  EXPECT_THROW((Clock{{.wander = Wander::kSine, .wander_period = 1}}), std::invalid_argument);
  EXPECT_THROW(Clock{{.frequency_hz = std::nan("")}}, std::invalid_argument);
  EXPECT_THROW(Clock{{.error_ppm = std::nan("")}}, std::invalid_argument);
  Clock clock;
  EXPECT_THROW(clock.set_error_ppm(1e6), std::invalid_argument);
}

}  // namespace
}  // namespace vericansim
