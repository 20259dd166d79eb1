// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_tx: passes over the buffers for ESR2 (flexcan.md 1.7), what they tell, and the winner
// beside them.
#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "unit/can_mb_tx_rig.hpp"

namespace vericansim {
namespace {

// ESR2 (flexcan.md 1.7): a pass that changes of the buffers ask for is announced once; one that
// only looks for what an upset may have lost is not.
TEST_P(MbTx, PassesThatNobodyAskedForAreQuiet) {
  unsigned begun = 0, ended = 0, seen = 0, looks = 0;
  const auto run = [&](bool fresh) {
    for (unsigned i = 0; i < 800; ++i) {
      top_.fresh_i = fresh && i < 8;
      top_.eval();
      const bool wanted = top_.pass_o != 0;
      looks += top_.scan_req_o;
      clock({}, 0, 100);
      top_.eval();
      begun += !wanted && top_.pass_o != 0;
      ended += top_.pass_end_o;
      seen += top_.seen_o;
    }
  };
  run(false);
  EXPECT_EQ(ended, 1u);
  EXPECT_EQ(seen, kBuffers);
  EXPECT_EQ(std::exchange(looks, 0u), 2 * kBuffers);
  run(true);
  EXPECT_EQ(begun, 0u);
  EXPECT_EQ(ended, 1u);
  EXPECT_EQ(seen, kBuffers);
  EXPECT_EQ(std::exchange(looks, 0u), kBuffers);
  clock(3, 0x08000000, 100);
  run(false);
  EXPECT_EQ(begun, 1u);
  EXPECT_EQ(ended, 2u);
}

// A frame that has failed is a buffer among others again: a pass for ESR2 counts it.
TEST_P(MbTx, FrameThatFailsCountsInTheStatusAgain) {  // FX-ESR2.LPTM
  buffers_[20] = {kActive << 24, 0x300 << 18};
  buffers_[30] = {kActive << 24, 0x200 << 18};
  top_.cur_idx_i = 20;
  top_.off_i = 1;
  settle();
  clock(50, 0x08000000, 100);
  settle();
  ASSERT_EQ(top_.pass_o, 0);
  top_.off_i = 0;
  top_.retry_i = 1;
  std::optional<unsigned> worst;
  unsigned ended = 0;
  for (unsigned i = 0; i < 800; ++i) {
    clock({}, 0, 60);
    top_.eval();
    if (top_.seen_o != 0 && top_.seen_idx_o == 0) worst.reset();
    if (top_.seen_o != 0 && top_.seen_worst_o != 0) worst = top_.seen_idx_o;
    ended += top_.pass_end_o;
  }
  EXPECT_EQ(ended, 1u);
  EXPECT_EQ(worst, top_.lbuf_i != 0 ? 30u : 20u);
  check();
}

// The buffer of a frame that is sent has a new code: a pass under way begins anew, in any clock of
// it; where there is none can_mb_status knows enough.
TEST_P(MbTx, FrameThatIsSentRestartsAPass) {  // FX-ESR2.LPTM, FX-ESR2.VPS
  settle();
  top_.sent_i = 1;
  clock({}, 0, 100);
  top_.sent_i = 0;
  top_.eval();
  EXPECT_EQ(top_.pass_o, 0);
  unsigned moment = 0;
  while (true) {
    clock(50, 0x08000000, 100);
    ++moment;
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    top_.eval();
    if (top_.pass_o == 0) break;
    top_.sent_i = 1;
    top_.eval();
    ASSERT_EQ(top_.pass_end_o, 0) << moment << ": what it has found is not valid any more";
    clock({}, 0, 100);
    top_.sent_i = 0;
    top_.eval();
    unsigned seen = 0, clocks = 0;
    while (top_.pass_end_o == 0) {
      ASSERT_LT(++clocks, 4 * kPass);
      clock({}, 0, 100);
      top_.eval();
      // A buffer that had been read before may still be told of.
      seen = top_.seen_o != 0 ? (top_.seen_idx_o == 0 ? 1 : seen + 1) : seen;
    }
    ASSERT_EQ(seen, kBuffers) << moment;
    settle();
  }
  EXPECT_GT(moment, kPass);
}

// ESR2.LPTM: what a pass finds to be sent last, whatever came before it; of two equal buffers the
// later one.
TEST_P(MbTx, WorstIsThatOfTheModel) {  // FX-ESR2.LPTM
  unsigned found = 0;
  for (unsigned round = 0; round < 600; ++round) {
    for (unsigned i = rng_() % 12; i > 0; --i) random_write(100);
    std::optional<unsigned> worst;
    bool ended = false;
    for (unsigned i = 0; i < 800; ++i) {
      clock({}, 0, 60);
      top_.eval();
      if (top_.seen_o != 0 && top_.seen_idx_o == 0) worst.reset();
      if (top_.seen_o != 0 && top_.seen_worst_o != 0) worst = top_.seen_idx_o;
      ended = ended || top_.pass_end_o != 0;
    }
    if (round > 0 && !ended) continue;  // no write
    std::optional<unsigned> last;
    for (unsigned i = 0; i < kBuffers; ++i) {
      if (!is_active(buffers_[i].cs)) continue;
      if (!last || top_.lbuf_i != 0 || bits(buffers_[i]) >= bits(buffers_[*last])) last = i;
    }
    ASSERT_EQ(worst, last) << "round " << round;
    found += last.has_value();
    check();
  }
  EXPECT_GT(found, 300u);
}

// A pass for ESR2 takes the place of the winner's value: a better buffer is the winner within a few
// clocks all the same, a worse one is not, and nobody needs a pass.
TEST_P(MbTx, InsertionInEveryClockOfAPassForTheStatus) {
  buffers_[20] = {kActive << 24, 0x200 << 18};
  for (const unsigned i : {30u, 60u}) buffers_[i] = {kActive << 24, 0x300 << 18};
  for (unsigned moment = 0; moment < kPass + 8; ++moment) {
    for (const unsigned written : {10u, 40u}) {
      settle();
      check();
      clock(50, 0x08000000, 100);  // a pass begins
      for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
      buffers_[written].id = (written == 10 ? 0x100u : 0x280u) << 18;
      clock(written, kActive << 24, 100);
      for (unsigned i = 0; i < 8; ++i) clock({}, 0, 100);
      check();
      ASSERT_TRUE(top_.settled_o && top_.scan_lazy_o) << written << " in clock " << moment;
      buffers_[written].cs = 0;
      clock(written, 0x08000000, 100);
    }
  }
}

// A frame that has failed is there for the first opportunity behind its error, 17 bits on: a pass
// that is just looking at its buffer takes it for none that nobody knows, and needs no other pass.
TEST_P(MbTx, RetryInEveryClockOfAPassForTheStatus) {  // FX-3.3.f
  buffers_[20] = {kActive << 24, 0x200 << 18};
  top_.cur_idx_i = 20;
  for (unsigned moment = 0; moment < kPass + 8; ++moment) {
    top_.off_i = 1;
    settle();
    clock(50, 0x08000000, 100);  // a pass begins
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    top_.off_i = 0;
    top_.retry_i = 1;
    for (unsigned i = 0; i < 8; ++i) clock({}, 0, 100);
    check();
    ASSERT_TRUE(top_.settled_o && top_.scan_lazy_o) << "in clock " << moment;
  }
}

// What such a pass was just looking at is no candidate: the winner is still known as such when it
// is taken away in the next clocks.
TEST_P(MbTx, WinnerLostBehindAnInsertionInAPassForTheStatus) {
  for (unsigned i = 1; i < kBuffers; ++i) buffers_[i] = {kActive << 24, (0x400 - i) << 18};
  buffers_[1].id = 0x500 << 18;  // the worst
  buffers_[40].id = 0x080 << 18;
  for (unsigned moment = 0; moment < kPass + 8; moment += 3) {
    for (unsigned gap = 0; gap < 4; ++gap) {
      buffers_[20] = {0x8u << 24, 0x100 << 18};
      clock(20, kActive << 24, 100);
      settle();
      clock(0, 0x08000000, 100);  // a pass begins
      for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
      clock(63, kActive << 24, 100);
      for (unsigned i = 0; i < gap; ++i) clock({}, 0, 100);
      clock(40, 0x08000000, 100);
      settle();
      check();
      clock(40, kActive << 24, 100);
      settle();
      check();
    }
  }
}

// Two C/S words written in a row while the winner's value is not there: the first one is found by a
// pass.
TEST_P(MbTx, InsertionsInARowInAPassForTheStatus) {
  buffers_[20] = {kActive << 24, 0x200 << 18};
  buffers_[30] = {kActive << 24, 0x300 << 18};
  for (unsigned moment = 0; moment < kPass + 8; ++moment) {
    settle();
    clock(50, 0x08000000, 100);
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    buffers_[10].id = 0x100 << 18;
    buffers_[11].id = 0x180 << 18;
    clock(10, kActive << 24, 100);
    clock(11, kActive << 24, 100);
    settle();
    check();
    clock(10, 0x08000000, 100);
    clock(11, 0x08000000, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, MbTx, kMbTxModes);

}  // namespace
}  // namespace vericansim
