// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlStation: a core with the time unit, in RTL, with the C driver on it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/rtl_node.hpp"
#include "node/task.hpp"
#include "verican/verican.h"

namespace vericansim {

/// What the driver tells and is asked runs on the bus: each register access takes its clocks. Its
/// interrupt handler is called by who runs the bus, some time behind the interrupt.
class RtlStation {
 public:
  /// Joins `bus`, which must outlive it. `bitrate`, bit/s.
  RtlStation(Bus &bus, std::string name, const ClockConfig &clock, std::uint32_t bitrate);
  ~RtlStation() { rtl_->forget_waiter(); }
  RtlStation(const RtlStation &) = delete;
  RtlStation &operator=(const RtlStation &) = delete;

  /// Sets the core up and lets it join the bus; it takes frames whose identifier equals `id` in
  /// the bits of `mask`. std::runtime_error with the driver's reason.
  void start(std::uint32_t id, std::uint32_t mask);

  /// True from an interrupt on; the run of the bus that met it has returned in its clock.
  [[nodiscard]] bool interrupted() const { return interrupted_; }
  /// Calls the driver's handler and waits for the next interrupt.
  void serve();
  /// The oldest frame received, if there is one.
  [[nodiscard]] bool receive(verican_frame_t &frame);
  /// Nothing waits to be sent.
  [[nodiscard]] bool silent() const;

  /// A frame of this node is on the bus, from SOF to EOF.
  [[nodiscard]] bool sending() const;

  /// The continuous reading of the clock at the bus's now(), ns (docs/time-spec.md, section 0):
  /// whole ns, and what has gone by since the last edge.
  struct Reading {
    std::uint64_t whole;
    double since;
  };
  [[nodiscard]] Reading reading();

  verican_t dev{};
  std::function<void(const verican_tx_event_t &)> on_sent;

 private:
  Task<> wait();
  void arm() { task_ = wait(); }

  Bus &bus_;
  std::unique_ptr<RtlNode> rtl_;
  verican_config_t config_{};
  std::vector<verican_frame_t> ring_ = std::vector<verican_frame_t>(64);
  Task<> task_;
  bool interrupted_ = false;
};

/// Difference of two readings, ps; ends of the range saturate.
[[nodiscard]] Time ahead(const RtlStation::Reading &one, const RtlStation::Reading &other);

}  // namespace vericansim
