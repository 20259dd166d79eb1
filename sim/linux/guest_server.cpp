// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GuestServer: see guest_server.hpp.
#include "linux/guest_server.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <utility>

#include "simulation/stop_request.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

// 2026-01-01T00:00:00Z: a guest's date does not depend on the day of the test.
constexpr std::uint64_t kTimeOfDay = 1'767'225'600ULL * 1'000'000'000ULL;
// A guest that waits this long without a timer of its own will never wake up.
constexpr std::uint64_t kLongestSleep = 3600ULL * 1'000'000'000ULL;
constexpr std::size_t kLongestCommand = 4096;
// Within what the simulator's time holds (106 days).
constexpr std::uint64_t kLongestRun = 100ULL * 24 * kLongestSleep;

// Between two questions whether to give up, also while the guest is silent.
constexpr std::chrono::milliseconds kPatience{200};

[[noreturn]] void refuse_guest(const std::string &what) { throw InputError("the guest", 0, what); }

}  // namespace

GuestServer::GuestServer(Board &board, const std::string &directory)
    : board_{board},
      calendar_{kTimeOfDay},
      time_listener_{directory + "/time"},
      register_listener_{directory + "/registers"},
      interrupt_listener_{directory + "/interrupts"} {}

void GuestServer::serve(std::function<bool()> given_up) {
  given_up_ = std::move(given_up);
  next_question_ = std::chrono::steady_clock::now() + kPatience;
  while (!ended()) {
    wait_for_guest();
    if (!over_ && calendar_.waiting()) let_time_pass();
  }
}

bool GuestServer::ended() {
  const auto now = std::chrono::steady_clock::now();
  if (!over_ && now >= next_question_) {
    over_ = given_up_();
    next_question_ = now + kPatience;
  }
  return over_ || stop_requested();
}

// Serves what the guest has sent, or waits for it.
void GuestServer::wait_for_guest() {
  const auto wanted = [](const Channel &channel, const Listener &listener) {
    return pollfd{channel.open() ? channel.get() : listener.get(), POLLIN, 0};
  };
  std::array fds{wanted(time_, time_listener_), wanted(registers_, register_listener_),
                 wanted(interrupt_, interrupt_listener_)};
  // An interrupt channel that is open has something to say in tell_interrupt() only.
  const nfds_t watched = interrupt_.open() ? 2 : 3;
  const int ready = ::poll(fds.data(), watched, kPatience.count());
  if (ready < 0 && errno != EINTR) throw std::runtime_error("waiting for the guest failed");
  if (ready <= 0) return;
  if (fds[0].revents != 0) {
    if (time_.open())
      serve_time();
    else
      time_ = time_listener_.accept();
  }
  if (fds[1].revents != 0 && !over_) {
    if (registers_.open())
      serve_registers();
    else
      registers_ = register_listener_.accept();
  }
  if (watched == 3 && fds[2].revents != 0) interrupt_ = interrupt_listener_.accept();
}

void GuestServer::serve_time() {
  TimeMessage message;
  if (!time_.read(message)) {
    over_ = true;
    return;
  }
  time_.send(calendar_.answer(message, board_.now()));
}

void GuestServer::serve_registers() {
  GuestRequest request;
  if (!registers_.read(request)) {
    registers_ = Channel{};  // the guest reboots or ends; its time socket tells which
    return;
  }
  ++accesses_;
  if (static_cast<GuestOp>(request.op) != GuestOp::kCommand) {
    if (request.op > 1 || (request.size != 1 && request.size != 2 && request.size != 4))
      refuse_guest("sent an access of " + std::to_string(request.size) + " bytes, operation " +
                   std::to_string(request.op) +
                   "; allowed: 1, 2 or 4 bytes, operation 0 (read) or 1 (write)");
    const std::uint32_t value =
        board_.access({request.address, request.op == static_cast<std::uint32_t>(GuestOp::kWrite),
                       request.value, request.size});
    registers_.send(GuestAnswer{value, board_.levels()});
    return;
  }
  if (request.size > kLongestCommand)
    refuse_guest("sent a command of " + std::to_string(request.size) + " bytes; allowed: up to " +
                 std::to_string(kLongestCommand));
  std::string line(request.size, '\0');
  if (!registers_.read(line.data(), line.size())) return;
  std::string reply;
  try {
    reply = board_.command(line);
  } catch (const std::exception &error) {
    reply = std::string{"error: "} + error.what() + "\n";
  }
  registers_.send(GuestAnswer{static_cast<std::uint32_t>(reply.size()), board_.levels()});
  registers_.write(reply.data(), reply.size());
}

// The guest waits: time goes on until it wants to run, or until an interrupt makes it want to.
void GuestServer::let_time_pass() {
  while (!ended() && calendar_.waiting()) {
    const std::uint64_t goal = calendar_.goal();
    const bool for_ever = goal >= calendar_.guest_time() + kLongestSleep;
    const std::uint64_t until = for_ever ? board_.now() + kLongestSleep : goal;
    if (goal > board_.now() && until > kLongestRun)
      refuse_guest("wants to sleep until " + std::to_string(until) +
                   " ns; allowed: up to 100 days");
    const bool risen = goal > board_.now() && run_board(until);
    if (risen && interrupt_.open()) {
      tell_interrupt();
      continue;
    }
    if (!risen && board_.now() < until) return;  // given up
    if (for_ever && goal > board_.now()) refuse_guest("sleeps, and nothing will ever wake it");
    time_.send(calendar_.run());
    TimeMessage ack;
    if (!time_.read(ack)) over_ = true;
  }
}

// True if an interrupt line has risen. In parts: where clocks do not rest, hours of simulated time
// are hours.
bool GuestServer::run_board(std::uint64_t until) {
  constexpr std::uint64_t kPart = 10'000'000;  // ns
  while (board_.now() < until && !ended())
    if (board_.run_until(std::min(until, board_.now() + kPart))) return true;
  return false;
}

// The guest answers on the interrupt socket once it has taken note, and speaks of time meanwhile.
void GuestServer::tell_interrupt() {
  ++interrupts_;
  interrupt_.send(board_.levels());
  while (!ended()) {
    std::array fds{pollfd{interrupt_.get(), POLLIN, 0}, pollfd{time_.get(), POLLIN, 0}};
    if (::poll(fds.data(), fds.size(), kPatience.count()) < 0) {
      if (errno == EINTR) continue;
      throw std::runtime_error("waiting for the guest failed");
    }
    // What it says of time comes before its answer, so it is read first.
    if (fds[1].revents != 0) {
      serve_time();
      continue;
    }
    if (fds[0].revents == 0) continue;
    std::uint32_t level = 0;
    if (!interrupt_.read(level)) over_ = true;
    return;
  }
}

}  // namespace vericansim
