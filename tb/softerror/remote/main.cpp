// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// softerror_remote: flips every flip-flop of a remote node under traffic and tells what it took to
// make the node work again (RN-103, docs/soft-errors.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fstream>
#include <mutex>
#include <random>

#include "harness/campaign_settings.hpp"
#include "softerror/remote/run.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kRounds = 20;  // flips of each flip-flop

struct Sum {
  std::array<unsigned, 5> cures{};
  unsigned flips = 0, babbled = 0, wrong_sent = 0;
  std::vector<std::string> notes;

  void add(const RemoteFlip &flip, const RemoteOutcome &outcome) {
    ++flips;
    ++cures.at(static_cast<std::size_t>(outcome.cure));
    babbled += outcome.babbled;
    wrong_sent += outcome.wrong_sent;
    const bool hangs = outcome.cure >= RemoteCure::kReset;
    if (hangs || outcome.babbled)
      notes.push_back(fmt::format("{} at clock {}: {}", FlopRemote::flops().names()[flip.flop],
                                  flip.clock, outcome.babbled ? "babbles" : "hangs"));
  }
  [[nodiscard]] unsigned hangs() const { return cures[3] + cures[4]; }
};

Json result_of(const Sum &sum) {
  const auto none = [](const char *name, unsigned value) {
    return campaign_figure(name, value, "0", value == 0);
  };
  return {{"figures",
           {campaign_figure("flip-flops flipped", FlopRemote::flops().names().size()),
            campaign_figure("flips", sum.flips), none("hangs", sum.hangs()),
            none("babbling", sum.babbled), campaign_figure("works again by itself", sum.cures[0]),
            campaign_figure("works again after RESTART", sum.cures[1]),
            campaign_figure("works again after RESTART and ASSIGN", sum.cures[2]),
            campaign_figure("sent under an identifier of the host", sum.wrong_sent)}},
          {"tables", Json::array()},
          {"notes", sum.notes}};
}

std::vector<RemoteFlip> plan(const CampaignSettings &settings) {
  std::mt19937_64 dice{settings.seed};
  std::uniform_int_distribution<std::uint64_t> when{kFlipFrom, kFlipTo};
  std::vector<RemoteFlip> flips;
  for (unsigned round = 0; round < kRounds; ++round)
    for (unsigned flop = 0; flop < FlopRemote::flops().names().size(); ++flop)
      flips.push_back({flop, when(dice), {}});
  const auto kept = static_cast<std::size_t>(static_cast<double>(flips.size()) * settings.scale);
  flips.resize(std::max<std::size_t>(kept, 1));
  return flips;
}

/// One flip-flop, flipped anew every so many clocks of the traffic.
std::vector<RemoteFlip> sweep(unsigned flop, std::uint64_t every) {
  std::vector<RemoteFlip> flips;
  for (std::uint64_t clock = kFlipFrom; clock < kFlipTo; clock += every)
    flips.push_back({flop, clock, {}});
  return flips;
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Soft errors of a remote node"};
  try {
    CampaignSettings settings;
    std::string flop;
    int stuck = 0;
    std::uint64_t every = 0;
    settings.add_to(app, "20 flips of every flip-flop");
    auto *only =
        app.add_option("--flop", flop, "Only this one, stuck from the start of the traffic on");
    auto *level = app.add_option("--stuck", stuck, "At this level")->check(CLI::Range(0, 1));
    app.add_option("--every", every, "Not stuck: flipped once, in runs this many clocks apart")
        ->check(CLI::Range(1, 100'000))
        ->needs(only)
        ->excludes(level);
    CLI11_PARSE(app, argc, argv);
    if (run_flip({0, ~0ULL, {}}).cure != RemoteCure::kNone)
      throw std::runtime_error("the node does not work without a flip");
    std::vector<RemoteFlip> flips = plan(settings);
    if (!flop.empty()) flips = {{FlopRemote::flops().number_of(flop), kFlipFrom, stuck != 0}};
    if (every != 0) flips = sweep(FlopRemote::flops().number_of(flop), every);
    Sum sum;
    std::mutex lock;
    run_jobs(flips.size(), settings.jobs, [&](std::size_t n) {
      const RemoteOutcome outcome = run_flip(flips[n]);
      const std::lock_guard guard{lock};
      sum.add(flips[n], outcome);
    });
    const Json result = result_of(sum);
    for (const Json &figure : result["figures"])
      fmt::print("{}: {}\n", figure["name"].get<std::string>(), figure["value"].dump());
    for (const std::string &note : sum.notes) fmt::print("{}\n", note);
    if (!settings.json.empty()) std::ofstream{settings.json} << result.dump(1) << '\n';
    return sum.hangs() + sum.babbled == 0 ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "softerror_remote: {}\n", error.what());
    return 2;
  }
}
