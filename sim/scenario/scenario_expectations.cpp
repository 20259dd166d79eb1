// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: expectations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scenario/bound_scope.hpp"
#include "scenario/output_pattern.hpp"
#include "scenario/scenario_parts.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::detail {
namespace {

/// Keys of a node that are numbers, and what is not known of nodes with somebody else's software.
constexpr const char *kNumbers[] = {"sent", "received", "overruns", "tec",
                                    "rec",  "max_tec",  "max_rec",  "errors",
                                    "lost", "retries",  "bus_off"};
constexpr std::string_view kOfOurSoftware = "overruns";

constexpr Range kPercent{0, 100};

/// What a number of a node may be. Bus-off counts as TEC 256.
Range possible(std::string_view key) {
  if (key == "tec" || key == "max_tec") return {0, 256, true};
  if (key == "rec" || key == "max_rec") return {0, 255, true};
  return kCounts;
}

void parse_pattern(const YamlValue &value, NodeExpectation &expectation) {
  try {
    static_cast<void>(OutputPattern{value.text()});
  } catch (const std::regex_error &) {
    value.refuse(OutputPattern::kAllowed);
  }
  expectation.matches.push_back(value.text());
}

/// Items of a list, of which there must be one: an empty one would ask for nothing.
std::vector<YamlValue> some_items(const YamlValue &value, const std::string &allowed) {
  std::vector<YamlValue> items = value.items();
  if (items.empty()) value.fail("nothing is in it; allowed: " + allowed);
  return items;
}

/// A finding that is asked for, or not named at all: its opposite is nothing that is looked for.
bool only_true(const YamlValue &value) {
  if (!value.boolean()) value.refuse("true; leave it out where it is not asked for");
  return true;
}

/// The same for bounds, where messages have them.
bool bounds_wanted(const YamlValue &value, const Scenario &scenario) {
  if (const std::string why = why_no_bound(scenario); only_true(value) && !why.empty())
    value.fail("no message has a bound: " + why +
               "; allowed: nodes that send periodic or single 'traffic', the lowest identifier "
               "first, from a buffer for each message");
  return true;
}

void parse_firmware_expectation(YamlMap &map, NodeExpectation &expectation) {
  map.with("exit_code", [&](const YamlValue &v) {
    expectation.exit_code = static_cast<int>(v.integer(0, 0x7FFFFFFF));
  });
  map.with("output", [&](const YamlValue &v) {
    for (const YamlValue &item : some_items(v, "a text, or a list of them"))
      expectation.output.push_back(item.text());
  });
  map.with("matches", [&](const YamlValue &v) {
    for (const YamlValue &item : some_items(v, "a regular expression, or a list of them"))
      parse_pattern(item, expectation);
  });
}

/// `several`: for all nodes, of which some have all of it; what this one does not have is left out.
NodeExpectation parse_node_expectation(const YamlValue &value, const Scenario &scenario,
                                       NodeId node, bool several) {
  const NodeSpec &spec = scenario.nodes[node];
  NodeExpectation expectation;
  expectation.node = node;
  YamlMap map{value};
  for (const char *key : kNumbers) {
    const bool known = key != kOfOurSoftware || spec.hosted();
    if (!known && !several) continue;
    map.with(key, [&](const YamlValue &v) {
      const Range range = parse_expected(v, possible(key));
      if (known) expectation.numbers[key] = range;
    });
  }
  map.with("state", [&](const YamlValue &v) {
    if (v.text() != "active" && v.text() != "passive" && v.text() != "bus-off")
      v.refuse("active, passive, bus-off");
    expectation.state = v.text();
  });
  if (std::holds_alternative<FirmwareRole>(spec.role)) parse_firmware_expectation(map, expectation);
  map.finish();
  map.need_some();
  return expectation;
}

void parse_expected_nodes(const YamlValue &value, const Scenario &scenario, Expectations &expect) {
  YamlMap map{value};
  for (NodeId id = 0; id < scenario.nodes.size(); ++id)
    map.with(scenario.nodes[id].name, [&](const YamlValue &v) {
      expect.nodes.push_back(parse_node_expectation(v, scenario, id, false));
    });
  // `all` stands for every node.
  const bool some_hosted = std::any_of(scenario.nodes.begin(), scenario.nodes.end(),
                                       [](const NodeSpec &node) { return node.hosted(); });
  map.with("all", [&](const YamlValue &v) {
    for (NodeId id = 0; id < scenario.nodes.size(); ++id)
      expect.nodes.push_back(parse_node_expectation(v, scenario, id, some_hosted));
  });
  map.finish();
  map.need_some();
}

void parse_expected_responses(const YamlValue &value, const Scenario &scenario,
                              Expectations &expect) {
  YamlMap map{value};
  for (const TrafficSpec &traffic : scenario.traffic)
    map.with(traffic.name, [&](const YamlValue &v) {
      expect.response_times[traffic.name] = v.time(1, kLongestTime);
    });
  map.finish();
  map.need_some(scenario.traffic.empty() ? "names of messages, and there is no traffic" : "");
}

}  // namespace

Range parse_range(const YamlValue &value, const Range &possible) {
  const auto number = [&](const YamlValue &v) {
    const auto count = possible.whole && v.is_scalar() ? parse_integer(v.text()) : std::nullopt;
    if (count && possible.contains(static_cast<double>(*count))) return static_cast<double>(*count);
    return v.number(possible.least, possible.most);
  };
  if (!value.is_map()) {
    const double exact = number(value);
    if (possible.whole && exact != std::trunc(exact))
      value.refuse("a whole number; nothing is there in parts");
    return {exact, exact};
  }
  Range range;
  YamlMap map{value};
  map.with("min", [&](const YamlValue &v) { range.least = number(v); });
  map.with("max", [&](const YamlValue &v) { range.most = number(v); });
  map.finish();
  map.need_some();
  if (range.least > range.most) value.fail("min is above max");
  return range;
}

Range parse_expected(const YamlValue &value, const Range &possible) {
  const Range range = parse_range(value, possible);
  if (range.least <= possible.least && range.most >= possible.most)
    value.fail("is always met; allowed: a min or max that can be missed");
  return range;
}

Expectations parse_expectations(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  Expectations expect;
  expect.given = true;
  for (const char *key : {"frames", "error_frames", "overload_frames", "pending"})
    map.with(key, [&](const YamlValue &v) { expect.numbers[key] = parse_expected(v, kCounts); });
  map.with("load",
           [&](const YamlValue &v) { expect.numbers["load"] = parse_expected(v, kPercent); });
  map.with("complete", [&](const YamlValue &v) { expect.complete = only_true(v); });
  map.with("within_bound",
           [&](const YamlValue &v) { expect.within_bound = bounds_wanted(v, scenario); });
  map.with("nodes", [&](const YamlValue &v) { parse_expected_nodes(v, scenario, expect); });
  map.with("response_times",
           [&](const YamlValue &v) { parse_expected_responses(v, scenario, expect); });
  parse_remote_expectations(map, scenario, expect.remote);
  map.with("signals", [&](const YamlValue &v) { parse_expected_signals(v, scenario, expect); });
  map.finish();
  return expect;
}

}  // namespace vericansim::detail
