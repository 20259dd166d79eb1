// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// fuzz_registers: random AHB sequences on a core under traffic; docs/fuzzing.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>

#include "fuzz/register_bench.hpp"
#include "harness/campaign_settings.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/text.hpp"

namespace {

using namespace vericansim;
using namespace vericansim::fuzz;

constexpr unsigned kCasesPerEpisode = 16;

struct Options {
  std::uint64_t cases = 1000;
  std::uint64_t seed = 1;
  std::string out, keep = ".", replay;
};

struct Totals {
  std::uint64_t cases = 0, episodes = 0, clocks = 0, bus_frames = 0, excused = 0, dominant = 0;
  std::uint64_t longest_acknowledge = 0;
  unsigned max_waits = 0;
  std::array<std::uint64_t, kModes> cases_in{}, transfers_in{};
};

/// One episode: a core in a mode, cases, recovery. Returns what was broken.
std::string run_episode(Episode &episode, bool replay, Totals &totals) {
  Random random{episode.seed};
  const auto kind = static_cast<FuzzedCore::Kind>(draw(random, 2));
  const auto mode = static_cast<CoreMode>(draw(random, kStartModes));
  const bool fifo = chance(random, 50);
  const auto way = static_cast<Recovery>(draw(random, 3));
  RegisterBench bench{kind, random()};
  bench.enter(mode, fifo);
  const std::size_t count = replay ? episode.cases.size() : kCasesPerEpisode;
  for (std::size_t i = 0; i < count && bench.fault().empty(); ++i) {
    if (!replay) episode.cases.push_back(draw_case(random, kind == FuzzedCore::Kind::kUser));
    const auto in = static_cast<std::size_t>(bench.mode());
    ++totals.cases;
    ++totals.cases_in[in];
    totals.transfers_in[in] += episode.cases[i].size();
    bench.run(episode.cases[i]);
  }
  if (bench.fault().empty()) bench.check_peers();
  if (bench.fault().empty()) bench.recover(way);
  ++totals.episodes;
  totals.clocks += bench.clocks();
  totals.bus_frames += bench.judge().frames();
  totals.excused += bench.judge().excused();
  totals.dominant += bench.judge().dominant_samples();
  totals.max_waits = std::max(totals.max_waits, bench.max_waits());
  totals.longest_acknowledge = std::max(totals.longest_acknowledge, bench.longest_acknowledge());
  if (bench.fault().empty()) return "";
  return fmt::format("{} core, begun in {} mode{}: {}",
                     kind == FuzzedCore::Kind::kFull ? "64-buffer" : "16-buffer CheckHprot",
                     to_string(mode), fifo ? " with Rx FIFO" : "", bench.fault());
}

void report(const Options &options, const Totals &totals, std::uint64_t failed, double seconds) {
  nlohmann::ordered_json modes = nlohmann::ordered_json::object();
  for (unsigned i = 0; i < kModes; ++i)
    modes[to_string(static_cast<CoreMode>(i))] = {{"cases", totals.cases_in[i]},
                                                  {"transfers", totals.transfers_in[i]}};
  const nlohmann::ordered_json json{{"cases", totals.cases},
                                    {"episodes", totals.episodes},
                                    {"failed", failed},
                                    {"clocks", totals.clocks},
                                    {"bus_frames", totals.bus_frames},
                                    {"excused_errors", totals.excused},
                                    {"dominant_samples", totals.dominant},
                                    {"max_waits", totals.max_waits},
                                    {"longest_acknowledge", totals.longest_acknowledge},
                                    {"seconds", seconds},
                                    {"modes", modes}};
  write_result(options.out, json.dump(2) + "\n");
  fmt::print("{} cases in {} episodes, {} clocks, {} frames on the bus, {:.1f} s: {} failed\n",
             totals.cases, totals.episodes, totals.clocks, totals.bus_frames, seconds, failed);
}

/// Where the episode of this seed is kept.
std::string path_of(const Options &options, std::uint64_t seed) {
  return fmt::format("{}/registers-{}.txt", options.keep, seed);
}

int fail(const Options &options, const Episode &episode, const std::string &fault) {
  const std::string path = path_of(options, episode.seed);
  write_result(path, fmt::format("# {}\n{}", fault, to_text(episode)));
  fmt::print("FAIL {}\n  again: fuzz_registers --replay {}\n", fault, path);
  return 1;
}

int run(const Options &options) {
  using Wall = std::chrono::steady_clock;
  const auto start = Wall::now();
  auto told = start;
  const auto seconds = [&] { return std::chrono::duration<double>(Wall::now() - start).count(); };
  Totals totals;
  if (!options.replay.empty()) {
    Episode episode = parse_episode(read_text_file(options.replay), options.replay);
    const std::string fault = run_episode(episode, true, totals);
    fmt::print("{}\n", fault.empty() ? "nothing is broken" : fault);
    return fault.empty() ? 0 : 1;
  }
  check_writable(options.out);
  check_writable(path_of(options, options.seed));
  Random seeds{options.seed};
  std::uint64_t failed = 0;
  while (totals.cases < options.cases && failed < 10) {
    Episode episode{seeds(), {}};
    const std::string fault = run_episode(episode, false, totals);
    if (!fault.empty()) failed += static_cast<unsigned>(fail(options, episode, fault));
    if (Wall::now() - told > std::chrono::seconds{10}) {
      told = Wall::now();
      fmt::print("{} cases, {:.0f} s\n", totals.cases, seconds());
      std::fflush(stdout);
    }
  }
  report(options, totals, failed, seconds());
  return failed == 0 ? 0 : 1;
}

void add_options(CLI::App &app, Options &options) {
  app.add_option("--cases", options.cases, "Cases in all")
      ->check(kAmounts.check())
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Seed")->check(kSeeds.check())->capture_default_str();
  app.add_option("--out", options.out, "File for the figures, JSON");
  app.add_option("--keep", options.keep, "Directory of failing episodes")->capture_default_str();
  app.add_option("--replay", options.replay, "Run this episode again");
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Random AHB sequences on a core under traffic (docs/fuzzing.md)"};
  try {
    Options options;
    add_options(app, options);
    if (const auto end = read_options(app, argc, argv)) return *end;
    return run(options);
  } catch (const InputError &error) {
    fmt::print(stderr, "{}\n", error.what());
  } catch (const std::exception &error) {
    fmt::print(stderr, "fuzz_registers: {}\n", error.what());
  }
  return 2;
}
