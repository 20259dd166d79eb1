// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortReport: see port_report.hpp.
#include "results/port_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

/// A line for each count that is not 0.
class Remarks {
 public:
  void add(std::uint64_t count, const char *what) {
    if (count != 0) text_ += fmt::format("    {}: {}\n", what, count);
  }
  [[nodiscard]] const std::string &text() const { return text_; }

 private:
  std::string text_;
};

std::string remarks(const PortReport &port) {
  Remarks remarks;
  remarks.add(port.lost, "LOST by the kernel before the bridge could read them");
  remarks.add(port.counts.overruns, "LOST by the node's software");
  remarks.add(port.counts.rejected, "messages of programs that are no CAN 2.0 frames, refused");
  remarks.add(port.counts.filtered, "frames kept from the programs by --filter");
  remarks.add(port.counts.away, "messages for the programs while the interface was down");
  remarks.add(port.counts.bus_off, "times bus-off");
  remarks.add(port.waiting, "messages that the programs have not taken");
  return remarks.text() + (port.bus_off ? "    bus-off now\n" : "") +
         (port.up ? "" : "    down now\n");
}

}  // namespace

std::string to_text(const std::vector<PortReport> &ports) {
  std::string text =
      fmt::format("  {:<16} {:>10} {:>10} {:>8} {:>10} {:>10} {:>8} {:>8}\n", "interface",
                  "from host", "sent", "to come", "received", "to host", "echoes", "errors");
  for (const PortReport &port : ports) {
    const PortCounts &c = port.counts;
    text += fmt::format("  {:<16} {:>10} {:>10} {:>8} {:>10} {:>10} {:>8} {:>8}\n",
                        port.name + (port.monitor ? " (m)" : ""), c.from_host, c.sent, port.pending,
                        c.received, c.to_host, c.echoes, c.errors);
    text += remarks(port);
  }
  return text;
}

std::string to_text(const SocketcandCounts &counts) {
  Remarks remarks;
  remarks.add(counts.refused, "clients that were one too many, refused");
  remarks.add(counts.too_slow, "clients that did not read, disconnected; frames for them are LOST");
  remarks.add(counts.given_up, "frames of clients that had left, too many to be kept: LOST");
  remarks.add(counts.undelivered, "messages for clients that were gone before they had read them");
  remarks.add(counts.bad_commands, "commands answered by an error");
  remarks.add(counts.missed, "periods of jobs left out because the bus was busy");
  return fmt::format("socketcand: {} clients, {} frames from them, {} messages to them\n",
                     counts.clients, counts.from_clients, counts.to_clients) +
         remarks.text();
}

std::string to_text(const PaceReport &pace) {
  if (pace.fast) return "as fast as possible";
  return fmt::format("lag at the end {:.1f} ms, largest {:.1f} ms",
                     static_cast<double>(pace.lag) / 1e6,
                     static_cast<double>(pace.largest_lag) / 1e6);
}

Json to_json(const PortReport &port) {
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

Json to_json(const SocketcandCounts &counts) {
  return {{"clients", counts.clients},           {"refused", counts.refused},
          {"too_slow", counts.too_slow},         {"bad_commands", counts.bad_commands},
          {"from_clients", counts.from_clients}, {"to_clients", counts.to_clients},
          {"undelivered", counts.undelivered},   {"missed", counts.missed},
          {"given_up", counts.given_up}};
}

Json to_json(const PaceReport &pace) {
  return {{"fast", pace.fast},
          {"cpu_seconds", pace.cpu_seconds},
          {"lag_ns", pace.lag},
          {"largest_lag_ns", pace.largest_lag}};
}

}  // namespace vericansim
