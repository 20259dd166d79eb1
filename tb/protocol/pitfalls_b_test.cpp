// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 18, second half: mistakes of other controllers in error handling, each as a scenario.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::to_delimiter;
using model_bench::whole;

// PF-33, EF-04, ED-04: passive receiver, dominant at flag bit 2: REC+1 only. And so for every bit.
TEST(PitfallB, DominantBitInAPassiveFlagCountsNothing) {
  for (int n = 1; n <= 6; ++n) {
    ErrorRig r({.tec = 128, .rec = 10});
    r.play("000000" + rep(n - 1, "1") + "0" + rep(6, "1"));
    EXPECT_EQ(r.rec(), 11u) << n;
    ErrorRig t({.tec = 128, .rec = 10});
    t.send(kGv1);
    t.play("!" + rep(n - 1, "1") + "0" + rep(6, "1"));
    EXPECT_EQ(t.tec(), 136u) << n;
    EXPECT_EQ(t.field(), Field::kWait) << n;
  }
}

// PF-34, FC-02, AR-04: only transmitters are exempt: a receiver's broken stuff bit counts one.
TEST(PitfallB, ReceiversHaveNoArbitrationExemption) {
  for (const Counters counters : {kActive, kPassive}) {
    ErrorRig rig(counters);
    rig.play("00000 0");  // r stuff bit of ID 00F -> d
    EXPECT_EQ(rig.last().errors, kErrStuff);
    EXPECT_EQ(rig.rec(), 1u);
    EXPECT_EQ(rig.play("......"), flag_of(counters));
    ErrorRig loser(counters);
    loser.send({.id = 0x7FF});
    loser.play("00 000 0");  // lost at ID28, then a receiver like all others
    EXPECT_EQ(loser.rec(), 1u);
    EXPECT_EQ(loser.tec(), counters.tec);
  }
}

// PF-35, ED-03: an acknowledge is no bit error, be it of one node or of many.
TEST(PitfallB, ReceivingAnAcknowledgeIsNoError) {
  for (const Counters counters : {kActive, kPassive, kPassiveByRec}) {
    ErrorRig rig(counters);
    rig.transmit(kGv1);
    EXPECT_EQ(rig.dut().events().errors, 0);
    EXPECT_EQ(rig.sent(), 1u);
  }
}

// PF-36, OV-01, OV-03, IF-05: dominant in the 8th delimiter bit and in the bit after it are both
// overload conditions; three bits later it is a start of frame.
TEST(PitfallB, OverloadDelimiterHasEightBits) {
  for (const Counters counters : {kActive, kPassive}) {
    for (const char *gap : {"1111111", "11111111"}) {
      ErrorRig rig(counters);
      rig.receive(kGv1);
      rig.play("0 ......" + std::string{gap} + "0");
      EXPECT_EQ(rig.play("......"), kOverloadFlag) << gap;
      EXPECT_EQ(rig.dut().events().errors, 0) << gap;
      rig.play("11111111 11");
      EXPECT_EQ(rig.receive(kGv1), rep(44, "1") + "0" + rep(8, "1")) << gap;
      EXPECT_EQ(rig.delivered(), 2u) << gap;
    }
  }
}

// PF-37, FC-08: long dominant levels after any of the three flags, both roles.
TEST(PitfallB, OverlongDominantAfterAFlagCounts) {
  ErrorRig active;
  active.play("000000 ......" + rep(8, "0"));
  EXPECT_EQ(active.rec(), 1u + 8u + 8u);
  ErrorRig passive({.tec = 130, .rec = 2});
  passive.play("000000 000000" + rep(16, "0"));
  EXPECT_EQ(passive.rec(), 3u + 8u + 16u);
  ErrorRig overload({.tec = 3, .rec = 2});
  overload.transmit(kGv1);
  overload.play("0 ......" + rep(8, "0"));
  EXPECT_EQ(overload.tec(), 10u);
  ErrorRig transmitter({.tec = 130});
  transmitter.send(kGv1);
  transmitter.play("! 000000" + rep(17, "0"));
  EXPECT_EQ(transmitter.tec(), 138u + 16u);
}

// PF-38, BO-02, BO-04: 10 r, d, 21 r, d, 126 x (11 r, d): still off; eleven more: on.
TEST(PitfallB, RecoveryCountIsExact) {
  ErrorRig rig({.tec = 248});
  rig.send(kGv1);
  rig.play("!");
  rig.play(rep(10, "1") + "0" + rep(21, "1") + "0" + rep(126, rep(11, "1") + "0"));
  EXPECT_TRUE(rig.last().bus_off);
  rig.play(rep(10, "1"));
  EXPECT_TRUE(rig.last().bus_off);
  rig.play("1");
  EXPECT_FALSE(rig.last().bus_off);
}

