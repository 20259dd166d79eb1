// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether the core holds what the bit timing calculator says of a setting.
#pragma once

#include <cstdint>
#include <vector>

#include "timing/bittime.hpp"

namespace vericansim {

/// A promise to be tested.
struct RowPromise {
  BitTiming timing;
  double clock_hz = 8e6;
  double tolerance = 0;      ///< of each node's clock, part of 1
  double cable_m = 0;        ///< between the ends of the bus
  double node_delay_ns = 0;  ///< of a transceiver
};

/// What rate_bit_timing() says of a setting: the worst clocks with their cable and, if it is
/// another promise, clocks of the request's error with theirs.
[[nodiscard]] std::vector<RowPromise> promises_of(const BitTimingResult &row,
                                                  const BitTimingRequest &request);

/// Sums over all buses.
struct RowProof {
  unsigned buses = 0, dirty = 0;  ///< dirty: with an error, or a frame that is not the same
  std::uint64_t frames = 0, node_cycles = 0;
};

/// Three nodes (three_nodes.hpp) with clocks at the ends of the tolerance in every combination, at
/// either end of the cable and in its middle in every order, with all delays and with none: 96
/// buses, which share `frames` frames evenly.
[[nodiscard]] RowProof prove_row(const RowPromise &promise, unsigned frames, std::uint64_t seed);

}  // namespace vericansim
