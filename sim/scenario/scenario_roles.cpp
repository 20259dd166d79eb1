// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: the kinds of nodes.
#include <filesystem>

#include "scenario/scenario_parts.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::detail {
namespace {

/// A file that a scenario names: relative to the scenario's own folder.
std::string file_of(const YamlValue &value) {
  const std::string path = value.text();
  if (path.empty()) value.refuse("the name of a file");
  return (std::filesystem::path{value.file()}.parent_path() / path).lexically_normal().string();
}

FirmwareRole parse_firmware(const YamlValue &value, YamlMap &map) {
  FirmwareRole role;
  role.file = file_of(value);
  map.with("clocks_per_instruction", [&](const YamlValue &v) {
    role.clocks_per_instruction = static_cast<unsigned>(v.integer(1, 100));
  });
  map.with("run_hard_fault_handler",
           [&](const YamlValue &v) { role.run_hard_fault_handler = v.boolean(); });
  return role;
}

SecondCoreRole parse_second_core(const YamlValue &value, const Scenario &scenario) {
  for (const NodeSpec &other : scenario.nodes) {
    const auto *second = std::get_if<SecondCoreRole>(&other.role);
    if (second != nullptr && second->board == value.text())
      value.fail("the board " + in_quotes(value.text()) +
                 " has its second core already: " + in_quotes(other.name));
  }
  for (const NodeSpec &other : scenario.nodes)
    if (other.name == value.text() && std::holds_alternative<FirmwareRole>(other.role))
      return {value.text()};
  value.refuse("the name of a node above that has firmware");
}

IdFilter parse_id_filter(const YamlValue &value) {
  try {
    return vericansim::parse_filter(value.text());
  } catch (const InputError &) {
    value.refuse(
        "ID:MASK or ID~MASK (all but these), hexadecimal, as in 100:7F0; above 7FF eight digits");
  }
}

void parse_filters(YamlMap &map, std::vector<IdFilter> &filters) {
  map.with("filter", [&](const YamlValue &v) {
    for (const YamlValue &item : v.items()) filters.push_back(parse_id_filter(item));
    if (filters.empty())
      v.fail("nothing is in it; allowed: one at least, or no 'filter' for any frame");
  });
}

/// "2/3": the second of three.
void parse_share(const YamlValue &value, ReplayRole &role) {
  const std::string text = value.text();
  const std::size_t slash = text.find('/');
  const auto part = parse_integer(text.substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : parse_integer(text.substr(slash + 1));
  if (!part || !of || *of > Bus::kMaxNodes || *part < 1 || *part > *of)
    value.refuse("a part of 1 to 64, as in 2/3");
  role.share = static_cast<unsigned>(*part - 1);
  role.shares = static_cast<unsigned>(*of);
}

ReplayRole parse_replay(const YamlValue &value, YamlMap &map) {
  ReplayRole role;
  role.file = file_of(value);
  map.with("channel", [&](const YamlValue &v) {
    role.channel = v.text();
    if (role.channel.empty()) v.refuse("the name of an interface, or no 'channel' for all of them");
  });
  map.with("start", [&](const YamlValue &v) { role.start = v.time(0, kLongestTime); });
  map.with("from", [&](const YamlValue &v) { role.from = v.time(0, kLongestTime); });
  map.with("to", [&](const YamlValue &v) { role.to = v.time(role.from, kLongestTime); });
  map.with("rate", [&](const YamlValue &v) {
    role.saturated = v.is_scalar() && v.text() == "saturated";
    if (!role.saturated) role.rate = v.number(0.001, 1000);
  });
  map.with("loop", [&](const YamlValue &v) { role.loop = v.boolean(); });
  map.with("frames", [&](const YamlValue &v) { role.frames = v.integer(1, 1'000'000'000); });
  map.with("share", [&](const YamlValue &v) { parse_share(v, role); });
  parse_filters(map, role.filters);
  return role;
}

void parse_programs(YamlMap &map, ProgramSettings &programs) {
  parse_filters(map, programs.filters);
  map.with("errors", [&](const YamlValue &v) {
    programs.errors = v.text();
    if (programs.errors != "none" && programs.errors != "state" && programs.errors != "own")
      v.refuse("none, state, own");
  });
  map.with("restart", [&](const YamlValue &v) { programs.restart = v.time(0, kLongestTime); });
}

InterfaceRole parse_interface(const YamlValue &value, YamlMap &map) {
  InterfaceRole role;
  role.interface = value.text();
  parse_programs(map, role.programs);
  map.with("echo", [&](const YamlValue &v) { role.echo = v.boolean(); });
  map.with("queue", [&](const YamlValue &v) { role.queue = v.integer(1, 100'000'000); });
  map.with("end_when_down", [&](const YamlValue &v) { role.end_when_down = v.boolean(); });
  return role;
}

SocketcandRole parse_socketcand(const YamlValue &value, YamlMap &map) {
  SocketcandRole role;
  role.address = value.text();
  parse_programs(map, role.programs);
  map.with("wait_for_clients", [&](const YamlValue &v) {
    role.wait_for_clients = static_cast<unsigned>(v.integer(0, 64));
  });
  return role;
}

}  // namespace

std::optional<ListenerSpec> parse_listener(const YamlValue &value) {
  YamlMap map{value};
  const auto monitor = map.find("monitor");
  if (!monitor || !monitor->is_scalar() || monitor->as_boolean()) return std::nullopt;
  ListenerSpec listener{monitor->text(), MonitorRole{monitor->text()}, value.line()};
  map.with("name", [&](const YamlValue &v) { listener.name = v.name(); });
  map.finish();
  return listener;
}

NodeRole parse_role(YamlMap &map, const Scenario &scenario) {
  NodeRole role;
  std::string kind;
  const auto is = [&](const char *key, auto parse) {
    map.with(key, [&](const YamlValue &v) {
      if (!kind.empty()) v.fail("a node is of one kind, and this one has '" + kind + "'");
      kind = key;
      role = parse(v);
    });
  };
  is("firmware", [&](const YamlValue &v) { return parse_firmware(v, map); });
  is("replay", [&](const YamlValue &v) { return parse_replay(v, map); });
  is("interface", [&](const YamlValue &v) { return parse_interface(v, map); });
  is("socketcand", [&](const YamlValue &v) { return parse_socketcand(v, map); });
  is("type", [&](const YamlValue &v) { return parse_remote(v, map); });
  is("second_core_of", [&](const YamlValue &v) { return parse_second_core(v, scenario); });
  return role;
}

}  // namespace vericansim::detail
