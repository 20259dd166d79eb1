// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Stop requests: see stop_request.hpp.
#include "simulation/stop_request.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>

#include "trace/unfinished_files.hpp"

namespace vericansim {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

// What a signal handler may touch.
volatile std::sig_atomic_t wanted_by = 0;
volatile std::sig_atomic_t wake_descriptor = -1;

std::array<struct sigaction, kSignals.size()> before;
unsigned nested = 0;

void handle(int signal) {
  if (wanted_by != 0) {
    remove_unfinished();
    ::_exit(128 + signal);
  }
  wanted_by = signal;
  if (wake_descriptor < 0) return;
  const int kept = errno;
  const char byte = 0;
  [[maybe_unused]] const auto ignored = ::write(wake_descriptor, &byte, 1);
  errno = kept;
}

}  // namespace

StopSignals::StopSignals() {
  if (nested++ != 0) return;
  wanted_by = 0;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;  // no half-written output; poll() returns all the same
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before[i]);
    // nohup has the work go on.
    if (kSignals[i] == SIGHUP && before[i].sa_handler == SIG_IGN) continue;
    ::sigaction(kSignals[i], &action, nullptr);
  }
}

StopSignals::~StopSignals() {
  if (--nested != 0) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
}

bool stop_requested() { return wanted_by != 0; }

int stop_signal() { return wanted_by; }

void wake_on_stop(int descriptor) { wake_descriptor = descriptor; }

}  // namespace vericansim
