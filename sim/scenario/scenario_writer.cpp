// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: a scenario back to text.
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "scenario/access_step.hpp"
#include "scenario/scenario_text.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

using namespace detail;

constexpr Time kEver = std::numeric_limits<Time>::max();

std::string name_of(const Scenario &scenario, NodeId node) {
  return yaml_text(scenario.nodes[node].name);
}

std::string clock_text(const ClockConfig &clock) {
  std::string text;
  const ClockConfig usual;
  if (clock.frequency_hz != usual.frequency_hz)
    text += fmt::format(", clock: {} Hz", clock.frequency_hz);
  if (clock.error_ppm != 0) text += fmt::format(", ppm: {}", clock.error_ppm);
  if (clock.phase != 0) text += fmt::format(", phase: {}", exact_time(clock.phase));
  if (clock.wander != Wander::kNone)
    text += fmt::format(", wander: {{kind: {}, ppm: {}, period: {}}}",
                        clock.wander == Wander::kSine ? "sine" : "walk", clock.wander_ppm,
                        exact_time(clock.wander_period));
  return text;
}

std::string filters_text(const std::vector<RxFilter> &filters) {
  std::string text;
  for (const RxFilter &f : filters) {
    text += fmt::format("{}{{id: 0x{:X}, mask: 0x{:X}", text.empty() ? "" : ", ", f.id, f.mask);
    if (f.extended) text += ", extended: true";
    if (!f.match_format) text += ", match_format: false";
    if (f.match_remote) text += fmt::format(", remote: {}", f.remote ? "true" : "false");
    text += "}";
  }
  return "[" + text + "]";
}

std::string node_text(const NodeSpec &node) {
  std::string text = "  - {name: " + yaml_text(node.name) + role_text(node);
  if (!std::holds_alternative<SecondCoreRole>(node.role)) text += clock_text(node.clock);
  const auto delay = [&](const char *key, Time value) {
    if (value != 0) text += fmt::format(", {}: {}", key, exact_time(value));
  };
  delay("delay", node.link.cable);
  delay("tx_delay", node.link.transmitter);
  delay("rx_delay", node.link.receiver);
  if (node.timing)
    text += fmt::format(", timing: {{brp: {}, prop: {}, ps1: {}, ps2: {}, sjw: {}}}",
                        node.timing->prescaler, node.timing->prop, node.timing->ps1,
                        node.timing->ps2, node.timing->sjw);
  if (node.bitrate) text += fmt::format(", bitrate: {}", *node.bitrate);
  if (node.sample_point) text += fmt::format(", sample_point: {}", *node.sample_point);
  if (node.sjw) text += fmt::format(", sjw: {}", *node.sjw);
  if (node.num_mb != 64) text += fmt::format(", mailboxes: {}", node.num_mb);
  if (node.hosted()) text += host_text(node.host);
  if (!node.software) text += ", software: none";
  return text + "}\n";
}

std::string payload_text(const TrafficSpec &traffic) {
  const Frame &frame = traffic.frame;
  if (traffic.data == DataKind::kCounter) return fmt::format(", data: counter, dlc: {}", frame.dlc);
  if (traffic.data == DataKind::kRandom) return fmt::format(", data: random, dlc: {}", frame.dlc);
  std::string bytes;
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    bytes += fmt::format("{}0x{:02X}", i == 0 ? "" : ", ", frame.data[i]);
  return (bytes.empty() ? "" : ", data: [" + bytes + "]") + fmt::format(", dlc: {}", frame.dlc);
}

std::string traffic_text(const Scenario &scenario, const TrafficSpec &traffic) {
  const Frame &frame = traffic.frame;
  std::string text =
      fmt::format("  - {{node: {}, name: {}, id: 0x{:X}", name_of(scenario, traffic.node),
                  yaml_text(traffic.name), frame.id);
  if (frame.extended) text += ", extended: true";
  if (frame.remote) text += ", remote: true";
  text += payload_text(traffic);
  if (traffic.saturated) text += ", period: saturated";
  if (traffic.period != 0) text += ", period: " + exact_time(traffic.period);
  if (traffic.random_offset) text += ", offset: random";
  if (traffic.offset != 0) text += ", offset: " + exact_time(traffic.offset);
  if (traffic.jitter != 0) text += ", jitter: " + exact_time(traffic.jitter);
  const bool repeats = traffic.saturated || traffic.period != 0;
  if (repeats && traffic.count != std::numeric_limits<std::uint64_t>::max())
    text += fmt::format(", count: {}", traffic.count);
  return text + "}\n";
}

std::string effect_text(Effect effect) {
  if (effect == Effect::kFlip) return "flip";
  return effect == Effect::kDominant ? "dominant" : "recessive";
}

std::string place_yaml(const Scenario &scenario, const FaultSpec &fault) {
  const PlaceSpec &place = fault.place;
  std::string text = ", at: {node: " + name_of(scenario, fault.watched);
  const auto number = [&](const char *key, const std::optional<unsigned> &value) {
    if (value) text += fmt::format(", {}: {}", key, *value);
  };
  number("frame", place.frame);
  if (place.field) text += fmt::format(", field: {}", field_name(*place.field));
  number("bit", place.index);
  number("bits_left", place.left);
  if (place.stuff) text += fmt::format(", stuff: {}", *place.stuff ? "true" : "false");
  number("first_tq", fault.first_quantum);
  number("last_tq", fault.last_quantum);
  return text + "}";
}

