// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CampaignJournal: see campaign_journal.hpp.
#include "random/campaign_journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

/// Every count of a run with its name, for reading and for writing.
template <typename Run, typename Visit>
void each_count(Run &run, const Visit &visit) {
  visit("frames", run.frames);
  visit("error frames", run.error_frames);
  visit("overload frames", run.overload_frames);
  visit("node cycles", run.node_cycles);
  visit("node bits", run.counts.node_bits);
  visit("accesses", run.counts.accesses);
  visit("errors", run.counts.errors);
  visit("bus-offs", run.counts.bus_offs);
  visit("stops", run.counts.stops);
  visit("software", run.counts.software);
  visit("exchanges", run.counts.wire.exchanges);
  visit("deliveries", run.counts.wire.deliveries);
  visit("strict", run.counts.wire.strict);
  visit("duplicates", run.counts.wire.duplicates);
  visit("decoded", run.counts.wire.decoded);
}

}  // namespace

CampaignJournal::CampaignJournal(const std::string &path, const std::string &key, bool resume)
    : CampaignJournal{path, key, resume ? std::vector{path} : std::vector<std::string>{}} {}

CampaignJournal::CampaignJournal(const std::string &path, const std::string &key,
                                 const std::vector<std::string> &sources) {
  for (const std::string &source : sources) take_over(source, key);
  file_.open(path, std::ios::trunc);
  file_ << Json{{"key", key}}.dump() << '\n';
  for (const auto &[seed, run] : before_) write(seed, run, seconds_before_);
  if (!file_.flush()) throw std::runtime_error("cannot write " + path);
}

void CampaignJournal::take_over(const std::string &path, const std::string &key) {
  std::ifstream file{path};
  std::string line;
  if (!std::getline(file, line)) return;
  const Json head = Json::parse(line, nullptr, false);
  if (!head.is_object() || head.value("key", "") != key) return;
  while (std::getline(file, line)) {
    const Json entry = Json::parse(line, nullptr, false);
    if (!entry.is_object()) return;
    JudgedRun run;
    run.cut_short = entry.at("cut short");
    each_count(run, [&](const char *name, std::uint64_t &count) { count = entry.at(name); });
    before_[entry.at("seed")] = run;
    seconds_before_ = std::max(seconds_before_, entry.at("seconds").get<double>());
  }
}

void CampaignJournal::add(std::uint64_t seed, const JudgedRun &run, double seconds) {
  write(seed, run, seconds);
  if (!file_.flush()) throw std::runtime_error("cannot write the journal");
}

void CampaignJournal::write(std::uint64_t seed, const JudgedRun &run, double seconds) {
  Json entry{{"seed", seed}, {"seconds", seconds}, {"cut short", run.cut_short}};
  each_count(run, [&](const char *name, const std::uint64_t &count) { entry[name] = count; });
  file_ << entry.dump() << '\n';
}

std::string program_key() {
  std::ifstream file{"/proc/self/exe", std::ios::binary};
  if (!file) throw std::runtime_error("cannot read /proc/self/exe");
  std::uint64_t hash = 0xCBF29CE484222325;  // FNV-1a
  for (std::istreambuf_iterator<char> at{file}, end; at != end; ++at)
    hash = (hash ^ static_cast<unsigned char>(*at)) * 0x100000001B3;
  return fmt::format("{:016x}", hash);
}

}  // namespace vericansim
