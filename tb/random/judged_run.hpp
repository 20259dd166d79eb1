// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// JudgedRun: a scenario with judges, run until the first difference.
#pragma once

#include <string>
#include <vector>

#include "judge/bus_judge.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// What came of a run.
struct JudgedRun {
  std::vector<std::string> findings;  ///< empty: all judges agree with the core
  bool cut_short = false;             ///< ended, without a finding: too much was open to judge on
  Time failed_at = -1;                ///< when the first was seen, in the scenario's time; -1: none
  std::uint64_t frames = 0;           ///< acknowledged on the bus
  std::uint64_t error_frames = 0, overload_frames = 0;
  JudgeCounts counts;
  std::uint64_t node_cycles = 0;
  [[nodiscard]] bool ok() const { return findings.empty(); }
};

/// Runs the scenario. What is thrown becomes a finding. A failing run ends some bits after the
/// first finding.
[[nodiscard]] JudgedRun run_judged(const Scenario &scenario);

}  // namespace vericansim
