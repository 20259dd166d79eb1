// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CanBus: see can_bus.hpp.
#include "systemc/can_bus.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace vericansim {

CanBus::CanBus(const sc_core::sc_module_name &name) : sc_core::sc_module{name} {
  check_time_resolution();
  SC_HAS_PROCESS(CanBus);
  SC_METHOD(pace);
}

// ---- Building

NodeId CanBus::add_pins(const std::string &name, const Link &link) {
  if (nodes_.size() >= Bus::kMaxNodes) throw std::invalid_argument("a bus takes at most 64 nodes");
  if (link.cable < 0 || link.transmitter < 0 || link.receiver < 0)
    throw std::invalid_argument("delays of " + name + " must not be negative");
  nodes_.push_back({std::make_unique<Pins>(name), link, {}, true});
  return static_cast<NodeId>(nodes_.size() - 1);
}

NodeId CanBus::attach(VericanTlm &node, const Link &link) {
  if (node.timing() == TlmTiming::kLooselyTimed) {
    const NodeId id = kernel_.add(node.node(), link);
    node.bus_ = this;
    loose_.push_back(&node);
    return id;
  }
  std::string pins = node.name();
  std::replace(pins.begin(), pins.end(), '.', '_');
  const NodeId id = add_pins(pins, link);
  node.can_tx.bind(nodes_[id].pins->tx);
  node.can_rx.bind(nodes_[id].pins->rx);
  return id;
}

void CanBus::set_delay(NodeId from, NodeId to, Time delay) {
  if (delay < 0) throw std::invalid_argument("a delay must not be negative");
  delay_override_[{from, to}] = delay;
  kernel_.set_delay(from, to, delay);
}

// A node hears itself through its own transceiver, others through both stubs as well.
Time CanBus::delay(NodeId from, NodeId to) const {
  if (const auto it = delay_override_.find({from, to}); it != delay_override_.end())
    return it->second;
  const Link &source = nodes_[from].link;
  const Link &sink = nodes_[to].link;
  return source.transmitter + (from == to ? 0 : source.cable + sink.cable) + sink.receiver;
}

void CanBus::end_of_elaboration() {
  if (!nodes_.empty() && !loose_.empty()) {
    SC_REPORT_FATAL(name(), "pins and loosely timed modules cannot share a bus");
  }
  if (nodes_.empty()) return;
  sc_core::sc_spawn_options options;
  options.spawn_method();
  options.set_sensitivity(&due_);
  for (const Entry &entry : nodes_) options.set_sensitivity(&entry.pins->tx.value_changed_event());
  sc_core::sc_spawn([this] { resolve(); }, "resolve", &options);
}

void CanBus::start_of_simulation() {
  global_ = tlm::tlm_global_quantum::instance().get();
  for (const VericanTlm *node : loose_) {
    const auto period = to_sc_time(static_cast<Time>(node->node_->oscillator().period_ps()));
    shortest_ = shortest_ == sc_core::SC_ZERO_TIME ? period : std::min(shortest_, period);
  }
  set_quantum(wanted_);
}

// Zero would let the bus be paced again and again in one instant.
void CanBus::set_quantum(const sc_core::sc_time &quantum) {
  wanted_ = quantum;
  quantum_ = std::max(wanted_ == sc_core::SC_ZERO_TIME ? global_ : wanted_, shortest_);
}

void CanBus::trace(sc_core::sc_trace_file *file) {
  sc_core::sc_trace(file, level, level.name());
  for (const Entry &entry : nodes_) {
    sc_core::sc_trace(file, entry.pins->tx, entry.pins->tx.name());
    sc_core::sc_trace(file, entry.pins->rx, entry.pins->rx.name());
  }
}

// ---- Pins

// Changes keep their order in time; those of one source never overtake each other, though the delay
// between them may have become shorter: else the older level would stay.
void CanBus::Receiver::push(Arrival arrival) {
  auto place = pending.end();
  while (place != pending.begin() && (place - 1)->time > arrival.time) {
    if ((place - 1)->source == arrival.source)
      arrival.time = (place - 1)->time;
    else
      --place;
  }
  pending.insert(place, arrival);
}

bool CanBus::Receiver::collect(Time now) {
  while (!pending.empty() && pending.front().time <= now) {
    const std::uint64_t bit = 1ULL << pending.front().source;
    dominant = pending.front().level ? dominant & ~bit : dominant | bit;
    pending.pop_front();
  }
  return dominant == 0;
}

void CanBus::send(NodeId from, Time now) {
  Entry &source = nodes_[from];
  source.tx = source.pins->tx.read();
  for (NodeId to = 0; to < nodes_.size(); ++to)
    nodes_[to].receiver.push({now + delay(from, to), from, source.tx});
  star_.push({now + source.link.transmitter + source.link.cable, from, source.tx});
}

void CanBus::resolve() {
  const Time now = to_ps(sc_core::sc_time_stamp());
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (nodes_[id].pins->tx.read() != nodes_[id].tx) send(id, now);
  }
  Time next = -1;
  const auto look = [&next](const Receiver &receiver) {
    if (receiver.pending.empty()) return;
    const Time time = receiver.pending.front().time;
    next = next < 0 ? time : std::min(next, time);
  };
  level.write(star_.collect(now));
  look(star_);
  for (Entry &entry : nodes_) {
    entry.pins->rx.write(entry.receiver.collect(now));
    look(entry.receiver);
  }
  if (next >= 0) due_.notify(to_sc_time(next - now));
}

// ---- Loosely timed modules

void CanBus::pace() {
  if (loose_.empty()) return;
  catch_up();
  level.write(to_bool(kernel_.level()));
  next_trigger(quantum_);
}

void CanBus::announce() {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  const sc_core::sc_time ahead = kernel_time() > now ? kernel_time() - now : sc_core::SC_ZERO_TIME;
  for (VericanTlm *node : loose_) node->outputs_changed(ahead);
}

void CanBus::run_to(const sc_core::sc_time &time) {
  if (to_ps(time) <= kernel_.now()) return;
  kernel_.run_until(to_ps(time));
  announce();
}

bool CanBus::shared_with_others(const VericanTlm &node) const {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  return std::any_of(loose_.begin(), loose_.end(), [&](const VericanTlm *other) {
    return other != &node && other->idle_from_ != sc_core::SC_ZERO_TIME &&
           other->idle_from_ + quantum_ > now;
  });
}

void CanBus::run_until_done(RtlNode &node, AhbMaster::Ticket ticket) {
  while (!node.ahb().done(ticket)) kernel_.step();
  announce();
}

}  // namespace vericansim
