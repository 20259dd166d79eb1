// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// check_faults: see fault_check.hpp.
#include "simulation/fault_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "results/fault_report.hpp"
#include "scenario/fault_words.hpp"
#include "simulation/check_parts.hpp"
#include "simulation/expected_frames.hpp"
#include "simulation/node_timing.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

using Kind = FaultSpec::Kind;

bool has_traffic(const Scenario &scenario, NodeId node) {
  return std::any_of(scenario.traffic.begin(), scenario.traffic.end(),
                     [node](const TrafficSpec &traffic) { return traffic.node == node; });
}

/// The node does nothing but what the scenario says of its traffic.
bool is_plain(const Scenario &scenario, NodeId node) {
  return scenario.nodes[node].hosted() && !has_accesses(scenario, node);
}

/// Why the node of a place never comes to it, whatever happens on the bus; empty if it may.
std::string never_there(const Scenario &scenario, const FaultSpec &fault) {
  const NodeSpec &node = scenario.nodes[fault.watched];
  const std::optional<Field> &field = fault.place.field;
  const bool alone = std::holds_alternative<TrafficRole>(node.role) && !node.software &&
                     !has_accesses(scenario, fault.watched);
  if (alone && field != Field::kInteg)
    return fmt::format(
        "nobody works '{}', so it never joins the bus; allowed: a node with software", node.name);
  if (!is_plain(scenario, fault.watched)) return "";
  const bool sends = has_traffic(scenario, fault.watched);
  if (!sends && (field == Field::kSof || field == Field::kSuspend))
    return fmt::format(
        "{} is a place of senders, and '{}' has no traffic; allowed: a node that "
        "sends, or the fields of receivers, from ID on",
        field_name(*field), node.name);
  return "";
}

/// Why a fault begins behind the bits that its node has by its timing; empty if it does not. A bit
/// that synchronisation makes longer has such quanta, but nobody can say which bit that will be.
std::string behind_the_bit(const Scenario &scenario, const FaultSpec &fault, double bitrate) {
  if (fault.kind != Kind::kPlace || !is_plain(scenario, fault.watched)) return "";
  const NodeSpec &node = scenario.nodes[fault.watched];
  const unsigned quanta = timing_of(scenario, node, bitrate).quanta();
  if (fault.first_quantum.value_or(0) < quanta) return "";
  return fmt::format("a bit of '{}' has {} quanta at {} bit/s; allowed: first_tq 0 to {}",
                     node.name, quanta, plain_number(bitrate), quanta - 1);
}

/// Why a fault can have no effect, whatever else happens on the bus; empty if it may.
std::string impossible(const Scenario &scenario, const FaultSpec &fault) {
  if (fault.kind == Kind::kPlace) return never_there(scenario, fault);
  const bool all_plain = std::all_of(
      scenario.nodes.begin(), scenario.nodes.end(),
      [](const NodeSpec &node) { return std::holds_alternative<TrafficRole>(node.role); });
  const Time end = scenario.duration + scenario.drain;
  if (all_plain && !scenario.endless && !scenario.cut_short && fault.window.from >= end)
    return fmt::format(
        "it begins at {}, and the run is over after {}; allowed: 'from' below "
        "duration and drain, {}",
        ms_text(fault.window.from), ms_text(end), ms_text(end));
  if (fault.kind == Kind::kCut && scenario.nodes.size() == 1)
    return fmt::format("'{}' is alone on the bus; allowed: a bus of two nodes or more",
                       scenario.nodes.front().name);
  return "";
}

}  // namespace

void check_faults(const Scenario &scenario, double bitrate) {
  const auto fail = [&](std::size_t index, const char *what, const std::string &why) {
    throw InputError(
        scenario.file, scenario.faults[index].line,
        fmt::format("faults[{}]: '{}' {}: {}", index, fault_name(scenario, index), what, why));
  };
  const auto refuse = [&](std::size_t index, const std::string &why) {
    fail(index, "can never hit", why);
  };
  for (std::size_t i = 0; i < scenario.faults.size(); ++i) {
    const std::string why = impossible(scenario, scenario.faults[i]);
    if (!why.empty()) refuse(i, why);
    const std::string behind = behind_the_bit(scenario, scenario.faults[i], bitrate);
    if (!behind.empty()) fail(i, "begins behind the bit", behind);
  }
  if (scenario.faults.empty()) return;
  const ExpectedFrames frames{scenario, bitrate};
  if (!frames.known()) return;
  // None of them is the first to hit if all need what undisturbed frames do not have.
  std::string first;
  for (const FaultSpec &fault : scenario.faults) {
    const std::string why = fault.kind == Kind::kPlace ? frames.missing(fault.place) : "";
    if (why.empty()) return;
    if (first.empty()) first = why;
  }
  refuse(0, first);
}

}  // namespace vericansim
