// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: parts that have files of their own; shared only by scenario_*.cpp.
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/yaml_value.hpp"

namespace vericansim::detail {

/// A node by its name; refuses others with a list of the names.
[[nodiscard]] NodeId parse_node_name(const YamlValue &value, const Scenario &scenario);

/// An item of `nodes` that is no node: `{monitor: vcan1}`; nothing if it is one.
[[nodiscard]] std::optional<ListenerSpec> parse_listener(const YamlValue &value);

/// What a number on which something is expected may be; how often something comes.
inline constexpr Range kAnyNumber{-1e15, 1e15}, kCounts{0, 1e15, true};
/// A number, or `{min: 1, max: 9}`, within `possible`.
[[nodiscard]] Range parse_range(const YamlValue &value, const Range &possible = kAnyNumber);
/// The same, but not all that is possible: nothing would be asked for.
[[nodiscard]] Range parse_expected(const YamlValue &value, const Range &possible);
/// How often something comes; more than once only if it `repeats`, which `with` would bring about.
[[nodiscard]] std::uint64_t parse_count(const YamlValue &value, bool repeats,
                                        std::string_view with = "a 'period'");
/// What kind of node it is, with the keys of that kind.
[[nodiscard]] NodeRole parse_role(YamlMap &map, const Scenario &scenario);
/// The keys of a node of `type: remote`.
[[nodiscard]] RemoteRole parse_remote(const YamlValue &value, YamlMap &map);
/// Keys `timing`, `bitrate`, `sample_point`, `sjw` of a node whose clock is known.
void parse_bit(YamlMap &map, NodeSpec &node, const std::vector<double> &bitrates);
[[nodiscard]] NodeSpec parse_node(const YamlValue &value, const Scenario &scenario);
[[nodiscard]] TrafficSpec parse_traffic(const YamlValue &value, const Scenario &scenario);
[[nodiscard]] FaultSpec parse_fault(const YamlValue &value, const Scenario &scenario);
/// Refuses two faults of one name.
void check_fault_names(const Scenario &scenario);
/// `judge`: refused where a node has no registers to be judged.
void parse_judge(const YamlValue &value, Scenario &scenario);
[[nodiscard]] RemoteCommandSpec parse_commands(const YamlValue &value, const Scenario &scenario);
[[nodiscard]] UserSpec parse_user(const YamlValue &value, const Scenario &scenario);
/// The keys of `expect` that are about remote nodes.
void parse_remote_expectations(YamlMap &map, const Scenario &scenario, RemoteExpectations &expect);
[[nodiscard]] AccessSpec parse_access(const YamlValue &value, const Scenario &scenario);
[[nodiscard]] Expectations parse_expectations(const YamlValue &value, const Scenario &scenario);

/// Reads the databases of `dbc`.
void parse_databases(YamlMap &map, Scenario &scenario);
/// `message`: sets name, identifier and length as the database has them; nullptr without.
const SignalMessage *parse_message(YamlMap &map, const Scenario &scenario, TrafficSpec &traffic);
/// `data` as values of signals.
void parse_signals(const YamlValue &value, const SignalMessage &message, Frame &frame);
void parse_expected_signals(const YamlValue &value, const Scenario &scenario, Expectations &expect);

inline constexpr Time kLongestTime = 1'000'000 * kSecond;

}  // namespace vericansim::detail
