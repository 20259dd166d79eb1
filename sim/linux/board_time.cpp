// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: the commands for pins of time units.
#include <fmt/format.h>

#include <algorithm>

#include "linux/board.hpp"
#include "linux/command_words.hpp"

namespace vericansim {

TimeNode &Board::time_unit(std::string_view name) {
  const NodeId node = node_named(name);
  if (node >= time_units_.size())
    refuse(fmt::format("{} has no time unit", in_quotes(std::string{name})));
  return *time_units_[node];
}

// The pin changes at `when` and then every `half`, `changes` times in all.
void Board::toggle_at(TimeNode &node, Time when, Time half, std::uint64_t changes) {
  if (changes == 0) return;
  bus_.at(when, [this, &node, when, half, changes] {
    node.external(changes % 2 == 0);
    toggle_at(node, when + half, half, changes - 1);
  });
}

std::string Board::pulse(const Words &words) {
  constexpr std::uint64_t kDay = 86'400ULL * 1'000'000'000ULL;
  TimeNode &node = time_unit(word(words, 1, "a node, a time, a period and a count"));
  const std::uint64_t start = number(word(words, 2, "a time, ns"), now(), 100 * kDay, "the time");
  const std::uint64_t period = number(word(words, 3, "a period, ns"), 2, kDay, "the period");
  const std::uint64_t count = number(word(words, 4, "a count"), 1, 1'000'000, "the count");
  const Time first = std::max(now_, static_cast<Time>(start) * kNanosecond);
  toggle_at(node, first, static_cast<Time>(period) * kNanosecond / 2, 2 * count);
  return "ok\n";
}

// A pin changes with a clock edge, and the clocks of a board do not wander.
std::string Board::edges(const Words &words) {
  const TimeNode &node = time_unit(word(words, 1, "a node and the name of a file"));
  const Clock clock{node.oscillator().config()};
  const auto file = open_log(std::string{word(words, 2, "the name of a file")});
  bool high = false;
  for (const std::uint64_t edge : node.pulses()) {
    high = !high;
    file->stream() << fmt::format("{} {:d}\n", clock.after(edge - TimeNode::kEdgesOfReset), high);
  }
  file->commit();
  return "ok\n";
}

}  // namespace vericansim
