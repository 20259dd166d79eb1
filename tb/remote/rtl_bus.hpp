// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlBus: the RTL of remote nodes on a UnitBus, and the places of their frames.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bus/observer.hpp"
#include "node/remote_node.hpp"
#include "remote/frame_texts.hpp"
#include "remote/unit_bus.hpp"
#include "trace/candump.hpp"

namespace vericansim {

/// When a node of the bus was last at certain places; 0: not yet.
class Places : public BusObserver {
 public:
  explicit Places(NodeId node) : node_{node} {}
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node != node_) return;
    if (bit.after.rx_valid && !bit.at.transmitter) valid = bit.time;
    if (bit.at.field == Field::kInt && bit.at.left == 1) int2 = bit.time;
    if (bit.at.field == Field::kSof) sof = bit.time;
  }
  Time valid = 0;  ///< SP of EOF6 of a frame that another node sent
  Time int2 = 0;   ///< SP of INT2
  Time sof = 0;    ///< SP of SOF

 private:
  NodeId node_;
};

/// A unit of profile small with the golden vectors' serial number.
inline std::unique_ptr<RemoteNode> rtl_unit(unsigned number, RemoteConfig config,
                                            const ClockConfig &clock = UnitBus::clock()) {
  if (config.serial == 0) config.serial = 0xCAFE1234;
  return RemoteNode::create("unit" + std::to_string(number), config, number, UnitBus::timing(),
                            clock);
}
inline std::unique_ptr<RemoteNode> rtl_unit(unsigned number) {
  return rtl_unit(number, RemoteConfig::profile("small"));
}

/// Nodes of the RTL on a bus, the first with its places. Not yet started.
class RtlBus : public UnitBus {
 public:
  explicit RtlBus(std::unique_ptr<RemoteNode> made) : UnitBus{std::move(made)} { bus.add(places); }
  /// Nodes of profile small with these numbers.
  explicit RtlBus(const std::vector<unsigned> &numbers) : UnitBus{units_of(numbers)} {
    bus.add(places);
  }
  ~RtlBus() { bus.remove(places); }

  [[nodiscard]] RemoteNode &node(std::size_t i = 0) {
    return static_cast<RemoteNode &>(*units.at(i));
  }
  std::vector<std::string> send(const std::string &text) { return UnitBus::send(frame_of(text)); }

  Places places{2};  // behind the host and the other node

 private:
  static std::vector<std::unique_ptr<RemoteUnit>> units_of(const std::vector<unsigned> &numbers) {
    std::vector<std::unique_ptr<RemoteUnit>> units;
    for (const unsigned number : numbers) units.push_back(rtl_unit(number));
    return units;
  }
};

}  // namespace vericansim
