// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_move alone (flexcan.md 3.4 to 3.6): two frames on their way, each bound to its buffer,
// and what C/S writes do to them, in both rows.
#include <gtest/gtest.h>

#include <vector>

#include "Vcan_mb_move.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kInactiveWord = 0, kFullWord = 0x2u << 24, kEmptyWord = 0x4u << 24;
constexpr unsigned kFull = 0x2, kOverrun = 0x6;

class MbMove : public ::testing::Test {
 protected:
  MbMove() {
    move_.reset();
    move_.settle();
    move_->match_done_i = move_->hit_i = 1;
  }
  /// One clock; steps are granted at once, their data follows a clock later.
  void clock() {
    move_.settle();
    const bool step = move_->req_o != 0 && move_->data_i == 0;
    if (move_->data_i != 0 && move_->step_o == 3) code_ = (move_->top_o >> 1) & 0xF;
    if (step) move_->cs_i = ram_cs_;
    move_.clock();
    move_.settle();
    move_->data_i = step && move_->moving_o != 0;  // as can_mb_step does it
    move_->cs_written_i = move_->start_i = move_->valid_i = 0;
    move_.settle();
    if (move_->flag_o || move_->ans_o) stored_.push_back(move_->idx_o);
  }
  /// A frame that belongs to the buffer; `known`: the match is over when the frame is.
  void frame(unsigned buffer, bool known = true) {
    move_->start_i = 1;
    clock();
    clock();
    move_->hit_idx_i = buffer;
    move_->match_done_i = known;
    move_->valid_i = 1;
    clock();
    if (known) clock();
  }
  /// Two frames wait, after a reset in row 0 for buffer 10 and in row 1 for buffer 20.
  void two_wait() {
    move_->hold_i = 1;
    frame(10);
    frame(20);
  }
  /// The CPU writes the C/S word of a buffer, which is known in the clock after.
  void write(unsigned buffer, bool empty) {
    move_->cpu_idx_i = buffer;
    clock();
    written(buffer, empty);
  }
  void written(unsigned buffer, bool empty) {
    ram_cs_ = empty ? kEmptyWord : kInactiveWord;
    move_->cs_written_i = 1;
    move_->cs_written_idx_i = buffer;
    clock();
  }
  std::vector<unsigned> all_that_moves() {
    move_->hold_i = 0;
    for (unsigned i = 0; i < 60; ++i) clock();
    EXPECT_FALSE(move_->busy_o);
    return stored_;
  }
  LeafModel<Vcan_mb_move> move_;
  std::vector<unsigned> stored_;
  std::uint32_t ram_cs_ = kInactiveWord;  // of whatever buffer is read
  unsigned code_ = 0;
};

using Buffers = std::vector<unsigned>;

TEST_F(MbMove, CsWriteCancelsTheFrameThatWaitsForItsBuffer) {  // FX-3.4.g
  for (const unsigned cancelled : {10u, 20u}) {
    move_.reset();
    for (unsigned round = 0; round < 4; ++round) {  // the rows take turns
      stored_.clear();
      two_wait();
      write(cancelled, false);
      EXPECT_EQ(all_that_moves(), Buffers{30 - cancelled}) << round;
    }
  }
}

// In whatever clock the write comes, that of the decision to move the frame too.
TEST_F(MbMove, CsWriteCancelsInEveryClock) {  // FX-3.4.g
  for (const bool empty : {false, true}) {
    unsigned cancelled = 0;
    for (unsigned wait = 0; wait < 24; ++wait) {
      move_.reset();
      stored_.clear();
      move_->cpu_idx_i = 10;
      move_->hold_i = 1;
      frame(10);
      for (unsigned i = 0; i < wait; ++i) {
        move_->hold_i = i < 5;
        clock();
      }
      move_->hold_i = wait < 5;
      written(10, empty);
      clock();
      const Buffers before = stored_;
      EXPECT_EQ(all_that_moves(), before) << "written in clock " << wait;
      cancelled += before.empty();
    }
    EXPECT_GT(cancelled, 5u);
    EXPECT_LT(cancelled, 24u);
  }
}

TEST_F(MbMove, CsWriteOfAnotherBufferCancelsNothing) {  // FX-3.4.g
  two_wait();
  write(11, false);
  move_->cs_written_idx_i = 20;  // no write
  clock();
  move_->cs_written_idx_i = 10;
  clock();
  EXPECT_EQ(all_that_moves(), (Buffers{10, 20}));
}

TEST_F(MbMove, WritingEmptyCancelsToo) {  // FX-3.4.g
  for (const unsigned locked : {10u, 20u, 30u}) {
    for (const unsigned written : {10u, 20u}) {
      stored_.clear();
      move_.reset();
      two_wait();
      move_->lock_i = 1;
      move_->lock_idx_i = locked;
      write(written, true);
      move_->lock_i = 0;
      EXPECT_EQ(all_that_moves(), Buffers{30 - written});
    }
  }
}

