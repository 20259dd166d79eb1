// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bit timing of a scenario's node: what it says, or the best that its clock can do.
#include "simulation/node_timing.hpp"

#include <fmt/format.h>

#include "timing/bittime.hpp"
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

}  // namespace vericansim
