// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandClient: a bus of a socketcand server as a way for the C client.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/frame.hpp"
#include "verican_remote.h"

namespace vericansim {

/// A TCP connection in raw mode.
class SocketcandClient {
 public:
  /// Opens bus can0 of the server at the loopback address. Throws std::runtime_error.
  explicit SocketcandClient(std::uint16_t port);
  ~SocketcandClient();
  SocketcandClient(const SocketcandClient &) = delete;
  SocketcandClient &operator=(const SocketcandClient &) = delete;

  /// False if the server is gone.
  bool send(const Frame &frame);
  /// The oldest frame of a base identifier that has come; waits `timeout_us` for one at most.
  std::optional<Frame> receive(std::uint32_t timeout_us);
  /// For the C client; refers to this object.
  verican_remote_port_t port();

 private:
  bool say(const std::string &message);
  /// What stands between the next pair of < and >.
  std::optional<std::string> message(std::uint32_t timeout_us);
  void expect(const std::string &wanted);

  int fd_;
  std::string received_;
};

}  // namespace vericansim
