// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Node model against the timelines of rule book 12a and the counter sequences of section 11, by
// hand.
#include <gtest/gtest.h>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using namespace model_bench;  // NOLINT: the bench exists for these tests

const std::string kUpToData = rep(22, ".");  // SOF and 21 more bits: the next one is a data bit

TEST(NodeModelTimeline, TL_01_ActiveTransmitterBitError) {
  NodeModel n = sender(kGv1);
  play(n, kUpToData);
  EXPECT_EQ(n.state().field, Field::kData);
  play(n, "!");
  EXPECT_EQ(n.events().error, NodeError::kBit0);
  EXPECT_TRUE(n.events().tx_fail);
  EXPECT_EQ(n.tec(), 8);
  EXPECT_EQ(play(n, rep(18, ".")),
            "000000"
            "11111111"
            "111"
            "0");
  EXPECT_EQ(n.tec(), 8);
}

TEST(NodeModelTimeline, TL_02_PassiveTransmitterBitError) {
  NodeModel n = sender(kGv1, 128);
  play(n, kUpToData + "!");
  EXPECT_EQ(play(n, rep(26, ".")),
            "111111"
            "11111111"
            "111"
            "11111111"
            "0");
  EXPECT_EQ(n.tec(), 136);
}

TEST(NodeModelTimeline, TL_03_NoAcknowledge) {
  NodeModel n = sender(kGv1);
  EXPECT_EQ(play(n, rep(44, ".")), kGv1Bits + "1");
  EXPECT_EQ(n.state().field, Field::kAck);
  play(n, ".");
  EXPECT_EQ(n.events().error, NodeError::kAck);
  EXPECT_EQ(play(n, rep(18, ".")),
            "000000"
            "11111111"
            "111"
            "0");  // SOF 18 bits after the slot
  EXPECT_EQ(n.tec(), 8);
}

TEST(NodeModelTimeline, TL_04_ReceiverCrcError) {
  NodeModel n = idle_node();
  std::string bad = kGv1Bits;
  bad.back() = '0';
  play(n, bad + "1");
  EXPECT_EQ(play(n, "01"), "11");  // no own acknowledge; r at the ACK delimiter
  EXPECT_EQ(n.events().error, NodeError::kCrc);
  EXPECT_EQ(n.rec(), 1);
  EXPECT_EQ(play(n, "......0"), "0000001");  // transmitter's flag lasts one bit longer
  EXPECT_EQ(n.rec(), 9);
  EXPECT_EQ(play(n, rep(11, "1")), rep(11, "1"));
  EXPECT_EQ(n.state().field, Field::kIdle);
}

TEST(NodeModelTimeline, TL_05_ReceiverFlagsOneBitEarly) {
  NodeModel n = idle_node();
  play(n, "00000");
  play(n, "0");  // error here: sixth d
  EXPECT_EQ(n.events().error, NodeError::kStuff);
  EXPECT_EQ(play(n, "0000000"), "0000001");
  EXPECT_EQ(n.rec(), 9);
  play(n, "1");  // DEL1
  EXPECT_EQ(n.state().field, Field::kDel);
  EXPECT_EQ(n.state().index, 0);
}

TEST(NodeModelTimeline, TL_06_OverloadAtEof7) {
  NodeModel n = idle_node();
  play(n, kGv1Bits + "1");
  EXPECT_EQ(play(n, "0"), "0");  // own acknowledge
  play(n,
       "1"
       "11111");
  EXPECT_FALSE(n.events().delivered);
  play(n, "1");  // EOF6
  EXPECT_TRUE(n.events().delivered);
  EXPECT_EQ(n.received(), kGv1);
  play(n, "0");  // EOF7
  EXPECT_TRUE(n.events().overload);
  EXPECT_EQ(n.events().error, NodeError::kNone);
  EXPECT_EQ(play(n, rep(17, ".")),
            "000000"
            "11111111"
            "111");
  EXPECT_EQ(n.state().field, Field::kIdle);
  EXPECT_EQ(n.rec(), 0);
}

TEST(NodeModelTimeline, TL_07_JoinedStart) {
  NodeModel n = idle_node();
  play(n, whole(kGv1) + "11");
  n.request({.id = 0x07F});  // 0000 1111111: fifth own bit is an r stuff bit (ST-07)
  EXPECT_EQ(play(n, "0"), "1");
  EXPECT_TRUE(n.events().started);
  EXPECT_EQ(n.role(), Role::kTransmitter);
  EXPECT_EQ(play(n, rep(13, ".")),
            "0000"
            "1"
            "1111"
            "0"
            "111");
  EXPECT_EQ(n.state().field, Field::kRtr);
}

TEST(NodeModelTimeline, TL_08_PassiveFlagOfUnequalBits) {
  NodeModel n = sender(kGv1, 128);
  play(n, kUpToData + "!");
  play(n,
       "00000"
       "11111"
       "000000");
  EXPECT_EQ(n.state().field, Field::kWait);
  play(n, "11111111");
  EXPECT_EQ(n.state().field, Field::kInt);
  play(n, "0");
  EXPECT_TRUE(n.events().overload);
  EXPECT_EQ(play(n, rep(7, ".")),
            "000000"
            "1");  // dominant although passive (OV-01)
  EXPECT_EQ(n.tec(), 136);
}

