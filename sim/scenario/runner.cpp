// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Builds the bus of a scenario, runs it, and collects the report.
#include "scenario/runner.hpp"

#include <fmt/format.h>

#include "scenario/bittime.hpp"
#include "session/session.hpp"
#include "trace/input_error.hpp"

namespace vericansim {

BitTiming timing_of(const Scenario &scenario, const NodeSpec &node, double bitrate) {
  if (node.timing) {
    const std::string wrong =
        rate_mismatch(*node.timing, node.clock.frequency_hz, node.bitrate.value_or(bitrate));
    if (!wrong.empty())
      throw InputError(scenario.file, node.line,
                       fmt::format("node '{}': timing {}", node.name, wrong));
    return *node.timing;
  }
  BitTimingRequest request =
      bit_timing_request(node.clock.frequency_hz, node.bitrate.value_or(bitrate));
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

RunReport run_scenario(const Scenario &scenario, double bitrate,
                       const std::function<void(double)> &progress) {
  SessionOptions options;
  options.progress = progress;
  Session session{{{scenario, bitrate}}, std::move(options)};
  return session.run().front();
}

}  // namespace vericansim
