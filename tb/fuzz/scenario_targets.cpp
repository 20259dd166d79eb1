// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets: scenario files, and the values of options and scenarios on their own.
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "bridge/socketcand_listener.hpp"
#include "fuzz/target.hpp"
#include "scenario/scenario.hpp"
#include "timing/bittime.hpp"
#include "trace/id_filter.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::fuzz {
namespace {

double take_double(Reader &input) {
  const std::uint64_t bits = input.number(8);
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void check_bit_timings(Reader &input) {
  BitTimingRequest request;
  request.clock_hz = static_cast<std::uint32_t>(input.number(4));
  request.bitrate = static_cast<std::uint32_t>(input.number(4));
  const std::uint8_t given = input.byte();
  if ((given & 1) != 0) request.sample_point = take_double(input);
  if ((given & 2) != 0) request.sjw = input.byte();
  if ((given & 4) != 0) request.cable_m = take_double(input);
  if ((given & 8) != 0) request.node_delay_ns = take_double(input);
  if ((given & 16) != 0) request.max_rate_error_ppm = take_double(input);
  if ((given & 32) != 0) request.controller_delay_ns = take_double(input);
  try {
    for (const BitTimingResult &result : find_bit_timings(request)) result.timing.validate();
  } catch (const std::invalid_argument &error) {
    // As the header says for a request out of range; a result that is none would say otherwise.
    require(std::strncmp(error.what(), "bit timing:", 11) != 0, "settings within the registers");
  }
}

}  // namespace

void fuzz_scenario(Bytes input) {
  try {
    const Scenario scenario = parse_scenario("input.yaml", std::string{text_of(input)});
    require(!scenario.nodes.empty() && scenario.nodes.size() <= Bus::kMaxNodes, "1 to 64 nodes");
    for (const TrafficSpec &traffic : scenario.traffic) {
      require(traffic.node < scenario.nodes.size(), "a node that there is");
      require_valid(traffic.frame);
    }
    for (const double bitrate : scenario.bitrates)
      require(bitrate >= 1e3 && bitrate <= 1e6, "a bit rate within its limits");
    require(scenario.duration > 0, "a duration");
  } catch (const InputError &) {
  }
}

// The first byte chooses the reader.
void fuzz_options(Bytes bytes) {
  Reader input{bytes};
  const unsigned reader = input.byte() % 10;
  if (reader == 9) return check_bit_timings(input);
  const std::string text{text_of(input.take(bytes.size()))};
  const auto number = [](std::optional<double> value) {
    require(!value || !std::isnan(*value), "a number");
  };
  try {
    switch (reader) {
      case 0: number(parse_frequency(text)); break;
      case 1: number(parse_bitrate(text)); break;
      case 2: static_cast<void>(parse_time(text)); break;
      case 3: number(parse_length(text)); break;
      case 4: number(parse_part(text)); break;
      case 5: number(parse_number(text)); break;
      case 6: static_cast<void>(parse_integer(text)); break;
      case 7: static_cast<void>(parse_filter(text)); break;
      default: static_cast<void>(SocketcandAddress::parse("--socketcand", text)); break;
    }
  } catch (const InputError &) {
  }
}

}  // namespace vericansim::fuzz
