// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusReport: what the checker of a bus has seen.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace vericansim {

/// Accesses, waits, errors and broken rules on the pins of a bus.
struct BusReport {
  std::uint64_t transfers = 0;
  std::uint64_t errors = 0;             ///< transfers with an error answer
  std::uint64_t wait_states = 0;        ///< clocks beyond the fewest, of transfers without an error
  unsigned max_waits = 0;               ///< most of them in one transfer
  std::vector<std::string> violations;  ///< broken rules, with the cycle number; the first 20

  /// One clock more in which a transfer waits, the `waits`th of it.
  void waited(unsigned waits) {
    ++wait_states;
    max_waits = std::max(max_waits, waits);
  }
  /// A transfer has ended.
  void ended(bool error) {
    ++transfers;
    if (error) ++errors;
  }
  /// `what` is told with the bus and the cycle.
  void violation(const char *bus, std::uint64_t cycle, const std::string &what) {
    if (violations.size() < 20)
      violations.push_back(std::string{bus} + " cycle " + std::to_string(cycle) + ": " + what);
  }
};

}  // namespace vericansim
