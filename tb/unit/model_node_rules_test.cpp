// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Node model, one rule at a time: formats, interframe space, errors, counters, bus-off, modes.
#include <gtest/gtest.h>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using namespace model_bench;  // NOLINT: the bench exists for these tests

const std::string kFlagAndDelimiter = rep(6, "0") + rep(8, "1");

/// A receiver that was passive by its REC, or another node, after one good frame; next bit is INT1.
NodeModel after_reception(int tec = 0, int rec = 0) {
  NodeModel n = idle_node(tec, rec);
  play(n, whole(kGv1));
  return n;
}

/// A transmitter after one good own frame; next bit is INT1.
NodeModel after_transmission(int tec) {
  NodeModel n = sender(kGv1, tec);
  play(n, rep(44, ".") + "0" + rep(8, "1"));
  EXPECT_TRUE(n.events().sent_ok);
  return n;
}

TEST(NodeModelFormat, ReservedBitsOfEitherLevelAreTaken) {  // FF-05
  const Frame f{.id = 0x1234567, .extended = true, .dlc = 1, .data = {0xC3}};
  for (unsigned mask = 0; mask < 8; ++mask) {
    const EncodeOptions o{.r0 = static_cast<Level>(mask & 1),
                          .r1 = static_cast<Level>((mask >> 1) & 1),
                          .srr = static_cast<Level>((mask >> 2) & 1)};
    NodeModel n = idle_node();
    play(n, to_delimiter(f, o));
    EXPECT_EQ(play(n, "0" + rep(7, "1")), "0" + rep(7, "1")) << mask;
    EXPECT_TRUE(n.events().delivered) << mask;
    EXPECT_EQ(n.received(), f);
  }
}

TEST(NodeModelFormat, FdToleranceLeavesTheFrame) {  // FF-06, IN-05, PF-20
  for (const bool extended : {false, true}) {
    const Frame f{.id = 0x155, .extended = extended};
    const EncodeOptions o{.r0 = extended ? Level::kDominant : Level::kRecessive,
                          .r1 = Level::kRecessive};
    NodeModel n = idle_node(3, 7, {.fd_tolerant = true});
    play(n, whole(f, o));
    EXPECT_EQ(n.state().field, Field::kInteg);
    EXPECT_EQ(n.rec(), 7);
    EXPECT_EQ(n.tec(), 3);
    play(n, "111");  // ACK delimiter, EOF and intermission are the eleven bits
    EXPECT_EQ(n.state().field, Field::kIdle);
  }
}

TEST(NodeModelFormat, LongDlcAndRemoteFrames) {  // FF-03, FF-08, FF-09
  for (std::uint8_t dlc = 0; dlc <= 15; ++dlc) {
    for (const bool remote : {false, true}) {
      Frame f{.id = 0x2AA, .remote = remote, .dlc = dlc};
      for (unsigned i = 0; i < f.payload_size(); ++i) f.data[i] = static_cast<std::uint8_t>(i + 1);
      NodeModel r = idle_node();
      play(r, whole(f).substr(0, whole(f).size() - 1));
      EXPECT_TRUE(r.events().delivered);
      EXPECT_EQ(r.received(), f);
      NodeModel t = sender(f);
      EXPECT_EQ(play(t, rep(static_cast<int>(to_delimiter(f).size()), ".")), to_delimiter(f));
    }
  }
}

TEST(NodeModelInterframe, PendingFrameStartsAfterInt3) {  // IF-02, IF-03
  NodeModel n = after_reception();
  play(n, "11");
  n.request(kGv1);
  EXPECT_EQ(play(n, ".."), "10");
}

TEST(NodeModelInterframe, SuspendOfAPassiveTransmitter) {  // IF-08, IF-11
  for (const int tec : {128, 129, 200}) {
    NodeModel n = after_transmission(tec);
    n.request(kGv1);
    const bool suspend = tec > 128;  // 128 became 127 by the success
    EXPECT_EQ(play(n, rep(12, ".")), suspend ? rep(11, "1") + "0" : "111" + kGv1Bits.substr(0, 9));
  }
}

TEST(NodeModelInterframe, NoSuspendForAPassiveReceiver) {  // IF-09
  NodeModel n = after_reception(200, 0);
  n.request(kGv1);
  EXPECT_EQ(play(n, "...."), "1110");
}

