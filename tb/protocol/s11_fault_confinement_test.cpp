// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 11, the steps of the counters: each one by number, at its bit, in all error states.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

class Confinement : public ::testing::TestWithParam<Counters> {
 protected:
  Confinement() : rig{GetParam()} {}
  [[nodiscard]] unsigned tec() const { return GetParam().tec; }
  [[nodiscard]] unsigned rec() const { return GetParam().rec; }
  [[nodiscard]] bool passive() const { return GetParam().passive(); }
  // The flag after an error as the DUT and the bus show it, of dominant bits in any state.
  [[nodiscard]] std::string flag_seen() const { return passive() ? "000000" : "......"; }
  void expect_counters(unsigned tec_step, unsigned rec_step) {
    EXPECT_EQ(rig.tec(), tec() + tec_step);
    rig.expect_rec(rec(), rec_step);
  }

  ErrorRig rig;
};

INSTANTIATE_TEST_SUITE_P(Counters, Confinement,
                         ::testing::Values(Counters{}, Counters{.tec = 40, .rec = 30},
                                           Counters{.tec = 128}, Counters{.rec = 128},
                                           Counters{.tec = 150, .rec = 140}));

// FC-01, FC-02, FC-05: an error counts in one counter only, that of the role.
TEST_P(Confinement, RoleDecidesWhichCounterMoves) {
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!");
  expect_counters(8, 0);
  rig.dut().cancel();
  rig.judge.cancel(0);
  rig.play(rep(30, "."));
  rig.play("000000");
  expect_counters(8, 1);
}

// FC-03, FC-02: at the sample point of the bad bit, not before and not with the flag.
TEST_P(Confinement, CountersMoveAtTheBadBit) {
  rig.play("00000");
  expect_counters(0, 0);
  rig.play("0");
  expect_counters(0, 1);
  rig.play(rep(17, "."));
  expect_counters(0, 1);
}

// FC-03, ED-20: a CRC error counts at the ACK delimiter or with the start of the flag.
TEST_P(Confinement, CrcErrorCountsAtTheAckDelimiter) {
  std::string bad = kGv1Bits;
  bad.back() = '0';
  rig.play(bad + "1 0");
  expect_counters(0, 0);
  rig.play("1 .");
  expect_counters(0, 1);
}

// FC-04, PF-33: eight for the first dominant bit after the flag, once; also after a passive flag.
TEST_P(Confinement, DominantBitAfterTheReceiversFlagCountsEightOnce) {
  rig.play("000000" + flag_seen());
  expect_counters(0, 1);
  rig.play("0");
  expect_counters(0, 9);
  rig.play("000000");  // 7 in all
  expect_counters(0, 9);
}

// FC-05: every error of a transmitter in a frame counts eight.
TEST_P(Confinement, ErrorOfATransmitterCountsEight) {
  rig.send(kGv1);
  rig.play("!");  // SOF
  expect_counters(8, 0);
  rig.play(rep(6 + 8 + 3 + (passive() ? 8 : 0), "."));
  EXPECT_EQ(rig.field(), Field::kSof);
  rig.play(rep(43, ".") + "0");  // CRC delimiter
  expect_counters(16, 0);
}

// FC-05, FC-05a, FC-05c, PF-43: without an acknowledge; each bit of the passive flag dominant once.
TEST_P(Confinement, MissingAcknowledge) {
  for (int n = 1; n <= 6; ++n) {
    ErrorRig fresh(GetParam());
    fresh.send(kGv1);
    fresh.play(rep(45, "."));
    EXPECT_EQ(fresh.last().errors, kErrAck);
    EXPECT_EQ(fresh.tec(), tec() + (passive() ? 0 : 8));
    fresh.play(rep(n - 1, ".") + (passive() ? "0" : "."));
    EXPECT_EQ(fresh.tec(), tec() + 8) << n;
    fresh.play("10101");  // no second step
    if (passive()) {
      EXPECT_EQ(fresh.tec(), tec() + 8) << n;
    }
  }
}

