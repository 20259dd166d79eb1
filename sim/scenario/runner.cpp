// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Builds the bus of a scenario, runs it, and collects the report.
#include "scenario/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "scenario/bittime.hpp"
#include "scenario/simulation.hpp"
#include "scenario/stop_request.hpp"
#include "trace/input_error.hpp"

namespace vericansim {

BitTiming timing_of(const Scenario &scenario, const NodeSpec &node, double bitrate) {
  if (node.timing) return *node.timing;
  BitTimingRequest request;
  request.clock_hz = static_cast<std::uint32_t>(std::llround(node.clock.frequency_hz));
  request.bitrate = static_cast<std::uint32_t>(std::llround(node.bitrate.value_or(bitrate)));
  request.sample_point = node.sample_point ? node.sample_point : scenario.sample_point;
  request.sjw = node.sjw;
  constexpr double kLargestError = 2'000;  // ppm; beyond it the bus would not work
  request.max_rate_error_ppm = kLargestError;
  const auto results = find_bit_timings(request);
  if (results.empty())
    throw InputError(
        scenario.file, node.line,
        fmt::format(
            "node '{}': no setting of 8 to 25 quanta gives {} bit/s within {:g} ppm from {} Hz",
            node.name, request.bitrate, kLargestError, request.clock_hz));
  return results.front().timing;
}

namespace {

/// Runs for the scenario's duration, or until the user wants the end.
void run_duration(Simulation &simulation, Time duration, Time bit_time,
                  const std::function<void(double)> &progress) {
  const Time part = std::min(duration / 100 + 1, 1'000 * bit_time);
  const Time end = simulation.started() + duration;
  while (simulation.bus().now() < end && !stop_requested()) {
    const Time now = simulation.bus().now();
    simulation.bus().run_until(end - now > part ? now + part : end);
    simulation.check();
    if (progress)
      progress(1 -
               static_cast<double>(end - simulation.bus().now()) / static_cast<double>(duration));
  }
}

}  // namespace

RunReport run_scenario(const Scenario &scenario, double bitrate,
                       const std::function<void(double)> &progress) {
  Simulation simulation{scenario, bitrate};
  const auto begin = std::chrono::steady_clock::now();
  simulation.join();
  simulation.start(simulation.bus().now());
  const auto bit_time = static_cast<Time>(std::llround(1e12 / bitrate));
  run_duration(simulation, scenario.duration, bit_time, progress);
  simulation.drain();
  RunReport report = simulation.finish(stop_requested());
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

}  // namespace vericansim
