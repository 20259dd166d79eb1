// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RateSearch: a remote node that looks for the bit rate of a bus (RN-73, RN-74).
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "node/core_node.hpp"
#include "node/remote_node.hpp"
#include "timing/rate_table.hpp"

namespace vericansim {

/// The bus. Hosts and node have clocks of the same nominal frequency.
struct RateSetting {
  double clock_hz = 8e6;     ///< one that can do all eight rates
  unsigned row = 0;          ///< of rate_table(): the rate of the bus
  unsigned hosts = 2;        ///< 1: a single sender, whom nobody acknowledges
  double ppm = 0;            ///< of the node; the hosts have the opposite
  double noise_per_bit = 0;  ///< of all nodes
  unsigned seed = 1;
};

/// Hosts of one bit rate, and a node of profile full that does not know it.
class RateSearch {
 public:
  explicit RateSearch(const RateSetting &setting);

  /// The node starts to listen.
  void start() { node_->start(); }
  void request(const Frame &frame) { hosts_[0]->request(frame); }
  void run_bits(unsigned bits) { bus_.run_for(bits * bit_); }
  [[nodiscard]] bool listens() const {
    return node_->state() == RemoteState::kListen || node_->state() == RemoteState::kInit;
  }
  /// Frames that have begun on the bus, attempts among them.
  [[nodiscard]] unsigned frames() const { return hosts_[0]->events().started; }
  [[nodiscard]] RemoteNode &node() { return *node_; }
  [[nodiscard]] CoreNode &host(std::size_t i) { return *hosts_.at(i); }

 private:
  std::vector<std::unique_ptr<CoreNode>> hosts_;
  std::unique_ptr<RemoteNode> node_;
  std::unique_ptr<Fault> noise_;
  Bus bus_;
  Time bit_;
};

/// What became of one search.
struct RateTrial {
  RateSetting setting;
  unsigned frames = 0;  ///< on the bus from its start to its end
  bool found = false;   ///< within kRateFrames
  bool right = true;    ///< the rate that was found is that of the bus
};
constexpr unsigned kRateFrames = 1000;

/// A search on a random bus: rate, clock and its error, hosts, frames, pauses, noise in every
/// fourth.
RateTrial random_rate_trial(unsigned seed);

}  // namespace vericansim
