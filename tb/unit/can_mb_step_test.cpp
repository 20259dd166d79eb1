// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_step alone: every slot has one owner, and a copy is never lost.
#include <gtest/gtest.h>

#include <string>

#include "Vcan_mb_step.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kStepWord = 0, kStepEnd = 1, kStepLow = 2, kStepHigh = 3, kStepHead = 4;

class MbStep : public ::testing::Test {
 protected:
  MbStep() {
    step_->moving_i = 1;
    step_.reset();
    step_.settle();
  }
  /// A clock in which every request is granted.
  void clock() {
    step_.settle();
    step_->slot_i = step_->req_o;
    step_.settle();
    step_.clock();
    step_.settle();
  }
  LeafModel<Vcan_mb_step> step_;
};

TEST_F(MbStep, ASlotHasOneOwner) {
  step_->rx_req_i = step_->scan_req_i = step_->slot_i = 1;
  for (const bool load : {false, true}) {
    step_->ld_req_i = load;
    step_->mv_req_i = !load;
    step_.settle();
    EXPECT_TRUE(step_->req_o);
    EXPECT_FALSE(step_->rx_gnt_o || step_->scan_gnt_o) << "the step's";
  }
  step_->ld_req_i = step_->mv_req_i = 0;
  step_.settle();
  EXPECT_TRUE(step_->rx_gnt_o);
  EXPECT_FALSE(step_->scan_gnt_o);
  step_->rx_req_i = 0;
  step_.settle();
  EXPECT_TRUE(step_->scan_gnt_o);
}

// Whoever wants a slot: without a request can_mb_port gives all of them to insertions.
TEST_F(MbStep, ASlotIsAskedForIfAnybodyWantsOne) {
  for (unsigned asks = 0; asks < 16; ++asks) {
    step_->ld_req_i = asks & 1;
    step_->rx_req_i = (asks & 2) != 0;
    step_->scan_req_i = (asks & 4) != 0;
    step_->mv_req_i = (asks & 8) != 0;
    step_.settle();
    EXPECT_EQ(step_->req_o != 0, asks != 0) << asks;
  }
}

// Only a pass for ESR2 gives way to the CPU every time.
TEST_F(MbStep, LazyIsWhatNobodyElseWaitsFor) {
  for (unsigned asks = 0; asks < 16; ++asks) {
    step_->ld_req_i = asks & 1;
    step_->rx_req_i = (asks & 2) != 0;
    step_->scan_req_i = 1;
    step_->scan_lazy_i = (asks & 4) != 0;
    step_->mv_req_i = (asks & 8) != 0;
    step_.settle();
    EXPECT_EQ(step_->lazy_o != 0, asks == 4) << asks;
  }
}

// Passes get the clocks between; they do not change whose turn it is.
TEST_F(MbStep, LoadsAndMovesTakeTurns) {
  step_->ld_req_i = step_->mv_req_i = step_->rx_req_i = 1;
  std::string order;
  for (unsigned i = 0; i < 12; ++i) {
    clock();
    if (step_->ld_data_o != 0) order += 'l';
    if (step_->mv_data_o != 0) order += 'm';
  }
  EXPECT_EQ(order, "lmlmlm");
}

TEST_F(MbStep, DataAreThereOnce) {
  for (const bool load : {false, true}) {
    step_->ld_req_i = load;
    step_->mv_req_i = !load;
    step_->ld_step_i = kStepLow;
    clock();
    step_->ld_req_i = step_->mv_req_i = 0;
    step_->rx_req_i = 1;
    step_.settle();
    EXPECT_EQ(step_->ld_data_o != 0, load);
    EXPECT_EQ(step_->mv_data_o != 0, !load);
    EXPECT_TRUE(step_->copy_o && step_->flight_o);
    clock();
    EXPECT_FALSE(step_->ld_data_o || step_->mv_data_o || step_->flight_o) << load;
  }
}

