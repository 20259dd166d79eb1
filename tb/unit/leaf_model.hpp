// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LeafModel: one Verilated block of the RTL with its clock and reset, for its unit test.
#pragma once

#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "verilated.h"

namespace vericansim {

/// Whether blocks have the registers that their source names; a netlist has other variables. A
/// template, so that a static_assert can look at it in a branch that is not taken.
template <typename Root>
#ifdef VERICAN_RTL_TRANSFORMED
inline constexpr bool kHasRegisters = false;
#else
inline constexpr bool kHasRegisters = true;
#endif

/// A block with clk_i and rst_ni. Inputs are set through `->` and hold until they are set again.
template <typename Model>
class LeafModel {
 public:
  LeafModel() { top_.eval(); }  // the first evaluation only initialises
  ~LeafModel() { top_.final(); }
  LeafModel(const LeafModel &) = delete;
  LeafModel &operator=(const LeafModel &) = delete;

  Model *operator->() { return &top_; }
  /// Signals inside, of blocks that show them.
  auto &root() { return *top_.rootp; }
  /// Rising edge with the inputs as they are.
  void clock() { rising_edge(top_, top_.clk_i); }
  /// Lets outputs follow the inputs without a clock edge.
  void settle() { top_.eval(); }
  /// Asynchronous reset; one edge with it, one without.
  void reset() {
    top_.rst_ni = 0;
    clock();
    top_.rst_ni = 1;
    clock();
  }

 private:
  SerialContext context_;
  Model top_{&context_, "leaf"};
};

}  // namespace vericansim
