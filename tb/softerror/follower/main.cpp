// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// softerror_follower: flips every flip-flop of a clock without a processor while it is locked, and
// tells how many pairs it takes until its time is right again (TM-141, docs/soft-errors.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <mutex>
#include <random>
#include <stdexcept>

#include "harness/campaign_settings.hpp"
#include "softerror/follower/run.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kRounds = 4;  // flips of each flip-flop
constexpr unsigned kBar = 10;    // pairs (TM-141)

struct Sum {
  unsigned flips = 0, hangs = 0, babbled = 0, silent = 0, wrong = 0, late = 0, most = 0;
  std::vector<std::string> notes;

  void add(const FollowerFlip &flip, const FollowerOutcome &outcome) {
    ++flips;
    hangs += outcome.hangs ? 1 : 0;
    babbled += outcome.babbled ? 1 : 0;
    silent += outcome.lost_pulses ? 1 : 0;
    wrong += outcome.pairs > 0 ? 1 : 0;
    late += !outcome.hangs && outcome.pairs > kBar ? 1 : 0;
    if (!outcome.hangs) most = std::max(most, outcome.pairs);
    if (outcome.hangs || outcome.babbled || outcome.pairs > kBar || outcome.lost_pulses)
      notes.push_back(fmt::format("{} at clock {}: {}, {} pairs, {:.0f} ns at most",
                                  follower_flops().names()[flip.flop], flip.clock,
                                  outcome.babbled ? "babbles"
                                  : outcome.hangs       ? "hangs"
                                  : outcome.lost_pulses ? "no pulses"
                                                        : "late",
                                  outcome.pairs, outcome.worst_ns));
  }
};

Json result_of(const Sum &sum) {
  const auto none = [](const char *name, unsigned value) {
    return campaign_figure(name, value, "0", value == 0);
  };
  return {
      {"figures",
       {campaign_figure("flip-flops flipped", follower_flops().names().size()),
        campaign_figure("flips", sum.flips), none("hangs", sum.hangs),
        none("babbling", sum.babbled), campaign_figure("time wrong until a pair came", sum.wrong),
        none("right again after more than 10 pairs", sum.late),
        campaign_figure("pairs until right again, at most", sum.most),
        none("pin without its pulses at the end", sum.silent)}},
      {"tables", Json::array()},
      {"notes", sum.notes}};
}

std::vector<FollowerFlip> plan(const CampaignSettings &settings) {
  std::mt19937_64 dice{settings.seed};
  std::uniform_int_distribution<std::uint64_t> when{kFlipFrom, kFlipTo};
  std::vector<FollowerFlip> flips;
  for (unsigned round = 0; round < kRounds; ++round)
    for (unsigned flop = 0; flop < follower_flops().names().size(); ++flop)
      flips.push_back({flop, when(dice), {}});
  // A part of all, scattered over the flip-flops.
  std::shuffle(flips.begin(), flips.end(), dice);
  const auto kept = static_cast<std::size_t>(static_cast<double>(flips.size()) * settings.scale);
  flips.resize(std::max<std::size_t>(kept, 1));
  return flips;
}

/// One flip-flop, flipped anew every so many clocks.
std::vector<FollowerFlip> sweep(unsigned flop, std::uint64_t every) {
  std::vector<FollowerFlip> flips;
  for (std::uint64_t clock = kFlipFrom; clock < kFlipTo; clock += every)
    flips.push_back({flop, clock, {}});
  return flips;
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Soft errors of a clock without a processor"};
  try {
    CampaignSettings settings;
    std::string flop;
    int stuck = 0;
    std::uint64_t every = 0;
    settings.add_to(app, "4 flips of every flip-flop");
    auto *only = app.add_option("--flop", flop, "Only this one, stuck from the first flip on");
    auto *level = app.add_option("--stuck", stuck, "At this level")->check(CLI::Range(0, 1));
    app.add_option("--every", every, "Not stuck: flipped once, in runs this many clocks apart")
        ->check(CLI::Range(1, 160'000))
        ->needs(only)
        ->excludes(level);
    CLI11_PARSE(app, argc, argv);
    const FollowerOutcome none = run_flip({0, ~0ULL, {}});
    if (none.hangs || none.lost_pulses) throw std::runtime_error("no lock without a flip");
    std::vector<FollowerFlip> flips = plan(settings);
    if (!flop.empty()) flips = {{follower_flops().number_of(flop), kFlipFrom, stuck != 0}};
    if (every != 0) flips = sweep(follower_flops().number_of(flop), every);
    Sum sum;
    std::mutex lock;
    run_jobs(flips.size(), settings.jobs, [&](std::size_t n) {
      const FollowerOutcome outcome = run_flip(flips[n]);
      const std::lock_guard guard{lock};
      sum.add(flips[n], outcome);
    });
    const Json result = result_of(sum);
    for (const Json &figure : result["figures"])
      fmt::print("{}: {}\n", figure["name"].get<std::string>(), figure["value"].dump());
    for (const std::string &note : sum.notes) fmt::print("{}\n", note);
    if (!settings.json.empty()) std::ofstream{settings.json} << result.dump(1) << '\n';
    return sum.hangs + sum.babbled + sum.late + sum.silent == 0 ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "softerror_follower: {}\n", error.what());
    return 2;
  }
}
