// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LiveBus: a bus of a session, which tells the operators of its nodes what happens.
#pragma once

#include <vector>

#include "session/session.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {

/// Scenario and simulation, and who wants to hear of it.
class LiveBus : private BusObserver {
 public:
  explicit LiveBus(SessionBus bus);
  ~LiveBus() override;
  LiveBus(const LiveBus &) = delete;
  LiveBus &operator=(const LiveBus &) = delete;

  /// `op` works node `id`, or listens (kAllNodes).
  void add(NodeId id, Operator &op);
  [[nodiscard]] Simulation &simulation() { return simulation_; }
  [[nodiscard]] const Scenario &scenario() const { return scenario_; }

 private:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId id, const BitRecord &bit) override;

  Scenario scenario_;
  Simulation simulation_;
  std::vector<Operator *> all_;
  std::vector<Operator *> by_node_;    // nullptr: nobody
  std::vector<Operator *> want_bits_;  // the same
  bool observes_ = false;
};

}  // namespace vericansim
