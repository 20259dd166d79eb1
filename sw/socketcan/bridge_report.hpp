// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BridgeReport: what went over a bridge, for people and for machines.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "port_node.hpp"
#include "scenario/report.hpp"
#include "session/pacer.hpp"

namespace vericansim {

/// One interface.
struct PortReport {
  std::string name;
  bool monitor = false;
  bool up = true;
  bool bus_off = false;
  PortCounts counts;
  std::uint64_t lost = 0;     ///< by the operating system, on the way to the bridge
  std::uint64_t pending = 0;  ///< frames of programs that have not left
  std::uint64_t waiting = 0;  ///< messages that the programs have not taken
};

struct BridgeReport {
  RunReport bus;
  std::vector<PortReport> ports;
  bool fast = false;
  double wall_seconds = 0;
  double cpu_seconds = 0;             ///< of this process
  WallTime lag = 0, largest_lag = 0;  ///< ns
  /// False if a frame was lost or an expectation of the scenario is not met.
  [[nodiscard]] bool ok() const;
};

/// A table for people, as lines.
[[nodiscard]] std::string to_text(const BridgeReport &report);
/// Everything, simulated times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const BridgeReport &report);

}  // namespace vericansim
