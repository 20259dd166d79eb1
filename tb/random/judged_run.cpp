// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// JudgedRun: see judged_run.hpp.
#include "random/judged_run.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "simulation/simulation.hpp"

namespace vericansim {
namespace {

void simulate(Simulation &simulation, const Scenario &scenario, JudgedRun &run) {
  const auto step = static_cast<Time>(std::llround(500e12 / scenario.bitrates.front()));
  simulation.join();
  simulation.start(simulation.bus().now());
  const Time end = simulation.started() + scenario.duration;
  const auto failed = [&] { return !simulation.judge()->findings().empty(); };
  while (simulation.bus().now() < end && !failed()) {
    simulation.bus().run_until(std::min(end, simulation.bus().now() + step));
    simulation.check();
  }
  if (failed()) {
    run.failed_at = simulation.bus().now() - simulation.started();
  } else {
    simulation.drain();
  }
}

}  // namespace

JudgedRun run_judged(const Scenario &scenario) {
  JudgedRun run;
  Simulation simulation{scenario, scenario.bitrates.front()};
  try {
    simulate(simulation, scenario, run);
    const RunReport report = simulation.finish();
    run.frames = report.frames;
    run.error_frames = report.error_frames;
    run.overload_frames = report.overload_frames;
    run.node_cycles = report.node_cycles;
    run.counts = *report.judged;
    // A run that ended early does not reach all that its scenario asks for.
    const bool whole = run.failed_at < 0 && !simulation.judge()->too_open();
    for (const CheckResult &check : report.checks)
      if (whole && !check.ok && check.what != "lockstep")
        run.findings.push_back(check.what + ": " + check.seen);
  } catch (const std::exception &error) {
    run.findings.emplace_back(error.what());
  }
  run.cut_short = simulation.judge()->too_open();
  if (run.cut_short) return run;
  const auto &findings = simulation.judge()->findings();
  run.findings.insert(run.findings.begin(), findings.begin(), findings.end());
  if (!run.ok() && run.failed_at < 0) run.failed_at = scenario.duration;
  return run;
}

}  // namespace vericansim
