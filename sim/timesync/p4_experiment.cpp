// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The experiment of the published system: see p4_experiment.hpp.
#include "timesync/p4_experiment.hpp"

#include <fmt/format.h>

#include "timesync/sync_goal.hpp"

namespace vericansim {
namespace {

P4Check in_range(const char *what, const char *paper, double least, double most, double seen_ns) {
  const double us = seen_ns / 1e3;
  return {what, fmt::format("{:g} to {:g} us ({})", least, most, paper),
          fmt::format("{:.1f} us", us), us >= least && us <= most};
}

P4Check at_most(const char *what, double limit, double seen_ns, bool locked) {
  return {what, fmt::format("{:.1f} ns at most", limit),
          locked ? fmt::format("{:.1f} ns", seen_ns) : "not locked", locked && seen_ns <= limit};
}

}  // namespace

SyncCase p4_case() {
  SyncCase setting;
  setting.clocks.opposed = true;
  setting.clocks.spread_ppm = 152;
  setting.followers = 2;
  return setting;
}

P4Result run_p4(const SyncWay &way, const SyncCase &setting) {
  check_way(way, setting);
  P4Result result{setting, SyncFigures{}, SyncFigures{}, {}};
  for (std::uint64_t seed = 1; seed <= setting.seeds; ++seed)
    result.published.add(way.run_p4(setting, seed));
  result.servo = run_case(way, setting);
  const double bound = steady_bound(setting).value_or(0);
  // 2 us more than the paper measured: what the driver's accesses add on RTL.
  result.checks = {
      in_range("offset alone: master and follower",
               "paper: at most 160 us measured; 2 us for the driver on RTL", 152, 162,
               result.published.max()),
      in_range("offset alone: two followers", "paper: 304 us predicted, at most 320 us measured",
               304, 320, result.published.between()),
      at_most("hardware stamps and servo: master and follower", bound, result.servo.max(),
              result.servo.locked()),
      at_most("hardware stamps and servo: two followers", 2 * bound, result.servo.between(),
              result.servo.locked()),
  };
  return result;
}

}  // namespace vericansim