// PF-39, IN-05, FF-06: a protocol exception and the integration after it leave the counters alone.
TEST(PitfallB, ProtocolExceptionKeepsTheCounters) {
  CoreConfig config = CoreBench::default_config();
  config.fd_tolerant = true;
  for (const Counters counters : {Counters{.tec = 17, .rec = 33}, Counters{.tec = 140, .rec = 2}}) {
    ErrorRig rig(counters, config);
    EXPECT_EQ(rig.play("0 00100100011 0 0 1 00000000 1 000000" + rep(11, "1")), rep(41, "1"));
    EXPECT_EQ(rig.field(), Field::kIdle);
    EXPECT_EQ(rig.tec(), counters.tec);
    EXPECT_EQ(rig.rec(), counters.rec);
    rig.receive(kGv1);
    EXPECT_EQ(rig.delivered(), 1u);
  }
}

// PF-40, MO-01: a listener and acknowledges that others give, or do not.
TEST(PitfallB, ListenerDoesNotJudgeForeignAcknowledges) {
  CoreConfig config = CoreBench::default_config();
  config.listen_only = true;
  for (const char *slot : {"0", "1"}) {
    ErrorRig rig(kActive, config);
    EXPECT_EQ(rig.play(kGv1Bits + "1" + slot + "1 1111111"), rep(53, "1"));
    EXPECT_EQ(rig.dut().events().errors, 0);
    EXPECT_EQ(rig.delivered(), 1u);
  }
}

// PF-41, ED-05, IF-10: a foreign start at INT3 (n = 0) or in any suspend bit: no flag, and the
// frame is received although an own one waits.
TEST(PitfallB, SuspendTimeHasNoBitErrors) {
  for (int n = 0; n <= 8; ++n) {
    ErrorRig rig({.tec = 140});
    rig.transmit(kGv1);
    rig.request({.id = 0x001});
    rig.play("11" + rep(n, "1"));
    rig.dut().clear_events();
    EXPECT_EQ(rig.receive(kGv1), rep(44, "1") + "0" + rep(8, "1")) << n;
    EXPECT_EQ(rig.dut().events().errors, 0) << n;
    EXPECT_EQ(rig.delivered(), 1u) << n;
  }
}

// PF-43, FC-05a: TEC 128, no acknowledge, dominant at flag bit 6.
TEST(PitfallB, WithheldStepOfAPassiveAckErrorIsAdded) {
  ErrorRig rig(kPassive);
  rig.send(kGv1);
  rig.play(rep(45, ".") + "11111");
  EXPECT_EQ(rig.tec(), 128u);
  rig.play("0");
  EXPECT_EQ(rig.tec(), 136u);
  rig.play("00000 1");
  EXPECT_EQ(rig.tec(), 136u);
  EXPECT_EQ(rig.field(), Field::kDel);
}

// PF-44, FC-13, FC-01, ST-06, FC-09: 247 to 255 stays passive; only the counter of the role moves
// by a long dominant level; stuff errors exist in arbitration; one step down a frame.
TEST(PitfallB, TransmitCounterAt255IsStillPassive) {
  ErrorRig rig({.tec = 247, .rec = 3});
  rig.send(kGv1);
  rig.play("!");
  EXPECT_EQ(rig.tec(), 255u);
  EXPECT_TRUE(rig.last().passive);
  EXPECT_FALSE(rig.last().bus_off);
  ErrorRig both({.tec = 10, .rec = 20});
  both.send(kGv1);
  both.play("! ......" + rep(8, "0"));
  EXPECT_EQ(both.tec(), 26u);
  EXPECT_EQ(both.rec(), 20u);
  ErrorRig stuff({.tec = 10, .rec = 20});
  stuff.play("000000");
  EXPECT_EQ(stuff.last().errors, kErrStuff);
  ErrorRig good({.tec = 10, .rec = 20});
  good.transmit(kGv1);
  EXPECT_EQ(good.tec(), 9u);
  good.play("111");
  good.receive(kGv1);
  EXPECT_EQ(good.rec(), 19u);
  EXPECT_EQ(good.tec(), 9u);
}

// PF-45, FF-05, EF-01: extended frame with recessive r1, r0: acknowledged and delivered.
TEST(PitfallB, RecessiveReservedBitsAreAccepted) {
  const Frame frame{.id = 0x12345678, .extended = true, .dlc = 2, .data = {0xA5, 0x5A}};
  for (const Level r1 : {Level::kDominant, Level::kRecessive}) {
    for (const Level r0 : {Level::kDominant, Level::kRecessive}) {
      for (const Level srr : {Level::kDominant, Level::kRecessive}) {
        ErrorRig rig;
        rig.play(whole(frame, {.r0 = r0, .r1 = r1, .srr = srr}));
        ASSERT_EQ(rig.delivered(), 1u);
        EXPECT_EQ(rig.dut().received()[0], frame);
        EXPECT_EQ(rig.dut().events().errors, 0);
      }
    }
  }
}

