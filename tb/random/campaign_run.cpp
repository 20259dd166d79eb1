// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The random campaign: see campaign_run.hpp.
#include "random/campaign_run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "harness/campaign_settings.hpp"
#include "random/campaign_journal.hpp"
#include "random/campaign_result.hpp"
#include "random/judged_run.hpp"
#include "random/random_scenario.hpp"
#include "random/shrink.hpp"

namespace vericansim {
namespace {

using Clock = std::chrono::steady_clock;

/// Frames of a seed for each of `frames_a_run`, rather too few than too many: shards together have
/// about the seeds that are needed. What is missing is run when they are merged.
constexpr double kFramesOfASeed = 1.2;

/// Seeds from `first` to below `end`.
struct Range {
  std::uint64_t first = 0;
  std::uint64_t end = ~std::uint64_t{0};
};

Range seeds_of(const CampaignOptions &options) {
  Range range{options.seed};
  if (options.runs != 0) range.end = options.seed + options.runs;
  if (!options.shard.part()) return range;
  const std::uint64_t runs =
      options.runs != 0
          ? options.runs
          : static_cast<std::uint64_t>(std::ceil(static_cast<double>(options.frames) /
                                                 kFramesOfASeed / options.frames_a_run));
  const auto begin_of = [&](std::uint64_t shard) {
    return options.seed + runs * shard / options.shard.count();
  };
  return {begin_of(options.shard.number()), begin_of(options.shard.number() + 1)};
}

class Campaign {
 public:
  explicit Campaign(const CampaignOptions &options)
      : options_{options},
        journal_{journal_of(options)},
        seeds_{seeds_of(options)},
        next_seed_{seeds_.first},
        begin_{Clock::now()} {}

  int run() {
    if (!journal_.before().empty()) fmt::print("{} seeds before\n", journal_.before().size());
    std::vector<std::thread> workers;
    for (unsigned i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });
    for (std::thread &worker : workers) worker.join();
    const CampaignResult result = sum();
    fmt::print("{}", result.text());
    if (options_.shard.part()) return 0;
    write_result(options_.json,
                 result.json(options_.seed, options_.runs == 0 ? options_.frames : 0));
    return result.failures.empty() ? 0 : 1;
  }

 private:
  static CampaignJournal journal_of(const CampaignOptions &options) {
    const std::string key =
        fmt::format("{} {} {}", program_key(), options.frames_a_run, options.seed);
    std::filesystem::create_directories(options.directory);
    const Shard &shard = options.shard;
    if (shard.part()) return {shard.path(options.directory), key, true};
    const std::string path = options.directory + "/journal.jsonl";
    if (shard.merge()) return {path, key, shard.paths(options.directory)};
    return {path, key, options.resume};
  }

  /// Seeds are taken in their order, so those that are done are always the first.
  void work() {
    const bool all = options_.runs != 0 || options_.shard.part();
    for (;;) {
      const std::uint64_t seed = next_seed_++;
      if (seed >= seeds_.end || (!all && frames_ >= options_.frames)) return;
      const auto before = journal_.before().find(seed);
      if (before == journal_.before().end())
        run(seed);
      else
        done(seed, before->second);
    }
  }

  void done(std::uint64_t seed, const JudgedRun &run) {
    frames_ += run.frames;
    const std::lock_guard lock{mutex_};
    done_[seed] = run;
  }

  void run(std::uint64_t seed) {
    const Scenario scenario = random_scenario(seed, options_.frames_a_run);
    const JudgedRun run = run_judged(scenario);
    if (!run.ok()) failed(seed, scenario, run);
    done(seed, run);
    const std::lock_guard lock{mutex_};
    failures_ += run.ok() ? 0 : 1;
    if (run.ok()) journal_.add(seed, run, seconds());
    if (seconds() < next_report_) return;
    next_report_ = seconds() + 10;
    fmt::print("{} seeds, {} frames, {:.0f} frames/s, {} failed\n", done_.size(), frames_.load(),
               static_cast<double>(frames_) / seconds(), failures_);
    std::fflush(stdout);
  }

  /// How many seeds are done when there are frames enough depends on the threads: the sum goes over
  /// the first that have enough. A failure counts wherever it is.
  [[nodiscard]] CampaignResult sum() const {
    CampaignResult result;
    const bool all = options_.runs != 0 || options_.shard.part();
    for (const auto &[seed, run] : done_) {
      if (all || result.frames < options_.frames || !run.ok())
        result.add(seed, random_scenario(seed, options_.frames_a_run), run);
    }
    result.seconds = seconds();
    return result;
  }

  void failed(std::uint64_t seed, const Scenario &scenario, const JudgedRun &run) {
    const std::string stem = fmt::format("{}/seed-{}", options_.directory, seed);
    write_result(stem + "-full.yaml", to_yaml(scenario));
    std::string text =
        fmt::format("seed {} FAILED after {:.3f} ms: {}\n", seed,
                    static_cast<double>(run.failed_at) / kMillisecond, run.findings.front());
    if (!options_.no_shrink) {
      const Shrunk shrunk = shrink(scenario, run);
      write_result(stem + ".yaml", to_yaml(shrunk.scenario));
      text += fmt::format("seed {} shrunk to {}.yaml ({} runs): {}\n", seed, stem, shrunk.runs,
                          shrunk.run.findings.front());
    }
    const std::lock_guard lock{mutex_};
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  /// Wall time, with that before an interruption.
  [[nodiscard]] double seconds() const {
    return journal_.seconds_before() + std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  CampaignOptions options_;
  CampaignJournal journal_;
  Range seeds_;
  std::atomic<std::uint64_t> next_seed_;
  std::atomic<std::uint64_t> frames_ = 0;
  std::mutex mutex_;  // of what follows, of the journal and of the output
  std::map<std::uint64_t, JudgedRun> done_;
  std::uint64_t failures_ = 0;
  Clock::time_point begin_;
  double next_report_ = 0;
};

}  // namespace

CampaignOptions campaign_defaults() {
  const CampaignSettings settings;
  CampaignOptions options;
  options.seed = settings.seed;
  options.frames = static_cast<std::uint64_t>(std::ceil(10'000'000 * settings.scale));
  options.jobs = settings.jobs;
  options.directory = campaign_variable("CAMPAIGN_DIR", "build/random");
  options.json = settings.json;
  options.resume = campaign_variable("CAMPAIGN_RESUME", 0U, Allowed<unsigned>{0, 1}) != 0;
  return options;
}

int run_campaign(const CampaignOptions &options) {
  if (options.print) {
    fmt::print("{}", to_yaml(random_scenario(options.seed, options.frames_a_run)));
    return 0;
  }
  if (!options.shard.part()) check_writable(options.json);
  return Campaign{options}.run();
}

}  // namespace vericansim
