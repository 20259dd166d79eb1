// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 9: error flags, how they end, and what follows them; both roles, all states.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

enum class As { kTransmitter, kReceiver };

struct Situation {
  As role;
  Counters counters;
};

void PrintTo(const Situation &s, std::ostream *out) {
  *out << (s.role == As::kTransmitter ? "T_" : "R_");
  PrintTo(s.counters, out);
}

class ErrorFrame : public ::testing::TestWithParam<Situation> {
 protected:
  ErrorFrame() : rig{GetParam().counters} {}
  // An error in this role, not at a place where counters play tricks; the flag comes next.
  void make_error() {
    if (transmitter()) {
      rig.send(kGv1);
      rig.play(rep(22, ".") + "!");
    } else {
      rig.play("000000");
    }
  }
  [[nodiscard]] bool transmitter() const { return GetParam().role == As::kTransmitter; }
  [[nodiscard]] bool passive() const { return GetParam().counters.passive(); }
  [[nodiscard]] std::string flag() const { return flag_of(GetParam().counters); }
  // What precedes the next own start after DEL8.
  [[nodiscard]] std::string gap() const {
    return kIntermission + (transmitter() ? suspend_of(GetParam().counters) : "");
  }

  ErrorRig rig;
};

const auto kActiveNodes =
    ::testing::Values(Situation{As::kTransmitter, kActive}, Situation{As::kReceiver, kActive});
const auto kPassiveNodes = ::testing::Values(
    Situation{As::kTransmitter, kPassive}, Situation{As::kTransmitter, kPassiveByRec},
    Situation{As::kReceiver, kPassive}, Situation{As::kReceiver, kPassiveByRec});

class ActiveErrorFlag : public ErrorFrame {};
class PassiveErrorFlag : public ErrorFrame {};

INSTANTIATE_TEST_SUITE_P(Active, ErrorFrame, kActiveNodes);
INSTANTIATE_TEST_SUITE_P(Passive, ErrorFrame, kPassiveNodes);
INSTANTIATE_TEST_SUITE_P(Roles, ActiveErrorFlag, kActiveNodes);
INSTANTIATE_TEST_SUITE_P(RolesAndStates, PassiveErrorFlag, kPassiveNodes);

// EF-01, EF-02, EF-10, IF-08, IF-09, RO-04: flag, delimiter, intermission; then the frame starts.
TEST_P(ErrorFrame, FlagDelimiterAndIntermissionAreExact) {
  make_error();
  if (!transmitter()) rig.request(kGv1);
  EXPECT_EQ(rig.play(rep(static_cast<int>(6 + 8 + gap().size() + 43), ".")),
            flag() + kDelimiter + gap() + kGv1Bits);
}

// EF-01: the other sources of a flag: acknowledge, form and bit error; stuff error as a receiver.
TEST(ErrorFlag, FollowsEveryKindOfErrorInTheNextBit) {
  ErrorRig ack;
  ack.send(kGv1);
  EXPECT_EQ(ack.play(rep(51, ".")).substr(43), bits("1 1 000000"));
  ErrorRig form;
  form.send(kGv1);
  EXPECT_EQ(form.play(rep(43, ".") + "1 0 0 ......").substr(43), bits("1 1 1 000000"));
  ErrorRig stuff;
  EXPECT_EQ(stuff.play("000000 ......"), bits("111111 000000"));
  ErrorRig crc;
  std::string bad = kGv1Bits;
  bad.back() = '0';
  EXPECT_EQ(crc.play(bad + "1 0 1 ......").substr(44), bits("1 1 000000"));
}

// EF-02, PF-48: six equal bits of either level end it; the bit with the error does not count.
TEST_P(PassiveErrorFlag, PassiveFlagEndsWithSixEqualBits) {
  make_error();
  EXPECT_EQ(rig.play("000000"), "111111");
  EXPECT_EQ(rig.field(), Field::kWait);
  EXPECT_EQ(rig.play("11111111" + gap()), rep(static_cast<int>(8 + gap().size()), "1"));
  EXPECT_EQ(rig.field(), transmitter() ? Field::kSof : Field::kIdle);
}

// EF-03: 5 d, 5 r, 6 d: complete with the last one.
TEST_P(PassiveErrorFlag, ChangeOfLevelRestartsThePassiveFlag) {
  make_error();
  rig.play("00000 11111 00000");
  EXPECT_EQ(rig.field(), Field::kErrFlag);
  rig.play("0");
  EXPECT_EQ(rig.field(), Field::kWait);
  rig.play("1");
  EXPECT_EQ(rig.field(), Field::kDel);
}

