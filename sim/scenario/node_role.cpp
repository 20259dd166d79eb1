// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeRole: see node_role.hpp.
#include "scenario/node_role.hpp"

namespace vericansim {
namespace {

const char *name(const TrafficRole &) { return "traffic"; }
const char *name(const FirmwareRole &) { return "firmware"; }
const char *name(const SecondCoreRole &) { return "second_core_of"; }
const char *name(const ReplayRole &) { return "replay"; }
const char *name(const InterfaceRole &) { return "interface"; }
const char *name(const MonitorRole &) { return "monitor"; }
const char *name(const SocketcandRole &) { return "socketcand"; }
const char *name(const RemoteRole &) { return "type: remote"; }
const char *name(const OwnRole &) { return "an operator of its own"; }

}  // namespace

bool has_host(const NodeRole &role) {
  return std::holds_alternative<TrafficRole>(role) || std::holds_alternative<ReplayRole>(role);
}

bool has_programs(const NodeRole &role) {
  return std::holds_alternative<InterfaceRole>(role) ||
         std::holds_alternative<SocketcandRole>(role) || std::holds_alternative<MonitorRole>(role);
}

const char *name_of(const NodeRole &role) {
  return std::visit([](const auto &kind) { return name(kind); }, role);
}

}  // namespace vericansim
