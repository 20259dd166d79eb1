// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ProgramBus: see program_bus.hpp.
#include "program_bus.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "bridge/frame_form.hpp"
#include "bus/range.hpp"
#include "simulation/node_timing.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

double chosen_rate(std::optional<double> wanted, const Scenario &scenario) {
  const double rate = wanted.value_or(scenario.bitrates.front());
  if (!(rate >= 1e3 && rate <= 1e6))
    throw std::invalid_argument(
        fmt::format("bitrate {:g}: 1000 to 1000000 bit/s are allowed", rate));
  return rate;
}

bool writes_files(const Outputs &outputs) {
  const auto names = {&outputs.vcd,    &outputs.fst,         &outputs.candump, &outputs.pcap,
                      &outputs.report, &outputs.signals_csv, &outputs.ids_csv};
  return std::any_of(names.begin(), names.end(),
                     [](const std::string *name) { return !name->empty(); });
}

}  // namespace

// ---- Building

Scenario ProgramBus::with_nodes(ProgramBusSetup &setup) {
  for (const std::string &name : setup.nodes) {
    if (text::has_control(name))
      throw std::invalid_argument("a node's name has a control character; allowed: others");
    if (name.empty() || name == "all")  // of which disturb() and scenarios mean all nodes
      throw std::invalid_argument(
          fmt::format("node name '{}': other names are allowed, of at least one letter", name));
    if (std::count(setup.nodes.begin(), setup.nodes.end(), name) > 1)
      throw std::invalid_argument(fmt::format("node name '{}' is used twice", name));
    const NodeId id = take_buffers(setup.scenario, name, "the program works", setup.clock_hz);
    // A role of its own keeps the simulation's software away; no session will ever ask it.
    setup.scenario.nodes[id].role = OwnRole{};
  }
  for (const NodeSpec &node : setup.scenario.nodes)
    if (has_programs(node.role))
      throw std::invalid_argument(fmt::format(
          "node '{}' is a {}: on a program's own bus nodes are worked by it or by traffic",
          node.name, name_of(node.role)));
  if (setup.scenario.nodes.empty())
    throw std::invalid_argument(fmt::format("no node is given; allowed: 1 to {}", Bus::kMaxNodes));
  return std::move(setup.scenario);
}

ProgramBus::ProgramBus(ProgramBusSetup setup)
    : process_{::getpid()},
      scenario_{with_nodes(setup)},
      simulation_{scenario_, chosen_rate(setup.bitrate, scenario_)},
      bit_time_{bit_time_of(simulation_.bitrate())},
      by_id_(scenario_.nodes.size()) {
  PortOptions options;
  options.restart = setup.restart;
  options.by_identifier = setup.by_identifier;
  for (const std::string &name : setup.nodes) {
    const NodeId id = id_of(name);
    auto port = std::make_unique<ProgramPort>(name);
    auto node = std::make_unique<PortNode>(
        *port, simulation_.node(id),
        timing_of(scenario_, scenario_.nodes[id], simulation_.bitrate()), options);
    by_id_[id] = node.get();
    worked_.push_back({id, std::move(port), std::move(node)});
  }
  simulation_.bus().add(*this);
  simulation_.on_bus_frame = [this](const BusFrame &frame) { frames_.push_back(frame); };
  simulation_.on_bus_event = [this](const BusEvent &event) { events_.push_back(event); };
  join();
}

ProgramBus::~ProgramBus() { simulation_.bus().remove(*this); }

void ProgramBus::join() {
  constexpr Time kLimit = 100 * kMillisecond;
  constexpr Time kIntegration = 14;  // bits; 11 are needed (IN-01)
  for (const Worked &worked : worked_) worked.node->start();
  simulation_.join();
  Bus &bus = simulation_.bus();
  const bool ready = bus.run_until(
      [this] {
        return std::all_of(worked_.begin(), worked_.end(),
                           [](const Worked &worked) { return worked.node->ready(); });
      },
      kLimit);
  for (const Worked &worked : worked_) worked.node->check();
  if (!ready) throw std::runtime_error("the set-up of a node takes longer than 100 ms");
  simulation_.start(bus.now() + kIntegration * bit_time_);
}

// ---- Nodes

NodeId ProgramBus::id_of(const std::string &name) const {
  for (NodeId id = 0; id < scenario_.nodes.size(); ++id)
    if (scenario_.nodes[id].name == name) return id;
  throw std::invalid_argument(
      fmt::format("no node '{}' on this bus; there are {}", name, fmt::join(names(), ", ")));
}

ProgramBus::Worked &ProgramBus::worked(const std::string &name) {
  const NodeId id = id_of(name);
  for (Worked &worked : worked_)
    if (worked.id == id) return worked;
  throw std::invalid_argument(
      fmt::format("node '{}' is worked by the scenario, not by the program", name));
}

std::vector<std::string> ProgramBus::names() const {
  std::vector<std::string> names;
  for (const NodeSpec &node : scenario_.nodes) names.push_back(node.name);
  return names;
}

void ProgramBus::send(const std::string &node, const can_frame &frame) {
  if (!from_can_frame(frame))
    throw std::invalid_argument(
        "no frame that a node could send: an error message, or an 11-bit "
        "identifier above 0x7FF");
  check_open();
  worked(node).port->send(frame);
}

