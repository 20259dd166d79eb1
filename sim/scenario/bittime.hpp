// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit timing calculator: from clock and bit rate to register settings, and what they can bear
// (BT-01..BT-08).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "node/bit_timing.hpp"

namespace vericansim {

/// What is asked for.
struct BitTimingRequest {
  std::uint32_t clock_hz = 8'000'000;       ///< clock of the controller, 1 kHz to 1 GHz
  std::uint32_t bitrate = 500'000;          ///< bit/s, 1000 to 1,000,000
  std::optional<double> sample_point = {};  ///< 0.5..0.9; unset: recommended_sample_point()
  std::optional<unsigned> sjw =
      {};                        ///< 1..4; unset: as large as the segments and the register allow
  double cable_m = 0.0;          ///< 0: PROP as half of TSEG1; else PROP covers this cable (BT-07)
  double node_delay_ns = 100.0;  ///< driver, comparator and controller of one node, one way
  double max_rate_error_ppm =
      50'000.0;  ///< settings beyond it are left out, as can-utils' calculator does
};

/// The request for a clock and a bit rate, Hz and bit/s, rounded. Throws std::invalid_argument if one
/// is out of range.
[[nodiscard]] BitTimingRequest bit_timing_request(double clock_hz, double bitrate);

/// One setting and what follows from it.
struct BitTimingResult {
  BitTiming timing;
  double bitrate = 0;               ///< bit/s that result
  double rate_error_ppm = 0;        ///< signed
  double sample_point = 0;          ///< 0..1
  double oscillator_tolerance = 0;  ///< largest relative error of each node's clock, BT-08
  double cable_m = 0;  ///< longest cable between two nodes, BT-07; negative: too slow nodes
};

/// CiA's recommendation: 75 % above 800 kbit/s, 80 % above 500 kbit/s, else 87.5 %.
[[nodiscard]] double recommended_sample_point(std::uint32_t bitrate);

/// All settings within the registers' limits (BRP 1..256, PROP+PS1 4..16, PS2 2..8, SJW 1..4, 8..25
/// tq a bit), best first: smallest bit-rate error in whole bit/s, then smallest distance from the
/// sample point in tenths of a per cent (one that lies behind the wanted place only if no other is
/// left), then smallest BRP. One setting for each number of quanta and sample point. Empty if none
/// fits. Throws std::invalid_argument if a value is out of range.
[[nodiscard]] std::vector<BitTimingResult> find_bit_timings(const BitTimingRequest &request);

/// What a given setting is worth at `clock_hz` and `bitrate`. Throws as BitTiming::validate().
[[nodiscard]] BitTimingResult rate_bit_timing(const BitTiming &timing,
                                              const BitTimingRequest &request);

/// Largest tolerance of each node's oscillator, as a part of 1 (BT-08). Throws as
/// BitTiming::validate().
[[nodiscard]] double oscillator_tolerance(const BitTiming &timing);

}  // namespace vericansim