TEST_F(MbMove, AnswerIsCancelledByAnyCsWriteAndByNothingElse) {  // FX-3.4.g, FX-3.7.b
  for (const bool written : {false, true}) {
    for (const unsigned buffer : {10u, 20u}) {
      stored_.clear();
      move_.reset();
      move_->hit_ans_i = 1;
      two_wait();
      move_->cs_written_idx_i = buffer;  // the last one written was this one
      clock();
      if (written) write(buffer, true);
      EXPECT_EQ(all_that_moves(), written ? Buffers{30 - buffer} : (Buffers{10, 20}));
    }
  }
}

// The buffer of a frame whose match is not over yet is that of an earlier one.
TEST_F(MbMove, CsWriteCancelsWhileTheOtherRowIsUnresolved) {  // FX-3.4.g
  two_wait();
  write(10, false);
  frame(30, false);
  EXPECT_EQ(move_->smb_o, 0);
  write(20, false);
  move_->match_done_i = 1;
  clock();
  EXPECT_EQ(all_that_moves(), Buffers{30});
}

// Bit 31 is the serviced mark.
TEST_F(MbMove, FrameOverAnUnreadOneIsAnOverrun) {  // FX-3.2.b, FX-3.2.c
  for (const std::uint32_t word : {kEmptyWord, kFullWord, kFullWord | 1u << 31}) {
    ram_cs_ = word;
    stored_.clear();
    frame(10);
    EXPECT_EQ(all_that_moves(), Buffers{10});
    EXPECT_EQ(code_, word == kFullWord ? kOverrun : kFull);
  }
}

// The row's own lock holds it up, no other one; while it moves the CPU sees BUSY, but for answers.
TEST_F(MbMove, OnlyTheLockOfItsBufferHoldsAFrameUp) {  // FX-3.5.o, FX-3.6.b
  for (const unsigned locked : {10u, 20u, 30u}) {
    for (const bool answer : {false, true}) {
      stored_.clear();
      move_.reset();
      move_->hit_ans_i = answer;
      two_wait();
      move_->hold_i = 0;
      move_->lock_i = 1;
      move_->lock_idx_i = locked;
      for (unsigned i = 0; i < 60; ++i) {
        clock();
        EXPECT_EQ(move_->busy_mb_o != 0, move_->moving_o != 0 && !answer);
        EXPECT_FALSE(move_->resolve_o);
      }
      EXPECT_EQ(stored_, locked == 30 ? (Buffers{10, 20}) : Buffers{30 - locked});
      move_->lock_i = 0;
      for (unsigned i = 0; i < 60; ++i) clock();
      EXPECT_EQ(stored_.size(), 2u);
    }
  }
}

// FX-3.4.g: EMPTY written while the answer is being prepared is no request for one.
TEST_F(MbMove, AnswerUnderWayIsCancelledByEmpty) {
  move_->hit_ans_i = 1;
  move_->cs_written_idx_i = 10;
  frame(10);
  while (move_->moving_o == 0) clock();
  ram_cs_ = kEmptyWord;
  move_->cs_written_i = 1;
  move_.settle();
  EXPECT_TRUE(move_->cancel_o);
  EXPECT_EQ(all_that_moves(), Buffers{});
}

// The search for a buffer has the time of a whole frame: until the next header, or until the next
// frame has no row to go to. The start of a frame that has one changes nothing.
TEST_F(MbMove, AFrameWithoutABufferByThenIsLost) {
  move_->hold_i = 1;
  frame(10, false);
  move_->start_i = 1;
  clock();
  move_->match_done_i = 1;
  clock();
  EXPECT_EQ(all_that_moves(), Buffers{10}) << "a start alone";
  for (const bool no_row : {false, true}) {
    stored_.clear();
    move_.reset();
    move_->hold_i = 1;
    if (no_row) frame(10);
    frame(20, false);
    (no_row ? move_->start_i : move_->rx_hdr_i) = 1;
    clock();
    move_->rx_hdr_i = 0;
    move_->match_done_i = 1;
    move_.settle();
    EXPECT_FALSE(move_->resolve_o);
    EXPECT_EQ(all_that_moves(), no_row ? Buffers{10} : Buffers{});
  }
}

