// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Loopback sockets, non-blocking on both sides.
#include "socketcan/socketcand_bench.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace vericansim {

SocketcandTestClient::SocketcandTestClient(std::uint16_t port, int receive_buffer)
    : fd_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
  if (receive_buffer > 0)
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  const int on = 1;
  ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(port);
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd_, reinterpret_cast<sockaddr *>(&name), sizeof name) != 0)
    throw std::runtime_error("cannot connect to the server under test");
  ::fcntl(fd_, F_SETFL, O_NONBLOCK);
}

SocketcandTestClient::~SocketcandTestClient() {
  if (fd_ >= 0) ::close(fd_);
}

std::size_t SocketcandTestClient::send(std::string_view bytes) const {
  const ssize_t count = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

void SocketcandTestClient::read() {
  char bytes[4096];
  ssize_t count = 0;
  while ((count = ::recv(fd_, bytes, sizeof bytes, 0)) > 0)
    received_.append(bytes, static_cast<std::size_t>(count));
  if (count == 0 || (errno != EAGAIN && errno != EINTR)) closed_ = true;
}

std::string SocketcandTestClient::taken() { return std::exchange(received_, {}); }

void SocketcandTestClient::half_close() const { ::shutdown(fd_, SHUT_WR); }

void SocketcandTestClient::vanish(bool reset) {
  const linger at_once{.l_onoff = 1, .l_linger = 0};
  if (reset) ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  ::close(fd_);
  fd_ = -1;
}

SocketcandBench::SocketcandBench(std::vector<std::string> buses, SocketcandLimits limits)
    : server_{std::make_unique<SocketcandServer>(SocketcandAddress{"127.0.0.1", 0},
                                                 std::move(buses), limits)},
      ports_{server_->ports()} {}

void SocketcandBench::step() {
  std::vector<pollfd> set;
  std::vector<std::size_t> begin;
  for (const auto &port : ports_) {
    port->tick(now);
    begin.push_back(set.size());
    port->poll_set(set, false);
  }
  begin.push_back(set.size());
  ::poll(set.data(), set.size(), wait_ms);
  const std::span<const pollfd> all{set};
  for (std::size_t i = 0; i < ports_.size(); ++i)
    ports_[i]->service(all.subspan(begin[i], begin[i + 1] - begin[i]));
  for (const auto &port : ports_) exchange(*port);
}

void SocketcandBench::exchange(CanPort &port) {
  while (room > 0) {
    auto message = port.take();
    if (!message) return;
    --room;
    now += 100 * kMicrosecond;
    message->time = now;
    sent.push_back({port.name(), *message});
    for (const auto &other : ports_) {
      PortMessage shown = *message;
      shown.echo = other.get() == &port;
      if (!shown.echo) shown.client = PortMessage::kNobody;
      if (!other->put(shown)) throw std::logic_error("a socketcand port always has room");
    }
  }
}

bool SocketcandBench::busy() {
  std::vector<pollfd> set;
  for (const auto &port : ports_) port->poll_set(set, false);
  return ::poll(set.data(), set.size(), 0) > 0;
}

bool SocketcandBench::until(const std::function<bool()> &done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    step();
  }
  return true;
}

bool SocketcandBench::expect(SocketcandTestClient &client, const std::string &text) {
  const bool found = until([&] {
    client.read();
    return client.received().find(text) != std::string::npos;
  });
  if (found) client.taken();
  return found;
}

bool SocketcandBench::send(SocketcandTestClient &client, std::string_view bytes) {
  return until([&] {
    bytes.remove_prefix(client.send(bytes));
    return bytes.empty();
  });
}

std::unique_ptr<SocketcandTestClient> SocketcandBench::raw_client(const std::string &bus) {
  auto client = std::make_unique<SocketcandTestClient>(port());
  const bool open = expect(*client, "< hi >") && send(*client, "< open " + bus + " >") &&
                    expect(*client, "< ok >") && send(*client, "< rawmode >") &&
                    expect(*client, "< ok >");
  if (!open) throw std::runtime_error("no raw mode");
  return client;
}

void SocketcandBench::frame_from_bus(canid_t id, std::vector<unsigned char> data) {
  can_frame frame{};
  frame.can_id = id;
  frame.len = static_cast<__u8>(data.size());
  std::copy(data.begin(), data.end(), frame.data);
  message_from_bus(frame);
}

void SocketcandBench::message_from_bus(const can_frame &frame) {
  now += 100 * kMicrosecond;
  for (const auto &port : ports_)
    if (!port->put({.frame = frame, .time = now}))
      throw std::logic_error("a socketcand port always has room");
}

}  // namespace vericansim
