// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bridge: see bridge.hpp.
#include "bridge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "bus/range.hpp"
#include "frame_form.hpp"
#include "scenario/runner.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

// Real time between two looks at the programs, ns: while something is under way, and else.
constexpr WallTime kBusyTick = 500'000;
constexpr WallTime kQuietTick = 5'000'000;
// While a port is down, or has no room: look again after.
constexpr WallTime kDownTick = 100'000'000;
constexpr WallTime kRefusedTick = 1'000'000;
// Longest stretch of simulation without a look at the programs.
constexpr Time kLongestStretch = 2 * kMillisecond;
// What a fast bridge simulates at once, bits: a few frames, and between two looks for quiet.
constexpr Time kFastStretch = 512;
constexpr Time kQuietLook = 16;

}  // namespace

// ---- Building

Bridge::Bridge(BridgeSetup setup, Wall &wall)
    : setup_{std::move(setup)}, wall_{wall}, bit_time_{bit_time_of(setup_.bitrate)} {
  // Its traffic goes on as long as the bridge does.
  setup_.scenario.duration = std::numeric_limits<Time>::max() / 4;
  place_nodes();
  for (const NodeId id : ids_) setup_.scenario.nodes[id].role = OwnRole{};
  simulation_ = std::make_unique<Simulation>(setup_.scenario, setup_.bitrate);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const NodeSpec &spec = setup_.scenario.nodes[ids_[i]];
    nodes_.push_back(std::make_unique<PortNode>(*setup_.ports[i], simulation_->node(ids_[i]),
                                                timing_of(setup_.scenario, spec, setup_.bitrate),
                                                setup_.options));
    by_id_[ids_[i]] = nodes_.back().get();
  }
  simulation_->bus().add(*this);
  if (setup_.monitor) {
    simulation_->on_bus_frame = [this](const BusFrame &frame) { on_frame(frame); };
    simulation_->on_bus_event = [this](const BusEvent &event) { on_event(event); };
  }
  was_up_.assign(all_ports().size(), 1);
}

Bridge::~Bridge() { simulation_->bus().remove(*this); }

void Bridge::place_nodes() {
  for (const auto &port : setup_.ports)
    ids_.push_back(find_or_add_node(setup_.scenario, port->name(), setup_.port_clock_hz));
  for (const TrafficSpec &traffic : setup_.scenario.traffic)
    if (std::find(ids_.begin(), ids_.end(), traffic.node) != ids_.end())
      throw InputError(
          setup_.scenario.file, 0,
          fmt::format("traffic '{}' is that of node '{}', which programs of the host work; "
                      "allowed: the other nodes",
                      traffic.name, setup_.scenario.nodes[traffic.node].name));
}

std::vector<CanPort *> Bridge::all_ports() const {
  std::vector<CanPort *> ports;
  for (const auto &port : setup_.ports) ports.push_back(port.get());
  if (setup_.monitor) ports.push_back(setup_.monitor.get());
  return ports;
}

void Bridge::start() {
  constexpr Time kLimit = 100 * kMillisecond;
  constexpr Time kIntegration = 14;  // bits; 11 are needed (IN-01)
  for (const auto &node : nodes_) node->start();
  simulation_->join();
  Bus &bus = simulation_->bus();
  const bool ready = bus.run_until(
      [this] {
        return std::all_of(nodes_.begin(), nodes_.end(), [](const auto &n) { return n->ready(); });
      },
      kLimit);
  for (const auto &node : nodes_) node->check();
  if (!ready) throw std::runtime_error("the set-up of an interface's node takes above 100 ms");
  simulation_->start(bus.now() + kIntegration * bit_time_);
  begin_ = wall_.now();
  cpu_begin_ = std::clock();
  pacer_.start(begin_, bus.now());
  exchange();  // what programs have sent before: nothing may come after it to wake the first round
}

