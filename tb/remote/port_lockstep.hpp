// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortLockstep: can_remote at the engine's port and the model of its rules, step by step.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "model/remote_model.hpp"
#include "remote/frame_port.hpp"

namespace vericansim {

/// Both get the same frames, milliseconds and accesses; difference() tells the first thing in which
/// they are not equal.
class PortLockstep {
 public:
  /// Profile and parameters as FramePort::create(). The node has joined the bus.
  PortLockstep(const std::string &profile, unsigned name_bits, unsigned number);

  /// A reset now; what user logic writes then it writes before start().
  void reset();
  void start();
  /// A frame that somebody else sends is valid.
  void receive(const Frame &frame);
  /// One that an error ends.
  void receive_broken(const Frame &frame, unsigned bytes);
  /// The node's turn: what it offers is sent, or fails as `end` says. False: it offers nothing.
  bool turn(FramePort::End end = FramePort::End::kSent);
  /// Until it offers nothing.
  void drain();
  void ms();
  void user_write(unsigned word, std::uint32_t data, unsigned lanes);
  void hold(bool on);
  /// User logic wants producer entry `k` sent.
  void event(unsigned k);
  void set_counters(unsigned tec, unsigned rec);
  /// The row of the clock from now on.
  void set_clock(const std::array<std::uint8_t, 16> &row);
  /// The engine goes bus-off, or has recovered.
  void bus_off(bool off);

  /// Compares memory, state and pulses; empty: equal.
  [[nodiscard]] const std::string &compare();
  [[nodiscard]] const std::string &difference() const { return difference_; }

  [[nodiscard]] FramePort &port() { return *port_; }
  [[nodiscard]] RemoteModel &model() { return *model_; }
  /// The last steps, for a message.
  [[nodiscard]] std::string history() const;

 private:
  void note(const std::string &step);
  void differ(const std::string &what, const std::string &rtl, const std::string &model);
  void compare_byte(unsigned address);
  void restart();
  void work();

  RemoteConfig config_;
  unsigned number_;
  std::unique_ptr<FramePort> port_;
  std::unique_ptr<RemoteModel> model_;
  std::string difference_;
  std::vector<std::string> steps_;
};

}  // namespace vericansim
