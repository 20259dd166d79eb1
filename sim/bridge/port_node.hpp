// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortNode: the node of the bus that a CAN interface of the host is.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "bus/bus.hpp"
#include "can_port.hpp"
#include "error_messages.hpp"
#include "node/host.hpp"
#include "results/port_report.hpp"
#include "trace/id_filter.hpp"

namespace vericansim {

/// How the nodes of interfaces behave.
struct PortOptions {
  ErrorChoice errors = ErrorChoice::kOwn;
  std::vector<IdFilter> filters{};  ///< frames of the bus for the programs; empty: all
  Time restart = 0;  ///< simulated time from bus-off to the begin of recovery; 0: only restart()
  /// Of the frames that the node holds the lowest identifier leaves first, not the oldest; frames
  /// of one identifier keep their order.
  bool by_identifier = false;
};

/// Messages that wait for the programs, in the order of the bus. A received frame has its place
/// from the bit in which it becomes valid, though software reads it out later.
class Outbox {
 public:
  void push(const PortMessage &message) { slots_.push_back({message, true}); }
  /// A frame has become valid; it will end at `time`.
  void expect(Time time);
  /// Software has read the next expected frame, which the programs get if it is `wanted`.
  void fill(const can_frame &frame, bool wanted);
  /// An expected frame will not come.
  void lose();

  /// Gives what is ready to the programs, or counts it as away while the port is down. False if the
  /// port refuses a message for now.
  bool give_to(CanPort &port, PortCounts &counts);
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  /// True while software has still to read a frame.
  [[nodiscard]] bool expecting() const { return expected_ != 0; }

 private:
  struct Slot {
    PortMessage message;
    bool ready = false;
    bool wanted = true;
  };
  std::deque<Slot>::iterator first_expected();

  std::deque<Slot> slots_;
  std::size_t expected_ = 0;
};

/// A Verilated core with software, between a CanPort and the bus. Frames of programs leave in their
/// order, or by PortOptions::by_identifier; messages for programs keep the order of the bus.
class PortNode {
 public:
  /// Frames that the node holds at most; more wait in the port.
  static constexpr std::size_t kRoom = 16;

  PortNode(CanPort &port, RtlNode &node, const BitTiming &timing, const PortOptions &options);
  PortNode(const PortNode &) = delete;
  PortNode &operator=(const PortNode &) = delete;

  void start() { host_.start(); }
  [[nodiscard]] bool ready() const { return host_.ready(); }
  /// Rethrows what went wrong in the node's software.
  void check() { host_.check(); }

  /// Takes frames of programs as long as there is room.
  void take();
  /// Gives messages to the programs; false if the port refuses one for now.
  bool give() { return outbox_.give_to(port_, counts_); }
  /// To be called for each bit of this node.
  void on_bit(const BitRecord &bit);
  /// Lets a bus-off node recover: 128 times 11 recessive bits, less those that have passed (BO-02).
  void restart();

  /// True while the node needs no simulated time: idle, no frame to send, none to read. A node that
  /// stays bus-off is quiet whatever waits.
  [[nodiscard]] bool quiet() const;
  /// Messages that wait for the programs.
  [[nodiscard]] std::size_t waiting() const { return outbox_.size(); }
  /// Frames of programs that have not left.
  [[nodiscard]] std::size_t pending() const { return queue_.size(); }
  [[nodiscard]] bool bus_off() const { return bus_off_; }
  [[nodiscard]] const PortCounts &counts() const { return counts_; }
  [[nodiscard]] const CanPort &port() const { return port_; }

 private:
  void on_received(const HostFrame &frame);
  void on_sent(Time end);
  void on_told(const HostFrame &sent);
  /// The oldest frame of this identifier and format; by_identifier it alone is in the core.
  [[nodiscard]] std::deque<PortMessage>::iterator first_of(canid_t identifier);
  void echo(PortMessage message, Time end);
  void enter_bus_off();

  CanPort &port_;
  RtlNode &node_;
  PortOptions options_;
  Time bit_time_, after_sample_;
  ErrorMessages errors_;
  Outbox outbox_;
  std::deque<PortMessage> queue_;  // taken from the port, not yet sent
  std::deque<Time> ends_;          // by_identifier: of frames that have left, not yet told by it
  PortCounts counts_;
  bool bus_off_ = false;
  bool recovering_ = false;
  Host host_;
};

}  // namespace vericansim
