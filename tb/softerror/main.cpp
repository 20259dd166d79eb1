// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// softerror: flips the flip-flops of the core under traffic (docs/soft-errors.md). Without
// --flop it is the stage `softerror` of the campaign.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "harness/campaign_settings.hpp"
#include "harness/shard.hpp"
#include "softerror/campaign.hpp"
#include "softerror/report.hpp"

namespace vericansim {
namespace {

struct Options : CampaignSettings {
  std::string flop;
  std::uint64_t time = 0;
  int stuck = -1;
  std::string wave;
  bool list = false;
};

unsigned find_flop(const std::string &name) {
  const auto &flops = FlopNode::flops();
  for (unsigned n = 0; n < flops.size(); ++n) {
    if (flops[n].name() == name) return n;
  }
  throw std::runtime_error("no flip-flop '" + name + "'; --list names them");
}

int one_flip(const Options &options) {
  Job job;
  job.seed = options.seed;
  if (options.time != 0) job.time = options.time;
  job.wave = options.wave;
  const auto kind = options.stuck < 0    ? Flip::Kind::kFlop
                    : options.stuck == 0 ? Flip::Kind::kStuckAt0
                                         : Flip::Kind::kStuckAt1;
  job.flips = {{kind, find_flop(options.flop)}};
  const Record record = run_job(job).front();
  print_record(record);
  return record.verdict >= Verdict::kHang ? 1 : 0;
}

/// Every so manieth job, as the shard says.
std::vector<Job> jobs_of(const Shard &shard, const Options &options) {
  const auto all = plan_jobs(options.seed, options.scale);
  std::vector<Job> mine;
  for (std::size_t n = shard.number(); n < all.size(); n += shard.count()) mine.push_back(all[n]);
  return mine;
}

int campaign(const Options &options) {
  const Shard shard;
  if (!shard.part()) check_writable(options.json);
  const auto records = shard.merge()
                           ? read_records(shard.paths(options.directory))
                           : run_jobs(jobs_of(shard, options), options.jobs, options.directory);
  if (shard.part()) {
    write_records(records, shard.path(options.directory));
    return 0;
  }
  write_json(records, options.json);
  return print_summary(records) ? 0 : 1;
}

void add_options(CLI::App &app, Options &options) {
  options.add_to(app, "the whole campaign", "--out");
  auto *flop = app.add_option("--flop", options.flop,
                              "Flip this one only, NAME[BIT], see --list; --seed is of the moment");
  app.add_option("--time", options.time, "Clock of the flip; default: chosen by the seed")
      ->needs(flop);
  app.add_option("--stuck", options.stuck, "A defect, stuck at 0 or 1 from then on")
      ->check(CLI::Range(0, 1))
      ->needs(flop);
  app.add_option("--wave", options.wave, "VCD file of the run from the flip on")->needs(flop);
  app.add_option("--scratch", options.directory, "Directory for files in between");
  app.add_flag("--list", options.list, "Name all flip-flops");
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app{"Flips flip-flops of can_ahb under traffic and tells what came of it."};
  add_options(app, options);
  if (const auto end = read_options(app, argc, argv)) return *end;
  if (options.list) {
    for (const Flop &flop : FlopNode::flops()) std::printf("%s\n", flop.name().c_str());
    return 0;
  }
  return options.flop.empty() ? campaign(options) : one_flip(options);
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  try {
    return vericansim::run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "softerror: %s\n", error.what());
    return 2;
  }
}
