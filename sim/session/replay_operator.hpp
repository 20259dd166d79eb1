// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayOperator: feeds a recording to a node's software and follows it to all who hear the bus.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "results/replay_result.hpp"
#include "session/operator.hpp"
#include "session/replay_plan.hpp"

namespace vericansim {

/// Every frame of the recording must be on the bus, bit-exact and in order, and so must every node
/// have it whose software takes any frame.
class ReplayOperator : public Operator {
 public:
  /// Reads the log. Throws InputError if that cannot be done.
  explicit ReplayOperator(const OperatorContext &context);

  void begin(Time now) override;
  void check() override;
  void on_frame(const BusFrame &frame) override;
  void on_received(NodeId node, const Frame &frame) override;
  void on_sent() override;
  [[nodiscard]] bool passes_time() const override { return true; }
  [[nodiscard]] bool done() const override;
  [[nodiscard]] double progress() const override;
  void end(Time elapsed) override;
  void report(RunReport &report) override;

 private:
  /// How far a node has got with the recording.
  struct Follower {
    NodeId node;
    std::uint64_t seen = 0;  // frames of the recording, from the first
  };

  [[nodiscard]] const Frame &frame(std::uint64_t number) const;
  [[nodiscard]] Time due(std::uint64_t number) const;
  [[nodiscard]] bool more() const;
  [[nodiscard]] bool stored(const Frame &frame) const;
  void feed();
  void skip_unstored(Follower &follower) const;
  [[nodiscard]] std::string give_up_reason() const;
  [[nodiscard]] std::string failure_at_end(bool interrupted) const;
  [[nodiscard]] ReplayReceiver judge(const Follower &follower) const;

  Simulation &simulation_;
  NodeId id_;
  std::string name_, file_;
  bool saturated_, loop_;
  ReplayPlan plan_;
  std::vector<Follower> followers_;
  std::uint64_t fed_ = 0;   // frames given to the software
  std::uint64_t sent_ = 0;  // of these, on the bus and acknowledged, as they should be
  std::uint64_t left_ = 0;  // of these, the software has been told that they left
  std::string failure_;
  bool none_of_share_ = false;
  Time bit_time_;
  Time start_ = 0;
  Time last_frame_ = 0;  // on the bus, of anybody
  Time last_own_ = 0;    // when the node had nothing to send, or got rid of a frame
  bool over_ = false;
  Time elapsed_ = 0;  // when it was over
};

}  // namespace vericansim
