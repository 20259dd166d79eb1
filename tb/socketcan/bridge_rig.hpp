// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A bridge between programs and a real time that are the test's own.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bridge/bridge.hpp"

namespace vericansim::test {

/// An interface whose programs are the test.
class FakePort : public CanPort {
 public:
  explicit FakePort(std::string port_name) : name_{std::move(port_name)} {}

  [[nodiscard]] const std::string &name() const override { return name_; }
  void poll_set(std::vector<pollfd> &, bool) override {}
  void service(std::span<const pollfd>) override {}
  [[nodiscard]] std::optional<PortMessage> take() override;
  [[nodiscard]] std::size_t remaining() override { return outgoing.size(); }
  [[nodiscard]] bool put(const PortMessage &message) override;
  [[nodiscard]] bool up() const override { return is_up; }
  [[nodiscard]] bool wants_echo() const override { return echo; }
  [[nodiscard]] bool awaits_time() const override { return awaits; }
  [[nodiscard]] std::uint64_t lost() const override { return lost_frames; }

  /// A program sends.
  void send(const Frame &frame, std::uint64_t client = PortMessage::kNobody);
  /// What the programs got: frames (echoes apart), and error messages.
  [[nodiscard]] std::vector<Frame> frames() const;
  [[nodiscard]] std::vector<Frame> echoes() const;
  [[nodiscard]] std::vector<can_frame> errors() const;
  /// Error messages that have all bits of `classes`.
  [[nodiscard]] std::vector<can_frame> errors(canid_t classes) const;

  std::deque<PortMessage> outgoing;
  std::vector<PortMessage> got;
  std::size_t room = ~std::size_t{0};  ///< messages that the programs still take
  std::size_t refusals = 0;
  bool is_up = true;
  bool echo = false;
  bool awaits = false;
  std::uint64_t lost_frames = 0;

 private:
  std::string name_;
};

/// Real time that passes as the test has it.
class FakeWall : public Wall {
 public:
  [[nodiscard]] WallTime now() override { return time += cost; }
  void wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) override;
  [[nodiscard]] bool stop_requested() override { return stop; }
  [[nodiscard]] bool restart_requested() override { return std::exchange(restart, false); }

  WallTime time = 1'000'000'000;  ///< ns
  WallTime cost = 0;              ///< of each look at the clock: a slow computer
  bool stop = false;
  bool restart = false;
  unsigned endless_waits = 0;
  std::vector<WallTime> timeouts;
  std::function<void()> on_wait = [] {};
};

/// Options of a rig; the ports are called can0, can1, ...
struct RigOptions {
  unsigned ports = 1;
  unsigned nodes = 2;    ///< plain ones
  unsigned remotes = 0;  ///< nodes without a processor, numbers from 1 on
  bool monitor = false;
  bool fast = true;
  double bitrate = 500e3;
  PortOptions options{};
  std::vector<FaultSpec> faults{};
  std::vector<TrafficSpec> traffic{};
  Time limit = 0;
  bool end_when_down = false;
};

/// Bridge, ports and wall. Node ids: plain nodes from 0, then the
/// remote ones, then the ports.
class BridgeRig {
 public:
  explicit BridgeRig(const RigOptions &options);

  [[nodiscard]] FakePort &port(std::size_t i) { return *ports_[i]; }
  [[nodiscard]] FakePort &monitor() { return *monitor_; }
  [[nodiscard]] Bridge &bridge() { return *bridge_; }
  /// Rounds until `done`; false if that takes more than `limit` of simulated time or 200,000 rounds
  /// without any.
  bool run_until(const std::function<bool()> &done, Time limit = 10 * kSecond);
  /// Rounds until simulated time has gone on by `time`, or stands still.
  void run_for(Time time);

  FakeWall wall;
  std::vector<std::string> said;

 private:
  std::vector<FakePort *> ports_;
  FakePort *monitor_ = nullptr;
  std::unique_ptr<Bridge> bridge_;
};

/// A frame made from a number: base and extended, data and remote, every DLC. Frames of even and of
/// odd numbers never have the same identifier, so that two senders may have them (AR-10).
[[nodiscard]] Frame numbered_frame(unsigned number);

/// A message of node 0, identifier 055, for RigOptions::traffic.
[[nodiscard]] TrafficSpec beat(Time period);

}  // namespace vericansim::test
