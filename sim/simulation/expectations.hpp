// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares what a run has shown with what its scenario expects.
#pragma once

#include <vector>

#include "model/bus_monitor.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// One result for each expectation of the scenario. `frames`: all frames of the bus in order;
/// `received`: for each node what its software read, in order.
[[nodiscard]] std::vector<CheckResult> check_expectations(
    const Scenario &scenario, const RunReport &report, const std::vector<BusFrame> &frames,
    const std::vector<std::vector<Frame>> &received);

/// Whether the number `seen` is in `range`.
[[nodiscard]] CheckResult check_number(const std::string &what, double seen, const Range &range);

}  // namespace vericansim
