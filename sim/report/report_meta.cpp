// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The JSON part of a report: see report_meta.hpp.
#include "report/report_meta.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "version/version.hpp"

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

double ns(Time time) { return static_cast<double>(time) / 1e3; }

/// Hz, error included.
double real_frequency(const ClockConfig &clock) {
  return clock.frequency_hz * (1 + clock.error_ppm * 1e-6);
}

Json node_json(const ReportRecorder &recorder, const ReportExtras &extras, NodeId id) {
  const Node &node = const_cast<Bus &>(recorder.bus()).node(id);
  const BitTiming &timing = recorder.setup().timings[id];
  const NodeCounts &counts = recorder.monitor().node(id);
  const ClockConfig &clock = node.oscillator().config();
  const bool in_run = extras.run != nullptr && id < extras.run->nodes.size();
  return {{"name", node.name()},
          {"clock_hz", clock.frequency_hz},
          {"error_ppm", clock.error_ppm},
          {"quanta", timing.quanta()},
          {"tq_ns", timing.prescaler * 1e9 / real_frequency(clock)},
          {"prop", timing.prop},
          {"ps1", timing.ps1},
          {"ps2", timing.ps2},
          {"sjw", timing.sjw},
          {"sample_point", 1.0 - static_cast<double>(timing.ps2) / timing.quanta()},
          {"sent", counts.sent},
          {"received", in_run ? extras.run->nodes[id].received : counts.delivered},
          {"retries", counts.retries()},
          {"lost", counts.lost_arbitration},
          {"errors", counts.errors},
          {"tec", counts.tec},
          {"rec", counts.rec},
          {"max_tec", counts.max_tec},
          {"max_rec", counts.max_rec},
          {"bus_off", counts.bus_off},
          {"state", counts.off       ? "bus-off"
                    : counts.passive ? "passive"
                                     : "active"}};
}

Json messages_json(const ReportExtras &extras) {
  Json list = Json::array();
  if (extras.run == nullptr) return list;
  for (std::size_t i = 0; i < extras.run->messages.size() && i < extras.messages.size(); ++i) {
    const MessageReport &m = extras.run->messages[i];
    const Frame &frame = extras.messages[i].frame;
    list.push_back({{"name", m.name},
                    {"node", extras.messages[i].node},
                    {"id", frame.id},
                    {"extended", frame.extended},
                    {"remote", frame.remote},
                    {"period_ns", ns(extras.messages[i].period)},
                    {"queued", m.queued},
                    {"sent", m.sent},
                    {"shortest_ns", ns(m.shortest)},
                    {"mean_ns", ns(m.mean())},
                    {"longest_ns", ns(m.longest)},
                    {"bound_ns", m.bound ? Json(ns(*m.bound)) : Json(nullptr)}});
  }
  return list;
}

Json summary_json(const ReportRecorder &recorder, const ReportExtras &extras) {
  const BusMonitor &monitor = recorder.monitor();
  const double duration = static_cast<double>(recorder.ended() - recorder.started());
  return {{"frames", monitor.frames()},
          {"unacknowledged", monitor.unacknowledged()},
          {"error_frames", monitor.error_frames()},
          {"overload_frames", monitor.overload_frames()},
          {"pending", extras.run != nullptr ? extras.run->pending : 0},
          {"load", duration > 0 ? static_cast<double>(monitor.busy()) / duration : 0.0},
          {"analytic_load", extras.run != nullptr ? extras.run->analytic_load : 0.0},
          {"wall_seconds", recorder.wall_seconds()}};
}

Json checks_json(const ReportExtras &extras) {
  Json list = Json::array();
  if (extras.run == nullptr) return list;
  for (const CheckResult &c : extras.run->checks)
    list.push_back({{"what", c.what}, {"wanted", c.wanted}, {"seen", c.seen}, {"ok", c.ok}});
  for (const ReplayResult &r : extras.run->replays)
    list.push_back({{"what", fmt::format("{}: replay of {}", r.node, r.file)},
                    {"wanted", fmt::format("{} frames, bit-exact and in order", r.frames)},
                    {"seen", fmt::format("{} sent; {}", r.sent, verdict(r))},
                    {"ok", r.ok()}});
  return list;
}

