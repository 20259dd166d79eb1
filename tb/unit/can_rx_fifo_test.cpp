// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rx_fifo: fill, rows, flags and the choice between FIFO and mailbox against a queue
// (flexcan.md section 4).
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "Vcan_rx_fifo.h"
#include "Vcan_rx_fifo___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kDepth = 6;

class RxFifoRing : public ::testing::Test {
 protected:
  RxFifoRing() { top_.reset(); }

  /// One clock; the combinational outputs in it are left in the members. Beside the block, a frame
  /// is on its way from the clock after it was taken to that after it was stored.
  void clock(bool pop, bool resolve, bool stored) {
    top_->fifo_in_flight_i = way_;
    top_->pop_i = pop;
    top_->resolve_i = resolve;
    top_->stored_i = stored;
    top_.settle();
    take_ = top_->take_o;
    warn_ = top_->warn_o;
    ovf_ = top_->ovf_o;
    head_ = top_->head_o;
    tail_ = top_->tail_o;
    if (resolve && take_) way_ = 1;
    if (stored || top_->clear_i) way_ = 0;
    top_.clock();
    top_->fifo_in_flight_i = way_;
    top_.settle();
  }

  bool take_ = false, warn_ = false, ovf_ = false;
  unsigned head_ = 0, tail_ = 0, way_ = 0;
  std::mt19937 rng_{9};
  LeafModel<Vcan_rx_fifo> top_;
};

TEST_F(RxFifoRing, IsAQueueOfSix) {  // FX-4.b, FX-4.m, FX-4.n, FX-4.o, FX-4.p
  std::deque<unsigned> rows;
  bool moving = false;
  unsigned moving_row = 0, idhit = 0, warnings = 0, losses = 0;
  top_->filter_i = 1;
  for (unsigned i = 0; i < 200000; ++i) {
    const unsigned mood = (i / 500) % 3;  // fills, drains, both
    const bool pop = rng_() % (mood == 0 ? 9 : mood == 1 ? 2 : 4) == 0;
    const bool stored = moving && rng_() % 2 == 0;
    const bool resolve = !moving && rng_() % 3 == 0;
    const std::size_t fill = rows.size();
    ASSERT_EQ(top_->avail_o != 0, fill != 0);
    top_->idhit_i = rng_() % 512;
    const bool popped = pop && fill != 0;
    clock(pop, resolve, stored);
    if (fill != 0) {
      ASSERT_EQ(head_, rows.front());
    }
    if (popped) rows.pop_front();
    ASSERT_EQ(warn_, stored && fill == 4 && !popped);
    ASSERT_EQ(ovf_, resolve && fill == kDepth);
    warnings += warn_;
    losses += ovf_;
    if (stored) {
      rows.push_back(moving_row);
      moving = false;
    }
    if (resolve) {
      ASSERT_EQ(take_, fill < kDepth);
      if (!take_) continue;
      moving = true;
      moving_row = tail_;
      idhit = top_->idhit_i;
      ASSERT_LT(tail_, kDepth);
      for (unsigned row : rows) ASSERT_NE(row, tail_) << "a row in use is written";
    }
    if (moving) {
      ASSERT_EQ(top_->idhit_o, idhit);
    }
  }
  EXPECT_GT(warnings, 100u);
  EXPECT_GT(losses, 100u);
}

TEST_F(RxFifoRing, ClearEmptiesIt) {  // FX-MCR.FEN
  top_->filter_i = 1;
  for (unsigned i = 0; i < 4; ++i) {
    clock(false, true, false);
    clock(false, false, true);
  }
  clock(true, false, false);
  EXPECT_TRUE(top_->avail_o);
  top_->clear_i = 1;
  clock(true, true, true);
  top_->clear_i = 0;
  top_.settle();
  EXPECT_FALSE(top_->avail_o);
  for (unsigned i = 0; i < kDepth; ++i) {
    clock(false, true, false);
    EXPECT_TRUE(take_);
    clock(false, false, true);
  }
  clock(false, true, false);
  EXPECT_TRUE(ovf_);
}

