// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteBench: see remote_bench.hpp.
#include "simulation/remote_bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bus/range.hpp"
#include "simulation/expectations.hpp"
#include "timing/analysis.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

constexpr std::size_t kNoUnit = std::numeric_limits<std::size_t>::max();

/// The largest error that a clock of the scenario may have. A fault sets its error, beside which it
/// goes on to wander.
double largest_ppm(const Scenario &scenario) {
  double ppm = 0;
  for (const NodeSpec &node : scenario.nodes)
    ppm = std::max(ppm, std::fabs(node.clock.error_ppm) + node.clock.wander_ppm);
  for (const FaultSpec &fault : scenario.faults)
    if (fault.kind == FaultSpec::Kind::kClock)
      ppm = std::max(ppm, std::fabs(fault.ppm) + scenario.nodes[fault.node].clock.wander_ppm);
  return ppm;
}

}  // namespace

RemoteBench::RemoteBench(const Scenario &scenario, Stations &stations, Bus &bus)
    : scenario_{scenario}, stations_{stations} {
  watch(bus);
  for (const RemoteCommandSpec &spec : scenario.commands) {
    const bool there = std::any_of(scripts_.begin(), scripts_.end(),
                                   [&](const auto &one) { return one->node() == spec.node; });
    if (there) continue;
    scripts_.push_back(std::make_unique<RemoteScript>(spec.node, scenario.nodes[spec.node].name,
                                                      *stations[spec.node].host, bus));
    scripts_.back()->on_command = [this](const Frame &frame) { watch_->commanded(frame); };
  }
  for (const UserSpec &spec : scenario.user) add_user(spec, bus);
  for (std::size_t index = 0; index < nodes_.size(); ++index)
    stations[nodes_[index]].remote->on_pulse = [this, index](const RemotePulse &pulse) {
      story_->written(index);
      if (!pulse.apply) return;
      watch_->applied(index);
      for (const auto &user : users_)
        if (user->spec().node == nodes_[index]) user->applied();
    };
}

void RemoteBench::watch(Bus &bus) {
  std::vector<WatchedUnit> units;
  std::vector<BitTiming> timings;
  for (NodeId id = 0; id < scenario_.nodes.size(); ++id) {
    timings.push_back(stations_[id].timing);
    const auto *role = std::get_if<RemoteRole>(&scenario_.nodes[id].role);
    if (role == nullptr) continue;
    nodes_.push_back(id);
    units.push_back(
        {id, stations_[id].remote.get(), role->config, role->number, stations_[id].remote_is_rtl});
  }
  watch_ = std::make_unique<RemoteWatch>(bus, units, std::move(timings), largest_ppm(scenario_));
  if (nodes_.empty()) return;
  bus.add(*watch_);
  story_ = std::make_unique<RemoteStory>(bus, units, !scenario_.outputs.report.empty());
  bus.add(*story_);
  watch_->on_cycle = [this](const BusFrame &trigger, std::size_t nodes, Time skew) {
    story_->on_cycle(trigger, nodes, skew);
  };
}

