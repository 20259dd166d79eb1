// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_guard alone (flexcan.md 3.3, 3.4): with AEN = 1, which writes take place, which are a
// request to abort, and which have to wait for a clock.
#include <gtest/gtest.h>

#include <functional>

#include "Vcan_mb_guard.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kCs = 0, kMsg = 1, kAbort = 0x9, kActive = 0xC, kAnswer = 0xE;

class MbGuard : public ::testing::Test {
 protected:
  MbGuard() {
    guard_->aen_i = guard_->gnt_i = 1;
    guard_->wr_i = guard_->mb_wr_i = 0;
    guard_.reset();
  }
  /// A write of a C/S word in its data phase, which ends in this clock.
  void cs_write(unsigned idx, unsigned code) {
    guard_->wr_i = guard_->mb_wr_i = guard_->be3_i = 1;
    guard_->kind_i = kCs;
    guard_->idx_i = idx;
    guard_->code_i = code;
    guard_.settle();
  }
  void clock() {
    guard_.clock();
    guard_->wr_i = guard_->mb_wr_i = guard_->end_i = 0;
    guard_.settle();
  }
  /// A transmission of the buffer ends: its flag is set in the next clock.
  void end(unsigned idx) {
    guard_->end_i = 1;
    guard_->end_idx_i = idx;
    clock();
    guard_->iflag_i |= std::uint64_t{1} << idx;
  }
  LeafModel<Vcan_mb_guard> guard_;
};

/// What makes a write of code 1001 something else.
const std::function<void(Vcan_mb_guard &)> kNoRequest[] = {
    [](auto &g) { g.wr_i = g.mb_wr_i = 0; },  // a read; the data lines show anything
    [](auto &g) { g.be3_i = 0; },             // the byte with the code is not written
    [](auto &g) { g.code_i = 0x8; },
    [](auto &g) { g.code_i = kActive; },
    [](auto &g) { g.kind_i = kMsg; },
    [](auto &g) { g.kind_i = 2; },
    [](auto &g) { g.kind_i = 3; },
    [](auto &g) { g.aen_i = 0; },
};

TEST_F(MbGuard, RequestForTheFrameThatHasMovedOut) {  // FX-3.4.b, FX-3.4.d
  guard_->out_i = 1;
  guard_->cur_idx_i = 7;
  cs_write(7, kAbort);
  EXPECT_TRUE(guard_->abort_o);
  EXPECT_TRUE(guard_->block_o);
  for (const auto &change : kNoRequest) {
    cs_write(7, kAbort);
    change(*guard_.operator->());
    guard_.settle();
    EXPECT_FALSE(guard_->abort_o) << &change - kNoRequest;
    guard_->aen_i = 1;
  }
  cs_write(6, kAbort);
  EXPECT_FALSE(guard_->abort_o || guard_->block_o) << "another buffer";
  clock();
  EXPECT_TRUE(guard_->flag_o);
}

TEST_F(MbGuard, RequestThatIsDoneAtOnce) {  // FX-3.4.a
  for (const auto &change : kNoRequest) {
    cs_write(3, kAbort);
    change(*guard_.operator->());
    clock();
    EXPECT_FALSE(guard_->flag_o) << &change - kNoRequest;
    guard_->aen_i = 1;
  }
  cs_write(3, kAbort);
  EXPECT_FALSE(guard_->block_o || guard_->abort_o);
  clock();
  EXPECT_TRUE(guard_->flag_o);
  EXPECT_EQ(guard_->flag_idx_o, 3);
  clock();
  EXPECT_FALSE(guard_->flag_o) << "once";
}

// The frame presented may be rewritten with what is not sent. Without the top byte the code stays,
// and that may be an active one.
TEST_F(MbGuard, WhatIsNotTakenBackForANewFrame) {  // FX-3.4.a
  guard_->kept_i = 1;
  guard_->cur_idx_i = 12;
  for (unsigned code = 0; code < 16; ++code) {
    for (const bool top_byte : {false, true}) {
      cs_write(12, code);
      guard_->be3_i = top_byte;
      guard_.settle();
      EXPECT_EQ(guard_->block_o != 0, !top_byte || code == kActive || code == kAnswer) << code;
      cs_write(13, code);
      EXPECT_FALSE(guard_->block_o);
    }
  }
}

