// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// softerror_clock: flips every flip-flop of the time unit while the node follows a master, and
// while a frame waits for its launch time (TM-141, docs/soft-errors.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>

#include "harness/campaign_settings.hpp"
#include "softerror/clock/run.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kRounds = 2;    // flips of each flip-flop in each scene
constexpr unsigned kMoments = 16;  // at which they come, of each round

struct SceneName {
  ClockScene scene;
  const char *name;
};
constexpr SceneName kScenes[] = {{ClockScene::kTime, "time"}, {ClockScene::kLaunch, "launch"}};

/// Figures of both scenes.
struct Sum {
  unsigned flips = 0, bad = 0;
  unsigned hangs = 0, babbled = 0, late = 0, lost = 0, rewrite = 0, set_up = 0, gone = 0, seen = 0;
  unsigned silent = 0, told = 0, pairs = 0, early = 0, behind = 0;
  double latest_ms = 0;
  std::vector<std::string> notes;

  static bool hung(const ClockOutcome &out) {
    return !out.finished || out.hangs || out.cure >= ClockCure::kHardReset;
  }
  static bool is_late(const ClockOutcome &out) { return out.pairs > kMostPairs || !out.locked; }

  void add(const char *scene, const ClockFlip &flip, const ClockOutcome &out) {
    ++flips;
    hangs += hung(out) ? 1 : 0;
    babbled += out.babbled ? 1 : 0;
    late += is_late(out) ? 1 : 0;
    lost += out.lost ? 1 : 0;
    rewrite += out.cure == ClockCure::kRewrite ? 1 : 0;
    set_up += out.cure == ClockCure::kSetUp ? 1 : 0;
    gone += out.gone && !out.seen ? 1 : 0;
    seen += out.seen ? 1 : 0;
    silent += out.wrong && !out.told ? 1 : 0;
    told += out.wrong && out.told ? 1 : 0;
    pairs = std::max(pairs, out.pairs);
    early += out.early_ms > 0 ? 1 : 0;
    behind += out.late_ms > 0 ? 1 : 0;
    latest_ms = std::max(latest_ms, out.late_ms);
    const bool wanting = hung(out) || out.babbled || is_late(out) || out.lost;
    bad += wanting ? 1 : 0;
    if (wanting || out.cure != ClockCure::kNone) note(scene, flip, out);
  }

  void note(const char *scene, const ClockFlip &flip, const ClockOutcome &out) {
    const char *what = hung(out)                       ? "hangs"
                       : out.babbled                   ? "babbles"
                       : out.lost                      ? "the frame is not sent"
                       : is_late(out)                  ? "TIME stays wrong"
                       : out.cure == ClockCure::kSetUp ? "needs a soft reset"
                                                       : "registers written anew";
    notes.push_back(fmt::format("--scene {} --flop {} --at {}: {}; {} failed, {} pairs, {:.0f} ns",
                                scene, FlopNode::flops()[flip.flop].name(), flip.at, what,
                                out.fails[0] != 0 ? out.fails : "nothing", out.pairs,
                                out.worst_ns));
  }

  [[nodiscard]] Json result() const {
    const auto none = [](const char *name, unsigned value) {
      return campaign_figure(name, value, "0", value == 0);
    };
    return {{"figures",
             {campaign_figure("flip-flops flipped", unit_flops().size()),
              campaign_figure("flips", flips), none("hangs", hangs), none("babbling", babbled),
              campaign_figure("no trace at all", gone),
              campaign_figure("the CPU saw something else", seen),
              campaign_figure("works once registers are written anew", rewrite),
              campaign_figure("works behind a soft reset", set_up),
              campaign_figure("TIME wrong, told by the servo", told),
              campaign_figure("TIME wrong, silently until the next pair", silent),
              campaign_figure("pairs until right again, at most", pairs),
              none("not right and locked after 11 pairs", late),
              campaign_figure("launches too early", early),
              campaign_figure("launches too late", behind),
              campaign_figure("latest launch, ms", std::round(latest_ms)),
              none("launches not within 2.2 s", lost)}},
            {"tables", Json::array()},
            {"notes", notes}};
  }
};

