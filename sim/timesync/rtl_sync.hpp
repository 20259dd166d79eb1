// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A case on RTL (TM-121, rtl and skip): cores with the time unit, the C driver and its CanTSyn on
// each of them.
#pragma once

#include <cstdint>

#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim {

/// What of a case cannot be run on RTL; nullptr: nothing.
[[nodiscard]] const char *missing_on_rtl(const SyncCase &setting);

/// A bus with load has hardly an idle gap: R = 0.1 s for 20 s then, one seed (TM-126). Other cases
/// as they are.
[[nodiscard]] SyncCase loaded_for_20_s(const SyncCase &setting);

/// Runs a seed of a case, every clock of every node; missing_on_rtl() is left out.
[[nodiscard]] SyncRun run_by_rtl(const SyncCase &setting, std::uint64_t seed);

/// The same with idle gaps skipped.
[[nodiscard]] SyncRun run_by_skip(const SyncCase &setting, std::uint64_t seed);

}  // namespace vericansim
