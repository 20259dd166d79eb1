// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_guard alone (flexcan.md 3.3, 3.4): with AEN = 1, which writes take place and which are a
// request to abort.
#include <gtest/gtest.h>

#include <functional>

#include "Vcan_mb_guard.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kCs = 0, kMsg = 1, kAbort = 0x9, kActive = 0xC;

class MbGuard : public ::testing::Test {
 protected:
  MbGuard() {
    guard_->aen_i = guard_->gnt_i = 1;
    guard_->wr_done_i = 0;
    guard_.reset();
  }
  /// A write in its first clock, in which its buffer is looked up.
  void look(unsigned mem_sel, unsigned idx, unsigned code) {
    guard_->wr_done_i = 0;
    guard_->first_i = 1;
    guard_->be3_i = 1;
    guard_->mem_sel_i = mem_sel;
    guard_->idx_i = idx;
    guard_->code_i = code;
  }
  /// The second clock of that access, in which it ends.
  void ends() {
    guard_.clock();
    guard_->end_i = guard_->first_i = 0;
    guard_->wr_done_i = 1;
    guard_.settle();
  }
  void cs_write(unsigned idx, unsigned code) {
    look(kCs, idx, code);
    ends();
  }
  void clock() {
    guard_.clock();
    guard_->wr_done_i = guard_->end_i = 0;
    guard_.settle();
  }
  [[nodiscard]] bool blocked() {
    return guard_->block_o != 0 || (guard_->if_ended_o != 0 && guard_->ended_i != 0);
  }
  LeafModel<Vcan_mb_guard> guard_;
};

/// What makes a write of code 1001 something else.
const std::function<void(Vcan_mb_guard &)> kNoRequest[] = {
    [](auto &g) { g.be3_i = 0; },  // the byte with the code is not written
    [](auto &g) { g.code_i = 0x8; },     [](auto &g) { g.code_i = kActive; },
    [](auto &g) { g.mem_sel_i = kMsg; }, [](auto &g) { g.mem_sel_i = 2; },
    [](auto &g) { g.mem_sel_i = 3; },    [](auto &g) { g.aen_i = 0; },
};

TEST_F(MbGuard, RequestForTheFrameThatHasMovedOut) {  // FX-3.4.b, FX-3.4.d
  guard_->out_i = 1;
  guard_->cur_idx_i = 7;
  look(kCs, 7, kAbort);
  guard_.settle();
  EXPECT_FALSE(guard_->abort_o) << "it is only being looked up";
  ends();
  EXPECT_TRUE(guard_->abort_o);
  EXPECT_TRUE(blocked());
  guard_->wr_done_i = 0;  // a read; the data lines show anything
  guard_.settle();
  EXPECT_FALSE(guard_->abort_o);
  for (const auto &change : kNoRequest) {
    look(kCs, 7, kAbort);
    change(*guard_.operator->());
    ends();
    EXPECT_FALSE(guard_->abort_o) << &change - kNoRequest;
    guard_->aen_i = 1;
  }
  cs_write(6, kAbort);
  EXPECT_FALSE(guard_->abort_o || blocked()) << "another buffer";
  clock();
  EXPECT_TRUE(guard_->flag_o);
}

// While a write looks its buffer up another frame may be presented in place of that buffer's.
TEST_F(MbGuard, FrameThatIsReplacedHasNotMovedOut) {  // FX-3.4.b
  guard_->out_i = guard_->done_i = 1;
  for (const bool replaced : {false, true}) {
    for (const unsigned mem_sel : {kCs, kMsg}) {
      guard_->cur_idx_i = 7;
      look(mem_sel, 7, kAbort);
      guard_->take_i = replaced;
      ends();
      guard_->take_i = 0;
      guard_->cur_idx_i = replaced ? 8 : 7;
      guard_.settle();
      EXPECT_EQ(blocked(), !replaced) << mem_sel;
    }
  }
}

