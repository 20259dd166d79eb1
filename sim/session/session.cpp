// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Session: building, start and end; session_rounds.cpp has what happens between.
#include "session/session.hpp"

#include <algorithm>
#include <stdexcept>

#include "bus/range.hpp"
#include "session/live_bus.hpp"

namespace vericansim {
// ---- Building

Session::Session(std::vector<SessionBus> buses, SessionOptions options)
    : options_{std::move(options)},
      wall_{options_.wall != nullptr ? *options_.wall : static_cast<Wall &>(steady_)} {
  if (buses.empty()) throw std::invalid_argument("a session needs a bus");
  for (SessionBus &bus : buses) {
    // Traffic goes on as long as the session does.
    if (bus.scenario.endless) bus.scenario.duration = kNoLimit;
    buses_.push_back(std::make_unique<LiveBus>(std::move(bus)));
  }
  bit_time_ = bit_time_of(simulation().bitrate());
  build_workers();
  set_limits();
}

Session::~Session() = default;

void Session::build_workers() {
  std::vector<Simulation *> simulations;
  for (const auto &bus : buses_) simulations.push_back(&bus->simulation());
  const auto add = [&](std::size_t bus, NodeId id, const auto &spec) {
    auto op = make_operator(
        {simulations, bus, id, spec.name, spec.role, spec.line, options_.output, options_.say},
        options_.factories);
    if (!op) return;
    buses_[bus]->add(id, *op);
    if (Outlet *outlet = op->outlet()) outlets_.push_back(outlet);
    workers_.push_back({std::move(op), bus});
  };
  for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
    const Scenario &scenario = buses_[bus]->scenario();
    for (NodeId id = 0; id < scenario.nodes.size(); ++id) add(bus, id, scenario.nodes[id]);
    for (const ListenerSpec &listener : scenario.listeners) add(bus, kAllNodes, listener);
  }
  was_up_.assign(outlets_.size(), 1);
}

void Session::set_limits() {
  // A look at the world after a few frames where programs wait for an answer.
  constexpr Time kFewFrames = 512;  // bits
  constexpr Time kLongest = 10 * kMillisecond;
  constexpr Time kParts = 100;
  const Scenario &scenario = buses_.front()->scenario();
  until_done_ = scenario.until_done;
  limit_ = options_.limit != 0 ? options_.limit : scenario.endless ? kNoLimit : scenario.duration;
  paced_ = scenario.pacing == Pacing::kRealTime;
  stretch_ = kFewFrames * bit_time_;
  if (outlets_.empty()) stretch_ = std::max(stretch_, std::min(kLongest, limit_ / kParts));
  // A judge looks at every bit of every node.
  const bool wanted =
      !outlets_.empty() || std::any_of(workers_.begin(), workers_.end(),
                                       [](const Worker &w) { return w.op->passes_time(); });
  passes_ = buses_.size() == 1 && !scenario.lockstep && wanted;
}

Simulation &Session::simulation(std::size_t bus) { return buses_[bus]->simulation(); }

Time Session::elapsed() const { return now() - start_; }

// ---- Start

// Those who set their nodes up themselves are ready later than start() of the simulation.
void Session::join_workers() {
  constexpr Time kLimit = 100 * kMillisecond;
  constexpr Time kIntegration = 14;  // bits; 11 are needed (IN-01)
  const auto all_ready = [this] {
    return std::all_of(workers_.begin(), workers_.end(),
                       [](const Worker &w) { return w.op->ready(); });
  };
  for (const Worker &worker : workers_) worker.op->start();
  const bool slow = !all_ready();
  for (const auto &bus : buses_) bus->simulation().join();
  for (const auto &bus : buses_) {
    Bus &wire = bus->simulation().bus();
    const bool ready = wire.run_until(all_ready, kLimit);
    for (const Worker &worker : workers_) worker.op->check();
    if (!ready) throw std::runtime_error("the set-up of a node takes longer than 100 ms");
    start_ = std::max(start_, wire.now() + (slow ? kIntegration * bit_time_ : 0));
  }
}

void Session::start() {
  join_workers();
  for (const auto &bus : buses_) bus->simulation().start(start_);
  for (const Worker &worker : workers_) worker.op->begin(start_);
  begin_ = wall_.now();
  cpu_begin_ = std::clock();
  pacer_.start(begin_, start_);
  exchange();  // what programs have sent before: nothing may come after it to wake the first round
}

// ---- End

std::vector<RunReport> Session::run() {
  start();
  while (round()) {
  }
  return finish();
}

std::vector<RunReport> Session::finish() {
  for (const Worker &worker : workers_) worker.op->end(elapsed());
  drain();
  std::vector<RunReport> reports;
  for (std::size_t index = 0; index < buses_.size(); ++index) {
    Simulation &simulation = buses_[index]->simulation();
    simulation.on_report = [this, index](RunReport &report) { describe(index, report); };
    reports.push_back(simulation.finish(interrupted_));
  }
  for (Outlet *outlet : outlets_) outlet->close(reports.front());
  return reports;
}

void Session::describe(std::size_t bus, RunReport &report) {
  report.wall_seconds = static_cast<double>(wall_.now() - begin_) / 1e9;
  if (paced_ || !outlets_.empty())
    report.pace = {!paced_, static_cast<double>(std::clock() - cpu_begin_) / CLOCKS_PER_SEC,
                   pacer_.lag(), pacer_.largest_lag()};
  for (const Worker &worker : workers_)
    if (worker.bus == bus) worker.op->report(report);
}

void Session::drain() {
  constexpr Time kLook = 16;  // bits
  for (const auto &live : buses_) {
    Bus &bus = live->simulation().bus();
    const Time end = bus.now() + live->scenario().drain;
    if (!outlets_.empty())
      while (bus.now() < end && !idle()) bus.run_until(bus.now() + kLook * bit_time_);
    live->simulation().drain(end);
    if (!outlets_.empty()) let_read(live->simulation());
  }
  give_last();
}

// The bus's log has a frame as soon as it has ended, the programs only when the CPU of their node
// has read it; until then no other frame can end.
void Session::let_read(Simulation &simulation) const {
  constexpr Time kRead = 16;  // bits
  std::uint64_t seen = 0;
  do {
    seen = simulation.frames();
    simulation.bus().run_for(kRead * bit_time_);
    simulation.settle();
  } while (simulation.frames() != seen);
}

// The programs get what the bus had for them, if they take it within a second.
void Session::give_last() {
  constexpr WallTime kPatience = 1'000'000'000;
  constexpr WallTime kAgain = 1'000'000;
  if (outlets_.empty()) return;
  const WallTime end = wall_.now() + kPatience;
  do {
    refused_ = false;
    give();
    poll_set_.clear();
    if (refused_) wall_.wait(poll_set_, kAgain);
  } while (refused_ && wall_.now() < end);
}

}  // namespace vericansim
