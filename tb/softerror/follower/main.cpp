// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// softerror_follower: flips every flip-flop of a clock without a processor while it is locked, and
// tells how many pairs it takes until its time is right again (TM-141, docs/soft-errors.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

#include "softerror/flip_plan.hpp"
#include "softerror/follower/run.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kRounds = 4;  // flips of each flip-flop
constexpr unsigned kBar = 10;    // pairs (TM-141)

struct Sum {
  unsigned flips = 0, hangs = 0, babbled = 0, silent = 0, wrong = 0, late = 0, most = 0;
  std::vector<std::string> notes;

  void add(const FlopFlip &flip, const FollowerOutcome &outcome) {
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
                                  outcome.babbled       ? "babbles"
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

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Soft errors of a clock without a processor"};
  try {
    FlipPlan plan{follower_flops(), kRounds, kFlipFrom, kFlipTo};
    plan.add_to(app);
    if (const auto end = read_options(app, argc, argv)) return *end;
    const FollowerOutcome none = run_flip({0, ~0ULL, {}});
    if (none.hangs || none.lost_pulses) throw std::runtime_error("no lock without a flip");
    const auto sum = run_flips<Sum>(plan, run_flip, result_of);
    return sum.hangs + sum.babbled + sum.late + sum.silent == 0 ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "softerror_follower: {}\n", error.what());
    return 2;
  }
}
