// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// How far the clocks of a bus may be off, with the delays that it has (BT-06..BT-09).
#pragma once

#include <optional>

#include "node/bit_timing.hpp"

namespace vericansim {

/// Delays between two nodes, ns.
struct BusDelays {
  double one_way_ns = 0;  ///< cable and transceivers, from pin to pin
  double core_ns = 0;     ///< from an edge on can_rx to the begin of the bit on can_tx
  bool this_core = true;  ///< false: another controller, of which nothing but core_ns is known
};

/// Whether no frame of any node is misread while each node's clock is off by at most `error`, a
/// part of 1. Derived in docs/integration.md, "Clocks and delays". What holds for an error or a
/// cable also holds for smaller ones.
[[nodiscard]] bool clocks_hold(const BitTiming &timing, double quantum_ns, const BusDelays &delays,
                               double error);

/// BT-08, which knows neither delays nor the width of a quantum.
[[nodiscard]] double textbook_limit(const BitTiming &timing);

}  // namespace vericansim
