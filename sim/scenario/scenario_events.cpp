// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: traffic.
#include <fmt/format.h>

#include <algorithm>

#include "model/same_identifier.hpp"
#include "scenario/scenario_parts.hpp"
#include "signals/signal_codec.hpp"
#include "trace/input_error.hpp"
#include "trace/text.hpp"

namespace vericansim::detail {
namespace {

void parse_data_bytes(const YamlValue &value, Frame &frame) {
  std::size_t count = 0;
  const auto add = [&](std::uint64_t byte) {
    if (count == 8) value.refuse("up to 8 bytes");
    frame.data[count++] = static_cast<std::uint8_t>(byte);
  };
  if (value.is_list()) {
    for (const YamlValue &item : value.items()) add(item.integer(0, 255));
  } else {
    const std::string text = value.text();
    for (const std::string_view word : text::split_blanks(text)) {
      const auto byte = word.size() == 2 ? text::parse_unsigned(word, 16) : std::nullopt;
      if (!byte)
        value.refuse("counter, random, a list of numbers, or hexadecimal bytes as in '01 A5'");
      add(*byte);
    }
  }
  frame.dlc = static_cast<std::uint8_t>(count);
}

void parse_payload(YamlMap &map, TrafficSpec &traffic, const SignalMessage *message) {
  Frame &frame = traffic.frame;
  const auto dlc = map.find("dlc");
  const auto data = map.find("data");
  if (message != nullptr && !data && !frame.remote) frame.data = encode(*message, {});
  if (data) {
    if (data->is_map() && message == nullptr) data->fail("signals need a 'message' of a database");
    if (data->is_map())
      parse_signals(*data, *message, frame);
    else if (data->is_scalar() && data->text() == "counter")
      traffic.data = DataKind::kCounter;
    else if (data->is_scalar() && data->text() == "random")
      traffic.data = DataKind::kRandom;
    else
      parse_data_bytes(*data, frame);
    if (frame.remote) data->fail("a remote frame has no data");
    if (traffic.data != DataKind::kFixed && message == nullptr) frame.dlc = 8;
  }
  if (!dlc) return;
  const auto code = static_cast<std::uint8_t>(dlc->integer(0, 15));
  if (data && traffic.data == DataKind::kFixed && std::min<unsigned>(code, 8) != frame.dlc)
    dlc->fail(fmt::format("{} does not fit the {} bytes of data", code, frame.dlc));
  frame.dlc = code;
  for (unsigned i = frame.payload_size(); i < frame.data.size(); ++i) frame.data[i] = 0;
}

void parse_identifier(YamlMap &map, TrafficSpec &traffic) {
  Frame &frame = traffic.frame;
  map.with("extended", [&](const YamlValue &v) { frame.extended = v.boolean(); });
  frame.id =
      static_cast<std::uint32_t>(map.need("id").integer(0, frame.extended ? 0x1FFFFFFF : 0x7FF));
  traffic.name = frame.extended ? fmt::format("{:08X}", frame.id) : fmt::format("{:03X}", frame.id);
}

void parse_times(YamlMap &map, TrafficSpec &traffic) {
  map.with("period", [&](const YamlValue &v) {
    if (v.is_scalar() && v.text() == "saturated")
      traffic.saturated = true;
    else
      traffic.period = v.time(kMicrosecond, kLongestTime);
  });
  map.with("offset", [&](const YamlValue &v) {
    if (v.is_scalar() && v.text() == "random") {
      if (traffic.period == 0) v.fail("a random offset needs a period");
      traffic.random_offset = true;
    } else {
      traffic.offset = v.time(0, kLongestTime);
    }
  });
  map.with("jitter", [&](const YamlValue &v) {
    traffic.jitter = v.time(0, kLongestTime);
    if (traffic.period != 0 && traffic.jitter >= traffic.period)
      v.fail("the jitter must be below the period");
  });
  const bool repeats = traffic.period != 0 || traffic.saturated;
  map.with("count", [&](const YamlValue &v) { traffic.count = parse_count(v, repeats); });
  if (!repeats) traffic.count = 1;
}

/// A saturated message goes on when one of its frames has left, so these must be its own.
void check_saturated(const YamlValue &value, const TrafficSpec &traffic, const Scenario &scenario) {
  for (const TrafficSpec &other : scenario.traffic)
    if ((traffic.saturated || other.saturated) && other.node == traffic.node &&
        same_identifier(other.frame, traffic.frame))
      value.fail(
          fmt::format("one of message {} in line {} and this one is saturated, and both "
                      "have one identifier; allowed: an identifier of its own",
                      in_quotes(other.name), other.line));
}

/// Expectations and reports know messages by their names.
void check_name(const YamlValue &value, const TrafficSpec &traffic, const Scenario &scenario) {
  for (const TrafficSpec &other : scenario.traffic)
    if (other.name == traffic.name)
      value.fail("message name " + in_quotes(traffic.name) +
                 " is used twice; give one with 'name'");
}

}  // namespace

std::uint64_t parse_count(const YamlValue &value, bool repeats, std::string_view with) {
  const std::uint64_t count = value.integer(1, 1'000'000'000);
  if (!repeats && count > 1) value.refuse(fmt::format("1, or more with {}", with));
  return count;
}

TrafficSpec parse_traffic(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  TrafficSpec traffic;
  traffic.line = value.line();
  const YamlValue node = map.need("node");
  traffic.node = parse_node_name(node, scenario);
  const NodeRole &role = scenario.nodes[traffic.node].role;
  if (!std::holds_alternative<TrafficRole>(role))
    node.fail(
        fmt::format("a node with '{}' sends of its own; allowed: the other nodes", name_of(role)));
  if (!scenario.nodes[traffic.node].software)
    node.fail("a node with 'software: none' sends by 'accesses' alone");
  map.with("remote", [&](const YamlValue &v) { traffic.frame.remote = v.boolean(); });
  const SignalMessage *message = parse_message(map, scenario, traffic);
  if (message == nullptr) parse_identifier(map, traffic);
  map.with("name", [&](const YamlValue &v) { traffic.name = v.name(); });
  check_name(value, traffic, scenario);
  parse_payload(map, traffic, message);
  parse_times(map, traffic);
  check_saturated(value, traffic, scenario);
  map.finish();
  return traffic;
}

}  // namespace vericansim::detail
