// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Oscillator: see oscillator.hpp.
#include "timesync/oscillator.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vericansim {
namespace {

constexpr Nanoseconds kPiece = 10'000'000;
constexpr double kPieceSeconds = 0.01;
constexpr auto kPieces = static_cast<std::size_t>(Oscillator::kBack / kPiece) + 2;

double turn(std::mt19937_64 &dice) { return std::uniform_real_distribution<double>{0, 1}(dice); }

}  // namespace

Oscillator::Oscillator(double frequency_hz, const OscillatorError &error, std::uint64_t seed)
    : nominal_{1e9L / frequency_hz}, error_{error}, dice_{seed} {
  const double first_edge = turn(dice_);
  phase_ = error.sine != 0 ? turn(dice_) : 0;
  pieces_.push_back({0, first_edge, error.constant});
}

Nanoseconds Oscillator::count(Nanoseconds t) {
  std::size_t number = 0;
  if (error_.wander > 0) {
    number = static_cast<std::size_t>(t / kPiece);
    while (grown_ <= number) grow();
    if (grown_ - number > kPieces) throw std::logic_error("Oscillator: that is forgotten");
  }
  const Piece &piece = pieces_[number % kPieces];
  return piece.count + ((t - piece.start) * (1 + static_cast<Nanoseconds>(piece.error)) +
                        (error_.sine != 0 ? swing(t) : 0)) /
                           nominal_;
}

// The integral of sine * sin(2 pi (t / period + phase)) from 0 to t.
Nanoseconds Oscillator::swing(Nanoseconds t) const {
  constexpr Nanoseconds kTurn = 2 * std::numbers::pi_v<Nanoseconds>;
  const Nanoseconds period = error_.sine_period_s * 1e9L;
  return error_.sine * period / kTurn *
         (std::cos(kTurn * phase_) - std::cos(kTurn * (t / period + phase_)));
}

void Oscillator::grow() {
  const Piece &last = pieces_[(grown_ - 1) % kPieces];
  const double step =
      error_.wander * std::sqrt(kPieceSeconds) * std::normal_distribution<double>{}(dice_);
  const Piece next{last.start + kPiece,
                   last.count + kPiece / nominal_ * (1 + static_cast<Nanoseconds>(last.error)),
                   last.error + step};
  if (grown_ < kPieces)
    pieces_.push_back(next);
  else
    pieces_[grown_ % kPieces] = next;
  ++grown_;
}

std::int64_t Oscillator::edge_after(Nanoseconds t) {
  return static_cast<std::int64_t>(std::ceil(count(t) - 1e-9L));
}

std::int64_t Oscillator::last_edge(Nanoseconds t) {
  return static_cast<std::int64_t>(std::floor(count(t)));
}

// The rate is 1 within 10^-3 or so: each turn leaves that part of what was off.
Nanoseconds Oscillator::time_of(std::int64_t edge, Nanoseconds t) {
  for (int n = 0; n < 4; ++n) t += (static_cast<Nanoseconds>(edge) - count(t)) * nominal_;
  return t;
}

}  // namespace vericansim
