// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs a scenario with a report and reads the report back.
#pragma once

#include <string>
#include <vector>

#include "report/report_reader.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"
#include "trace/log.hpp"

namespace vericansim {

/// A path for a file of the running test.
[[nodiscard]] std::string report_file(const std::string &ending);

struct ReportedRun {
  RunReport report;
  ReportPage page;
  CanLog log;  ///< the same run's candump log
};

/// Simulates `scenario` at its first bit rate.
[[nodiscard]] ReportedRun run_with_report(Scenario scenario);

/// Four nodes with clocks that differ, all identifiers in arbitration, no cable.
[[nodiscard]] Scenario busy_scenario();
/// Three nodes, clocks 4000 ppm apart, faults that every second frame or so.
[[nodiscard]] Scenario disturbed_scenario();

}  // namespace vericansim
