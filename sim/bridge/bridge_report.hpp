// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BridgeReport: what went over a bridge, for people and for machines.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "results/port_report.hpp"
#include "results/report.hpp"

namespace vericansim {

struct BridgeReport {
  RunReport bus;
  std::vector<PortReport> ports;
  PaceReport pace;
  double wall_seconds = 0;
  /// False if a frame was lost or an expectation of the scenario is not met.
  [[nodiscard]] bool ok() const;
};

/// A table for people, as lines.
[[nodiscard]] std::string to_text(const BridgeReport &report);
/// Everything, simulated times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const BridgeReport &report);

}  // namespace vericansim
