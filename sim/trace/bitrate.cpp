// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit rate detection.
#include "trace/bitrate.hpp"

#include <algorithm>
#include <cmath>

namespace vericansim {
namespace {

constexpr double kUsualRates[] = {10e3,  20e3,  100e3 / 3, 50e3,  250e3 / 3, 100e3,
                                  125e3, 250e3, 500e3,     800e3, 1e6};
constexpr double kMostBits = 5.5;  // longest distance between edges inside a frame

/// Mean distance from the grid, as a part of a bit, of all distances that are at most 5 bits.
struct Fit {
  double off_grid = 1.0;
  double bit = 0.0;  // refined bit time
};

Fit fit_grid(const std::vector<double> &distances, double bit) {
  double sum = 0.0, bits = 0.0, off = 0.0;
  std::size_t used = 0;
  for (const double distance : distances) {
    if (distance > kMostBits * bit) break;  // sorted
    const double whole = std::max(1.0, std::round(distance / bit));
    off += std::abs(distance / bit - whole);
    sum += distance;
    bits += whole;
    ++used;
  }
  if (used < 5) return {};
  return {off / static_cast<double>(used), sum / bits};
}

}  // namespace

std::optional<double> detect_bitrate(const std::vector<Time> &edges) {
  if (edges.size() < 10) return std::nullopt;
  std::vector<double> distances;
  for (std::size_t i = 1; i < edges.size(); ++i)
    distances.push_back(static_cast<double>(edges[i] - edges[i - 1]));
  std::sort(distances.begin(), distances.end());
  // Start from short distances that are not glitches: the true bit is the first whose grid holds
  // the others.
  for (std::size_t percent = 0; percent <= 50; ++percent) {
    const double start = distances[distances.size() * percent / 100];
    if (start <= 0.0) continue;
    Fit fit = fit_grid(distances, start);
    if (fit.off_grid > 0.15) continue;
    fit = fit_grid(distances, fit.bit);
    const double rate = 1e12 / fit.bit;
    for (const double usual : kUsualRates)
      if (std::abs(rate / usual - 1.0) < 0.02) return usual;
    return rate;
  }
  return std::nullopt;
}

}  // namespace vericansim