TEST(NodeModelInterframe, DominantBitsInSuspendAreAForeignSof) {  // IF-10, MX-15
  for (int k = 0; k < 9; ++k) {                                   // INT3 and suspend 1..8
    NodeModel n = after_transmission(200);
    n.request({.id = 0});
    play(n, rep(2 + k, ".") + "0");
    EXPECT_EQ(n.role(), Role::kReceiver);
    EXPECT_TRUE(n.events().started);
    EXPECT_EQ(play(n, rep(6, ".")), rep(6, "1")) << k;
    EXPECT_EQ(n.events().error, NodeError::kStuff);
    EXPECT_EQ(n.rec(), 1);
  }
}

TEST(NodeModelInterframe, OverloadAtInt1AndInt2) {  // IF-04, OV-01, MX-13, PF-49
  for (const int tec : {0, 200}) {
    for (const std::string first : {"0", "10"}) {
      NodeModel n = after_reception(tec);
      play(n, first);
      EXPECT_TRUE(n.events().overload);
      EXPECT_EQ(play(n, rep(17, ".")), kFlagAndDelimiter + "111");
      EXPECT_EQ(n.state().field, Field::kIdle);
      EXPECT_EQ(n.tec(), tec);
    }
  }
}

TEST(NodeModelInterframe, JoinsFromIdle) {  // IF-14
  NodeModel n = idle_node();
  n.request({.id = 0x7FF});
  EXPECT_EQ(play(n, "0."), "11");
  EXPECT_EQ(n.role(), Role::kTransmitter);
}

TEST(NodeModelErrors, ReceiverAcknowledgeOverwritten) {  // ED-07
  NodeModel n = idle_node(0, 5);
  play(n, to_delimiter(kGv1));
  EXPECT_EQ(play(n, "1"), "0");
  EXPECT_EQ(n.events().error, NodeError::kBit0);
  EXPECT_EQ(n.rec(), 6);
  EXPECT_EQ(play(n, "."), "0");
}

TEST(NodeModelErrors, LaterErrorAfterTheSetBack) {  // FC-10, FC-10a, PF-50
  const int cases[][3] = {{0, 0, 1}, {9, 8, 9}, {127, 126, 127}, {128, 127, 128}, {130, 127, 128}};
  for (const auto &[before, slot, after] : cases) {
    NodeModel n = idle_node(0, before);
    play(n, to_delimiter(kGv1) + "0");
    EXPECT_EQ(n.rec(), slot);
    play(n, "110");  // EOF2
    EXPECT_EQ(n.events().error, NodeError::kForm);
    EXPECT_EQ(n.rec(), after);
    EXPECT_EQ(play(n, "."), "0") << before;  // active at detection (MX-10)
  }
}

TEST(NodeModelErrors, FlagTypeIsThatOfTheStateBefore) {  // EF-05, PF-47
  NodeModel n = idle_node(0, 127);
  play(n, "000000");
  EXPECT_EQ(n.rec(), 128);
  EXPECT_EQ(play(n, rep(18, ".")), kFlagAndDelimiter + "1111");
  play(n, "000000");
  EXPECT_EQ(play(n, "."), "1");
}

TEST(NodeModelErrors, DominantInAPassiveFlagCountsNothing) {  // ED-04, PF-33
  NodeModel n = idle_node(0, 127);
  n.preset_counters(130, 20);
  play(n, "00000010");
  EXPECT_EQ(n.rec(), 21);
}

TEST(NodeModelErrors, WithheldAcknowledgeStep) {  // FC-05, FC-05a, PF-43
  for (int at = 0; at < 6; ++at) {
    NodeModel n = sender(kGv1, 128);
    play(n, rep(45, "."));
    EXPECT_EQ(n.events().error, NodeError::kAck);
    EXPECT_EQ(n.tec(), 128);
    play(n, rep(at, "1") + "0");
    EXPECT_EQ(n.tec(), 136);
    play(n, "00");
    EXPECT_EQ(n.tec(), 136);  // once
  }
  NodeModel n = sender(kGv1, 128);
  play(n, rep(45, ".") + rep(6, "1") + "0");  // after the flag's end: not counted
  EXPECT_EQ(n.tec(), 128);
}

