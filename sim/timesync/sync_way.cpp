// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncWay: see sync_way.hpp.
#include "timesync/sync_way.hpp"

#include <stdexcept>

#include "timesync/p4_loop.hpp"
#include "timesync/rtl_p4.hpp"
#include "timesync/rtl_sync.hpp"
#include "timesync/sync_loop.hpp"

namespace vericansim {
namespace {

const char *nothing(const SyncCase &) { return nullptr; }
SyncCase as_it_is(const SyncCase &setting) { return setting; }

constexpr SyncWay kWays[] = {
    {"model", "no RTL: oscillators, clock registers, stamps and frames in closed form",
     run_by_model, run_p4_by_model, false, nothing, as_it_is},
    {"skip", "RTL and driver on each node; idle gaps of the bus in closed form", run_by_skip,
     run_p4_by_skip, true, missing_on_rtl, loaded_for_20_s},
    {"rtl", "RTL and driver on each node, every clock of it", run_by_rtl, run_p4_by_rtl, true,
     missing_on_rtl, loaded_for_20_s},
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

void check_way(const SyncWay &way, const SyncCase &setting) {
  if (const char *missing = way.missing(setting); missing != nullptr)
    throw std::invalid_argument("--how " + std::string{way.name} + " knows no " + missing +
                                "; --how model does");
}

SyncFigures run_case(const SyncWay &way, const SyncCase &setting) {
  return run_case(way, setting, [](const SyncRun &) {});
}

}  // namespace vericansim
