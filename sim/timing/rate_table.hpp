// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rate table: the bit rates that a remote node searches through, and their bit timing (RN-73).
#pragma once

#include <string>
#include <vector>

#include "node/bit_timing.hpp"

namespace vericansim {

/// One row of can_remote's RateTable.
struct RateRow {
  unsigned bitrate = 0;  ///< bit/s
  BitTiming timing;
};

/// The rows for a clock, fastest first: 1000, 800, 500, 250, 125, 50, 20 and 10 kbit/s. A rate that
/// the clock cannot do, within a node's tolerance, is left out. Throws as bit_timing_request().
[[nodiscard]] std::vector<RateRow> rate_table(double clock_hz);

/// The table as parameters RateRows and RateTable of can_remote, to be put between the parentheses
/// of an instance.
[[nodiscard]] std::string rate_parameters(const std::vector<RateRow> &rows);

}  // namespace vericansim
