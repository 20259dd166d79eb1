// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The random campaign: see campaign_run.hpp.
#include "random/campaign_run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "random/campaign_journal.hpp"
#include "random/campaign_result.hpp"
#include "random/judged_run.hpp"
#include "random/random_scenario.hpp"
#include "random/shrink.hpp"

namespace vericansim {
namespace {

using Clock = std::chrono::steady_clock;

double environment(const char *name, double otherwise) {
  const char *text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  if (text == nullptr || *text == 0) return otherwise;
  double value = 0;
  const char *end = text + std::strlen(text);
  if (std::from_chars(text, end, value).ptr != end || value < 0)
    throw std::runtime_error(fmt::format("{}='{}' is no number", name, text));
  return value;
}

std::string environment(const char *name, const std::string &otherwise) {
  const char *text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr || *text == 0 ? otherwise : text;
}

class Campaign {
 public:
  explicit Campaign(const CampaignOptions &options)
      : options_{options},
        journal_{in_directory(options, "journal.jsonl"),
                 fmt::format("{} {} {}", program_key(), options.frames_a_run, options.seed),
                 options.resume},
        next_seed_{options.seed},
        begin_{Clock::now()} {}

  int run() {
    for (const auto &[seed, run] : journal_.before()) {
      frames_ += run.frames;
      result_.add(seed, random_scenario(seed, options_.frames_a_run), run);
    }
    if (result_.runs != 0) fmt::print("{} seeds, {} frames before\n", result_.runs, frames_.load());
    std::vector<std::thread> workers;
    for (unsigned i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });
    for (std::thread &worker : workers) worker.join();
    result_.seconds = seconds();
    fmt::print("{}", result_.text());
    if (!options_.json.empty())
      write(options_.json, result_.json(options_.seed, options_.runs == 0 ? options_.frames : 0));
    return result_.failures.empty() ? 0 : 1;
  }

 private:
  void work() {
    for (;;) {
      const std::uint64_t seed = next_seed_++;
      const bool enough =
          options_.runs != 0 ? seed >= options_.seed + options_.runs : frames_ >= options_.frames;
      if (enough) return;
      if (journal_.before().count(seed) == 0) run(seed);
    }
  }

  void run(std::uint64_t seed) {
    const Scenario scenario = random_scenario(seed, options_.frames_a_run);
    const JudgedRun run = run_judged(scenario);
    frames_ += run.frames;
    if (!run.ok()) failed(seed, scenario, run);
    const std::lock_guard lock{mutex_};
    result_.add(seed, scenario, run);
    if (run.ok()) journal_.add(seed, run, seconds());
    if (seconds() < next_report_) return;
    next_report_ = seconds() + 10;
    fmt::print("{} seeds, {} frames, {:.0f} frames/s, {} failed\n", result_.runs, frames_.load(),
               static_cast<double>(frames_) / seconds(), result_.failures.size());
    std::fflush(stdout);
  }

  void failed(std::uint64_t seed, const Scenario &scenario, const JudgedRun &run) {
    const std::string stem = fmt::format("{}/seed-{}", options_.directory, seed);
    write(stem + "-full.yaml", to_yaml(scenario));
    std::string text =
        fmt::format("seed {} FAILED after {:.3f} ms: {}\n", seed,
                    static_cast<double>(run.failed_at) / kMillisecond, run.findings.front());
    if (!options_.no_shrink) {
      const Shrunk shrunk = shrink(scenario, run);
      write(stem + ".yaml", to_yaml(shrunk.scenario));
      text += fmt::format("seed {} shrunk to {}.yaml ({} runs): {}\n", seed, stem, shrunk.runs,
                          shrunk.run.findings.front());
    }
    const std::lock_guard lock{mutex_};
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  static void write(const std::string &path, const std::string &text) {
    std::ofstream file{path};
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
  }

  /// The name of a file in the directory, which is made.
  static std::string in_directory(const CampaignOptions &options, const std::string &name) {
    std::filesystem::create_directories(options.directory);
    return options.directory + "/" + name;
  }

  /// Wall time, with that before an interruption.
  [[nodiscard]] double seconds() const {
    return journal_.seconds_before() + std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  CampaignOptions options_;
  CampaignJournal journal_;
  std::atomic<std::uint64_t> next_seed_;
  std::atomic<std::uint64_t> frames_ = 0;
  std::mutex mutex_;  // of result_ and of the output
  CampaignResult result_;
  Clock::time_point begin_;
  double next_report_ = 0;
};

}  // namespace

CampaignOptions campaign_defaults() {
  CampaignOptions options;
  options.seed = static_cast<std::uint64_t>(environment("CAMPAIGN_SEED", 1.0));
  const double scale = environment("CAMPAIGN_SCALE", 1.0);
  options.frames = static_cast<std::uint64_t>(10'000'000 * scale);
  options.directory = environment("CAMPAIGN_DIR", std::string{"build/random"});
  options.json = environment("CAMPAIGN_OUT", std::string{});
  options.resume = environment("CAMPAIGN_RESUME", 0.0) != 0;
  return options;
}

int run_campaign(const CampaignOptions &options) {
  if (options.print) {
    fmt::print("{}", to_yaml(random_scenario(options.seed, options.frames_a_run)));
    return 0;
  }
  return Campaign{options}.run();
}

}  // namespace vericansim
