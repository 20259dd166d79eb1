// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BridgeReport: see bridge_report.hpp.
#include "bridge_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vericansim {
namespace {

std::string pace_text(const BridgeReport &report) {
  if (report.fast) return "as fast as possible";
  return fmt::format("lag at the end {:.1f} ms, largest {:.1f} ms",
                     static_cast<double>(report.lag) / 1e6,
                     static_cast<double>(report.largest_lag) / 1e6);
}

std::string remarks(const PortReport &port) {
  std::string text;
  const auto add = [&text](std::uint64_t count, const char *what) {
    if (count != 0) text += fmt::format("    {}: {}\n", what, count);
  };
  add(port.lost, "LOST by the kernel before the bridge could read them");
  add(port.counts.overruns, "LOST by the node's software");
  add(port.counts.rejected, "messages of programs that are no CAN 2.0 frames, refused");
  add(port.counts.filtered, "frames kept from the programs by --filter");
  add(port.counts.away, "messages for the programs while the interface was down");
  add(port.counts.bus_off, "times bus-off");
  add(port.waiting, "messages that the programs have not taken");
  if (port.bus_off) text += "    bus-off now\n";
  if (!port.up) text += "    down now\n";
  return text;
}

nlohmann::ordered_json to_json(const PortReport &port) {
  const PortCounts &c = port.counts;
  return {{"name", port.name},
          {"monitor", port.monitor},
          {"up", port.up},
          {"bus_off_now", port.bus_off},
          {"from_host", c.from_host},
          {"sent", c.sent},
          {"pending", port.pending},
          {"rejected", c.rejected},
          {"lost", port.lost},
          {"received", c.received},
          {"overruns", c.overruns},
          {"filtered", c.filtered},
          {"to_host", c.to_host},
          {"echoes", c.echoes},
          {"errors", c.errors},
          {"away", c.away},
          {"waiting", port.waiting},
          {"bus_off", c.bus_off},
          {"restarts", c.restarts}};
}

}  // namespace

bool BridgeReport::ok() const {
  return bus.ok() && std::none_of(ports.begin(), ports.end(), [](const PortReport &port) {
           return port.lost != 0 || port.counts.overruns != 0;
         });
}

std::string to_text(const BridgeReport &report) {
  std::string text = fmt::format("bridge: {:.3f} s of the bus in {:.3f} s ({:.3f} s of CPU), {}\n",
                                 static_cast<double>(report.bus.duration) / kSecond,
                                 report.wall_seconds, report.cpu_seconds, pace_text(report));
  text += fmt::format("  {:<16} {:>10} {:>10} {:>8} {:>10} {:>10} {:>8} {:>8}\n", "interface",
                      "from host", "sent", "to come", "received", "to host", "echoes", "errors");
  for (const PortReport &port : report.ports) {
    const PortCounts &c = port.counts;
    text += fmt::format("  {:<16} {:>10} {:>10} {:>8} {:>10} {:>10} {:>8} {:>8}\n",
                        port.name + (port.monitor ? " (m)" : ""), c.from_host, c.sent, port.pending,
                        c.received, c.to_host, c.echoes, c.errors);
    text += remarks(port);
  }
  return text;
}

nlohmann::ordered_json to_json(const BridgeReport &report) {
  nlohmann::ordered_json ports = nlohmann::ordered_json::array();
  for (const PortReport &port : report.ports) ports.push_back(to_json(port));
  return {{"ok", report.ok()},
          {"fast", report.fast},
          {"wall_seconds", report.wall_seconds},
          {"cpu_seconds", report.cpu_seconds},
          {"lag_ns", report.lag},
          {"largest_lag_ns", report.largest_lag},
          {"ports", ports},
          {"bus", to_json(report.bus)}};
}

}  // namespace vericansim
