// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Three engines that all want to send all the time: does a bit timing hold what is said of it?
#pragma once

#include <array>
#include <cstdint>

#include "node/core_node.hpp"

namespace vericansim {

/// A bus of three nodes with the same bit timing.
struct ThreeNodes {
  BitTiming timing;
  double clock_hz = 8e6;
  std::array<double, 3> error_ppm{};  ///< of each node's clock
  std::array<double, 3> metres{};     ///< where each node is on the cable
  double node_delay_ns = 0;           ///< driver and comparator of a node together
  std::uint64_t seed = 1;             ///< of frames and of clock phases
};

/// What came of it. An undisturbed bus has neither errors nor differences.
struct ThreeNodesResult {
  unsigned frames = 0;       ///< sent
  unsigned errors = 0;       ///< nodes that saw an error or sent an overload flag, each time
  unsigned differences = 0;  ///< frames that another node did not receive as they were sent
  std::uint64_t node_cycles = 0;
  [[nodiscard]] bool clean() const { return errors == 0 && differences == 0; }
};

/// Runs until `frames` have been sent, or four times the time that takes, or `most_errors`.
ThreeNodesResult run_three_nodes(const ThreeNodes &bus, unsigned frames, unsigned most_errors = 1);

}  // namespace vericansim