// FX-3.6.b, VA-01: the hidden row that a frame is written to from its begin on holds no other one:
// a frame waits for a locked buffer, and the match of the next one ends in any clock around the
// begin of a third; so does the lock. One of the three is lost at most, never the last.
TEST_F(MbMove, AFrameThatBeginsOverwritesNoOther) {
  for (const unsigned second : {20u, 10u})
    for (unsigned match = 0; match < 24; ++match)
      for (unsigned unlock = 0; unlock < 40; ++unlock) {
        move_.reset();
        stored_.clear();
        move_->lock_i = 1;
        move_->lock_idx_i = 10;
        frame(10);
        frame(second, false);
        for (unsigned i = 0; i < 60; ++i) {
          if (i == match) move_->match_done_i = 1;
          if (i == unlock) move_->lock_i = 0;
          move_->start_i = i == 12;
          clock();
          ASSERT_FALSE(i > 12 && move_->moving_o && move_->row_o == move_->smb_o)
              << second << " match " << match << " unlock " << unlock << " clock " << i;
        }
        move_->hit_idx_i = 30;
        move_->valid_i = 1;
        clock();
        const Buffers all = all_that_moves();
        ASSERT_FALSE(all.empty());
        EXPECT_EQ(all.back(), 30u);
        EXPECT_GE(all.size(), 2u) << second << " match " << match << " unlock " << unlock;
      }
}

// FX-3.5.l, FX-3.5.o: the buffer of a frame that waits is not free for the next one: it is told of
// from either row, from the start of the next frame until it has moved. Answers and frames for the
// Rx FIFO wait for no buffer, nor does one whose match is not over.
TEST_F(MbMove, FrameThatWaitsIsToldOfFromEitherRow) {
  for (const bool answer : {false, true}) {
    for (const bool fifo : {false, true}) {
      move_.reset();
      move_->hit_ans_i = answer;
      move_->hit_fifo_i = fifo;
      for (unsigned buffer = 10; buffer < 14; ++buffer) {  // the rows take turns
        SCOPED_TRACE(testing::Message() << answer << fifo << ' ' << buffer);
        move_->hold_i = 1;
        frame(buffer, false);
        move_->start_i = 1;
        clock();
        EXPECT_FALSE(move_->waits_o) << "its match is not over";
        move_->match_done_i = 1;
        clock();
        EXPECT_EQ(move_->waits_o != 0, !answer && !fifo);
        EXPECT_TRUE(answer || fifo || move_->waits_idx_o == buffer);
        move_->hold_i = 0;
        for (unsigned i = 0; i < 30; ++i) clock();
        EXPECT_FALSE(move_->busy_o || move_->waits_o);
      }
    }
  }
}

// Behind a hard reset there is nothing to tell of, neither a flag nor a frame in the Rx FIFO nor an
// answer, in whatever clock of a move it comes.
TEST_F(MbMove, HardResetInEveryClockOfAMoveLeavesNothingToTell) {  // FX-2.a
  for (const unsigned kind : {0u, 1u, 2u}) {
    unsigned told = 0;
    move_->hit_fifo_i = kind == 1;
    move_->hit_ans_i = kind == 2;
    for (unsigned wait = 0; wait < 30; ++wait) {
      frame(10);
      for (unsigned i = 0; i < wait; ++i) clock();
      told += move_->flag_o || move_->stored_o || move_->ans_o;
      move_->rst_ni = 0;
      move_.settle();
      EXPECT_FALSE(move_->flag_o || move_->stored_o || move_->ans_o) << kind << ' ' << wait;
      EXPECT_FALSE(move_->moving_o || move_->busy_o) << kind << ' ' << wait;
      move_->data_i = 0;
      move_.reset();
    }
    EXPECT_EQ(told, 1u) << kind;
  }
}

// From the clock after the decision until it is stored, whatever the other row does.
TEST_F(MbMove, FramesOnTheirWayIntoTheFifoAreCounted) {  // FX-4.b
  move_->hit_fifo_i = move_->hold_i = 1;
  EXPECT_EQ(move_->fifo_in_flight_o, 0);
  frame(0);
  EXPECT_EQ(move_->fifo_in_flight_o, 1);
  frame(1, false);
  for (unsigned i = 0; i < 5; ++i, clock())
    EXPECT_EQ(move_->fifo_in_flight_o, 1) << "the other one may not fit";
  move_->match_done_i = 1;
  clock();
  EXPECT_EQ(move_->fifo_in_flight_o, 3);
  move_->hold_i = 0;
  unsigned stored = 0;
  for (unsigned i = 0; i < 60; ++i, clock()) {
    EXPECT_EQ(move_->fifo_in_flight_o, stored == 0 ? 3 : stored == 1 ? 2 : 0);
    if (move_->stored_o != 0) ++stored;
  }
  EXPECT_EQ(stored, 2u);
  // Rows that were the FIFO's before are not counted before the decision.
  frame(2, false);
  EXPECT_EQ(move_->fifo_in_flight_o, 0);
}

}  // namespace
}  // namespace vericansim
