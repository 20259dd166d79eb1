// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What one shard of the stage "matrix" has counted, as a file for the merge.
#pragma once

#include <string>

#include "faults/campaign/tally.hpp"

namespace vericansim {

/// Writes the counts, whole or not at all. Throws std::runtime_error if that is impossible.
void write_shard(const std::string &path, const Tally &tally, const RuleBins &bins);
/// Adds those of a file. Throws std::runtime_error if it is none of these.
void add_shard(const std::string &path, Tally &tally, RuleBins &bins);

}  // namespace vericansim
