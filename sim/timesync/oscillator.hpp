// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Oscillator: when the edges of a clock come whose frequency is never quite the nominal one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace vericansim {

/// Simulated time in ns; 64 bits of mantissa are 10^-7 ns after an hour.
using Nanoseconds = long double;

/// How an oscillator differs from its nominal frequency.
struct OscillatorError {
  double constant = 0;       ///< part of the frequency
  double wander = 0;         ///< density of a random walk of the frequency, 1/sqrt(s)
  double sine = 0;           ///< amplitude of a slow swing of the frequency
  double sine_period_s = 1;  ///< and its period; the phase is random
};

/// Edges as a real number of periods: whole at an edge. The random walk makes a step every 10 ms.
class Oscillator {
 public:
  static constexpr Nanoseconds kBack = 60e9L;

  Oscillator(double frequency_hz, const OscillatorError &error, std::uint64_t seed);

  /// Periods up to `t`, t >= 0. With wander not more than kBack before the latest `t` so far.
  [[nodiscard]] Nanoseconds count(Nanoseconds t);
  /// The first edge at or after `t`.
  [[nodiscard]] std::int64_t edge_after(Nanoseconds t);
  /// The last edge at or before `t`.
  [[nodiscard]] std::int64_t last_edge(Nanoseconds t);
  /// Time of an edge that is within some ms of `t`.
  [[nodiscard]] Nanoseconds time_of(std::int64_t edge, Nanoseconds t);
  /// Nominal period, ns.
  [[nodiscard]] Nanoseconds nominal() const { return nominal_; }

 private:
  struct Piece {
    Nanoseconds start, count;
    double error;
  };
  void grow();
  [[nodiscard]] Nanoseconds swing(Nanoseconds t) const;

  Nanoseconds nominal_;
  OscillatorError error_;
  std::mt19937_64 dice_;
  double phase_;               ///< of the sine, turns
  std::vector<Piece> pieces_;  ///< of the random walk, the latest: number n at n modulo their most
  std::size_t grown_ = 1;      ///< pieces so far
};

}  // namespace vericansim
