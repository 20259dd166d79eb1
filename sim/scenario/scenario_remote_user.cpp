// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: user logic of remote nodes, and what is expected of them.
#include <fmt/format.h>

#include <algorithm>

#include "scenario/scenario_remote_parts.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::detail {
namespace {

unsigned parse_place(const YamlValue &value, unsigned length, unsigned end) {
  return static_cast<unsigned>(value.integer(0, end - length));
}

void parse_plant(const YamlValue &value, const RemoteConfig &config, UserSpec &user) {
  YamlMap map{value};
  PlantSpec plant;
  const unsigned end = memory_end(config);
  plant.set_point = parse_place(map.need("set_point"), 2, end);
  const YamlValue measured = map.need("measured");
  plant.measured = parse_place(measured, 4, end);
  if (plant.measured % 4 != 0) measured.refuse("a multiple of 4: current and voltage are one word");
  map.finish();
  user.plant = plant;
}

void parse_when(YamlMap &map, UserSpec &user) {
  map.with("after", [&](const YamlValue &v) {
    if (v.text() != "apply") v.refuse("apply");
    user.after_apply = true;
  });
  if (user.after_apply) {
    map.with("delay", [&](const YamlValue &v) { user.at = v.time(1, kSecond); });
    user.at = std::max(user.at, Time{1});
  } else {
    map.with("at", [&](const YamlValue &v) { user.at = v.time(0, kLongestTime); });
    map.with("period",
             [&](const YamlValue &v) { user.period = v.time(kMicrosecond, kLongestTime); });
  }
  const bool repeats = user.after_apply || user.period != 0;
  map.with("count", [&](const YamlValue &v) {
    user.count = parse_count(v, repeats, "a 'period' or 'after'");
  });
}

/// Whether producer entry `k` is on from the start (RN-63).
bool is_on(const RemoteRole &role, unsigned k) {
  const unsigned mode = remote_map::kProducers + 8 * k + 1;
  return std::any_of(role.memory.begin(), role.memory.end(), [mode](const auto &bytes) {
    const auto &[first, data] = bytes;
    return mode >= first && mode < first + data.size() && (data[mode - first] & 0x80) != 0;
  });
}

/// Whether somebody may write the tables of a node later: unlocks it, or is a program.
bool tables_may_change(const Scenario &scenario, const RemoteConfig &config) {
  const unsigned a = (1U << config.address_bits()) - 1;
  const unsigned setup = config.first_port() + static_cast<unsigned>(RemotePort::kSetup);
  const auto unlocks = [&](const Frame &frame) {
    return !frame.extended && !frame.remote && (frame.id & a) == setup;
  };
  return std::any_of(scenario.nodes.begin(), scenario.nodes.end(),
                     [](const NodeSpec &node) {
                       return !std::holds_alternative<TrafficRole>(node.role) &&
                              !std::holds_alternative<RemoteRole>(node.role);
                     }) ||
         std::any_of(scenario.traffic.begin(), scenario.traffic.end(),
                     [&](const TrafficSpec &traffic) { return unlocks(traffic.frame); }) ||
         std::any_of(scenario.commands.begin(), scenario.commands.end(),
                     [&](const RemoteCommandSpec &commands) {
                       return std::any_of(
                           commands.steps.begin(), commands.steps.end(),
                           [&](const RemoteStep &step) { return unlocks(step.frame); });
                     });
}

void parse_event(const YamlValue &value, const RemoteRole &role, const Scenario &scenario,
                 UserSpec &user) {
  if (role.config.num_prod == 0) value.fail("this node has no producers");
  user.event = static_cast<unsigned>(value.integer(0, role.config.num_prod - 1));
  if (!is_on(role, *user.event) && !tables_may_change(scenario, role.config))
    value.fail(fmt::format("producer {} is off; allowed: an entry of 'producers'", *user.event));
}

void parse_actions(YamlMap &map, const RemoteConfig &config, UserSpec &user) {
  const unsigned end = memory_end(config);
  map.with("write", [&](const YamlValue &v) {
    YamlMap bytes{v};
    for (const std::string &key : bytes.keys()) {
      const YamlValue one = bytes.need(key);
      const unsigned at = parse_address(key, one, end);
      add_bytes(one, at, parse_bytes(one, end - at), user.write);
    }
  });
  map.with("ramp", [&](const YamlValue &v) { user.ramp = parse_place(v, 2, end); });
  if (user.ramp) {
    map.with("from",
             [&](const YamlValue &v) { user.from = static_cast<unsigned>(v.integer(0, 0xFFFF)); });
    map.with("step",
             [&](const YamlValue &v) { user.step = static_cast<unsigned>(v.integer(1, 0xFFFF)); });
  }
  map.with("plant", [&](const YamlValue &v) { parse_plant(v, config, user); });
}

}  // namespace

