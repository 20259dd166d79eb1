// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ExpectedFrames: see expected_frames.hpp.
#include "simulation/expected_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/node_timing.hpp"
#include "timing/bittime.hpp"

namespace vericansim {
namespace {

/// Only the scenario's traffic is sent: nobody's software, no log, no access to a register.
bool traffic_is_all(const Scenario &scenario) {
  return scenario.accesses.empty() &&
         std::all_of(scenario.nodes.begin(), scenario.nodes.end(), [](const NodeSpec &node) {
           return std::holds_alternative<TrafficRole>(node.role);
         });
}

/// Delay between the two nodes that are farthest apart, from pin to pin, ns.
double farthest_ns(const Scenario &scenario) {
  Time longest = 0, second = 0;
  for (const NodeSpec &node : scenario.nodes) {
    const Time delay = node.link.cable + node.link.transmitter + node.link.receiver;
    second = std::max(second, std::min(longest, delay));
    longest = std::max(longest, delay);
  }
  return static_cast<double>(longest + second) / kNanosecond;
}

/// Half of what the clocks may differ by, with the delays there are, leaves nothing to be misread.
bool reads_all_bits(const Scenario &scenario, double bitrate) {
  const double delay_ns = farthest_ns(scenario);
  return std::all_of(scenario.nodes.begin(), scenario.nodes.end(), [&](const NodeSpec &node) {
    BitTimingRequest request = bit_timing_request(node.clock.frequency_hz, bitrate);
    request.node_delay_ns = delay_ns;
    const BitTimingResult result = rate_bit_timing(timing_of(scenario, node, bitrate), request);
    const double ppm = std::abs(node.clock.error_ppm) + std::abs(node.clock.wander_ppm) +
                       std::abs(result.rate_error_ppm);
    return result.usable() && 2e-6 * ppm <= result.oscillator_tolerance;
  });
}

/// Others than the sender acknowledge, so that no frame is sent again.
bool acknowledged(const Scenario &scenario) {
  return 2 <= std::count_if(scenario.nodes.begin(), scenario.nodes.end(), [](const NodeSpec &node) {
           return node.hosted() && !node.host.listen_only && !node.host.loop_back;
         });
}

/// Frames that a message is queued for, at most.
std::uint64_t frames_of(const TrafficSpec &traffic, Time duration) {
  const Time offset = traffic.random_offset ? 0 : traffic.offset;
  if (offset >= duration) return 0;
  if (traffic.period == 0) return traffic.count;
  return std::min<std::uint64_t>(
      traffic.count, static_cast<std::uint64_t>((duration - 1 - offset) / traffic.period) + 1);
}

}  // namespace

ExpectedFrames::ExpectedFrames(const Scenario &scenario, double bitrate)
    : known_{!scenario.cut_short && traffic_is_all(scenario) && reads_all_bits(scenario, bitrate)} {
  for (const TrafficSpec &traffic : scenario.traffic) {
    if (scenario.nodes[traffic.node].host.loop_back) continue;  // not on the bus
    const std::uint64_t frames = frames_of(traffic, scenario.duration);
    if (frames == 0) continue;
    extended_ = extended_ || traffic.frame.extended;
    const unsigned bytes = traffic.frame.payload_size();
    if (bytes != 0) data_.insert(8 * bytes);
    count_ = frames > kAny - count_ ? kAny : count_ + frames;
  }
  if (!acknowledged(scenario) && count_ != 0) count_ = kAny;
}

std::string ExpectedFrames::missing_data(const PlaceSpec &place) const {
  if (data_.empty()) return "no frame has data; allowed: traffic with data";
  const bool fits = std::any_of(data_.begin(), data_.end(), [&](unsigned bits) {
    return place.index.value_or(0) + place.left.value_or(0) < bits &&
           (!place.index || !place.left || *place.index + *place.left + 1 == bits);
  });
  if (fits) return "";
  return fmt::format("no frame has such a bit of data; the longest data have {} bits",
                     *data_.rbegin());
}

std::string ExpectedFrames::missing(const PlaceSpec &place) const {
  const Field field = place.field.value_or(Field::kIdle);
  const bool of_a_frame = field >= Field::kSof && field <= Field::kEof;
  if (count_ == 0 && (of_a_frame || place.frame))
    return "no frame is sent; allowed: a scenario with traffic";
  if (place.frame && *place.frame > count_)
    return fmt::format("frame {} does not come; allowed: 1 to {}, all that is sent", *place.frame,
                       count_);
  if (!extended_ && (field == Field::kExId || field == Field::kExRtr || field == Field::kR1))
    return fmt::format(
        "{} is in extended frames, and none is sent; allowed: traffic with "
        "'extended: true', or a field of base frames",
        field_name(field));
  return field == Field::kData ? missing_data(place) : "";
}

}  // namespace vericansim
