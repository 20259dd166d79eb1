// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RunReport as text and as JSON.
#include "results/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

#include "signals/signal_output.hpp"

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

double milliseconds(Time time) { return static_cast<double>(time) / kMillisecond; }

std::string messages_text(const RunReport &report) {
  std::string text;
  auto out = std::back_inserter(text);
  const bool bounds = std::any_of(report.messages.begin(), report.messages.end(),
                                  [](const MessageReport &m) { return m.bound.has_value(); });
  fmt::format_to(out, "  {:<14} {:<12} {:>8} {:>8} {:>11} {:>11} {:>11}{}\n", "message", "from",
                 "queued", "sent", "shortest ms", "mean ms", "longest ms",
                 bounds ? "    bound ms" : "");
  for (const MessageReport &m : report.messages) {
    fmt::format_to(out, "  {:<14} {:<12} {:>8} {:>8} {:>11.3f} {:>11.3f} {:>11.3f}", m.name, m.node,
                   m.queued, m.sent, milliseconds(m.shortest), milliseconds(m.mean()),
                   milliseconds(m.longest));
    if (m.bound)
      fmt::format_to(out, " {:>11.3f}", milliseconds(*m.bound));
    else if (bounds)
      fmt::format_to(out, " {:>11}", "none");
    text += '\n';
  }
  for (const MessageReport &m : report.messages)
    if (m.unsaid) fmt::format_to(out, "  warning: {} was never queued\n", m.name);
  return text;
}

std::string nodes_text(const RunReport &report) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "  {:<14} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9}  {}\n", "node", "sent",
                 "received", "retries", "arb lost", "errors", "TEC (max)", "REC (max)", "state");
  for (const NodeReport &n : report.nodes) {
    const NodeCounts &c = n.counts;
    fmt::format_to(out, "  {:<14} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9}  {}\n", n.name, c.sent,
                   n.received, c.retries(), c.lost_arbitration, c.errors,
                   fmt::format("{} ({})", c.tec, c.max_tec),
                   fmt::format("{} ({})", c.rec, c.max_rec), n.state());
  }
  return text;
}

/// The parts that only some kinds of nodes have.
std::string parts_text(const RunReport &report) {
  std::string text;
  if (!report.boards.empty()) text += firmware::to_text(report.boards) + "\n";
  if (!report.replays.empty()) text += to_text(report.replays) + "\n";
  if (!report.ports.empty()) text += to_text(report.ports);
  for (const SocketcandCounts &counts : report.servers) text += "  " + to_text(counts);
  if (report.pace) text += "  " + to_text(*report.pace) + "\n\n";
  return text;
}

Json message_json(const MessageReport &m) {
  Json json{{"name", m.name},
            {"node", m.node},
            {"queued", m.queued},
            {"sent", m.sent},
            {"shortest_ps", m.shortest},
            {"mean_ps", m.mean()},
            {"longest_ps", m.longest}};
  json["bound_ps"] = m.bound ? Json(*m.bound) : Json(nullptr);
  return json;
}

Json node_json(const NodeReport &n) {
  const NodeCounts &c = n.counts;
  return {{"name", n.name},
          {"sent", c.sent},
          {"received", n.received},
          {"overruns", n.overruns},
          {"attempts", c.attempts},
          {"retries", c.retries()},
          {"lost_arbitration", c.lost_arbitration},
          {"errors", c.errors},
          {"stuff_errors", c.by_kind[0]},
          {"form_errors", c.by_kind[1]},
          {"crc_errors", c.by_kind[2]},
          {"ack_errors", c.by_kind[3]},
          {"bit_errors", c.by_kind[4] + c.by_kind[5]},
          {"tec", c.tec},
          {"rec", c.rec},
          {"max_tec", c.max_tec},
          {"max_rec", c.max_rec},
          {"bus_off", c.bus_off},
          {"state", n.state()},
          {"ahb_transfers", n.bus_transfers},
          {"ahb_max_wait_states", n.max_wait_states},
          {"ahb_violations", n.ahb_violations}};
}

}  // namespace

std::string NodeReport::state() const {
  if (counts.off) return "bus-off";
  return counts.passive ? "passive" : "active";
}