TEST(NodeModelTimeline, TL_09_SixDominantAfterAPassiveFlag) {
  NodeModel n = sender(kGv1, 128);
  play(n, kUpToData + "!" + "111111" + "000000");
  EXPECT_EQ(n.tec(), 136);
  EXPECT_EQ(play(n, rep(20, ".")), rep(19, "1") + "0");  // n+13..n+31 r, SOF at n+32
}

TEST(NodeModelTimeline, TL_10_BusOffAndRecovery) {
  NodeModel n = sender(kGv1, 248);
  play(n, kUpToData + "!");
  EXPECT_EQ(n.tec(), 256);
  EXPECT_TRUE(n.events().bus_off_entered);
  EXPECT_EQ(n.error_state(), ErrorState::kBusOff);
  EXPECT_EQ(play(n, rep(1407, ".")), rep(1407, "1"));
  EXPECT_EQ(n.error_state(), ErrorState::kBusOff);
  play(n, ".");
  EXPECT_TRUE(n.events().recovered);
  EXPECT_EQ(n.error_state(), ErrorState::kActive);
  EXPECT_EQ(n.tec(), 0);
  EXPECT_EQ(play(n, rep(44, ".")), kGv1Bits + "1");  // BO-05, BO-07
}

TEST(NodeModelTimeline, TL_11_StuckDominant) {  // also FC-19
  NodeModel n = idle_node();
  for (int bit = 1; bit <= 200; ++bit) {
    const std::string sent = play(n, "0");
    EXPECT_EQ(sent, bit >= 7 && bit <= 12 ? "0" : "1") << bit;
    const int after_flag = std::min(9 + 8 * ((bit - 12) / 8), 129);
    EXPECT_EQ(n.rec(), bit < 6 ? 0 : bit < 13 ? 1 : after_flag) << bit;
    EXPECT_EQ(n.error_state() == ErrorState::kPassive, bit >= 132) << bit;
  }
}

TEST(NodeModelTimeline, TL_12_StuckRecessive) {  // also FC-20
  NodeModel n = sender(kGv1);
  for (int i = 1; i <= 17; ++i) {  // SOF, then each bit of the active flags
    EXPECT_EQ(play(n, "1"), "0") << i;
    EXPECT_EQ(n.tec(), 8 * i);
  }
  int starts = 1;
  for (int bit = 0; bit < 1000 && n.error_state() != ErrorState::kBusOff; ++bit) {
    if (n.drive() == Level::kDominant) {
      ++starts;
      EXPECT_EQ(n.state().field, Field::kSof);
    }
    play(n, "1");
  }
  EXPECT_EQ(starts, 16);
  EXPECT_EQ(n.tec(), 256);
}

TEST(NodeModelTimeline, FC_18_LoneTransmitter) {
  NodeModel n = sender(kGv1);
  std::vector<int> starts;
  for (int bit = 0; bit < 43 * 40; ++bit) {
    if (n.state().field == Field::kSof) starts.push_back(bit);
    play(n, ".");
    EXPECT_NE(n.error_state(), ErrorState::kBusOff);
  }
  ASSERT_GT(starts.size(), 20u);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    EXPECT_EQ(starts[i] - starts[i - 1], 43 + 2 + (i < 16 ? 17 : 25)) << i;
  }
  EXPECT_EQ(n.tec(), 128);
}

TEST(NodeModelTimeline, MX_29_CorruptedActiveFlag) {
  NodeModel t = sender(kGv1);
  play(t, kUpToData + "!");
  play(t, rep(15, "1"));
  EXPECT_EQ(t.tec(), 128);
  EXPECT_EQ(play(t, "1"), "0");  // the 16th, still in an active flag
  EXPECT_EQ(t.tec(), 136);
  EXPECT_EQ(play(t, "1"), "1");  // now passive

  NodeModel r = idle_node();
  play(r, "000000");
  play(r, rep(16, "1"));
  EXPECT_EQ(r.rec(), 129);
  EXPECT_EQ(play(r, "1"), "0");
  EXPECT_GE(r.rec(), 128);
  EXPECT_EQ(play(r, "1"), "1");
}

TEST(NodeModelTimeline, MX_30_DominantBitsAfterAPassiveFlag) {
  const int expected[][2] = {{1, 0}, {6, 0}, {7, 0}, {8, 8}, {9, 8}, {16, 16}};
  for (const auto &[count, extra] : expected) {
    NodeModel n = sender(kGv1, 128);
    play(n, kUpToData + "!" + "111111" + rep(count, "0"));
    EXPECT_EQ(n.tec(), 136 + extra) << count;
  }
}

TEST(NodeModelTimeline, FC_08_SixteenDominantAfterTheFlag) {
  NodeModel r = idle_node();
  play(r,
       "000000"
       "000000" +
           rep(16, "0"));
  EXPECT_EQ(r.rec(), 25);
  NodeModel t = sender(kGv1);
  play(t, kUpToData + "!" + "000000" + rep(16, "0"));
  EXPECT_EQ(t.tec(), 24);
  EXPECT_EQ(t.rec(), 0);      // FC-01, FC-04
  NodeModel o = idle_node();  // after an overload flag: two steps, no FC-04
  play(o, whole(kGv1) + "0" + "000000" + rep(23, "0"));
  EXPECT_EQ(o.rec(), 16);
}

}  // namespace
}  // namespace vericansim
