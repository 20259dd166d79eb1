// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Dice: random choices that depend on the seed alone, on every machine.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>

namespace vericansim {

/// A stream of choices. The standard's distributions differ between libraries, so there are none.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_{seed * 0x9E3779B97F4A7C15ULL + 1} {}

  [[nodiscard]] std::uint64_t word() { return random_(); }
  /// 0 .. n-1.
  [[nodiscard]] unsigned below(std::uint64_t n) { return static_cast<unsigned>(random_() % n); }
  /// low .. high.
  [[nodiscard]] unsigned in(unsigned low, unsigned high) { return low + below(high - low + 1); }
  [[nodiscard]] bool per_cent(unsigned n) { return below(100) < n; }
  /// 0 <= x < 1.
  [[nodiscard]] double part() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  /// low <= x < high.
  [[nodiscard]] double in_span(double low, double high) { return low + (high - low) * part(); }
  /// The index of one of the weights.
  [[nodiscard]] unsigned weighted(std::initializer_list<unsigned> weights) {
    unsigned sum = 0;
    for (const unsigned weight : weights) sum += weight;
    unsigned at = below(sum);
    unsigned index = 0;
    for (const unsigned weight : weights) {
      if (at < weight) return index;
      at -= weight;
      ++index;
    }
    return 0;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace vericansim
