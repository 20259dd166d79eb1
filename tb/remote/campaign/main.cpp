// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// remote_campaign: remote nodes of the RTL beside their model, every frame and random commands at
// the engine's port and on random buses, the skew of triggers, searches for the bit rate, a
// babbling host (RN-36, RN-47, RN-73, RN-101).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "harness/campaign_settings.hpp"
#include "remote/babbler.hpp"
#include "remote/port_every_frame.hpp"
#include "remote/random_port.hpp"
#include "remote/random_remotes.hpp"
#include "remote/rate_search.hpp"
#include "remote/trigger_skew.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kBusCommands = 100'000, kOfBus = 50;
constexpr unsigned kTriggers = 10'000, kOfLine = 25;
constexpr unsigned kPortCommands = 1'000'000, kOfPort = 1'000;
constexpr unsigned kSearches = 10'000;
constexpr unsigned kBabbledBits = 30'000'000, kOfBabble = 500'000;  // ten seconds a profile
constexpr unsigned kFrames = 1'048'576, kAccesses = 524'288, kStride = 16;
const std::vector<std::string> kProfiles = {"small", "standard", "full"};

/// What the buses add up to.
struct Sum {
  std::uint64_t runs = 0, commands = 0, answers = 0, disturbed = 0;
  std::vector<std::string> differences;
};

/// What the runs at the port add up to.
struct PortSum {
  std::uint64_t frames = 0, answers = 0;
  std::vector<std::string> differences;
};

/// What the searches for the bit rate add up to.
struct RateSum {
  unsigned runs = 0, wrong = 0, lost = 0;
  unsigned frames = 0, frames_alone = 0;  // most, without noise; alone: with a single sender
  std::vector<std::string> failures;

  void add(const RateTrial &trial) {
    ++runs;
    wrong += trial.right ? 0 : 1;
    lost += trial.found ? 0 : 1;
    if (!trial.right || !trial.found)
      failures.push_back(fmt::format("search, seed {}: {}", trial.setting.seed,
                                     trial.found ? "wrong rate" : "no rate"));
    if (trial.setting.noise_per_bit != 0) return;
    unsigned &most = trial.setting.hosts == 1 ? frames_alone : frames;
    most = std::max(most, trial.frames);
  }
};

/// What the runs with a babbling host add up to.
struct BabbleSum {
  std::uint64_t bits = 0, frames = 0, broken = 0;
  double lost = 0;  // most, %
  unsigned longest_wait = 0;
  std::vector<std::string> silent;  // nodes that did not answer behind it

  void add(const BabbleResult &run, const std::string &what) {
    bits += run.bits;
    frames += run.frames;
    broken += run.broken;
    lost = std::max(lost, run.lost());
    longest_wait = std::max(longest_wait, run.longest_wait);
    if (!run.answers) silent.push_back(what);
  }
};

class Campaign {
 public:
  explicit Campaign(const CampaignSettings &settings) : settings_{settings} {}

  void buses() {
    each(kBusCommands, kOfBus, [&](const std::string &profile, unsigned seed) {
      RandomRemotes remotes{profile, seed};
      unsigned done = 0;
      while (done < kOfBus && remotes.step()) ++done;
      const std::lock_guard guard{lock_};
      ++buses_.runs;
      buses_.commands += done;
      buses_.answers += remotes.answers();
      buses_.disturbed += remotes.disturbed();
      if (!remotes.difference().empty())
        buses_.differences.push_back(profile + ", seed " + std::to_string(seed) + ": " +
                                     remotes.difference());
    });
  }
  void triggers() {
    each(kTriggers, kOfLine, [&](const std::string &profile, unsigned seed) {
      const TriggerSkew skew = measure_triggers(profile, seed, kOfLine);
      const std::lock_guard guard{lock_};
      skew_ += skew;
    });
  }

  void searches() {
    const auto count = static_cast<std::size_t>(std::ceil(kSearches * settings_.scale));
    run_jobs(count, settings_.jobs, [&](std::size_t n) {
      const RateTrial trial = random_rate_trial(seed(static_cast<unsigned>(n)));
      const std::lock_guard guard{lock_};
      rates_.add(trial);
    });
  }

  void babblers() {
    each(kBabbledBits, kOfBabble, [&](const std::string &profile, unsigned seed) {
      const BabbleResult run = babble(profile, seed, kOfBabble);
      const std::lock_guard guard{lock_};
      babble_.add(run, fmt::format("babbling host, {}, seed {}: no answer", profile, seed));
    });
  }

