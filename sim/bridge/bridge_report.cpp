// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BridgeReport: see bridge_report.hpp.
#include "bridge_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vericansim {

bool BridgeReport::ok() const {
  return bus.ok() &&
         std::all_of(ports.begin(), ports.end(), [](const PortReport &p) { return p.ok(); });
}

std::string to_text(const BridgeReport &report) {
  return fmt::format("bridge: {:.3f} s of the bus in {:.3f} s ({:.3f} s of CPU), {}\n",
                     static_cast<double>(report.bus.duration) / kSecond, report.wall_seconds,
                     report.pace.cpu_seconds, to_text(report.pace)) +
         to_text(report.ports);
}

nlohmann::ordered_json to_json(const BridgeReport &report) {
  nlohmann::ordered_json ports = nlohmann::ordered_json::array();
  for (const PortReport &port : report.ports) ports.push_back(to_json(port));
  nlohmann::ordered_json json{{"ok", report.ok()}, {"wall_seconds", report.wall_seconds}};
  json.update(to_json(report.pace));
  json["ports"] = ports;
  json["bus"] = to_json(report.bus);
  return json;
}

}  // namespace vericansim
