// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HostWall: see wall.hpp.
#include "wall.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>

namespace vericansim {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGUSR1};

// What a signal handler may touch; a pipe wakes poll() without a race.
volatile std::sig_atomic_t stop_wanted = 0;
volatile std::sig_atomic_t restart_wanted = 0;
int wake_pipe[2] = {-1, -1};
std::array<struct sigaction, kSignals.size()> before;

void handle(int signal) {
  const int kept = errno;
  if (signal == SIGUSR1) {
    restart_wanted = 1;
  } else {
    if (stop_wanted != 0) ::_exit(128 + signal);
    stop_wanted = 1;
  }
  const char byte = 0;
  [[maybe_unused]] const auto ignored = ::write(wake_pipe[1], &byte, 1);
  errno = kept;
}

}  // namespace

HostWall::HostWall() {
  if (wake_pipe[0] >= 0) throw std::logic_error("one HostWall at a time");
  if (::pipe2(wake_pipe, O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::runtime_error(std::string{"no pipe for signals: "} + std::strerror(errno));
  stop_wanted = 0;
  restart_wanted = 0;
  struct sigaction action {};
  action.sa_handler = handle;
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &action, &before[i]);
}

HostWall::~HostWall() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
  for (int &fd : wake_pipe) {
    ::close(fd);
    fd = -1;
  }
}

WallTime HostWall::now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void HostWall::wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) {
  set.push_back({wake_pipe[0], POLLIN, 0});
  timespec limit{};
  if (timeout) {
    constexpr WallTime kSecondNs = 1'000'000'000;
    limit.tv_sec = *timeout / kSecondNs;
    limit.tv_nsec = *timeout % kSecondNs;
  }
  const int ready = ::ppoll(set.data(), set.size(), timeout ? &limit : nullptr, nullptr);
  if (ready < 0)
    for (pollfd &entry : set) entry.revents = 0;  // a signal: nothing is known to be ready
  char bytes[16];
  while (::read(wake_pipe[0], bytes, sizeof bytes) > 0) {
  }
  set.pop_back();
}

bool HostWall::stop_requested() { return stop_wanted != 0; }

bool HostWall::restart_requested() {
  const bool wanted = restart_wanted != 0;
  restart_wanted = 0;
  return wanted;
}

}  // namespace vericansim