TEST(NodeModelErrors, StuffBitInArbitration) {  // AR-04, FC-05b, PF-09, PF-51
  NodeModel n = sender({.id = 0x078});          // SOF 0000: an r stuff bit is the sixth bit
  play(n, ".....!");
  EXPECT_EQ(n.events().error, NodeError::kStuff);
  EXPECT_EQ(n.role(), Role::kTransmitter);
  EXPECT_EQ(n.tec(), 0);
  play(n, "..!");  // bit error in the flag counts
  EXPECT_EQ(n.tec(), 8);
  play(n, "......00000000");
  EXPECT_EQ(n.tec(), 16);
}

TEST(NodeModelErrors, StuffBitRightAfterTheRtr) {  // FC-05b: 0 at the base IDE, 8 at r1
  NodeModel b = sender({.id = 0x010});             // four d at the end and RTR make five
  while (!(b.state().field == Field::kIde && b.state().is_stuff)) {
    ASSERT_NE(b.state().field, Field::kR0);
    play(b, ".");
  }
  EXPECT_EQ(b.internal_level(), Level::kRecessive);
  play(b, "!");
  EXPECT_EQ(b.events().error, NodeError::kStuff);
  EXPECT_EQ(b.tec(), 0);

  NodeModel e = sender({.id = 0x10, .extended = true});
  while (!(e.state().field == Field::kR1 && e.state().is_stuff)) {
    ASSERT_NE(e.state().field, Field::kR0);
    play(e, ".");
  }
  play(e, "!");
  EXPECT_EQ(e.events().error, NodeError::kBit1);
  EXPECT_EQ(e.tec(), 8);
}

TEST(NodeModelErrors, DelimiterViolations) {  // EF-09, FC-16, MX-20, PF-10, PF-36
  for (int del = 2; del <= 8; ++del) {
    NodeModel r = idle_node();
    play(r, "000000......" + rep(del - 1, "1") + "0");
    EXPECT_EQ(r.rec(), del < 8 ? 2 : 1);
    EXPECT_EQ(r.events().overload, del == 8);
    NodeModel t = sender(kGv1, 124);
    play(t, ".!......" + rep(del - 1, "1") + "0");
    EXPECT_EQ(t.tec(), del < 8 ? 140 : 132);
    EXPECT_EQ(play(t, "."), del < 8 ? "1" : "0");
  }
}

TEST(NodeModelErrors, BitErrorInOverloadFlag) {  // ED-21, MX-21
  for (int bit = 0; bit < 6; ++bit) {
    NodeModel r = after_reception();
    play(r, "0" + rep(bit, ".") + "!");
    EXPECT_EQ(r.rec(), 8);
    EXPECT_EQ(r.state().field, Field::kErrFlag);
    NodeModel t = after_transmission(1);
    play(t, "0" + rep(bit, ".") + "!");
    EXPECT_EQ(t.tec(), 8);
  }
}

TEST(NodeModelErrors, DominantEof7) {  // ED-10, ED-11
  NodeModel t = sender(kGv1);
  play(t, rep(44, ".") + "0" + rep(7, "1") + "0");
  EXPECT_EQ(t.events().error, NodeError::kForm);
  EXPECT_TRUE(t.events().tx_fail);
  EXPECT_TRUE(t.pending());
}

TEST(NodeModelErrors, IsolatedDominantBit) {  // IF-15
  NodeModel n = idle_node();
  play(n, "011111");
  EXPECT_EQ(n.events().error, NodeError::kNone);
  play(n, "1");
  EXPECT_EQ(n.events().error, NodeError::kStuff);
  EXPECT_EQ(n.rec(), 1);
}

TEST(NodeModelIntegration, ElevenRecessiveBits) {  // IN-01, IN-03, IN-04, PF-27
  NodeModel n;
  n.request(kGv1);
  EXPECT_EQ(play(n, rep(10, "1") + "0" + rep(10, "1") + "0" + rep(11, "1") + "."),
            rep(33, "1") + "0");
}

