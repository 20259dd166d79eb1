// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_cmp alone against the rules, clock by clock: TM-30, TM-31, TM-40.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "Vcan_time_cmp.h"
#include "Vcan_time_cmp___024root.h"
#include "unit/leaf_model.hpp"

// Verilator's own (5.006): evaluates all logic that is not clocked.
void Vcan_time_cmp___024root___eval_settle(Vcan_time_cmp___024root *root);

namespace vericansim {
namespace {

/// Flips a bit of the target, or behind these what is armed and the level of the pin, as upsets of
/// flip-flops do. Not in a netlist of cells, which has no variable for the target: false.
template <typename Root>
bool flip(Root *root, unsigned bit) {
  if constexpr (requires { root->can_time_cmp__DOT__target_q; }) {
    if (bit < 32)
      root->can_time_cmp__DOT__target_q ^= 1U << bit;
    else
      (bit == 32 ? root->armed_o : root->out_o) ^= 1;
    Vcan_time_cmp___024root___eval_settle(root);
    return true;
  } else {
    static_assert(!kHasRegisters<Root>, "the register has another name");
    return false;
  }
}

/// What is given in one clock; `now` is TIME[31:0] of the clock.
struct Inputs {
  std::uint32_t now = 0, data = 0, period = 0, launch = 0;
  bool enable = false, arm = false, hold = false, release = false;
};

/// "At most 2^31 ns ago": the difference of two words, signed.
bool reached(std::uint32_t now, std::uint32_t time) {
  return static_cast<std::int32_t>(now - time) >= 0;
}

/// Both events as the rules tell them. A target counts from the second clock behind its change on,
/// TTX from the first (TM-18: what is compared is registered).
class EventModel {
 public:
  bool armed = false, out = false, match = false, held = false, launched = false;

  void clock(const Inputs &in) {
    match = armed && in.enable && !fresh_ && reached(in.now, target_);
    launched = held && reached(in.now, launch_);
    fresh_ = in.arm || match;
    if (in.arm) {
      target_ = in.data;
      armed = in.enable;
      if (in.enable) out = false;
    } else {
      if (match) {
        target_ += in.period;
        out = in.period == 0 || !out;
      }
      armed = armed && in.enable && !(match && in.period == 0);
    }
    held = in.hold || (held && !launched && !in.release);
    launch_ = in.launch;
  }

 private:
  bool fresh_ = true;
  std::uint32_t target_ = 0, launch_ = 0;
};

/// The module and the model side by side.
class CanTimeCmp : public testing::Test {
 protected:
  void SetUp() override {
    rtl_.reset();
    for (unsigned i = 0; i < 4; ++i) clock();  // nothing is armed; what is compared is known then
  }
  /// One clock; TIME grows by `step` behind it.
  void clock(std::uint32_t step = 20) {
    rtl_->lo_i = in_.now + step;  // of the next clock
    rtl_->data_i = in_.data;
    rtl_->period_i = in_.period;
    rtl_->launch_i = in_.launch;
    rtl_->enable_i = in_.enable;
    rtl_->arm_i = in_.arm;
    rtl_->hold_i = in_.hold;
    rtl_->release_i = in_.release;
    rtl_.clock();
    model_.clock(in_);
    wrong_ += rtl_->armed_o != model_.armed || rtl_->out_o != model_.out ||
                      rtl_->match_o != model_.match || rtl_->held_o != model_.held ||
                      rtl_->launch_o != model_.launched
                  ? 1
                  : 0;
    alarms_ += rtl_->upset_o;
    matches_ += model_.match ? 1 : 0;
    launches_ += model_.launched ? 1 : 0;
    in_.arm = in_.hold = in_.release = false;
    in_.now += step;
  }
  /// A time near to TIME, or a power of two before or behind it.
  std::uint32_t some_time() {
    const std::uint32_t near = in_.now + static_cast<std::uint32_t>(random_() % 800);
    if (random_() % 3 != 0) return near;
    const std::uint32_t far = 1U << (8 + random_() % 24);
    return random_() % 2 == 0 ? near + far - 400 : near - far;
  }
  void command() {
    in_.data = static_cast<std::uint32_t>(random_());
    switch (random_() % 8) {
      case 0: in_.enable = random_() % 4 != 0; break;
      case 1:
        in_.period = random_() % 2 == 0 ? 0 : static_cast<std::uint32_t>(random_() % 900);
        break;
      case 2: in_.launch = some_time(); break;
      case 3: in_.release = true; break;
      case 4:
      case 5:
        in_.hold = true;
        in_.launch = some_time();
        break;
      default:
        in_.arm = true;
        in_.data = some_time();
        break;
    }
  }