// EF-03: recessive bits end it as well, in the middle of anything.
TEST_P(PassiveErrorFlag, PassiveFlagAlternatesAsLongAsTheBusDoes) {
  make_error();
  rig.play("01 01 01 01 001 0001 00001 000001 11111");
  EXPECT_EQ(rig.field(), Field::kWait);
}

// EF-04, PF-33: no step and no error, whatever is seen.
TEST_P(PassiveErrorFlag, PassiveFlagCountsNothing) {
  make_error();
  const unsigned tec = rig.tec();
  const unsigned rec = rig.rec();
  rig.play("1 0 11 00 1 0 1 00000 111111");
  EXPECT_EQ(rig.tec(), tec);
  EXPECT_EQ(rig.rec(), rec);
}

// EF-05, FC-06, FC-07, MX-29, PF-47: 16th (T) and 17th (R) corrupted bit of active flags.
TEST(ErrorFlag, ErrorThatReaches128StillFlagsActively) {
  ErrorRig t;
  t.send(kGv1);
  t.play("!");
  for (unsigned n = 1; n <= 15; ++n) {
    EXPECT_EQ(t.play("!"), "0") << n;
    EXPECT_EQ(t.tec(), 8 * (n + 1)) << n;
  }
  EXPECT_EQ(t.play("!"), "0");  // TEC is 128: that error's flag is still an active one
  EXPECT_EQ(t.tec(), 136u);
  EXPECT_EQ(t.play("......"), "111111");
  ErrorRig r;
  r.play("000000");
  for (unsigned n = 1; n <= 16; ++n) {
    EXPECT_EQ(r.play("!"), "0") << n;
    EXPECT_EQ(r.rec(), 1 + 8 * n) << n;
  }
  EXPECT_EQ(r.play("!"), "0");  // the 16th error came below 128: its flag is still active
  EXPECT_GE(r.rec(), 128u);
  EXPECT_EQ(r.play("......"), "111111");
}

// EF-05, MX-26, MX-27: at 127 both ways, one error: six dominant bits, then the passive state.
TEST(ErrorFlag, StateBeforeTheErrorDecides) {
  ErrorRig t({.tec = 127});
  t.send(kGv1);
  EXPECT_EQ(t.play("! ......"), "0000000");
  EXPECT_EQ(t.tec(), 135u);
  EXPECT_EQ(t.play("11111111 111 11111111 ."), rep(19, "1") + "0");  // suspended (IF-11)
  EXPECT_EQ(t.play("! ......"), "0" + rep(6, "1"));
  ErrorRig r({.rec = 127});
  EXPECT_EQ(r.play("000000 ......"), bits("111111 000000"));
  EXPECT_TRUE(r.last().passive);
  r.play(rep(11, "."));
  EXPECT_EQ(r.play("000000 ......"), bits("111111 111111"));
}

// EF-06, MX-17: each bit of an active flag seen recessive starts six new ones.
TEST_P(ActiveErrorFlag, RecessiveInAnActiveFlagStartsANewOne) {
  for (int n = 1; n <= 6; ++n) {
    ErrorRig fresh;
    if (transmitter()) {
      fresh.send(kGv1);
      fresh.play("!");
    } else {
      fresh.play("000000");
    }
    fresh.play(rep(n - 1, ".") + "!");
    EXPECT_EQ(fresh.last().errors, kErrBit0) << n;
    EXPECT_EQ(fresh.play(rep(14, ".")), "000000" + kDelimiter) << n;
    EXPECT_EQ(fresh.tec(), transmitter() ? 16u : 0u) << n;
    EXPECT_EQ(fresh.rec(), transmitter() ? 0u : 9u) << n;
  }
}

// EF-07, EF-11: two engines, one of which sees the error alone. A flag that the other did not
// answer would be one bit shorter than each of these: six, or seven behind a dominant bit of the
// frame.
TEST(ErrorFlag, SuperposedFlagsLastSixToTwelveBits) {
  std::string lengths;
  for (unsigned n = 0; n < 8; ++n) {
    CoreBench bench(2);
    bench.start();
    bench.dut(0).request({.id = 0x155, .dlc = 1, .data = {0xFF}});
    bench.invert(1, {.frame = 1, .field = Field::kData, .index = n, .stuff = false});
    std::string wire;
    for (unsigned k = 0; k < 80; ++k) {
      bench.step();
      wire.push_back(bench.last(0).rx == Level::kDominant ? '0' : '1');
    }
    const std::size_t flag = wire.find("000000");
    ASSERT_NE(flag, std::string::npos) << n;
    const std::size_t end = wire.find('1', flag);
    lengths += std::to_string(end - flag) + " ";
  }
  EXPECT_EQ(lengths, "8 8 8 8 7 7 7 8 ");
}

