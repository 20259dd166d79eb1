// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the programs share that flip the flip-flops of one model: which flips, and their result.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "harness/campaign_settings.hpp"
#include "softerror/flop_places.hpp"

namespace vericansim {

/// The flips that the command line asks for: rounds in which each flip-flop is flipped once, in any
/// order, or one flip-flop alone.
class FlipPlan {
 public:
  /// Flips lie in clocks `from` to `to`.
  FlipPlan(const FlopPlaces &flops, unsigned rounds, std::uint64_t from, std::uint64_t to)
      : flops_{flops}, rounds_{rounds}, from_{from}, to_{to} {}

  /// The options of the program, those of CampaignSettings among them.
  void add_to(CLI::App &app) {
    settings.add_to(app, fmt::format("{} flips of every flip-flop", rounds_));
    auto *only = app.add_option("--flop", flop_,
                                fmt::format("Only this one, stuck from clock {} on", from_));
    auto *level =
        app.add_option("--stuck", stuck_, "At this level")->check(CLI::Range(0, 1))->needs(only);
    app.add_option("--every", every_, "Not stuck: flipped once, in runs this many clocks apart")
        ->check(CLI::Range(std::uint64_t{1}, to_ - from_))
        ->needs(only)
        ->excludes(level);
  }

  /// std::invalid_argument if there is no such flip-flop.
  [[nodiscard]] std::vector<FlopFlip> flips() const {
    if (flop_.empty()) return all();
    const unsigned flop = flops_.number_of(flop_);
    return every_ == 0 ? std::vector<FlopFlip>{{flop, from_, stuck_ != 0}} : sweep(flop);
  }

  CampaignSettings settings;  ///< as the command line says, once it is parsed

 private:
  [[nodiscard]] std::vector<FlopFlip> all() const {
    std::mt19937_64 dice{settings.seed};
    std::uniform_int_distribution<std::uint64_t> when{from_, to_};
    std::vector<unsigned> order(flops_.names().size());
    std::iota(order.begin(), order.end(), 0U);
    std::vector<FlopFlip> flips;
    for (unsigned round = 0; round < rounds_; ++round) {
      std::shuffle(order.begin(), order.end(), dice);
      for (const unsigned flop : order) flips.push_back({flop, when(dice), {}});
    }
    const auto kept = static_cast<std::size_t>(static_cast<double>(flips.size()) * settings.scale);
    flips.resize(std::max<std::size_t>(kept, 1));
    return flips;
  }
  [[nodiscard]] std::vector<FlopFlip> sweep(unsigned flop) const {
    std::vector<FlopFlip> flips;
    for (std::uint64_t clock = from_; clock < to_; clock += every_)
      flips.push_back({flop, clock, {}});
    return flips;
  }

  const FlopPlaces &flops_;
  unsigned rounds_;
  std::uint64_t from_, to_, every_ = 0;
  std::string flop_;
  int stuck_ = 0;
};

/// Makes the flips of the plan, sum.add() of each outcome, and prints result_of(sum), which is also
/// written where tools/campaign.py wants it. Throws std::runtime_error if the file cannot be
/// written, before the flips if that can be told then.
template <typename Sum, typename Run, typename ResultOf>
Sum run_flips(const FlipPlan &plan, const Run &run, const ResultOf &result_of) {
  check_writable(plan.settings.json);
  Sum sum;
  std::mutex lock;
  const std::vector<FlopFlip> flips = plan.flips();
  run_jobs(flips.size(), plan.settings.jobs, [&](std::size_t n) {
    const auto outcome = run(flips[n]);
    const std::lock_guard guard{lock};
    sum.add(flips[n], outcome);
  });
  const nlohmann::ordered_json result = result_of(sum);
  print_result(result);
  write_result(plan.settings.json, result.dump(1) + "\n");
  return sum;
}

}  // namespace vericansim
