// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BoardNode: a whole board of examples/remote/board on the bus, by its pins alone: RTL, netlist or
// bitstream.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "bus/node.hpp"
#include "node/model_context.hpp"

namespace vericansim {

/// `Model`: a Verilated remote_icestick or remote_hx8k. Out of reset 8 clocks after the first.
/// Number 3.
template <typename Model>
class BoardNode : public Node {
 public:
  BoardNode(std::string name, const ClockConfig &clock) : Node{std::move(name), clock} {
    set_inputs(0);
    set_number(3);
    model_.can_rx_i = 1;
    model_.clk_i = 0;
    model_.eval();
  }
  ~BoardNode() override { model_.final(); }
  BoardNode(const BoardNode &) = delete;
  BoardNode &operator=(const BoardNode &) = delete;

  void clock(Level rx) override {
    model_.can_rx_i = static_cast<std::uint8_t>(rx);
    model_.clk_i = 1;
    model_.eval();
    model_.clk_i = 0;
    model_.eval();
    drive(static_cast<Level>(model_.can_tx_o));
  }

  /// Inputs of user logic.
  void set_inputs(unsigned bits) { model_.inputs_i = static_cast<std::uint8_t>(bits); }
  /// The node's number, where pins set it.
  void set_number(unsigned number) {
    if constexpr (kNumberPins) model_.number_i = static_cast<std::uint8_t>(number);
  }
  /// Outputs of user logic: pins, or the HX8K board's LEDs.
  [[nodiscard]] unsigned outputs() const {
    if constexpr (kNumberPins)
      return model_.leds_o;
    else
      return model_.outputs_o;
  }

  static constexpr bool kNumberPins = requires(Model model) { model.number_i; };
  static constexpr unsigned kInputMask = 3;
  static constexpr unsigned kOutputMask = kNumberPins ? 0xFF : 0xF;

 private:
  SerialContext context_;
  Model model_{&context_};
  ModelContext model_context_{context_};
};

}  // namespace vericansim
