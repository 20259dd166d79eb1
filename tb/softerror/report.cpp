// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the flips have shown: see report.hpp.
#include "softerror/report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/campaign_settings.hpp"

namespace vericansim {
namespace {

using nlohmann::json;

const std::vector<std::string> &blocks() {
  static const std::vector<std::string> list = {"bit",       "frame", "mailbox", "RAM output",
                                                "registers", "AHB",   "time"};
  return list;
}

const char *const kRams[] = {"C/S", "MSG", "MASK"};

std::string ram_of(std::uint32_t bit) {
  const std::uint32_t word = bit / 32;
  return kRams[word < 128 ? 0 : word < 384 ? 1 : 2];
}

std::string name_of(const Flip &flip) {
  if (flip.kind == Flip::Kind::kRam)
    return ram_of(flip.index) + " RAM bit " + std::to_string(flip.index);
  return FlopNode::flops()[flip.index].name();
}

bool is_ram(const Record &record) { return record.outcome.flip.kind == Flip::Kind::kRam; }

std::string column_of(const Record &record) {
  const Flip &flip = record.outcome.flip;
  return is_ram(record) ? ram_of(flip.index) : block_of(FlopNode::flops()[flip.index].variable);
}

/// Rows: classes that occur and those that must not, worst last; columns: blocks.
json table(const std::vector<Record> &records, bool ram, const std::vector<std::string> &columns) {
  std::array<std::map<std::string, unsigned>, kVerdicts> counts;
  for (const Record &record : records) {
    if (is_ram(record) == ram) ++counts[static_cast<unsigned>(record.verdict)][column_of(record)];
  }
  json rows = json::array();
  for (unsigned v = 0; v < kVerdicts; ++v) {
    if (counts[v].empty() && v < static_cast<unsigned>(Verdict::kHang)) continue;
    json row = {to_string(static_cast<Verdict>(v))};
    unsigned sum = 0;
    for (const std::string &column : columns) {
      row.push_back(counts[v][column]);
      sum += counts[v][column];
    }
    row.push_back(sum);
    rows.push_back(row);
  }
  return rows;
}

unsigned count(const std::vector<Record> &records, bool ram, Verdict verdict) {
  return static_cast<unsigned>(std::count_if(records.begin(), records.end(), [&](const Record &r) {
    return is_ram(r) == ram && r.verdict == verdict;
  }));
}

template <typename Value>
Value worst(const std::vector<Record> &records, Value Outcome::*member, Cure most) {
  Value value = 0;
  for (const Record &record : records) {
    if (!is_ram(record) && record.outcome.cure <= most)
      value = std::max(value, record.outcome.*member);
  }
  return value;
}

/// What is told of a variable in the tables of variables.
struct Entry {
  unsigned flips = 0;
  unsigned hits = 0;
  Verdict worst = Verdict::kGone;
  std::set<unsigned> bits;  ///< that had the worst class
  std::string example;
};

std::string ranges(const std::set<unsigned> &bits) {
  std::string text;
  for (auto first = bits.begin(); first != bits.end();) {
    auto last = first;
    while (std::next(last) != bits.end() && *std::next(last) == *last + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(*first);
    if (last != first) text += "-" + std::to_string(*last);
    first = std::next(last);
  }
  return text;
}

/// Variables whose flips came out as one of these classes.
json variables(const std::vector<Record> &records, const std::set<Verdict> &verdicts) {
  std::map<std::string, Entry> found;
  for (const Record &record : records) {
    if (is_ram(record)) continue;
    const Flop &flop = FlopNode::flops()[record.outcome.flip.index];
    Entry &entry = found[flop.variable];
    ++entry.flips;
    if (verdicts.count(record.verdict) == 0) continue;
    if (entry.hits++ == 0 || record.verdict > entry.worst) {
      entry.worst = record.verdict;
      entry.bits.clear();
      entry.example = "--flop " + flop.name() + " --seed " + std::to_string(record.outcome.seed);
    }
    if (record.verdict == entry.worst) entry.bits.insert(flop.bit);
  }
  json rows = json::array();
  for (const auto &[name, entry] : found) {
    if (entry.hits != 0)
      rows.push_back({name, entry.hits, entry.flips, to_string(entry.worst), ranges(entry.bits),
                      entry.example});
  }
  return rows;
}

json figure(const std::string &name, double value, const json &bar, const json &ok) {
  return {{"name", name}, {"value", value}, {"bar", bar}, {"ok", ok}};
}

json bad_figure(const std::string &name, unsigned value) {
  return figure(name, value, "0", value == 0);
}

json figures(const std::vector<Record> &records) {
  const auto ram = static_cast<unsigned>(std::count_if(records.begin(), records.end(), is_ram));
  std::set<unsigned> flops;
  for (const Record &record : records) {
    if (!is_ram(record)) flops.insert(record.outcome.flip.index);
  }
  unsigned accesses = 0, stuck = 0;
  for (const Record &record : records) {
    accesses += record.outcome.ahb_hangs ? 1 : 0;
    stuck += !is_ram(record) && record.verdict >= Verdict::kStuckRenew &&
                     record.verdict <= Verdict::kBlocked
                 ? 1
                 : 0;
  }
  const auto all = static_cast<double>(FlopNode::flops().size());
  return {figure("flip-flops of the core", all, nullptr, nullptr),
          figure("flip-flops flipped", static_cast<double>(flops.size()), nullptr, nullptr),
          figure("flips", static_cast<double>(records.size() - ram), nullptr, nullptr),
          bad_figure("hangs", count(records, false, Verdict::kHang)),
          bad_figure("babbling", count(records, false, Verdict::kBabble)),
          bad_figure("CPU accesses that never ended", accesses),
          figure("stopped until software acted", stuck, nullptr, nullptr),
          figure("longest dominant run of the node, own bits",
                 worst(records, &Outcome::longest_run, Cure::kNever) / 10.0, nullptr, nullptr),
          figure("worst recovery without software, bits",
                 worst(records, &Outcome::recovery, Cure::kNone), nullptr, nullptr),
          figure("flips of RAM bits", ram, nullptr, nullptr),
          bad_figure("hangs and babbling by RAM bits", count(records, true, Verdict::kHang) +
                                                           count(records, true, Verdict::kBabble))};
}

}  // namespace

std::string block_of(const std::string &variable) {
  const auto has = [&variable](const char *part) {
    return variable.find(part) != std::string::npos;
  };
  if (has("gen_time.") || has(".u_stamp.")) return "time";
  if (has("u_core.u_bsp.")) return "frame";
  if (has("u_core.")) return "bit";
  if (has(".rdata_o")) return "RAM output";
  if (has("u_mailbox.")) return "mailbox";
  if (has("u_regs.") || has("u_wake.")) return "registers";
  return "AHB";
}

void print_record(const Record &record) {
  const Outcome &o = record.outcome;
  static constexpr const char *kCures[] = {"none needed", "buffers renewed", "freeze and set-up",
                                           "soft reset",  "hard reset",      "none found"};
  std::printf("%s  seed %llu  clock %llu: %s\n", name_of(o.flip).c_str(),
              static_cast<unsigned long long>(o.seed), static_cast<unsigned long long>(o.time),
              to_string(record.verdict));
  std::printf("  bus %s, host %s, configuration %s, cure: %s\n", o.bus_differs ? "differs" : "same",
              o.host_differs ? "differs" : "same", o.config_changed ? "changed" : "same",
              kCures[static_cast<unsigned>(o.cure)]);
  std::printf(
      "  errors %u, bus-off %u, wrong sent %u, wrong received %u, lost sent %u, lost "
      "received %u, told %u, twice %u, between the others %u\n",
      o.errors, o.bus_offs, o.wrong_sent, o.wrong_received, o.lost_sent, o.lost_received, o.told,
      o.twice, o.others);
  std::printf("  longest dominant run %.1f own bits%s, longest gap %u bits, recovery %u bits%s\n",
              o.longest_run / 10.0, o.run_too_long ? " (TOO LONG)" : "", o.longest_gap, o.recovery,
              o.ahb_hangs ? ", AHB HANGS" : "");
}

bool print_summary(const std::vector<Record> &records) {
  for (const Record &record : records) {
    if (record.verdict >= Verdict::kHang) print_record(record);
  }
  for (const json &f : figures(records))
    std::printf("%s: %g\n", f["name"].get<std::string>().c_str(), f["value"].get<double>());
  std::printf("\n%-40s", "");
  for (const std::string &block : blocks()) std::printf("%11s", block.c_str());
  std::printf("%11s\n", "all");
  for (const json &row : table(records, false, blocks())) {
    std::printf("%-40s", row[0].get<std::string>().c_str());
    for (std::size_t i = 1; i < row.size(); ++i) std::printf("%11u", row[i].get<unsigned>());
    std::printf("\n");
  }
  return std::none_of(records.begin(), records.end(),
                      [](const Record &r) { return r.verdict >= Verdict::kHang; });
}

void write_json(const std::vector<Record> &records, const std::string &path) {
  std::vector<std::string> columns = {"class"};
  columns.insert(columns.end(), blocks().begin(), blocks().end());
  columns.emplace_back("all");
  const json tables = {
      {{"title", "Flips of flip-flops: what came of them, by block"},
       {"columns", columns},
       {"rows", table(records, false, blocks())}},
      {{"title", "Flips of RAM bits"},
       {"columns", {"class", "C/S", "MSG", "MASK", "all"}},
       {"rows", table(records, true, {"C/S", "MSG", "MASK"})}},
      {{"title", "Registers that stay changed until software rewrites them"},
       {"columns", {"variable", "flips", "of", "worst class", "its bits", "repeat with"}},
       {"rows", variables(records, {Verdict::kConfig, Verdict::kConfigBad})}},
      {{"title", "Variables whose flip stopped something until software acted"},
       {"columns", {"variable", "flips", "of", "worst class", "its bits", "repeat with"}},
       {"rows",
        variables(records, {Verdict::kStuckRenew, Verdict::kStuckFreeze, Verdict::kStuckReset,
                            Verdict::kBlocked, Verdict::kHang, Verdict::kBabble})}}};
  const json result{{"figures", figures(records)},
                    {"tables", tables},
                    {"notes",
                     {"A flip is repeated by build/release/tb/softerror/softerror with the options "
                      "in the column 'repeat with'; classes: docs/soft-errors.md."}}};
  write_result(path, result.dump(1) + "\n");
}

}  // namespace vericansim
