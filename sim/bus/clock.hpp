// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clock: the oscillator of one node; says when its next rising edge comes, without cumulative
// rounding.
#pragma once

#include <cstdint>

#include "bus/types.hpp"

namespace vericansim {

/// How an oscillator leaves its nominal frequency over time.
enum class Wander : std::uint8_t {
  kNone,  ///< constant error
  kSine,  ///< error_ppm + wander_ppm * sin(2 pi t / wander_period)
  kWalk,  ///< bounded random walk within error_ppm +- wander_ppm, one step each wander_period / 64
  kFree,  ///< random walk without bounds but those of the error, of wander_density
};

/// Settings of one oscillator. Invalid values make Clock's constructor throw std::invalid_argument.
struct ClockConfig {
  double frequency_hz = 8e6;  ///< nominal, 1 kHz to 10 GHz
  double error_ppm = 0.0;     ///< constant error, within +-100,000 ppm; kept to 10^-11 (TM-120)
  Time phase = 0;             ///< time of the first rising edge, ps, >= 0
  Wander wander = Wander::kNone;
  double wander_ppm = 0.0;      ///< kSine, kWalk: largest excursion from error_ppm
  double wander_density = 0.0;  ///< kFree: of the walk of the frequency, 1/sqrt(s), 0 to 10^-3
  Time wander_period = 10 * kMillisecond;
  std::uint64_t seed = 1;  ///< of a random walk

  friend bool operator==(const ClockConfig &, const ClockConfig &) = default;
};

/// An oscillator. The edge time is kept as picoseconds with 64 fractional bits, and the period is
/// divided out exactly to that precision: after 10^9 edges the edge is off by less than 10^-10 ps.
class Clock {
 public:
  explicit Clock(const ClockConfig &config = {});

  /// Time of the next rising edge, ps (rounded down).
  [[nodiscard]] Time next() const { return static_cast<Time>(edge_ >> 64); }

  /// Time of the last edge consumed, as long as the period has not changed since.
  [[nodiscard]] Time previous() const { return static_cast<Time>((edge_ - period_) >> 64); }

  /// Consumes the next rising edge.
  void tick() {
    edge_ += period_;
    ++cycles_;
    if (--until_update_ == 0) update();
  }

  /// Consumes all rising edges up to and including `until`, ps.
  void skip(Time until) { pass(count_until(until)); }
  /// Rising edges up to and including `until`, ps, however many.
  [[nodiscard]] std::uint64_t count_until(Time until) const;
  /// Consumes `edges` rising edges, however many.
  void pass(std::uint64_t edges);

  /// Time of the edge that comes `edges` after the next one; exact for up to steady_edges().
  [[nodiscard]] Time after(std::uint64_t edges) const {
    return static_cast<Time>((edge_ + edges * period_) >> 64);
  }
  /// Edges to come before the period may change; the edge after them is at after(steady_edges()).
  [[nodiscard]] std::uint64_t steady_edges() const { return until_update_ - 1; }
  /// Edges up to and including `until`, ps, as long as there are at most steady_edges() of them.
  [[nodiscard]] std::uint64_t edges_until(Time until) const {
    if (until < next()) return 0;
    const auto guess = static_cast<std::uint64_t>(static_cast<double>(until - next()) / period_ps_);
    std::uint64_t edges = guess < 2 ? 0 : guess - 1;  // the quotient may be off by one
    while (after(edges) <= until) ++edges;
    return edges;
  }
  /// Consumes `edges` rising edges, at most steady_edges().
  void advance(std::uint64_t edges) {
    edge_ += edges * period_;
    cycles_ += edges;
    until_update_ -= edges;
  }
  [[nodiscard]] bool wanders() const { return config_.wander != Wander::kNone; }

  /// Rising edges consumed so far.
  [[nodiscard]] std::uint64_t cycles() const { return cycles_; }
  /// Nominal frequency, Hz.
  [[nodiscard]] double nominal_hz() const { return config_.frequency_hz; }
  /// Error in force now (constant part and wander), ppm.
  [[nodiscard]] double error_ppm() const { return momentary_ppm_; }
  /// Length of the current period, ps.
  [[nodiscard]] double period_ps() const { return period_ps_; }
  [[nodiscard]] const ClockConfig &config() const { return config_; }

  /// Sets a new constant error, in force from the edge after the next one (clock drift fault).
  void set_error_ppm(double ppm);

  /// True if the two clocks tick at the same instants for ever.
  [[nodiscard]] bool in_step_with(const Clock &other) const;

 private:
  __extension__ using Fixed = unsigned __int128;

  void update();
  void set_period(double ppm);
  double next_walk_ppm();
  double next_free_ppm();
  double uniform();

  ClockConfig config_;
  Fixed edge_ = 0;    // 64.64 fixed point, ps
  Fixed period_ = 0;  // 64.64 fixed point, ps
  double period_ps_ = 1.0;
  std::uint64_t cycles_ = 0;
  std::uint64_t until_update_ = 0;  // edges until the wander is evaluated again; 0 wraps: never
  std::uint64_t random_ = 0;
  double walk_ppm_ = 0.0;
  double momentary_ppm_ = 0.0;
};

}  // namespace vericansim
