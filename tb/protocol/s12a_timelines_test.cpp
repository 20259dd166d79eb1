// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 12a: the reference timelines, bit by bit against hand-written levels.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

// TL-01, EF-01, RO-04: six dominant bits, eight of the delimiter, three of the intermission, SOF.
TEST(Timeline, ActiveTransmitterRetries18BitsAfterAnError) {
  ErrorRig rig;
  rig.send(kGv1);
  EXPECT_EQ(rig.play(rep(22, ".")), kGv1Bits.substr(0, 22));
  rig.play("!");
  EXPECT_EQ(rig.last().errors, kErrBit0);
  EXPECT_EQ(rig.tec(), 8u);
  EXPECT_EQ(rig.play(rep(18, ".")), bits("000000 11111111 111 0"));
  EXPECT_EQ(rig.tec(), 8u);
}

// TL-02, EF-02, RO-04, IF-08: nothing dominant, and eight bits of suspend time.
TEST(Timeline, PassiveTransmitterRetries26BitsAfterAnError) {
  ErrorRig rig(kPassive);
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!");
  EXPECT_EQ(rig.play(rep(26, ".")), bits("111111 11111111 111 11111111 0"));
  EXPECT_EQ(rig.tec(), 136u);
}

// TL-03, ED-16: the flag stands at ACK delimiter to EOF5; SOF 18 bits after the slot.
TEST(Timeline, FrameWithoutAcknowledgeIsRepeated) {
  ErrorRig rig;
  rig.send(kGv1);
  EXPECT_EQ(rig.play(rep(44, ".")), kGv1Bits + "1");
  EXPECT_EQ(rig.play("."), "1");
  EXPECT_EQ(rig.last().field, Field::kAck);
  EXPECT_EQ(rig.last().errors, kErrAck);
  EXPECT_EQ(rig.play(rep(18, ".")), bits("000000 11111111 111 0"));
  EXPECT_EQ(rig.tec(), 8u);
}

// TL-04, ED-20, FC-04: the transmitter flags one bit later, so one dominant bit follows the flag.
TEST(Timeline, ReceiverWithCrcErrorFlagsFromEof1) {
  ErrorRig rig;
  std::string bad = kGv1Bits;
  bad.back() = '0';
  rig.play(bad + "1");
  EXPECT_EQ(rig.play("0 1"), "11");  // no acknowledge, nothing at the ACK delimiter
  EXPECT_EQ(rig.play(". 00000 0"), bits("000000 1"));
  EXPECT_EQ(rig.rec(), 9u);
  EXPECT_EQ(rig.play(rep(11, ".")), rep(11, "1"));
  EXPECT_EQ(rig.field(), Field::kIdle);
  EXPECT_EQ(rig.delivered(), 0u);
}

// TL-04: alone, DEL1 is at the place of EOF7.
TEST(Timeline, QuietBusAfterCrcErrorCostsOnlyOne) {
  ErrorRig rig;
  std::string bad = kGv1Bits;
  bad.back() = '0';
  EXPECT_EQ(rig.play(bad + "1 0 1").substr(44), "11");
  EXPECT_EQ(rig.play(rep(7, ".")), bits("000000 1"));
  EXPECT_EQ(rig.rec(), 1u);
  EXPECT_EQ(rig.field(), Field::kDel);
}

// TL-05, EF-11, FC-04: an early receiver sees the others' flags one bit longer.
TEST(Timeline, ReceiverThatFlagsOneBitEarlyCountsNine) {
  ErrorRig rig;
  rig.play("0 00000");  // SOF and five more: the sixth is the error
  EXPECT_EQ(rig.last().errors, kErrStuff);
  EXPECT_EQ(rig.rec(), 1u);
  EXPECT_EQ(rig.play("000000 0"), bits("000000 1"));
  EXPECT_EQ(rig.rec(), 9u);
  rig.play("1");  // DEL1
  EXPECT_EQ(rig.field(), Field::kDel);
  EXPECT_EQ(rig.bench.place().left(), 6u);
}

// TL-06, ED-11, OV-03, VA-01: delivered at EOF6, then an overload frame and nothing counted.
TEST(Timeline, ReceiverAnswersDominantEof7WithAnOverloadFrame) {
  ErrorRig rig;
  rig.play(kGv1Bits + "1");
  EXPECT_EQ(rig.play("0 1 11111"), bits("0 1 11111"));
  EXPECT_EQ(rig.delivered(), 0u);
  rig.play("1");  // EOF6
  ASSERT_EQ(rig.delivered(), 1u);
  EXPECT_EQ(rig.dut().received()[0], kGv1);
  rig.play("0");  // EOF7
  EXPECT_EQ(rig.last().errors, 0);
  EXPECT_EQ(rig.play(rep(17, ".")), bits("000000 11111111 111"));
  EXPECT_EQ(rig.field(), Field::kIdle);
  EXPECT_EQ(rig.rec(), 0u);
}

