// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus: the wired-AND of its nodes, and the kernel that runs their clocks.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bus/node.hpp"
#include "bus/observer.hpp"
#include "bus/types.hpp"

namespace vericansim {

class Fault;

/// How a node hangs on the bus; all one-way, ps.
struct Link {
  Time cable = 0;        ///< stub from the node to the common star point
  Time transmitter = 0;  ///< transceiver, TX pin to wire
  Time receiver = 0;     ///< transceiver, wire to RX pin
};

/// Propagation on copper, 5 ns/m, for those who think in metres: 0 to 1,000,000
/// (std::invalid_argument otherwise).
constexpr Time cable_delay(double metres) {
  if (!(metres >= 0 && metres <= 1e6)) throw std::invalid_argument("a cable has 0 to 1000000 m");
  return static_cast<Time>(metres * 5000.0);
}

/// The bus. Nodes, observers and faults are referred to, not owned, and must outlive it.
///
/// A level driven at time t reaches another node after the sum of the delays between them, and a
/// clock edge sees what arrived strictly before it: with no delay at all, all nodes that are
/// clocked at the same instant sample what their registers drove before that instant (no races).
class Bus {
 public:
  static constexpr unsigned kMaxNodes = 64;

  Bus() = default;
  ~Bus();
  Bus(const Bus &) = delete;
  Bus &operator=(const Bus &) = delete;

  /// Adds a node (at most kMaxNodes; std::invalid_argument beyond or if a delay is negative) and
  /// returns its index. A node's first edge must not lie in the past of this bus.
  NodeId add(Node &node, const Link &link = {});
  /// Sets the delay from the TX pin of `from` to the RX pin of `to`, instead of the sum of the
  /// links.
  void set_delay(NodeId from, NodeId to, Time delay);
  [[nodiscard]] Time delay(NodeId from, NodeId to) const;
  void add(BusObserver &observer);
  void remove(BusObserver &observer);
  void add(Fault &fault);
  [[nodiscard]] bool has_faults() const { return !faults_.empty(); }

  /// Calls `action` at `when` (ps, not before now()), before the clock edges of that instant.
  void at(Time when, std::function<void()> action);

  /// True while an action is still to come.
  [[nodiscard]] bool has_actions() const { return !actions_.empty(); }

  /// Tells the kernel that an oscillator was changed while the bus runs.
  void clocks_changed() { unprepare(); }

  /// Whether nodes may rest: edges at which nothing moves in a node but the place in the bit
  /// (Node::quiet()) are not clocked one by one but made good in closed form, before anybody looks.
  /// All results are the same. On by default; faults and observers of single clocks turn it off
  /// while they are there.
  void let_rest(bool allowed);
  /// Edges of all nodes that were made good in closed form so far.
  [[nodiscard]] std::uint64_t edges_passed() const { return edges_passed_; }

  /// Runs all clock edges of the next instant that has any.
  void step();
  /// Runs every edge and action up to and including `until`, or until stop().
  void run_until(Time until);
  void run_for(Time duration) { run_until(time_behind(now_, duration)); }
  /// Runs until `done()` is true, tested after every instant; false if `limit` (ps from now, the
  /// largest Time: none) came first.
  bool run_until(const std::function<bool()> &done, Time limit);
  /// Lets the run_until() under way return after the current instant.
  void stop() { stopped_ = true; }

  /// Lets time pass without clocking the nodes, as if they had been clocked or, where a node has no
  /// period (Node::skip_period()), as if its clock were gated; up to `until` or to the next
  /// action, or a bit less. Only where that cannot be seen on the bus: all nodes show an idle bus
  /// and drive recessive, nothing is on its way, there are no faults. For a caller who knows that
  /// no node has anything to send. False, and nothing done, otherwise, or if no node has a period
  /// to pass up to then.
  bool skip(Time until);

  [[nodiscard]] Time now() const { return now_; }
  /// Level at the observation point, as known at now().
  [[nodiscard]] Level level() const { return level_; }
  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(nodes_.size()); }
  [[nodiscard]] Node &node(NodeId id) { return *nodes_[id].node; }
  [[nodiscard]] const Node &node(NodeId id) const { return *nodes_[id].node; }
  [[nodiscard]] const Link &link(NodeId id) const { return nodes_[id].link; }
  /// True while all oscillators tick together and there is neither a delay nor a fault: the fast
  /// path.
  [[nodiscard]] bool lockstep();

