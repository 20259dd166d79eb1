// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// check_traffic: see traffic_check.hpp.
#include "simulation/traffic_check.hpp"

#include <fmt/format.h>

#include <string>

#include "simulation/check_parts.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// Why a message is never sent; empty if it may be.
std::string impossible(const Scenario &scenario, const TrafficSpec &traffic) {
  const NodeId node = traffic.node;
  if (scenario.nodes[node].host.listen_only && !has_accesses(scenario, node))
    return fmt::format("node {} only listens; allowed: nodes without 'listen_only' and 'monitor'",
                       in_quotes(scenario.nodes[node].name));
  if (scenario.nodes[node].host.loop_back && !has_accesses(scenario, node))
    return fmt::format("node {} sends to itself alone; allowed: nodes without 'loop_back'",
                       in_quotes(scenario.nodes[node].name));
  if (!scenario.endless && !scenario.cut_short && !traffic.random_offset &&
      traffic.offset >= scenario.duration)
    return fmt::format(
        "it begins at {}, and nothing is queued from {} on; allowed: 'offset' below the duration, "
        "{}",
        ms_text(traffic.offset), ms_text(scenario.duration), ms_text(scenario.duration));
  return "";
}

}  // namespace

void check_traffic(const Scenario &scenario) {
  for (std::size_t i = 0; i < scenario.traffic.size(); ++i) {
    const TrafficSpec &traffic = scenario.traffic[i];
    if (const std::string why = impossible(scenario, traffic); !why.empty())
      throw InputError(
          scenario.file, traffic.line,
          fmt::format("traffic[{}]: {} can never be sent: {}", i, in_quotes(traffic.name), why));
  }
}

}  // namespace vericansim