  /// All of them at any scale: a minute a profile.
  void every_frame() {
    at_port(frames_, kPortSettings * kStride, [&](const std::string &profile, unsigned n) {
      return run_every_frame(port_setting(profile, n / kStride), kStride, n % kStride, seed(n));
    });
    at_port(accesses_, 4 * kStride, [&](const std::string &profile, unsigned n) {
      return run_every_access({profile, n & 1 ? 7U : 3U, (n & 2) != 0}, kStride, n / 4, seed(n));
    });
  }
  void port_commands() {
    each(kPortCommands, kOfPort, [&](const std::string &profile, unsigned seed) {
      PortLockstep pair{profile, 3, 3};
      RandomHost host{seed};
      PortRun run;
      while (run.frames < kOfPort && pair.compare().empty())
        if (random_port_step(pair, host)) ++run.frames;
      if (!pair.difference().empty())
        run.difference =
            fmt::format("{}, seed {}: {}\n{}", profile, seed, pair.difference(), pair.history());
      add(port_, run);
    });
  }

  /// Runs these parts, all if there is none, and prints the figures of each as it ends.
  Json run(const std::vector<std::string> &parts);

  /// A part of the campaign, and what it adds up to.
  struct Part {
    const char *name;
    void (Campaign::*run)();
    Json (Campaign::*figures)() const;
  };
  static const std::array<Part, 6> kParts;

 private:
  [[nodiscard]] Json enough(const char *name, std::uint64_t value, unsigned bar) const;
  [[nodiscard]] Json of_babblers() const;
  [[nodiscard]] Json of_searches() const;
  [[nodiscard]] Json of_frames() const;
  [[nodiscard]] Json of_commands() const;
  [[nodiscard]] Json of_triggers() const;
  [[nodiscard]] Json of_buses() const;
  [[nodiscard]] Json notes() const;
  [[nodiscard]] unsigned seed(unsigned n) const {
    return static_cast<unsigned>(settings_.seed * 1'000'000 + n);
  }
  void add(PortSum &sum, const PortRun &run) {
    const std::lock_guard guard{lock_};
    sum.frames += run.frames;
    sum.answers += run.answers;
    if (!run.difference.empty()) sum.differences.push_back(run.difference);
  }
  // The runs 0 to count - 1 of every profile.
  template <typename Run>
  void at_port(PortSum &sum, unsigned count, const Run &run) {
    for (const std::string &profile : kProfiles)
      run_jobs(count, settings_.jobs,
               [&](std::size_t n) { add(sum, run(profile, static_cast<unsigned>(n))); });
  }

  // Runs of `length` until there are `whole` in all, the profiles in turn.
  template <typename Run>
  void each(unsigned whole, unsigned length, const Run &run) {
    const auto count = static_cast<std::size_t>(std::ceil(whole * settings_.scale / length));
    run_jobs(count, settings_.jobs, [&](std::size_t n) {
      run(kProfiles[n % kProfiles.size()], static_cast<unsigned>(settings_.seed * 1'000'000 + n));
    });
  }

  const CampaignSettings &settings_;
  std::mutex lock_;
  Sum buses_;
  PortSum frames_, accesses_, port_;
  TriggerSkew skew_;
  RateSum rates_;
  BabbleSum babble_;
};

const std::array<Campaign::Part, 6> Campaign::kParts = {
    Part{"babblers", &Campaign::babblers, &Campaign::of_babblers},
    Part{"frames", &Campaign::every_frame, &Campaign::of_frames},
    Part{"buses", &Campaign::buses, &Campaign::of_buses},
    Part{"commands", &Campaign::port_commands, &Campaign::of_commands},
    Part{"searches", &Campaign::searches, &Campaign::of_searches},
    Part{"triggers", &Campaign::triggers, &Campaign::of_triggers}};

Json Campaign::enough(const char *name, std::uint64_t value, unsigned bar) const {
  return campaign_figure(name, value, fmt::format(">= {}", bar),
                         settings_.scale >= 1 ? Json(value >= bar) : Json(nullptr));
}

Json none(const char *name, std::uint64_t value) {
  return campaign_figure(name, value, "0", value == 0);
}

