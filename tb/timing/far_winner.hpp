// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Two neighbours, one of whom loses arbitration to the far end of the bus: the frames after which
// their bits lie farthest apart when one of them acknowledges (docs/integration.md).
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "model/frame.hpp"
#include "timing/row_proof.hpp"

namespace vericansim {

/// A frame that wins and one that is the same up to one bit of the identifier.
struct Contest {
  Frame winner, loser;
  double apart = 0;  ///< of the neighbours at the ACK slot, in quanta, estimated
};

/// The `count` worst of many random contests, worst first, for a bus with this promise.
[[nodiscard]] std::vector<Contest> worst_contests(const RowPromise &promise, unsigned count,
                                                  std::uint64_t seed);

/// Runs contests in `buses` buses of three nodes, ten in each, with the neighbours' clocks at
/// opposite ends of the tolerance, the winner's at either, and random phases.
[[nodiscard]] RowProof prove_far_winner(const RowPromise &promise, unsigned buses,
                                        std::uint64_t seed);

}  // namespace vericansim
