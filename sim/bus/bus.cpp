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
Node::~Node() {
  if (bus_ != nullptr) bus_->detach(*this);
}

Bus::~Bus() {
  for (NodeId id = 0; id < size(); ++id) {
    end_rest(id);
    if (nodes_[id].node != nullptr) nodes_[id].node->bus_ = nullptr;
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
  unprepare();
  node.bus_ = this;
  node.id_ = size();
  Entry entry;
  entry.node = &node;
  entry.link = link;
  nodes_.push_back(std::move(entry));
  return size() - 1;
}

void Bus::set_delay(NodeId from, NodeId to, Time delay) {
  if (delay < 0) throw std::invalid_argument("a delay must not be negative");
  if (from >= kMaxNodes || to >= kMaxNodes)
    throw std::invalid_argument("a delay is between nodes 0 to 63, got " +
                                std::to_string(std::max(from, to)));
  unprepare();
  delay_override_[{from, to}] = delay;
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
  unprepare();
  observers_.push_back(&observer);
  interests_ |= observer.interests();
}

void Bus::remove(BusObserver &observer) {
  unprepare();
  std::erase(observers_, &observer);
  interests_ = 0;
  for (const BusObserver *other : observers_) interests_ |= other->interests();
}

void Bus::add(Fault &fault) {
  fault.attach(*this);  // throws before the bus knows it
  unprepare();
  faults_.push_back(&fault);
  const unsigned hooks = fault.hooks();
  if ((hooks & Fault::kUnheard) != 0) with_unheard_.push_back(&fault);
  if ((hooks & Fault::kBabbling) != 0) with_babbling_.push_back(&fault);
  if ((hooks & Fault::kLevel) != 0) with_level_.push_back(&fault);
  if ((hooks & Fault::kClocked) != 0) with_clocked_.push_back(&fault);
  levels_disturbed_ = levels_disturbed_ || (hooks & ~Fault::kClocked) != 0;
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
  rests_.resize(n);
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
  resting_ = may_rest_ && faults_.empty() && (interests_ & BusObserver::kClocks) == 0;
  const bool watched = (interests_ & kTraceUsers) != 0 || !with_clocked_.empty();
  for (Entry &entry : nodes_) entry.node->watched_ = watched;
  prepared_ = true;
}

// ---- Time

Time Bus::next_edge() const {
  if (next_.empty()) return std::numeric_limits<Time>::max();
  return together_ && !resting_ ? next_[0] : *std::min_element(next_.begin(), next_.end());
}

bool Bus::run_action() {
  now_ = std::max(now_, actions_.top().time);
  catch_up_all(std::max(done_before_, now_));
  observe(passed_);
  const auto run = actions_.top().run;
  actions_.pop();
  run();
  return true;
}

void Bus::step() {
  end_all_rest();
  do {
    if (!prepared_) prepare();
  } while (run_actions(next_edge()));
  if (!next_.empty()) run_instant(next_edge());
  catch_up_all(done_before_);
}

void Bus::run_until(Time until) {
  until = std::min(until, kEndOfTime);
  stopped_ = false;
  while (!stopped_) {
    if (!prepared_) prepare();
    const Time t = next_edge();
    if (run_actions(std::min(t, until))) continue;
    if (t > until) {
      now_ = std::max(now_, until);
      catch_up_all(until + 1);
      observe(until + 1);
      return;
    }
    run_instant(t);
  }
  catch_up_all(done_before_);
}

bool Bus::run_until(const std::function<bool()> &done, Time limit) {
  const Time end = time_behind(now_, limit);
  stopped_ = false;
  while (!done()) {
    end_all_rest();
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
           return trace_field(entry.node->trace()) == Field::kIdle && at_rest(entry.receiver);
         });
}

// The last instant up to which every node may be left alone.
Time Bus::skip_end(Time until) const {
  for (const Entry &entry : nodes_) {
    const std::uint64_t most = entry.node->skip_most();
    const Clock &clock = entry.node->oscillator_;
    if (most < clock.count_until(until)) {
      Clock copy = clock;
      copy.pass(most);
      until = copy.next() - 1;
    }
  }
  return until;
}

std::uint64_t Bus::edges_to_skip(const Node &node, Time until) {
  const std::uint64_t edges = node.oscillator_.count_until(until);
  return edges - edges % node.skip_period();
}

bool Bus::skip(Time until) {
  if (!actions_.empty()) until = std::min(until, actions_.top().time - 1);
  end_all_rest();
  if (until <= now_ || !may_skip()) return false;
  until = skip_end(until);
  if (until <= now_) return false;
  Time first = until + 1;
  bool any = false;
  for (NodeId i = 0; i < size(); ++i) {
    Node &node = *nodes_[i].node;
    const std::uint64_t edges = edges_to_skip(node, until);
    any = any || edges > 0;
    node.skipped(edges);
    node.oscillator_.pass(edges);
    next_[i] = node.oscillator_.next();
    first = std::min(first, next_[i]);
  }
  // A node with a period lacks less than that of its edges.
  now_ = std::max(now_, first - 1);
  done_before_ = now_ + 1;
  return any;
}

void Bus::run_instant(Time t) {
  now_ = done_before_ = t;
  if (direct_) {
    clock_together(t);
  } else {
    observe(t);
    clock_due(t, [this, t](NodeId id) { return receive(id, t); });
  }
  done_before_ = t + 1;
  clocked_ = 0;
}

}  // namespace vericansim
