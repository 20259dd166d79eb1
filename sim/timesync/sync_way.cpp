// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncWay: see sync_way.hpp.
#include "timesync/sync_way.hpp"

#include <stdexcept>

#include "timesync/sync_loop.hpp"

namespace vericansim {
namespace {

constexpr SyncWay kWays[] = {
    {"model", "no RTL: oscillators, clock registers, stamps and frames in closed form",
     run_by_model},
};

}  // namespace

std::span<const SyncWay> sync_ways() { return kWays; }

const SyncWay &sync_way(const std::string &name) {
  std::string names;
  for (const SyncWay &way : kWays) {
    if (name == way.name) return way;
    names += (names.empty() ? "" : ", ") + std::string{way.name};
  }
  throw std::invalid_argument("--how: '" + name + "' is not allowed; allowed: " + names);
}

SyncFigures run_case(const SyncWay &way, const SyncCase &setting) {
  return run_case(way, setting, [](const SyncRun &) {});
}

}  // namespace vericansim
