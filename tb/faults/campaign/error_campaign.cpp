// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// error_campaign: the whole error injection matrix (docs/error-injection.md), or one run of it.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <mutex>
#include <thread>

#include "faults/campaign/result_json.hpp"
#include "faults/campaign/shard_file.hpp"
#include "faults/campaign/tally.hpp"
#include "harness/campaign_settings.hpp"
#include "harness/shard.hpp"
#include "harness/test_wave.hpp"

namespace vericansim {
namespace {

struct Options : CampaignSettings {
  bool list = false;
  std::string run;
  std::vector<std::string> parts;
  std::string csv;
  std::string wave;
  bool bins = false;
  Shard shard;
};

/// A part with the sample of its cases that is to be run.
struct Work {
  const Section *section;
  Spread spread;
};

class Campaign {
 public:
  Campaign(const Sections &sections, const Options &options);
  void run(unsigned jobs);
  /// Instead: what the shards have counted.
  void take_up(const std::vector<std::string> &files);
  [[nodiscard]] const Tally &tally() const { return tally_; }
  [[nodiscard]] const RuleBins &bins() const { return bins_; }
  [[nodiscard]] std::size_t size() const { return total_; }

 private:
  static constexpr std::size_t kChunk = 200;

  void work();
  void show_progress();

  Shard shard_;
  std::vector<Work> work_;
  std::size_t total_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<unsigned> working_ = 0;  // threads
  std::mutex mutex_;
  Tally tally_;
  RuleBins bins_;
};

Campaign::Campaign(const Sections &sections, const Options &options) : shard_{options.shard} {
  for (const auto &section : sections) {
    const std::string &name = section->grid().name();
    const auto &parts = options.parts;
    if (!parts.empty() && std::find(parts.begin(), parts.end(), name) == parts.end()) continue;
    const std::size_t size = section->grid().size();
    const auto count = static_cast<std::size_t>(static_cast<double>(size) * options.scale);
    work_.push_back({section.get(), Spread{size, std::max<std::size_t>(count, 1)}});
    total_ += work_.back().spread.count();
  }
}

// Cases are numbered through over all parts; a thread takes kChunk of them at a time, a shard every
// so manieth chunk. No case knows of another, so the threads' order changes nothing.
void Campaign::work() {
  Tally tally;
  RuleBins bins;
  for (;;) {
    const std::size_t first = (next_.fetch_add(1) * shard_.count() + shard_.number()) * kChunk;
    if (first >= total_) break;
    std::size_t base = 0;
    for (const Work &part : work_) {
      const std::size_t end = std::min(first + kChunk, base + part.spread.count());
      for (std::size_t n = std::max(first, base); n < end; ++n) {
        const std::size_t index = part.spread.at(n - base);
        const Grid &grid = part.section->grid();
        tally.add(grid, index, part.section->run(grid.digits(index), &bins));
      }
      base += part.spread.count();
    }
    done_ += std::min(kChunk, total_ - first);
  }
  const std::lock_guard lock{mutex_};
  tally_.merge(tally);
  bins_.merge(bins);
}

void Campaign::show_progress() {
  using namespace std::chrono_literals;
  auto shown = std::chrono::steady_clock::now();
  while (working_ != 0) {
    std::this_thread::sleep_for(20ms);
    if (std::chrono::steady_clock::now() - shown < 10s) continue;
    shown = std::chrono::steady_clock::now();
    std::cout << "error injection: " << done_ << " of " << total_ << " runs" << std::endl;
  }
}

void Campaign::run(unsigned jobs) {
  std::vector<std::thread> threads;
  working_ = jobs;
  for (unsigned i = 0; i < jobs; ++i)
    threads.emplace_back([this] {
      work();
      --working_;
    });
  show_progress();
  for (std::thread &thread : threads) thread.join();
}

void Campaign::take_up(const std::vector<std::string> &files) {
  for (const std::string &file : files) add_shard(file, tally_, bins_);
}

void list(const Sections &sections) {
  std::size_t total = 0;
  for (const auto &section : sections) {
    const Grid &grid = section->grid();
    std::cout << grid.name() << ": " << grid.size() << "  (" << section->rules() << ")\n";
    for (const Axis &axis : grid.axes()) {
      std::cout << "    " << axis.name << " " << axis.values.size() << ": " << axis.values.front()
                << " .. " << axis.values.back() << "\n";
    }
    total += grid.size();
  }
  std::cout << "all: " << total << "\n";
}

int run_one(const Sections &sections, const Options &options) {
  for (const auto &section : sections) {
    const auto index = section->grid().find(options.run);
    if (!index) continue;
    if (!options.wave.empty()) {
      setenv("VERICAN_WAVE_DIR", options.wave.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
      std::string name = options.run;
      std::replace(name.begin(), name.end(), '/', '_');
      TestWave::name_run(name);
    }
    const Outcome outcome = section->run(section->grid().digits(*index), nullptr);
    std::cout << options.run << ": role " << outcome.role << ", state " << outcome.state
              << ", position " << outcome.position << ", reaction " << outcome.reaction << "\n"
              << (outcome.report.empty() ? "RTL and rules agree\n" : outcome.report);
    return outcome.report.empty() ? 0 : 1;
  }
  std::cerr << "error_campaign: there is no run '" << options.run
            << "'; see --list for the parts and their axes\n";
  return 2;
}

void list_missing(const RuleBins &bins) {
  for (const BinGroup &group : bins.groups()) {
    for (const auto &[key, bin] : group.bins) {
      if (bin.hits == 0) std::cout << "not hit: " << group.name << ": " << bin.name << "\n";
    }
    for (const auto &[key, hits] : group.unlisted) {
      std::cout << "called unreachable: " << group.name << ": key " << key << "\n";
    }
  }
}

void summarise(const Tally &tally, const RuleBins &bins, const Options &options, double seconds) {
  for (const Failure &failure : tally.failures()) {
    std::cout << "MISMATCH " << failure.id << "\n"
              << failure.report << "again: error_campaign --seed " << options.seed << " --run "
              << failure.id << "\n";
  }
  for (const BinGroup &group : bins.groups()) {
    std::cout << "TH-05 " << group.name << ": " << group.reached() << " of " << group.bins.size()
              << " bins" << (group.unlisted.empty() ? "" : ", and some called unreachable") << "\n";
  }
  if (options.bins) list_missing(bins);
  const Count total = tally.total();
  std::cout << "error injection: " << total.runs << " runs, " << total.mismatches << " mismatches, "
            << seconds << " s" << std::endl;
}

int run_campaign(const Sections &sections, const Options &options) {
  const Shard &shard = options.shard;
  if (!shard.part()) {
    check_writable(options.json);
    check_writable(options.csv);
  }
  const auto begin = std::chrono::steady_clock::now();
  Campaign campaign{sections, options};
  if (shard.merge())
    campaign.take_up(shard.paths(options.directory));
  else
    campaign.run(options.jobs);
  if (shard.part()) {
    write_shard(shard.path(options.directory), campaign.tally(), campaign.bins());
    return 0;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const double cpu = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  const ResultInfo info{options.scale >= 1 && options.parts.empty(), took.count(), cpu,
                        options.seed};
  write_result(options.json, result_json(campaign.tally(), campaign.bins(), sections, info));
  write_result(options.csv, result_csv(campaign.tally()));
  summarise(campaign.tally(), campaign.bins(), options, took.count());
  return campaign.tally().total().mismatches == 0 ? 0 : 1;
}

void add_options(CLI::App &app, Options &options) {
  app.add_flag("--list", options.list, "Print the parts of the table with their axes and sizes");
  auto *run =
      app.add_option("--run", options.run, "Only this run, by its name: <part>/<value>/<value>...");
  app.add_option("--part", options.parts, "Only these parts");
  options.add_to(app, "the cases of each part of the table, evenly chosen");
  app.add_option("--directory", options.directory, "Where shards leave what they have counted");
  app.add_option("--csv", options.csv, "Write runs and mismatches of every combination here");
  app.add_flag("--bins", options.bins, "Name the bins of TH-05 that were not hit");
  app.add_option("--wave", options.wave, "With --run: write the run's waveform to this folder")
      ->check(CLI::ExistingDirectory)
      ->needs(run);
}

void check_parts(const Sections &sections, const Options &options) {
  for (const std::string &part : options.parts) {
    const auto named = [&part](const auto &section) { return section->grid().name() == part; };
    if (std::none_of(sections.begin(), sections.end(), named)) {
      throw std::runtime_error("there is no part '" + part + "'; see --list");
    }
  }
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  using namespace vericansim;
  CLI::App app{"The error injection matrix: the RTL against the rules, bit by bit."};
  try {
    Options options;
    add_options(app, options);
    if (const auto end = read_options(app, argc, argv)) return *end;
    const Sections sections = all_sections(options.seed);
    check_parts(sections, options);
    if (options.list) {
      list(sections);
      return 0;
    }
    return options.run.empty() ? run_campaign(sections, options) : run_one(sections, options);
  } catch (const std::exception &error) {
    std::cerr << "error_campaign: " << error.what() << "\n";
    return 2;
  }
}
