// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteReport as text and as JSON.
#include "results/remote_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

#include "trace/quantity.hpp"

namespace vericansim {

std::uint64_t RemoteReport::total(const std::string &key) const {
  if (key == "triggers") return triggers;
  std::uint64_t sum = 0;
  for (const RemoteNodeReport &node : nodes)
    sum += key == "refused"           ? node.refused
           : key == "lost_set_points" ? node.lost_set_points
                                      : node.late_statements;
  return sum;
}

std::string RemoteReport::unseen(const std::string &key) const {
  const auto none = [this](const auto &seen) {
    return std::none_of(nodes.begin(), nodes.end(), seen);
  };
  if (key == "lost_set_points" &&
      none([](const RemoteNodeReport &n) { return n.awaited + n.lost_set_points != 0; }))
    return "no TRIGGER to a node in OPERATE";
  if (key == "late_statements" &&
      none([](const RemoteNodeReport &n) { return n.statements + n.late_statements != 0; }))
    return "no measurement that was due";
  return "";
}

namespace {

/// The first frames: enough to see what goes on.
std::string frames_text(const RemoteReport &report) {
  constexpr std::size_t kListed = 20;
  std::string text;
  auto out = std::back_inserter(text);
  const std::size_t listed = std::min(kListed, report.frames.size());
  for (std::size_t i = 0; i < listed; ++i)
    fmt::format_to(out, "  {:>14}  {}\n", readable_time(report.frames[i].start),
                   report.frames[i].words);
  const std::uint64_t more = report.frames.size() - listed + report.more_frames;
  if (more != 0) fmt::format_to(out, "  {:>14}  and {} more frames\n", "", more);
  return text;
}

nlohmann::ordered_json frames_json(const RemoteReport &report) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const RemoteFrameReport &frame : report.frames)
    list.push_back({{"start_ps", frame.start}, {"words", frame.words}});
  return list;
}

}  // namespace

std::string to_text(const RemoteReport &report) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "  {:<14} {:>6} {:<6} {:<8} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n",
                 "remote node", "number", "is", "state", "accepted", "refused", "applied", "lost",
                 "said", "late");
  for (const RemoteNodeReport &n : report.nodes) {
    fmt::format_to(out, "  {:<14} {:>6} {:<6} {:<8} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}", n.name,
                   n.number, n.rtl ? "RTL" : "model", n.state, n.accepted, n.refused, n.applied,
                   n.lost_set_points, n.statements, n.late_statements);
    if (n.went_safe != 0)
      fmt::format_to(out, "  left OPERATE {}x, last at {}", n.went_safe,
                     readable_time(n.last_safe));
    text += '\n';
    if (n.statements == 0) continue;
    fmt::format_to(out, "  {:<14} tells its measurements {} to {} after the action{}\n", "",
                   readable_time(n.shortest), readable_time(n.longest),
                   n.bound ? ", bound " + readable_time(*n.bound) : "");
  }
  if (report.triggers != 0)
    fmt::format_to(out,
                   "  {} TRIGGERs; skew mean {}, longest {}, bound {}; from action to action {} to "
                   "{}\n",
                   report.triggers, readable_time(report.skew_mean),
                   readable_time(report.skew_longest), readable_time(report.skew_bound),
                   readable_time(report.period_shortest), readable_time(report.period_longest));
  if (report.latency_longest != 0)
    fmt::format_to(out,
                   "  from command to action {} to {}; from TRIGGER to TRIGGER the bus is held for "
                   "{} to {}, {:.1f} %\n",
                   readable_time(report.latency_shortest), readable_time(report.latency_longest),
                   readable_time(report.traffic_shortest), readable_time(report.traffic_longest),
                   100 * report.cycle_load);
  // RN-13.
  if (report.hosts.size() > 1)
    fmt::format_to(out,
                   "  warning: {} have 'commands', and these nodes know one host: requests of "
                   "two collide\n",
                   fmt::join(report.hosts, ", "));
  return text + frames_text(report) + "\n";
}

nlohmann::ordered_json to_json(const RemoteReport &report) {
  nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
  for (const RemoteNodeReport &n : report.nodes) {
    nodes.push_back({{"name", n.name},
                     {"rtl", n.rtl},
                     {"number", n.number},
                     {"state", n.state},
                     {"went_safe", n.went_safe},
                     {"last_safe_ps", n.last_safe},
                     {"accepted", n.accepted},
                     {"refused", n.refused},
                     {"applied", n.applied},
                     {"lost_set_points", n.lost_set_points},
                     {"statements", n.statements},
                     {"late_statements", n.late_statements},
                     {"shortest_ps", n.shortest},
                     {"longest_ps", n.longest},
                     {"sum_ps", n.sum},
                     {"bound_ps", nullptr}});
    if (n.bound) nodes.back()["bound_ps"] = *n.bound;
  }
  return {{"nodes", nodes},
          {"triggers", report.triggers},
          {"compared", report.compared},
          {"skew_mean_ps", report.skew_mean},
          {"skew_longest_ps", report.skew_longest},
          {"skew_bound_ps", report.skew_bound},
          {"above_bound", report.above_bound},
          {"period_shortest_ps", report.period_shortest},
          {"period_longest_ps", report.period_longest},
          {"traffic_shortest_ps", report.traffic_shortest},
          {"traffic_longest_ps", report.traffic_longest},
          {"traffic_mean_ps", report.traffic_mean},
          {"cycle_load", report.cycle_load},
          {"latency_shortest_ps", report.latency_shortest},
          {"latency_longest_ps", report.latency_longest},
          {"hosts", report.hosts},
          {"commands", report.commands},
          {"frames", frames_json(report)},
          {"more_frames", report.more_frames}};
}

}  // namespace vericansim
