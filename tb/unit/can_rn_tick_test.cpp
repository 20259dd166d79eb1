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
  CanRnTick() {
    tick_->kick_i = 1;  // off the bus
    tick_.reset();
  }
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

// However long the node was off the bus: the first millisecond may be short, but is not long.
TEST_F(CanRnTick, EveryMillisecondHasItsClocks) {
  for (const unsigned off : {1U, 17U, 100U, 4096U, 4200U, 12'345U}) {
    SCOPED_TRACE(off);
    tick_->kick_i = 1;
    for (unsigned i = 0; i < off; ++i) tick_.clock();
    tick_->kick_i = 0;
    tick_.settle();
    EXPECT_LE(to_pulse(), kClocksPerMs);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(to_pulse(), kClocksPerMs);
  }
}

// An upset may lead to any state, that of all zeros included; after RESTART the time goes on.
TEST_F(CanRnTick, NoStateLastsBeyondARestart) {
  for (unsigned bit = 0; bit < 17; ++bit) {
    auto &state = tick_.root().can_rn_tick__DOT__state_q;
    state = bit == 0 ? 0 : state ^ 1U << bit;
    tick_->kick_i = 1;
    tick_.clock();
    tick_->kick_i = 0;
    tick_.settle();
    EXPECT_NE(to_pulse(), 0U) << bit;
    EXPECT_EQ(to_pulse(), kClocksPerMs) << bit;
  }
}

}  // namespace
}  // namespace vericansim