TEST(NodeModelBusOff, SequencesDoNotOverlap) {  // BO-02, PF-38
  NodeModel n = sender(kGv1, 248);
  play(n, "!");
  play(n, rep(10, "1") + "0" + rep(21, "1") + "0" + rep(126, rep(11, "1") + "0"));
  EXPECT_EQ(n.error_state(), ErrorState::kBusOff);
  EXPECT_EQ(n.recovery_sequences(), 127);
  play(n, rep(11, "1"));
  EXPECT_EQ(n.error_state(), ErrorState::kActive);
  EXPECT_EQ(n.rec(), 0);
}

TEST(NodeModelBusOff, HeldUntilReleased) {  // BO-03
  NodeModel n = sender(kGv1, 248, 0, {.boff_rec = true});
  play(n, "!" + rep(128 * 11 + 25, "1"));
  EXPECT_EQ(n.error_state(), ErrorState::kBusOff);
  n.config().boff_rec = false;
  play(n, rep(7, "1"));  // 25 = 2 * 11 + 3: the run is complete one bit later
  EXPECT_EQ(n.error_state(), ErrorState::kBusOff);
  play(n, "1");
  EXPECT_EQ(n.error_state(), ErrorState::kActive);
}

TEST(NodeModelBusOff, Threshold) {  // FC-13, PF-44
  NodeModel n = after_transmission(248);
  EXPECT_EQ(n.tec(), 247);
  n.request(kGv1);
  play(n, rep(11, ".") + "!");
  EXPECT_EQ(n.tec(), 255);
  EXPECT_EQ(n.error_state(), ErrorState::kPassive);
  play(n, rep(25, ".") + "!");
  EXPECT_EQ(n.error_state(), ErrorState::kBusOff);
}

TEST(NodeModelModes, ListenOnly) {  // MO-01, MO-03, FC-22
  NodeModel n = idle_node(50, 60, {.listen_only = true});
  n.request(kGv1);
  EXPECT_EQ(play(n, to_delimiter(kGv1) + "11111111"), rep(52, "1"));  // nobody acknowledges
  EXPECT_TRUE(n.events().delivered);
  EXPECT_EQ(play(n, "10000000" + rep(11, "1")), rep(19, "1"));
  EXPECT_EQ(n.state().field, Field::kIdle);
  EXPECT_EQ(play(n, "0000000000000000" + rep(11, "1")), rep(27, "1"));
  EXPECT_EQ(n.state().field, Field::kIdle);
  EXPECT_EQ(n.tec(), 50);
  EXPECT_EQ(n.rec(), 60);
}

TEST(NodeModelModes, LoopBack) {  // MO-04, MO-06
  NodeModel n = sender(kGv1, 1, 0, {.loop_back = true});
  EXPECT_EQ(play(n, rep(52, "0")), rep(52, "1"));  // deaf and mute
  EXPECT_TRUE(n.events().delivered);
  EXPECT_EQ(n.received(), kGv1);
  play(n, "0");
  EXPECT_TRUE(n.events().sent_ok);
  EXPECT_FALSE(n.pending());
  EXPECT_EQ(n.tec(), 0);
}

TEST(NodeModelModes, OneShotAndCancel) {  // MO-09; and a frame taken back
  NodeModel o = sender({.id = 0x7FF}, 0, 0, {.one_shot = true});
  play(o, ".!");
  EXPECT_TRUE(o.events().lost_arbitration && o.events().tx_fail);
  EXPECT_FALSE(o.pending());
  NodeModel c = sender(kGv1);
  play(c, "...");
  c.cancel();
  play(c, rep(41, ".") + "0" + rep(8, "1"));
  EXPECT_TRUE(c.events().sent_ok);
  NodeModel f = sender(kGv1);
  f.cancel();
  play(f, "!");
  EXPECT_TRUE(f.events().tx_fail);
  EXPECT_EQ(play(f, rep(30, ".")).substr(6), rep(24, "1"));
}

TEST(NodeModelModes, RequestIsCopiedAtTheStart) {  // FF-12
  NodeModel n = sender(kGv1);
  play(n, "...");
  n.request({.id = 0x555});
  EXPECT_EQ(play(n, rep(40, ".")), kGv1Bits.substr(3));
  play(n, "10" + rep(8, "1"));
  EXPECT_TRUE(n.events().sent_ok);
  EXPECT_TRUE(n.pending());  // the newer one
}

}  // namespace
}  // namespace vericansim
