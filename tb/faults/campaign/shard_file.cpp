// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Shards as files: see shard_file.hpp.
#include "faults/campaign/shard_file.hpp"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace vericansim {

using Json = nlohmann::json;

void write_shard(const std::string &path, const Tally &tally, const RuleBins &bins) {
  Json counts = Json::array(), failures = Json::array(), hits = Json::array();
  for (const auto &[key, count] : tally.counts())
    counts.push_back({key, count.runs, count.mismatches});
  for (const Failure &failure : tally.failures()) failures.push_back({failure.id, failure.report});
  for (std::size_t n = 0; n < bins.groups().size(); ++n) {
    const BinGroup &group = bins.groups()[n];
    for (const auto &[key, bin] : group.bins)
      if (bin.hits != 0) hits.push_back({n, key, bin.hits});
    for (const auto &[key, count] : group.unlisted) hits.push_back({n, key, count});
  }
  const std::string unfinished = path + ".new";
  std::ofstream file{unfinished};
  file << Json{{"counts", counts}, {"failures", failures}, {"hits", hits}};
  file.close();
  if (!file || std::rename(unfinished.c_str(), path.c_str()) != 0)
    throw std::runtime_error("cannot write '" + path + "'");
}

void add_shard(const std::string &path, Tally &tally, RuleBins &bins) {
  std::ifstream file{path};
  const Json data = Json::parse(file, nullptr, false);
  if (!data.is_object()) throw std::runtime_error("'" + path + "' holds no counts of a shard");
  for (const Json &entry : data.at("counts"))
    tally.add(entry.at(0).get<Tally::Key>(), {entry.at(1), entry.at(2)});
  for (const Json &entry : data.at("failures")) tally.add({entry.at(0), entry.at(1)});
  for (const Json &entry : data.at("hits")) bins.add(entry.at(0), entry.at(1), entry.at(2));
}

}  // namespace vericansim
