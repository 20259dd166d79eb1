// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncWay: the ways to run a case (TM-121). Each takes a case and a seed and gives samples; what is
// made of them is the same for all.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim {

/// One way: its name for --how, and what it does.
struct SyncWay {
  const char *name;
  const char *what;  ///< one line for people
  /// A seed of a case: CanTSyn, stamps in hardware, the driver's servo.
  SyncRun (*run)(const SyncCase &setting, std::uint64_t seed);
  /// A seed of the published experiment: followers +spread and -spread in turn, offset alone.
  SyncRun (*run_p4)(const SyncCase &setting, std::uint64_t seed);
  /// The published experiment, too, has the bus of the case and clocks that wander.
  bool p4_has_bus;
  /// What of a case this way does not know, for people; nullptr: nothing.
  const char *(*missing)(const SyncCase &setting);
  /// The case as a sweep runs it, which has to end some time.
  SyncCase (*in_sweep)(const SyncCase &setting);
};

/// All that are built; the first is the usual one.
[[nodiscard]] std::span<const SyncWay> sync_ways();

/// The way of that name. Throws std::invalid_argument that lists the names.
[[nodiscard]] const SyncWay &sync_way(const std::string &name);

/// std::invalid_argument, if the way does not know all of the case.
void check_way(const SyncWay &way, const SyncCase &setting);

/// Runs all seeds of a case; `each`, if given, sees every run. Throws as check_way().
template <typename See>
SyncFigures run_case(const SyncWay &way, const SyncCase &setting, See each) {
  check_way(way, setting);
  SyncFigures figures{setting.master_cut};
  for (std::uint64_t n = 0; n < setting.seeds; ++n) {
    SyncRun run = way.run(setting, setting.first_seed + n);
    figures.add(run);
    each(std::move(run));
  }
  return figures;
}
[[nodiscard]] SyncFigures run_case(const SyncWay &way, const SyncCase &setting);

}  // namespace vericansim