 private:
  // Observers that look at a node's trace.
  static constexpr unsigned kTraceUsers = BusObserver::kBits | BusObserver::kClocks;

  struct Arrival {
    Time time;
    NodeId source;
    Level level;
  };

  // A receiver: who has been heard as dominant, and the changes still on the wire, oldest first.
  struct Receiver {
    std::uint64_t dominant = 0;
    std::vector<Arrival> pending;
    std::size_t head = 0;

    void push(Arrival arrival);
    void collect(Time before);
  };

  struct Entry {
    Node *node = nullptr;
    Link link;
    Receiver receiver;
    Level tx = Level::kRecessive;
    Level rx = Level::kRecessive;
    BitRecorder bits;
  };

  struct Action {
    Time time;
    std::uint64_t order;
    std::function<void()> run;
    bool operator<(const Action &other) const {
      return time != other.time ? time > other.time : order > other.order;
    }
  };

  friend class Node;

  void detach(const Node &node);
  void prepare();
  void unprepare();
  void catch_up(NodeId id);
  void catch_up(NodeId id, Time before);
  void catch_up_all(Time before);
  void end_rest(NodeId id);
  void end_all_rest();
  void rest(NodeId id);
  void wake_at(NodeId id, Time arrival);
  // Flattened: what it calls is in other files of this folder, which verican_unity() compiles with
  // this one.
  [[gnu::flatten]] void run_instant(Time t);
  void clock_together(Time t);
  /// Clocks the nodes whose turn is at `t`, with the level that `level_for` gives. What is looked
  /// at in every instant stays in registers: next_ does not move while nodes are clocked.
  template <typename LevelFor>
  void clock_due(Time t, LevelFor &&level_for) {
    const auto count = static_cast<NodeId>(next_.size());
    const Time *next = next_.data();
    for (NodeId id = 0; id < count; ++id) {
      if (next[id] != t) continue;
      clocked_ = id;
      clock_node(id, t, level_for(id));
    }
    clocked_ = count;
  }
  void clock_node(NodeId id, Time t, Level rx);
  void driven(NodeId id, Time t, Level level);
  void watch(NodeId id, Time t, Level rx);
  void observe(Time before);
  void set_level(Time t, Level level);
  [[nodiscard]] Level receive(NodeId id, Time t);
  [[nodiscard]] Level with_faults(NodeId id, Time t, std::uint64_t dominant);
  [[nodiscard]] Time next_edge() const;
  [[nodiscard]] bool may_skip();
  [[nodiscard]] static std::uint64_t edges_to_skip(const Node &node, Time until);
  [[nodiscard]] Time skip_end(Time until) const;
  [[nodiscard]] bool run_actions(Time until) {
    return !actions_.empty() && actions_.top().time <= until && run_action();
  }
  bool run_action();

  std::vector<Entry> nodes_;
  std::vector<Time> next_;  // next edge of each node that is clocked, contiguous for the scan
  std::vector<std::uint64_t> rests_;  // while a node rests: its edges before next_
  std::map<std::pair<NodeId, NodeId>, Time> delay_override_;
  std::vector<Time> delay_;  // [from * size + to], valid while prepared_
  Receiver observer_point_;
  std::vector<BusObserver *> observers_;
  std::vector<Fault *> faults_;
  // Those of them that have the hook.
  std::vector<Fault *> with_unheard_, with_babbling_, with_level_, with_clocked_;
  std::priority_queue<Action> actions_;
  std::uint64_t action_order_ = 0;
  std::uint64_t driven_dominant_ = 0;  // lockstep: bit i set while node i drives dominant
  Time now_ = 0;
  Level level_ = Level::kRecessive;
  unsigned interests_ = 0;
  bool prepared_ = false;
  bool together_ = false;          // all oscillators in step
  bool direct_ = false;            // and neither delays nor faults in levels: one AND for all
  bool levels_disturbed_ = false;  // some fault has more than clocked()
  bool stopped_ = false;
  bool may_rest_ = true;  // as the user has it
  bool resting_ = false;  // and nothing speaks against it now
  std::uint64_t edges_passed_ = 0;
  Time passed_ = 0;       // latest of the edges that were made good
  Time done_before_ = 0;  // all edges before it have been, or have to be made good
  NodeId clocked_ = 0;    // and in an instant those of the nodes before this one at it
};

}  // namespace vericansim