// A frame that is taken and, by an upset flip-flop, never stored: what comes later is found where
// it was put, and there is room for as many as before.
TEST_F(RxFifoRing, LostFrameDoesNotShiftTheRing) {  // FX-4.b
  top_->filter_i = 1;
  for (unsigned lost = 0; lost < 2 * kDepth + 1; ++lost) {
    clock(false, true, false);
    way_ = 0;
    clock(false, false, false);
    std::deque<unsigned> rows;
    for (unsigned i = 0; i < kDepth; ++i) {
      clock(false, true, false);
      ASSERT_TRUE(take_) << i;
      rows.push_back(tail_);
      clock(false, false, true);
    }
    for (; !rows.empty(); rows.pop_front()) {
      clock(false, false, false);
      ASSERT_TRUE(top_->avail_o);
      ASSERT_EQ(head_, rows.front());
      clock(true, false, false);
    }
    ASSERT_FALSE(top_->avail_o);
  }
}

// The element belongs to the frame that was taken, until that is stored.
TEST_F(RxFifoRing, ElementOfATakenFrameStays) {  // FX-RXFIR.IDHIT
  top_->filter_i = 1;
  top_->idhit_i = 5;
  clock(false, true, false);
  ASSERT_TRUE(take_);
  top_->filter_i = 0;
  top_->idhit_i = 9;
  clock(false, true, false);
  ASSERT_FALSE(take_);
  for (unsigned i = 0; i < 5; ++i) {
    EXPECT_EQ(top_->idhit_o, 5);
    clock(false, false, false);
  }
}

TEST_F(RxFifoRing, IsEmptyAfterAHardReset) {  // FX-4.b
  top_->filter_i = 1;
  for (unsigned i = 0; i < 4; ++i) {
    clock(false, true, false);
    clock(false, false, true);
  }
  EXPECT_TRUE(top_->avail_o);
  top_->rst_ni = 0;
  top_.settle();
  EXPECT_FALSE(top_->avail_o);
  EXPECT_EQ(top_->head_o, 0);
}

// No search of the mailboxes: an element fits, there is room and the FIFO comes first.
TEST_F(RxFifoRing, MailboxesAreSearchedIfTheyCouldGetTheFrame) {  // FX-4.k, FX-4.l
  for (bool mrp : {false, true}) {
    top_.reset();
    top_->mrp_i = mrp;
    for (unsigned fill = 0; fill <= kDepth; ++fill) {
      for (bool fits : {false, true}) {
        top_->rx_hdr_i = 1;
        top_->filter_i = 0;
        clock(false, false, false);
        top_->rx_hdr_i = 0;
        EXPECT_FALSE(top_->enough_o);
        top_->filter_i = fits;
        clock(false, false, false);
        EXPECT_EQ(top_->enough_o != 0, fits && !mrp && fill < kDepth) << fill;
      }
      clock(false, true, false);
      if (take_) clock(false, false, true);
    }
  }
}

// A frame that is taken and not stored yet has its place. With it the FIFO may be full, so that a
// mailbox could get the next frame; while there is room, the FIFO gets that one, too.
TEST_F(RxFifoRing, FrameOnItsWayHasItsPlace) {  // FX-4.b, FX-4.k
  top_->filter_i = 1;
  for (const unsigned way : {1u, 2u}) {
    for (unsigned fill = 0; fill < kDepth; ++fill) {
      top_.reset();
      for (unsigned i = 0; i < fill; ++i) {
        clock(false, true, false);
        clock(false, false, true);
      }
      clock(false, true, false);
      ASSERT_TRUE(take_) << fill;
      way_ = way;
      top_->rx_hdr_i = 1;
      clock(false, false, false);
      top_->rx_hdr_i = 0;
      clock(false, false, false);
      EXPECT_EQ(top_->enough_o != 0, fill + 1 < kDepth) << fill;
      way_ = 0;
      clock(false, false, false);
    }
  }
}

}  // namespace
}  // namespace vericansim
