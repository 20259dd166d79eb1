// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CampaignResult: see campaign_result.hpp.
#include "random/campaign_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char *kNoise[] = {"0 none", "1 light", "2 noisy", "3 storm"};

std::string clocks_name(const Scenario &scenario) {
  const NodeSpec &first = scenario.nodes.front();
  bool common = true, wander = false, delay = false;
  for (const NodeSpec &node : scenario.nodes) {
    common = common && node.clock.error_ppm == first.clock.error_ppm &&
             node.clock.frequency_hz == first.clock.frequency_hz &&
             node.clock.phase == first.clock.phase;
    wander = wander || node.clock.wander != Wander::kNone;
    delay = delay || node.link.cable + node.link.transmitter + node.link.receiver != 0;
  }
  if (common) return "one clock";
  return std::string{wander ? "own clocks, wandering" : "own clocks"} + (delay ? ", delays" : "");
}

Json figure(const std::string &name, double value, const std::string &bar = {},
            const Json &ok = nullptr) {
  return {{"name", name},
          {"value", value},
          {"bar", bar.empty() ? Json(nullptr) : Json(bar)},
          {"ok", ok}};
}

}  // namespace

void CampaignResult::count(Histogram &histogram, const std::string &bin, const JudgedRun &run) {
  ++histogram[bin].runs;
  histogram[bin].frames += run.frames;
}

void CampaignResult::add(std::uint64_t seed, const Scenario &scenario, const JudgedRun &run) {
  ++runs;
  cut_short += run.cut_short ? 1 : 0;
  frames += run.frames;
  error_frames += run.error_frames;
  overload_frames += run.overload_frames;
  node_cycles += run.node_cycles;
  const JudgeCounts &c = run.counts;
  counts.node_bits += c.node_bits;
  counts.accesses += c.accesses;
  counts.errors += c.errors;
  counts.bus_offs += c.bus_offs;
  counts.stops += c.stops;
  counts.software += c.software;
  counts.wire.exchanges += c.wire.exchanges;
  counts.wire.deliveries += c.wire.deliveries;
  counts.wire.strict += c.wire.strict;
  counts.wire.duplicates += c.wire.duplicates;
  counts.wire.decoded += c.wire.decoded;
  count(nodes_, fmt::format("{:2}", scenario.nodes.size()), run);
  count(rates_, fmt::format("{:4.0f} kbit/s", scenario.bitrates.front() / 1e3), run);
  count(noise_, kNoise[static_cast<unsigned>(noise_level(seed))], run);
  count(clocks_, clocks_name(scenario), run);
  if (!run.ok()) failures.push_back({seed, run.findings.front()});
}

std::string CampaignResult::text() const {
  std::string text = fmt::format(
      "{} seeds, {} frames on the buses in {:.0f} s: {:.0f} frames/s, {:.1f} million "
      "node-cycles/s\n",
      runs, frames, seconds, static_cast<double>(frames) / seconds,
      static_cast<double>(node_cycles) / 1e6 / seconds);
  text += fmt::format(
      "rules: {} node-bits compared; buffers: {} accesses; wire: {} exchanges ({} strict), {} "
      "deliveries, {} seen by the decoder; software: {} frames\n",
      counts.node_bits, counts.accesses, counts.wire.exchanges, counts.wire.strict,
      counts.wire.deliveries, counts.wire.decoded, counts.software);
  text += fmt::format(
      "error frames {}, overload frames {}, errors at nodes {}, bus-offs {}, stops {}, "
      "duplicates by VA-03 {}\n",
      error_frames, overload_frames, counts.errors, counts.bus_offs, counts.stops,
      counts.wire.duplicates);
  for (const Failure &failure : failures)
    text += fmt::format("FAILED seed {}: {}\n", failure.seed, failure.finding);
  return text + fmt::format("{} of {} seeds failed, {} ended before their time\n", failures.size(),
                            runs, cut_short);
}

std::string CampaignResult::json(std::uint64_t first_seed, std::uint64_t least) const {
  const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
  Json figures = Json::array();
  figures.push_back(figure("frames on random buses", number(frames),
                           least == 0 ? "" : fmt::format("at least {}", least),
                           least == 0 ? Json(nullptr) : Json(frames >= least)));
  figures.push_back(
      figure("seeds with a difference", number(failures.size()), "0", failures.empty()));
  figures.push_back(figure("seeds", number(runs)));
  figures.push_back(
      figure("... that ended before their time: too much left open", number(cut_short)));
  figures.push_back(figure("frames a second", std::round(number(frames) / seconds)));
  figures.push_back(figure("node-bits compared with the rules", number(counts.node_bits)));
  figures.push_back(figure("register accesses judged", number(counts.accesses)));
  figures.push_back(figure("exchanges compared between nodes", number(counts.wire.exchanges)));
  figures.push_back(
      figure("... in which every node was held to the frame", number(counts.wire.strict)));
  figures.push_back(figure("... seen alike by the decoder", number(counts.wire.decoded)));
  figures.push_back(figure("deliveries compared", number(counts.wire.deliveries)));
  figures.push_back(figure("frames followed into software", number(counts.software)));
  figures.push_back(figure("error frames", number(error_frames)));
  figures.push_back(figure("overload frames", number(overload_frames)));
  figures.push_back(figure("error events at nodes", number(counts.errors)));
  figures.push_back(figure("bus-offs", number(counts.bus_offs)));
  figures.push_back(figure("nodes stopped while others talk", number(counts.stops)));
  figures.push_back(figure("deliveries that VA-03 doubles", number(counts.wire.duplicates)));
  Json tables = Json::array();
  const auto table = [&](const char *title, const Histogram &histogram) {
    Json rows = Json::array();
    for (const auto &[bin, entry] : histogram) rows.push_back({bin, entry.runs, entry.frames});
    tables.push_back({{"title", title}, {"columns", {"", "buses", "frames"}}, {"rows", rows}});
  };
  table("Nodes on the bus", nodes_);
  table("Bit rate", rates_);
  table("Disturbances", noise_);
  table("Clocks", clocks_);
  Json notes = Json::array();
  notes.push_back(fmt::format("first seed {}", first_seed));
  for (const Failure &failure : failures)
    notes.push_back(fmt::format("seed {}: {}", failure.seed, failure.finding));
  return Json{{"figures", figures}, {"tables", tables}, {"notes", notes}}.dump(1) + "\n";
}

}  // namespace vericansim
