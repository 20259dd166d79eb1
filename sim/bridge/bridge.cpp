// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bridge: see bridge.hpp.
#include "bridge.hpp"

#include <fmt/format.h>

#include <utility>

#include "port_operator.hpp"

namespace vericansim {
namespace {

std::string describe(const BridgeSetup &setup, const std::string &names) {
  const std::size_t count = setup.scenario.nodes.size();
  return fmt::format("{} on a bus of {} node{} at {:g} kbit/s{}", names, count,
                     count == 1 ? "" : "s", setup.bitrate / 1e3,
                     setup.fast ? ", as fast as possible" : "");
}

OwnRole role_of(const BridgeSetup &setup, std::shared_ptr<CanPort> port) {
  return {[port = std::move(port), options = setup.options,
           ends = setup.end_when_down](const OperatorContext &context) {
    return std::make_unique<PortOperator>(context, port, options, ends);
  }};
}

OwnRole monitor_role(const BridgeSetup &setup, std::shared_ptr<CanPort> port) {
  return {[port = std::move(port), errors = setup.options.errors,
           ends = setup.end_when_down](const OperatorContext &) {
    return std::make_unique<MonitorOperator>(port, errors, ends);
  }};
}

}  // namespace

Bridge::Bridge(BridgeSetup setup, Wall &wall) {
  std::string names;
  for (auto &port : setup.ports) {
    const NodeId id = take_buffers(setup.scenario, port->name(), "programs of the host work",
                                   setup.port_clock_hz);
    names += (names.empty() ? "" : ", ") + port->name();
    setup.scenario.nodes[id].role = role_of(setup, std::move(port));
  }
  description_ = describe(setup, names);
  if (setup.monitor) {
    const std::string name = setup.monitor->name();
    setup.scenario.listeners.push_back({name, monitor_role(setup, std::move(setup.monitor)), 0});
  }
  setup.scenario.pacing = setup.fast ? Pacing::kFast : Pacing::kRealTime;
  // Its traffic goes on as long as the bridge does.
  setup.scenario.endless = true;
  // With programs a recording that has been sent is no end, unless the file wants it to be.
  setup.scenario.until_done = setup.scenario.done_given;
  SessionOptions options;
  options.limit = setup.limit;
  options.wall = &wall;
  options.say = setup.say;
  std::vector<SessionBus> buses;
  buses.push_back({std::move(setup.scenario), setup.bitrate});
  session_ = std::make_unique<Session>(std::move(buses), std::move(options));
}

BridgeReport Bridge::finish() {
  BridgeReport report;
  report.bus = session_->finish().front();
  report.ports = std::exchange(report.bus.ports, {});
  report.pace = *std::exchange(report.bus.pace, std::nullopt);
  report.wall_seconds = report.bus.wall_seconds;
  return report;
}

BridgeReport Bridge::run() {
  start();
  while (round()) {
  }
  return finish();
}

}  // namespace vericansim
