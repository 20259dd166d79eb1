// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bridge: the bus of a scenario with CAN interfaces of the host as nodes, run beside the programs
// that use them; the short form of a session with such nodes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bridge_report.hpp"
#include "can_port.hpp"
#include "port_node.hpp"
#include "session/session.hpp"

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

/// A session of the scenario with the ports as nodes.
class Bridge {
 public:
  /// Builds the bus. Throws InputError if the scenario cannot have these nodes or this bit rate.
  Bridge(BridgeSetup setup, Wall &wall);

  /// Lets all nodes join the bus; times count from here.
  void start() { session_->start(); }
  /// One round; false once it is over.
  bool round() { return session_->round(); }
  /// Lets what is under way come to its end, for at most the scenario's `drain`; completes files.
  [[nodiscard]] BridgeReport finish();
  /// All of these.
  [[nodiscard]] BridgeReport run();

  /// "vcan0 on a bus of 3 nodes at 500 kbit/s", for people.
  [[nodiscard]] const std::string &description() const { return description_; }
  [[nodiscard]] Simulation &simulation() { return session_->simulation(); }
  /// Simulated time since start(), ps.
  [[nodiscard]] Time elapsed() { return session_->elapsed(); }
  [[nodiscard]] const Pacer &pacer() const { return session_->pacer(); }

 private:
  std::string description_;
  std::unique_ptr<Session> session_;
};

}  // namespace vericansim
