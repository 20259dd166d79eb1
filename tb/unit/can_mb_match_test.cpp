// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_match alone: when its result is one.
#include <gtest/gtest.h>

#include "Vcan_mb_match.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class MbMatch : public ::testing::Test {
 protected:
  MbMatch() {
    match_->fen_i = 1;
    match_->msg_i = match_->cs_i = match_->data_i = match_->mask_i = ~0u;  // no element fits
    match_.reset();
  }
  void clock(bool grant) {
    match_.settle();
    match_->gnt_i = grant && match_->req_o != 0;
    match_.settle();
    match_.clock();
    match_->rx_hdr_i = match_->gnt_i = 0;
    match_.settle();
  }
  LeafModel<Vcan_mb_match> match_;
};

// All of the table first, however long its slots take.
TEST_F(MbMatch, IsDoneWhenTheLastWordHasBeenCompared) {  // FX-4.a, FX-4.k
  for (const unsigned first : {8u, 38u}) {
    match_->first_i = first;
    match_->maxmb_i = 63;
    match_->rx_hdr_i = 1;
    clock(false);
    const unsigned slots = 8 + 64 - first;
    unsigned granted = 0;
    for (unsigned i = 0; granted < slots; ++i) {
      ASSERT_FALSE(match_->done_o) << granted << " of " << slots;
      // Word 0 of a buffer in the table is in the C/S memory (flexcan.md section 4).
      if (match_->req_o != 0) {
        EXPECT_EQ(match_->cs_o != 0, granted < 8 && granted % 4 == 0) << granted;
      }
      granted += i % 3 == 0 && match_->req_o != 0;
      clock(i % 3 == 0);
      ASSERT_LT(i, 1000u);
    }
    for (unsigned i = 0; i < 4; ++i) clock(true);
    EXPECT_TRUE(match_->done_o);
    EXPECT_FALSE(match_->hit_o);
  }
}

// In a core of 16 or 32 buffers the table can reach the last one. That there is no mailbox to look
// at is no result before the last word, which may be the one that fits.
TEST_F(MbMatch, IsNotDoneBeforeTheTableBecauseThereAreNoMailboxes) {  // FX-4.a, FX-4.k
  for (const bool fits : {false, true}) {
    match_.reset();
    match_->first_i = 64;
    match_->maxmb_i = 63;
    match_->rx_hdr_i = 1;
    match_->msg_i = match_->cs_i = match_->data_i = ~0u;
    clock(false);
    for (unsigned granted = 0; granted < 8; ++granted) {
      for (unsigned wait = 0; wait < 3; ++wait, clock(false)) ASSERT_FALSE(match_->done_o);
      ASSERT_TRUE(match_->req_o);
      clock(true);
    }
    if (fits) match_->msg_i = match_->cs_i = match_->data_i = 0;
    for (unsigned i = 0; i < 4; ++i) clock(false);
    EXPECT_TRUE(match_->done_o);
    EXPECT_EQ(match_->hit_o != 0, fits);
    EXPECT_EQ(match_->hit_fifo_o != 0, fits);
    match_->first_i = 38;
    clock(false);
  }
}

// A soft reset or a change of FEN ends the search, in the table or in the mailboxes behind it.
TEST_F(MbMatch, ClearEndsTheSearch) {  // FX-2.3.b, FX-MCR.FEN
  for (unsigned granted = 0; granted < 40; granted += 3) {
    SCOPED_TRACE(granted);
    match_.reset();
    match_->first_i = 8;
    match_->maxmb_i = 63;
    match_->rx_hdr_i = 1;
    clock(false);
    for (unsigned i = 0; i < granted; ++i) clock(true);
    ASSERT_FALSE(match_->done_o);
    match_->clear_i = 1;
    clock(false);
    match_->clear_i = 0;
    for (unsigned i = 0; i < 100; ++i) {
      clock(true);
      ASSERT_FALSE(match_->req_o || match_->hit_o) << i;
    }
  }
}

TEST_F(MbMatch, EndsIfTheFifoLeavesNoMailbox) {  // FX-4.a, FX-MCR.MAXMB
  match_->first_i = 38;
  match_->maxmb_i = 37;
  match_->rx_hdr_i = 1;
  for (unsigned i = 0; i < 8 + 64 - 38 + 6; ++i) clock(true);
  EXPECT_TRUE(match_->done_o);
  EXPECT_FALSE(match_->hit_o);
}

}  // namespace
}  // namespace vericansim
