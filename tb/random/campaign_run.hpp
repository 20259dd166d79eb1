// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The random campaign: seeds to verdicts, with progress and a summary.
#pragma once

#include <cstdint>
#include <string>

#include "harness/shard.hpp"

namespace vericansim {

struct CampaignOptions {
  std::uint64_t seed = 1;
  std::uint64_t runs = 0;  ///< 0: as many as `frames` need
  std::uint64_t frames = 10'000'000;
  unsigned frames_a_run = 3000;
  unsigned jobs = 2;
  std::string directory = ".";  ///< for the journal and scenarios of failing seeds; is made
  std::string json;
  bool print = false;
  bool no_shrink = false;
  bool resume = false;  ///< seeds that passed before an interruption, with this program, count
  Shard shard;          ///< a range of the seeds, or the figures from those of all shards
};

/// Defaults, with those of CampaignSettings, CAMPAIGN_RESUME and CAMPAIGN_SHARD of the environment.
/// Throws std::runtime_error if one of them has a value that is not allowed.
[[nodiscard]] CampaignOptions campaign_defaults();

/// Runs it; 0 if every seed passed, 1 otherwise. The figures are those of the first seeds that have
/// the frames together, whatever the number of threads and shards; a shard has no figures, and the
/// end of its work is no failure whatever it found. Throws std::runtime_error if a file cannot be
/// written, before the work if that can be told then.
int run_campaign(const CampaignOptions &options);

}  // namespace vericansim