// FC-05, FC-05a: no dominant bit in the flag, or only after it: nothing is counted.
TEST(PassiveAckError, AloneCostsNothing) {
  ErrorRig rig(kPassive);
  rig.send(kGv1);
  rig.play(rep(45, ".") + rep(6, "."));
  EXPECT_EQ(rig.field(), Field::kWait);
  rig.play("0000000");
  EXPECT_EQ(rig.tec(), 128u);
  rig.play("0");  // the eighth counts by FC-08
  EXPECT_EQ(rig.tec(), 136u);
}

// FC-05b, AR-04, PF-09: the exemption covers the stuff error alone.
TEST_P(Confinement, ArbitrationStuffErrorExemptsOnlyItself) {
  for (const bool flag_error : {true, false}) {
    ErrorRig fresh(GetParam());
    fresh.send({.id = 0x00F});
    EXPECT_EQ(fresh.play("....."), "00000");
    EXPECT_EQ(fresh.play("0"), "1");  // the recessive stuff bit
    EXPECT_EQ(fresh.last().errors, kErrStuff);
    EXPECT_TRUE(fresh.last().failed);
    EXPECT_EQ(fresh.tec(), tec());
    if (flag_error && !passive()) {
      fresh.play("..!");
      EXPECT_EQ(fresh.tec(), tec() + 8);
    } else {
      fresh.play(flag_seen() + "00000000");
      EXPECT_EQ(fresh.tec(), tec() + 8);
    }
    fresh.expect_rec(rec(), 0);
  }
}

// FC-06, FC-07, PF-26, MX-17: each corrupted bit of an active flag counts eight, not nine or 16.
TEST(CorruptedFlag, CountsEightForEachBit) {
  for (int n = 1; n <= 6; ++n) {
    ErrorRig t({.tec = 16, .rec = 5});
    t.send(kGv1);
    t.play("!" + rep(n - 1, ".") + "!");
    EXPECT_EQ(t.tec(), 32u) << n;
    EXPECT_EQ(t.rec(), 5u) << n;
    ErrorRig r({.tec = 16, .rec = 5});
    r.play("000000" + rep(n - 1, ".") + "!");
    EXPECT_EQ(r.rec(), 14u) << n;
    EXPECT_EQ(r.tec(), 16u) << n;
    ErrorRig overload({.tec = 16, .rec = 5});
    overload.transmit(kGv1);
    overload.play("0" + rep(n - 1, ".") + "!");
    EXPECT_EQ(overload.tec(), 23u) << n;
  }
}

// FC-08, FC-04, MX-19, MX-30, PF-37: k dominant bits after the flag.
TEST_P(Confinement, EveryEighthDominantBitAfterAFlagCountsEight) {
  for (const int k : {1, 6, 7, 8, 9, 15, 16, 17, 24}) {
    const unsigned eights = 8 * (static_cast<unsigned>(k) / 8);
    ErrorRig t(GetParam());
    t.send(kGv1);
    t.play("!" + flag_seen() + rep(k, "0"));
    EXPECT_EQ(t.tec(), tec() + 8 + eights) << k;
    ErrorRig r(GetParam());
    r.play("000000" + flag_seen() + rep(k, "0"));
    r.expect_rec(rec(), 1 + 8 + eights);
    EXPECT_EQ(r.tec(), tec()) << k;
  }
}

// FC-08: the two numbers of the rule, and 23 bits after an overload flag.
TEST(DominantAfterFlag, NumbersOfTheRuleBook) {
  ErrorRig r;
  r.play("000000 ......" + rep(16, "0"));
  EXPECT_EQ(r.rec(), 25u);
  ErrorRig t;
  t.send(kGv1);
  t.play("! ......" + rep(16, "0"));
  EXPECT_EQ(t.tec(), 24u);
  ErrorRig o({.tec = 1});
  o.transmit(kGv1);
  o.play("0 ......" + rep(23, "0"));
  EXPECT_EQ(o.tec(), 16u);
}

// FC-09, MX-28: minus one at EOF7, not below 0.
TEST_P(Confinement, SuccessfulTransmissionTakesOneAway) {
  rig.send(kGv1);
  rig.play(rep(44, ".") + "0" + rep(7, "."));
  expect_counters(0, 0);
  rig.play(".");
  EXPECT_EQ(rig.tec(), tec() == 0 ? 0u : tec() - 1);
  EXPECT_EQ(rig.rec(), rec());
}

