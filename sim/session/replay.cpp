// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Replay of recorded traffic: a scenario of its own, run by a session.
#include "session/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "session/session.hpp"
#include "timing/bittime.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

BitTiming timing_for(const ReplayOptions &options) {
  const BitTimingRequest request = bit_timing_request(options.clock_hz, options.bitrate);
  const auto timings = find_bit_timings(request);
  if (timings.empty())
    throw InputError("--clock", 0,
                     fmt::format("no setting of 8 to 25 quanta gives {} bit/s from {} Hz",
                                 request.bitrate, request.clock_hz));
  return timings.front().timing;
}

// Ends of the range at the first and the last node, and phases that are no fraction of a period.
NodeSpec node_for(const ReplayOptions &options, NodeId id) {
  const double place = static_cast<double>(id) / (options.nodes - 1);
  NodeSpec node;
  node.name = fmt::format("node{}", id);
  node.clock = {.frequency_hz = options.clock_hz, .error_ppm = options.ppm * (1 - 2 * place)};
  node.clock.phase = options.ppm == 0 ? 0 : static_cast<Time>(id) * 7'919;
  node.link.cable = cable_delay(options.cable_m * std::abs(place - 0.5));
  node.num_mb = options.num_mb;
  return node;
}

/// The first of `options.senders` nodes that share the log.
ReplayRole role_for(const CanLog &log, const ReplayOptions &options) {
  ReplayRole role;
  role.file = options.file.empty() ? "the recording" : options.file;
  role.log = std::make_shared<const CanLog>(log);
  role.saturated = options.fast;
  role.frames = options.limit;
  role.shares = options.senders;
  return role;
}

/// What node `id` sends has come to all others, and nothing else has.
ReplayNode node_report(const RunReport &run, NodeId id) {
  const NodeReport &seen = run.nodes[id];
  ReplayNode node;
  node.name = seen.name;
  node.counts = seen.counts;
  node.received = seen.received;
  std::uint64_t right = 0;
  for (const ReplayResult &replay : run.replays) {
    if (replay.node == node.name) {
      node.to_send = replay.frames;
      node.sent = replay.sent;
    }
    for (const ReplayReceiver &receiver : replay.receivers) {
      if (receiver.node != node.name) continue;
      node.expected += receiver.expected;
      right += receiver.received;
      if (node.first_difference.empty()) node.first_difference = receiver.first_difference;
    }
  }
  if (node.first_difference.empty() && node.received != right && !run.interrupted)
    node.first_difference = fmt::format("{} frames more than were sent", node.received - right);
  node.complete = node.first_difference.empty();
  return node;
}

ReplayReport summary(const CanLog &log, RunReport run) {
  ReplayReport report;
  report.interrupted = run.interrupted;
  report.on_bus = run.frames;
  report.error_frames = run.error_frames;
  report.skipped = log.skipped;
  report.duration = run.duration;
  report.load = run.load;
  report.wall_seconds = run.wall_seconds;
  report.node_cycles = run.node_cycles;
  for (const ReplayResult &replay : run.replays) {
    report.frames += replay.frames;
    report.longest_gap = std::max(report.longest_gap, replay.longest_gap);
    if (report.failure.empty()) report.failure = replay.failure;
  }
  for (NodeId id = 0; id < run.nodes.size(); ++id) report.nodes.push_back(node_report(run, id));
  for (std::size_t i = 0; i < std::min(report.frames, log.entries.size()); ++i)
    report.recorded = std::max(report.recorded, log.entries[i].time);
  report.run = std::move(run);
  return report;
}

}  // namespace

bool ReplayReport::ok() const {
  return run.ok() && failure.empty() && on_bus == frames && error_frames == 0 &&
         std::all_of(nodes.begin(), nodes.end(), [](const ReplayNode &n) { return n.complete; });
}

Scenario replay_scenario(const CanLog &log, const ReplayOptions &options) {
  if (options.nodes < 2 || options.nodes > Bus::kMaxNodes || options.senders < 1 ||
      options.senders > options.nodes)
    throw std::invalid_argument("a replay needs 2 to 64 nodes and 1 to that many senders");
  Scenario scenario;
  scenario.name = options.file.empty() ? "Replay" : "Replay of " + options.file;
  scenario.file = fmt::format(
      "{} frames of a recording",
      options.limit == 0 ? log.entries.size() : std::min(options.limit, log.entries.size()));
  scenario.bitrates = {options.bitrate};
  scenario.endless = true;
  scenario.until_done = true;
  scenario.outputs = options.outputs;
  ReplayRole role = role_for(log, options);
  for (NodeId id = 0; id < options.nodes; ++id) {
    scenario.nodes.push_back(node_for(options, id));
    scenario.nodes.back().timing = timing_for(options);
    role.share = id;
    if (id < options.senders) scenario.nodes.back().role = role;
  }
  return scenario;
}

Scenario replay_scenario(Scenario bus, const CanLog &log, const ReplayOptions &options) {
  ReplayRole role = role_for(log, options);
  for (; role.share < options.senders; ++role.share) {
    const std::string name = role.share == 0 ? "replay" : fmt::format("replay{}", role.share + 1);
    NodeSpec &node = bus.nodes[take_node(bus, name, "sends the recording", options.clock_hz)];
    if (!node.software)
      throw InputError(bus.file, node.line,
                       fmt::format("node '{}', which sends the recording, has 'software: none'; "
                                   "allowed: 'host'",
                                   name));
    node.role = role;
  }
  bus.endless = true;
  bus.until_done = true;
  return bus;
}

ReplayReport replay(const CanLog &log, const ReplayOptions &options,
                    const std::function<void(double)> &progress) {
  SessionOptions session_options;
  session_options.progress = progress;
  Session session{{{replay_scenario(log, options), options.bitrate}}, std::move(session_options)};
  session.start();
  if (options.fault != nullptr) session.simulation().bus().add(*options.fault);
  while (session.round()) {
  }
  return summary(log, session.finish().front());
}

}  // namespace vericansim
