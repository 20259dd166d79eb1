// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayPlan: see replay_plan.hpp.
#include "session/replay_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trace/id_filter.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// Far below what Time holds.
constexpr double kLatest = 90.0 * 24 * 3600 * kSecond;

bool wanted(const ReplayRole &role, const LogEntry &entry) {
  return (role.from == 0 || entry.time >= role.from) && entry.time <= role.to &&
         (role.channel.empty() || entry.channel == role.channel) &&
         passes(role.filters, can_id_of(entry.frame));
}

Time due_time(const ReplayRole &role, Time in_log) {
  if (role.saturated || in_log < role.from) return role.start;
  const double due =
      static_cast<double>(role.start) + static_cast<double>(in_log - role.from) / role.rate;
  if (due > kLatest)
    throw InputError(
        role.file, 0,
        fmt::format("a frame is {:.0f} s after the first; allowed: 90 days", due / 1e12));
  return role.rate == 1 ? role.start + in_log - role.from : static_cast<Time>(std::llround(due));
}

void find_gap(ReplayPlan &plan, Time gap) {
  if (gap <= plan.longest_gap) return;
  plan.longest_gap = gap;
  plan.after_gap = plan.frames.size() + 1;
}

std::string reason(const ReplayRole &role, const CanLog &log) {
  if (!log.entries.empty())
    return fmt::format("none of the {} frames of {} is chosen by the settings of the node",
                       log.entries.size(), role.file);
  return fmt::format("{} holds no classical CAN frame{}", role.file,
                     log.skipped != 0 ? fmt::format(" ({} entries are none)", log.skipped) : "");
}

}  // namespace

// Fibonacci hashing spreads neighbours.
unsigned share_of(const Frame &frame, unsigned of) {
  const std::uint32_t key = (frame.id ^ (frame.extended ? 0x80000000U : 0U)) * 2654435769U;
  return static_cast<unsigned>((static_cast<std::uint64_t>(key) * of) >> 32);
}

ReplayPlan make_plan(const ReplayRole &role) {
  const CanLog read = role.log ? CanLog{} : read_log(role.file);
  const CanLog &log = role.log ? *role.log : read;
  ReplayPlan plan;
  plan.skipped = log.skipped;
  plan.warnings = read.warnings;
  std::size_t taken = 0;
  Time first = 0, last = 0;
  for (const LogEntry &entry : log.entries) {
    if (!wanted(role, entry)) continue;
    if (role.frames != 0 && taken == role.frames) break;
    ++taken;
    if (share_of(entry.frame, role.shares) != role.share) continue;
    if (plan.frames.empty()) first = last = entry.time;
    find_gap(plan, entry.time - last);
    last = std::max(last, entry.time);
    plan.frames.push_back({due_time(role, entry.time), entry.frame});
  }
  plan.recorded = last - first;
  // Another pass begins a mean distance after the last frame of the one before.
  const auto count = static_cast<Time>(plan.frames.size());
  if (count != 0) {
    const Time length = due_time(role, last) - plan.frames.front().due;
    plan.pass = count > 1 && length > 0 ? length + length / (count - 1) : kMillisecond;
  }
  if (taken == 0) plan.nothing = reason(role, log);
  return plan;
}

}  // namespace vericansim
