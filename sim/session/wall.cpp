// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HostWall: see wall.hpp.
#include "session/wall.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>

namespace vericansim {
namespace {

// What a signal handler may touch; a pipe wakes poll() without a race.
volatile std::sig_atomic_t restart_wanted = 0;
int wake_pipe[2] = {-1, -1};
struct sigaction before;

void handle_restart(int) {
  const int kept = errno;
  restart_wanted = 1;
  const char byte = 0;
  [[maybe_unused]] const auto ignored = ::write(wake_pipe[1], &byte, 1);
  errno = kept;
}

}  // namespace

HostWall::HostWall() {
  if (wake_pipe[0] >= 0) throw std::logic_error("one HostWall at a time");
  if (::pipe2(wake_pipe, O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::runtime_error(std::string{"no pipe for signals: "} + std::strerror(errno));
  wake_on_stop(wake_pipe[1]);
  restart_wanted = 0;
  struct sigaction action {};
  action.sa_handler = handle_restart;
  ::sigaction(SIGUSR1, &action, &before);
}

HostWall::~HostWall() {
  ::sigaction(SIGUSR1, &before, nullptr);
  wake_on_stop(-1);
  for (int &fd : wake_pipe) {
    ::close(fd);
    fd = -1;
  }
}

WallTime SteadyWall::now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void SteadyWall::wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) {
  timespec limit{};
  if (timeout) {
    constexpr WallTime kSecondNs = 1'000'000'000;
    limit.tv_sec = *timeout / kSecondNs;
    limit.tv_nsec = *timeout % kSecondNs;
  }
  const int ready = ::ppoll(set.data(), set.size(), timeout ? &limit : nullptr, nullptr);
  if (ready < 0)
    for (pollfd &entry : set) entry.revents = 0;  // a signal: nothing is known to be ready
}

void HostWall::wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) {
  set.push_back({wake_pipe[0], POLLIN, 0});
  SteadyWall::wait(set, timeout);
  char bytes[16];
  while (::read(wake_pipe[0], bytes, sizeof bytes) > 0) {
  }
  set.pop_back();
}

bool SteadyWall::stop_requested() { return vericansim::stop_requested(); }

bool HostWall::restart_requested() {
  const bool wanted = restart_wanted != 0;
  restart_wanted = 0;
  return wanted;
}

}  // namespace vericansim
