// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus: who hears whom at a clock edge, and what observers are told; see bus.hpp.
#include "bus/bus.hpp"
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

// ---- Levels

// All nodes sample the AND of what was driven before t; what they drive now shows from t on.
void Bus::clock_together(Time t) {
  const Level rx = wired_and(driven_dominant_);
  clock_due(t, [rx](NodeId) { return rx; });
  const Level level = wired_and(driven_dominant_);
  if (level == level_) return;
  set_level(t, level);
  for (NodeId i = 0; i < next_.size(); ++i) wake_at(i, t);
}

void Bus::clock_node(NodeId id, Time t, Level rx) {
  Node &node = *nodes_[id].node;
  end_rest(id);
  resting_ ? node.clock_lightly(rx) : node.clock(rx);
  node.oscillator_.tick();
  next_[id] = node.oscillator_.next();
  if (node.tx() != nodes_[id].tx) driven(id, t, node.tx());
  if (interests_ != 0 || !with_clocked_.empty()) watch(id, t, rx);
  if (resting_) rest(id);
}

void Bus::driven(NodeId id, Time t, Level level) {
  nodes_[id].tx = level;
  set_bit(driven_dominant_, id, level == Level::kDominant);
  if ((interests_ & BusObserver::kNodeLevels) != 0) {
    for (BusObserver *observer : observers_) observer->on_node_tx(id, t, level);
  }
  if (direct_) return;
  const Time *delay = &delay_[static_cast<std::size_t>(id) * size()];
  for (NodeId to = 0; to < size(); ++to) {
    nodes_[to].receiver.push({t + delay[to], id, level});
    wake_at(to, t + delay[to]);
  }
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

// Arrivals keep their order in time; those of one source never overtake each other, though the
// delay between them may have become shorter: else the older level would stay.
void Bus::Receiver::push(Arrival arrival) {
  auto place = pending.end();
  while (place - pending.begin() > static_cast<std::ptrdiff_t>(head) &&
         (place - 1)->time > arrival.time) {
    if ((place - 1)->source == arrival.source)
      arrival.time = (place - 1)->time;
    else
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
  if (!entry.node->watched_) return;
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
