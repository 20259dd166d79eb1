// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs a scenario on Verilated cores: all traffic goes through their registers.
#pragma once

#include <functional>

#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// Simulates `scenario` at one of its bit rates and checks its expectations, or ends early when the
/// user wants it (stop_request.hpp). `progress` (0..1) may be empty. Times of the scenario count
/// from the moment when all nodes are on the bus. Throws InputError if a node cannot have the bit
/// rate or an output cannot be written; std::runtime_error if the software of a node fails.
[[nodiscard]] RunReport run_scenario(const Scenario &scenario, double bitrate,
                                     const std::function<void(double)> &progress = {});

}  // namespace vericansim
