// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: traffic and faults.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

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
  map.with("count", [&](const YamlValue &v) { traffic.count = v.integer(1, 1'000'000'000); });
  if (traffic.period == 0 && !traffic.saturated)
    traffic.count = std::min<std::uint64_t>(traffic.count, 1);
}

std::string lower(std::string text) {
  for (char &c : text)
    c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Field parse_field(const YamlValue &value) {
  std::string names;
  for (unsigned code = 0; code < 32; ++code) {
    const std::string name{field_name(static_cast<Field>(code))};
    if (name == "?") continue;
    if (lower(name) == lower(value.text())) return static_cast<Field>(code);
    names += (names.empty() ? "" : ", ") + name;
  }
  value.refuse(names);
}

void parse_window(YamlMap &map, Window &window) {
  map.with("from", [&](const YamlValue &v) { window.from = v.time(0, kLongestTime); });
  const auto to = map.find("to");
  const auto length = map.find("for");
  if (to && length) length->fail("either 'to' or 'for', not both");
  if (to) window.to = to->time(window.from + 1, kLongestTime);
  if (length) window.to = window.from + length->time(1, kLongestTime);
}

void parse_place(const YamlValue &value, const Scenario &scenario, FaultSpec &fault) {
  YamlMap map{value};
  fault.kind = FaultSpec::Kind::kPlace;
  fault.watched = parse_node_name(map.need("node"), scenario);
  fault.node = fault.watched;
  const auto number = [&](const char *key, std::optional<unsigned> &target, std::uint64_t least,
                          std::uint64_t most) {
    map.with(key,
             [&](const YamlValue &v) { target = static_cast<unsigned>(v.integer(least, most)); });
  };
  map.with("field", [&](const YamlValue &v) { fault.place.field = parse_field(v); });
  number("frame", fault.place.frame, 1, 1'000'000'000);
  number("bit", fault.place.index, 0, 127);
  number("bits_left", fault.place.left, 0, 63);
  number("first_tq", fault.first_quantum, 0, 24);
  number("last_tq", fault.last_quantum, 0, 24);
  map.with("stuff", [&](const YamlValue &v) { fault.place.stuff = v.boolean(); });
  map.finish();
}

void parse_noise(YamlMap &map, NoiseConfig &noise, std::uint64_t seed) {
  noise.seed = seed;
  map.with("per_bit", [&](const YamlValue &v) { noise.per_bit = v.number(0, 1); });
  map.with("glitches_per_ms", [&](const YamlValue &v) { noise.per_ns = v.number(0, 1e6) / 1e6; });
  map.with("glitch", [&](const YamlValue &v) { noise.glitch = v.time(1, kSecond); });
  map.with("seed", [&](const YamlValue &v) { noise.seed = v.integer(0, 0xFFFFFFFF); });
}

}  // namespace

TrafficSpec parse_traffic(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  TrafficSpec traffic;
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
  map.with("name", [&](const YamlValue &v) { traffic.name = v.text(); });
  for (const TrafficSpec &other : scenario.traffic)
    if (other.name == traffic.name)
      value.fail("message name " + quoted(traffic.name) + " is used twice; give one with 'name'");
  parse_payload(map, traffic, message);
  parse_times(map, traffic);
  map.finish();
  return traffic;
}

FaultSpec parse_fault(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  FaultSpec fault;
  const YamlValue kind = map.need("kind");
  const std::string word = kind.text();
  const bool level = word == "flip" || word == "dominant" || word == "recessive";
  if (level) {
    fault.effect = word == "flip"       ? Effect::kFlip
                   : word == "dominant" ? Effect::kDominant
                                        : Effect::kRecessive;
    map.with("at", [&](const YamlValue &v) { parse_place(v, scenario, fault); });
  } else if (word == "noise") {
    fault.kind = FaultSpec::Kind::kNoise;
    parse_noise(map, fault.noise, scenario.seed);
  } else if (word == "clock") {
    fault.kind = FaultSpec::Kind::kClock;
    fault.ppm = map.need("ppm").number(-50'000, 50'000);
  } else if (word == "cut" || word == "short") {
    fault.kind = word == "cut" ? FaultSpec::Kind::kCut : FaultSpec::Kind::kShort;
  } else {
    kind.refuse("flip, dominant, recessive, cut, short, clock, noise");
  }
  if (fault.kind != FaultSpec::Kind::kPlace) parse_window(map, fault.window);
  const bool everyone = level || fault.kind == FaultSpec::Kind::kNoise;  // others need one node
  const auto node = map.find("node");
  if (node && everyone && node->is_scalar() && node->text() == "all")
    fault.node = kAllNodes;
  else if (node)
    fault.node = parse_node_name(*node, scenario);
  else if (!everyone)
    value.fail("key 'node' is missing");
  fault.noise.victim = fault.node;
  fault.noise.window = fault.window;
  map.finish();
  return fault;
}

}  // namespace vericansim::detail