bool RunReport::ok() const {
  const auto good = [](const auto &part) { return part.ok(); };
  return !interrupted &&
         std::all_of(checks.begin(), checks.end(), [](const CheckResult &c) { return c.ok; }) &&
         std::all_of(boards.begin(), boards.end(), good) &&
         std::all_of(replays.begin(), replays.end(), good) &&
         std::all_of(ports.begin(), ports.end(), good) &&
         std::all_of(servers.begin(), servers.end(), good);
}

std::string tables_text(const RunReport &report) {
  std::string text;
  if (report.show_signals) text += to_text(report.signals) + "\n";
  if (report.show_identifiers) text += to_text(report.identifiers) + "\n";
  return text;
}

std::string to_text(const RunReport &report) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {:.0f} bit/s, {:.3f} ms\n", report.name, report.bitrate,
                 milliseconds(report.duration));
  fmt::format_to(
      out, "  frames {}  error frames {}  overload frames {}  still waiting {}  load {:.1f} %",
      report.frames, report.error_frames, report.overload_frames, report.pending,
      report.load * 100);
  if (report.unacknowledged != 0) fmt::format_to(out, "  without ACK {}", report.unacknowledged);
  if (report.analytic_load > 0)
    fmt::format_to(out, " (worst case {:.1f} %)", report.analytic_load * 100);
  text += "\n\n";
  if (!report.messages.empty()) text += messages_text(report) + "\n";
  if (!report.no_bound.empty()) fmt::format_to(out, "  no bound: {}\n\n", report.no_bound);
  text += nodes_text(report) + "\n";
  if (!report.remote.empty()) text += to_text(report.remote);
  text += tables_text(report);
  if (!report.faults.empty()) text += faults_text(report.faults) + "\n";
  if (report.interrupted) text += "  interrupted; expectations were not checked\n";
  text += parts_text(report);
  for (const CheckResult &check : report.checks)
    fmt::format_to(out, "  {}  {}: {} (expected {})\n", check.ok ? "ok  " : "FAIL", check.what,
                   check.seen, check.wanted);
  fmt::format_to(
      out, "  {:.1f} million node-cycles in {:.2f} s: {:.1f} million a second\n",
      static_cast<double>(report.node_cycles) / 1e6, report.wall_seconds,
      static_cast<double>(report.node_cycles) / 1e6 / std::max(report.wall_seconds, 1e-9));
  return text;
}

Json to_json(const RunReport &report) {
  Json messages = Json::array(), nodes = Json::array(), checks = Json::array();
  for (const MessageReport &m : report.messages) messages.push_back(message_json(m));
  for (const NodeReport &n : report.nodes) nodes.push_back(node_json(n));
  for (const CheckResult &c : report.checks)
    checks.push_back({{"what", c.what}, {"expected", c.wanted}, {"seen", c.seen}, {"ok", c.ok}});
  Json json{{"name", report.name},
            {"bitrate", report.bitrate},
            {"duration_ps", report.duration},
            {"frames", report.frames},
            {"unacknowledged", report.unacknowledged},
            {"error_frames", report.error_frames},
            {"overload_frames", report.overload_frames},
            {"pending", report.pending},
            {"load", report.load},
            {"analytic_load", report.analytic_load},
            {"wall_seconds", report.wall_seconds},
            {"node_cycles", report.node_cycles},
            {"messages", messages},
            {"nodes", nodes},
            {"identifiers", to_json(report.identifiers)},
            {"faults", faults_json(report.faults)},
            {"checks", checks},
            {"interrupted", report.interrupted},
            {"ok", report.ok()}};
  if (!report.no_bound.empty()) json["no_bound"] = report.no_bound;
  if (!report.remote.empty()) json["remote"] = to_json(report.remote);
  for (const firmware::BoardReport &b : report.boards) json["boards"].push_back(to_json(b));
  for (const ReplayResult &r : report.replays) json["replays"].push_back(to_json(r));
  for (const PortReport &p : report.ports) json["ports"].push_back(to_json(p));
  for (const SocketcandCounts &c : report.servers) json["socketcand"].push_back(to_json(c));
  if (report.pace) json["pace"] = to_json(*report.pace);
  if (report.signals.database) json["signals"] = to_json(report.signals);
  return json;
}

}  // namespace vericansim
