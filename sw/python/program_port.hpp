// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ProgramPort: the CAN interface of a node for the program that holds the simulator itself.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bridge/can_port.hpp"

namespace vericansim {

/// Two queues in memory; no descriptor, no other process.
class ProgramPort : public CanPort {
 public:
  explicit ProgramPort(std::string name) : name_{std::move(name)} {}

  [[nodiscard]] const std::string &name() const override { return name_; }
  void poll_set(std::vector<pollfd> &, bool) override {}
  void service(std::span<const pollfd>) override {}
  [[nodiscard]] std::optional<PortMessage> take() override;
  [[nodiscard]] std::size_t remaining() override { return to_bus_.size(); }
  [[nodiscard]] bool put(const PortMessage &message) override;
  [[nodiscard]] bool up() const override { return true; }
  [[nodiscard]] bool wants_echo() const override { return true; }

  /// A frame for the bus, behind those that wait.
  void send(const can_frame &frame);
  /// All that the bus had for the program since the last call.
  [[nodiscard]] std::vector<PortMessage> receive();
  /// Whether receive() would have anything.
  [[nodiscard]] bool heard() const { return !from_bus_.empty(); }

 private:
  std::string name_;
  std::deque<PortMessage> to_bus_;
  std::vector<PortMessage> from_bus_;
};

}  // namespace vericansim