Json statements_json(const ReportRecorder &recorder, const ReportExtras &extras) {
  Json list = Json::array();
  for (const ReportStatement &s : extras.statements)
    list.push_back(
        {{"figure", s.figure},
         {"reported", s.reported},
         {"seen", s.seen},
         {"ok", s.ok},
         {"time_ns", s.time ? Json(recorder.ns(static_cast<double>(*s.time))) : Json(nullptr)}});
  return list;
}

Json initial_json(const ReportData &data) {
  const auto levels = [](const std::vector<EdgeList> &lists) {
    Json json = Json::array();
    for (const EdgeList &list : lists) json.push_back(static_cast<int>(list.initial()));
    return json;
  };
  return {{"wire", static_cast<int>(data.wire.initial())},
          {"tx", levels(data.tx)},
          {"rx", levels(data.rx)}};
}

Json view_json(const ReportRecorder &recorder, const ReportExtras &extras) {
  if (!extras.view) return nullptr;
  const double end = ns(recorder.ended() - recorder.started());
  const auto place = [&](Time time) {
    return std::clamp(recorder.ns(static_cast<double>(time)), 0.0, end);
  };
  return {{"from_ns", place(extras.view->first)}, {"to_ns", place(extras.view->second)}};
}

Json truncated_json(const ReportRecorder &recorder) {
  if (recorder.details_ended() == recorder.ended()) return nullptr;
  return fmt::format(
      "Bits and edges are kept for the first {} frames (--report-frames); frames, events and "
      "counters are complete.",
      recorder.limit());
}

std::string leaf_of(const DatabaseFile &file) {
  return std::filesystem::path(file.path).filename().string();
}

/// For the page, which reads them as if they were dropped onto it. There one of a name takes the
/// place of another, so those of several folders with one name keep their folders.
Json databases_json(const ReportExtras &extras) {
  Json list = Json::array();
  if (extras.database == nullptr) return list;
  const auto &files = extras.database->files();
  for (const DatabaseFile &file : files) {
    const auto same = [&](const DatabaseFile &other) { return leaf_of(other) == leaf_of(file); };
    const bool alone = std::count_if(files.begin(), files.end(), same) == 1;
    list.push_back({{"name", alone ? leaf_of(file) : file.path}, {"text", file.text}});
  }
  return list;
}

/// null without remote nodes.
Json remote_json(const ReportExtras &extras) {
  if (extras.remote == nullptr) return nullptr;
  Json units = Json::array();
  for (const RemoteColumns::Unit &unit : extras.remote->units)
    units.push_back({{"node", unit.node}, {"number", unit.number}, {"window", unit.window}});
  return {{"units", units}};
}

}  // namespace

Json report_meta(const ReportRecorder &recorder, const ReportExtras &extras) {
  const ReportData &data = recorder.data();
  Json nodes = Json::array(), causes = Json::array();
  for (NodeId id = 0; id < recorder.bus().size(); ++id)
    nodes.push_back(node_json(recorder, extras, id));
  for (const auto &cause : data.causes)
    causes.push_back({{"text", cause.text}, {"rule", cause.rule}});
  return {{"format", 1},
          {"tool", "verican " + std::string{version()}},
          {"title", recorder.setup().title},
          {"note", recorder.setup().note},
          {"bitrate", recorder.setup().bitrate},
          {"duration_ns", ns(recorder.ended() - recorder.started())},
          {"tick_ps", EdgeList::kTick},
          {"initial", initial_json(data)},
          {"nodes", nodes},
          {"messages", messages_json(extras)},
          {"no_bound", extras.run != nullptr ? extras.run->no_bound : ""},
          {"summary", summary_json(recorder, extras)},
          {"checks", checks_json(extras)},
          {"faults", extras.run != nullptr ? faults_meta(extras.run->faults) : Json::array()},
          {"causes", causes},
          {"databases", databases_json(extras)},
          {"statements", statements_json(recorder, extras)},
          {"remote", remote_json(extras)},
          {"view", view_json(recorder, extras)},
          {"truncated", truncated_json(recorder)},
          {"origin_ns", ns(recorder.started() - extras.zero)},
          {"detail_end_ns", ns(recorder.details_ended() - recorder.started())}};
}

std::string script_json(const Json &json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace vericansim
