// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The campaign's result: see result_json.hpp.
#include "faults/campaign/result_json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kWantedRuns = 170'000;  // 19.5 item 6

Json figure(const std::string &name, double value, const Json &bar, const Json &ok,
            const std::string &text = {}) {
  Json json{{"name", name}, {"value", value}};
  if (!text.empty()) json["text"] = text;
  json["bar"] = bar;
  json["ok"] = ok;
  return json;
}

Json judged(bool whole, bool ok) { return whole ? Json(ok) : Json(nullptr); }

/// Rows of one part of the key, columns of another; each cell the number of runs, and the last
/// column the mismatches of the row.
Json cross_table(const Tally &tally, const std::string &title, const std::string &corner,
                 std::size_t row, std::size_t column) {
  const auto sums = tally.by(row, column);
  std::set<std::string> columns;
  std::map<std::string, Count> rows;
  for (const auto &[key, count] : sums) {
    columns.insert(key.second);
    rows[key.first].add(count);
  }
  Json head{corner};
  for (const std::string &name : columns) head.push_back(name);
  head.push_back("mismatches");
  Json body = Json::array();
  for (const auto &[name, total] : rows) {
    Json line{name};
    for (const std::string &c : columns) {
      const auto cell = sums.find({name, c});
      line.push_back(cell == sums.end() ? 0 : cell->second.runs);
    }
    line.push_back(total.mismatches);
    body.push_back(line);
  }
  return {{"title", title}, {"columns", head}, {"rows", body}};
}

Json section_table(const Tally &tally, const Sections &sections) {
  const auto sums = tally.by(0, 0);
  Json body = Json::array();
  for (const auto &section : sections) {
    const auto found = sums.find({section->grid().name(), section->grid().name()});
    const Count count = found == sums.end() ? Count{} : found->second;
    body.push_back({section->grid().name(), section->rules(), section->grid().size(), count.runs,
                    count.mismatches});
  }
  return {{"title", "Error injection: parts of the table"},
          {"columns", {"part", "what", "cases", "runs", "mismatches"}},
          {"rows", body}};
}

Json bin_table(const RuleBins &bins) {
  Json body = Json::array();
  for (const BinGroup &group : bins.groups()) {
    body.push_back({group.name, group.reached(), group.bins.size(), group.unreachable.size()});
  }
  return {{"title", "Functional coverage (TH-05)"},
          {"columns",
           {"cross", "bins hit", "bins that can be reached", "kinds left out, with reasons"}},
          {"rows", body}};
}

/// Bins that were missed, and hits of bins that are called unreachable; the first of each cross.
Json bin_notes(const RuleBins &bins, bool whole) {
  constexpr unsigned kShown = 20;
  Json notes = Json::array();
  for (const BinGroup &group : bins.groups()) {
    unsigned shown = 0;
    for (const auto &[key, bin] : group.bins) {
      if (!whole || bin.hits != 0 || ++shown > kShown) continue;
      notes.push_back("TH-05 bin not hit: " + group.name + ": " + bin.name);
    }
    for (const auto &[key, hits] : group.unlisted) {
      notes.push_back("TH-05 bin hit " + std::to_string(hits) + " times that is called " +
                      "unreachable: " + group.name + ": key " + std::to_string(key));
    }
  }
  return notes;
}

Json unreachable_table(const RuleBins &bins) {
  Json body = Json::array();
  for (const BinGroup &group : bins.groups()) {
    for (const std::string &text : group.unreachable) body.push_back({group.name, text});
  }
  return {{"title", "Functional coverage: what cannot be reached, and why"},
          {"columns", {"cross", "left out"}},
          {"rows", body}};
}

Json figures(const Tally &tally, const RuleBins &bins, const ResultInfo &info) {
  const Count total = tally.total();
  std::uint64_t random = 0;
  std::uint64_t clocks = 0;
  std::uint64_t sweep = 0;
  for (const auto &[key, count] : tally.counts()) {
    if (key[0].starts_with("random")) random += count.runs;
    if (key[0].starts_with("clock")) clocks += count.runs;
    if (key[0].starts_with("sync")) sweep += count.runs;
  }
  const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
  const std::uint64_t bits = total.runs - random - clocks - sweep;
  bool unlisted = false;
  for (const BinGroup &group : bins.groups()) unlisted = unlisted || !group.unlisted.empty();
  const bool all_hit = bins.reached() == bins.size() && !unlisted;
  const double percent = 100.0 * number(bins.reached()) / number(bins.size());
  return {
      figure("error injection: runs of the table", number(bits), ">= 170,000",
             judged(info.whole, bits >= kWantedRuns)),
      figure("error injection: runs with several random disturbances", number(random), ">= 200,000",
             judged(info.whole, random >= 200'000)),
      figure("error injection: runs with levels forced for some clocks", number(clocks), nullptr,
             nullptr),
      figure("error injection: points of the sweep SY-19", number(sweep), nullptr, nullptr),
      figure("error injection: mismatches", number(total.mismatches), "0", total.mismatches == 0),
      figure("TH-05 bins", std::floor(percent * 100) / 100, "100 %", judged(info.whole, all_hit),
             std::to_string(bins.reached()) + " of " + std::to_string(bins.size()))};
}

}  // namespace

std::string result_json(const Tally &tally, const RuleBins &bins, const Sections &sections,
                        const ResultInfo &info) {
  Json notes = bin_notes(bins, info.whole);
  for (const Failure &failure : tally.failures()) {
    notes.push_back("mismatch: error_campaign --seed " + std::to_string(info.seed) + " --run " +
                    failure.id);
  }
  notes.push_back("seed " + std::to_string(info.seed) + ", " +
                  std::to_string(std::lround(info.seconds)) + " s, CPU time " +
                  std::to_string(std::lround(info.cpu_seconds)) + " s");
  const Json json{
      {"figures", figures(tally, bins, info)},
      {"tables",
       {section_table(tally, sections),
        cross_table(tally, "Error injection: runs by position and role", "position", 3, 1),
        cross_table(tally, "Error injection: runs by position and start state", "position", 3, 2),
        cross_table(tally, "Error injection: runs by reaction and role", "reaction", 4, 1),
        bin_table(bins), unreachable_table(bins)}},
      {"notes", notes}};
  return json.dump(1) + "\n";
}

std::string result_csv(const Tally &tally) {
  std::string text = "part,role,state,position,reaction,runs,mismatches\n";
  for (const auto &[key, count] : tally.counts()) {
    for (const std::string &part : key) text += part + ",";
    text += std::to_string(count.runs) + "," + std::to_string(count.mismatches) + "\n";
  }
  return text;
}

}  // namespace vericansim
