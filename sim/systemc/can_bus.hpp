// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CanBus: the wired-AND bus between SystemC modules, with the delays of cable and transceivers.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "bus/bus.hpp"
#include "systemc/time.hpp"
#include "systemc/verican_tlm.hpp"

namespace vericansim {

/// The bus. A level driven at time t reaches each other node after the delays of both stubs and
/// transceivers (Link, bus/bus.hpp); the pin of a node shows the AND of what has arrived. Pins are
/// recessive (true) while nobody drives.
///
/// A bus is either for pins, of cycle-exact modules and anything else that has pins; or for loosely
/// timed modules, whose clocks it then runs itself: exactly to the clock among each other, but not
/// in step with SystemC. The bus is behind SystemC's time by at most one quantum, and ahead of it
/// as far as the local time of an initiator that accesses a module. An access to a module of a bus
/// that is ahead already takes place then: late by at most the quantum of the initiators. Where
/// several modules are accessed within a quantum, the initiators do not run ahead (b_transport
/// waits), so that nobody is made late again and again.
class CanBus : public sc_core::sc_module {
 public:
  /// The pins of a node, as signals.
  using Pin = sc_core::sc_signal<bool, sc_core::SC_MANY_WRITERS>;
  struct Pins {
    Pin tx;  ///< driven by the node
    Pin rx;  ///< driven by the bus
    explicit Pins(const std::string &name)
        : tx{(name + "_tx").c_str(), true}, rx{(name + "_rx").c_str(), true} {}
  };

  explicit CanBus(const sc_core::sc_module_name &name);

  /// A node with pins, and its index; at most Bus::kMaxNodes (std::invalid_argument beyond, or if a
  /// delay is negative). During elaboration.
  NodeId add_pins(const std::string &name, const Link &link = {});
  /// Puts a module on the bus: binds can_rx and can_tx, or runs it if it is loosely timed.
  NodeId attach(VericanTlm &node, const Link &link = {});
  /// Sets the delay from the TX pin of `from` to the RX pin of `to`, instead of the sum of the
  /// links.
  void set_delay(NodeId from, NodeId to, Time delay);
  /// Of a node that has any; std::out_of_range for others, loosely timed modules among them.
  [[nodiscard]] Pins &pins(NodeId id) { return *nodes_.at(id).pins; }

  /// The level at the star point of the cables. Of loosely timed modules: as far as the bus has
  /// got.
  sc_core::sc_signal<bool> level{"level", true};

  /// Loosely timed: how far the bus may lag behind SystemC's time. Unset, or zero: the global
  /// quantum of TLM-2.0 as it is when the simulation starts; no less than the shortest clock
  /// period. During the simulation: from the end of the present quantum on.
  void set_quantum(const sc_core::sc_time &quantum);
  /// The simulator's bus that runs loosely timed modules, for its observers and faults.
  [[nodiscard]] Bus &kernel() { return kernel_; }

  using sc_core::sc_module::trace;
  /// Writes the level and all pins to a VCD file.
  void trace(sc_core::sc_trace_file *file);

 private:
  friend class VericanTlm;

  struct Arrival {
    Time time;
    NodeId source;
    bool level;
  };
  // Who has been heard as dominant, and the changes still on the wire, oldest first.
  struct Receiver {
    std::uint64_t dominant = 0;
    std::deque<Arrival> pending;

    void push(Arrival arrival);
    [[nodiscard]] bool collect(Time now);  // the level
  };
  struct Entry {
    std::unique_ptr<Pins> pins;
    Link link;
    Receiver receiver;
    bool tx = true;
  };

  void end_of_elaboration() override;
  void start_of_simulation() override;

  void resolve();
  void send(NodeId from, Time now);
  [[nodiscard]] Time delay(NodeId from, NodeId to) const;

  void pace();
  void announce();
  void run_to(const sc_core::sc_time &time);
  void catch_up() { run_to(sc_core::sc_time_stamp()); }
  [[nodiscard]] bool shared_with_others(const VericanTlm &node) const;
  void run_until_done(RtlNode &node, AhbMaster::Ticket ticket);
  [[nodiscard]] sc_core::sc_time kernel_time() const { return to_sc_time(kernel_.now()); }

  std::vector<Entry> nodes_;
  std::map<std::pair<NodeId, NodeId>, Time> delay_override_;
  Receiver star_;
  sc_core::sc_event due_;  // the next change arrives somewhere

  Bus kernel_;
  std::vector<VericanTlm *> loose_;
  sc_core::sc_time wanted_;    // set_quantum()
  sc_core::sc_time global_;    // quantum of TLM-2.0
  sc_core::sc_time shortest_;  // clock period
  sc_core::sc_time quantum_;   // what these make
};

}  // namespace vericansim
