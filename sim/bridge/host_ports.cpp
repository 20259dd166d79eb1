// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HostPorts: see host_ports.hpp.
#include "host_ports.hpp"

#include <fmt/format.h>

#include <chrono>

#include "port_operator.hpp"
#include "raw_port.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {
namespace {

/// Host time in which clients may take the last messages.
constexpr std::chrono::seconds kLastMessages{10};

/// How messages name the key of a node: "bus.yaml:7: interface".
std::string place(const OperatorContext &context, const char *key) {
  return fmt::format("{}:{}: {}", context.scenario().file, context.line, key);
}

ErrorChoice choice(const std::string &errors) {
  if (errors == "none") return ErrorChoice::kNone;
  return errors == "state" ? ErrorChoice::kState : ErrorChoice::kOwn;
}

PortOptions options_of(const ProgramSettings &programs) {
  return {choice(programs.errors), programs.filters, programs.restart};
}

}  // namespace

std::unique_ptr<Operator> HostPorts::make(const OperatorContext &context) {
  if (std::holds_alternative<InterfaceRole>(context.role)) return make_interface(context);
  if (std::holds_alternative<MonitorRole>(context.role)) return make_monitor(context);
  if (std::holds_alternative<SocketcandRole>(context.role)) return make_socketcand(context);
  return nullptr;
}

std::unique_ptr<Operator> HostPorts::make_interface(const OperatorContext &context) const {
  const auto &role = std::get<InterfaceRole>(context.role);
  RawPortOptions raw;
  raw.echo = role.echo;
  raw.queue = role.queue;
  raw.option = place(context, "interface");
  return std::make_unique<PortOperator>(context, std::make_shared<RawCanPort>(role.interface, raw),
                                        options_of(role.programs), role.end_when_down);
}

std::unique_ptr<Operator> HostPorts::make_monitor(const OperatorContext &context) const {
  RawPortOptions raw;
  raw.receives = false;
  raw.option = place(context, "monitor");
  const auto &role = std::get<MonitorRole>(context.role);
  return std::make_unique<MonitorOperator>(std::make_shared<RawCanPort>(role.interface, raw),
                                           ErrorChoice::kOwn, false);
}

// The nodes of one address are the buses of one server, which has to know all of them at once.
HostPorts::Server &HostPorts::server_for(const OperatorContext &context,
                                         const std::string &address) {
  Server &server = servers_[address];
  if (server.server) return server;
  std::vector<std::string> names;
  for (const NodeSpec &node : context.scenario().nodes)
    if (const auto *role = std::get_if<SocketcandRole>(&node.role);
        role != nullptr && role->address == address) {
      names.push_back(node.name);
      server.clients = std::max<std::size_t>(server.clients, role->wait_for_clients);
    }
  server.server = std::make_unique<SocketcandServer>(
      SocketcandAddress::parse(place(context, "socketcand"), address), names);
  for (auto &port : server.server->ports()) {
    const std::string name = port->name();
    server.ports[name] = std::move(port);
  }
  return server;
}

std::unique_ptr<Operator> HostPorts::make_socketcand(const OperatorContext &context) {
  const auto &role = std::get<SocketcandRole>(context.role);
  Server &server = server_for(context, role.address);
  auto made = std::make_unique<PortOperator>(context, server.ports.at(context.name),
                                             options_of(role.programs), false);
  // The first node of a server speaks for all.
  if (server.server->buses().front() == context.name)
    made->on_close = [&server](RunReport &report) {
      server.server->finish(kLastMessages);
      report.servers.push_back(server.server->counts());
    };
  return made;
}

std::vector<std::string> HostPorts::descriptions() const {
  std::vector<std::string> lines;
  for (const auto &[address, server] : servers_) lines.push_back(server.server->description());
  return lines;
}

void HostPorts::wait_for_clients(Wall &wall, const std::function<void(const std::string &)> &say) {
  for (auto &[address, server] : servers_)
    server.server->wait_for_clients(server.clients, wall, say);
}

}  // namespace vericansim
