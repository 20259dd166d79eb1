// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random buses: see random_scenario.hpp.
#include "random/random_scenario.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vericansim {
namespace {

constexpr double kRates[] = {1e6, 800e3, 500e3, 250e3, 125e3, 50e3};

unsigned draw_node_count(Dice &dice) {
  switch (dice.weighted({45, 25, 15, 11, 4})) {
    case 0: return 2;
    case 1: return 3;
    case 2: return 4;
    case 3: return dice.in(5, 8);
    default: return dice.in(9, 16);
  }
}

void draw_nodes(Dice &dice, Scenario &scenario) {
  const unsigned count = draw_node_count(dice);
  for (NodeId id = 0; id < count; ++id) {
    NodeSpec node;
    node.name = fmt::format("n{}", id);
    node.num_mb = 16U << dice.weighted({75, 15, 10});
    // Node 0 has software, so that there is traffic.
    node.software = id == 0 || !dice.per_cent(25);
    node.clock.seed = scenario.seed * 1000 + id;
    if (node.software) {
      node.host.lowest_buffer_first = dice.per_cent(30);
      node.host.fd_tolerant = dice.per_cent(5);
      // Somebody must acknowledge.
      node.host.listen_only = id > 1 && scenario.nodes[1].software && dice.per_cent(4);
      node.host.self_reception = !node.host.listen_only && dice.per_cent(5);
    }
    scenario.nodes.push_back(node);
  }
}

}  // namespace

Time bit_time(const Scenario &scenario) {
  return static_cast<Time>(std::llround(1e12 / scenario.bitrates.front()));
}

std::uint32_t draw_identifier(Dice &dice, NodeId node, bool extended) {
  // Few different first bits, so that arbitration goes far; the node in the last four.
  const std::uint32_t wide = dice.per_cent(50) ? 0x120 : dice.below(0x7F0);
  const std::uint32_t base = (wide & 0x7F0) | node;
  if (!extended) return base;
  const std::uint32_t low = dice.per_cent(50) ? dice.below(16) << 4 : dice.below(0x3FFFF);
  return (base << 18) | (low & 0x3FFF0) | node;
}

NoiseLevel noise_level(std::uint64_t seed) {
  Dice dice{seed ^ 0x5EED};
  return static_cast<NoiseLevel>(dice.weighted({35, 35, 20, 10}));
}

Scenario random_scenario(std::uint64_t seed, unsigned frames) {
  Dice dice{seed};
  Scenario scenario;
  scenario.name = fmt::format("random bus {}", seed);
  scenario.file = scenario.name;
  scenario.seed = seed & 0xFFFFFFFF;
  scenario.lockstep = true;
  scenario.bitrates = {kRates[dice.weighted({50, 10, 20, 10, 5, 5})]};
  draw_nodes(dice, scenario);
  // An FD-tolerant node that integrates also looks at edges between sample points (IN-02); the
  // model sees samples alone, so glitches and such nodes do not go together.
  if (noise_level(seed) != NoiseLevel::kNone)
    for (NodeSpec &node : scenario.nodes) node.host.fd_tolerant = false;
  draw_clocks(dice, scenario);
  draw_traffic(dice, scenario, frames);
  draw_accesses(dice, scenario);
  draw_faults(dice, scenario, noise_level(seed));
  return scenario;
}

}  // namespace vericansim
