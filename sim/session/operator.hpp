// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Operator: what works a node's registers in place of the simulation's own software, or feeds it.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/observer.hpp"
#include "model/bus_monitor.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"
#include "session/outlet.hpp"

namespace vericansim {

class Simulation;

/// Later than anything that happens.
inline constexpr Time kNever = std::numeric_limits<Time>::max();

/// Where an operator finds its node.
struct OperatorContext {
  std::span<Simulation *const> simulations;  ///< all buses of the session, built
  std::size_t bus = 0;                       ///< of `simulations`
  NodeId id = 0;                             ///< on that bus; kAllNodes: a listener
  std::string name;                          ///< of node or listener
  NodeRole role;
  std::size_t line = 0;  ///< in the scenario's file
  /// A node's software prints: name of the node, text.
  std::function<void(std::string_view, std::string_view)> output;
  /// A line for the user.
  std::function<void(const std::string &)> say;

  [[nodiscard]] Simulation &simulation() const { return *simulations[bus]; }
  [[nodiscard]] const Scenario &scenario() const;
  [[nodiscard]] const NodeSpec &spec() const;
};

/// One operator works one node. The session calls, in this order: start(), ready() until it is
/// true, begin(), then check(), clock() and the tellings as the bus runs, end(), report().
class Operator {
 public:
  virtual ~Operator() = default;

  /// Begins the set-up of the node.
  virtual void start() {}
  /// True once the node takes part in the bus (it still integrates then).
  [[nodiscard]] virtual bool ready() const { return true; }
  /// The times of the scenario count from now on, a time of the bus.
  virtual void begin(Time now) { (void)now; }
  /// Rethrows what went wrong in the node's software.
  virtual void check() {}

  /// Time of the next clock edge at which it wants to be called, after the nodes; kNever: none.
  [[nodiscard]] virtual Time next_edge() const { return kNever; }
  /// The nodes have had the edge that next_edge() told.
  virtual void clock(Time now) { (void)now; }
  /// True if it wants on_bit().
  [[nodiscard]] virtual bool wants_bits() const { return false; }
  /// A bit of its own node.
  virtual void on_bit(const BitRecord &bit) { (void)bit; }
  /// A frame on its bus, as the monitor of the bus tells it.
  virtual void on_frame(const BusFrame &frame) { (void)frame; }
  /// The simulation's own software of any node of its bus has received a frame.
  virtual void on_received(NodeId node, const Frame &frame) {
    (void)node;
    (void)frame;
  }
  /// The simulation's own software of its own node has sent its oldest frame.
  virtual void on_sent() {}
  /// Any event of its bus.
  virtual void on_event(const BusEvent &event) { (void)event; }

  /// True while it needs no simulated time: time may be passed over up to what the bus has planned.
  [[nodiscard]] virtual bool idle() const { return true; }
  /// True if time in which nothing happens is to be passed over at no cost.
  [[nodiscard]] virtual bool passes_time() const { return false; }
  /// True if it has nothing left to do, whatever comes.
  [[nodiscard]] virtual bool done() const { return true; }
  /// Part of its work that is done, 0..1.
  [[nodiscard]] virtual double progress() const { return done() ? 1 : 0; }
  /// The programs of the host that it connects with its node; nullptr: none.
  [[nodiscard]] virtual Outlet *outlet() { return nullptr; }

  /// The session is over after `elapsed`, but for frames that still wait.
  virtual void end(Time elapsed) { (void)elapsed; }
  /// Adds what it knows to the report of its bus, before the expectations are checked.
  virtual void report(RunReport &report) { (void)report; }
};

/// Makes operators for kinds of nodes that need more than this library, such as CAN interfaces.
class OperatorFactory {
 public:
  virtual ~OperatorFactory() = default;
  /// The operator for a node; nullptr: none of this factory's kinds. InputError: it cannot be made.
  [[nodiscard]] virtual std::unique_ptr<Operator> make(const OperatorContext &context) = 0;
};

/// The operator of a node or listener, from the library's own kinds, then from `factories`; nullptr
/// for a node that needs none. Throws InputError if no factory knows the kind.
[[nodiscard]] std::unique_ptr<Operator> make_operator(const OperatorContext &context,
                                                      std::span<OperatorFactory *const> factories);

}  // namespace vericansim
