// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clock: see clock.hpp.
#include "bus/clock.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace vericansim {
namespace {

constexpr int kStepsPerWanderPeriod = 64;
constexpr double kMaxErrorPpm = 100'000.0;
constexpr Time kLongestStep = 10 * kMillisecond;  // of an oscillator that wanders (TM-120)

// a / b as 64.64 fixed point, rounded down; a / b must be below 2^63.
__extension__ using Wide = unsigned __int128;

Wide divide(Wide a, Wide b) {
  Wide result = a / b;
  Wide rest = a % b;
  for (int bit = 0; bit < 64; ++bit) {
    result <<= 1;
    rest <<= 1;
    if (rest >= b) {
      rest -= b;
      result |= 1;
    }
  }
  return result;
}

void check(bool ok, const std::string &what) {
  if (!ok) throw std::invalid_argument("clock: " + what);
}

}  // namespace

Clock::Clock(const ClockConfig &config) : config_{config}, random_{config.seed} {
  check(config.frequency_hz >= 1e3 && config.frequency_hz <= 10e9,
        "frequency must be 1 kHz to 10 GHz, got " + std::to_string(config.frequency_hz) + " Hz");
  check(std::abs(config.error_ppm) + std::abs(config.wander_ppm) <= kMaxErrorPpm,
        "error must be within +-100000 ppm");
  check(config.phase >= 0, "phase must not be negative");
  check(config.wander_density >= 0 && config.wander_density <= 1e-3,
        "density of wander must be 0 to 0.001 per root second, got " +
            std::to_string(config.wander_density));
  check(config.wander_period >= kMicrosecond, "wander period must be at least 1 us");
  edge_ = static_cast<Fixed>(config.phase) << 64;
  set_period(config.error_ppm);
  if (config.wander != Wander::kNone) update();
}

void Clock::set_error_ppm(double ppm) {
  check(std::abs(ppm) + std::abs(config_.wander_ppm) <= kMaxErrorPpm,
        "error must be within +-100000 ppm, got " + std::to_string(ppm));
  config_.error_ppm = ppm;
  set_period(ppm + walk_ppm_);
}

// A clock that wanders is counted piece by piece, on a copy.
std::uint64_t Clock::count_until(Time until) const {
  if (!wanders()) return edges_until(until);
  Clock copy = *this;
  while (copy.next() <= until)
    copy.pass(std::max<std::uint64_t>(1, std::min(copy.edges_until(until), copy.steady_edges())));
  return copy.cycles_ - cycles_;
}

void Clock::pass(std::uint64_t edges) {
  while (edges != 0) {
    const std::uint64_t piece = std::min(edges, steady_edges());
    if (piece == 0) {
      tick();
      --edges;
    } else {
      advance(piece);
      edges -= piece;
    }
  }
}

// Frequency in mHz times (10^11 + error in 10^-11) is an exact integer, so the period 10^26 / that
// is divided out without going through floating point.
void Clock::set_period(double ppm) {
  momentary_ppm_ = ppm;
  const auto millihertz = static_cast<Fixed>(std::llround(config_.frequency_hz * 1e3));
  const long long rate = 100'000'000'000 + std::llround(ppm * 1e5);
  constexpr Fixed kTera = 1'000'000'000'000ULL;
  period_ = divide(kTera * kTera * 100, millihertz * static_cast<Fixed>(rate));
  period_ps_ = std::ldexp(static_cast<double>(period_), -64);
}

void Clock::update() {
  Time step = config_.wander_period / kStepsPerWanderPeriod;
  if (config_.wander == Wander::kFree) step = kLongestStep;
  if (config_.wander == Wander::kSine) step = std::min(step, kLongestStep);
  if (config_.wander == Wander::kSine) {
    const double turns = static_cast<double>(next()) / static_cast<double>(config_.wander_period);
    walk_ppm_ = config_.wander_ppm * std::sin(2.0 * std::numbers::pi * turns);
  } else if (config_.wander == Wander::kWalk) {
    walk_ppm_ = next_walk_ppm();
  } else if (config_.wander == Wander::kFree) {
    walk_ppm_ = next_free_ppm();
  } else {
    return;
  }
  set_period(config_.error_ppm + walk_ppm_);
  until_update_ = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(static_cast<double>(step) / period_ps()));
}

// 0 to 1, 1 excluded.
double Clock::uniform() {
  random_ = random_ * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<double>(random_ >> 11) / 9007199254740992.0;
}

// A step of a normal distribution (Box and Muller), whose variance grows with the time it takes.
double Clock::next_free_ppm() {
  const double deviation =
      1e6 * config_.wander_density * std::sqrt(static_cast<double>(kLongestStep) / kSecond);
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  const double bound = kMaxErrorPpm - std::abs(config_.error_ppm);
  const double step = deviation * radius * std::cos(2 * std::numbers::pi * uniform());
  return std::clamp(walk_ppm_ + step, -bound, bound);
}

// One step of up to a sixteenth of the range; the bounds reflect.
double Clock::next_walk_ppm() {
  const double bound = std::abs(config_.wander_ppm);
  const double moved = walk_ppm_ + (uniform() - 0.5) * bound / 4.0;
  if (moved > bound) return 2.0 * bound - moved;
  if (moved < -bound) return -2.0 * bound - moved;
  return moved;
}

bool Clock::in_step_with(const Clock &other) const {
  return edge_ == other.edge_ && period_ == other.period_ && config_.wander == Wander::kNone &&
         other.config_.wander == Wander::kNone;
}

}  // namespace vericansim
