// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bridge: the bus of a scenario with CAN interfaces of the host as nodes, run beside the programs
// that use them.
#pragma once

#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bridge_report.hpp"
#include "bus/observer.hpp"
#include "can_port.hpp"
#include "port_node.hpp"
#include "scenario/simulation.hpp"
#include "session/wall.hpp"

namespace vericansim {

/// What a bridge connects.
struct BridgeSetup {
  /// Nodes, traffic and faults. A node with the name of a port is that port's node; for others one
  /// is added, with the clock `port_clock_hz`.
  Scenario scenario;
  double bitrate = 500e3;
  double port_clock_hz = 8e6;
  std::vector<std::unique_ptr<CanPort>> ports;  ///< each a node
  std::unique_ptr<CanPort> monitor;             ///< gets all that is on the bus; may be empty
  PortOptions options;
  bool fast = false;           ///< not held to real time; waits while nothing is to do
  Time limit = 0;              ///< simulated time to run; 0: until somebody wants the end
  bool end_when_down = false;  ///< end when an interface goes down, instead of waiting for it
  /// Called with each line for the user: interfaces that come and go, the lag.
  std::function<void(const std::string &)> say = [](const std::string &) {};
};

/// Runs in rounds: wait for the programs or for real time, simulate a stretch, exchange messages.
/// Nothing is dropped: a program's frame stays in its port until the node has room, and while
/// programs do not take what the bus has for them, simulated time stands still.
class Bridge : private BusObserver {
 public:
  /// Messages that may wait for the programs of one port before simulated time stands still.
  static constexpr std::size_t kMostWaiting = 4096;

  /// Builds the bus. Throws InputError if the scenario cannot have these nodes or this bit rate.
  Bridge(BridgeSetup setup, Wall &wall);
  ~Bridge() override;
  Bridge(const Bridge &) = delete;
  Bridge &operator=(const Bridge &) = delete;

  /// Lets all nodes join the bus; times count from here.
  void start();
  /// One round; false once it is over.
  bool round();
  /// Lets what is under way come to its end, for at most the scenario's `drain`; completes files.
  [[nodiscard]] BridgeReport finish();
  /// All of these.
  [[nodiscard]] BridgeReport run();

  /// "vcan0 on a bus of 3 nodes at 500 kbit/s", for people.
  [[nodiscard]] std::string description() const;
  [[nodiscard]] Simulation &simulation() { return *simulation_; }
  /// Simulated time since start(), ps.
  [[nodiscard]] Time elapsed() { return simulation_->bus().now() - simulation_->started(); }
  [[nodiscard]] const Pacer &pacer() const { return pacer_; }

 private:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId id, const BitRecord &bit) override;
  void on_frame(const BusFrame &frame);
  void on_event(const BusEvent &event);
  void place_nodes();
  void wait();
  [[nodiscard]] std::optional<WallTime> patience();
  void advance();
  void run_until(Time target);
  void advance_fast(Time end);
  void advance_paced(Time end);
  void give();
  void exchange();
  void give_last();
  void watch_ports();
  void watch(const CanPort &port, char &was_up);
  [[nodiscard]] bool idle() const;
  [[nodiscard]] bool quiet() const;
  [[nodiscard]] bool stalled() const;
  [[nodiscard]] bool all_up() const;
  void drain();
  [[nodiscard]] std::vector<CanPort *> all_ports() const;

  BridgeSetup setup_;
  Wall &wall_;
  Time bit_time_;
  std::vector<NodeId> ids_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<PortNode>> nodes_;
  std::map<NodeId, PortNode *> by_id_;
  Outbox monitor_box_;
  PortCounts monitor_counts_;
  Pacer pacer_;
  WallTime begin_ = 0;
  std::clock_t cpu_begin_ = 0;
  std::vector<char> was_up_;
  std::vector<pollfd> poll_set_;
  bool refused_ = false;  // a port has no room for a message
  bool ended_ = false;
};

}  // namespace vericansim
