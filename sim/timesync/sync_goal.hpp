// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncGoal: what a case has to reach (docs/time-spec.md, section 12).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim {

/// Limits, ns.
struct SyncGoal {
  std::optional<double> sd;
  double max = 0;

  /// Followers were locked, and within the limits.
  [[nodiscard]] bool reached_by(const SyncFigures &figures) const;
};

/// A row of the table of section 12.
struct SyncRow {
  std::string name;
  SyncCase setting;
  std::optional<SyncGoal> goal;
};

/// The table, for both of its frequencies, one behind the other.
[[nodiscard]] std::vector<SyncRow> goal_table();

/// The bound that holds without wander and without displaced edges, ns: B T + 2. Automatic has that
/// of N = 1, which it may choose.
[[nodiscard]] std::optional<double> steady_bound(const SyncCase &setting);

/// That of the table if the case is in it (whatever followers, intervals and seeds there are), else
/// the bound if it holds; nothing if nothing is promised.
[[nodiscard]] std::optional<SyncGoal> goal_of(const SyncCase &setting);

}  // namespace vericansim
