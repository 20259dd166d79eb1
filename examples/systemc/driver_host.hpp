// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DriverHost: a processor in short: a TLM-2.0 initiator whose thread runs the C driver.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <cstdint>
#include <functional>
#include <systemc>
#include <tlm>
#include <vector>

#include "verican/verican.h"

/// Sends `to_send` frames and waits for `to_receive`, by interrupt. Every register access of the
/// driver is one b_transport of a word; with a quantum the host runs ahead of SystemC's time.
class DriverHost : public sc_core::sc_module {
 public:
  struct Settings {
    std::uint32_t clock_hz = 8'000'000;
    std::uint32_t bitrate = 500'000;
    std::uint32_t base_id = 0x100;  ///< identifiers of what it sends: base_id + number % 16
    unsigned to_send = 0;
    unsigned to_receive = 0;
  };

  DriverHost(const sc_core::sc_module_name &name, const Settings &settings);

  tlm_utils::simple_initiator_socket<DriverHost> socket{"socket"};
  sc_core::sc_in<bool> irq{"irq"};

  /// Called at each frame received and sent, with the local time.
  std::function<void(const sc_core::sc_time &, const verican_frame_t &)> on_frame;
  std::function<void(const sc_core::sc_time &, unsigned sent)> on_sent;
  /// Called once when all frames are sent and received.
  std::function<void()> on_done;

  [[nodiscard]] unsigned sent() const { return sent_; }
  [[nodiscard]] const std::vector<verican_frame_t> &received() const { return received_; }
  [[nodiscard]] std::uint64_t accesses() const { return accesses_; }
  [[nodiscard]] std::uint64_t interrupts() const { return interrupts_; }
  /// Result of the driver's set-up.
  [[nodiscard]] verican_result_t result() const { return result_; }
  /// The frame with this number.
  [[nodiscard]] verican_frame_t frame(unsigned number) const;

 private:
  void software();
  void set_up();
  void send_more();
  void take_received();
  void wait_for_interrupt();
  void access(tlm::tlm_command command, std::uint32_t offset, std::uint32_t &word);

  static std::uint32_t read(void *self, std::uint32_t offset);
  static void write(void *self, std::uint32_t offset, std::uint32_t value);
  static void sent_one(void *self, verican_t *, const verican_tx_event_t *event);

  Settings settings_;
  verican_t device_{};
  std::vector<verican_frame_t> ring_ = std::vector<verican_frame_t>(128);
  std::vector<verican_frame_t> received_;
  verican_result_t result_ = VERICAN_OK;
  unsigned queued_ = 0, sent_ = 0;
  std::uint64_t accesses_ = 0, interrupts_ = 0;
  tlm_utils::tlm_quantumkeeper keeper_;
};
