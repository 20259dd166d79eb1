// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time: readings and captures of one clock each, compare and launch in their clocks: TM-11,
// TM-20, TM-30, TM-31, TM-40.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "Vcan_time.h"
#include "Vcan_time___024root.h"
#include "model/time_model.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

// Bits of cmd_i and stat_o (rtl/can_pkg.sv), fields of TCTRL.
constexpr unsigned kSet = 1 << 0, kArm = 1 << 4, kHold = 1 << 5, kRelease = 1 << 6, kExt = 1 << 7,
                   kRead = 1 << 8;
constexpr unsigned kHeld = 1 << 1, kOut = 1 << 2, kArmed = 1 << 3, kMatch = 1 << 4,
                   kLaunch = 1 << 6;
constexpr std::uint32_t kCmpen = 1 << 13;
constexpr std::uint64_t kStep = 20;  // ns a clock

/// 20 ns a clock; TIME by the model.
class CanTimeUnit : public testing::Test {
 protected:
  void SetUp() override {
    unit_.reset();  // one edge behind it
    time_.clock();
    unit_->rx_i = unit_->tx_i = 1;
  }
  /// One clock with these commands; returns TIME of that clock.
  std::uint64_t clock(unsigned cmd = 0, std::uint64_t data = 0) {
    unit_->cmd_i = static_cast<std::uint16_t>(cmd);
    unit_->data_i = data;
    unit_.clock();
    unit_->cmd_i = 0;
    const std::uint64_t now = time_.time();
    time_.clock(pending_[2]);
    pending_ = {(cmd & kSet) != 0 ? TimeCommand{.kind = TimeCommand::Kind::kSet, .ns = data}
                                  : TimeCommand{},
                pending_[0], pending_[1]};
    return now;
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  LeafModel<Vcan_time> unit_;
  TimeModel time_{20, 0};
  std::array<TimeCommand, 3> pending_{};
};

// TM-11, TM-20: around every carry out of bits 7, 15 and 31, at every phase: no tear.
TEST_F(CanTimeUnit, SnapshotAtEveryCarry) {
  for (const unsigned bit : {8u, 16u, 32u, 33u, 63u}) {
    for (unsigned phase = 0; phase < 24; ++phase) {
      clock(kSet, (1ULL << bit) - 200);
      clocks(phase);
      const std::uint64_t at = clock(kRead | kExt);
      clocks(2);
      EXPECT_EQ(unit_->now_o, at) << bit << ' ' << phase;
      EXPECT_EQ(unit_->ext_o, at) << bit << ' ' << phase;
      clocks(10);
      EXPECT_EQ(unit_->now_o, at);
    }
  }
}

// TM-30: it fires in the first clock in which TIME has reached the target, once.
TEST_F(CanTimeUnit, CompareFirstClock) {
  unit_->tctrl_i = kCmpen;
  for (unsigned phase = 0; phase < 20; ++phase) {
    clocks(7);
    const std::uint64_t target = time_.time() + 1000 + phase;
    clock(kArm, target << 32);
    EXPECT_EQ(unit_->stat_o & (kArmed | kOut), kArmed);
    unsigned matches = 0;
    for (unsigned i = 0; i < 100; ++i) {
      const std::uint64_t now = time_.time();
      if ((unit_->stat_o & kMatch) != 0) {
        ++matches;
        EXPECT_GE(now - kStep, target);  // told in the clock after
        EXPECT_LT(now - kStep, target + kStep);
      }
      clock();
    }
    EXPECT_EQ(matches, 1u);
    EXPECT_EQ(unit_->stat_o & (kArmed | kOut), kOut);
  }
}

// TM-31: periods; over the wrap of the lower half; CMPEN = 0 disarms.
TEST_F(CanTimeUnit, ComparePeriodic) {
  unit_->tctrl_i = kCmpen;
  unit_->tcmph_i = 330;
  clock(kSet, (1ULL << 32) - 2000);
  clocks(5);
  clock(kArm, ((1ULL << 32) - 1500) << 32);
  std::vector<std::uint64_t> fired;
  for (unsigned i = 0; i < 200; ++i) {
    if ((unit_->stat_o & kMatch) != 0) fired.push_back(time_.time() - kStep);
    clock();
  }
  ASSERT_GE(fired.size(), 6u);
  for (std::size_t i = 0; i < fired.size(); ++i) {
    const std::uint64_t target = (1ULL << 32) - 1500 + i * 330;
    EXPECT_GE(fired[i], target);
    EXPECT_LT(fired[i], target + 20);
  }
  unit_->tctrl_i = 0;
  clock();
  EXPECT_EQ(unit_->stat_o & kArmed, 0u);
}

// TM-31: after a jump forward the events catch up, at most 16 clocks apart; after one back they
// wait.
TEST_F(CanTimeUnit, CompareAfterShift) {
  unit_->tctrl_i = kCmpen;
  unit_->tcmph_i = 400;
  clock(kArm, (time_.time() + 400) << 32);
  const std::uint64_t jumped = time_.time() + 4000;
  clock(kSet, jumped);
  clocks(3);
  unsigned matches = 0, since = 0;
  while (matches < 10) {
    ++since;
    ASSERT_LE(since, 16u);
    if ((unit_->stat_o & kMatch) != 0) {
      ++matches;
      since = 0;
    }
    clock();
  }
  clock(kSet, 100);
  clocks(3);
  for (unsigned i = 0; i < 100; ++i) {
    EXPECT_EQ(unit_->stat_o & kMatch, 0u);
    clock();
  }
}

// TM-40: HOLD clears in the first clock at or behind T0; at once if that is past; the CPU may, too.
TEST_F(CanTimeUnit, LaunchInItsClock) {
  for (unsigned phase = 0; phase < 20; ++phase) {
    const std::uint64_t t0 = time_.time() + 500 + phase;
    unit_->ttx_i = static_cast<std::uint32_t>(t0);
    clock(kHold);
    unsigned launches = 0;
    for (unsigned i = 0; i < 60; ++i) {
      const std::uint64_t now = time_.time();
      EXPECT_EQ((unit_->stat_o & kHeld) != 0, now < t0 + kStep && launches == 0);
      if ((unit_->stat_o & kLaunch) != 0) {
        ++launches;
        EXPECT_GE(now - kStep, t0);
        EXPECT_LT(now - kStep, t0 + kStep);
      }
      clock();
    }
    EXPECT_EQ(launches, 1u);
  }
  clock(kHold);
  clocks(2);
  EXPECT_EQ(unit_->stat_o & kHeld, 0u);
  unit_->ttx_i = static_cast<std::uint32_t>(time_.time() + 100000);
  clock(kHold);
  clocks(10);
  EXPECT_NE(unit_->stat_o & kHeld, 0u);
  clock(kRelease);
  EXPECT_EQ(unit_->stat_o & kHeld, 0u);
}

// TM-40: TTX is ahead of TIME, or behind it, by up to half of the lower word's range.
TEST_F(CanTimeUnit, LaunchFarAheadAndFarBehind) {
  constexpr std::uint32_t kHalf = 1U << 31, kFar = kHalf - 4000;
  for (const std::uint32_t ahead : {1U << 29, 1U << 30, 3U << 29, kFar}) {
    const auto now = static_cast<std::uint32_t>(time_.time());
    unit_->ttx_i = now + ahead;
    clock(kHold);
    clocks(50);
    EXPECT_NE(unit_->stat_o & kHeld, 0u) << ahead;
    clock(kRelease);
    unit_->ttx_i = now - ahead;
    clock(kHold);
    clocks(2);
    EXPECT_EQ(unit_->stat_o & kHeld, 0u) << ahead;
  }
}

// TM-03, TM-11: TIME is 0 in the reset, and what is read of its last clock tears nothing.
TEST_F(CanTimeUnit, SnapshotOfTheReset) {
  unit_->cmd_i = static_cast<std::uint16_t>(kRead | kExt);
  unit_.reset();
  EXPECT_EQ(unit_->now_o, 0u);
  EXPECT_EQ(unit_->ext_o, 0u);
}

// TM-24: the stamp at SOF is the edge before its sample point, not one in the clock in which that
// is told, nor any later one of the frame.
TEST_F(CanTimeUnit, StampOfSofIsTheEdgeBefore) {
  const auto fall = [this](bool told) {
    unit_->rx_i = 1;
    clocks(2);
    unit_->rx_i = 0;
    unit_->sof_i = told;
    const std::uint64_t now = clock();
    unit_->sof_i = 0;
    return now;
  };
  const std::uint64_t edge = fall(false);
  EXPECT_EQ(unit_->stamp_o, edge);
  unit_->field_i = 0x09;  // can_pkg::FldId
  fall(true);
  EXPECT_EQ(unit_->stamp_o, edge);
  fall(false);
  EXPECT_EQ(unit_->stamp_o, edge);
}

}  // namespace
}  // namespace vericansim