// EF-08, FC-08, PF-37: recessive and patient; the first recessive bit is DEL1.
TEST_P(ErrorFrame, DelimiterWaitsForTheFirstRecessiveBit) {
  make_error();
  rig.play(passive() ? "000000" : "......");
  EXPECT_EQ(rig.play(rep(23, "0")), rep(23, "1"));
  EXPECT_EQ(rig.field(), Field::kWait);
  EXPECT_EQ(rig.play("1"), "1");
  EXPECT_EQ(rig.field(), Field::kDel);
  EXPECT_EQ(rig.bench.place().left(), 6u);
}

// EF-09, ED-12, MX-20: DEL2..DEL7 and DEL8.
TEST_P(ErrorFrame, DominantInTheDelimiter) {
  for (int n = 2; n <= 8; ++n) {
    ErrorRig fresh(GetParam().counters);
    if (transmitter()) fresh.send(kGv1);
    fresh.play(transmitter() ? "!" : "000000");
    const bool still_active = !fresh.last().passive;
    fresh.play(rep(6, ".") + rep(n - 1, ".") + "0");
    const bool error = n < 8;
    EXPECT_EQ(fresh.last().errors, error ? kErrForm : 0) << n;
    const bool dominant = still_active || !error;
    EXPECT_EQ(fresh.play(rep(6, ".")), dominant ? "000000" : "111111") << n;
  }
}

// EF-10: a frame of another node at INT3, 8 + 2 bits after the last dominant one, is received.
TEST_P(ErrorFrame, FrameInInt3AfterTheErrorFrameIsReceived) {
  make_error();
  rig.play("......" + kDelimiter + "11");
  rig.bench.dut().cancel();
  rig.judge.cancel(0);
  const std::string driven = rig.receive(kGv1);
  EXPECT_EQ(driven, rep(44, "1") + "0" + rep(8, "1"));
  EXPECT_EQ(rig.delivered(), 1u);
}

// EF-11, FC-04, MX-19: dominant right behind the flag costs the receiver 8, the transmitter
// nothing.
TEST_P(ErrorFrame, EarlyFlaggerSeesTheOthersFlags) {
  make_error();
  const unsigned tec = rig.tec();
  const unsigned rec = rig.rec();
  rig.play((passive() ? "000000" : "......") + std::string("0"));
  EXPECT_EQ(rig.tec(), tec);
  rig.expect_rec(rec, transmitter() ? 0 : 8);
}

// EF-12: a passive receiver whose local error comes at the end of a good frame falls behind by
// three bits; what it does then depends on when the next frame comes.
TEST(ErrorFlag, LonePassiveReceiverFallsBehind) {
  struct Case {
    int idle;          // the next SOF is in this bit of bus idle
    std::string then;  // what the DUT sends in the six bits behind that SOF
    bool error;
  };
  for (const Case &c : {Case{1, "111111", true}, Case{2, "111111", true}, Case{3, "000000", false},
                        Case{4, "000000", false}, Case{5, "000000", false}}) {
    ErrorRig rig(kPassive);
    rig.play(kGv1Bits.substr(0, 17) + "0");  // the stuff bit, seen by this node alone
    EXPECT_EQ(rig.last().errors, kErrStuff);
    rig.play(kGv1Bits.substr(18) + "1 0 1 1111111 111");  // the others accept the frame
    rig.play(rep(c.idle - 1, "1") + "0");
    EXPECT_EQ(rig.last().errors != 0, c.error) << c.idle;
    EXPECT_EQ(rig.play("1 0 1 0 1 0"), c.then) << c.idle;
    EXPECT_EQ(rig.rec(), c.error ? 2u : 1u) << c.idle;
  }
  ErrorRig rig(kPassive);
  rig.play(kGv1Bits.substr(0, 17) + "0" + kGv1Bits.substr(18) + "1 0 1 1111111 111" + "11111");
  rig.receive(kGv1);  // SOF in the sixth bit of bus idle: in step again
  EXPECT_EQ(rig.delivered(), 1u);
}

// EF-13, MO-01, MX-22: no flag from nodes that are listening, integrating or off.
TEST(ErrorFlag, IsNotSentByNodesThatDoNotTakePart) {
  CoreConfig listening = CoreBench::default_config();
  listening.listen_only = true;
  ErrorRig listen(kActive, listening);
  EXPECT_EQ(listen.play("000000" + rep(30, ".")), rep(36, "1"));
  CoreBench integrating;
  integrating.dut().start();
  integrating.lt("1111 000000000 11 0000000 1");
  integrating.run_bits(23);
  EXPECT_EQ(integrating.tx_history().find('0'), std::string::npos);
  ErrorRig off({.tec = 248});
  off.send(kGv1);
  off.play("!");
  EXPECT_EQ(off.play("000000 111111 000000000 1 0" + rep(20, ".")), rep(43, "1"));
}

}  // namespace
}  // namespace vericansim
