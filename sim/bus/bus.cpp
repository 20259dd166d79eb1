// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus: see bus.hpp.
#include "bus/bus.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "bus/faults.hpp"

namespace vericansim {
namespace {

constexpr Level wired_and(std::uint64_t dominant) {
  return dominant == 0 ? Level::kRecessive : Level::kDominant;
}

void set_bit(std::uint64_t &mask, unsigned bit, bool value) {
  mask = (mask & ~(1ULL << bit)) | (static_cast<std::uint64_t>(value) << bit);
}

}  // namespace

Node::~Node() {
  if (bus_ != nullptr) bus_->detach(*this);
}

Bus::~Bus() {
  for (Entry &entry : nodes_) {
    if (entry.node != nullptr) entry.node->bus_ = nullptr;
  }
}

// A node that dies before its bus leaves the bus unusable but safe to destroy.
void Bus::detach(const Node &node) {
  prepared_ = false;
  for (Entry &entry : nodes_) {
    if (entry.node == &node) entry.node = nullptr;
  }
}

// ---- Building

NodeId Bus::add(Node &node, const Link &link) {
  if (nodes_.size() >= kMaxNodes) throw std::invalid_argument("a bus takes at most 64 nodes");
  if (node.bus_ != nullptr) throw std::invalid_argument(node.name() + " is on a bus already");
  if (link.cable < 0 || link.transmitter < 0 || link.receiver < 0) {
    throw std::invalid_argument("delays of " + node.name() + " must not be negative");
  }
  if (node.oscillator().next() < now_) {
    throw std::invalid_argument("first clock edge of " + node.name() +
                                " lies in the past of the bus");
  }
  node.bus_ = this;
  Entry entry;
  entry.node = &node;
  entry.link = link;
  nodes_.push_back(std::move(entry));
  prepared_ = false;
  return size() - 1;
}

void Bus::set_delay(NodeId from, NodeId to, Time delay) {
  if (delay < 0) throw std::invalid_argument("a delay must not be negative");
  delay_override_[{from, to}] = delay;
  prepared_ = false;
}

// A node hears itself through its own transceiver, others through both stubs as well.
Time Bus::delay(NodeId from, NodeId to) const {
  if (const auto it = delay_override_.find({from, to}); it != delay_override_.end())
    return it->second;
  const Link &source = nodes_[from].link;
  const Link &sink = nodes_[to].link;
  const Time cable = from == to ? 0 : source.cable + sink.cable;
  return source.transmitter + cable + sink.receiver;
}

void Bus::add(BusObserver &observer) {
  observers_.push_back(&observer);
  interests_ |= observer.interests();
}

void Bus::remove(BusObserver &observer) {
  std::erase(observers_, &observer);
  interests_ = 0;
  for (const BusObserver *other : observers_) interests_ |= other->interests();
}

void Bus::add(Fault &fault) {
  faults_.push_back(&fault);
  const unsigned hooks = fault.hooks();
  if ((hooks & Fault::kUnheard) != 0) with_unheard_.push_back(&fault);
  if ((hooks & Fault::kBabbling) != 0) with_babbling_.push_back(&fault);
  if ((hooks & Fault::kLevel) != 0) with_level_.push_back(&fault);
  if ((hooks & Fault::kClocked) != 0) with_clocked_.push_back(&fault);
  levels_disturbed_ = levels_disturbed_ || (hooks & ~Fault::kClocked) != 0;
  prepared_ = false;
  fault.attach(*this);
}

void Bus::at(Time when, std::function<void()> action) {
  if (when < now_) throw std::invalid_argument("an action must not lie in the past of the bus");
  actions_.push({when, action_order_++, std::move(action)});
}

bool Bus::lockstep() {
  if (!prepared_) prepare();
  return direct_;
}

// Chooses the fastest way to run the bus as it now is, and carries the levels over.
void Bus::prepare() {
  const unsigned n = size();
  next_.resize(n);
  delay_.assign(static_cast<std::size_t>(n) * n, 0);
  together_ = true;
  bool delayed = false;
  for (NodeId i = 0; i < n; ++i) {
    if (nodes_[i].node == nullptr) throw std::logic_error("a node of the bus has been destroyed");
    next_[i] = nodes_[i].node->oscillator().next();
    together_ =
        together_ && nodes_[i].node->oscillator().in_step_with(nodes_[0].node->oscillator());
    delayed = delayed || nodes_[i].link.transmitter + nodes_[i].link.cable > 0;
    for (NodeId to = 0; to < n; ++to) {
      delay_[static_cast<std::size_t>(i) * n + to] = delay(i, to);
      delayed = delayed || delay(i, to) > 0;
    }
  }
  const bool direct = together_ && !delayed && !levels_disturbed_;
  if (direct_ && !direct) {
    for (Entry &entry : nodes_) entry.receiver.dominant = driven_dominant_;
    observer_point_.dominant = driven_dominant_;
  }
  direct_ = direct;
  prepared_ = true;
}

// ---- Time

Time Bus::next_edge() const {
  if (next_.empty()) return std::numeric_limits<Time>::max();
  return together_ ? next_[0] : *std::min_element(next_.begin(), next_.end());
}

bool Bus::run_actions(Time until) {
  if (actions_.empty() || actions_.top().time > until) return false;
  now_ = std::max(now_, actions_.top().time);
  const auto run = actions_.top().run;
  actions_.pop();
  run();
  return true;
}

void Bus::step() {
  do {
    if (!prepared_) prepare();
  } while (run_actions(next_edge()));
  if (!next_.empty()) run_instant(next_edge());
}

void Bus::run_until(Time until) {
  stopped_ = false;
  while (!stopped_) {
    if (!prepared_) prepare();
    const Time t = next_edge();
    if (run_actions(std::min(t, until))) continue;
    if (t > until) {
      now_ = std::max(now_, until);
      observe(until + 1);
      return;
    }
    run_instant(t);
  }
}

bool Bus::run_until(const std::function<bool()> &done, Time limit) {
  const Time end = now_ + limit;
  stopped_ = false;
  while (!done()) {
    if (!prepared_) prepare();
    const Time t = next_edge();
    if (run_actions(std::min(t, end))) continue;
    if (t > end || stopped_) return false;
    run_instant(t);
  }
  return true;
}

bool Bus::may_skip() {
  if (!prepared_) prepare();
  const auto at_rest = [](const Receiver &receiver) {
    return receiver.head == receiver.pending.size();
  };
  return faults_.empty() && driven_dominant_ == 0 && level_ == Level::kRecessive &&
         at_rest(observer_point_) &&
         std::all_of(nodes_.begin(), nodes_.end(), [&](const Entry &entry) {
           return trace_field(entry.node->trace()) == Field::kIdle && at_rest(entry.receiver) &&
                  !entry.node->oscillator_.wanders();
         });
}

bool Bus::skip(Time until) {
  if (!actions_.empty()) until = std::min(until, actions_.top().time - 1);
  if (until <= now_ || !may_skip()) return false;
  for (NodeId i = 0; i < size(); ++i) {
    nodes_[i].node->oscillator_.skip(until);
    next_[i] = nodes_[i].node->oscillator_.next();
  }
  now_ = until;
  return true;
}

void Bus::run_instant(Time t) {
  now_ = t;
  if (direct_) {
    clock_together(t);
    return;
  }
  observe(t);
  for (NodeId i = 0; i < next_.size(); ++i) {
    if (next_[i] == t) clock_node(i, t, receive(i, t));
  }
}

// ---- Levels

// All nodes sample the AND of what was driven before t; what they drive now shows from t on.
void Bus::clock_together(Time t) {
  const Level rx = wired_and(driven_dominant_);
  for (NodeId i = 0; i < next_.size(); ++i) clock_node(i, t, rx);
  const Level level = wired_and(driven_dominant_);
  if (level != level_) set_level(t, level);
}

void Bus::clock_node(NodeId id, Time t, Level rx) {
  Node &node = *nodes_[id].node;
  node.clock(rx);
  node.oscillator_.tick();
  next_[id] = node.oscillator_.next();
  if (node.tx() != nodes_[id].tx) driven(id, t, node.tx());
  if (interests_ != 0 || !with_clocked_.empty()) watch(id, t, rx);
}

void Bus::driven(NodeId id, Time t, Level level) {
  nodes_[id].tx = level;
  set_bit(driven_dominant_, id, level == Level::kDominant);
  if ((interests_ & BusObserver::kNodeLevels) != 0) {
    for (BusObserver *observer : observers_) observer->on_node_tx(id, t, level);
  }
  if (direct_) return;
  const Time *delay = &delay_[static_cast<std::size_t>(id) * size()];
  for (NodeId to = 0; to < size(); ++to) nodes_[to].receiver.push({t + delay[to], id, level});
  observer_point_.push({t + nodes_[id].link.transmitter + nodes_[id].link.cable, id, level});
}

Level Bus::receive(NodeId id, Time t) {
  Receiver &receiver = nodes_[id].receiver;
  receiver.collect(t);
  return levels_disturbed_ ? with_faults(id, t, receiver.dominant) : wired_and(receiver.dominant);
}

Level Bus::with_faults(NodeId id, Time t, std::uint64_t dominant) {
  std::uint64_t unheard = 0;
  for (Fault *fault : with_unheard_) unheard |= fault->unheard(id, t);
  for (Fault *fault : with_babbling_) {
    const std::uint64_t babbling = fault->babbling(t);
    if ((dominant & ~unheard) == 0 && (babbling & ~unheard) != 0) fault->took_effect(id, t);
    dominant |= babbling;
  }
  Level level = wired_and(dominant & ~unheard);
  if (level != wired_and(dominant)) {
    for (Fault *fault : with_unheard_)
      if ((fault->unheard(id, t) & dominant) != 0) fault->took_effect(id, t);
  }
  for (Fault *fault : with_level_) level = fault->level(id, t, level);
  return level;
}

// Arrivals keep their order in time; those of one source never overtake each other.
void Bus::Receiver::push(const Arrival &arrival) {
  auto place = pending.end();
  while (place - pending.begin() > static_cast<std::ptrdiff_t>(head) &&
         (place - 1)->time > arrival.time) {
    --place;
  }
  pending.insert(place, arrival);
}

void Bus::Receiver::collect(Time before) {
  while (head < pending.size() && pending[head].time < before) {
    set_bit(dominant, pending[head].source, pending[head].level == Level::kDominant);
    ++head;
  }
  if (head == pending.size() && head != 0) {
    pending.clear();
    head = 0;
  }
}

// ---- Observers

void Bus::observe(Time before) {
  if (direct_) return;
  Receiver &point = observer_point_;
  while (point.head < point.pending.size() && point.pending[point.head].time < before) {
    const Time t = point.pending[point.head].time;
    point.collect(t + 1);
    const Level level =
        levels_disturbed_ ? with_faults(kBusPoint, t, point.dominant) : wired_and(point.dominant);
    if (level != level_) set_level(t, level);
  }
  if (!levels_disturbed_) return;
  const Level level = with_faults(kBusPoint, now_, point.dominant);
  if (level != level_) set_level(now_, level);
}

void Bus::set_level(Time t, Level level) {
  level_ = level;
  if ((interests_ & BusObserver::kLevels) == 0) return;
  for (BusObserver *observer : observers_) observer->on_level(t, level);
}

void Bus::watch(NodeId id, Time t, Level rx) {
  Entry &entry = nodes_[id];
  if (rx != entry.rx) {
    entry.rx = rx;
    if ((interests_ & BusObserver::kNodeLevels) != 0) {
      for (BusObserver *observer : observers_) observer->on_node_rx(id, t, rx);
    }
  }
  constexpr unsigned kTraceUsers = BusObserver::kBits | BusObserver::kClocks;
  if ((interests_ & kTraceUsers) == 0 && with_clocked_.empty()) return;
  const std::uint64_t word = entry.node->trace();
  for (Fault *fault : with_clocked_) fault->clocked(id, t, word);
  if ((interests_ & BusObserver::kBits) != 0 && entry.bits.clocked(word, next_[id])) {
    for (BusObserver *observer : observers_) observer->on_bit(id, entry.bits.record());
  }
  if ((interests_ & BusObserver::kClocks) != 0) {
    for (BusObserver *observer : observers_) observer->on_clock(id, t, word);
  }
}

}  // namespace vericansim
