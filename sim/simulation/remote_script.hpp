// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteScript: the commands of a scenario that a host sends to remote nodes.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "model/bus_monitor.hpp"
#include "node/host.hpp"
#include "results/report.hpp"
#include "scenario/remote_spec.hpp"

namespace vericansim {

/// The commands of one host: frames leave in the order of the commands (RN-94), a read waits for
/// its answer and is tried three times (RN-91). Its host must have one transmit buffer. Must
/// outlive the bus's actions.
class RemoteScript {
 public:
  RemoteScript(NodeId node, std::string name, Host &host, Bus &bus)
      : node_{node}, name_{std::move(name)}, host_{host}, bus_{bus} {}
  RemoteScript(const RemoteScript &) = delete;
  RemoteScript &operator=(const RemoteScript &) = delete;

  /// `spec` must outlive the script. Rounds begin from `start` on, none at `stop` or later.
  void add(const RemoteCommandSpec &spec, Time start, Time stop);
  /// The host has received a frame.
  void on_received(const Frame &frame);
  /// A frame has ended on the bus.
  void on_frame(const BusFrame &frame);

  /// A frame has been given to the host.
  std::function<void(const Frame &frame)> on_command;

  [[nodiscard]] NodeId node() const { return node_; }
  [[nodiscard]] const std::string &name() const { return name_; }
  [[nodiscard]] std::uint64_t done() const { return done_; }
  /// Answers that were wrong or never came, and what has not come to its end.
  [[nodiscard]] std::vector<CheckResult> failures() const;
  /// Response times of the steps that come again and again: from their event to the end on the bus,
  /// of those that are answered until the host has the answer.
  [[nodiscard]] std::vector<MessageReport> messages() const;

 private:
  struct Due {
    const RemoteCommandSpec *spec;
    std::uint64_t round;
    Time event;
    std::size_t first_message;  // of its steps in messages_, if it has a period
    std::size_t step = 0;
  };
  struct OnBus {
    Frame frame;
    Time event;
    std::size_t message;
  };

  void schedule(const RemoteCommandSpec &spec, std::uint64_t round, Time when, Time stop,
                std::size_t first_message);
  void work();
  void send(const Due &due, const RemoteStep &step);
  void ask();
  void on_time_out(std::uint64_t asked);
  void finish_step();
  void respond(std::size_t message, Time response);
  void failed(const RemoteStep &step, const std::string &wanted, const std::string &seen);

  NodeId node_;
  std::string name_;
  Host &host_;
  Bus &bus_;
  std::vector<const RemoteCommandSpec *> never_;  // their time is behind the end
  std::deque<Due> due_;
  std::deque<OnBus> on_bus_;  // frames of periodic steps that have not ended yet
  std::vector<MessageReport> messages_;
  std::vector<CheckResult> failures_;
  const RemoteStep *waiting_ = nullptr;  // a read without its answer
  unsigned tries_left_ = 0;
  std::uint64_t asked_ = 0;  // requests of reads, to tell a time-out that is none any more
  std::uint8_t trigger_ = 0;
  std::uint64_t done_ = 0;
};

}  // namespace vericansim
