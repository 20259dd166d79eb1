// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusTraffic: when a frame of the master gets through, among other frames and error frames
// (TM-121).
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "timesync/oscillator.hpp"
#include "timesync/sync_case.hpp"

namespace vericansim {

/// Bits of the longest base data frame with its intermission (rule book, FF-11).
inline constexpr double kLongestBaseFrame = 135;

/// A bus that others use too. Other frames are of the longest base format.
class BusTraffic {
 public:
  BusTraffic(const SyncCase &setting, std::uint64_t seed);

  /// A frame of `bits` that is queued now: ns until SOF of the attempt that gets through.
  [[nodiscard]] Nanoseconds until_sof(std::size_t bits);
  /// Length of `bits`, ns.
  [[nodiscard]] Nanoseconds duration(std::size_t bits) const;
  /// Attempts that failed so far.
  [[nodiscard]] std::uint64_t failed() const { return failed_; }

 private:
  [[nodiscard]] double uniform() { return std::uniform_real_distribution<double>{0, 1}(dice_); }
  [[nodiscard]] double waiting(double load);
  [[nodiscard]] double frames_ahead();

  double bit_ns_;
  double load_, load_above_, bit_errors_;
  std::mt19937_64 dice_;
  std::uint64_t failed_ = 0;
};

}  // namespace vericansim
