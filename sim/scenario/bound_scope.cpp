// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See bound_scope.hpp.
#include "scenario/bound_scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "model/same_identifier.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

unsigned messages_of(const Scenario &scenario, NodeId id) {
  return static_cast<unsigned>(
      std::count_if(scenario.traffic.begin(), scenario.traffic.end(),
                    [id](const TrafficSpec &traffic) { return traffic.node == id; }));
}

template <typename List>
bool any_of_node(const List &list, NodeId id) {
  return std::any_of(list.begin(), list.end(), [id](const auto &spec) { return spec.node == id; });
}

/// What node `id` sends beside traffic, when nobody knows; empty: nothing.
std::string other_frames(const Scenario &scenario, NodeId id) {
  const NodeRole &role = scenario.nodes[id].role;
  if (!std::holds_alternative<TrafficRole>(role))
    return fmt::format("with '{}' sends of its own", name_of(role));
  if (any_of_node(scenario.commands, id)) return "sends 'commands'";
  if (any_of_node(scenario.accesses, id)) return "has 'accesses', which may send";
  return "";
}

/// Why node `id` may keep an urgent frame behind another one; empty: it does not.
std::string wrong_order(const Scenario &scenario, NodeId id) {
  const unsigned messages = messages_of(scenario, id);
  if (messages < 2) return "";
  if (scenario.nodes[id].host.lowest_buffer_first) return "has 'lowest_buffer_first'";
  const unsigned buffers = transmit_buffers(scenario, id);
  if (buffers >= messages) return "";
  return fmt::format("has {} for {} messages",
                     text::counted(buffers, "transmit buffer", "transmit buffers"), messages);
}

/// Two messages of which the analysis would put one before the other; empty: there are none.
std::string one_identifier(const std::vector<TrafficSpec> &traffic) {
  for (std::size_t i = 0; i < traffic.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same_identifier(traffic[i].frame, traffic[j].frame))
        return fmt::format("messages '{}' and '{}' have one identifier", traffic[j].name,
                           traffic[i].name);
  return "";
}

}  // namespace

unsigned transmit_buffers(const Scenario &scenario, NodeId id) {
  constexpr std::size_t kLeastReceive = 8;
  const NodeSpec &node = scenario.nodes[id];
  if (node.host.tx_buffers != 0) return node.host.tx_buffers;
  // Commands leave in their order (RN-94).
  if (any_of_node(scenario.commands, id)) return 1;
  const auto receive = static_cast<unsigned>(std::max(node.host.filters.size(), kLeastReceive));
  return std::clamp(messages_of(scenario, id), 1U, node.num_mb - receive);
}

std::string why_no_bound(const Scenario &scenario) {
  for (const TrafficSpec &traffic : scenario.traffic)
    if (traffic.saturated) return fmt::format("message '{}' is saturated", traffic.name);
  for (NodeId id = 0; id < scenario.nodes.size(); ++id)
    for (const std::string &why : {other_frames(scenario, id), wrong_order(scenario, id)})
      if (!why.empty()) return fmt::format("node '{}' {}", scenario.nodes[id].name, why);
  return one_identifier(scenario.traffic);
}

}  // namespace vericansim
