// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus: edges at which nothing moves in a node are made good when somebody looks; see bus.hpp,
// Bus::let_rest().
#include <algorithm>
#include <cassert>

#include "bus/bus.hpp"

namespace vericansim {

void Node::make_good() const { bus_->catch_up(id_); }
void Node::end_rest() { bus_->end_rest(id_); }

void Bus::let_rest(bool allowed) {
  unprepare();
  may_rest_ = allowed;
}

void Bus::unprepare() {
  end_all_rest();
  prepared_ = false;
}

// What nodes hear may have changed for later edges only: those before, and in an instant those of
// nodes that have had their turn, are still as foreseen.
void Bus::catch_up(NodeId id) { catch_up(id, id < clocked_ ? done_before_ + 1 : done_before_); }

void Bus::catch_up(NodeId id, Time before) {
  Node &node = *nodes_[id].node;
  Clock &clock = node.oscillator_;
  assert(node.resting_);  // else rests_ is of another time
  const std::uint64_t edges = before < next_[id] ? clock.edges_until(before - 1) : rests_[id];
  if (edges == 0) return;
  rests_[id] -= edges;
  edges_passed_ += edges;
  node.pass(edges);
  clock.advance(edges);
  passed_ = std::max(passed_, clock.previous());
}

void Bus::catch_up_all(Time before) {
  done_before_ = before;
  for (NodeId id = 0; id < size(); ++id)
    if (nodes_[id].node != nullptr && nodes_[id].node->resting_) catch_up(id, before);
}

void Bus::end_rest(NodeId id) {
  Node *node = nodes_[id].node;
  if (node == nullptr || !node->resting_) return;
  catch_up(id);
  node->resting_ = false;
  next_[id] = node->oscillator_.next();
}

void Bus::end_all_rest() {
  for (NodeId id = 0; id < size(); ++id) end_rest(id);
}

// After an edge of the node: until when it may be left alone.
void Bus::rest(NodeId id) {
  constexpr std::uint64_t kMost = 1U
                                  << 24;  // an idle node that is stopped: for as long as it takes
  Entry &entry = nodes_[id];
  if (entry.bits.pending()) return;
  const Clock &clock = entry.node->oscillator_;
  std::uint64_t quiet = std::min(std::min(entry.node->quiet(), clock.steady_edges()), kMost);
  if (quiet == 0) return;
  const Receiver &receiver = entry.receiver;
  if (!direct_ && receiver.head < receiver.pending.size())
    quiet = std::min(quiet, clock.edges_until(receiver.pending[receiver.head].time));
  if (quiet == 0) return;
  entry.node->resting_ = true;
  rests_[id] = quiet;
  next_[id] = clock.after(quiet);
}

// A level reaches the node: edges up to then have the old one.
void Bus::wake_at(NodeId id, Time arrival) {
  if (!nodes_[id].node->resting_ || next_[id] <= arrival) return;
  const Clock &clock = nodes_[id].node->oscillator_;
  rests_[id] = clock.edges_until(arrival);
  next_[id] = clock.after(rests_[id]);
}

}  // namespace vericansim
