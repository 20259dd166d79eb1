// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The experiment of the published system (P4, TM-123), and the same clocks with stamps in hardware.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"
#include "timesync/sync_way.hpp"

namespace vericansim {

/// A statement of the paper, or a goal, beside what was seen.
struct P4Check {
  std::string what, expected, seen;
  bool ok = false;
};

struct P4Result {
  SyncCase setting;
  SyncFigures published;  ///< offset alone, clocks read in the handler
  SyncFigures servo;      ///< CanTSyn, stamps in hardware, the driver's servo
  std::vector<P4Check> checks;
};

/// A fast and a slow follower that drift 152 us/s from their master, R = 1 s.
[[nodiscard]] SyncCase p4_case();

/// Runs both by `way`, with the intervals and seeds of `setting`. Throws as check_way().
[[nodiscard]] P4Result run_p4(const SyncWay &way, const SyncCase &setting);

/// Why this setting would change nothing of what was published, and so compare two different
/// things; nullptr if it counts in all of the experiment to which it can apply.
[[nodiscard]] const char *missing_in_p4(const SyncWay &way, std::string_view setting);

}  // namespace vericansim