TEST_F(MbGuard, ProtectsWhatHasEndedUntilItsFlagIsCleared) {  // FX-3.3.j
  end(5);
  // The first clock of a write only looks its buffer up; it is not blocked for the one before.
  for (const unsigned idx : {5u, 6u, 5u}) {
    for (const unsigned kind : {kCs, kMsg}) {
      guard_->waited_i = 0;
      guard_->kind_i = kind;
      guard_->idx_i = idx;
      guard_->wr_i = 1;
      guard_->code_i = guard_->be3_i = 0;
      guard_.settle();
      EXPECT_TRUE(guard_->stall_o);
      EXPECT_FALSE(guard_->block_o) << idx;
      clock();
      guard_->waited_i = guard_->wr_i = 1;
      guard_.settle();
      EXPECT_EQ(guard_->block_o != 0, idx == 5) << idx;
      clock();
    }
  }
  guard_->iflag_i = 0;
  clock();
  clock();
  EXPECT_FALSE(guard_->stall_o);
}

// A frame that is received sets the flag in the clock in which the CPU clears it: it is never seen
// down. Of other buffers, and for an end, that changes nothing.
TEST_F(MbGuard, ClearedFlagEndsItThoughAReceptionSetsItAgain) {  // FX-3.3.j
  for (const bool again : {false, true}) {
    for (const unsigned cleared : {5u, 6u}) {
      for (const bool ends : {false, true}) {
        guard_.reset();
        end(5);
        guard_->again_i = again;
        guard_->end_i = ends;
        guard_->end_idx_i = cleared;
        clock();
        guard_->again_i = 0;
        cs_write(5, 8);
        guard_->mb_wr_i = 0;
        clock();
        cs_write(5, 8);
        guard_->waited_i = 1;
        guard_.settle();
        EXPECT_EQ(guard_->block_o != 0, !(again && cleared == 5 && !ends));
        guard_->waited_i = 0;
        guard_->iflag_i = 0;
      }
    }
  }
}

// In the clock in which a frame ends, and while it is about to, nothing is known by IFLAG yet.
TEST_F(MbGuard, ProtectsWhatIsAboutToEnd) {  // FX-3.3.j
  for (const unsigned kind : {kCs, kMsg, 2u, 3u}) {
    for (const unsigned idx : {4u, 5u}) {
      guard_->cur_idx_i = 5;
      guard_->done_i = 1;
      cs_write(idx, 0);
      guard_->kind_i = kind;
      guard_.settle();
      EXPECT_EQ(guard_->block_o != 0, idx == 5 && kind <= kMsg) << kind << " " << idx;
      clock();
      guard_->done_i = 0;
      // The end is told in the clock in which the write looks its buffer up.
      guard_->waited_i = 0;
      guard_->wr_i = 1;
      guard_->end_i = 1;
      guard_->end_idx_i = 5;
      clock();
      guard_->wr_i = guard_->waited_i = 1;
      guard_.settle();
      EXPECT_EQ(guard_->block_o != 0, idx == 5 && kind <= kMsg) << kind << " " << idx;
      guard_->waited_i = 0;
      clock();
      clock();
    }
  }
}

// Its flag is not set yet, because that of a reception comes first.
TEST_F(MbGuard, ProtectsWhatWasAbortedAtOnce) {  // FX-3.3.j
  guard_->gnt_i = 0;
  cs_write(3, kAbort);
  clock();
  for (const unsigned idx : {0u, 3u, 4u}) {
    cs_write(idx, 0);
    EXPECT_EQ(guard_->block_o != 0, idx == 3) << idx;
    clock();
  }
  guard_->gnt_i = 1;
  clock();
  cs_write(3, 0);
  EXPECT_FALSE(guard_->block_o);
}

TEST_F(MbGuard, WritesWaitOnlyForEndedBuffers) {  // FX-3.3.j
  for (unsigned i = 0; i < 5; ++i, clock()) EXPECT_FALSE(guard_->stall_o);
  guard_->iflag_i = 1u << 9;  // of a buffer that has received
  for (unsigned i = 0; i < 5; ++i, clock()) EXPECT_FALSE(guard_->stall_o);
  // From the clock after an abort at once on, for that buffer is about to be protected.
  cs_write(3, kAbort);
  EXPECT_FALSE(guard_->stall_o);
  clock();
  EXPECT_TRUE(guard_->stall_o);
  end(3);
  for (unsigned i = 0; i < 5; ++i, clock()) EXPECT_TRUE(guard_->stall_o);
  guard_->aen_i = 0;
  clock();
  EXPECT_FALSE(guard_->stall_o);
}

}  // namespace
}  // namespace vericansim
