// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusObserver: hooks for whoever watches a bus; a hook that nobody wants costs nothing.
#pragma once

#include <cstdint>

#include "bus/node.hpp"
#include "bus/trace.hpp"
#include "bus/types.hpp"

namespace vericansim {

/// Watches a bus. `interests()` is asked once, when the observer is added.
class BusObserver {
 public:
  enum Interest : unsigned {
    kLevels = 1,      ///< on_level: the bus at the observation point (the star point of the cable)
    kNodeLevels = 2,  ///< on_node_tx, on_node_rx
    kBits = 4,        ///< on_bit
    kClocks = 8,      ///< on_clock: every edge of every node; slow
  };

  virtual ~BusObserver() = default;
  [[nodiscard]] virtual unsigned interests() const = 0;

  /// The bus has a new level.
  virtual void on_level(Time, Level) {}
  /// A node drives a new level at its transmit pin.
  virtual void on_node_tx(NodeId, Time, Level) {}
  /// A node's receive pin had a new level at its clock edge (delays and faults included).
  virtual void on_node_rx(NodeId, Time, Level) {}
  /// A node has sampled a bit; called two clocks later, when all that follows from it is known.
  virtual void on_bit(NodeId, const BitRecord &) {}
  /// A node has been clocked; the word is its raw trace.
  virtual void on_clock(NodeId, Time, std::uint64_t) {}
};

}  // namespace vericansim
