// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeNode: a whole core of 64 buffers with the time unit, in one Verilated model.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "node/rtl_node.hpp"

namespace vericansim {

/// ns a clock of every TimeNode after a reset: what a clock of 8 MHz needs (sim/CMakeLists.txt).
inline constexpr std::uint64_t kTimeStep = 125;

/// The core, every clock of it evaluated. With let_rest(true) a core whose engine has stopped is
/// not, while nothing in it moves but TIME: that goes on in closed form
/// (tb/time/time_rest_test.cpp).
class TimeNode final : public RtlNode {
 public:
  explicit TimeNode(std::string name, const ClockConfig &clock = {});
  ~TimeNode() override;

  void reset() override;
  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t quiet() const override;
  void pass(std::uint64_t edges) override;
  [[nodiscard]] std::uint64_t trace() const override;
  [[nodiscard]] std::uint8_t irq_lines() const override;
  void request_stop(bool stop) override;
  /// Always std::logic_error: this node is read by real transfers only.
  [[nodiscard]] AhbResult peek(const AhbTransfer &transfer) override;

  void let_rest(bool allowed);
  /// Called when a line, irq_o or irq_time_o, has risen.
  std::function<void()> on_interrupt;

  /// Number, as of edges(), of the first edge of the oscillator: those of a reset come before.
  static constexpr std::uint64_t kEdgesOfReset = 2;
  /// Clock edges since the reset ended: TIME is kTimeStep times that while nobody sets it (TM-10).
  [[nodiscard]] std::uint64_t edges() const;
  /// Edges after which the transmit flip-flop had gone dominant.
  [[nodiscard]] const std::vector<std::uint64_t> &falls() const { return falls_; }
  /// Edges after which the trace told that a frame had become valid: the end of EOF6's sample
  /// point.
  [[nodiscard]] const std::vector<std::uint64_t> &valids() const { return valids_; }
  /// Edges after which `time_out_o` had changed.
  [[nodiscard]] const std::vector<std::uint64_t> &pulses() const { return pulses_; }
  /// `irq_time_o`.
  [[nodiscard]] bool irq_time() const override;
  /// `time_out_o`.
  [[nodiscard]] bool time_out() const override { return out_; }
  /// Level of `ext_i` from the next clock edge on.
  void external(bool level) override;

 private:
  struct Impl;  // keeps the Verilated header out of this one

  void edge();
  void watch_rest();
  void note_interrupt();

  std::unique_ptr<Impl> impl_;
  std::uint64_t edges_ = 0;
  bool dominant_ = false, out_ = false, interrupt_ = false;
  bool rests_ = false;  // let_rest()
  bool still_ = false;  // the last edge has moved nothing but TIME
  std::vector<std::uint64_t> falls_, valids_, pulses_;
};

}  // namespace vericansim
