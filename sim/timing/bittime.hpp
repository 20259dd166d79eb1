// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit timing calculator: from clock and bit rate to register settings, and what they can bear
// (BT-01..BT-08).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
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
  double node_delay_ns = 100.0;  ///< driver and comparator of a transceiver together
  std::optional<double> controller_delay_ns =
      {};  ///< from a pin's edge to the controller's bit, and out; unset: this core's
  double clock_error_ppm = 100.0;  ///< of the nodes' clocks, for crystal_cable_m; 0 to 50,000
  double max_rate_error_ppm =
      50'000.0;  ///< settings beyond it are left out, as can-utils' calculator does
};

/// The request for a clock and a bit rate, Hz and bit/s, rounded. Throws std::invalid_argument if
/// one is out of range.
[[nodiscard]] BitTimingRequest bit_timing_request(double clock_hz, double bitrate);

/// One setting and what follows from it.
struct BitTimingResult {
  BitTiming timing;
  double bitrate = 0;               ///< bit/s that result
  double rate_error_ppm = 0;        ///< signed
  double sample_point = 0;          ///< 0..1
  double controller_delay_ns = 0;   ///< that it was rated with
  double oscillator_tolerance = 0;  ///< largest relative error of each node's clock at the cable
                                    ///< asked for; the error of the bit rate counts as part of it
  double cable_m = 0;               ///< longest cable between two nodes at that tolerance
  std::optional<double> crystal_cable_m = {};  ///< the same with clocks of clock_error_ppm; unset
                                               ///< if that is more than oscillator_tolerance

  /// False: the delays of nodes and cable are too long for it, even with perfect clocks.
  [[nodiscard]] bool usable() const { return oscillator_tolerance > 0; }
  /// The rate is off by no more than a node's clock may be.
  [[nodiscard]] bool rate_fits() const;
};

/// CiA's recommendation: 75 % above 800 kbit/s, 80 % above 500 kbit/s, else 87.5 %.
[[nodiscard]] double recommended_sample_point(std::uint32_t bitrate);

/// All settings within the registers' limits (BRP 1..256, PROP+PS1 4..16, PS2 2..8, SJW 1..4, 8..25
/// tq a bit), best first: smallest bit-rate error in whole bit/s, then smallest distance from the
/// sample point in tenths of a per cent (one that lies behind the wanted place only if no other is
/// left), then smallest BRP. One setting for each number of quanta and sample point, usable or not.
/// Empty if none fits. Throws std::invalid_argument if a value is out of range.
[[nodiscard]] std::vector<BitTimingResult> find_bit_timings(const BitTimingRequest &request);

/// What a given setting is worth at `clock_hz` and `bitrate`. Throws as BitTiming::validate().
[[nodiscard]] BitTimingResult rate_bit_timing(const BitTiming &timing,
                                              const BitTimingRequest &request);

/// Why `timing` has no place on a bus of `bitrate`: its rate is off by more than the clocks may be
/// (oscillator_tolerance()). Empty if it has one.
[[nodiscard]] std::string rate_mismatch(const BitTiming &timing, double clock_hz, double bitrate);

/// Delay of this core, ns: its synchroniser lets up to two clocks pass between an edge on can_rx
/// and the begin of the bit on can_tx (docs/integration.md).
[[nodiscard]] constexpr double core_delay_ns(double clock_hz) { return 2e9 / clock_hz; }

/// Largest tolerance of each node's oscillator, as a part of 1, by the two conditions of BT-08,
/// which know neither delays nor the width of a quantum: rate_bit_timing() does. Throws as
/// BitTiming::validate().
[[nodiscard]] double oscillator_tolerance(const BitTiming &timing);

}  // namespace vericansim
