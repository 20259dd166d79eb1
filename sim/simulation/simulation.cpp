// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulation: see simulation.hpp.
#include "simulation/simulation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "bus/range.hpp"
#include "scenario/bound_scope.hpp"
#include "simulation/expectations.hpp"
#include "simulation/fault_check.hpp"
#include "simulation/node_timing.hpp"
#include "simulation/stop_request.hpp"
#include "simulation/traffic_check.hpp"
#include "timing/analysis.hpp"

namespace vericansim {

Simulation::Simulation(const Scenario &scenario, double bitrate)
    : scenario_{scenario},
      bitrate_{bitrate},
      bit_time_{bit_time_of(bitrate)},
      faults_{scenario},
      sent_(scenario.nodes.size(), SentFrames{bit_time_}) {
  check_faults(scenario_, bitrate_);
  check_traffic(scenario_);
  build_stations();
  remote_ = std::make_unique<RemoteBench>(scenario_, stations_, bus_);
  observe();
  if (scenario_.lockstep) set_up_judge();
}

void Simulation::build_stations() {
  for (NodeId id = 0; id < scenario_.nodes.size(); ++id) {
    const NodeSpec &spec = scenario_.nodes[id];
    HostConfig config = spec.host;
    config.timing = timing_of(scenario_, spec, bitrate_);
    config.tx_buffers = transmit_buffers(scenario_, id);
    if (const auto *remote = std::get_if<RemoteRole>(&spec.role)) {
      stations_.add(bus_, make_remote_station(spec.name, spec.clock, config.timing, *remote),
                    spec.link);
      continue;
    }
    if (!spec.hosted()) {
      stations_.add(bus_, make_bare_station(spec.name, spec.clock, config.timing, spec.num_mb),
                    spec.link);
      continue;
    }
    stations_.add(bus_, make_station(spec.name, spec.clock, config, spec.num_mb), spec.link);
    stations_[id].host->on_received = [this, id](const HostFrame &frame) {
      // A run without end must not need memory without end.
      if (scenario_.expect.complete) stations_[id].received.push_back(frame.frame);
      remote_->on_received(id, frame.frame);
      if (on_host_received) on_host_received(id, frame.frame);
    };
    stations_[id].host->on_sent = [this, id](const HostFrame &frame) { on_sent(id, frame.frame); };
  }
}

void Simulation::observe() {
  Time longest_bit = bit_time_;
  for (NodeId id = 0; id < stations_.size(); ++id)
    longest_bit =
        std::max(longest_bit, static_cast<Time>(stations_[id].timing.clocks_per_bit() * 1e12 /
                                                scenario_.nodes[id].clock.frequency_hz));
  // In the middle of the last quantum of PS1: a node that a glitch has moved on by SJW sends edges
  // where the next one would be, and the others still read them (SY-08).
  const BitTiming &first = stations_[0].timing;
  monitor_ =
      std::make_unique<BusMonitor>(bus_, bit_time_, 1.0 - (first.ps2 + 0.5) / first.quanta());
  monitor_->on_frame = [this](const BusFrame &frame) { on_frame(frame); };
  monitor_->on_event = [this](const BusEvent &event) {
    if (on_bus_event) on_bus_event(event);
  };
  bus_.add(*monitor_);
  outputs_ = std::make_unique<BusOutputs>(scenario_.outputs, bus_, longest_bit);
  outputs_->record(bus_, *monitor_, report_setup());
}

ReportSetup Simulation::report_setup() const {
  ReportSetup setup{scenario_.name, scenario_.file, bitrate_, bit_time_, {}};
  for (NodeId id = 0; id < stations_.size(); ++id) setup.timings.push_back(stations_[id].timing);
  return setup;
}

ReportExtras Simulation::report_extras(const RunReport &report) const {
  ReportExtras extras;
  extras.run = &report;
  extras.remote = remote_->columns();
  for (const TrafficSpec &spec : scenario_.traffic)
    extras.messages.push_back({spec.node, spec.frame, spec.period});
  return extras;
}

void Simulation::start_accesses() {
  std::vector<AccessScript *> script(scenario_.nodes.size());
  for (const AccessSpec &spec : scenario_.accesses) {
    if (script[spec.node] == nullptr) {
      scripts_.push_back(std::make_unique<AccessScript>(*stations_[spec.node].node, bus_));
      script[spec.node] = scripts_.back().get();
    }
    script[spec.node]->add(spec, start_ + spec.at);
  }
}

void Simulation::on_frame(const BusFrame &frame) {
  if (scenario_.expect.complete) frames_.push_back(frame);
  outputs_->write(frame, origin_of(frame));
  remote_->on_frame(frame, monitor_->busy());
  if (judge_) judge_->on_wire(frame);
  if (on_bus_frame) on_bus_frame(frame);
}

bool Simulation::quiet() const {
  for (NodeId id = 0; id < stations_.size(); ++id) {
    const Station &station = stations_[id];
    if (station.remote && !station.remote->idle()) return false;
    if (!station.host) continue;
    const Field field = trace_field(station.node->trace());
    const bool off = field == Field::kBusOff && scenario_.nodes[id].host.boff_rec;
    if (!off && (field != Field::kIdle || station.host->pending() != 0)) return false;
  }
  return true;
}

void Simulation::drain() { drain(bus_.now() + scenario_.drain); }

void Simulation::drain(Time limit) {
  while (bus_.now() < limit && stations_.pending() != 0 && !stop_requested())
    bus_.run_until(std::min(limit, bus_.now() + 20 * bit_time_));
  bus_.run_for(16 * bit_time_);
  stations_.check();
  monitor_->advance(bus_.now());
}

void Simulation::add_bounds(RunReport &report) const {
  if (traffic_.empty()) return;
  report.no_bound = why_no_bound(scenario_);
  if (!report.no_bound.empty()) return;
  std::vector<std::size_t> order(traffic_.size());
  std::iota(order.begin(), order.end(), 0);
  // Priority on the bus: the bits of the arbitration field in their order (AR-06).
  const auto priority = [&](std::size_t i) {
    const Frame &f = traffic_[i]->spec().frame;
    const std::uint64_t base = f.extended ? f.id >> 18 : f.id;
    return base << 21 | (f.extended ? (3ULL << 19 | (f.id & 0x3FFFF) << 1 | (f.remote ? 1 : 0))
                                    : (f.remote ? 1ULL << 20 : 0));
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return priority(a) < priority(b); });
  std::vector<MessageSpec> set;
  for (const std::size_t i : order) {
    const TrafficSpec &t = traffic_[i]->spec();
    const Time period = t.period != 0 ? t.period : scenario_.duration + scenario_.drain;
    set.push_back({t.frame.payload_size(), t.frame.extended, period, t.jitter});
  }
  const auto bounds = response_times(set, bit_time_);
  for (std::size_t i = 0; i < order.size(); ++i) report.messages[order[i]].bound = bounds[i];
  report.analytic_load = worst_case_load(set, bit_time_);
}