std::string Bridge::description() const {
  std::string names;
  for (const auto &port : setup_.ports) names += (names.empty() ? "" : ", ") + port->name();
  return fmt::format("{} on a bus of {} node{} at {:g} kbit/s{}", names,
                     setup_.scenario.nodes.size(), setup_.scenario.nodes.size() == 1 ? "" : "s",
                     setup_.bitrate / 1e3, setup_.fast ? ", as fast as possible" : "");
}

// ---- What the bus tells

void Bridge::on_bit(NodeId id, const BitRecord &bit) {
  if (const auto node = by_id_.find(id); node != by_id_.end()) node->second->on_bit(bit);
}

void Bridge::on_frame(const BusFrame &frame) {
  ++monitor_counts_.received;
  monitor_box_.push({.frame = to_can_frame(frame.frame), .time = frame.end});
}

void Bridge::on_event(const BusEvent &event) {
  if (setup_.options.errors == ErrorChoice::kOwn)
    if (const auto message = bus_error_message(event))
      monitor_box_.push({.frame = *message, .time = event.end});
}

// ---- Rounds

bool Bridge::idle() const {
  return simulation_->quiet() &&
         std::all_of(nodes_.begin(), nodes_.end(), [](const auto &n) { return n->quiet(); });
}

bool Bridge::quiet() const {
  return idle() && !simulation_->bus().has_actions() &&
         std::none_of(setup_.ports.begin(), setup_.ports.end(),
                      [](const auto &port) { return port->awaits_time(); });
}

bool Bridge::stalled() const {
  return monitor_box_.size() > kMostWaiting ||
         std::any_of(nodes_.begin(), nodes_.end(),
                     [](const auto &n) { return n->waiting() > kMostWaiting; });
}

bool Bridge::all_up() const {
  const auto ports = all_ports();
  return std::all_of(ports.begin(), ports.end(), [](const CanPort *port) { return port->up(); });
}

// How long to wait for the programs if they do not come; unset: for ever.
std::optional<WallTime> Bridge::patience() {
  std::optional<WallTime> least;
  const auto at_most = [&least](WallTime limit) { least = std::min(least.value_or(limit), limit); };
  if (!all_up()) at_most(kDownTick);
  if (refused_) at_most(kRefusedTick);
  if (stalled()) return least;
  if (setup_.fast) {
    if (!quiet()) at_most(0);
    return least;
  }
  const Time tick = (quiet() ? kQuietTick : kBusyTick) * kNanosecond;
  at_most(std::max<WallTime>(0, pacer_.wall_of(simulation_->bus().now() + tick) - wall_.now()));
  return least;
}

void Bridge::wait() {
  poll_set_.clear();
  const auto ports = all_ports();
  std::vector<std::size_t> begin;
  for (CanPort *port : ports) {
    port->tick(simulation_->bus().now());
    begin.push_back(poll_set_.size());
    port->poll_set(poll_set_, refused_);
  }
  begin.push_back(poll_set_.size());
  wall_.wait(poll_set_, patience());
  const std::span<const pollfd> all{poll_set_};
  for (std::size_t i = 0; i < ports.size(); ++i)
    ports[i]->service(all.subspan(begin[i], begin[i + 1] - begin[i]));
}

void Bridge::advance() {
  if (stalled()) return;
  const Time end = setup_.limit != 0 ? simulation_->started() + setup_.limit
                                     : std::numeric_limits<Time>::max() / 2;
  if (setup_.fast)
    advance_fast(end);
  else
    advance_paced(end);
  simulation_->check();
  for (const auto &node : nodes_) node->check();
  if (elapsed() >= setup_.limit && setup_.limit != 0) ended_ = true;
}

// Runs the bus; where nothing is under way it lets time pass at no cost.
void Bridge::run_until(Time target) {
  Bus &bus = simulation_->bus();
  while (bus.now() < target) {
    if (idle()) {
      simulation_->settle();
      if (bus.skip(target)) continue;
    }
    bus.run_until(std::min(target, bus.now() + kQuietLook * bit_time_));
  }
}

// The bridge may wait without a limit as soon as all is quiet, so that by then the monitor must
// have all frames.
void Bridge::advance_fast(Time end) {
  const Time stretch = simulation_->bus().now() + kFastStretch * bit_time_;
  if (!quiet()) run_until(std::min(end, stretch));
  if (quiet()) simulation_->settle();
}