// The header is copied when its frame is presented: into the hidden word of the frame sent.
TEST_F(MbStep, OnlyCopiesTakeTheWritePort) {
  for (const unsigned step : {kStepWord, kStepEnd, kStepLow, kStepHigh, kStepHead}) {
    step_->ld_req_i = 1;
    step_->ld_step_i = step;
    step_.settle();
    if (step != kStepWord) {
      EXPECT_EQ(step_->cs_o != 0, step == kStepEnd || step == kStepHead) << step;
    }
    clock();
    step_->ld_req_i = 0;
    step_.settle();
    EXPECT_TRUE(step_->ld_data_o);
    EXPECT_EQ(step_->ld_data_step_o, step);
    EXPECT_EQ(step_->copy_o != 0, step != kStepWord) << step;
    if (step_->copy_o != 0) {
      EXPECT_EQ(step_->copy_cs_o != 0, step == kStepEnd || step == kStepHead) << step;
      EXPECT_EQ(step_->copy_be_o, step == kStepEnd ? 0b1011 : 0b1111) << step;
    }
    clock();
  }
}

// A frame being loaded and the one that is presented each have a word of their own: the copy may
// still be cancelled.
TEST_F(MbStep, HeaderGoesToItsOwnRowAndTheEndComesFromTheOther) {
  for (const unsigned row : {0u, 1u}) {
    step_->ld_req_i = 1;
    step_->ld_row_i = row;
    step_->ld_step_i = kStepEnd;
    step_.settle();
    EXPECT_EQ(step_->cs_row_o, 64 + !row);
    step_->ld_step_i = kStepHead;
    clock();
    step_->ld_req_i = 0;
    step_.settle();
    EXPECT_TRUE(step_->copy_o);
    EXPECT_FALSE(step_->copy_off_o);
    EXPECT_EQ(step_->copy_row_o, 64 + row);
    clock();
  }
}

// The end of a frame whose buffer the CPU has rewritten.
TEST_F(MbStep, EndThatIsWithdrawnIsNotWritten) {
  for (const unsigned step : {kStepLow, kStepEnd}) {
    for (const bool cancel : {false, true}) {
      step_->ld_req_i = 1;
      step_->ld_step_i = step;
      clock();
      step_->ld_req_i = 0;
      step_->ld_cancel_i = cancel;
      step_.settle();
      EXPECT_EQ(step_->copy_end_o != 0, step == kStepEnd);
      EXPECT_EQ(step_->copy_off_o != 0, step == kStepEnd && cancel);
      clock();
    }
  }
}

// What a copy writes and where: the words of a frame received, then its C/S word; of an answer the
// code alone, and bits 31:28 as they were.
TEST_F(MbStep, MovesCopyWordForWord) {  // FX-3.5.b, FX-3.7.b
  step_->mv_idx_i = 9;
  step_->mv_top_i = 0x004;  // FULL
  for (unsigned word = 0; word < 4; ++word) {
    step_->mv_req_i = 1;
    step_->mv_step_i = word;
    step_.settle();
    EXPECT_EQ(step_->cs_o != 0, word == 3);
    step_->word_i = step_->cs_o != 0 ? 0xA5123456 : 0x89ABCDEF;
    clock();
    step_->mv_req_i = 0;
    step_.settle();
    EXPECT_TRUE(step_->copy_o);
    EXPECT_EQ(step_->copy_be_o, 0b1111);
    EXPECT_EQ(step_->copy_cs_o != 0, word == 3);
    EXPECT_EQ(step_->copy_row_o, word == 3 ? 9u : word * 64 + 9);
    EXPECT_EQ(step_->copy_data_o, word == 3 ? 0x02123456u : 0x89ABCDEFu);
    step_->mv_cancel_i = 1;
    step_.settle();
    EXPECT_TRUE(step_->copy_off_o) << "rewritten by the CPU";
    step_->mv_cancel_i = 0;
    clock();
  }
  step_->mv_req_i = step_->mv_answer_i = 1;
  step_->mv_step_i = 3;
  step_->mv_top_i = 0x01C;  // 1110
  step_.settle();
  EXPECT_EQ(step_->cs_row_o, 9) << "its own word, not the hidden one";
  clock();
  EXPECT_EQ(step_->copy_be_o, 0b1000);
  EXPECT_EQ(step_->copy_data_o >> 24, 0xAEu);
}

TEST_F(MbStep, NoStepIsUnderWayInReset) {
  step_->ld_req_i = 1;
  step_->ld_step_i = kStepLow;
  clock();
  EXPECT_TRUE(step_->flight_o);
  step_->rst_ni = 0;
  step_.settle();
  EXPECT_FALSE(step_->flight_o || step_->copy_o || step_->ld_data_o || step_->mv_data_o);
}

}  // namespace
}  // namespace vericansim
