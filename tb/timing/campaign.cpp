// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// bittime_campaign: every setting that `verican bittime` prints for a set of clocks and bit rates,
// held against the core (docs/integration.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "timing/far_winner.hpp"
#include "timing/row_proof.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kFrames = 10'000;  // of a row in a whole campaign
constexpr unsigned kPrinted = 10;     // rows of a table, without --rows
constexpr std::uint32_t kMegahertz[] = {8, 10, 12, 16, 20, 24, 40, 48, 50};
constexpr std::uint32_t kRates[] = {1'000'000, 800'000, 500'000, 250'000, 125'000};

struct Options {
  std::uint64_t seed = 1;
  double scale = 1;
  unsigned jobs = 2;
  std::string json;
};

struct Row {
  BitTimingRequest request;
  BitTimingResult rated;
  RowProof proof = {};
};

/// What the environment of tools/campaign.py says.
Options defaults() {
  const auto value = [](const char *name, const char *otherwise) {
    const char *text = std::getenv(name);
    return std::string{text != nullptr ? text : otherwise};
  };
  return {std::stoull(value("CAMPAIGN_SEED", "1")), std::stod(value("CAMPAIGN_SCALE", "1")),
          static_cast<unsigned>(std::stoul(value("CAMPAIGN_JOBS", "2"))),
          value("CAMPAIGN_OUT", "")};
}

std::vector<Row> printed_rows() {
  std::vector<Row> rows;
  for (const std::uint32_t megahertz : kMegahertz)
    for (const std::uint32_t rate : kRates) {
      const BitTimingRequest request{.clock_hz = megahertz * 1'000'000, .bitrate = rate};
      unsigned printed = 0;
      for (const BitTimingResult &rated : find_bit_timings(request))
        if (rated.usable() && printed++ < kPrinted) rows.push_back({request, rated});
    }
  return rows;
}

RowProof sum(const RowProof &a, const RowProof &b) {
  return {a.buses + b.buses, a.dirty + b.dirty, a.frames + b.frames, a.node_cycles + b.node_cycles};
}

/// The worst clocks bear `frames` frames; every tenth as many come after the far end has won, and
/// with good clocks and the longest cable there are a fifth of all that.
RowProof prove(const Row &row, unsigned frames, std::uint64_t seed) {
  constexpr unsigned kContestsOfBus = 10, kLess = 5;
  RowProof all;
  for (const RowPromise &promise : promises_of(row.rated, row.request)) {
    const unsigned share = all.buses == 0 ? frames : (frames + kLess - 1) / kLess;
    all = sum(all, prove_row(promise, share, seed));
    all = sum(all, prove_far_winner(promise, share / 10 / kContestsOfBus + 2, seed));
  }
  return all;
}

void prove(std::vector<Row> &rows, const Options &options) {
  const auto frames = static_cast<unsigned>(std::ceil(kFrames * options.scale));
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads;
  for (unsigned job = 0; job < options.jobs; ++job)
    threads.emplace_back([&] {
      for (std::size_t n = next++; n < rows.size(); n = next++)
        rows[n].proof = prove(rows[n], frames, options.seed * 1000 * rows.size() + 1000 * n);
    });
  for (std::thread &thread : threads) thread.join();
}

std::string name_of(const Row &row) {
  const BitTiming &t = row.rated.timing;
  return fmt::format("{} MHz, {} bit/s, BRP {} PROP {} PS1 {} PS2 {} SJW {}, {:.4f} %, {:.1f} m",
                     row.request.clock_hz / 1'000'000, row.request.bitrate, t.prescaler, t.prop,
                     t.ps1, t.ps2, t.sjw, row.rated.oscillator_tolerance * 100, row.rated.cable_m);
}

Json figure(const char *name, std::uint64_t value, const Json &bar = nullptr,
            const Json &ok = nullptr) {
  return {{"name", name}, {"value", value}, {"bar", bar}, {"ok", ok}};
}

Json result_of(const std::vector<Row> &rows, const Options &options) {
  std::uint64_t frames = 0, least = ~0ULL, buses = 0, bad = 0;
  Json notes = Json::array(), clocks = Json::array();
  for (const std::uint32_t megahertz : kMegahertz) {
    std::uint64_t own = 0, own_frames = 0, own_bad = 0;
    for (const Row &row : rows) {
      if (row.request.clock_hz != megahertz * 1'000'000) continue;
      ++own;
      own_frames += row.proof.frames;
      own_bad += row.proof.dirty != 0;
      least = std::min(least, row.proof.frames);
      buses += row.proof.buses;
      if (row.proof.dirty != 0)
        notes.push_back(fmt::format("{}: errors on {} buses", name_of(row), row.proof.dirty));
    }
    clocks.push_back({fmt::format("{} MHz", megahertz), own, own_frames, own_bad});
    frames += own_frames;
    bad += own_bad;
  }
  const bool whole = options.scale >= 1;
  Json figures = {figure("settings", rows.size()), figure("buses of three nodes", buses),
                  figure("frames", frames),
                  figure("frames of the setting with fewest", least, fmt::format(">= {}", kFrames),
                         whole ? Json(least >= kFrames) : Json(nullptr)),
                  figure("settings with an error", bad, "0", bad == 0)};
  return {{"figures", figures},
          {"tables",
           {{{"title", "Settings that bittime prints, by clock"},
             {"columns", {"clock", "settings", "frames", "with an error"}},
             {"rows", clocks}}}},
          {"notes", notes}};
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Every setting that verican bittime prints, on buses of three nodes"};
  try {
    Options options = defaults();
    app.add_option("--seed", options.seed, "Seed")->capture_default_str();
    app.add_option("--scale", options.scale, "Part of 10,000 frames a setting")
        ->check(CLI::Range(0.0001, 1.0))
        ->capture_default_str();
    app.add_option("--jobs", options.jobs, "Threads")->check(CLI::Range(1U, 64U));
    app.add_option("--json", options.json, "File for the result");
    CLI11_PARSE(app, argc, argv);
    std::vector<Row> rows = printed_rows();
    prove(rows, options);
    const Json result = result_of(rows, options);
    for (const Json &figure : result["figures"])
      fmt::print("{}: {}\n", figure["name"].get<std::string>(), figure["value"].dump());
    for (const Json &note : result["notes"]) fmt::print("{}\n", note.get<std::string>());
    if (!options.json.empty()) std::ofstream{options.json} << result.dump(1) << '\n';
    return result["notes"].empty() ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "bittime_campaign: {}\n", error.what());
    return 2;
  }
}
