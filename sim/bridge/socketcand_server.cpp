// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The server and its ports. A port is a thin front; the first one carries the work of polling.
#include "socketcand_server.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// Longest name of a bus in the protocol.
constexpr std::size_t kLongestName = 16;

/// Descriptors in the poll set before those of clients: the listening socket and the timer.
constexpr std::size_t kOthers = 2;

void check_names(const std::vector<std::string> &names) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    const bool good = std::all_of(name->begin(), name->end(), [](char c) {
      return c > 0x20 && c < 0x7F && c != '<' && c != '>';
    });
    if (name->empty() || name->size() > kLongestName || !good)
      throw InputError("--bus-name", 0,
                       in_quotes(*name) +
                           " is not allowed; allowed: 1 to 16 printable characters "
                           "without blanks, '<' and '>'");
    if (std::find(names.begin(), name, *name) != name)
      throw InputError("--bus-name", 0, in_quotes(*name) + " is named twice");
  }
}

}  // namespace

/// The port for one bus.
class SocketcandServer::Bus : public CanPort {
 public:
  Bus(SocketcandServer &server, std::size_t index) : server_{server}, index_{index} {}

  [[nodiscard]] const std::string &name() const override { return server_.shared_.buses[index_]; }
  void poll_set(std::vector<pollfd> &set, bool /*wants_room*/) override {
    if (index_ == 0) server_.poll_set(set);
  }
  void service(std::span<const pollfd> ready) override {
    if (index_ == 0) server_.service(ready);
  }
  [[nodiscard]] std::optional<PortMessage> take() override { return server_.take(index_); }
  [[nodiscard]] std::size_t remaining() override { return server_.remaining(index_); }
  [[nodiscard]] bool put(const PortMessage &message) override {
    server_.put(index_, message);
    return true;
  }
  [[nodiscard]] bool up() const override { return true; }
  [[nodiscard]] bool wants_echo() const override { return true; }
  void tick(Time now) override { server_.shared_.now = now; }
  [[nodiscard]] bool awaits_time() const override {
    const auto &clients = server_.clients_;
    return index_ == 0 && std::any_of(clients.begin(), clients.end(),
                                      [](const auto &client) { return client->awaits_time(); });
  }

 private:
  SocketcandServer &server_;
  std::size_t index_;
};

SocketcandServer::SocketcandServer(const SocketcandAddress &address, std::vector<std::string> buses,
                                   const SocketcandLimits &limits)
    : listener_{address.option, address},
      timer_{::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)} {
  check_names(buses);
  shared_.buses = std::move(buses);
  shared_.limits = limits;
  shared_.traffic.resize(shared_.buses.size());
}

SocketcandServer::~SocketcandServer() { ::close(timer_); }

std::vector<std::unique_ptr<CanPort>> SocketcandServer::ports() {
  std::vector<std::unique_ptr<CanPort>> ports;
  for (std::size_t i = 0; i < shared_.buses.size(); ++i)
    ports.push_back(std::make_unique<Bus>(*this, i));
  return ports;
}

void SocketcandServer::serve(const std::function<void(std::vector<pollfd> &)> &wait) {
  std::vector<pollfd> set;
  poll_set(set);
  wait(set);
  service(set);
}

void SocketcandServer::wait_for_clients(std::size_t count, Wall &wall,
                                        const std::function<void(const std::string &)> &say) {
  if (receiving() < count)
    say(fmt::format("waits for {} client{} on {}", count, count == 1 ? "" : "s",
                    fmt::join(buses(), " ")));
  while (receiving() < count && !wall.stop_requested())
    serve([&wall](std::vector<pollfd> &set) { wall.wait(set, std::nullopt); });
}

std::string SocketcandServer::description() const {
  return fmt::format("socketcand {} at {}", fmt::join(buses(), " "), address().text());
}

std::size_t SocketcandServer::receiving() const {
  return static_cast<std::size_t>(std::count_if(
      clients_.begin(), clients_.end(), [](const auto &client) { return client->receiving(); }));
}

// The steady clock is CLOCK_MONOTONIC here.
void SocketcandServer::set_timer() const {
  std::optional<std::chrono::steady_clock::time_point> first;
  for (const auto &client : clients_)
    if (const auto alarm = client->alarm()) first = std::min(first.value_or(*alarm), *alarm);
  itimerspec time{};
  if (first) {
    const auto since = first->time_since_epoch();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since);
    time.it_value.tv_sec = seconds.count();
    time.it_value.tv_nsec = std::chrono::nanoseconds(since - seconds).count() + 1;
  }
  ::timerfd_settime(timer_, TFD_TIMER_ABSTIME, &time, nullptr);
}

