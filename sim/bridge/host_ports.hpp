// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HostPorts: makes the nodes of a scenario that are CAN interfaces or socketcand clients.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "session/operator.hpp"
#include "session/wall.hpp"
#include "socketcand_server.hpp"

namespace vericansim {

/// The factory of `interface`, `monitor` and `socketcand` nodes. Opens interfaces and servers when
/// the session is built, and must outlive it.
class HostPorts : public OperatorFactory {
 public:
  /// Throws InputError if an interface or an address cannot be used.
  [[nodiscard]] std::unique_ptr<Operator> make(const OperatorContext &context) override;

  /// "socketcand can0 can1 at 127.0.0.1:29536", one for each server.
  [[nodiscard]] std::vector<std::string> descriptions() const;
  /// Serves until as many clients receive as the nodes want, or somebody wants the end; `say` tells
  /// what it waits for.
  void wait_for_clients(Wall &wall, const std::function<void(const std::string &)> &say);

 private:
  /// A server and the ports that no node has taken yet.
  struct Server {
    std::unique_ptr<SocketcandServer> server;
    std::map<std::string, std::shared_ptr<CanPort>> ports;
    std::size_t clients = 0;
  };

  [[nodiscard]] std::unique_ptr<Operator> make_interface(const OperatorContext &context) const;
  [[nodiscard]] std::unique_ptr<Operator> make_monitor(const OperatorContext &context) const;
  [[nodiscard]] std::unique_ptr<Operator> make_socketcand(const OperatorContext &context);
  Server &server_for(const OperatorContext &context, const std::string &address);

  std::map<std::string, Server> servers_;  // by address, as the scenario has it
};

}  // namespace vericansim
