// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// For tests with SystemC: a process for each simulation, because SystemC elaborates only once in
// one; and an initiator whose thread is a lambda.
#pragma once

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include "systemc/time.hpp"

namespace vericansim {

/// Runs `body` in a child process and returns what it returned. The test fails if an expectation
/// fails in the child, or if it ends otherwise than by returning.
std::string simulate_for(const std::function<std::string()> &body);
void simulate(const std::function<void()> &body);

/// How a transport ended.
struct Outcome {
  tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;
  sc_core::sc_time taken;  ///< SystemC's time and the change of the annotated delay
};

/// An initiator. Its thread runs `program` and keeps the local time, which it gives back to SystemC
/// when it has come to `quantum` (zero: at once).
class Master : public sc_core::sc_module {
 public:
  using Program = std::function<void(Master &)>;

  explicit Master(const sc_core::sc_module_name &name, Program program = {},
                  sc_core::sc_time quantum = sc_core::SC_ZERO_TIME);

  tlm_utils::simple_initiator_socket<Master> socket{"socket"};

  /// Sets a payload to `length` bytes at `data`.
  static void fill(tlm::tlm_generic_payload &payload, tlm::tlm_command command,
                   std::uint64_t address, void *data, unsigned length);
  Outcome transport(tlm::tlm_generic_payload &payload);
  Outcome transport(tlm::tlm_command command, std::uint64_t address, void *data, unsigned length);
  /// Words; a response other than OK fails the test.
  std::uint32_t read32(std::uint32_t address);
  void write32(std::uint32_t address, std::uint32_t value);
  /// Debug read of a word; fails the test if it is not served.
  std::uint32_t peek32(std::uint32_t address);

  /// Local time: SystemC's and what this thread is ahead of it.
  [[nodiscard]] sc_core::sc_time local() const { return sc_core::sc_time_stamp() + ahead; }
  /// Lets SystemC catch up with the local time.
  void sync();
  void pause(const sc_core::sc_time &time) {
    sync();
    wait(time);
  }
  using sc_core::sc_module::wait;

  sc_core::sc_time ahead;
  bool finished = false;

 private:
  void run();

  Program program_;
  sc_core::sc_time quantum_;
};

/// Passes a clock on, a number of delta cycles later.
class DeltaLag : public sc_core::sc_module {
 public:
  DeltaLag(const sc_core::sc_module_name &name, const sc_core::sc_signal_in_if<bool> &in,
           unsigned deltas);
  /// The clock after the lag.
  [[nodiscard]] sc_core::sc_signal<bool> &out() { return *stages_.back(); }

 private:
  std::vector<std::unique_ptr<sc_core::sc_signal<bool>>> stages_;
};

/// Passes the calls of several initiators on to one target.
class Junction : public sc_core::sc_module {
 public:
  Junction(const sc_core::sc_module_name &name, unsigned inputs);
  tlm_utils::simple_target_socket_tagged<Junction> &input(unsigned number) {
    return *inputs_[number];
  }

  tlm_utils::simple_initiator_socket<Junction> output{"output"};

 private:
  void b_transport(int, tlm::tlm_generic_payload &payload, sc_core::sc_time &delay) {
    output->b_transport(payload, delay);
  }
  std::vector<std::unique_ptr<tlm_utils::simple_target_socket_tagged<Junction>>> inputs_;
};

}  // namespace vericansim
