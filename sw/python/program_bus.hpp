// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ProgramBus: a simulated bus that one program holds, steps and works node by node.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bridge/port_node.hpp"
#include "program_port.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {

/// What a program wants to have.
struct ProgramBusSetup {
  Scenario scenario;               ///< nodes, traffic and faults besides; may be empty
  std::optional<double> bitrate;   ///< bit/s; none: the first of the scenario
  std::vector<std::string> nodes;  ///< worked by the program; added where the scenario lacks them
  double clock_hz = 8e6;           ///< of nodes that are added
  Time restart = 0;                ///< simulated time from bus-off to recovery; 0: only restart()
  bool by_identifier = false;      ///< of the frames that wait the lowest identifier leaves first
};

/// Every node of the program is a Verilated core behind the software of PortNode. Nothing happens
/// but in step() and run_until_quiet(). Times count from the end of the constructor, ps.
class ProgramBus : private BusObserver {
 public:
  /// Whatever would end later is refused (std::invalid_argument): picoseconds reach to 9,223,372 s,
  /// of which a node's restart may need the rest.
  static constexpr Time kLongestLife = 8'000'000 * kSecond;

  /// Builds the bus and lets all nodes join it. InputError or std::invalid_argument if it cannot
  /// be.
  explicit ProgramBus(ProgramBusSetup setup);
  ~ProgramBus() override;
  ProgramBus(const ProgramBus &) = delete;
  ProgramBus &operator=(const ProgramBus &) = delete;

  /// Queues a frame. std::invalid_argument: no such node of the program, or no frame.
  void send(const std::string &node, const can_frame &frame);
  /// What a node had for the program since the last call: frames, echoes of its own frames at their
  /// ends, error messages, in the order of the bus.
  [[nodiscard]] std::vector<PortMessage> receive(const std::string &node);
  /// Frames of the program that have not left: queued, waiting in the core, or on the bus.
  [[nodiscard]] std::size_t pending(const std::string &node);
  /// Lets a bus-off node recover.
  void restart(const std::string &node);

  /// Called some twenty times a second of the host while time passes; what it throws ends the step
  /// there, after which the bus can go on.
  std::function<void()> on_look;

  /// Lets simulated time pass.
  void step(Time duration);
  /// The same, at no cost while nothing is under way: the clocks of all nodes rest then.
  void pass(Time duration);
  /// Steps until no node of the program or of the scenario has anything to send or under way; false
  /// if `limit` came first.
  bool run_until_quiet(Time limit);
  /// Steps until a node of the program has a message (frame, echo or error message), which is
  /// looked for every four bits; false if `limit` came first.
  bool run_until_message(Time limit);
  [[nodiscard]] bool quiet() const;
  /// Nothing is under way, and nothing is planned: without the program nothing will happen.
  [[nodiscard]] bool settled() { return quiet() && !simulation_.bus().has_actions(); }

  /// Receivers see another level for a while: `node` alone, or, if empty, all. From `begin`, which
  /// is not in the past; std::invalid_argument otherwise.
  void disturb(const std::string &node, Effect effect, Time begin, Time duration);

  [[nodiscard]] Time now() { return simulation_.bus().now() - simulation_.started(); }
  [[nodiscard]] Time bit_time() const { return bit_time_; }
  [[nodiscard]] bool level() { return simulation_.bus().level() == Level::kRecessive; }
  /// Error counters and state of any core.
  [[nodiscard]] Trace trace(const std::string &node);
  [[nodiscard]] std::vector<std::string> names() const;
  /// Valid frames on the bus since the last call.
  [[nodiscard]] std::vector<BusFrame> frames() { return told(frames_); }
  /// Frames, error frames and overload frames on the bus since the last call, in their order.
  [[nodiscard]] std::vector<BusEvent> events() { return told(events_); }
  /// Completes the files of the scenario's outputs. send(), restart(), disturb() and whatever lets
  /// time pass throw std::runtime_error after it.
  [[nodiscard]] RunReport finish() {
    check_process();
    finished_ = true;
    if (quiet()) simulation_.settle();
    return simulation_.finish();
  }
  [[nodiscard]] Time started() const { return simulation_.started(); }
  /// True in a process that was forked from the one that opened the files of the outputs: finish()
  /// and what throws after it throw std::runtime_error there, and a destructor would remove them.
  [[nodiscard]] bool files_of_another() const;

 private:
  /// A node of the program.
  struct Worked {
    NodeId id;
    std::unique_ptr<ProgramPort> port;
    std::unique_ptr<PortNode> node;
  };

  /// Without an edge behind it, the last frame is told two bits behind its end.
  template <typename Value>
  [[nodiscard]] std::vector<Value> told(std::vector<Value> &values) {
    simulation_.settle();
    return std::exchange(values, {});
  }
  static Scenario with_nodes(ProgramBusSetup &setup);
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId id, const BitRecord &bit) override;
  void join();
  void check_process() const;
  void check_open() const;
  void exchange();
  /// When what begins now and takes `duration` ends, on the bus's own clock.
  [[nodiscard]] Time end_of(Time duration);
  void look();
  [[nodiscard]] Time stretch() const;
  void run_until(Time when);
  [[nodiscard]] Worked &worked(const std::string &name);
  [[nodiscard]] NodeId id_of(const std::string &name) const;

  ScheduledFaults faults_;  // outlives the bus
  bool disturbed_ = false;
  bool finished_ = false;
  pid_t process_;
  Scenario scenario_;
  Simulation simulation_;
  Time bit_time_;
  std::chrono::steady_clock::time_point next_look_;
  std::vector<Worked> worked_;
  std::vector<PortNode *> by_id_;
  std::vector<BusFrame> frames_;
  std::vector<BusEvent> events_;
};

}  // namespace vericansim
