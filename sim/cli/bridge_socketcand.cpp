// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See bridge_socketcand.hpp.
#include "cli/bridge_socketcand.hpp"

namespace vericansim::cli {

void add_socketcand_options(CLI::App &command, SocketcandOptions &options) {
  CLI::Option *address = command.add_option(
      "--socketcand", options.address,
      "Offer nodes by the socketcand protocol at [ADDRESS:]PORT (address 127.0.0.1; port 0: any "
      "free one; usual: 29536)");
  command
      .add_option("--bus-name", options.buses,
                  "Name of a bus for socketcand, each a node; may be repeated (can0)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(address);
  command
      .add_option("--wait-for-clients", options.wait_for_clients,
                  "Begin when so many socketcand clients receive (0)")
      ->check(CLI::Range(0, 64))
      ->needs(address);
}

std::vector<std::string> bus_names(const SocketcandOptions &options) {
  if (options.address.empty()) return {};
  return options.buses.empty() ? std::vector<std::string>{"can0"} : options.buses;
}

std::unique_ptr<SocketcandServer> open_socketcand(const SocketcandOptions &options,
                                                  BridgeSetup &setup) {
  if (options.address.empty()) return nullptr;
  auto server = std::make_unique<SocketcandServer>(
      SocketcandAddress::parse("--socketcand", options.address), bus_names(options));
  for (auto &port : server->ports()) setup.ports.push_back(std::move(port));
  return server;
}

}  // namespace vericansim::cli