Json within(const char *name, unsigned value, unsigned bar) {
  return campaign_figure(name, value, fmt::format("<= {}", bar), value <= bar);
}

Json Campaign::of_babblers() const {
  return {enough("bits of a bus with a babbling host", babble_.bits, kBabbledBits),
          campaign_figure("its frames", babble_.frames),
          campaign_figure("its frames that were broken", babble_.broken),
          campaign_figure("RAM clocks that user logic loses to it, at most, %",
                          std::round(100 * babble_.lost) / 100, "<= 15", babble_.lost <= 15),
          within("clocks that user logic waits for, at most", babble_.longest_wait, 24),
          none("nodes without an answer 1 ms later", babble_.silent.size())};
}

Json Campaign::of_searches() const {
  return {enough("searches for the bit rate", rates_.runs, kSearches),
          none("searches that took a wrong rate", rates_.wrong),
          none("searches that found none", rates_.lost),
          within("frames until it was found, at most, without noise", rates_.frames, 40),
          within("the same with a single sender", rates_.frames_alone, 56)};
}

Json Campaign::of_frames() const {
  const auto profiles = static_cast<unsigned>(kProfiles.size());
  return {
      enough("frames at the port: every one of each number, locked or not", frames_.frames,
             profiles * kFrames),
      enough("accesses at the port: every address and length", accesses_.frames,
             profiles * kAccesses),
      campaign_figure("answers to them", frames_.answers + accesses_.answers),
      none("differences at the port", frames_.differences.size() + accesses_.differences.size())};
}

Json Campaign::of_commands() const {
  return {enough("random commands at the port", port_.frames, kPortCommands),
          none("differences in random commands", port_.differences.size())};
}

Json Campaign::of_triggers() const {
  return {enough("triggers", skew_.triggers, kTriggers),
          campaign_figure("pairs of nodes at a trigger", skew_.pairs),
          none("triggers that a node missed", skew_.lost),
          none("pairs beyond the bound of RN-47", skew_.above),
          campaign_figure("largest skew, ns", static_cast<double>(skew_.largest) / kNanosecond),
          campaign_figure("largest part of the bound, %", std::round(1000 * skew_.part) / 10)};
}

Json Campaign::of_buses() const {
  return {enough("commands on buses", buses_.commands, kBusCommands),
          campaign_figure("buses of two to eight nodes", buses_.runs),
          campaign_figure("answers of nodes", buses_.answers),
          campaign_figure("disturbances", buses_.disturbed),
          none("buses with a difference", buses_.differences.size())};
}

Json Campaign::notes() const {
  Json notes = Json::array();
  for (const auto *texts : {&buses_.differences, &frames_.differences, &accesses_.differences,
                            &port_.differences, &rates_.failures, &babble_.silent})
    for (const std::string &text : *texts) notes.push_back(text);
  if (skew_.triggers != 0)
    notes.push_back(
        fmt::format("nearest to its bound: {:.0f} % of it, {}", 100 * skew_.part, skew_.worst));
  return notes;
}

Json Campaign::run(const std::vector<std::string> &parts) {
  Json figures = Json::array();
  for (const Part &part : kParts) {
    if (!parts.empty() && std::find(parts.begin(), parts.end(), part.name) == parts.end()) continue;
    (this->*part.run)();
    for (const Json &figure : (this->*part.figures)()) {
      print_figure(figure);
      figures.push_back(figure);
    }
    std::fflush(stdout);
  }
  return {{"figures", figures}, {"tables", Json::array()}, {"notes", notes()}};
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Remote nodes of the RTL beside their model"};
  try {
    CampaignSettings settings;
    settings.add_to(app,
                    "1,000,000 commands at the port, 100,000 on buses, 10,000 triggers, 10,000 "
                    "searches for the bit rate and 30 s with a babbling host");
    std::vector<std::string> parts;
    app.add_option("--only", parts,
                   "Parts of it: babblers, frames, buses, commands, searches, triggers")
        ->delimiter(',')
        ->check(CLI::IsMember({"babblers", "frames", "buses", "commands", "searches", "triggers"}));
    if (const auto end = read_options(app, argc, argv)) return *end;
    check_writable(settings.json);
    const Json result = Campaign{settings}.run(parts);
    print_notes(result);
    write_result(settings.json, result.dump(1) + "\n");
    return bars_hold(result) ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "remote_campaign: {}\n", error.what());
    return 2;
  }
}
