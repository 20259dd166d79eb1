// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section: a part of the error injection matrix, as a list of runs that can be counted, named and
// repeated one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "faults/grid.hpp"
#include "faults/rule_bins.hpp"

namespace vericansim {

/// What a run was, for the tables, and what it found.
struct Outcome {
  std::string role = {};      ///< T or R at the disturbed bit, - for neither
  std::string state = {};     ///< of the start counters: A, P(tec), P(rec), P(both)
  std::string position = {};  ///< class of the disturbed bit
  std::string reaction = {};
  std::string report = {};  ///< what is wrong; empty if nothing is
};

/// One part. run() may be called from several threads at once.
class Section {
 public:
  explicit Section(Grid grid, std::string rules)
      : grid_{std::move(grid)}, rules_{std::move(rules)} {}
  virtual ~Section() = default;
  Section(const Section &) = delete;
  Section &operator=(const Section &) = delete;

  [[nodiscard]] const Grid &grid() const { return grid_; }
  /// What it is about, with the rules.
  [[nodiscard]] const std::string &rules() const { return rules_; }
  /// One case; `bins` may be null.
  [[nodiscard]] virtual Outcome run(const Grid::Digits &at, RuleBins *bins) const = 0;

 private:
  Grid grid_;
  std::string rules_;
};

using Sections = std::vector<std::unique_ptr<Section>>;

/// Frame bits, arbitration, error handling, gaps, modes, pairs: whole bits.
[[nodiscard]] Sections bit_sections();
/// Integration, bus-off and every start value of the counters.
[[nodiscard]] Sections state_sections();
/// `count` runs with several random disturbances; `seed` is part of their names.
[[nodiscard]] std::unique_ptr<Section> random_section(std::uint64_t seed, std::size_t count);
/// Levels forced for some clocks; the sweep SY-19.
[[nodiscard]] Sections clock_sections();
/// All of them, in this order; the campaign's table.
[[nodiscard]] Sections all_sections(std::uint64_t seed);

}  // namespace vericansim
