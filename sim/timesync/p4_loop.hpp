// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// P4Loop: IEEE 1588 over CAN as it was published (docs/time-spec.md, 7.2, TM-123): clocks that are
// read in the interrupt handler, and corrected in their offset alone.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "timesync/clock_node.hpp"
#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"
#include "verican/delay.h"

namespace vericansim {

/// One seed. Odd followers are fast by the whole spread, even ones slow, the master is right.
/// Messages, delay and offset are those of the C driver.
class P4Loop {
 public:
  P4Loop(const SyncCase &setting, std::uint64_t seed);
  const SyncRun &run();

  std::vector<ClockNode> nodes;  ///< the first is the master
  std::vector<verican_p4_t> followers;
  SyncRun result;  ///< followers are locked once they know their delay

 private:
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] std::uint64_t read_in_handler(ClockNode &node, Nanoseconds event);
  void round();
  void correct(unsigned n, const std::uint8_t (&follow_up)[8], Nanoseconds t);
  void measure(unsigned n, Nanoseconds t);
  [[nodiscard]] Nanoseconds wait_for(unsigned n, std::uint32_t message, Nanoseconds t);
  void look(Nanoseconds t);

  SyncCase setting_;
  std::mt19937_64 dice_;
  Nanoseconds now_ = 1e6;
  unsigned rounds_ = 0;
};

/// Runs a seed by the model.
[[nodiscard]] SyncRun run_p4_by_model(const SyncCase &setting, std::uint64_t seed);

}  // namespace vericansim
