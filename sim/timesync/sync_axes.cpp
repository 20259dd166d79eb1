// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The axes of the sweep: see sync_axes.hpp.
#include "timesync/sync_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace vericansim {
namespace {

/// One axis: a case for each value.
template <typename Value, typename Set>
SyncTable axis(const char *title, std::initializer_list<Value> values, const char *name, Set set) {
  SyncTable table{title, {}};
  for (const Value value : values) {
    SyncRow row{fmt::format(fmt::runtime(name), value), {}, {}};
    set(row.setting, value);
    row.goal = goal_of(row.setting);
    table.rows.push_back(std::move(row));
  }
  return table;
}

SyncTable automatic_by_wander() {
  return axis("Wander, automatic filter", {0.0, 1e-9, 1e-8, 1e-7}, "{:g} /sqrt(s)",
              [](SyncCase &c, double value) {
                c.filter = 0;
                c.clocks.wander = value;
              });
}

SyncTable filters() {
  SyncTable table = axis("Filter", {1, 2, 4, 8, 16}, "N = {}", [](SyncCase &c, int value) {
    c.filter = static_cast<std::uint8_t>(value);
  });
  SyncRow row{"automatic", {}, {}};
  row.setting.filter = 0;
  row.goal = goal_of(row.setting);
  table.rows.push_back(row);
  return table;
}

std::vector<SyncTable> axes() {
  return {
      axis("Clock", {16, 25, 40, 50}, "{} MHz",
           [](SyncCase &c, int value) { c.clocks.frequency_hz = value * 1e6; }),
      axis("Errors of the clocks", {0.5, 100.0}, "+-{} ppm",
           [](SyncCase &c, double value) { c.clocks.spread_ppm = value; }),
      automatic_by_wander(),
      axis("Followers", {1u, 2u, 4u, 8u}, "{}",
           [](SyncCase &c, unsigned value) { c.followers = value; }),
      axis("Load below SYNC's priority", {0.0, 0.5, 1.0}, "{}",
           [](SyncCase &c, double value) { c.load = value; }),
      axis("Load above SYNC's priority", {0.9}, "{}",
           [](SyncCase &c, double value) { c.load_above = value; }),
      axis("Bit errors", {1e-4}, "{}", [](SyncCase &c, double value) { c.bit_errors = value; }),
      axis("Interval R", {0.1, 0.2, 0.5, 1.0, 2.0}, "{} s",
           [](SyncCase &c, double value) { c.interval_s = value; }),
      filters(),
      axis("Edges up to 300 ns early", {0.01}, "{}",
           [](SyncCase &c, double value) { c.displaced = value; }),
      axis("Master cut half-way, filter", {0, 8}, "N = {} (0: automatic)",
           [](SyncCase &c, int value) {
             c.master_cut = true;
             c.filter = static_cast<std::uint8_t>(value);
           }),
      axis("Followers in hardware", {16, 25, 40, 50}, "{} MHz",
           [](SyncCase &c, int value) {
             c.hardware = true;
             c.clocks.frequency_hz = value * 1e6;
           }),
  };
}

}  // namespace

std::vector<SyncTable> sweep(const SyncCase &base) {
  std::vector<SyncTable> tables = {{"16 MHz", {}}, {"50 MHz", {}}};
  for (SyncRow &row : goal_table())
    tables[row.setting.clocks.frequency_hz > 16e6 ? 1 : 0].rows.push_back(std::move(row));
  for (SyncTable &table : axes()) tables.push_back(std::move(table));
  for (SyncTable &table : tables) {
    for (SyncRow &row : table.rows) {
      if (table.title != "Followers") row.setting.followers = base.followers;
      row.setting.intervals = base.intervals;
      row.setting.seeds = base.seeds;
      row.setting.first_seed = base.first_seed;
    }
  }
  return tables;
}

bool counts_in_sweep(std::string_view setting) {
  constexpr std::array<std::string_view, 4> kTaken = {"followers", "intervals", "seeds",
                                                      "first-seed"};
  return std::find(kTaken.begin(), kTaken.end(), setting) != kTaken.end();
}

}  // namespace vericansim
