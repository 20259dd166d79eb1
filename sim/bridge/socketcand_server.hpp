// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandServer: offers nodes of the simulated bus to TCP clients by the socketcand protocol.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "can_port.hpp"
#include "session/wall.hpp"
#include "socketcand_client.hpp"
#include "socketcand_limits.hpp"
#include "socketcand_listener.hpp"

namespace vericansim {

/// One listening socket, one or several buses, several clients at once. Each bus is a CanPort, the
/// CAN interface of one node; the clients of one bus share it as programs share an interface.
class SocketcandServer {
 public:
  /// Listens. InputError: see SocketcandListener; a name of a bus that is empty, longer than 16
  /// characters, there twice, or holds a blank, a bracket or a byte that is not printable ASCII.
  SocketcandServer(const SocketcandAddress &address, std::vector<std::string> buses,
                   const SocketcandLimits &limits = {});
  ~SocketcandServer();
  SocketcandServer(const SocketcandServer &) = delete;
  SocketcandServer &operator=(const SocketcandServer &) = delete;

  /// Where it listens.
  [[nodiscard]] const SocketcandAddress &address() const { return listener_.address(); }
  /// Names of the buses.
  [[nodiscard]] const std::vector<std::string> &buses() const { return shared_.buses; }
  /// "socketcand can0 can1 at 127.0.0.1:29536".
  [[nodiscard]] std::string description() const;
  /// A port for each bus, in the order of the names; the server has to outlive them. The first
  /// looks after the descriptors of all.
  [[nodiscard]] std::vector<std::unique_ptr<CanPort>> ports();
  /// For the time when no bridge looks after the ports: accepts clients and answers them. `wait`
  /// is to poll the set.
  void serve(const std::function<void(std::vector<pollfd> &)> &wait);
  /// Serves until so many clients get frames, or somebody wants the end. What it waits for, if it
  /// does, is told by `say`.
  void wait_for_clients(std::size_t count, Wall &wall,
                        const std::function<void(const std::string &)> &say);
  /// Clients that get frames: in raw mode or with a filter.
  [[nodiscard]] std::size_t receiving() const;
  /// Sends what is queued, for at most `time` (host time), and closes all connections in order.
  void finish(std::chrono::milliseconds time);
  [[nodiscard]] const SocketcandCounts &counts() const { return shared_.counts; }

 private:
  class Bus;

  void poll_set(std::vector<pollfd> &set);
  void set_timer() const;
  void service(std::span<const pollfd> ready);
  [[nodiscard]] std::optional<PortMessage> take(std::size_t bus);
  [[nodiscard]] std::size_t remaining(std::size_t bus);
  void put(std::size_t bus, const PortMessage &message);
  void accept_clients();
  void remove_done();
  void give_up_departed();
  [[nodiscard]] std::size_t connected() const;

  SocketcandShared shared_;
  SocketcandListener listener_;
  int timer_;  ///< for pauses in host time
  std::vector<std::unique_ptr<SocketcandClient>> clients_;
  std::vector<std::uint64_t> polled_;  ///< clients in the order of the last poll_set()
  std::uint64_t next_id_ = PortMessage::kNobody + 1;
};

}  // namespace vericansim
