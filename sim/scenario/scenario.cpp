// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: the file as a whole, and its nodes.
#include "scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenario/scenario_parts.hpp"
#include "scenario/scenario_text.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace detail {
namespace {

void parse_wander(const YamlValue &value, ClockConfig &clock) {
  YamlMap map{value};
  const YamlValue kind = map.need("kind");
  if (kind.text() == "sine")
    clock.wander = Wander::kSine;
  else if (kind.text() == "walk")
    clock.wander = Wander::kWalk;
  else
    kind.refuse("sine, walk");
  clock.wander_ppm = map.need("ppm").number(0, 50'000);
  map.with("period",
           [&](const YamlValue &v) { clock.wander_period = v.time(kMicrosecond, 1000 * kSecond); });
  map.finish();
}

RxFilter parse_filter(const YamlValue &value) {
  YamlMap map{value};
  RxFilter filter;
  map.with("extended", [&](const YamlValue &v) { filter.extended = v.boolean(); });
  const std::uint32_t highest = filter.extended ? 0x1FFFFFFF : 0x7FF;
  filter.id = static_cast<std::uint32_t>(map.need("id").integer(0, highest));
  filter.mask = highest;
  map.with("mask", [&](const YamlValue &v) {
    filter.mask = static_cast<std::uint32_t>(v.integer(0, highest));
  });
  map.with("remote", [&](const YamlValue &v) {
    filter.remote = v.boolean();
    filter.match_remote = true;
  });
  filter.match_format = true;
  map.with("match_format", [&](const YamlValue &v) { filter.match_format = v.boolean(); });
  map.finish();
  return filter;
}

void parse_clock(YamlMap &map, ClockConfig &clock) {
  map.with("clock", [&](const YamlValue &v) { clock.frequency_hz = v.frequency(1e5, 1e9); });
  map.with("ppm", [&](const YamlValue &v) { clock.error_ppm = v.number(-50'000, 50'000); });
  map.with("phase", [&](const YamlValue &v) { clock.phase = v.time(0, kMillisecond); });
  map.with("wander", [&](const YamlValue &v) { parse_wander(v, clock); });
}

/// Of a core whose clock is that of its board.
void refuse_clock(YamlMap &map) {
  for (const char *key : {"clock", "ppm", "phase", "wander"})
    map.with(key, [](const YamlValue &v) { v.fail("is that of the board; allowed: there alone"); });
}

void parse_link(YamlMap &map, Link &link) {
  map.with("cable", [&](const YamlValue &v) { link.cable = cable_delay(v.length(10'000)); });
  map.with("delay", [&](const YamlValue &v) {
    if (map.find("cable")) v.fail("'cable' is given too; allowed: one of them");
    link.cable = v.time(0, kMillisecond);
  });
  map.with("tx_delay", [&](const YamlValue &v) { link.transmitter = v.time(0, kMillisecond); });
  map.with("rx_delay", [&](const YamlValue &v) { link.receiver = v.time(0, kMillisecond); });
}

void parse_host(YamlMap &map, NodeSpec &node) {
  HostConfig &host = node.host;
  const auto flag = [&](const char *key, bool &target) {
    map.with(key, [&](const YamlValue &v) { target = v.boolean(); });
  };
  flag("listen_only", host.listen_only);
  flag("loop_back", host.loop_back);
  flag("self_reception", host.self_reception);
  flag("fd_tolerant", host.fd_tolerant);
  flag("triple_sampling", host.triple_sampling);
  flag("lowest_buffer_first", host.lowest_buffer_first);
  map.with("bus_off_recovery", [&](const YamlValue &v) {
    if (v.text() != "automatic" && v.text() != "never") v.refuse("automatic, never");
    host.boff_rec = v.text() == "never";
  });
  map.with("filters", [&](const YamlValue &v) {
    for (const YamlValue &item : v.items()) host.filters.push_back(parse_filter(item));
    if (host.filters.empty())
      v.fail("nothing is in it; allowed: one at least, or no 'filters' for any frame");
  });
}

void parse_software(YamlMap &map, NodeSpec &node) {
  map.with("software", [&](const YamlValue &v) {
    if (v.text() != "host" && v.text() != "none") v.refuse("host, none");
    node.software = v.text() == "host";
  });
}

void parse_buffers(YamlMap &map, NodeSpec &node) {
  map.with("tx_buffers", [&](const YamlValue &v) {
    node.host.tx_buffers = static_cast<unsigned>(v.integer(1, 62));
  });
}

// A node that hears and says nothing.
void parse_monitor(YamlMap &map, HostConfig &host) {
  map.with("monitor", [&](const YamlValue &v) {
    if (map.find("listen_only")) v.fail("'listen_only' is given too; allowed: one of them");
    host.listen_only = v.boolean();
  });
}

void parse_mailboxes(YamlMap &map, NodeSpec &node) {
  map.with("mailboxes", [&](const YamlValue &v) {
    const auto count = v.is_scalar() ? parse_integer(v.text()) : std::nullopt;
    if (count != 16 && count != 32 && count != 64) v.refuse("16, 32, 64");
    node.num_mb = static_cast<unsigned>(*count);
  });
}

void check_buffers(const YamlValue &value, const NodeSpec &node) {
  const std::size_t receive = std::max<std::size_t>(node.host.filters.size(), 1);
  const unsigned transmit = std::max(node.host.tx_buffers, 1U);
  if (transmit + receive > node.num_mb)
    value.fail(fmt::format("{} transmit and {} receive buffers are more than the {} of the node",
                           transmit, receive, node.num_mb));
}

}  // namespace

NodeSpec parse_node(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  NodeSpec node;
  node.line = value.line();
  node.host.tx_buffers = 0;               // one for each message of the node
  node.host.lowest_buffer_first = false;  // lowest identifier first, as on the bus
  const YamlValue name = map.need("name");
  node.name = name.name();
  if (node.name.empty()) name.refuse("a name of at least one letter");
  if (node.name == "all") name.refuse("other names; 'all' stands for every node");
  for (const NodeSpec &other : scenario.nodes)
    if (other.name == node.name) value.fail("node name " + in_quotes(node.name) + " is used twice");
  node.clock.seed = scenario.seed * 1000 + scenario.nodes.size();
  parse_clock(map, node.clock);
  parse_link(map, node.link);
  node.role = parse_role(map, scenario);
  const bool plain = std::holds_alternative<TrafficRole>(node.role);
  if (plain) parse_software(map, node);
  if (node.hosted()) parse_host(map, node);
  if (node.hosted() && plain) {
    parse_buffers(map, node);
    parse_monitor(map, node.host);
  }
  parse_bit(map, node, scenario.bitrates);
  if (!std::holds_alternative<RemoteRole>(node.role)) parse_mailboxes(map, node);
  map.finish();
  if (const auto *second = std::get_if<SecondCoreRole>(&node.role)) {
    refuse_clock(map);
    for (const NodeSpec &board : scenario.nodes)
      if (board.name == second->board) node.clock = board.clock;
  }
  check_buffers(value, node);
  return node;
}

NodeId parse_node_name(const YamlValue &value, const Scenario &scenario) {
  std::string names;
  for (NodeId id = 0; id < scenario.nodes.size(); ++id) {
    if (scenario.nodes[id].name == value.text()) return id;
    names += (names.empty() ? "" : ", ") + scenario.nodes[id].name;
  }
  value.refuse("the name of a node: " + names);
}

}  // namespace detail

namespace {

void parse_nodes(const YamlValue &list, Scenario &scenario) {
  for (const YamlValue &item : list.items()) {
    if (auto listener = detail::parse_listener(item)) {
      scenario.listeners.push_back(std::move(*listener));
      continue;
    }
    if (scenario.nodes.size() >= Bus::kMaxNodes)
      item.fail(fmt::format("more than {} nodes", Bus::kMaxNodes));
    scenario.nodes.push_back(detail::parse_node(item, scenario));
  }
  if (scenario.nodes.empty()) list.fail("no node is given; allowed: 1 to 64");
}

void parse_outputs(const YamlValue &value, Outputs &outputs) {
  YamlMap map{value};
  const auto file = [&](const char *key, std::string &target) {
    map.with(key, [&](const YamlValue &v) {
      target = v.text();
      if (target.empty()) v.refuse("the name of a file");
    });
  };
  file("vcd", outputs.vcd);
  file("fst", outputs.fst);
  file("candump", outputs.candump);
  file("pcap", outputs.pcap);
  file("report", outputs.report);
  file("ids_csv", outputs.ids_csv);
  file("signals_csv", outputs.signals_csv);
  map.with("signals_csv", [&](const YamlValue &v) {
    if (!outputs.database) v.fail("needs a database; allowed: 'dbc' in the scenario");
  });
  map.finish();
}

void parse_general(YamlMap &map, Scenario &scenario) {
  map.with("name", [&](const YamlValue &v) { scenario.name = v.name(); });
  map.with("bitrate", [&](const YamlValue &v) {
    scenario.bitrates.clear();
    for (const YamlValue &item : v.items()) {
      const double rate = item.bitrate();
      if (std::ranges::find(scenario.bitrates, rate) != scenario.bitrates.end())
        item.fail("is there twice; allowed: each bit rate once");
      scenario.bitrates.push_back(rate);
    }
    if (scenario.bitrates.empty()) v.refuse("a bit rate, or a list of them");
  });
  map.with("sample_point", [&](const YamlValue &v) { scenario.sample_point = v.part(0.5, 0.9); });
  map.with("duration", [&](const YamlValue &v) {
    scenario.duration = v.time(kShortestDuration, kLongestDuration);
  });
  map.with("drain", [&](const YamlValue &v) { scenario.drain = v.time(0, 1000 * kSecond); });
  map.with("seed", [&](const YamlValue &v) { scenario.seed = v.integer(0, 0xFFFFFFFF); });
  map.with("analysis", [&](const YamlValue &v) { scenario.analysis = v.boolean(); });
}

// With programs as nodes a scenario is held to real time and has no end, with a recording it ends
// when that has been sent, unless the file says otherwise.
void parse_end(YamlMap &map, Scenario &scenario) {
  const bool programs = detail::any_programs(scenario);
  scenario.pacing = programs ? Pacing::kRealTime : Pacing::kFast;
  map.with("pacing", [&](const YamlValue &v) {
    if (v.text() != "real_time" && v.text() != "fast") v.refuse("real_time, fast");
    scenario.pacing = v.text() == "real_time" ? Pacing::kRealTime : Pacing::kFast;
  });
  const bool finite = detail::any_finite_replay(scenario);
  bool looped = false, firmware = false;
  for (const NodeSpec &node : scenario.nodes) {
    const auto *replay = std::get_if<ReplayRole>(&node.role);
    looped = looped || (replay != nullptr && replay->loop);
    firmware = firmware || std::holds_alternative<FirmwareRole>(node.role);
  }
  const bool limited = map.find("duration").has_value();
  scenario.endless = !limited && (programs || finite);
  scenario.until_done = !limited && finite && !programs;
  if (looped && !limited && !scenario.endless)
    map.value().fail("a recording in a loop has no end; the scenario needs a 'duration'");
  map.with("end", [&](const YamlValue &v) {
    if (v.text() != "time" && v.text() != "done") v.refuse("time, done");
    scenario.until_done = v.text() == "done";
    if (scenario.until_done && !finite && !firmware)
      v.fail("'done' needs a node that comes to an end: with firmware, or a replay without loop");
    if (!scenario.until_done && !limited && !programs) v.fail("'time' needs a 'duration'");
    scenario.done_given = scenario.until_done;
  });
}

template <typename Item>
void parse_each(YamlMap &map, const char *key, const Scenario &scenario, std::vector<Item> &items,
                Item (*parse)(const YamlValue &, const Scenario &)) {
  map.with(key, [&](const YamlValue &list) {
    for (const YamlValue &item : list.items()) items.push_back(parse(item, scenario));
  });
}

}  // namespace

Scenario parse_scenario(const std::string &path, const std::string &text) {
  YamlMap map{YamlValue::parse(path, text)};
  Scenario scenario;
  scenario.file = path;
  scenario.name = path;
  parse_general(map, scenario);
  detail::parse_databases(map, scenario);
  parse_nodes(map.need("nodes"), scenario);
  parse_end(map, scenario);
  parse_each(map, "traffic", scenario, scenario.traffic, detail::parse_traffic);
  map.with("faults", [&](const YamlValue &list) {
    for (const YamlValue &item : list.items())
      scenario.faults.push_back(detail::parse_fault(item, scenario));
    detail::check_fault_names(scenario);
  });
  parse_each(map, "accesses", scenario, scenario.accesses, detail::parse_access);
  parse_each(map, "commands", scenario, scenario.commands, detail::parse_commands);
  parse_each(map, "user", scenario, scenario.user, detail::parse_user);
  map.with("judge", [&](const YamlValue &v) { detail::parse_judge(v, scenario); });
  map.with("expect",
           [&](const YamlValue &v) { scenario.expect = detail::parse_expectations(v, scenario); });
  map.with("outputs", [&](const YamlValue &v) { parse_outputs(v, scenario.outputs); });
  map.finish();
  return scenario;
}

Scenario read_scenario(const std::string &path) {
  return parse_scenario(path, read_text_file(path, kMostWritten));
}

NodeId find_or_add_node(Scenario &scenario, const std::string &name, double clock_hz) {
  for (NodeId id = 0; id < scenario.nodes.size(); ++id)
    if (scenario.nodes[id].name == name) return id;
  if (scenario.nodes.size() >= Bus::kMaxNodes)
    throw InputError(
        scenario.file, 0,
        fmt::format("no room for node '{}': a bus takes {} nodes", name, Bus::kMaxNodes));
  NodeSpec node;
  node.name = name;
  node.clock.frequency_hz = clock_hz;
  scenario.nodes.push_back(node);
  return static_cast<NodeId>(scenario.nodes.size() - 1);
}

NodeId take_node(Scenario &scenario, const std::string &name, const std::string &user,
                 double clock_hz) {
  const NodeId id = find_or_add_node(scenario, name, clock_hz);
  const NodeSpec &node = scenario.nodes[id];
  if (!std::holds_alternative<TrafficRole>(node.role))
    throw InputError(
        scenario.file, node.line,
        fmt::format("node '{}', which {}, has '{}' in the file; allowed: a plain node, "
                    "or none of this name",
                    name, user, name_of(node.role)));
  for (const TrafficSpec &traffic : scenario.traffic)
    if (traffic.node == id)
      throw InputError(scenario.file, 0,
                       fmt::format("traffic '{}' is that of node '{}', which {}; allowed: the "
                                   "other nodes",
                                   traffic.name, name, user));
  return id;
}

NodeId take_core(Scenario &scenario, const std::string &name, const std::string &user,
                 double clock_hz) {
  const NodeId id = take_node(scenario, name, user, clock_hz);
  const NodeSpec &node = scenario.nodes[id];
  if (node.line == 0) return id;  // in no file
  std::string keys = detail::host_text(node.host);
  if (!node.software) keys += ", software: none";
  if (keys.empty()) return id;
  throw InputError(scenario.file, node.line,
                   fmt::format("node '{}', which {}, has '{}'; allowed: no keys of the "
                               "simulation's own software",
                               name, user, keys.substr(2)));
}

NodeId take_buffers(Scenario &scenario, const std::string &name, const std::string &user,
                    double clock_hz) {
  const NodeId id = take_core(scenario, name, user, clock_hz);
  for (const AccessSpec &access : scenario.accesses)
    if (access.node == id && writes_buffers(access))
      throw InputError(scenario.file, scenario.nodes[id].line,
                       fmt::format("'accesses' write buffers of node '{}', which {}; allowed: {}",
                                   name, user, kBesidePrograms));
  return id;
}

}  // namespace vericansim
