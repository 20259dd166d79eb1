// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// bittime_campaign: every setting that `verican bittime` prints for a set of clocks and bit rates,
// held against the core (docs/integration.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/campaign_settings.hpp"
#include "timing/far_winner.hpp"
#include "timing/row_proof.hpp"

namespace {

using namespace vericansim;
using Json = nlohmann::ordered_json;

constexpr unsigned kPrinted = 10;  // rows of a table, without --rows
/// A clock, and the frames of each of its rows in a whole campaign. A bit of a fast clock costs
/// more clocks, and its rows share PROP, PS1, PS2 and SJW with those of a slow one.
struct ClockRate {
  std::uint32_t megahertz;
  unsigned frames;
};
constexpr ClockRate kClocks[] = {{8, 10'000}, {10, 10'000}, {12, 10'000}, {16, 10'000}, {20, 1'000},
                                 {24, 1'000}, {40, 1'000},  {48, 1'000},  {50, 1'000}};
constexpr std::uint32_t kRates[] = {1'000'000, 800'000, 500'000, 250'000, 125'000};

struct Row {
  unsigned frames;
  BitTimingRequest request;
  BitTimingResult rated;
  RowProof proof = {};
};

std::vector<Row> printed_rows() {
  std::vector<Row> rows;
  for (const ClockRate &clock : kClocks)
    for (const std::uint32_t rate : kRates) {
      const BitTimingRequest request{.clock_hz = clock.megahertz * 1'000'000, .bitrate = rate};
      unsigned printed = 0;
      for (const BitTimingResult &rated : find_bit_timings(request))
        if (rated.usable() && printed++ < kPrinted) rows.push_back({clock.frames, request, rated});
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

unsigned due(unsigned frames, const CampaignSettings &options) {
  return static_cast<unsigned>(std::ceil(frames * options.scale));
}

void prove(std::vector<Row> &rows, const CampaignSettings &options) {
  run_jobs(rows.size(), options.jobs, [&](std::size_t n) {
    rows[n].proof =
        prove(rows[n], due(rows[n].frames, options), options.seed * 1000 * rows.size() + 1000 * n);
  });
}

std::string name_of(const Row &row) {
  const BitTiming &t = row.rated.timing;
  return fmt::format("{} MHz, {} bit/s, BRP {} PROP {} PS1 {} PS2 {} SJW {}, {:.4f} %, {:.1f} m",
                     row.request.clock_hz / 1'000'000, row.request.bitrate, t.prescaler, t.prop,
                     t.ps1, t.ps2, t.sjw, row.rated.oscillator_tolerance * 100, row.rated.cable_m);
}

/// What the rows of one clock came to.
struct Sum {
  std::uint64_t rows = 0, frames = 0, least = ~0ULL, buses = 0, bad = 0;

  void add(const RowProof &proof) {
    ++rows;
    frames += proof.frames;
    least = std::min(least, proof.frames);
    buses += proof.buses;
    bad += proof.dirty != 0;
  }
};

Sum sum_of(const std::vector<Row> &rows, const ClockRate &clock) {
  Sum sum;
  for (const Row &row : rows)
    if (row.request.clock_hz == clock.megahertz * 1'000'000) sum.add(row.proof);
  return sum;
}

Json result_of(const std::vector<Row> &rows, const CampaignSettings &options) {
  Sum all;
  Json notes = Json::array(), clocks = Json::array();
  std::size_t short_of = 0;
  for (const Row &row : rows) {
    all.add(row.proof);
    short_of += row.proof.frames < due(row.frames, options);
    if (row.proof.dirty != 0)
      notes.push_back(fmt::format("{}: errors on {} buses", name_of(row), row.proof.dirty));
  }
  for (const ClockRate &clock : kClocks) {
    const Sum own = sum_of(rows, clock);
    clocks.push_back(
        {fmt::format("{} MHz", clock.megahertz), own.rows, own.frames, own.least, own.bad});
  }
  Json figures = {
      campaign_figure("settings", rows.size()), campaign_figure("buses of three nodes", all.buses),
      campaign_figure("frames", all.frames),
      campaign_figure("settings with fewer frames than due", short_of, "0", short_of == 0),
      campaign_figure("settings with an error", all.bad, "0", all.bad == 0)};
  return {{"figures", figures},
          {"tables",
           {{{"title", "Settings that bittime prints, by clock"},
             {"columns", {"clock", "settings", "frames", "least of a setting", "with an error"}},
             {"rows", clocks}}}},
          {"notes", notes}};
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{"Every setting that verican bittime prints, on buses of three nodes"};
  try {
    CampaignSettings options;
    options.add_to(app, "the frames that each setting is due");
    if (const auto end = read_options(app, argc, argv)) return *end;
    check_writable(options.json);
    std::vector<Row> rows = printed_rows();
    prove(rows, options);
    const Json result = result_of(rows, options);
    print_result(result);
    write_result(options.json, result.dump(1) + "\n");
    return bars_hold(result) ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "bittime_campaign: {}\n", error.what());
    return 2;
  }
}