  LeafModel<Vcan_time_cmp> rtl_;
  EventModel model_;
  Inputs in_;
  std::mt19937 random_{30};
  unsigned wrong_ = 0, matches_ = 0, launches_ = 0, alarms_ = 0;
};

// TM-30, TM-31, TM-40: random commands, targets and launch times up to 2^31 ns before and behind
// TIME, which runs, jumps and stands.
TEST_F(CanTimeCmp, AgainstTheRules) {
  for (unsigned i = 0; i < 400000; ++i) {
    const unsigned every = (i >> 12) % 3 == 0 ? 2 : 30;
    if (random_() % every == 0) command();
    std::uint32_t step = 20;
    if (random_() % 500 == 0) step = static_cast<std::uint32_t>(random_());
    if (random_() % 50 == 0) step = 0;
    clock(step);
    ASSERT_EQ(wrong_, 0u) << i;
  }
  EXPECT_EQ(alarms_, 0u) << "told of an upset that was none";
  EXPECT_GT(matches_, 5000u);
  EXPECT_GT(launches_, 2000u);
}

// TM-141: each bit that the events to come depend on, flipped in every clock of a period: told at
// once, whatever fires meanwhile, until it is armed anew; but for the clock behind an event, in
// which the parity is taken.
TEST_F(CanTimeCmp, TellsOfAnUpset) {
  const auto arm = [this] {
    in_.enable = in_.arm = true;
    in_.data = in_.now + 1000;
    in_.period = 1000;
    clock();
  };
  constexpr unsigned kPeriod = 50;  // clocks
  for (unsigned bit = 0; bit < 34; ++bit) {
    unsigned told = 0;
    for (unsigned wait = 0; wait < kPeriod; ++wait) {
      SCOPED_TRACE(testing::Message() << bit << ' ' << wait);
      arm();
      for (unsigned i = 0; i < 4 * kPeriod + wait; ++i) clock();
      ASSERT_EQ(alarms_, 0u);
      if (!flip(&rtl_.root(), bit)) GTEST_SKIP();
      clock();
      const bool upset = rtl_->upset_o != 0;
      told += upset ? 1 : 0;
      for (unsigned i = 0; i < 6 * kPeriod; ++i) {
        clock();
        ASSERT_EQ(rtl_->upset_o != 0, upset) << i;
      }
      arm();
      EXPECT_FALSE(rtl_->upset_o);
      alarms_ = 0;
    }
    EXPECT_EQ(told, kPeriod - 1) << bit;
  }
}

// TM-03: a hard reset leaves nothing armed, held or set, amid both events.
TEST_F(CanTimeCmp, HardReset) {
  for (unsigned i = 0; i < 300; ++i) {
    in_.enable = in_.arm = in_.hold = true;
    in_.data = in_.launch = in_.now + 60;
    in_.period = 400;
    for (unsigned n = 0; n < i % 9; ++n) clock();
    rtl_->arm_i = rtl_->hold_i = 0;
    rtl_.reset();
    EXPECT_FALSE(rtl_->armed_o || rtl_->out_o || rtl_->match_o || rtl_->held_o || rtl_->launch_o);
    model_ = {};
    in_ = {.now = in_.now};
    for (unsigned n = 0; n < 20; ++n) clock();
  }
  EXPECT_EQ(wrong_, 0u);
}

}  // namespace
}  // namespace vericansim
