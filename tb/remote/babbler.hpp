// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Babbler: a host that sends to a remote node without pause (RN-36).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "bus/observer.hpp"
#include "node/remote_node.hpp"

namespace vericansim {

/// What a babbling host has cost the node, and what has become of it.
struct BabbleResult {
  std::uint64_t bits = 0, idle_bits = 0;  ///< of the bus
  std::uint64_t frames = 0, broken = 0;   ///< of the host
  std::uint64_t clocks = 0, waited = 0;   ///< of the node; those in which user logic waits
  unsigned longest_wait = 0;              ///< clocks
  bool answers = false;                   ///< 1 ms after the last frame, to correct commands

  /// What user logic loses of the RAM's clocks, %.
  [[nodiscard]] double lost() const {
    return clocks == 0 ? 0 : 100.0 * static_cast<double>(waited) / static_cast<double>(clocks);
  }
};

/// Counts clocks of the node, those in which user logic waits, and bits without a frame.
class UserWaits : public BusObserver {
 public:
  /// `unit` is node `node` of the bus.
  UserWaits(RemoteNode &unit, NodeId node, BabbleResult &result)
      : unit_{unit}, node_{node}, result_{result} {}
  [[nodiscard]] unsigned interests() const override { return kClocks | kBits; }
  void on_clock(NodeId node, Time, std::uint64_t) override {
    if (node != node_) return;
    ++result_.clocks;
    wait_ = unit_.ready() ? 0 : wait_ + 1;
    result_.waited += wait_ != 0;
    result_.longest_wait = std::max(result_.longest_wait, wait_);
  }
  void on_bit(NodeId node, const BitRecord &bit) override;

 private:
  RemoteNode &unit_;
  NodeId node_;
  BabbleResult &result_;
  unsigned wait_ = 0;
};

/// For `bits` at 8 clocks a bit a host sends random frames to node 3 of a profile, right and wrong,
/// each behind the one before; now and then a bit is flipped, so that a frame breaks.
[[nodiscard]] BabbleResult babble(const std::string &profile, unsigned seed, unsigned bits);

}  // namespace vericansim
