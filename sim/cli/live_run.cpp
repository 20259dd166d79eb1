// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See live_run.hpp.
#include "cli/live_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bridge/host_ports.hpp"
#include "cli/cli.hpp"
#include "cli/console.hpp"
#include "cli/print_error.hpp"
#include "session/session.hpp"
#include "simulation/fault_check.hpp"
#include "simulation/node_timing.hpp"
#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

void tell(const std::string &line) {
  print_error("verican: {}\n", line);
  std::fflush(stderr);
}

/// Who watches the bus reads it at its bit rate: where no node has that, all of it would be errors.
void check_some_node_has(const Scenario &scenario, double bitrate) {
  constexpr double kTolerance = 0.05;  // more than clocks are off by
  const auto other = [bitrate](const NodeSpec &node) {
    return std::abs(node.bitrate.value_or(bitrate) / bitrate - 1) > kTolerance;
  };
  if (scenario.nodes.empty() || !std::ranges::all_of(scenario.nodes, other)) return;
  throw InputError(scenario.file, scenario.nodes.front().line,
                   fmt::format("each node has a 'bitrate' of its own, none that of the bus, {:g} "
                               "bit/s; allowed: a bit rate of the bus that a node has",
                               bitrate));
}

/// Programs are told where they find the bus, and may come before it begins.
void open_to_programs(HostPorts &ports, Wall &wall) {
  for (const std::string &line : ports.descriptions()) tell(line);
  ports.wait_for_clients(wall, tell);
}

}  // namespace

RunReport simulate(const Scenario &scenario, double bitrate, bool prints) {
  Console console{false};
  Progress progress{fmt::format("{:g} kbit/s", bitrate / 1e3)};
  HostPorts ports;
  HostWall wall;
  SessionOptions setup;
  setup.factories = {&ports};
  setup.wall = &wall;
  setup.say = tell;
  if (!scenario.endless || scenario.until_done)
    setup.progress = [&](double part) { progress.show(part); };
  setup.output = [&](std::string_view node, std::string_view text) {
    if (prints) console.print(node, text);
  };
  Session session{{{scenario, bitrate}}, std::move(setup)};
  open_to_programs(ports, wall);
  session.start();
  if (session.has_outlets()) tell("ready");
  while (session.round()) {
  }
  return session.finish().front();
}

int exit_code_of(const RunReport &report) {
  const int code = exit_code_of(report.boards, report.ok() ? kOk : kFailed);
  return report.interrupted ? exit_code_after(code) : code;
}

void check_bitrates(const Scenario &scenario) {
  for (const double bitrate : scenario.bitrates) {
    check_faults(scenario, bitrate);
    check_some_node_has(scenario, bitrate);
    for (const NodeSpec &node : scenario.nodes)
      static_cast<void>(timing_of(scenario, node, bitrate));
  }
}

double only_bitrate(const Scenario &scenario, double wanted) {
  if (wanted != 0) return wanted;
  if (scenario.bitrates.size() != 1)
    throw InputError(scenario.file, 0, "has several bit rates; --bitrate says which");
  return scenario.bitrates.front();
}

}  // namespace vericansim::cli
