// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The axes of the sweep (TM-124): cases that differ from the base in one thing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "timesync/sync_goal.hpp"

namespace vericansim {

/// Rows that belong together.
struct SyncTable {
  std::string title;
  std::vector<SyncRow> rows;
};

/// The tables of section 12 at 16 and 50 MHz, then one for each axis. All rows have the number of
/// followers, intervals and seeds of `base`, but for the axis of followers.
[[nodiscard]] std::vector<SyncTable> sweep(const SyncCase &base);

/// Whether sweep() takes this setting of its base.
[[nodiscard]] bool counts_in_sweep(std::string_view setting);

}  // namespace vericansim