NodeId parse_remote_name(const YamlValue &value, const Scenario &scenario) {
  const NodeId id = parse_node_name(value, scenario);
  if (!std::holds_alternative<RemoteRole>(scenario.nodes[id].role))
    value.fail(in_quotes(value.text()) + " is no remote node; allowed: nodes of 'type: remote'");
  return id;
}

UserSpec parse_user(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  UserSpec user;
  user.node = parse_remote_name(map.need("node"), scenario);
  const auto &role = std::get<RemoteRole>(scenario.nodes[user.node].role);
  parse_when(map, user);
  parse_actions(map, role.config, user);
  map.with("event", [&](const YamlValue &v) { parse_event(v, role, scenario, user); });
  map.finish();
  if (user.write.empty() && !user.ramp && !user.plant && !user.event)
    value.fail("nothing to do; allowed: write, ramp, plant, event");
  return user;
}

namespace {

constexpr const char *kRemoteNames = "names of remote nodes";

/// Bytes of a node, which must be bytes that it has: others read as 0 for ever.
void parse_expected_bytes(const YamlValue &value, NodeId node, const Scenario &scenario,
                          RemoteExpectations &expect) {
  const NodeSpec &spec = scenario.nodes[node];
  const unsigned end = memory_end(std::get<RemoteRole>(spec.role).config);
  YamlMap places{value};
  for (const std::string &key : places.keys()) {
    const YamlValue one = places.need(key);
    const std::uint64_t at = parse_integer(key).value_or(remote_map::kSize);
    const bool own = at >= remote_map::kNode && at < remote_map::kSize;
    if (at >= end && !own)
      one.fail(fmt::format("{} is no address of node {}; allowed: 0x0 to 0x{:X}, 0x{:X} to 0x{:X}",
                           in_quotes(key), in_quotes(spec.name), end - 1, remote_map::kNode,
                           remote_map::kSize - 1));
    const auto first = static_cast<unsigned>(at);
    expect.memory.push_back(
        {node, first, parse_bytes(one, (own ? remote_map::kSize : end) - first)});
  }
  places.need_some("addresses with their bytes");
}

/// Where nobody is, everything would be as it should.
void need_remote_node(const YamlValue &value, const Scenario &scenario) {
  const bool any = std::any_of(
      scenario.nodes.begin(), scenario.nodes.end(),
      [](const NodeSpec &node) { return std::holds_alternative<RemoteRole>(node.role); });
  if (!any) value.fail("there is no remote node; allowed: with a node of 'type: remote'");
}

}  // namespace

void parse_remote_expectations(YamlMap &map, const Scenario &scenario, RemoteExpectations &expect) {
  map.with("memory", [&](const YamlValue &v) {
    YamlMap nodes{v};
    for (const std::string &name : nodes.keys()) {
      const YamlValue bytes = nodes.need(name);
      const NodeId node =
          parse_remote_name({v.file(), v.key(), YAML::Node(name), bytes.line()}, scenario);
      parse_expected_bytes(bytes, node, scenario, expect);
    }
    nodes.need_some(kRemoteNames);
  });
  for (const char *key : {"refused", "triggers", "lost_set_points", "late_statements"})
    map.with(key, [&](const YamlValue &v) {
      need_remote_node(v, scenario);
      expect.numbers[key] = parse_expected(v, kCounts);
    });
  map.with("trigger_skew", [&](const YamlValue &v) {
    need_remote_node(v, scenario);
    if (v.text() == "bound")
      expect.skew_within_bound = true;
    else
      expect.trigger_skew = v.time(1, kSecond);
  });
  map.with("states", [&](const YamlValue &v) {
    YamlMap nodes{v};
    for (const std::string &name : nodes.keys()) {
      const YamlValue state = nodes.need(name);
      const NodeId node =
          parse_remote_name({v.file(), v.key(), YAML::Node(name), state.line()}, scenario);
      const std::string text = state.text();
      if (text != "INIT" && text != "LISTEN" && text != "SAFE" && text != "OPERATE")
        state.refuse("INIT, LISTEN, SAFE, OPERATE");
      expect.states[node] = text;
    }
    nodes.need_some(kRemoteNames);
  });
}

}  // namespace vericansim::detail