std::string window_yaml(const Window &window) {
  std::string text;
  if (window.from != 0) text += ", from: " + exact_time(window.from);
  if (window.to != kEver) text += ", for: " + exact_time(window.to - window.from);
  return text;
}

std::string range_text(const Range &range) {
  if (range.least == range.most) return fmt::format("{}", range.least);
  std::string text;
  if (!std::isinf(range.least)) text += fmt::format("min: {}", range.least);
  if (!std::isinf(range.most))
    text += fmt::format("{}max: {}", text.empty() ? "" : ", ", range.most);
  return "{" + text + "}";
}

std::string fault_line(const Scenario &scenario, const FaultSpec &fault) {
  using Kind = FaultSpec::Kind;
  const std::string node =
      ", node: " + (fault.node == kAllNodes ? "all" : name_of(scenario, fault.node));
  std::string text = "  - {kind: ";
  switch (fault.kind) {
    case Kind::kLevel: text += effect_text(fault.effect) + node + window_yaml(fault.window); break;
    case Kind::kPlace:
      text += effect_text(fault.effect) + node + place_yaml(scenario, fault);
      break;
    case Kind::kCut: text += "cut" + node + window_yaml(fault.window); break;
    case Kind::kShort: text += "short" + node + window_yaml(fault.window); break;
    case Kind::kClock:
      text += "clock" + node + window_yaml(fault.window) + fmt::format(", ppm: {}", fault.ppm);
      break;
    case Kind::kNoise:
      text += "noise" + node + window_yaml(fault.window) +
              fmt::format(", per_bit: {}, seed: {}", fault.noise.per_bit, fault.noise.seed);
      if (fault.noise.per_ns != 0)
        text += fmt::format(", glitches_per_ms: {}, glitch: {}", fault.noise.per_ns * 1e6,
                            exact_time(fault.noise.glitch));
      break;
  }
  if (!fault.name.empty()) text += ", name: " + yaml_text(fault.name);
  if (fault.hits) text += ", hits: " + range_text(*fault.hits);
  return text + "}\n";
}

std::string access_text(const Scenario &scenario, const AccessSpec &access) {
  std::string steps;
  for (const AccessStep &step : access.steps)
    steps += (steps.empty() ? "" : ", ") + to_text(step, scenario.nodes[access.node].num_mb);
  return fmt::format("  - {{node: {}, at: {}, do: [{}]}}\n", name_of(scenario, access.node),
                     exact_time(access.at), steps);
}

}  // namespace

std::string detail::host_text(const HostConfig &host) {
  std::string text;
  const auto flag = [&](const char *key, bool value) {
    if (value) text += fmt::format(", {}: true", key);
  };
  if (host.tx_buffers != 0) text += fmt::format(", tx_buffers: {}", host.tx_buffers);
  flag("lowest_buffer_first", host.lowest_buffer_first);
  flag("listen_only", host.listen_only);
  flag("loop_back", host.loop_back);
  flag("self_reception", host.self_reception);
  flag("triple_sampling", host.triple_sampling);
  flag("fd_tolerant", host.fd_tolerant);
  if (host.boff_rec) text += ", bus_off_recovery: never";
  if (!host.filters.empty()) text += ", filters: " + filters_text(host.filters);
  return text;
}

std::string to_yaml(const Scenario &scenario) {
  std::string text = "name: " + yaml_text(scenario.name) + "\n";
  if (scenario.lockstep) text += "judge: lockstep\n";
  std::string rates;
  for (const double rate : scenario.bitrates)
    rates += fmt::format("{}{}", rates.empty() ? "" : ", ", rate);
  text += scenario.bitrates.size() == 1 ? "bitrate: " + rates + "\n" : "bitrate: [" + rates + "]\n";
  if (scenario.sample_point) text += fmt::format("sample_point: {}\n", *scenario.sample_point);
  text += end_text(scenario);
  text += "drain: " + exact_time(scenario.drain) + "\n";
  text += fmt::format("seed: {}\n", scenario.seed);
  if (scenario.analysis) text += "analysis: true\n";
  text += "nodes:\n";
  for (const NodeSpec &node : scenario.nodes) text += node_text(node);
  for (const ListenerSpec &listener : scenario.listeners) text += listener_text(listener);
  if (!scenario.traffic.empty()) text += "traffic:\n";
  for (const TrafficSpec &traffic : scenario.traffic) text += traffic_text(scenario, traffic);
  if (!scenario.faults.empty()) text += "faults:\n";
  for (const FaultSpec &fault : scenario.faults) text += fault_line(scenario, fault);
  if (!scenario.accesses.empty()) text += "accesses:\n";
  for (const AccessSpec &access : scenario.accesses) text += access_text(scenario, access);
  if (!scenario.commands.empty()) text += "commands:\n";
  for (const RemoteCommandSpec &commands : scenario.commands)
    text += commands_text(scenario, commands);
  if (!scenario.user.empty()) text += "user:\n";
  for (const UserSpec &user : scenario.user) text += user_text(scenario, user);
  return text;
}

}  // namespace vericansim
