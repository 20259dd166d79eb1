// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See time_rig.hpp.
#include "time/time_rig.hpp"

#include <utility>

namespace vericansim {

namespace {

std::vector<ClockConfig> clocks_of(const std::vector<Time> &first_edges) {
  std::vector<ClockConfig> clocks;
  for (const Time phase : first_edges) clocks.push_back({.phase = phase});
  return clocks;
}

std::vector<Time> phases_of(const std::vector<ClockConfig> &clocks) {
  std::vector<Time> phases;
  for (const ClockConfig &clock : clocks) phases.push_back(clock.phase);
  return phases;
}

}  // namespace

std::vector<std::unique_ptr<RtlNode>> TimeRig::make(const std::vector<ClockConfig> &clocks,
                                                    std::vector<TimeNode *> &made) {
  std::vector<std::unique_ptr<RtlNode>> all;
  for (const ClockConfig &clock : clocks) {
    auto node = std::make_unique<TimeNode>("node" + std::to_string(made.size()), clock);
    made.push_back(node.get());
    all.push_back(std::move(node));
  }
  return all;
}

TimeRig::TimeRig(const std::vector<Time> &first_edges) : TimeRig{clocks_of(first_edges)} {}

TimeRig::TimeRig(const std::vector<ClockConfig> &clocks)
    : phases{phases_of(clocks)}, rig{make(clocks, nodes)} {}

std::uint64_t TimeRig::time(unsigned n) {
  const std::uint64_t low = rig.read(n, time_reg::kTimelo);
  return low | (std::uint64_t{rig.read(n, time_reg::kTimehi)} << 32);
}

std::uint64_t TimeRig::stamp(unsigned n, unsigned mb) {
  const std::uint64_t low = rig.read(n, time_reg::stamp(mb));
  return low | (std::uint64_t{rig.read(n, time_reg::stamp(mb) + 4)} << 32);
}

}  // namespace vericansim
