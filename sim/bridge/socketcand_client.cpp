// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A client's connection: what is read, what waits for the bus, what is shown to the client.
#include "socketcand_client.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <utility>

namespace vericansim {
namespace {

constexpr std::size_t kReadAtOnce = 4096;

}  // namespace

SocketcandClient::SocketcandClient(std::uint64_t id, int fd, SocketcandShared &shared)
    : id_{id}, shared_{shared}, connection_{fd} {
  connection_.put("< hi >");
  connection_.flush();
}

short SocketcandClient::events() const {
  const bool room = splitter_.waiting() < shared_.limits.input;
  short events = 0;
  if ((room || leaving_) && connection_.input_open()) events |= POLLIN;
  if (connection_.wants_to_write()) events |= POLLOUT;
  return events;
}

std::optional<std::chrono::steady_clock::time_point> SocketcandClient::alarm() const {
  if (leaving_) return told_ + shared_.limits.farewell;
  return connection_.pause_end();
}

bool SocketcandClient::awaits_time() const {
  return !leaving_ && connection_.input_open() &&
         (statistics_interval_ != 0 || broadcast_.awaits_time());
}

void SocketcandClient::read() {
  while (!leaving_ && connection_.input_open() && splitter_.waiting() < shared_.limits.input) {
    const std::string bytes = connection_.read(kReadAtOnce);
    splitter_.feed(bytes);
    if (!connection_.input_open()) splitter_.finish();
    if (bytes.size() < kReadAtOnce) return;
  }
}

void SocketcandClient::work() {
  tick();
  while (!pending_ && !leaving_) {
    const auto item = splitter_.next();
    if (!item) break;
    if (item->good)
      execute(item->text);
    else
      fail(item->text);
  }
  connection_.flush();
  if (leaving_ && connection_.queued() == 0) say_goodbye();
}

std::optional<can_frame> SocketcandClient::take() {
  work();
  std::optional<can_frame> frame;
  const bool ended = !connection_.input_open() || leaving_;
  if (!ended && (jobs_turn_ || !pending_)) frame = broadcast_.due(shared_.now);
  jobs_turn_ = !frame;
  if (!frame) frame = std::exchange(pending_, std::nullopt);
  if (frame) ++shared_.counts.from_clients;
  return frame;
}

std::size_t SocketcandClient::drop_frames() {
  // More than TCP buffers hold: a client that goes on sending does not keep the bridge from ending.
  constexpr std::size_t kMost = std::size_t{64} << 20U;
  std::size_t count = 0;
  for (std::size_t bytes = 0; bytes < kMost && !leaving_;) {
    read();
    bytes += splitter_.waiting();
    if (splitter_.waiting() == 0 && !pending_) break;
    for (work(); pending_; work()) {
      ++count;
      pending_.reset();
    }
  }
  return count;
}

std::size_t SocketcandClient::remaining() {
  const std::size_t count = drop_frames();
  if (count != 0)
    fail(fmt::format("the bus has ended; the last {} frames of this client were not sent", count));
  return count;
}

void SocketcandClient::deliver(const PortMessage &message) {
  if (message.echo && message.client == id_ && !own_messages_) return;
  if (mode_ == kRaw) show(message);
  if (mode_ != kBroadcast) return;
  std::vector<PortMessage> shown;
  broadcast_.receive(message, shown);
  for (const PortMessage &one : shown) show(one);
}

// False if it is thrown away: the client is gone, or has not read for too long and is told to go.
// Those who are told already may still be told why.
bool SocketcandClient::put(const std::string &text) {
  if (!connection_.output_open()) return false;
  if (leaving_ || connection_.queued() <= shared_.limits.output) {
    connection_.put(text);
    return true;
  }
  leave();
  ++shared_.counts.too_slow;
  fail(
      fmt::format("this client reads too slowly, {} bytes wait; it is disconnected and what it "
                  "has sent meanwhile is ignored",
                  connection_.queued()));
  return false;
}

void SocketcandClient::show(const PortMessage &message) {
  const std::string_view separator = mode_ == kBroadcast ? " " : "";
  if (!leaving_ && put(message_text(message, separator))) ++shared_.counts.to_clients;
}

void SocketcandClient::tick() {
  std::vector<PortMessage> due;
  broadcast_.release(shared_.now, due);
  for (const PortMessage &message : due) show(message);
  if (statistics_interval_ == 0 || shared_.now < statistics_due_ || leaving_) return;
  statistics_due_ = shared_.now + statistics_interval_;
  const SocketcandTraffic &traffic = shared_.traffic[*bus_];
  put(fmt::format("\n< stat {} {} {} {} >", traffic.received_bytes, traffic.received_frames,
                  traffic.sent_bytes, traffic.sent_frames));
}

void SocketcandClient::leave() {
  leaving_ = true;
  told_ = std::chrono::steady_clock::now();
  pending_.reset();
}

bool SocketcandClient::connected() const { return connection_.input_open() && !leaving_; }

bool SocketcandClient::done() const {
  const bool delivered = connection_.queued() == 0 || !connection_.output_open();
  if (leaving_)
    return (delivered && !connection_.input_open()) ||
           std::chrono::steady_clock::now() - told_ > shared_.limits.farewell;
  return delivered && !connection_.input_open() && !pending_ && splitter_.waiting() == 0;
}

bool SocketcandClient::flushed() {
  connection_.flush();
  return connection_.queued() == 0 || !connection_.output_open();
}

void SocketcandClient::say_goodbye() {
  connection_.shut_down();
  while (connection_.input_open() && !connection_.read(kReadAtOnce).empty()) {
  }
}

void SocketcandClient::account() {
  shared_.counts.undelivered += connection_.messages_queued();
  shared_.counts.missed += broadcast_.missed();
}

void SocketcandClient::fail(const std::string &text) {
  ++shared_.counts.bad_commands;
  put(error_text(text));
}

}  // namespace vericansim
