// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusTraffic: see bus_traffic.hpp.
#include "timesync/bus_traffic.hpp"

#include <cmath>

namespace vericansim {
namespace {

// Error flag, its echo, delimiter and intermission.
constexpr double kErrorFrame = 12 + 8 + 3;

}  // namespace

BusTraffic::BusTraffic(const SyncCase &setting, std::uint64_t seed)
    : bit_ns_{1e9 / setting.bitrate},
      load_{setting.load},
      load_above_{setting.load_above},
      bit_errors_{setting.bit_errors},
      dice_{seed} {}

// Bits that frames above the priority are still to send, seen at random: a queue of equal frames
// that come independently (Pollaczek and Khinchine).
double BusTraffic::waiting(double load) {
  double bits = 0;
  while (uniform() < load) bits += uniform() * kLongestBaseFrame;
  return bits;
}

// Bits until the bus is free for SYNC: what is on it, and what comes above SYNC meanwhile.
double BusTraffic::frames_ahead() {
  double bits = waiting(load_above_);
  if (bits == 0 && uniform() < load_) bits = uniform() * kLongestBaseFrame;
  if (load_above_ == 0) return bits;
  for (double open = bits; open > 0;) {
    std::poisson_distribution<unsigned> more{open * load_above_ / kLongestBaseFrame};
    open = kLongestBaseFrame * more(dice_);
    bits += open;
  }
  return bits;
}

Nanoseconds BusTraffic::until_sof(std::size_t bits) {
  double ahead = frames_ahead();
  const double fails = 1 - std::pow(1 - bit_errors_, static_cast<double>(bits));
  while (uniform() < fails) {
    ++failed_;
    ahead += uniform() * static_cast<double>(bits) + kErrorFrame;
  }
  return ahead * bit_ns_;
}

Nanoseconds BusTraffic::duration(std::size_t bits) const {
  return static_cast<double>(bits) * bit_ns_;
}

}  // namespace vericansim
