// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Shrinking: from a failing scenario to a small one that still fails.
#pragma once

#include <functional>

#include "random/judged_run.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

struct Shrunk {
  Scenario scenario;
  JudgedRun run;      ///< of that scenario
  unsigned runs = 0;  ///< that it took
};

/// Drops nodes, messages, accesses and faults, shortens the run, and simplifies clocks, timings,
/// buffers and frames, as long as a difference of the same kind is left; at most `limit` runs. The
/// result also fails after it was written and read as a file.
[[nodiscard]] Shrunk shrink(const Scenario &scenario, const JudgedRun &run, unsigned limit = 500);

}  // namespace vericansim
