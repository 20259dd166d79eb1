// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandBench: a socketcand server with real TCP clients, and a bus made of a list in place of
// the simulated one. One thread; waiting means that the server works.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bridge/socketcand_server.hpp"

namespace vericansim {

/// A TCP client that speaks the protocol by hand.
class SocketcandTestClient {
 public:
  /// Connects to the loopback address.
  explicit SocketcandTestClient(std::uint16_t port, int receive_buffer = 0);
  ~SocketcandTestClient();
  SocketcandTestClient(const SocketcandTestClient &) = delete;
  SocketcandTestClient &operator=(const SocketcandTestClient &) = delete;

  /// Sends what the window allows; the number of bytes.
  std::size_t send(std::string_view bytes) const;
  /// Reads what there is into received().
  void read();
  [[nodiscard]] const std::string &received() const { return received_; }
  /// received(), and forgets it.
  std::string taken();
  /// True once the server has closed.
  [[nodiscard]] bool closed() const { return closed_; }
  /// No more is sent; reading goes on.
  void half_close() const;
  /// Vanishes, with a reset if `reset`.
  void vanish(bool reset);

 private:
  int fd_;
  std::string received_;
  bool closed_ = false;
};

/// The server, and the bus: a frame that is taken is at once sent, 100 us later.
class SocketcandBench {
 public:
  explicit SocketcandBench(std::vector<std::string> buses = {"can0"}, SocketcandLimits limits = {});

  SocketcandServer &server() { return *server_; }
  [[nodiscard]] std::uint16_t port() const { return server_->address().port; }
  /// One round of the bridge.
  void step();
  /// Frames of clients of the first bus that have not been taken.
  std::size_t remaining() { return ports_.front()->remaining(); }
  /// True if poll() would not wait now.
  bool busy();
  /// Rounds until `done`; false after 20 s of host time.
  bool until(const std::function<bool()> &done);
  /// Rounds until `client` has received `text`, which is then forgotten with all before it.
  bool expect(SocketcandTestClient &client, const std::string &text);
  /// Sends all of `bytes`, with rounds as long as the window is closed.
  bool send(SocketcandTestClient &client, std::string_view bytes);
  /// A client in raw mode on `bus`.
  std::unique_ptr<SocketcandTestClient> raw_client(const std::string &bus = "can0");
  /// A frame of another node of the bus.
  void frame_from_bus(canid_t id, std::vector<unsigned char> data);
  void message_from_bus(const can_frame &frame);

  std::size_t room = SIZE_MAX;  ///< frames that the bus still takes
  Time now = 0;
  int wait_ms = 1;  ///< how long a round waits for clients
  /// What has been sent on the bus, with the name of the port.
  struct Sent {
    std::string bus;
    PortMessage message;
  };
  std::vector<Sent> sent;

 private:
  void exchange(CanPort &port);

  std::unique_ptr<SocketcandServer> server_;
  std::vector<std::unique_ptr<CanPort>> ports_;
};

}  // namespace vericansim