RunReport Simulation::collect(bool interrupted) {
  RunReport report;
  report.interrupted = interrupted;
  report.name = scenario_.name;
  report.bitrate = bitrate_;
  report.duration = bus_.now() - start_;
  report.frames = monitor_->frames();
  report.unacknowledged = monitor_->unacknowledged();
  report.error_frames = monitor_->error_frames();
  report.overload_frames = monitor_->overload_frames();
  report.pending = stations_.pending();
  if (report.duration > 0)
    report.load = static_cast<double>(monitor_->busy()) / static_cast<double>(report.duration);
  for (NodeId id = 0; id < stations_.size(); ++id)
    forget_lost(id, std::numeric_limits<Time>::max());
  for (const auto &traffic : traffic_) {
    report.messages.push_back(traffic->report());
    MessageReport &message = report.messages.back();
    message.unsaid =
        message.queued == 0 && !scenario_.expect.given && !scenario_.cut_short && !interrupted;
  }
  for (NodeId id = 0; id < stations_.size(); ++id) {
    const Station &station = stations_[id];
    const BusReport ahb = station.node ? station.node->ahb().report() : BusReport{};
    // What software of somebody else has read is not known; its core has accepted this much.
    const std::uint64_t received =
        station.host ? station.host->stats().received : monitor_->node(id).delivered;
    report.nodes.push_back({scenario_.nodes[id].name, monitor_->node(id), received,
                            station.host ? station.host->stats().overruns : 0, ahb.transfers,
                            ahb.max_waits, ahb.violations, station.host != nullptr});
  }
  if (outputs_->signals() != nullptr) report.signals = outputs_->signals()->report();
  report.show_signals = scenario_.outputs.signals;
  report.identifiers = outputs_->identifiers();
  report.show_identifiers = scenario_.outputs.ids;
  report.faults = faults_.report(bus_.now());
  report.node_cycles = stations_.cycles();
  if (scenario_.analysis || scenario_.expect.within_bound) add_bounds(report);
  remote_->describe(report);
  if (on_report) on_report(report);
  if (!interrupted) check_all(report);
  return report;
}

void Simulation::check_all(RunReport &report) {
  std::vector<std::vector<Frame>> received;
  for (NodeId id = 0; id < stations_.size(); ++id) received.push_back(stations_[id].received);
  if (!stations_.stores_remote())
    std::erase_if(frames_, [](const BusFrame &frame) { return frame.frame.remote; });
  for (CheckResult &check : check_expectations(scenario_, report, frames_, received))
    report.checks.push_back(std::move(check));
  for (const auto &script : scripts_)
    for (const CheckResult &failure : script->failures()) report.checks.push_back(failure);
  remote_->check(report);
  if (judge_) add_judgement(report);
}

void Simulation::join() { stations_.join(bus_, bit_time_); }

void Simulation::start(Time when) {
  bus_.run_until(when);
  start_ = bus_.now();
  faults_.add_to(bus_, start_, bit_time_,
                 [this](NodeId id) { return stations_[id].timing.prescaler; });
  outputs_->begin(start_);
  if (judge_) add_disturbances();
  stations_.start_remote_nodes();
  start_traffic();
  start_accesses();
  remote_->start(start_, start_ + scenario_.duration);
}

RunReport Simulation::finish(bool interrupted) {
  monitor_->close(bus_.now());
  if (judge_) judge_->finish(bus_.now());
  outputs_->finish(bus_.now());
  RunReport report = collect(interrupted);
  outputs_->write_report(report_extras(report));
  return report;
}

}  // namespace vericansim