// What programs send is taken after this, so that no frame is on the bus before it was sent.
void Bridge::advance_paced(Time end) {
  const Time now = simulation_->bus().now();
  const Time due = pacer_.due(wall_.now());
  const Time reach = quiet() ? due : now + kLongestStretch;
  run_until(std::min({due, end, reach}));
  if (pacer_.reached(wall_.now(), simulation_->bus().now()))
    setup_.say(
        fmt::format("the simulation lags {:.0f} ms behind real time; fewer nodes, a slower "
                    "clock or bit rate, or --fast help",
                    static_cast<double>(pacer_.lag()) / 1e6));
}

void Bridge::give() {
  for (const auto &node : nodes_)
    if (!node->give()) refused_ = true;
  if (setup_.monitor && !monitor_box_.give_to(*setup_.monitor, monitor_counts_)) refused_ = true;
}

void Bridge::exchange() {
  refused_ = false;
  give();
  for (const auto &node : nodes_) node->take();
}

void Bridge::watch(const CanPort &port, char &was_up) {
  if (port.up() == (was_up != 0)) return;
  was_up = port.up() ? 1 : 0;
  if (port.up()) {
    setup_.say(fmt::format("{} is back", port.name()));
    return;
  }
  setup_.say(fmt::format("{} is down or gone; {}", port.name(),
                         setup_.end_when_down ? "this is the end" : "waiting for it"));
  if (setup_.end_when_down) ended_ = true;
}

void Bridge::watch_ports() {
  const auto ports = all_ports();
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const bool was_down = was_up_[i] == 0;
    watch(*ports[i], was_up_[i]);
    // As on hardware: an interface that comes up starts its controller.
    if (was_down && ports[i]->up() && i < nodes_.size()) nodes_[i]->restart();
  }
  if (wall_.restart_requested())
    for (const auto &node : nodes_) node->restart();
}

bool Bridge::round() {
  wait();
  advance();
  exchange();
  watch_ports();
  return !ended_ && !wall_.stop_requested();
}

// ---- End

void Bridge::drain() {
  Bus &bus = simulation_->bus();
  const Time end = bus.now() + setup_.scenario.drain;
  while (bus.now() < end && !idle()) bus.run_until(bus.now() + kQuietLook * bit_time_);
  simulation_->drain();
  give_last();
}

// The programs get what the bus had for them, if they take it within a second.
void Bridge::give_last() {
  constexpr WallTime kPatience = 1'000'000'000;
  const WallTime end = wall_.now() + kPatience;
  do {
    refused_ = false;
    give();
    poll_set_.clear();
    if (refused_) wall_.wait(poll_set_, kRefusedTick);
  } while (refused_ && wall_.now() < end);
}

BridgeReport Bridge::finish() {
  drain();
  BridgeReport report;
  report.bus = simulation_->finish();
  report.fast = setup_.fast;
  report.wall_seconds = static_cast<double>(wall_.now() - begin_) / 1e9;
  report.bus.wall_seconds = report.wall_seconds;
  report.cpu_seconds = static_cast<double>(std::clock() - cpu_begin_) / CLOCKS_PER_SEC;
  report.lag = pacer_.lag();
  report.largest_lag = pacer_.largest_lag();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const PortNode &node = *nodes_[i];
    CanPort &port = *setup_.ports[i];
    const std::size_t left = port.remaining();
    PortCounts counts = node.counts();
    counts.from_host += left;
    report.ports.push_back({port.name(), false, port.up(), node.bus_off(), counts, port.lost(),
                            node.pending() + left, node.waiting()});
  }
  if (setup_.monitor)
    report.ports.push_back({setup_.monitor->name(), true, setup_.monitor->up(), false,
                            monitor_counts_, setup_.monitor->lost(), 0, monitor_box_.size()});
  return report;
}

BridgeReport Bridge::run() {
  start();
  while (round()) {
  }
  return finish();
}

}  // namespace vericansim
