// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Codes 1110 and 1010 as the transmit side sees them, abort included (flexcan.md 3.2, 3.4, 3.7).
#include <gtest/gtest.h>

#include "mailbox/tx_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 10, kAsker = 20, kCodeAnswers = 0xA, kCodeAnswering = 0xE;

const Frame kAnswer{.id = 0x155, .dlc = 3, .data = {1, 2, 3}};

class Reply : public ::testing::Test {
 protected:
  explicit Reply(const RigConfig &config = {}) : rig_{2, config} {}
  void offer(const Frame &frame) { rig_.put(0, kMb, mb_words(frame, kCodeAnswers)); }
  // Node 1 sends a remote frame and waits until it is through.
  void ask(const Frame &frame) {
    Frame remote = frame;
    remote.remote = true;
    rig_.put_tx(1, kAsker, remote);
    ASSERT_TRUE(rig_.wait_flag(1, kAsker));
    rig_.clear_flag(1, kAsker);
    rig_.write(1, reg::mb(kAsker), kInactiveWord);  // it became a receiver
  }
  TxRig rig_;
};

TEST_F(Reply, ComesAtOnceAndAgain) {  // FX-3.7.b, FX-3.2.h, FX-3.2.i
  offer(kAnswer);
  rig_.join();
  for (unsigned i = 0; i < 3; ++i) {
    ask(kAnswer);
    EXPECT_EQ(rig_.code(kMb), kCodeAnswering);
    EXPECT_EQ(rig_.flags(0), 0u) << "a request sets no IFLAG";
    ASSERT_TRUE(rig_.wait_flag(0, kMb));
    EXPECT_EQ(rig_.code(kMb), kCodeAnswers);
    EXPECT_EQ(mb_frame(rig_.received()), kAnswer);
    rig_.clear_flag(0, kMb);
  }
  rig_.reset_counts();
  rig_.watch(1500);
  EXPECT_EQ(rig_.starts(), 0u);
}

TEST_F(Reply, CodeWrittenByTheCpuIsSentToo) {
  rig_.join();
  rig_.put(0, kMb, mb_words(kAnswer, kCodeAnswering));
  ASSERT_TRUE(rig_.wait_flag(0, kMb));
  EXPECT_EQ(rig_.code(kMb), kCodeAnswers);
}

class ReplyWithAen : public Reply {
 protected:
  ReplyWithAen() : Reply{TxRig::with_aen()} {}
};

// FX-3.4.a, FX-3.4.c: request, then the abort after k clocks: one end, 1001 or a frame on the wire.
TEST_F(ReplyWithAen, AbortedAtEveryClock) {
  rig_.join();
  for (unsigned k = 0; k < 700; k += 3) {
    SCOPED_TRACE(k);
    offer(kAnswer);
    ask(kAnswer);
    rig_.reset_counts();
    rig_.watch(k);
    rig_.write_watched(reg::mb(kMb), kAbortWord);
    ASSERT_TRUE(rig_.watch_flag(kMb, 1200));
    rig_.watch(1000);
    ASSERT_EQ(rig_.starts(), rig_.sent());
    ASSERT_EQ(rig_.code(kMb), rig_.sent() != 0 ? kCodeAnswers : 9u);
    rig_.clear_flag(0, kMb);
    rig_.write(0, reg::mb(kMb), kInactiveWord);
    rig_.run(10);
    ASSERT_EQ(rig_.flags(0), 0u);
  }
}

// FX-3.7.a: after an own remote frame the buffer is one that receives (FX-9.e3407).
TEST_F(Reply, RequestSentLeavesAnEmptyBuffer) {
  rig_.join();
  rig_.put_tx(0, kMb, {.id = 0x155, .remote = true});
  ASSERT_TRUE(rig_.wait_flag(0, kMb));
  EXPECT_EQ(rig_.code(kMb), 4u);
  rig_.clear_flag(0, kMb);
  rig_.put_tx(0, kMb + 1, {.id = 0x156});
  ASSERT_TRUE(rig_.wait_flag(0, kMb + 1)) << "no answer holds nothing up";
}

// FX-3.3.j: the flag of the request is cleared, so the buffer may be written: also if its answer
// comes in that very clock and sets the flag again.
TEST_F(ReplyWithAen, RequestWhoseFlagIsClearedInAnyClockOfTheAnswer) {
  rig_.join();
  unsigned both = 0;
  for (unsigned k = 0; k < 620; ++k) {
    rig_.put_tx(0, kMb, {.id = 0x155, .remote = true});
    ASSERT_TRUE(rig_.wait_flag(0, kMb));
    ASSERT_EQ(rig_.code(kMb), 4u);
    rig_.put_tx(1, kAsker, {.id = 0x155, .dlc = 0});
    rig_.run(k);
    rig_.clear_flag(0, kMb);
    both += rig_.flags(0) != 0 ? 1 : 0;
    rig_.write(0, reg::mb(kMb), kInactiveWord);
    ASSERT_TRUE(rig_.wait_flag(1, kAsker));
    rig_.run(100);
    ASSERT_EQ(rig_.code(kMb), 8u) << "after " << k << " clocks";
    rig_.clear_flag(0, kMb);
    rig_.clear_flag(1, kAsker);
  }
  EXPECT_GT(both, 0u) << "the case this test is for";
}

}  // namespace
}  // namespace vericansim
