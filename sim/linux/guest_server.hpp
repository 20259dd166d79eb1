// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GuestServer: serves one guest kernel: its time, its registers, its interrupts.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "linux/board.hpp"
#include "linux/calendar.hpp"
#include "linux/guest_link.hpp"

namespace vericansim {

/// Lets a Board and a guest kernel take turns: while the guest computes the board stands still,
/// except for the clocks of its accesses, and while the guest waits the board runs. Guest and board
/// are never active at the same time, so a run depends on nothing but its inputs.
class GuestServer {
 public:
  /// Opens the sockets `time`, `registers` and `interrupts` in `directory`. Throws
  /// std::system_error or std::invalid_argument.
  GuestServer(Board &board, const std::string &directory);

  /// Serves until the guest closes its time socket, until the user wants the end
  /// (stop_request.hpp), or until `given_up` says so, which is asked some times a second. Throws
  /// InputError if the guest breaks the rules, or if it waits for something that cannot happen.
  void serve(std::function<bool()> given_up);

  /// True once a guest has asked for the time.
  [[nodiscard]] bool connected() const { return time_.open(); }
  /// Accesses served so far, and interrupts told to a waiting guest.
  [[nodiscard]] std::uint64_t accesses() const { return accesses_; }
  [[nodiscard]] std::uint64_t interrupts() const { return interrupts_; }

 private:
  [[nodiscard]] bool ended();
  void wait_for_guest();
  void serve_time();
  void serve_registers();
  void let_time_pass();
  [[nodiscard]] bool run_board(std::uint64_t until);
  void tell_interrupt();

  Board &board_;
  Calendar calendar_;
  Listener time_listener_;
  Listener register_listener_;
  Listener interrupt_listener_;
  Channel time_;
  Channel registers_;
  Channel interrupt_;
  std::uint64_t accesses_ = 0;
  std::uint64_t interrupts_ = 0;
  std::function<bool()> given_up_;
  std::chrono::steady_clock::time_point next_question_;
  bool over_ = false;
};

}  // namespace vericansim