// TL-07, IF-06, ST-07, AR-11: ID28 follows the foreign SOF; that SOF is the first bit of the run.
TEST(Timeline, PendingFrameJoinsAStartInInt3) {
  ErrorRig rig;
  rig.play(whole(kGv1) + "11");
  rig.request({.id = 0x07F});  // 0000 1111111: the fifth own bit is a recessive stuff bit
  EXPECT_EQ(rig.play("0"), "1");
  EXPECT_TRUE(rig.last().started);
  EXPECT_EQ(rig.play(rep(13, ".")), bits("0000 1 1111 0 111"));
  EXPECT_TRUE(rig.last().transmitter);
  EXPECT_EQ(rig.field(), Field::kRtr);
}

// TL-08, EF-02, EF-03, OV-01: the passive flag ends with six equal bits, here the dominant ones.
TEST(Timeline, InterruptedPassiveFlagThenOverload) {
  ErrorRig rig(kPassive);
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!");
  EXPECT_EQ(rig.play("00000 11111 000000"), rep(16, "1"));  // flag complete at n+16
  EXPECT_EQ(rig.play("11111111"), rep(8, "1"));             // DEL n+17..n+24
  EXPECT_EQ(rig.play("0"), "1");                            // INT1 at n+25
  EXPECT_EQ(rig.last().field, Field::kInt);
  EXPECT_EQ(rig.play(rep(7, ".")), bits("000000 1"));  // n+26..n+31, although passive
  EXPECT_EQ(rig.tec(), 136u);
}

// TL-09, FC-08: six dominant bits after the flag are less than eight.
TEST(Timeline, PassiveFlagFollowedBySixDominantBits) {
  ErrorRig rig(kPassive);
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!");
  EXPECT_EQ(rig.play("111111 000000"), rep(12, "1"));
  EXPECT_EQ(rig.play(rep(20, ".")), bits("11111111 111 11111111 0"));  // SOF at n+32
  EXPECT_EQ(rig.tec(), 136u);
}

// TL-10, BO-01, BO-02, BO-05, FC-13: off at once, back after 128 times eleven recessive bits.
TEST(Timeline, OneMoreErrorAt248IsBusOff) {
  ErrorRig rig({.tec = 248});
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!");
  EXPECT_TRUE(rig.last().bus_off);
  EXPECT_EQ(rig.play(rep(1408, ".")), rep(1408, "1"));
  EXPECT_FALSE(rig.last().bus_off);
  EXPECT_EQ(rig.tec(), 0u);
  EXPECT_EQ(rig.rec(), 0u);
  EXPECT_FALSE(rig.last().passive);
  EXPECT_EQ(rig.play(rep(43, ".")), kGv1Bits);  // the frame waited, and is exact
}

// TL-11, FC-19: one flag, then +8 at once and with every eighth bit; never off, never a second
// flag.
TEST(Timeline, ReceiveLineStuckDominant) {
  ErrorRig rig;
  std::string sent;
  for (unsigned bit = 1; bit <= 300; ++bit) {  // SOF is bit 1
    sent += rig.play("0");
    if (bit < 6) {
      EXPECT_EQ(rig.rec(), 0u) << bit;
    } else if (bit < 13) {
      EXPECT_EQ(rig.rec(), 1u) << bit;
    } else if (bit <= 132) {
      EXPECT_EQ(rig.rec(), 9u + 8u * ((bit - 12) / 8)) << bit;  // 9@13, 17@20, 25@28
    } else {
      EXPECT_GE(rig.rec(), 128u) << bit;
    }
    EXPECT_EQ(rig.last().passive, bit >= 132) << bit;
  }
  EXPECT_EQ(sent, bits(rep(6, "1") + rep(6, "0") + rep(288, "1")));
  EXPECT_FALSE(rig.last().bus_off);
}

// TL-12, FC-20: eight for each dominant bit that is not seen; the last of 16 starts reaches 256.
TEST(Timeline, ReceiveLineStuckRecessive) {
  ErrorRig rig;
  rig.send(kGv1);
  unsigned starts = 0;
  unsigned previous = 0;
  for (unsigned bit = 0; bit < 1000 && !rig.last().bus_off; ++bit) {
    if (rig.field() == Field::kSof) ++starts;
    rig.play("R");
    if (!rig.last().bus_off) {
      EXPECT_TRUE(rig.tec() == previous || rig.tec() == previous + 8) << bit;
      previous = rig.tec();
    }
  }
  EXPECT_EQ(starts, 16u);
  EXPECT_EQ(previous, 248u);
  EXPECT_TRUE(rig.last().bus_off);
}

}  // namespace
}  // namespace vericansim
