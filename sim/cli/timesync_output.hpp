// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What `verican timesync` prints: tables for people, JSON.
#pragma once

#include <string>
#include <vector>

#include "cli/cli.hpp"
#include "timesync/p4_experiment.hpp"
#include "timesync/sync_axes.hpp"
#include "timesync/sync_goal.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim::cli {

/// A case that was run.
struct SyncOutcome {
  SyncRow row;
  SyncFigures figures;
  /// All followers are locked, and what is promised, if anything is, is kept.
  [[nodiscard]] bool ok() const {
    return figures.locked() && (!row.goal || row.goal->reached_by(figures));
  }
};

/// "16 MHz +-100 ppm, R = 1 s, ..."
[[nodiscard]] std::string to_text(const SyncCase &setting);
void print_sync_head();
void print_sync_row(const SyncOutcome &outcome);
/// What the numbers do not hold.
void print_sync_foot();

[[nodiscard]] Json to_json(const SyncOutcome &outcome);
/// A row of a sweep that a way cannot run, and why.
[[nodiscard]] Json to_json(const SyncRow &row, const char *missing);
/// All samples of a run, ps, and what each follower's servo did with each pair.
[[nodiscard]] Json to_json(const SyncRun &run);
[[nodiscard]] Json to_json(const P4Result &result);
void print_p4(const P4Result &result);

}  // namespace vericansim::cli
