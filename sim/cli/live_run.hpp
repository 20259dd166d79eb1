// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenarios with every kind of node, as several subcommands run them.
#pragma once

#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim::cli {

/// Simulates `scenario` at one bit rate. Where programs of the host are nodes, stderr tells them
/// where they find the bus, and says "ready" when it has begun; what firmware prints goes to stdout
/// if `prints`. Throws InputError.
[[nodiscard]] RunReport simulate(const Scenario &scenario, double bitrate, bool prints);

/// The exit code of a run: with programs as nodes the user's wish is an end like others.
[[nodiscard]] int exit_code_of(const RunReport &report);

/// A bit rate of the scenario at which it cannot run is found before any run of it. Throws
/// InputError.
void check_bitrates(const Scenario &scenario);

/// The bit rate of a scenario that is to run once: `wanted`, or its only one if that is 0. Throws
/// InputError if it has several.
[[nodiscard]] double only_bitrate(const Scenario &scenario, double wanted);

}  // namespace vericansim::cli
