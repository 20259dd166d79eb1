// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// rising_edge(): one clock cycle of a Verilated model for the price of one eval().
#pragma once

#include <cstdint>

namespace vericansim {

/// Evaluates a rising edge of the model's clock, with its other inputs as they are now.
///
/// Nothing in the design is clocked by the falling edge, so the eval() for it does no work but
/// costs as much as the combinational logic of the inputs. Verilator 5.006 keeps the last level of
/// the clock in a member of the root; where that exists it is set to "was low" and the falling edge
/// is left out.
template <typename Model, typename Signal>
inline void rising_edge(Model &model, Signal &clock) {
  auto &root = *model.rootp;
  if constexpr (requires { root.__Vtrigrprev__TOP__clk_i; }) {
    root.__Vtrigrprev__TOP__clk_i = 0;
  } else if constexpr (requires { root.__Vtrigrprev__TOP__hclk; }) {
    root.__Vtrigrprev__TOP__hclk = 0;
  } else {
    clock = 0;
    model.eval();
  }
  clock = 1;
  model.eval();
}

}  // namespace vericansim
