// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tick alone: a pulse each millisecond, by which RN-54, RN-70 and RN-72 count.
#include <gtest/gtest.h>

#include "Vcan_rn_tick.h"
#include "Vcan_rn_tick_100000.h"
#include "Vcan_rn_tick_100000___024root.h"
#include "Vcan_rn_tick_131071.h"
#include "Vcan_rn_tick_131071___024root.h"
#include "Vcan_rn_tick_16383.h"
#include "Vcan_rn_tick_16383___024root.h"
#include "Vcan_rn_tick_25000.h"
#include "Vcan_rn_tick_25000___024root.h"
#include "Vcan_rn_tick_48000.h"
#include "Vcan_rn_tick_48000___024root.h"
#include "Vcan_rn_tick_8192.h"
#include "Vcan_rn_tick_8192___024root.h"
#include "Vcan_rn_tick___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

/// A model, its flip-flops and its parameter.
template <typename M, unsigned kBitsOfIt, unsigned kClocks>
struct Tick {
  using Model = M;
  static constexpr unsigned kBits = kBitsOfIt;
  static constexpr unsigned kClocksPerMs = kClocks;
};
/// Each number of flip-flops; 16,383 and 131,071 are all states of theirs.
using Ticks =
    testing::Types<Tick<Vcan_rn_tick, 13, 8'000>, Tick<Vcan_rn_tick_8192, 14, 8'192>,
                   Tick<Vcan_rn_tick_16383, 14, 16'383>, Tick<Vcan_rn_tick_25000, 15, 25'000>,
                   Tick<Vcan_rn_tick_48000, 16, 48'000>, Tick<Vcan_rn_tick_100000, 17, 100'000>,
                   Tick<Vcan_rn_tick_131071, 17, 131'071>>;

/// The shift register; its name begins with that of the module, not of the model. A netlist of
/// cells has no variable for it: nullptr.
template <typename Root>
auto *state_of(Root &root) {
  if constexpr (requires { root.can_rn_tick__DOT__state_q; }) {
    return &root.can_rn_tick__DOT__state_q;
  } else {
    static_assert(!kHasRegisters<Root>, "the register has another name");
    return static_cast<std::uint32_t *>(nullptr);
  }
}

template <typename T>
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
  LeafModel<typename T::Model> tick_;
};
TYPED_TEST_SUITE(CanRnTick, Ticks);

TYPED_TEST(CanRnTick, EveryMillisecondHasItsClocks) {
  const unsigned first = this->to_pulse();
  EXPECT_GE(first, TypeParam::kClocksPerMs - 1);  // a clock may be part of the reset
  EXPECT_LE(first, TypeParam::kClocksPerMs);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(this->to_pulse(), TypeParam::kClocksPerMs);
}

// An upset may lead to any state, that of all zeros included, which may end a millisecond at once;
// the time goes on, after one that lasts no longer than all states.
TYPED_TEST(CanRnTick, NoStateStopsTheTime) {
  constexpr unsigned kStates = (1U << TypeParam::kBits) - 1;
  auto *state = state_of(this->tick_.root());
  if (state == nullptr) GTEST_SKIP();
  for (unsigned bit = 0; bit <= TypeParam::kBits; ++bit) {
    *state = bit == TypeParam::kBits ? 0 : *state ^ 1U << bit;
    this->tick_.settle();
    for (int i = 0; i < 2; ++i) {
      const unsigned clocks = this->to_pulse();
      EXPECT_GE(clocks, 1U) << bit;
      EXPECT_LE(clocks, kStates) << bit;
    }
    EXPECT_EQ(this->to_pulse(), TypeParam::kClocksPerMs) << bit;
  }
}

}  // namespace
}  // namespace vericansim
