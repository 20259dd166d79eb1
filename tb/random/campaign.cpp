// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// random_campaign: whole cores on random buses, judged in every bit (docs/lockstep.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "harness/campaign_settings.hpp"
#include "random/campaign_run.hpp"

namespace {

using namespace vericansim;

void add_options(CLI::App &app, CampaignOptions &options) {
  app.add_option("--seed", options.seed, "First seed; else CAMPAIGN_SEED")
      ->check(kSeeds.check())
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Seeds to run; 0: until there are --frames")
      ->check(Allowed<std::uint64_t>{0, kAmounts.most()}.check())
      ->capture_default_str();
  app.add_option("--frames", options.frames, "Frames on the buses in all")
      ->check(kAmounts.check())
      ->capture_default_str();
  app.add_option("--frames-a-run", options.frames_a_run, "Frames of one bus of middle size")
      ->check(CLI::Range(10U, 1'000'000U))
      ->capture_default_str();
  CampaignSettings::add_jobs_to(app, options.jobs);
  app.add_option("--directory", options.directory,
                 "Where the journal and scenarios of failing seeds go")
      ->capture_default_str();
  app.add_option("--json", options.json, "File for the result");
  app.add_flag("--print", options.print, "Print the scenario of --seed, do not run it");
  app.add_flag("--no-shrink", options.no_shrink, "Keep a failing scenario as it is");
  app.add_flag("--resume", options.resume,
               "Go on after an interruption: seeds that passed with this program count");
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Random buses of whole cores with all judges on (docs/lockstep.md)"};
  try {
    CampaignOptions options = campaign_defaults();
    add_options(app, options);
    if (const auto end = read_options(app, argc, argv)) return *end;
    return run_campaign(options);
  } catch (const std::exception &error) {
    fmt::print(stderr, "random_campaign: {}\n", error.what());
    return 2;
  }
}
