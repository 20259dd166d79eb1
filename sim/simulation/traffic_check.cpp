// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// check_traffic: see traffic_check.hpp.
#include "simulation/traffic_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

std::string ms(Time time) { return plain_number(static_cast<double>(time) / kMillisecond) + " ms"; }

/// Accesses of its CPU may take a node out of the mode.
bool only_listens(const Scenario &scenario, NodeId node) {
  return scenario.nodes[node].host.listen_only &&
         std::none_of(scenario.accesses.begin(), scenario.accesses.end(),
                      [node](const AccessSpec &access) { return access.node == node; });
}

/// Why a message is never sent; empty if it may be.
std::string impossible(const Scenario &scenario, const TrafficSpec &traffic) {
  if (only_listens(scenario, traffic.node))
    return fmt::format("node {} only listens; allowed: nodes without 'listen_only' and 'monitor'",
                       in_quotes(scenario.nodes[traffic.node].name));
  if (!scenario.endless && !scenario.cut_short && !traffic.random_offset &&
      traffic.offset >= scenario.duration)
    return fmt::format(
        "it begins at {}, and nothing is queued from {} on; allowed: 'offset' below the duration, "
        "{}",
        ms(traffic.offset), ms(scenario.duration), ms(scenario.duration));
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
