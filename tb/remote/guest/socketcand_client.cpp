// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandClient: see socketcand_client.hpp.
#include "remote/guest/socketcand_client.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <stdexcept>

namespace vericansim {
namespace {

std::uint32_t microseconds() {
  using namespace std::chrono;
  return static_cast<std::uint32_t>(
      duration_cast<std::chrono::microseconds>(steady_clock::now().time_since_epoch()).count());
}

/// `frame ID TIME DATA` or `rtr ID TIME DLC`, nothing for other messages.
std::optional<Frame> frame_of_message(const std::string &message) {
  std::istringstream words{message};
  std::string kind, id, time, rest;
  words >> kind >> id >> time >> rest;
  if (kind != "frame" && kind != "rtr") return std::nullopt;
  Frame frame;
  frame.id = static_cast<std::uint32_t>(std::stoul(id, nullptr, 16));
  frame.extended = id.size() > 3;
  frame.remote = kind == "rtr";
  frame.dlc = static_cast<std::uint8_t>(frame.remote ? std::stoul(rest) : rest.size() / 2);
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(std::stoul(rest.substr(2 * i, 2), nullptr, 16));
  return frame;
}

SocketcandClient &self(void *context) { return *static_cast<SocketcandClient *>(context); }

verican_remote_result_t port_send(void *context, const verican_remote_frame_t *out) {
  Frame frame{out->id, false, out->remote, out->dlc, {}};
  std::copy_n(out->data, frame.data.size(), frame.data.begin());
  return self(context).send(frame) ? VERICAN_REMOTE_OK : VERICAN_REMOTE_BUS_OFF;
}

verican_remote_result_t port_receive(void *context, verican_remote_frame_t *in,
                                     std::uint32_t timeout_us) {
  const std::optional<Frame> frame = self(context).receive(timeout_us);
  if (!frame) return VERICAN_REMOTE_TIMEOUT;
  *in = {static_cast<std::uint16_t>(frame->id), frame->remote, frame->dlc, {}};
  std::copy(frame->data.begin(), frame->data.end(), in->data);
  return VERICAN_REMOTE_OK;
}

std::uint32_t port_now(void * /*context*/) { return microseconds(); }

}  // namespace

SocketcandClient::SocketcandClient(std::uint16_t port)
    : fd_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd_, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0)
    throw std::runtime_error("no server");
  expect("hi");
  say("open can0");
  expect("ok");
  say("rawmode");
  expect("ok");
}

SocketcandClient::~SocketcandClient() { ::close(fd_); }

bool SocketcandClient::send(const Frame &frame) {
  const std::string id =
      frame.extended ? fmt::format("{:08X}", frame.id) : fmt::format("{:03X}", frame.id);
  if (frame.remote) return say(fmt::format("sendrtr {} {}", id, frame.dlc));
  std::string text = fmt::format("send {} {}", id, frame.dlc);
  for (unsigned i = 0; i < frame.payload_size(); ++i) text += fmt::format(" {:02X}", frame.data[i]);
  return say(text);
}

std::optional<Frame> SocketcandClient::receive(std::uint32_t timeout_us) {
  const std::uint32_t start = microseconds();
  for (;;) {
    const std::uint32_t spent = std::min(microseconds() - start, timeout_us);
    const std::optional<std::string> text = message(timeout_us - spent);
    if (!text) return std::nullopt;
    const std::optional<Frame> frame = frame_of_message(*text);
    if (frame && !frame->extended) return frame;
  }
}

verican_remote_port_t SocketcandClient::port() { return {port_send, port_receive, port_now, this}; }

bool SocketcandClient::say(const std::string &message) {
  const std::string bytes = "< " + message + " >";
  return ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(bytes.size());
}

std::optional<std::string> SocketcandClient::message(std::uint32_t timeout_us) {
  for (;;) {
    const std::size_t begin = received_.find('<'), end = received_.find('>');
    if (end != std::string::npos) {
      std::string text = received_.substr(begin + 2, end - begin - 3);
      received_.erase(0, end + 1);
      return text;
    }
    pollfd event{fd_, POLLIN, 0};
    if (::poll(&event, 1, static_cast<int>(timeout_us / 1000)) <= 0) return std::nullopt;
    char bytes[4096];
    const ssize_t count = ::recv(fd_, bytes, sizeof bytes, 0);
    if (count <= 0) return std::nullopt;
    received_.append(bytes, static_cast<std::size_t>(count));
  }
}

void SocketcandClient::expect(const std::string &wanted) {
  constexpr std::uint32_t kPatienceUs = 60'000'000;
  const std::optional<std::string> text = message(kPatienceUs);
  if (text != wanted) throw std::runtime_error("not " + wanted + ": " + text.value_or("nothing"));
}

}  // namespace vericansim