void SocketcandServer::poll_set(std::vector<pollfd> &set) {
  set_timer();
  set.push_back({.fd = listener_.fd(), .events = POLLIN, .revents = 0});
  set.push_back({.fd = timer_, .events = POLLIN, .revents = 0});
  polled_.clear();
  for (const auto &client : clients_) {
    const short events = client->events();
    // A closed connection that is not read now would keep poll() from waiting.
    if (events == 0) continue;
    set.push_back({.fd = client->fd(), .events = events, .revents = 0});
    polled_.push_back(client->id());
  }
}

void SocketcandServer::service(std::span<const pollfd> ready) {
  if (ready.size() != polled_.size() + kOthers) return;
  for (std::size_t i = 0; i < polled_.size(); ++i) {
    if (ready[i + kOthers].revents == 0) continue;
    const auto client = std::find_if(clients_.begin(), clients_.end(),
                                     [&](const auto &entry) { return entry->id() == polled_[i]; });
    if (client != clients_.end()) (*client)->read();
  }
  for (const auto &client : clients_) client->work();
  remove_done();
  give_up_departed();
  if (ready.front().revents != 0) accept_clients();
}

void SocketcandServer::remove_done() {
  const auto gone = std::stable_partition(clients_.begin(), clients_.end(),
                                          [](const auto &client) { return !client->done(); });
  for (auto client = gone; client != clients_.end(); ++client) (*client)->account();
  clients_.erase(gone, clients_.end());
}

std::size_t SocketcandServer::connected() const {
  return static_cast<std::size_t>(std::count_if(
      clients_.begin(), clients_.end(), [](const auto &client) { return client->connected(); }));
}

// A bus that takes nothing must not fill the memory with the frames of those who come and go.
void SocketcandServer::give_up_departed() {
  for (std::size_t departed = clients_.size() - connected(); departed > shared_.limits.departed;
       --departed) {
    const auto oldest =
        std::min_element(clients_.begin(), clients_.end(), [](const auto &a, const auto &b) {
          return std::pair{a->connected(), a->id()} < std::pair{b->connected(), b->id()};
        });
    shared_.counts.given_up += (*oldest)->drop_frames();
    (*oldest)->account();
    clients_.erase(oldest);
  }
}

void SocketcandServer::accept_clients() {
  for (int fd = listener_.accept(); fd >= 0; fd = listener_.accept()) {
    if (connected() < shared_.limits.clients) {
      clients_.push_back(std::make_unique<SocketcandClient>(next_id_++, fd, shared_));
      ++shared_.counts.clients;
      continue;
    }
    const auto text =
        error_text(fmt::format("there are {} clients, more are not allowed", connected()));
    // A fresh socket takes a short message at once.
    static_cast<void>(::send(fd, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
    ::close(fd);
    ++shared_.counts.refused;
  }
}

std::optional<PortMessage> SocketcandServer::take(std::size_t bus) {
  for (auto client = clients_.begin(); client != clients_.end(); ++client) {
    if ((*client)->bus() != bus) continue;
    const auto frame = (*client)->take();
    if (!frame) continue;
    PortMessage message{.frame = *frame, .client = (*client)->id()};
    // The next call asks the others first.
    std::rotate(client, client + 1, clients_.end());
    return message;
  }
  return std::nullopt;
}

std::size_t SocketcandServer::remaining(std::size_t bus) {
  std::size_t count = 0;
  for (const auto &client : clients_)
    if (client->bus() == bus) count += client->remaining();
  return count;
}

void SocketcandServer::put(std::size_t bus, const PortMessage &message) {
  SocketcandTraffic &traffic = shared_.traffic[bus];
  const can_frame &frame = message.frame;
  const bool remote = (frame.can_id & CAN_RTR_FLAG) != 0;
  if ((frame.can_id & CAN_ERR_FLAG) == 0) {
    (message.echo ? traffic.sent_bytes : traffic.received_bytes) += remote ? 0U : frame.len;
    ++(message.echo ? traffic.sent_frames : traffic.received_frames);
  }
  for (const auto &client : clients_)
    if (client->bus() == bus) client->deliver(message);
}

void SocketcandServer::finish(std::chrono::milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  const auto waiting = [](const auto &client) { return !client->flushed(); };
  while (std::any_of(clients_.begin(), clients_.end(), waiting) &&
         std::chrono::steady_clock::now() < end) {
    std::vector<pollfd> set;
    for (const auto &client : clients_)
      if (!client->flushed()) set.push_back({.fd = client->fd(), .events = POLLOUT, .revents = 0});
    // A pause of the output is not seen by poll(), so that it is asked again soon.
    ::poll(set.data(), set.size(), 10);
  }
  for (const auto &client : clients_) {
    client->say_goodbye();
    client->account();
  }
  clients_.clear();
}

}  // namespace vericansim
