// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican bridge --socketcand: options, start and report of the socketcand server.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bridge/bridge.hpp"
#include "bridge/socketcand_server.hpp"
#include "cli/cli.hpp"

namespace vericansim::cli {

struct SocketcandOptions {
  std::string address;  ///< empty: no server
  std::vector<std::string> buses;
  unsigned wait_for_clients = 0;
};

void add_socketcand_options(CLI::App &command, SocketcandOptions &options);

/// Names of the buses, each a node; none if no server is wanted.
[[nodiscard]] std::vector<std::string> bus_names(const SocketcandOptions &options);

/// Starts the server and adds its buses to the ports of `setup`; nullptr if it is not wanted. The
/// server has to outlive the bridge. InputError: options that cannot be used.
[[nodiscard]] std::unique_ptr<SocketcandServer> open_socketcand(const SocketcandOptions &options,
                                                                BridgeSetup &setup);

}  // namespace vericansim::cli
