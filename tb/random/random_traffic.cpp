// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random buses: what the nodes with software send and want to receive.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

using Key = std::tuple<std::uint32_t, bool, bool>;

/// Bits of a frame with its intermission, about.
unsigned about_bits(const Frame &frame) {
  return (frame.extended ? 74 : 51) + 9 * frame.payload_size();
}

Frame draw_frame(Dice &dice, NodeId node, std::set<Key> &used) {
  Frame frame;
  do {
    frame.extended = dice.per_cent(25);
    frame.remote = dice.per_cent(12);
    frame.id = draw_identifier(dice, node, frame.extended);
  } while (!used.insert({frame.id, frame.extended, frame.remote}).second);
  switch (dice.weighted({60, 22, 12, 6})) {
    case 0: frame.dlc = static_cast<std::uint8_t>(dice.in(0, 1)); break;
    case 1: frame.dlc = static_cast<std::uint8_t>(dice.in(2, 4)); break;
    case 2: frame.dlc = static_cast<std::uint8_t>(dice.in(5, 8)); break;
    default: frame.dlc = static_cast<std::uint8_t>(dice.in(9, 15)); break;
  }
  return frame;
}

void draw_payload(Dice &dice, TrafficSpec &traffic) {
  Frame &frame = traffic.frame;
  if (frame.remote || frame.payload_size() == 0) return;
  traffic.data = DataKind::kCounter;
  if (dice.per_cent(40)) traffic.data = DataKind::kRandom;
  if (!dice.per_cent(20)) return;
  traffic.data = DataKind::kFixed;  // long runs of equal bits
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] =
        static_cast<std::uint8_t>(dice.per_cent(80) ? 0xFF * dice.below(2) : dice.below(256));
}

void draw_filters(Dice &dice, HostConfig &host) {
  if (dice.per_cent(50)) return;
  const unsigned count = dice.in(1, 6);
  for (unsigned i = 0; i < count; ++i) {
    RxFilter filter;
    filter.extended = dice.per_cent(40);
    const std::uint32_t highest = filter.extended ? 0x1FFFFFFF : 0x7FF;
    filter.id = draw_identifier(dice, dice.below(16), filter.extended);
    // Some bits of the whole, or a few of them, or the last ones: a node.
    const unsigned kind = dice.below(3);
    filter.mask = kind == 0 ? highest : kind == 1 ? dice.below(highest) : 0xF;
    filter.match_format = dice.per_cent(30);
    filter.match_remote = filter.match_format;
    filter.remote = filter.match_format && dice.per_cent(20);
    host.filters.push_back(filter);
  }
}

// Buses get equal shares of the computer's time, so that large and idle ones do not take all of it.
Time bits_of_run(const Scenario &scenario, unsigned frames) {
  constexpr std::uint64_t kClocksAFrame = 3000;  // of all nodes together, on a bus of middle size
  std::uint64_t clocks_a_bit = 0;
  for (const NodeSpec &node : scenario.nodes) clocks_a_bit += node.timing->clocks_per_bit();
  return static_cast<Time>(frames * kClocksAFrame / clocks_a_bit);
}

}  // namespace

void draw_traffic(Dice &dice, Scenario &scenario, unsigned frames) {
  const Time bit = bit_time(scenario);
  const unsigned load = dice.in(10, 130);  // per cent, where nothing is saturated
  const bool saturated = dice.per_cent(60);
  std::set<Key> used;
  std::uint64_t bits = 0;
  for (NodeId id = 0; id < scenario.nodes.size(); ++id) {
    NodeSpec &node = scenario.nodes[id];
    if (!node.software) continue;
    draw_filters(dice, node.host);
    const unsigned count = node.host.listen_only ? 0 : dice.in(1, 3);
    node.host.tx_buffers = dice.per_cent(60) ? 1 : std::max(1U, count);
    for (unsigned i = 0; i < count; ++i) {
      TrafficSpec traffic;
      traffic.node = id;
      traffic.name = fmt::format("{}m{}", node.name, i);
      traffic.frame = draw_frame(dice, id, used);
      draw_payload(dice, traffic);
      bits += about_bits(traffic.frame);
      scenario.traffic.push_back(traffic);
    }
  }
  scenario.duration = bit * bits_of_run(scenario, frames);
  scenario.drain = bit * 20'000;
  for (TrafficSpec &traffic : scenario.traffic) {
    // With one buffer a saturated message would keep the others of its node waiting for ever.
    traffic.saturated = saturated && dice.per_cent(70);
    const Time period = bit * static_cast<Time>(bits * 100 / load + 1);
    if (!traffic.saturated) traffic.period = period * dice.in(50, 150) / 100;
    if (!traffic.saturated && dice.per_cent(50)) traffic.random_offset = true;
    if (!traffic.saturated && dice.per_cent(30)) traffic.jitter = traffic.period / 3;
  }
}

}  // namespace vericansim