// PF-46, FC-11, FC-12: 127 and 128, on the way up and on the way down.
TEST(PitfallB, PassiveLimitsAre127And128) {
  ErrorRig up({.rec = 126});
  up.play("000000 ......");
  EXPECT_EQ(up.rec(), 127u);
  EXPECT_FALSE(up.last().passive);
  up.play(rep(11, ".") + "000000");
  EXPECT_TRUE(up.last().passive);
  ErrorRig down({.tec = 129});
  down.transmit(kGv1);
  EXPECT_EQ(down.tec(), 128u);
  EXPECT_TRUE(down.last().passive);
  down.play(rep(11, "."));
  down.transmit(kGv1);
  EXPECT_EQ(down.tec(), 127u);
  EXPECT_FALSE(down.last().passive);
}

// PF-47, EF-05: REC 127 and TEC 127: the flag of the error that reaches 128 is dominant.
TEST(PitfallB, ErrorThatReaches128FlagsActively) {
  ErrorRig r({.rec = 127});
  EXPECT_EQ(r.play("000000 ......"), bits("111111 000000"));
  for (const std::uint8_t tec : {std::uint8_t{120}, std::uint8_t{127}}) {
    ErrorRig t({.tec = tec});
    t.send(kGv1);
    EXPECT_EQ(t.play("! ......"), bits("0 000000"));
  }
}

// PF-48, EF-02, EF-03, EF-10: 3 r, 6 d, then 8 + 2 r: INT3 is next, and a start there is one.
TEST(PitfallB, PassiveFlagIsNotSixFixedBits) {
  for (const bool transmitter : {false, true}) {
    ErrorRig rig({.tec = 136});
    if (transmitter) rig.send(kGv1);
    rig.play(transmitter ? "!" : "000000");
    rig.play("111 000000 11111111 11");
    rig.dut().cancel();
    rig.judge.cancel(0);
    EXPECT_EQ(rig.receive(kGv1), rep(44, "1") + "0" + rep(8, "1"));
    EXPECT_EQ(rig.delivered(), 1u);
  }
}

// PF-49, OV-01: TEC 128, dominant at INT1: six dominant bits.
TEST(PitfallB, PassiveNodeSendsADominantOverloadFlag) {
  for (const bool own : {false, true}) {
    ErrorRig rig({.tec = 136});
    own ? rig.transmit(kGv1) : rig.receive(kGv1);
    rig.play("0");
    EXPECT_EQ(rig.play("......."), bits("000000 1"));
  }
}

// PF-50, FC-10, FC-10a: REC 9, dominant EOF3: 9, not 10; 8 from the ACK slot on.
TEST(PitfallB, ReceiveCounterStepsAtTheAckSlot) {
  ErrorRig rig({.rec = 9});
  rig.play(kGv1Bits + "1 0");
  EXPECT_EQ(rig.rec(), 8u);
  rig.play("1 11 0");
  EXPECT_EQ(rig.rec(), 9u);
}

// PF-51, AR-04: ID 078: its first recessive stuff bit made dominant: a flag, no reception, a retry
// as transmitter. In 0x078 that is a dominant one, so 0x00F stands beside it.
TEST(PitfallB, BrokenOwnStuffBitIsNoLostArbitration) {
  for (const Counters counters : {kActive, kPassive}) {
    ErrorRig rig(counters);
    rig.send({.id = 0x00F});
    rig.play(".....0");
    EXPECT_EQ(rig.last().errors, kErrStuff);
    EXPECT_TRUE(rig.last().transmitter);
    EXPECT_EQ(rig.tec(), counters.tec);
    EXPECT_EQ(rig.play("......"), flag_of(counters));
    EXPECT_EQ(rig.play("11111111 111" + suspend_of(counters)),
              kDelimiter + kIntermission + suspend_of(counters));
    EXPECT_EQ(rig.field(), Field::kSof);
  }
}

// PF-52, AK-01: the acknowledge depends on the CRC alone: given to any frame, whatever the error
// state, a pending request or a frame like our own; never with a wrong CRC.
TEST(PitfallB, AcknowledgeDependsOnTheCrcAlone) {
  for (const Counters counters : {kActive, kPassive, kPassiveByRec}) {
    ErrorRig rig(counters);
    for (int n = 0; n < 70; ++n) {  // nobody takes the frames away
      EXPECT_EQ(rig.receive(kGv1), rep(44, "1") + "0" + rep(8, "1")) << n;
      rig.play("111");
    }
    std::string bad = kGv1Bits;
    bad.back() = '0';
    EXPECT_EQ(rig.play(bad + "1 0"), rep(45, "1"));
  }
}

// PF-55, VA-01: after an error at EOF6 nothing is delivered, and the node goes on to flag.
TEST(PitfallB, NothingIsDeliveredAfterAnErrorInEof6) {
  for (const Counters counters : {kActive, kPassive}) {
    ErrorRig rig(counters);
    rig.play(kGv1Bits + "1 0 1 11111 0");
    EXPECT_EQ(rig.last().errors, kErrForm);
    EXPECT_EQ(rig.play("......"), flag_of(counters));
    rig.play(rep(30, "."));
    EXPECT_EQ(rig.delivered(), 0u);
  }
}

}  // namespace
}  // namespace vericansim
