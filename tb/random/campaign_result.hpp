// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CampaignResult: the sums of a random campaign, for people and for the campaign's report.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "random/judged_run.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

struct CampaignResult {
  struct Failure {
    std::uint64_t seed;
    std::string finding;
  };

  std::uint64_t runs = 0, cut_short = 0, frames = 0, error_frames = 0, overload_frames = 0,
                node_cycles = 0;
  JudgeCounts counts;
  std::vector<Failure> failures;
  double seconds = 0;

  void add(std::uint64_t seed, const Scenario &scenario, const JudgedRun &run);
  [[nodiscard]] std::string text() const;
  /// As tools/campaign.py reads it. `least`: frames that are demanded, 0: none.
  [[nodiscard]] std::string json(std::uint64_t first_seed, std::uint64_t least) const;

 private:
  struct Bin {
    std::uint64_t runs = 0, frames = 0;
  };
  using Histogram = std::map<std::string, Bin>;
  static void count(Histogram &histogram, const std::string &bin, const JudgedRun &run);

  Histogram nodes_, rates_, noise_, clocks_;
};

}  // namespace vericansim
