// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockNode: see clock_node.hpp.
#include "timesync/clock_node.hpp"

#include <cmath>

namespace vericansim {
namespace {

constexpr Nanoseconds kFraction = 4294967296.0L;  // 2^32

}  // namespace

ClockNode::ClockNode(const Oscillator &of, std::uint64_t start_ns)
    : oscillator{of},
      increment_{static_cast<std::uint64_t>(std::llround(of.nominal() * kFraction))},
      whole_{start_ns} {}

// Carries out of FR in the next `clocks`.
std::uint64_t ClockNode::carries(std::uint64_t clocks) const {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(
      (fraction_ + Wide{clocks} * static_cast<std::uint32_t>(increment_)) >> 32);
}

// A carry reaches NS one clock behind its addition.
std::uint64_t ClockNode::at(std::int64_t edge) const {
  const auto clocks = static_cast<std::uint64_t>(edge - edge_);
  if (clocks == 0) return whole_;
  return whole_ + clocks * (increment_ >> 32) + (carry_ ? 1 : 0) + carries(clocks - 1);
}

void ClockNode::apply(std::int64_t edge, const verican_correction_t &correction) {
  const auto clocks = static_cast<std::uint64_t>(edge - edge_);
  if (clocks > 0) {
    const bool carry = carries(clocks) != carries(clocks - 1);
    const auto step = static_cast<std::uint32_t>(increment_);
    whole_ = at(edge);
    fraction_ += static_cast<std::uint32_t>(clocks) * step;
    carry_ = carry;
    edge_ = edge;
  }
  whole_ += static_cast<std::uint64_t>(correction.shift);
  increment_ = correction.increment;
}

Nanoseconds ClockNode::since_edge(Nanoseconds t) {
  const Nanoseconds edges = oscillator.count(t);
  return (edges - std::floor(edges)) * static_cast<Nanoseconds>(increment_) / kFraction;
}

Nanoseconds ClockNode::ahead_of(ClockNode &other, Nanoseconds t) {
  const auto whole = static_cast<std::int64_t>(now(t) - other.now(t));
  return static_cast<Nanoseconds>(whole) + since_edge(t) - other.since_edge(t);
}

// The first edge at or behind it takes the level into the synchroniser, the next one shows it.
std::uint64_t ClockNode::receive_stamp(Nanoseconds edge) {
  return at(oscillator.edge_after(edge) + 1);
}

}  // namespace vericansim
