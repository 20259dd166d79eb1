// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of a scenario in words: name, kind, and what it does where and when.
#include "scenario/fault_words.hpp"

#include <fmt/format.h>

#include <limits>

namespace vericansim {
namespace {

using Kind = FaultSpec::Kind;

std::string milliseconds(Time time) {
  return fmt::format("{:.10g} ms", static_cast<double>(time) / kMillisecond);
}

std::string node_name(const Scenario &scenario, NodeId node) {
  if (node == kBusPoint) return "the observation point";
  return node == kAllNodes ? "every node" : scenario.nodes[node].name;
}

std::string window_text(const Window &window) {
  const bool ends = window.to != std::numeric_limits<Time>::max();
  if (ends) return fmt::format(", {} to {}", milliseconds(window.from), milliseconds(window.to));
  return window.from == 0 ? "" : fmt::format(", from {} on", milliseconds(window.from));
}

std::string place_text(const Scenario &scenario, const FaultSpec &fault) {
  const PlaceSpec &place = fault.place;
  std::string text = " while " + scenario.nodes[fault.watched].name + " is in";
  text += place.field ? fmt::format(" {}", field_name(*place.field)) : " any field";
  if (place.index) text += fmt::format(", bit {}", *place.index);
  if (place.left) text += fmt::format(", {} bits before the last", *place.left);
  if (place.stuff) text += *place.stuff ? ", stuff bits" : ", no stuff bits";
  if (fault.first_quantum || fault.last_quantum)
    text += fmt::format(
        ", quanta {} to {}", fault.first_quantum.value_or(0),
        fault.last_quantum ? std::to_string(*fault.last_quantum) : "the end of the bit");
  if (place.frame) text += fmt::format(", frame {}", *place.frame);
  return text;
}

std::string noise_text(const NoiseConfig &noise) {
  std::string text;
  if (noise.per_bit > 0) text += fmt::format(", each bit flipped with {:g}", noise.per_bit);
  if (noise.per_ns > 0)
    text += fmt::format(", {:.10g} glitches of {:.10g} ns a millisecond", noise.per_ns * 1e6,
                        static_cast<double>(noise.glitch) / kNanosecond);
  return text;
}

}  // namespace

std::string fault_name(const Scenario &scenario, std::size_t index) {
  const FaultSpec &fault = scenario.faults[index];
  return fault.name.empty() ? fmt::format("{} {}", fault_kind(fault), index + 1) : fault.name;
}

std::string fault_kind(const FaultSpec &fault) {
  switch (fault.kind) {
    case Kind::kCut: return "cut";
    case Kind::kShort: return "short";
    case Kind::kClock: return "clock";
    case Kind::kNoise: return "noise";
    default: break;
  }
  if (fault.effect == Effect::kFlip) return "flip";
  return fault.effect == Effect::kDominant ? "dominant" : "recessive";
}

std::string fault_text(const Scenario &scenario, const FaultSpec &fault) {
  const std::string node = node_name(scenario, fault.node);
  switch (fault.kind) {
    case Kind::kCut: return "cable of " + node + " open" + window_text(fault.window);
    case Kind::kShort:
      return "transmitter of " + node + " shorted to dominant" + window_text(fault.window);
    case Kind::kClock:
      return fmt::format("clock of {} off by {:g} ppm{}", node, fault.ppm,
                         window_text(fault.window));
    case Kind::kNoise:
      return "noise at " + node + noise_text(fault.noise) + window_text(fault.window);
    default: break;
  }
  const std::string what =
      (fault.effect == Effect::kFlip ? "flipped" : fault_kind(fault)) + " at " + node;
  return what +
         (fault.kind == Kind::kPlace ? place_text(scenario, fault) : window_text(fault.window));
}

}  // namespace vericansim
