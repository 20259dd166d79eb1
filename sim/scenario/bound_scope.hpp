// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the analysis of response times holds: it knows the scenario's traffic alone, and nodes that
// send the most urgent frame that they have.
#pragma once

#include <string>

#include "scenario/scenario.hpp"

namespace vericansim {

/// Transmit buffers that node `id` has: those that it was given, else one for each of its messages,
/// as many as fit beside its receive buffers.
[[nodiscard]] unsigned transmit_buffers(const Scenario &scenario, NodeId id);

/// Why messages have no analytic bound, as a sentence's part that names the node or message; empty
/// if they have one.
[[nodiscard]] std::string why_no_bound(const Scenario &scenario);

}  // namespace vericansim
