// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_status alone (flexcan.md 1.7): ESR2 where things meet in one clock.
#include <gtest/gtest.h>

#include "Vcan_mb_status.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kVps = 2, kImb = 1;

class MbStatus : public ::testing::Test {
 protected:
  MbStatus() { status_.reset(); }
  void see(unsigned idx, bool free, bool worst) {
    status_->seen_i = 1;
    status_->seen_idx_i = idx;
    status_->seen_free_i = free;
    status_->seen_worst_i = worst;
  }
  unsigned clock() {
    status_.settle();
    status_.clock();
    status_->seen_i = status_->sent_i = status_->pass_end_i = 0;
    status_.settle();
    return status_->esr2_o;
  }
  static unsigned esr2(unsigned lptm, unsigned bits) { return (lptm << 2) | bits; }
  LeafModel<Vcan_mb_status> status_;
};

TEST_F(MbStatus, FrameThatEndsFillsInWhereNothingIsFree) {  // FX-ESR2.LPTM, FX-ESR2.IMB
  see(0, false, true);
  EXPECT_EQ(clock(), esr2(0, 0));
  status_->cur_idx_i = 9;
  status_->sent_i = 1;
  EXPECT_EQ(clock(), esr2(9, kVps | kImb));
}

// A pass is under way when a frame ends: it begins anew, and finds the lowest inactive buffer.
TEST_F(MbStatus, FrameThatEndsInAPassIsLeftToIt) {  // FX-ESR2.LPTM, FX-ESR2.VPS
  status_->pass_i = 1;
  see(0, false, true);
  clock();
  status_->cur_idx_i = 9;
  status_->sent_i = 1;
  EXPECT_EQ(clock(), esr2(0, 0));
  see(3, true, false);
  status_->sent_i = 1;
  EXPECT_EQ(clock(), esr2(3, kImb));
  see(9, true, false);
  EXPECT_EQ(clock(), esr2(3, kImb));
  status_->pass_end_i = 1;
  EXPECT_EQ(clock(), esr2(3, kVps | kImb));
}

// From the moment a pass is wanted until it has ended there is no result.
TEST_F(MbStatus, ResultIsThereWithTheEndOfThePass) {  // FX-ESR2.VPS
  status_->pass_i = 1;
  see(0, false, true);
  EXPECT_EQ(clock(), esr2(0, 0));
  see(1, false, true);
  status_->pass_end_i = 1;
  EXPECT_EQ(clock(), esr2(1, kVps));
  status_->pass_i = 0;
  EXPECT_EQ(clock(), esr2(1, kVps));
  status_->pass_i = 1;
  EXPECT_EQ(clock(), esr2(1, 0));
}

TEST_F(MbStatus, PassForgetsTheOneBefore) {  // FX-ESR2.LPTM
  see(5, true, false);
  EXPECT_EQ(clock() >> 2, 5u);
  see(0, false, false);
  EXPECT_EQ(clock(), esr2(0, 0));
}

// Buffer 0 counts like any other, although a lower inactive one was known before: none is lower.
TEST_F(MbStatus, FirstBufferCountsInEveryPass) {  // FX-ESR2.IMB, FX-ESR2.LPTM
  see(5, true, false);
  clock();
  see(0, true, false);
  EXPECT_EQ(clock(), esr2(0, kImb));
  see(0, false, true);
  clock();
  see(1, false, false);  // would be sent before buffer 0
  EXPECT_EQ(clock(), esr2(0, 0));
}

}  // namespace
}  // namespace vericansim
