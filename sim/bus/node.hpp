// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Node: a participant of the bus with a clock of its own. Nothing in it is global (design.md, 3).
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "bus/clock.hpp"
#include "bus/types.hpp"

namespace vericansim {

class Bus;

/// Index of a node on its bus, 0, 1, ... in the order of Bus::add().
using NodeId = unsigned;

/// A bus participant. The kernel calls clock() once for each rising edge of the node's oscillator,
/// with the level that its pin has had just before the edge.
class Node {
 public:
  Node(std::string name, const ClockConfig &clock) : name_{std::move(name)}, oscillator_{clock} {}
  virtual ~Node();  // leaves its bus
  Node(const Node &) = delete;
  Node &operator=(const Node &) = delete;

  /// One rising clock edge. `rx` is the level at the receive pin.
  virtual void clock(Level rx) = 0;

  /// Clock edges to come, the next one first, that change nothing but what pass() makes good, as
  /// long as the receive pin keeps its level and nobody calls the node. 0: clock me every time.
  /// While the node is watched(), they do not change its trace either.
  [[nodiscard]] virtual std::uint64_t quiet() const { return 0; }
  /// `edges` of those at once, never more than quiet() has said.
  virtual void pass(std::uint64_t edges) { (void)edges; }
  /// clock() on a bus whose nodes may rest: an edge that would be quiet() if the receive pin had
  /// kept its level, or nobody looked at the trace, need not be clocked if it is made good.
  virtual void clock_lightly(Level rx) { clock(rx); }

  /// What Bus::skip() may do to the node while the bus is idle. 1: its clock may be gated for any
  /// number of edges; else a multiple of skip_period() edges, skip_most() at most, is as good as
  /// clocked by skipped(). 0: none now.
  [[nodiscard]] virtual std::uint64_t skip_period() const { return 1; }
  [[nodiscard]] virtual std::uint64_t skip_most() const { return ~0ULL; }
  virtual void skipped(std::uint64_t edges) { (void)edges; }

  /// The observer's view after the last edge (trace_o, see bus/trace.hpp); 0 if the node has none.
  [[nodiscard]] virtual std::uint64_t trace() const { return 0; }

  /// Level at the transmit pin since the last edge.
  [[nodiscard]] Level tx() const { return tx_; }
  [[nodiscard]] const std::string &name() const { return name_; }
  [[nodiscard]] Clock &oscillator() {
    disturbed();
    return oscillator_;
  }
  [[nodiscard]] const Clock &oscillator() const {
    catch_up();
    return oscillator_;
  }

  /// The bus the node has been added to, or nullptr.
  [[nodiscard]] Bus *bus() const { return bus_; }

 protected:
  void drive(Level level) { tx_ = level; }

  /// Somebody on the bus looks at the trace after each edge that is clocked.
  [[nodiscard]] bool watched() const { return watched_; }
  /// To be called before a state is read that pass() changes: makes the edges good that the bus has
  /// left out up to now.
  void catch_up() const {
    if (resting_) make_good();
  }
  /// To be called before an input other than the receive pin changes: the next edge is clocked.
  void disturbed() {
    if (resting_) end_rest();
  }

 private:
  friend class Bus;

  void make_good() const;
  void end_rest();

  Level tx_ = Level::kRecessive;
  bool resting_ = false;  // on a bus that has put off edges of this node
  bool watched_ = false;  // on a bus whose observers look at traces
  NodeId id_ = 0;         // there
  Bus *bus_ = nullptr;
  std::string name_;
  Clock oscillator_;
};

}  // namespace vericansim
