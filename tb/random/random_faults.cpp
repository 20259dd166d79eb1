// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random buses: what disturbs them. Everything is a fault at a given time, so that a scenario can
// lose one after the other.
#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

constexpr unsigned kFrameBits = 70;  // about

struct Draw {
  Dice &dice;
  Scenario &scenario;
  Time bit;

  [[nodiscard]] Time moment() {
    const Time tick = bit / 16;
    return tick *
           static_cast<Time>(dice.below(static_cast<std::uint64_t>(scenario.duration / tick)));
  }
  [[nodiscard]] NodeId node() { return dice.below(scenario.nodes.size()); }
  void add(FaultSpec::Kind kind, Effect effect, NodeId node, Time length) {
    FaultSpec fault;
    fault.kind = kind;
    fault.effect = effect;
    fault.node = node;
    fault.window.from = moment();
    fault.window.to = fault.window.from + length;
    fault.noise.window = fault.window;
    scenario.faults.push_back(fault);
  }
};

Effect draw_effect(Dice &dice) {
  switch (dice.weighted({70, 20, 10})) {
    case 0: return Effect::kFlip;
    case 1: return Effect::kDominant;
    default: return Effect::kRecessive;
  }
}

/// One bit or less, a few bits, or a burst; at one receiver or at all.
void draw_flip(Draw &draw) {
  Dice &dice = draw.dice;
  const NodeId victim = dice.per_cent(75) ? draw.node() : kAllNodes;
  Time length = 0;
  switch (dice.weighted({60, 20, 15, 5})) {
    case 0: length = draw.bit * dice.in(8, 16) / 16; break;
    case 1: length = draw.bit * dice.in(1, 8) / 32; break;  // a glitch: shorter than a bit
    case 2: length = draw.bit * dice.in(1, 12); break;
    default: length = draw.bit * dice.in(12, 60); break;
  }
  draw.add(FaultSpec::Kind::kLevel, draw_effect(dice), victim, length);
}

/// Long enough for bus-off, or for a node to miss many frames.
void draw_break(Draw &draw) {
  Dice &dice = draw.dice;
  const Time length = draw.bit * dice.in(50, 3000);
  switch (dice.below(4)) {
    case 0: draw.add(FaultSpec::Kind::kCut, Effect::kFlip, draw.node(), length); break;
    case 1: draw.add(FaultSpec::Kind::kShort, Effect::kFlip, draw.node(), length / 4); break;
    case 2: draw.add(FaultSpec::Kind::kLevel, Effect::kRecessive, draw.node(), length); break;
    default: draw.add(FaultSpec::Kind::kLevel, Effect::kDominant, draw.node(), length / 4); break;
  }
}

}  // namespace

void draw_faults(Dice &dice, Scenario &scenario, NoiseLevel level) {
  if (level == NoiseLevel::kNone) return;
  Draw draw{dice, scenario, bit_time(scenario)};
  const auto frames = static_cast<unsigned>(scenario.duration / (draw.bit * kFrameBits));
  const unsigned apart = level == NoiseLevel::kLight ? 60 : level == NoiseLevel::kNoisy ? 12 : 4;
  for (unsigned n = frames / apart; n > 0; --n) draw_flip(draw);
  if (level == NoiseLevel::kLight) return;
  for (unsigned n = frames / (apart * 60) + 1; n > 0; --n) draw_break(draw);
}

}  // namespace vericansim
