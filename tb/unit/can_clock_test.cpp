// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_clock alone against the rule, clock by clock: TM-10, TM-12 to TM-17.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

#include "Vcan_clock.h"
#include "Vcan_clock___024root.h"
#include "model/time_model.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

using Kind = TimeCommand::Kind;

/// The module and the model side by side.
class CanClock : public testing::Test {
 protected:
  CanClock() { rtl_->slewr_i = 3; }
  void SetUp() override {
    rtl_.reset();  // one edge behind it, and the lower half is a clock ahead of TIME
    model_.clock();
    model_.clock();
  }

  void slewr(unsigned value) {
    rtl_->slewr_i = static_cast<std::uint8_t>(value);
    model_.set_slewr(value);
  }

  /// One clock in which `command` is given; it acts on TIME in the second clock after (TM-16).
  void clock(const TimeCommand &command = {}) {
    rtl_->set_i = command.kind == Kind::kSet;
    rtl_->shift_i = command.kind == Kind::kShift;
    rtl_->rate_i = command.kind == Kind::kRate;
    rtl_->slew_i = command.kind == Kind::kSlew;
    rtl_->data_i = command.ns;
    if (command.kind == Kind::kRate)
      rtl_->data_i = std::uint64_t{command.inc_frac} << 32 | command.inc_ns;
    if (command.kind == Kind::kSlew)
      rtl_->data_i = std::uint64_t{static_cast<std::uint32_t>(command.slew)} << 32;
    rtl_.clock();
    const std::uint64_t before = model_.time();
    model_.clock(given_[1]);
    given_ = {command, given_[0]};
    // The upper half of this clock belongs to the lower one of the clock before (TM-18).
    wrong_ += rtl_->lo_o != static_cast<std::uint32_t>(model_.time()) ? 1 : 0;
    wrong_ += rtl_->hi_o != static_cast<std::uint32_t>(before >> 32) ? 1 : 0;
    ++clocks_;
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  static TimeCommand set(std::uint64_t ns) { return {.kind = Kind::kSet, .ns = ns}; }
  static TimeCommand shift(std::int64_t ns) {
    return {.kind = Kind::kShift, .ns = static_cast<std::uint64_t>(ns)};
  }
  static TimeCommand rate(std::uint8_t ns, std::uint32_t fraction) {
    return {.kind = Kind::kRate, .inc_ns = ns, .inc_frac = fraction};
  }
  static TimeCommand slew(std::int32_t ns) { return {.kind = Kind::kSlew, .slew = ns}; }

  LeafModel<Vcan_clock> rtl_;
  TimeModel model_{20, 0};  // the module's default, 50 MHz
  std::array<TimeCommand, 2> given_{};
  unsigned wrong_ = 0;
  std::uint64_t clocks_ = 0;
};

// TM-10, TM-16: random commands, also in consecutive clocks, and values around every carry.
TEST_F(CanClock, ModelEveryClock) {
  std::mt19937_64 random{10};
  const auto near_carry = [&random] {
    const std::uint64_t edge = random() % 3 == 0 ? 0 : 1ULL << (random() % 64);
    return edge + random() % 64 - 32;
  };
  const auto command = [&]() -> TimeCommand {
    switch (random() % 5) {
      case 0: return set(near_carry());
      case 1: return shift(static_cast<std::int64_t>(near_carry()));
      case 2:
        return rate(static_cast<std::uint8_t>(random()), static_cast<std::uint32_t>(random()));
      case 3: return slew(static_cast<std::int32_t>(random() % 64) - 32);
      default: return {};
    }
  };
  unsigned commands = 0;
  for (unsigned i = 0; i < 2000000; ++i) {
    // Long rests, short ones, and none.
    const std::uint64_t every = (i >> 14) % 3 == 0 ? 1 : (i >> 14) % 3 == 1 ? 20 : 3000;
    if (i % 50000 == 0) {  // while nothing is worked off: a change of SLEWR may bring a step
      clock(slew(0));
      clocks(6);
      slewr(random() % 4);
      clocks(6);
    }
    if (random() % every != 0) {
      clock();
      continue;
    }
    ++commands;
    clock(command());
  }
  EXPECT_EQ(wrong_, 0u);
  EXPECT_GT(commands, 500000u);
}

// TM-12: from one clock to the next TIME is what was set.
TEST_F(CanClock, SetIsAtomic) {
  clocks(10);
  clock(set(0xFFFFFFFFFFFFFFF0ULL));
  clocks(2);
  EXPECT_EQ(rtl_->lo_o, 0xFFFFFFF0u);
  clock();
  EXPECT_EQ(rtl_->hi_o, 0xFFFFFFFFu);
  EXPECT_EQ(rtl_->lo_o, 4u);  // 20 ns later, modulo 2^64
  clock();
  EXPECT_EQ(rtl_->hi_o, 0u);
  EXPECT_EQ(wrong_, 0u);
}

// TM-13: a clock that is shifted, and back, is one that was not.
TEST_F(CanClock, ShiftLosesNothing) {
  clock(rate(20, 0x80000001));
  const std::uint64_t offsets[] = {1, 0x100000000ULL, 0x7FFFFFFFFFFFFFFFULL, 0xFFFFFFF0ULL};
  std::uint64_t sum = 0;
  TimeModel plain{20, 0};
  for (unsigned i = 0; i < 4; ++i) plain.clock();
  plain.clock(rate(20, 0x80000001));
  clocks(2);
  for (unsigned i = 0; i < 4000; ++i) {
    const std::uint64_t offset = offsets[i % 4] * (i % 3 == 0 ? 1 : i);
    sum += offset;
    clock(shift(static_cast<std::int64_t>(offset)));
    plain.clock();
  }
  for (unsigned i = 0; i < 4; ++i) {
    clock();
    plain.clock();
  }
  EXPECT_EQ(rtl_->lo_o, static_cast<std::uint32_t>(plain.time() + sum));
  EXPECT_EQ(wrong_, 0u);
}

// TM-14: 0 stops the clock.
TEST_F(CanClock, RateFromOneClockOn) {
  clock(rate(0, 0));
  clocks(4);
  const std::uint32_t stopped = rtl_->lo_o;
  clocks(100);
  EXPECT_EQ(rtl_->lo_o, stopped);
  clock(rate(1, 0x40000000));
  clocks(2);
  EXPECT_EQ(rtl_->lo_o, stopped + 1u);  // the third clock after the one it was given in
  clocks(400);
  EXPECT_EQ(rtl_->lo_o, stopped + 1u + 500u);
  EXPECT_EQ(wrong_, 0u);
}

// TM-15, TM-17: steps of 1 ns, one each 1,024 to 8,192 ns, which add up; TIME never goes back.
TEST_F(CanClock, SlewIsExact) {
  for (unsigned slewr_value = 0; slewr_value < 4; ++slewr_value) {
    slewr(slewr_value);
    for (const std::int32_t value : {100, -100}) {
      const std::uint64_t start = model_.time(), begin = clocks_;
      clock(slew(value));
      std::uint32_t before = rtl_->lo_o;
      while (rtl_->left_o != 0 || clocks_ < begin + 5) {
        clock();
        ASSERT_GT(rtl_->lo_o - before, 0u);
        ASSERT_LT(rtl_->lo_o - before, 100u);
        before = rtl_->lo_o;
      }
      clocks(4);
      EXPECT_EQ(model_.time() - start, (clocks_ - begin) * 20 + static_cast<std::uint64_t>(value));
      const double took = static_cast<double>(clocks_ - begin) * 20 / 100;
      EXPECT_NEAR(took, 8192 >> slewr_value, 100);
    }
  }
  EXPECT_EQ(wrong_, 0u);
}

// TM-15: the same at both ends of its range, and where the sign is not in the bit below.
TEST_F(CanClock, SlewOfTheWholeRange) {
  slewr(3);
  constexpr std::uint32_t kValues[] = {0x40000000, 0x7FFFFFFF, 0x80000000, 0xBFFFFFFF};
  for (const std::uint32_t value : kValues) {
    clock(slew(static_cast<std::int32_t>(value)));
    clocks(1000);
    EXPECT_NE(rtl_->left_o, value);
  }
  EXPECT_EQ(wrong_, 0u);
}

// TM-15: 0 stops it, another value replaces it; with an increment below 2 ns no step is made.
TEST_F(CanClock, SlewIsReplaced) {
  clock(slew(1000));
  clocks(300);
  clock(slew(-5));
  clock();
  EXPECT_NEAR(static_cast<std::int32_t>(rtl_->left_o), -5, 1);  // a step may be due
  clock(slew(0));
  clock();
  EXPECT_EQ(rtl_->left_o, 0u);
  clock(slew(-5));
  clock(rate(1, 0));
  clocks(10);
  const std::uint32_t left = rtl_->left_o;
  EXPECT_NE(left, 0u);
  clocks(20000);
  EXPECT_EQ(rtl_->left_o, left);
  EXPECT_EQ(wrong_, 0u);
}

}  // namespace
}  // namespace vericansim
