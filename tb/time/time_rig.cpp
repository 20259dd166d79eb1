// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See time_rig.hpp.
#include "time/time_rig.hpp"

#include <utility>

namespace vericansim {

std::vector<std::unique_ptr<RtlNode>> TimeRig::make(const std::vector<Time> &first_edges,
                                                    std::vector<TimeNode *> &made) {
  std::vector<std::unique_ptr<RtlNode>> all;
  for (const Time phase : first_edges) {
    auto node = std::make_unique<TimeNode>("node" + std::to_string(made.size()),
                                           ClockConfig{.phase = phase});
    made.push_back(node.get());
    all.push_back(std::move(node));
  }
  return all;
}

TimeRig::TimeRig(const std::vector<Time> &first_edges)
    : phases{first_edges}, rig{make(phases, nodes)} {}

std::uint64_t TimeRig::time(unsigned n) {
  const std::uint64_t low = rig.read(n, time_reg::kTimelo);
  return low | (std::uint64_t{rig.read(n, time_reg::kTimehi)} << 32);
}

std::uint64_t TimeRig::stamp(unsigned n, unsigned mb) {
  const std::uint64_t low = rig.read(n, time_reg::stamp(mb));
  return low | (std::uint64_t{rig.read(n, time_reg::stamp(mb) + 4)} << 32);
}

}  // namespace vericansim
