// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the programs of a campaign's stages share: settings from tools/campaign.py, figures.
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace vericansim {

/// Settings of a stage; by default what the environment of tools/campaign.py says.
struct CampaignSettings {
  std::uint64_t seed = std::stoull(variable("CAMPAIGN_SEED", "1"));
  double scale = std::stod(variable("CAMPAIGN_SCALE", "1"));
  unsigned jobs = static_cast<unsigned>(std::stoul(variable("CAMPAIGN_JOBS", "2")));
  std::string json = variable("CAMPAIGN_OUT", "");

  /// `part`: what --scale is a part of.
  void add_to(CLI::App &app, const std::string &part) {
    app.add_option("--seed", seed, "Seed")->capture_default_str();
    app.add_option("--scale", scale, "Part of " + part)
        ->check(CLI::Range(0.0001, 1.0))
        ->capture_default_str();
    app.add_option("--jobs", jobs, "Threads")->check(CLI::Range(1U, 64U));
    app.add_option("--json", json, "File for the result");
  }

 private:
  static std::string variable(const char *name, const char *otherwise) {
    const char *text = std::getenv(name);
    return text != nullptr ? text : otherwise;
  }
};

/// A figure as tools/campaign.py reads it; without a bar: no verdict.
inline nlohmann::ordered_json campaign_figure(const char *name, const nlohmann::ordered_json &value,
                                              const nlohmann::ordered_json &bar = nullptr,
                                              const nlohmann::ordered_json &ok = nullptr) {
  return {{"name", name}, {"value", value}, {"bar", bar}, {"ok", ok}};
}

/// work(n) for each n below `count`, on `jobs` threads.
template <typename Work>
void run_jobs(std::size_t count, unsigned jobs, const Work &work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads;
  for (unsigned job = 0; job < jobs; ++job)
    threads.emplace_back([&] {
      for (std::size_t n = next++; n < count; n = next++) work(n);
    });
  for (std::thread &thread : threads) thread.join();
}

}  // namespace vericansim
