// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BoardBus: a device with a host and another node at 12 MHz and 1 Mbit/s.
#pragma once

#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/core_node.hpp"

namespace vericansim {

/// What the device is made of does not matter: all is seen from the bus.
class BoardBus {
 public:
  /// `device`: must outlive this.
  explicit BoardBus(Node &device);

  /// Sends a frame, from the host or from the other node, and waits until the bus has been idle for
  /// 30 bits; what the device says until then, as candump writes it.
  std::vector<std::string> send(const Frame &frame, bool from_other = false);
  /// Waits as send() does.
  std::vector<std::string> settle();
  void run_bits(unsigned bits) { bus_.run_for(bits * kMicrosecond); }

  /// 12 MHz and the bit timing of the boards: 12 quanta, sample point at 75 %.
  static BitTiming timing() { return {.prescaler = 1, .prop = 5, .ps1 = 3, .ps2 = 3, .sjw = 3}; }
  static ClockConfig clock();

 private:
  CoreNode host_;
  CoreNode other_;
  Bus bus_;
};

}  // namespace vericansim
