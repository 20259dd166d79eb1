// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs with a report: see report_run.hpp.
#include "report/report_run.hpp"

#include <gtest/gtest.h>

#include "session/runner.hpp"

namespace vericansim {

std::string report_file(const std::string &ending) {
  const auto *test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string{test->test_suite_name()} + "." + test->name();
  for (char &c : name)
    if (c == '/') c = '-';
  return ::testing::TempDir() + name + ending;
}

ReportedRun run_with_report(Scenario scenario) {
  scenario.outputs.report = report_file(".html");
  scenario.outputs.candump = report_file(".log");
  RunReport report = run_scenario(scenario, scenario.bitrates.front());
  return {report, ReportPage{scenario.outputs.report},
          report.frames == 0 ? CanLog{} : read_log(scenario.outputs.candump)};
}

Scenario busy_scenario() {
  return parse_scenario("busy.yaml", R"(
name: Busy
bitrate: 500k
duration: 20 ms
analysis: true
nodes:
  - {name: a, clock: 8 MHz}
  - {name: b, clock: 8 MHz, ppm: 900, phase: 31 ns}
  - {name: c, clock: 16 MHz, ppm: -900}
  - {name: d, clock: 40 MHz, ppm: 300, phase: 7 ns}
traffic:
  - {node: a, name: zeros, id: 0x000, data: [0, 0, 0, 0, 0, 0, 0, 0], period: 2 ms}
  - {node: b, name: ones, id: 0x7FF, data: [255, 255, 255], period: 2 ms}
  - {node: b, name: asked, id: 0x123, remote: true, dlc: 5, period: 4 ms}
  - {node: c, name: long, id: 0x1FFFFFFF, extended: true, data: random, dlc: 8, period: 2 ms}
  - {node: d, name: near, id: 0x7FE, data: counter, dlc: 15, period: 2 ms}
  - {node: d, name: same, id: 0x01FC0000, extended: true, data: random, dlc: 1, period: 4 ms}
expect: {pending: 0, error_frames: 0}
)");
}

Scenario disturbed_scenario() {
  return parse_scenario("disturbed.yaml", R"(
name: Disturbed
bitrate: 250k
duration: 40 ms
drain: 40 ms
nodes:
  - {name: a, clock: 8 MHz}
  - {name: b, clock: 8 MHz, ppm: 2000, phase: 50 ns}
  - {name: c, clock: 16 MHz, ppm: -2000}
traffic:
  - {node: a, name: fast, id: 0x080, data: random, dlc: 8, period: 1 ms}
  - {node: b, name: slow, id: 0x300, data: random, dlc: 6, period: 3 ms}
  - {node: c, name: long, id: 0x12345678, extended: true, data: random, dlc: 3, period: 4 ms}
faults:
  - {kind: noise, node: all, per_bit: 0.002, seed: 3}
  - {kind: dominant, node: all, from: 12.3 ms, for: 6 us}
  - {kind: cut, node: c, from: 20 ms, for: 4 ms}
)");
}

}  // namespace vericansim