TEST_F(MbGuard, RequestThatIsDoneAtOnce) {  // FX-3.4.a
  for (const auto &change : kNoRequest) {
    look(kCs, 3, kAbort);
    change(*guard_.operator->());
    ends();
    clock();
    EXPECT_FALSE(guard_->flag_o) << &change - kNoRequest;
    guard_->aen_i = 1;
  }
  cs_write(3, kAbort);
  EXPECT_FALSE(blocked() || guard_->abort_o);
  clock();
  EXPECT_TRUE(guard_->flag_o);
  EXPECT_EQ(guard_->flag_idx_o, 3);
  clock();
  EXPECT_FALSE(guard_->flag_o) << "once";
}

// What is refused is not done: where a frame has ended whose flag is not set yet, and where an
// abort has been done whose flag is not set yet.
TEST_F(MbGuard, RequestThatIsRefusedIsNotDone) {  // FX-3.3.j, FX-3.4.a
  guard_->cur_idx_i = 7;
  guard_->done_i = 1;
  cs_write(7, kAbort);
  EXPECT_TRUE(blocked());
  clock();
  EXPECT_FALSE(guard_->flag_o);
  guard_->done_i = guard_->gnt_i = 0;
  cs_write(3, kAbort);
  clock();
  ASSERT_TRUE(guard_->flag_o);
  cs_write(3, kAbort);
  EXPECT_TRUE(blocked());
  guard_->gnt_i = 1;
  clock();
  EXPECT_FALSE(guard_->flag_o) << "is set a second time";
}

// The mark of the C/S word alone is not enough, nor is a flag: that may be a reception's.
TEST_F(MbGuard, ProtectsWhatHasEndedUntilItsFlagIsCleared) {  // FX-3.3.j
  for (const bool marked : {false, true}) {
    for (const bool flag : {false, true}) {
      for (const unsigned mem_sel : {kCs, kMsg, 2u, 3u}) {
        for (const bool fifo : {false, true}) {
          for (const bool aen : {false, true}) {
            guard_->iflag_i = flag ? 1u << 5 : ~(1u << 5);
            guard_->area_i = fifo;
            guard_->aen_i = aen;
            guard_->ended_i = 0;
            look(mem_sel, 5, 0);
            ends();
            guard_->ended_i = marked;  // the RAM shows it
            guard_.settle();
            EXPECT_EQ(blocked(), aen && !fifo && mem_sel <= kMsg && marked && flag) << mem_sel;
          }
        }
      }
    }
  }
}

// In the clock in which a frame ends, and while it is about to, nothing is known by IFLAG yet.
TEST_F(MbGuard, ProtectsWhatIsAboutToEnd) {  // FX-3.3.j
  for (const unsigned mem_sel : {kCs, kMsg, 2u, 3u}) {
    for (const unsigned idx : {4u, 5u}) {
      guard_->cur_idx_i = 5;
      guard_->done_i = 1;
      look(mem_sel, idx, 0);
      ends();
      EXPECT_EQ(blocked(), idx == 5 && mem_sel <= kMsg) << mem_sel << " " << idx;
      clock();
      guard_->done_i = 0;
      // The end is told in the clock in which the write looks its buffer up: marked already.
      look(mem_sel, idx, 0);
      guard_->end_i = 1;
      guard_->end_idx_i = 5;
      ends();
      guard_->ended_i = idx == 5;
      guard_.settle();
      EXPECT_EQ(blocked(), idx == 5 && mem_sel <= kMsg) << mem_sel << " " << idx;
      guard_->ended_i = 0;
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
    EXPECT_EQ(blocked(), idx == 3) << idx;
    clock();
  }
  guard_->gnt_i = 1;
  clock();
  cs_write(3, 0);
  EXPECT_FALSE(blocked());
}

// No flag is set behind a soft reset, also where the abort ends in its clock.
TEST_F(MbGuard, SoftResetForgetsTheFlag) {  // FX-2.3.b
  for (const bool waits : {false, true}) {
    guard_->gnt_i = 0;
    cs_write(3, kAbort);
    if (waits) clock();
    guard_->clear_i = 1;
    clock();
    guard_->clear_i = 0;
    EXPECT_FALSE(guard_->flag_o) << waits;
    clock();
    EXPECT_FALSE(guard_->flag_o) << waits;
  }
}

}  // namespace
}  // namespace vericansim
