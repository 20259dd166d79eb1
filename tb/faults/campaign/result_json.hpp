// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The result of the campaign's stage "matrix": figures, tables and notes as JSON, and all counts as
// CSV.
#pragma once

#include <string>

#include "faults/campaign/tally.hpp"

namespace vericansim {

/// What result_json() needs besides the counts.
struct ResultInfo {
  bool whole = true;  ///< every case has been run: only then the coverage is judged
  double seconds = 0;
  double cpu_seconds = 0;
  std::uint64_t seed = 1;
};

[[nodiscard]] std::string result_json(const Tally &tally, const RuleBins &bins,
                                      const Sections &sections, const ResultInfo &info);
/// One line for each section, role, state, position class and reaction.
[[nodiscard]] std::string result_csv(const Tally &tally);

}  // namespace vericansim
