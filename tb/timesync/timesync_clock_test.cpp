// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clocks of the synchronisation without RTL: oscillators, clock registers, stamps (TM-121).
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "model/time_model.hpp"
#include "timesync/clock_node.hpp"

namespace vericansim {
namespace {

constexpr Nanoseconds kSecond = 1e9L;

Oscillator oscillator(double frequency_hz, const OscillatorError &error = {}) {
  return {frequency_hz, error, 1};
}

// A constant error stays to 10^-11: 16 kclocks in 1000 s are 1 ppm.
TEST(Oscillator, ConstantErrorIsExact) {
  for (const double error : {0.0, 1e-9, -100e-6, 400e-6}) {
    Oscillator one = oscillator(16e6, {.constant = error});
    const Nanoseconds clocks = one.count(1000 * kSecond) - one.count(0);
    EXPECT_NEAR(static_cast<double>(clocks / 16e9L - 1 - static_cast<Nanoseconds>(error)), 0,
                1e-15);
  }
}

// Frequency after t is a random walk of variance density^2 t; no edge is lost between its steps.
TEST(Oscillator, WanderHasItsDensity) {
  constexpr int kRuns = 400;
  constexpr double kDensity = 1e-8;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    Oscillator one{16e6, {.wander = kDensity}, seed};
    const Nanoseconds rate =
        (one.count(100.005L * kSecond) - one.count(100.001L * kSecond)) / (0.004L * 16e6L) - 1;
    squares += static_cast<double>(rate * rate);
  }
  const double sd = std::sqrt(squares / kRuns);
  EXPECT_NEAR(sd, kDensity * 10, 0.1 * kDensity * 10);  // 2.8 sigma of the estimate
}

// 100,000 intervals of 5 s are six days, and nodes are many: the walk that has been is forgotten.
TEST(Oscillator, WanderTakesNoMemoryOfItsLength) {
  const auto most_kilobytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  Oscillator one = oscillator(16e6, {.wander = 1e-9});
  (void)one.count(100 * kSecond);
  const long before = most_kilobytes();
  EXPECT_NEAR(static_cast<double>(one.count(20'000 * kSecond) / (20'000 * 16e6L)), 1, 1e-5);
  EXPECT_LT(most_kilobytes() - before, 20'000);  // two million steps are 96 MB
}

// The swing turns the frequency by its amplitude each way, and not on average.
TEST(Oscillator, SwingHasItsAmplitude) {
  Oscillator one = oscillator(16e6, {.sine = 1e-6, .sine_period_s = 120});
  double least = 1, most = -1;
  for (int s = 0; s < 240; ++s) {
    const Nanoseconds rate = (one.count((s + 1) * kSecond) - one.count(s * kSecond)) / 16e6L - 1;
    least = std::min(least, static_cast<double>(rate));
    most = std::max(most, static_cast<double>(rate));
  }
  EXPECT_NEAR(most, 1e-6, 1e-9);
  EXPECT_NEAR(least, -1e-6, 1e-9);
  EXPECT_NEAR(static_cast<double>(one.count(120 * kSecond) - one.count(0)), 120 * 16e6, 1e-3);
}

TEST(Oscillator, EdgesAreWhereTheyAreCounted) {
  for (const OscillatorError &error :
       {OscillatorError{.constant = 300e-6}, OscillatorError{.wander = 1e-7}}) {
    Oscillator one = oscillator(25e6, error);
    for (Nanoseconds t = 1e6L; t < 2e9L; t += 33'333'333.3L) {
      const std::int64_t next = one.edge_after(t);
      const Nanoseconds at = one.time_of(next, t);
      EXPECT_GE(at, t - 1e-6L);
      EXPECT_LT(at, t + 40.1L);
      EXPECT_EQ(one.last_edge(at + 1), next);
      EXPECT_EQ(one.last_edge(at - 1), next - 1);
    }
  }
}

/// Model and closed form, given the same commands.
class ClockNodeBeside : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kIncrement = 0x3E'80000000;  // 62.5 ns

  void to(std::int64_t edge) {
    for (; edge_ < edge; ++edge_) model_.clock();
  }
  void give(TimeCommand command, const verican_correction_t &correction) {
    node_.apply(edge_, correction);
    model_.clock(command);
    ++edge_;
  }
  void expect_equal() { ASSERT_EQ(node_.at(edge_), model_.time()) << "edge " << edge_; }

  TimeModel model_{62, 0x80000000};
  ClockNode node_{oscillator(16e6), 0};
  std::int64_t edge_ = 0;
};

// TM-121: the clock register in closed form is the rule's, clock by clock (TM-10, TM-13, TM-14).
TEST_F(ClockNodeBeside, EqualsTimeModel) {
  std::mt19937_64 dice{1};
  ASSERT_EQ(node_.increment(), kIncrement);
  for (int n = 0; n < 20'000; ++n) {
    to(edge_ + 1 + static_cast<std::int64_t>(dice() % 50));
    expect_equal();
    const auto shift = static_cast<std::int64_t>(dice() % 2'000'000) - 1'000'000;
    const std::uint64_t increment = dice() % 2 == 0 ? node_.increment() : dice() >> 25;
    if (increment == node_.increment())
      give({.kind = TimeCommand::Kind::kShift, .ns = static_cast<std::uint64_t>(shift)},
           {shift, increment, false, 0});
    else
      give({.kind = TimeCommand::Kind::kRate,
            .inc_ns = static_cast<std::uint8_t>(increment >> 32),
            .inc_frac = static_cast<std::uint32_t>(increment)},
           {0, increment, false, 0});
    expect_equal();
  }
}

// TM-26: a stamp is 1.5 clocks behind the edge on average, and what remains is uniform in a clock.
TEST(ClockNode, StampsHaveTheLatencyOfTheRule) {
  constexpr int kEdges = 100'000;
  ClockNode node{oscillator(16e6), 0};
  std::mt19937_64 dice{1};
  double sum = 0, least = 1e9, most = -1e9;
  const Nanoseconds first = node.oscillator.time_of(0, 0);
  for (int n = 0; n < kEdges; ++n) {
    const Nanoseconds edge = 1e3L + std::uniform_real_distribution<double>{0, 1e6}(dice);
    const auto late = static_cast<double>(node.receive_stamp(edge) - (edge - first));
    sum += late;
    least = std::min(least, late);
    most = std::max(most, late);
  }
  EXPECT_NEAR(sum / kEdges, 1.5 * 62.5 - 0.5, 0.5);  // TIME has whole ns
  EXPECT_GE(least, 62.5 - 1.01);
  EXPECT_LE(most, 2 * 62.5 + 0.01);
}

// Section 0: the continuous readings of two equal clocks differ by their start and their phase.
TEST(ClockNode, ContinuousReading) {
  ClockNode a{Oscillator{16e6, {}, 1}, 1000}, b{Oscillator{16e6, {}, 2}, 0};
  const Nanoseconds phase = (a.oscillator.count(0) - b.oscillator.count(0)) * 62.5L;
  for (Nanoseconds t = 0; t < 1e6L; t += 777.7L)
    EXPECT_NEAR(static_cast<double>(a.ahead_of(b, t) - 1000 - phase), 0, 1.01);
}

}  // namespace
}  // namespace vericansim