std::size_t RemoteBench::unit_of(NodeId node) const {
  return static_cast<std::size_t>(std::find(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
}

void RemoteBench::add_user(const UserSpec &spec, Bus &bus) {
  users_.push_back(std::make_unique<RemoteUser>(spec, *stations_[spec.node].remote, bus));
  if (story_->for_page())
    users_.back()->on_written = [this, index = unit_of(spec.node)] { story_->written(index); };
  if (!spec.plant || !spec.event) return;
  users_.back()->on_measured = [this, index = unit_of(spec.node), address = spec.plant->measured](
                                   std::uint32_t word) { watch_->measured(index, address, word); };
}

void RemoteBench::start(Time start, Time stop) {
  watch_->begin(start);
  if (story_) story_->begin();
  for (const RemoteCommandSpec &spec : scenario_.commands)
    for (const auto &script : scripts_)
      if (script->node() == spec.node) script->add(spec, start, stop);
  for (const auto &user : users_) user->start(start, stop);
}

void RemoteBench::on_received(NodeId node, const Frame &frame) {
  for (const auto &script : scripts_)
    if (script->node() == node) script->on_received(frame);
}

void RemoteBench::on_frame(const BusFrame &frame, Time busy) {
  for (const auto &script : scripts_) script->on_frame(frame);
  watch_->on_frame(frame, busy);
  if (story_) story_->on_frame(frame);
}

void RemoteBench::describe(RunReport &report) {
  report.remote = watch_->report();
  if (story_) {
    story_->finish();
    story_->describe(report.remote);
  }
  for (const auto &script : scripts_) {
    report.remote.commands += script->done();
    report.remote.hosts.push_back(script->name());
    for (MessageReport &message : script->messages()) report.messages.push_back(message);
  }
  if (scenario_.analysis) add_bounds(report.remote, bit_time_of(report.bitrate));
}

// All that the host sends again and again, and the measurements, each once a round: all queued at
// one moment is the worst that can be, also where the host's frames are out of the way by then.
void RemoteBench::add_bounds(RemoteReport &report, Time bit_time) const {
  struct Message {
    unsigned id;
    MessageSpec spec;
    std::size_t unit;
  };
  std::vector<Message> all;
  Time period = 0;
  for (const RemoteCommandSpec &commands : scenario_.commands) {
    if (commands.period == 0) continue;
    period = period == 0 ? commands.period : std::min(period, commands.period);
    for (const RemoteStep &step : commands.steps)
      all.push_back({step.frame.id, {step.frame.payload_size(), false, commands.period}, kNoUnit});
  }
  if (period == 0) return;
  for (const auto &user : users_) {
    const UserSpec &spec = user->spec();
    if (!spec.plant || !spec.event) continue;
    const auto &role = std::get<RemoteRole>(scenario_.nodes[spec.node].role);
    all.push_back({role.config.id(1, role.number, spec.plant->measured),
                   {4, false, period},
                   unit_of(spec.node)});
  }
  std::sort(all.begin(), all.end(), [](const Message &a, const Message &b) { return a.id < b.id; });
  std::vector<MessageSpec> set;
  for (const Message &message : all) set.push_back(message.spec);
  const auto bounds = response_times(set, bit_time);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].unit != kNoUnit) report.nodes[all[i].unit].bound = bounds[i];
}

void RemoteBench::check(RunReport &report) const {
  for (const auto &script : scripts_)
    for (const CheckResult &failure : script->failures()) report.checks.push_back(failure);
  for (const auto &user : users_)
    if (user->never_acts())
      report.checks.push_back(
          {fmt::format(
               "{}: user {}", scenario_.nodes[user->spec().node].name,
               user->spec().after_apply ? "after apply" : "at " + readable_time(user->spec().at)),
           "done", "not until the end", false});
  const RemoteExpectations &expect = scenario_.expect.remote;
  check_bytes(report);
  check_numbers(report);
  const bool compared = report.remote.compared != 0;
  const std::string seen =
      compared ? readable_time(report.remote.skew_longest) : "no two nodes that act";
  if (expect.trigger_skew)
    report.checks.push_back({"trigger_skew", "at most " + readable_time(*expect.trigger_skew), seen,
                             compared && report.remote.skew_longest <= *expect.trigger_skew});
  if (expect.skew_within_bound)
    report.checks.push_back({"trigger_skew", "within the bound of each pair in each cycle", seen,
                             compared && report.remote.above_bound == 0});
  for (const auto &[node, state] : expect.states) {
    const RemoteNodeReport &unit = report.remote.nodes[unit_of(node)];
    report.checks.push_back({unit.name + ".state", state, unit.state, unit.state == state});
  }
}

// Where nothing could be counted, a 0 has not been found to be right.
void RemoteBench::check_numbers(RunReport &report) const {
  for (const auto &[key, range] : scenario_.expect.remote.numbers) {
    CheckResult result = check_number(key, static_cast<double>(report.remote.total(key)), range);
    if (const std::string none = report.remote.unseen(key); !none.empty()) {
      result.seen = none;
      result.ok = false;
    }
    report.checks.push_back(std::move(result));
  }
}

void RemoteBench::check_bytes(RunReport &report) const {
  for (const RemoteExpectations::Bytes &wanted : scenario_.expect.remote.memory) {
    std::vector<unsigned> seen;
    for (std::size_t i = 0; i < wanted.bytes.size(); ++i)
      seen.push_back(
          stations_[wanted.node].remote->peek(wanted.address + static_cast<unsigned>(i)));
    report.checks.push_back(
        {fmt::format("{} 0x{:03X}", scenario_.nodes[wanted.node].name, wanted.address),
         fmt::format("{:02X}", fmt::join(wanted.bytes, " ")),
         fmt::format("{:02X}", fmt::join(seen, " ")),
         std::equal(seen.begin(), seen.end(), wanted.bytes.begin(), wanted.bytes.end())});
  }
}

}  // namespace vericansim
