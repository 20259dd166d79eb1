// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the bit rate of a recorded bus from the distances of its edges.
#pragma once

#include <optional>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// Bit rate in bit/s from the times of level changes in their order, ps. Inside a frame all
/// distances are 1 to 5 bits (bit stuffing), so the grid on which most distances lie is the bit
/// time. A result within 2 % of a usual rate (10 k, 20 k, 33.3 k, 50 k, 83.3 k, 100 k, 125 k, 250
/// k, 500 k, 800 k, 1 M) becomes that rate. Nothing if there are fewer than 10 edges or no common
/// grid.
[[nodiscard]] std::optional<double> detect_bitrate(const std::vector<Time> &edges);

}  // namespace vericansim
