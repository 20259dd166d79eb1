// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// UnitBus: remote nodes, whatever they are made of, with a host and another node on a bus of bits.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/core_node.hpp"
#include "node/remote_unit.hpp"

namespace vericansim {

/// Engines at 8 clocks a bit; the host's and the other node's are bare.
class UnitBus {
 public:
  explicit UnitBus(std::unique_ptr<RemoteUnit> made);
  /// Several units; `unit` is the first.
  explicit UnitBus(std::vector<std::unique_ptr<RemoteUnit>> made);

  /// The units join; what they say then.
  std::vector<std::string> start();
  /// Sends a frame, from the host or from the other node, and waits until the bus has been idle for
  /// 20 bits; what the units say then.
  std::vector<std::string> send(const Frame &frame, bool from_other = false);
  /// Waits until nothing is under way, `bits` at most; what the units say.
  std::vector<std::string> settle(unsigned bits = 30'000);
  void run_bits(unsigned bits) { bus.run_for(bits * kBit); }

  static constexpr Time kBit = kMicrosecond;  ///< 1 Mbit/s at 8 MHz
  static BitTiming timing() { return {.prescaler = 1, .prop = 1, .ps1 = 4, .ps2 = 2, .sjw = 2}; }
  static ClockConfig clock() {
    ClockConfig config;
    config.frequency_hz = 8e6;
    return config;
  }

  std::vector<std::unique_ptr<RemoteUnit>> units;
  RemoteUnit *unit;
  CoreNode host;
  CoreNode other;
  Bus bus;
};

}  // namespace vericansim
