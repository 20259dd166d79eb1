// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bit timing of a scenario's node.
#pragma once

#include "node/bit_timing.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// Bit timing of one node at a bit rate of the bus. Throws InputError with the node's line if there
/// is none.
[[nodiscard]] BitTiming timing_of(const Scenario &scenario, const NodeSpec &node, double bitrate);

}  // namespace vericansim
