// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncGoal: see sync_goal.hpp.
#include "timesync/sync_goal.hpp"

#include <utility>

namespace vericansim {
namespace {

struct Limits {
  double sd, max;
};
struct Row {
  const char *name;
  void (*change)(SyncCase &setting);
  Limits at16, at50;
};

void automatic(SyncCase &c) { c.filter = 0; }
void wander(SyncCase &c, double density, double interval_s) {
  c.filter = 0;
  c.clocks.wander = density;
  c.interval_s = interval_s;
}

const Row kRows[] = {
    {"base, N = 8", [](SyncCase &) {}, {16, 60}, {5.5, 21}},
    {"N = 1 (two SYNCs)", [](SyncCase &c) { c.filter = 1; }, {46, 96}, {15, 32}},
    {"automatic", automatic, {13, 60}, {4, 21}},
    {"clocks within 1 ppm", [](SyncCase &c) { c.clocks.spread_ppm = 0.5; }, {25, 60}, {8, 21}},
    {"R = 0.1 s", [](SyncCase &c) { c.interval_s = 0.1; }, {18, 60}, {6, 21}},
    {"100 % load, bit errors 1e-4",
     [](SyncCase &c) {
       c.load = 1;
       c.bit_errors = 1e-4;
     },
     {18, 60},
     {6, 21}},
    {"automatic, wander 1e-9", [](SyncCase &c) { wander(c, 1e-9, 1); }, {20, 75}, {10, 45}},
    {"automatic, wander 1e-8", [](SyncCase &c) { wander(c, 1e-8, 1); }, {45, 200}, {25, 110}},
    {"automatic, wander 1e-8, R = 0.1 s",
     [](SyncCase &c) { wander(c, 1e-8, 0.1); },
     {18, 75},
     {7, 30}},
    {"automatic, wander 1e-7", [](SyncCase &c) { wander(c, 1e-7, 1); }, {190, 800}, {170, 800}},
    {"automatic, wander 1e-7, R = 0.1 s",
     [](SyncCase &c) { wander(c, 1e-7, 0.1); },
     {32, 130},
     {15, 75}},
    {"automatic, sine 1 ppm in 120 s",
     [](SyncCase &c) {
       automatic(c);
       c.clocks.sine_ppm = 1;
     },
     {100, 250},
     {90, 180}},
    {"automatic, 1 % of edges early",
     [](SyncCase &c) {
       automatic(c);
       c.displaced = 0.01;
     },
     {16, 130},
     {5, 60}},
    {"own pin, N = 8", [](SyncCase &c) { c.own_pin = true; }, {18, 91}, {6, 31}},
    {"hardware follower, KD 2, PHALF 1",
     [](SyncCase &c) { c.hardware = true; },
     {20, 62},
     {6.5, 20}},
    {"the same, 100 % load, bit errors 1e-4",
     [](SyncCase &c) {
       c.hardware = true;
       c.load = 1;
       c.bit_errors = 1e-4;
     },
     {20, 62},
     {6.5, 20}},
    {"hardware, KD 1, PHALF 0, wander 1e-8",
     [](SyncCase &c) {
       c.hardware = c.restless = true;
       c.clocks.wander = 1e-8;
     },
     {42, 5 * 62.5},
     {26, 5 * 20}},
};

SyncRow row_of(const Row &row, double frequency_hz, const Limits &limits) {
  SyncRow result{row.name, {}, SyncGoal{limits.sd, limits.max}};
  result.setting.clocks.frequency_hz = frequency_hz;
  row.change(result.setting);
  return result;
}

// B of section 12.
double periods(unsigned filter) {
  constexpr std::pair<unsigned, double> kBounds[] = {{1, 1.5}, {2, 1.17}, {4, 1.0}, {8, 0.92}};
  for (const auto &[length, bound] : kBounds)
    if (filter <= length) return bound;
  return 0.88;
}

bool same(SyncCase a, const SyncCase &b) {
  a.followers = b.followers;
  a.intervals = b.intervals;
  a.seeds = b.seeds;
  a.first_seed = b.first_seed;
  return a == b;
}

}  // namespace

bool SyncGoal::reached_by(const SyncFigures &figures) const {
  return figures.locked() && figures.max() <= max && (!sd || figures.sd() <= *sd);
}

std::vector<SyncRow> goal_table() {
  std::vector<SyncRow> rows;
  for (const Row &row : kRows) rows.push_back(row_of(row, 16e6, row.at16));
  for (const Row &row : kRows) rows.push_back(row_of(row, 50e6, row.at50));
  return rows;
}

std::optional<double> steady_bound(const SyncCase &setting) {
  if (setting.clocks.wander > 0 || setting.clocks.sine_ppm > 0 || setting.displaced > 0 ||
      setting.master_late_ns > 0)
    return std::nullopt;
  const double bound = periods(setting.filter) + (setting.own_pin ? 0.5 : 0);
  return bound * 1e9 / setting.clocks.frequency_hz + 2;
}

std::optional<SyncGoal> goal_of(const SyncCase &setting) {
  for (const SyncRow &row : goal_table())
    if (same(row.setting, setting)) return row.goal;
  if (setting.hardware) return std::nullopt;
  // TM-89: two followers each within half of it.
  if (setting.master_cut && steady_bound(setting))
    return SyncGoal{std::nullopt, 3e9 / setting.clocks.frequency_hz};
  if (const auto bound = steady_bound(setting)) return SyncGoal{std::nullopt, *bound};
  return std::nullopt;
}

}  // namespace vericansim