// FC-10, FC-10b, PF-50: minus one at the ACK slot; from above 127 to 119..127. The engine knows no
// filters, so a frame that a filter rejects is such a frame too.
TEST_P(Confinement, ReceptionTakesOneAwayAtTheAckSlot) {
  rig.play(kGv1Bits + "1");
  expect_counters(0, 0);
  rig.play("0");
  if (rec() >= 128) {
    EXPECT_GE(rig.rec(), 119u);
    EXPECT_LE(rig.rec(), 127u);
  } else {
    EXPECT_EQ(rig.rec(), rec() == 0 ? 0u : rec() - 1);
  }
  const unsigned after = rig.rec();
  rig.play("1 1111111 111");
  EXPECT_EQ(rig.rec(), after);
  EXPECT_EQ(rig.tec(), tec());
}

// FC-10a, MX-10, PF-50: an error after the slot counts on top.
TEST(ErrorAfterAcknowledge, CountsOnTop) {
  const struct {
    std::uint8_t before;
    unsigned after;
  } cases[] = {{0, 1}, {1, 1}, {9, 9}, {127, 127}};
  for (const auto &c : cases) {
    for (const char *tail : {"0", "1 0", "1 110", "1 111110"}) {  // ACK delimiter, EOF1, 3, 6
      ErrorRig rig({.rec = c.before});
      rig.play(kGv1Bits + "1 0" + tail);
      EXPECT_EQ(rig.last().errors, kErrForm);
      EXPECT_EQ(rig.rec(), c.after) << tail;
    }
  }
  ErrorRig above({.rec = 128});
  above.play(kGv1Bits + "1 0 0");
  EXPECT_GE(above.rec(), 120u);
  EXPECT_LE(above.rec(), 128u);
  EXPECT_EQ(above.play("......"), "000000");  // active since the slot (FC-12)
}

// FC-15: a lost arbitration moves nothing; what follows is a receiver's business.
TEST_P(Confinement, LostArbitrationCountsNothing) {
  rig.send({.id = 0x555});
  const std::string winner = whole(kGv1);
  rig.play(winner.substr(0, 2));
  EXPECT_TRUE(rig.last().failed);  // 1 against 0 in ID28
  expect_counters(0, 0);
  rig.play(winner.substr(2));
  EXPECT_EQ(rig.tec(), tec());
  EXPECT_EQ(rig.delivered(), 1u);
}

// FC-15: an error in the winner's frame is REC's.
TEST_P(Confinement, ErrorAfterLostArbitrationIsAReceivers) {
  rig.send({.id = 0x555});
  rig.play("00 0000");
  expect_counters(0, 1);
}

// FC-16, MX-20: DEL2..DEL7.
TEST_P(Confinement, ErrorInTheOwnDelimiterCounts) {
  for (int n = 2; n <= 7; ++n) {
    ErrorRig t(GetParam());
    t.send(kGv1);
    t.play("!" + flag_seen() + rep(n - 1, ".") + "0");
    EXPECT_EQ(t.tec(), tec() + 16) << n;
    ErrorRig r(GetParam());
    r.play("000000" + flag_seen() + rep(n - 1, ".") + "0");
    r.expect_rec(rec(), 2);
  }
}

// FC-17: overload conditions are free; both roles.
TEST_P(Confinement, OverloadConditionsCountNothing) {
  rig.play(kGv1Bits + "1 0 1 111111");
  const unsigned after_frame = rig.rec();
  rig.play("0 ...... 1111111 0 ...... 11111111 0 ...... 11111111 10 ...... 11111111");
  EXPECT_EQ(rig.rec(), after_frame);
  EXPECT_EQ(rig.tec(), tec());
  ErrorRig t(GetParam());
  t.transmit(kGv1);
  const unsigned sent = t.tec();
  t.play("0 ...... 1111111 0 ...... 11111111 10 ...... 11111111");
  EXPECT_EQ(t.tec(), sent);
  EXPECT_EQ(t.rec(), rec());
}

}  // namespace
}  // namespace vericansim
