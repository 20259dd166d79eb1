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

#include "harness/shard.hpp"
#include "softerror/campaign.hpp"
#include "softerror/report.hpp"

namespace vericansim {
namespace {

struct Options {
  std::string flop;
  std::uint64_t seed = 1;
  std::uint64_t time = 0;
  int stuck = -1;
  std::string wave;
  double scale = 1.0;
  unsigned jobs = 2;
  bool list = false;
  std::string scratch = ".";
  std::string out;
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
  const auto records = shard.merge()
                           ? read_records(shard.paths(options.scratch))
                           : run_jobs(jobs_of(shard, options), options.jobs, options.scratch);
  if (shard.part()) {
    write_records(records, shard.path(options.scratch));
    return 0;
  }
  if (!options.out.empty()) write_json(records, options.out);
  return print_summary(records) ? 0 : 1;
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app{"Flips flip-flops of can_ahb under traffic and tells what came of it."};
  app.add_option("--flop", options.flop, "flip this one only, NAME[BIT]; see --list");
  app.add_option("--seed", options.seed, "seed of the campaign, or of the moment with --flop")
      ->envname("CAMPAIGN_SEED");
  app.add_option("--time", options.time, "clock of the flip; default: chosen by the seed");
  app.add_option("--stuck", options.stuck, "with --flop: a defect, stuck at 0 or 1 from then on")
      ->check(CLI::Range(0, 1));
  app.add_option("--wave", options.wave, "with --flop: VCD file of the run from the flip on");
  app.add_option("--scale", options.scale, "share of the whole campaign, above 0, at most 1")
      ->envname("CAMPAIGN_SCALE")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--jobs", options.jobs, "processes, 1 to 64")
      ->envname("CAMPAIGN_JOBS")
      ->check(CLI::Range(1, 64));
  app.add_option("--scratch", options.scratch, "directory for files in between")
      ->envname("CAMPAIGN_DIR");
  app.add_option("--out", options.out, "file for figures and tables, JSON")
      ->envname("CAMPAIGN_OUT");
  app.add_flag("--list", options.list, "name all flip-flops");
  CLI11_PARSE(app, argc, argv);
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
