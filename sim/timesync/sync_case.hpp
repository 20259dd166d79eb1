// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncCase: what is to be synchronised, and under which conditions; one case, several seeds.
#pragma once

#include <cstdint>

namespace vericansim {

/// Identifier of the master's SYNC and FUP.
inline constexpr std::uint32_t kSyncId = 0x080;

/// The oscillators of all nodes. Their constant errors are uniform in -spread..spread.
struct SyncClocks {
  double frequency_hz = 16e6;
  double spread_ppm = 100;
  double wander = 0;    ///< density of a random walk of the frequency, 1/sqrt(s)
  double sine_ppm = 0;  ///< amplitude of a slow swing of the frequency
  double sine_period_s = 120;
  bool opposed = false;  ///< instead: the master right, followers +spread and -spread in turn

  friend bool operator==(const SyncClocks &, const SyncClocks &) = default;
};

/// Master, followers and bus. The defaults are the base case of section 12; what may be said of
/// them is in sync_settings.hpp.
struct SyncCase {
  SyncClocks clocks;
  unsigned followers = 8;
  double interval_s = 1;        ///< R
  std::uint8_t filter = 8;      ///< N: 1, 2, 4, 8, 16; 0: automatic
  double bitrate = 500e3;       ///< bit/s
  double load = 0;              ///< part of the bus that frames below SYNC's priority take
  double load_above = 0;        ///< part that frames above it take
  double bit_errors = 0;        ///< probability of each bit to make an error frame
  double displaced = 0;         ///< part of the edges that come up to 300 ns early at a follower
  bool own_pin = false;         ///< the master stamps at its receive pin (TXPIN)
  double master_late_ns = 0;    ///< the master stamps so much behind the edge, as followers know
  double master_uneven_ns = 0;  ///< and up to so much more, evenly
  bool hardware = false;        ///< followers are can_time_sync, without software
  bool restless = false;        ///< and have the setting for restless oscillators: KD 1, no PHALF
  bool master_cut = false;  ///< half-way the master falls silent for ever; a follower takes over
  unsigned intervals = 260;
  unsigned seeds = 4;
  std::uint64_t first_seed = 1;

  friend bool operator==(const SyncCase &, const SyncCase &) = default;
};

}  // namespace vericansim