/// A part of all flips, in the order of time: each round deals the flip-flops anew to its moments,
/// of which every other lies where frames are on the bus, or a launch is under way.
std::vector<ClockFlip> plan(ClockScene scene, const CampaignSettings &settings) {
  std::mt19937_64 dice{settings.seed * 2 + (scene == ClockScene::kTime ? 0 : 1)};
  const FlipWindow window = window_of(scene);
  std::vector<unsigned> flops = unit_flops();
  std::vector<ClockFlip> flips;
  for (unsigned round = 0; round < kRounds; ++round) {
    std::shuffle(flops.begin(), flops.end(), dice);
    std::vector<Time> moments;
    for (unsigned n = 0; n < kMoments; ++n) {
      std::uniform_int_distribution<Time> when{0, (n % 2 == 0 ? window.busy : window.period) - 1};
      moments.push_back(window.begin + n / 2 % 2 * window.period + when(dice));
    }
    for (std::size_t n = 0; n < flops.size(); ++n)
      flips.push_back({flops[n], moments[n % kMoments], {}});
  }
  const auto kept = static_cast<std::size_t>(static_cast<double>(flips.size()) * settings.scale);
  flips.resize(std::max<std::size_t>(kept, 1));
  std::stable_sort(flips.begin(), flips.end(),
                   [](const ClockFlip &a, const ClockFlip &b) { return a.at < b.at; });
  return flips;
}

unsigned number_of(const std::string &name) {
  const auto &flops = FlopNode::flops();
  for (unsigned n = 0; n < flops.size(); ++n)
    if (flops[n].name() == name) return n;
  throw std::invalid_argument("--flop " + name + ": there is no such flip-flop; --list names them");
}

struct Options {
  CampaignSettings settings;
  std::string flop, scene;
  Time at = 0;
  std::optional<int> stuck;
  bool list = false;

  void add_to(CLI::App &app) {
    settings.add_to(app, "2 flips of every flip-flop in each scene");
    app.add_option("--scene", scene, "Only this one")->check(CLI::IsMember({"time", "launch"}));
    auto *one = app.add_option("--flop", flop, "Only this one, NAME[BIT]");
    app.add_option("--at", at, "When, ps; default: at the first moment of the scene")->needs(one);
    app.add_option("--stuck", stuck, "Not flipped: stuck at this level from then on")
        ->check(CLI::Range(0, 1))
        ->needs(one);
    app.add_flag("--list", list, "Name the flip-flops");
  }
  [[nodiscard]] std::vector<ClockFlip> flips(ClockScene of) const {
    if (flop.empty()) return plan(of, settings);
    ClockFlip flip{number_of(flop), at != 0 ? at : window_of(of).begin, {}};
    if (stuck) flip.stuck = *stuck != 0;
    return {flip};
  }
};

int list_flops() {
  for (const unsigned n : unit_flops()) fmt::print("{}\n", FlopNode::flops()[n].name());
  return 0;
}

int run(const Options &options) {
  check_writable(options.settings.json);
  Sum sum;
  for (const auto &[scene, name] : kScenes) {
    if (!options.scene.empty() && options.scene != name) continue;
    const std::vector<ClockFlip> flips = options.flips(scene);
    const auto outcomes = run_flips(scene, flips, options.settings.jobs);
    for (std::size_t n = 0; n < flips.size(); ++n) sum.add(name, flips[n], outcomes[n]);
  }
  const Json result = sum.result();
  print_result(result);
  write_result(options.settings.json, result.dump(1) + "\n");
  return sum.bad == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Soft errors of the time unit"};
  try {
    Options options;
    options.add_to(app);
    if (const auto end = read_options(app, argc, argv)) return *end;
    return options.list ? list_flops() : run(options);
  } catch (const std::exception &error) {
    fmt::print(stderr, "softerror_clock: {}\n", error.what());
    return 2;
  }
}
