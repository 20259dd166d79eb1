// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit rate detection.
#include "trace/bitrate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vericansim {
namespace {

constexpr double kUsualRates[] = {10e3,  20e3,  100e3 / 3, 50e3,  250e3 / 3, 100e3,
                                  125e3, 250e3, 500e3,     800e3, 1e6};
constexpr double kMostBits = 5.5;  // longest distance between edges inside a frame
constexpr double kOffGrid = 0.25;  // of a bit: edges of one direction may all be late

/// How well distances of at most 5 bits are whole numbers of bits.
struct Fit {
  std::size_t short_ones = 0;
  std::size_t whole_ones = 0;
  double bit = 0.0;  // refined by the whole ones
};

Fit fit_grid(const std::vector<double> &distances, double bit) {
  double sum = 0.0, bits = 0.0;
  Fit fit;
  for (const double distance : distances) {
    if (distance > kMostBits * bit) break;  // sorted
    ++fit.short_ones;
    const double whole = std::max(1.0, std::round(distance / bit));
    if (std::abs(distance / bit - whole) > kOffGrid) continue;
    sum += distance;
    bits += whole;
    ++fit.whole_ones;
  }
  if (fit.whole_ones != 0) fit.bit = sum / bits;
  return fit;
}

/// Distances from each edge to the one `steps` later, the shortest first.
std::vector<double> distances_of(const std::vector<Time> &edges, std::size_t steps) {
  std::vector<double> distances;
  for (std::size_t i = steps; i < edges.size(); ++i)
    distances.push_back(static_cast<double>(edges[i] - edges[i - steps]));
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace

std::optional<double> detect_bitrate(const std::vector<Time> &edges) {
  if (edges.size() < 10) return std::nullopt;
  const std::vector<double> distances = distances_of(edges, 1);
  // The bit is the grid that holds most of the distances; that of a glitch holds few. Half of the
  // distance between edges of one direction is a bit even where the other one's are late.
  Fit best;
  for (const std::size_t steps : {1, 2}) {
    const std::vector<double> starts = distances_of(edges, steps);
    double before = 0.0;
    for (std::size_t percent = 0; percent <= 50; ++percent) {
      const double start = starts[starts.size() * percent / 100] / static_cast<double>(steps);
      if (start <= std::exchange(before, start)) continue;
      const Fit fit = fit_grid(distances, start);
      if (fit.whole_ones > best.whole_ones) best = fit;
    }
  }
  constexpr std::size_t kFewest = 5;
  if (best.whole_ones < kFewest) return std::nullopt;
  best = fit_grid(distances, best.bit);
  if (best.whole_ones * 10 < best.short_ones * 7) return std::nullopt;  // chance gives a half
  const double rate = 1e12 / best.bit;
  for (const double usual : kUsualRates)
    if (std::abs(rate / usual - 1.0) < 0.02) return usual;
  return rate;
}

}  // namespace vericansim
