// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tick alone: a pulse each millisecond, by which RN-54, RN-70 and RN-72 count.
#include <gtest/gtest.h>

#include "Vcan_rn_tick.h"
#include "Vcan_rn_tick___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kClocksPerMs = 8000;  // the parameter's default

class CanRnTick : public testing::Test {
 protected:
  CanRnTick() { tick_.reset(); }
  /// Clocks until the next pulse ends; 0 if there is none within 1,000,000.
  unsigned to_pulse() {
    for (unsigned clocks = 1; clocks <= 1'000'000; ++clocks) {
      const bool last = tick_->ms_o != 0;
      tick_.clock();
      if (last) return clocks;
    }
    return 0;
  }
  LeafModel<Vcan_rn_tick> tick_;
};

TEST_F(CanRnTick, EveryMillisecondHasItsClocks) {
  const unsigned first = to_pulse();
  EXPECT_GE(first, kClocksPerMs - 1);  // a clock may be part of the reset
  EXPECT_LE(first, kClocksPerMs);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(to_pulse(), kClocksPerMs);
}

// An upset may lead to any state, that of all zeros included, which may end a millisecond at once;
// the time goes on, after one that lasts no longer than all states.
TEST_F(CanRnTick, NoStateStopsTheTime) {
  for (unsigned bit = 0; bit < 18; ++bit) {
    auto &state = tick_.root().can_rn_tick__DOT__state_q;
    state = bit == 17 ? 0 : state ^ 1U << bit;
    tick_.settle();
    for (int i = 0; i < 2; ++i) {
      const unsigned clocks = to_pulse();
      EXPECT_GE(clocks, 1U) << bit;
      EXPECT_LE(clocks, 131'071U) << bit;
    }
    EXPECT_EQ(to_pulse(), kClocksPerMs) << bit;
  }
}

}  // namespace
}  // namespace vericansim