std::vector<PortMessage> ProgramBus::receive(const std::string &node) {
  return worked(node).port->receive();
}

std::size_t ProgramBus::pending(const std::string &node) {
  const Worked &of = worked(node);
  return of.port->remaining() + of.node->pending();
}

void ProgramBus::restart(const std::string &node) {
  check_open();
  worked(node).node->restart();
}

Trace ProgramBus::trace(const std::string &node) {
  return decode_trace(simulation_.bus().node(id_of(node)).trace());
}

void ProgramBus::on_bit(NodeId id, const BitRecord &bit) {
  if (by_id_[id] != nullptr) by_id_[id]->on_bit(bit);
}

// ---- Time

bool ProgramBus::files_of_another() const {
  return process_ != ::getpid() && writes_files(scenario_.outputs);
}

void ProgramBus::check_process() const {
  if (files_of_another())
    throw std::runtime_error(
        "this bus writes files, which are those of the process that opened it");
}

void ProgramBus::check_open() const {
  check_process();
  if (finished_)
    throw std::runtime_error(
        "no frame is sent, no step made, no node disturbed or restarted after finish()");
}

Time ProgramBus::end_of(Time duration) {
  if (duration < 0) throw std::invalid_argument("time passes forwards: no duration is negative");
  if (duration > kLongestLife - now())
    throw std::invalid_argument(
        fmt::format("this would end behind {} s; allowed: a bus lives for that much simulated time",
                    kLongestLife / kSecond));
  return simulation_.bus().now() + duration;
}

void ProgramBus::look() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kLook{50};
  if (!on_look || Clock::now() < next_look_) return;
  on_look();
  next_look_ = Clock::now() + kLook;
}

// Whoever wants the end does not wait long for a bus whose bits have many clocks.
Time ProgramBus::stretch() const {
  constexpr double kMostClocks = 1e6, kMostBits = 512;
  double clocks = 0;  // of all nodes in a bit
  for (const NodeSpec &node : scenario_.nodes)
    clocks += node.clock.frequency_hz / simulation_.bitrate();
  return static_cast<Time>(std::clamp(kMostClocks / clocks, 1.0, kMostBits)) * bit_time_;
}

// All that lets time pass begins here.
void ProgramBus::exchange() {
  check_open();
  for (const Worked &worked : worked_) {
    worked.node->take();
    (void)worked.node->give();  // the port never refuses
  }
}

// Software of a node holds a few frames: it is given more before it runs dry.
void ProgramBus::run_until(Time when) {
  const Time most = stretch();
  Bus &bus = simulation_.bus();
  exchange();
  while (bus.now() < when) {
    bus.run_until(std::min(when, bus.now() + most));
    simulation_.check();
    for (const Worked &worked : worked_) worked.node->check();
    exchange();
    look();
  }
}

void ProgramBus::step(Time duration) { run_until(end_of(duration)); }

void ProgramBus::pass(Time duration) {
  constexpr Time kLook = 16;  // bits
  Bus &bus = simulation_.bus();
  const Time end = end_of(duration);
  exchange();
  while (bus.now() < end) {
    if (quiet()) {
      simulation_.settle();
      if (bus.skip(end)) continue;
    }
    run_until(std::min(end, bus.now() + kLook * bit_time_));
  }
}

bool ProgramBus::quiet() const {
  return simulation_.quiet() &&
         std::all_of(worked_.begin(), worked_.end(), [](const Worked &worked) {
           return worked.node->quiet() && (worked.node->bus_off() || worked.port->remaining() == 0);
         });
}

bool ProgramBus::run_until_quiet(Time limit) {
  constexpr Time kLook = 16;  // bits
  Bus &bus = simulation_.bus();
  const Time end = end_of(limit);
  exchange();
  while (!settled()) {
    if (bus.now() >= end) return false;
    run_until(std::min(end, bus.now() + kLook * bit_time_));
  }
  simulation_.settle();
  return true;
}

bool ProgramBus::run_until_message(Time limit) {
  constexpr Time kLook = 4;  // bits
  const auto heard = [this] {
    return std::any_of(worked_.begin(), worked_.end(),
                       [](const Worked &worked) { return worked.port->heard(); });
  };
  Bus &bus = simulation_.bus();
  const Time end = end_of(limit);
  exchange();
  while (!heard() && bus.now() < end) {
    if (quiet()) {
      simulation_.settle();
      if (bus.skip(end)) continue;
    }
    run_until(std::min(end, bus.now() + kLook * bit_time_));
  }
  return heard();
}

// ---- Faults

void ProgramBus::disturb(const std::string &node, Effect effect, Time begin, Time duration) {
  check_open();
  if (begin < now()) throw std::invalid_argument("a disturbance begins now or later");
  if (duration <= 0) throw std::invalid_argument("a disturbance lasts longer than nothing");
  (void)end_of(begin - now() + duration);
  const Time from = begin + simulation_.started();
  faults_.add(node.empty() ? kAllNodes : id_of(node), effect, {from, from + duration});
  if (!disturbed_) simulation_.bus().add(faults_);
  disturbed_ = true;
}

}  // namespace vericansim
