// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What `verican timesync` prints: see timesync_output.hpp.
#include "cli/timesync_output.hpp"

#include <fmt/format.h>

#include <cmath>

#include "trace/quantity.hpp"

namespace vericansim::cli {
namespace {

std::string filter_text(unsigned filter) {
  return filter == 0 ? "automatic" : std::to_string(filter);
}

Time picoseconds(double ns) { return std::llround(ns * 1e3); }

Json to_json(const SyncCase &c) {
  return {{"frequency_hz", c.clocks.frequency_hz},
          {"spread_ppm", c.clocks.spread_ppm},
          {"opposed", c.clocks.opposed},
          {"wander", c.clocks.wander},
          {"sine_ppm", c.clocks.sine_ppm},
          {"sine_period_s", c.clocks.sine_period_s},
          {"followers", c.followers},
          {"bitrate", c.bitrate},
          {"load", c.load},
          {"load_above", c.load_above},
          {"bit_errors", c.bit_errors},
          {"interval_s", c.interval_s},
          {"filter", c.filter},
          {"displaced", c.displaced},
          {"own_pin", c.own_pin},
          {"hardware", c.hardware},
          {"restless", c.restless},
          {"master_cut", c.master_cut},
          {"intervals", c.intervals},
          {"seeds", c.seeds},
          {"first_seed", c.first_seed}};
}

Json to_json(const SyncFigures &figures) {
  return {{"samples", figures.count()},
          {"locked", figures.locked()},
          {"mean_ps", picoseconds(figures.mean())},
          {"sd_ps", picoseconds(figures.sd())},
          {"max_ps", picoseconds(figures.max())},
          {"between_ps", picoseconds(figures.between())}};
}

Json to_json(const SyncGoal &goal) {
  return {{"sd_ps", goal.sd ? Json(picoseconds(*goal.sd)) : Json(nullptr)},
          {"max_ps", picoseconds(goal.max)}};
}

/// By columns. Events are numbers of VERICAN_SERVO_*.
Json to_json(const std::vector<SyncAction> &actions) {
  Json at = Json::array(), follower = Json::array(), shift = Json::array();
  Json increment = Json::array(), events = Json::array(), state = Json::array();
  for (const SyncAction &action : actions) {
    at.push_back(action.at);
    follower.push_back(action.follower);
    shift.push_back(action.shift);
    increment.push_back(action.increment);
    events.push_back(action.events);
    state.push_back(action.state);
  }
  return {{"at_ps", at},      {"follower", follower}, {"shift_ns", shift}, {"increment", increment},
          {"events", events}, {"state", state}};
}

std::string verdict(const SyncOutcome &outcome) {
  if (!outcome.figures.locked()) return outcome.row.goal ? "no, not locked" : "not locked";
  if (!outcome.row.goal) return "-";
  return outcome.ok() ? "yes" : "no";
}

}  // namespace

std::string to_text(const SyncCase &c) {
  std::string text = fmt::format(
      "{} MHz {} ppm, R = {} s, N = {}, {} followers, {} x {} intervals",
      plain_number(c.clocks.frequency_hz / 1e6),
      (c.clocks.opposed ? "fast and slow by " : "+-") + plain_number(c.clocks.spread_ppm),
      plain_number(c.interval_s), filter_text(c.filter), c.followers, c.seeds, c.intervals);
  const auto add = [&text](bool is, const std::string &what) {
    if (is) text += ", " + what;
  };
  add(c.clocks.wander > 0, fmt::format("wander {:g} /sqrt(s)", c.clocks.wander));
  add(c.clocks.sine_ppm > 0, fmt::format("swing {} ppm in {} s", plain_number(c.clocks.sine_ppm),
                                         plain_number(c.clocks.sine_period_s)));
  add(c.load > 0, fmt::format("load {} %", plain_number(c.load * 100)));
  add(c.load_above > 0, fmt::format("load above SYNC {} %", plain_number(c.load_above * 100)));
  add(c.bit_errors > 0, fmt::format("bit errors {:g}", c.bit_errors));
  add(c.displaced > 0, fmt::format("{} % of edges early", plain_number(c.displaced * 100)));
  add(c.own_pin, "master stamps at its own pin");
  add(c.hardware,
      c.restless ? "followers in hardware, KD 1, PHALF 0" : "followers in hardware, KD 2, PHALF 1");
  add(c.master_cut, "master cut half-way");
  add(c.bitrate != SyncCase{}.bitrate, fmt::format("{} bit/s", plain_number(c.bitrate)));
  return text;
}

void print_sync_head() {
  fmt::print("{:<40} {:>8} {:>8} {:>8} {:>8}  {:>8} {:>8}\n", "ns", "mean", "sd", "max", "between",
             "goal sd", "goal max");
}

void print_sync_row(const SyncOutcome &outcome) {
  const SyncFigures &f = outcome.figures;
  const auto &goal = outcome.row.goal;
  fmt::print("{:<40} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f}  {:>8} {:>8}  {}\n", outcome.row.name,
             f.mean(), f.sd(), f.max(), f.between(),
             goal && goal->sd ? fmt::format("{:.1f}", *goal->sd) : "-",
             goal ? fmt::format("{:.1f}", goal->max) : "-", verdict(outcome));
}

void print_sync_foot() {
  fmt::print(
      "\nmean, sd, max: each follower less the master, at any instant in which it is locked, or\n"
      "from its first lock on where the master is cut; between: of two followers. Simulated:\n"
      "transceivers and cables come on top.\n");
}

Json to_json(const SyncOutcome &outcome) {
  return {{"name", outcome.row.name},
          {"case", to_json(outcome.row.setting)},
          {"result", to_json(outcome.figures)},
          {"goal", outcome.row.goal ? to_json(*outcome.row.goal) : Json(nullptr)},
          {"ok", outcome.ok()}};
}

Json to_json(const SyncRow &row, const char *missing) {
  return {{"name", row.name}, {"case", to_json(row.setting)}, {"missing", missing}};
}

Json to_json(const SyncRun &run) {
  Json at = Json::array(), followers = Json::array();
  for (const SyncLook &look : run.looks) at.push_back(look.at);
  const std::size_t count = run.looks.empty() ? 0 : run.looks.front().followers.size();
  for (std::size_t n = 0; n < count; ++n) {
    Json errors = Json::array(), states = Json::array();
    for (const SyncLook &look : run.looks) {
      errors.push_back(look.followers[n].error);
      states.push_back(look.followers[n].state);
    }
    followers.push_back({{"error_ps", errors}, {"state", states}});
  }
  return {{"frames", run.frames},   {"repeated", run.repeated},
          {"refused", run.refused}, {"at_ps", at},
          {"followers", followers}, {"corrections", to_json(run.actions)}};
}

Json to_json(const P4Result &result) {
  Json checks = Json::array();
  bool ok = true;
  for (const P4Check &check : result.checks) {
    ok = ok && check.ok;
    checks.push_back({{"what", check.what},
                      {"expected", check.expected},
                      {"seen", check.seen},
                      {"ok", check.ok}});
  }
  return {{"case", to_json(result.setting)},
          {"offset_alone", to_json(result.published)},
          {"servo", to_json(result.servo)},
          {"checks", checks},
          {"ok", ok}};
}

void print_p4(const P4Result &result) {
  fmt::print(
      "Park, Kim, Lee: Implementation of IEEE 1588 for clock synchronisation of CAN (2014)\n"
      "{}\n\n",
      to_text(result.setting));
  for (const P4Check &check : result.checks)
    fmt::print("  {} {}\n       expected: {}\n       seen:     {}\n", check.ok ? "ok  " : "FAIL",
               check.what, check.expected, check.seen);
}

}  // namespace vericansim::cli
