// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// IEEE 1588 over CAN as it was published (docs/time-spec.md, 7.2, TM-123), on RTL: the driver's
// messages, clocks read in the interrupt handler, corrected in their offset alone.
#pragma once

#include <cstdint>

#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim {

/// One seed, every clock of every node. Odd followers are fast by the whole spread, even ones slow,
/// the master is right. Followers are locked once they know their delay.
[[nodiscard]] SyncRun run_p4_by_rtl(const SyncCase &setting, std::uint64_t seed);

/// The same with idle gaps skipped.
[[nodiscard]] SyncRun run_p4_by_skip(const SyncCase &setting, std::uint64_t seed);

}  // namespace vericansim
