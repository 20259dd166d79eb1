// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// rising_edge(): one clock cycle of a Verilated model for the price of one eval(); settled_edge():
// for less, where no input has changed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "verilated.h"

namespace vericansim {

#ifdef VERICAN_PLAIN_EDGES
/// No short cuts: for models of netlists, or of a Verilator that is not 5.006 (verilate.cmake).
inline constexpr bool kPlainEdges = true;
#else
inline constexpr bool kPlainEdges = false;
#endif

/// Evaluates a rising edge of the model's clock, with its other inputs as they are now.
///
/// Nothing in the design is clocked by the falling edge, so the eval() for it does no work but
/// costs as much as the combinational logic of the inputs. Verilator 5.006 keeps the last level of
/// the clock in a member of the root; where that exists it is set to "was low" and the falling edge
/// is left out.
template <typename Model, typename Signal>
inline void rising_edge(Model &model, Signal &clock) {
  [[maybe_unused]] auto &root = *model.rootp;
  if constexpr (!kPlainEdges && requires { root.__Vtrigrprev__TOP__clk_i; }) {
    root.__Vtrigrprev__TOP__clk_i = 0;
  } else if constexpr (!kPlainEdges && requires { root.__Vtrigrprev__TOP__hclk; }) {
    root.__Vtrigrprev__TOP__hclk = 0;
  } else {
    clock = 0;
    model.eval();
  }
  clock = 1;
  model.eval();
}

/// The same for a model whose inputs are as they were at its last eval(), but for those that only
/// flip-flops look at, and whose clock input is high: what is clocked is evaluated at once, without
/// the combinational logic of the inputs and the search for what has changed.
/// verican_clock_edge(Root *), one for each model, is written by cmake/include_all.cmake. Without
/// short cuts it does nothing and is not to be called.
template <typename Model>
inline void settled_edge([[maybe_unused]] Model &model) {
  if constexpr (!kPlainEdges) {
    auto &root = *model.rootp;
    auto set_all = []<std::size_t kCount>(VlTriggerVec<kCount> &triggers) {
      for (std::size_t i = 0; i < kCount; ++i) triggers.at(i) = true;
    };
    set_all(root.__VnbaTriggered);
    verican_clock_edge(&root);
  }
}

}  // namespace vericansim
