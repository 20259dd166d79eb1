// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 10: overload frames; after own and foreign frames, in all error states.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

struct Situation {
  bool own_frame;  // the frame before was sent by the DUT: it is transmitter (RO-01)
  Counters counters;
};

void PrintTo(const Situation &s, std::ostream *out) {
  *out << (s.own_frame ? "T_" : "R_");
  PrintTo(s.counters, out);
}

class Overload : public ::testing::TestWithParam<Situation> {
 protected:
  // Well above 128, so that a good frame leaves the state as it is.
  Overload() : rig{GetParam().counters} {}
  void good_frame() {
    if (GetParam().own_frame) {
      rig.transmit(kGv1);
    } else {
      rig.receive(kGv1);
    }
    tec_ = rig.tec();
    rec_ = rig.rec();
    rig.dut().clear_events();
  }
  void expect_nothing_counted() {
    EXPECT_EQ(rig.tec(), tec_);
    EXPECT_EQ(rig.rec(), rec_);
    EXPECT_EQ(rig.dut().events().errors, 0);
  }
  // The rest of an overload frame whose condition was the last bit, up to the next start.
  void expect_overload_frame() { EXPECT_EQ(rig.play(rep(14, ".")), kOverloadFlag + kDelimiter); }
  [[nodiscard]] bool suspends() const {
    return GetParam().own_frame && GetParam().counters.passive();
  }

  ErrorRig rig;
  unsigned tec_ = 0;
  unsigned rec_ = 0;
};

const auto kSenders = ::testing::Values(Situation{true, kActive}, Situation{true, {.tec = 136}},
                                        Situation{true, {.rec = 130}});
const auto kReceivers = ::testing::Values(Situation{false, kActive}, Situation{false, {.tec = 136}},
                                          Situation{false, {.tec = 140, .rec = 3}});

class ReceiverOverload : public Overload {};

INSTANTIATE_TEST_SUITE_P(Senders, Overload, kSenders);
INSTANTIATE_TEST_SUITE_P(Receivers, Overload, kReceivers);
INSTANTIATE_TEST_SUITE_P(States, ReceiverOverload, kReceivers);

// OV-01, OV-03, IF-04, ED-05, MX-13, PF-49: dominant at INT1 and at INT2, from passive nodes too.
TEST_P(Overload, DominantInInt1AndInt2IsAnsweredWithAFlag) {
  good_frame();
  rig.play("0");
  expect_overload_frame();
  rig.play(".0");
  expect_overload_frame();
  expect_nothing_counted();
  EXPECT_EQ(rig.field(), Field::kInt);
}

// OV-03, ED-12, FC-17, PF-36: dominant at DEL8, of an overload frame and of an error frame.
TEST_P(Overload, DominantInTheLastDelimiterBitIsAnsweredWithAFlag) {
  good_frame();
  rig.play("0 ...... 1111111 0");
  expect_overload_frame();
  expect_nothing_counted();
  ErrorRig other(GetParam().counters);
  if (GetParam().own_frame) other.send(kGv1);
  other.play(GetParam().own_frame ? "!" : "000000");
  const unsigned tec = other.tec();
  const unsigned rec = other.rec();
  other.play("...... 1111111 0");
  EXPECT_EQ(other.play(rep(14, ".")), kOverloadFlag + kDelimiter);
  EXPECT_EQ(other.tec(), tec);
  EXPECT_EQ(other.rec(), rec);
}

// OV-03, ED-11: a receiver answers a dominant EOF7 so; the frame is valid all the same (OV-06).
TEST_P(ReceiverOverload, AnswersDominantEof7) {
  rig.play(kGv1Bits + "1 0 1 111111 0");
  expect_overload_frame();
  EXPECT_EQ(rig.delivered(), 1u);
  EXPECT_EQ(rig.dut().events().errors, 0);
}

// OV-04: every trigger is answered, here twenty in a row.
TEST_P(Overload, ThereIsNoLimit) {
  good_frame();
  rig.play("0");
  for (int n = 0; n < 20; ++n) {
    EXPECT_EQ(rig.play("...... 1111111 0"), kOverloadFlag + kDelimiter) << n;
  }
  expect_overload_frame();
  expect_nothing_counted();
}

// OV-05, FC-08: the first dominant bit after the flag costs nothing; the eighth costs eight.
TEST_P(Overload, OnlyEveryEighthDominantBitAfterTheFlagCounts) {
  good_frame();
  rig.play("0 ......");
  EXPECT_EQ(rig.play("0000000"), rep(7, "1"));
  expect_nothing_counted();
  rig.play("0");
  const unsigned step = 8;
  EXPECT_EQ(rig.tec(), tec_ + (GetParam().own_frame ? step : 0));
  rig.expect_rec(rec_, GetParam().own_frame ? 0 : step);
  EXPECT_EQ(rig.play(rep(15, "0")), rep(15, "1"));  // 23 in all: two steps
  EXPECT_EQ(rig.tec(), tec_ + (GetParam().own_frame ? 2 * step : 0));
  rig.expect_rec(rec_, GetParam().own_frame ? 0 : 2 * step);
}

// OV-05, FC-06, FC-07, FC-16, ED-21: bit error in the flag (+8), form error in the delimiter.
TEST_P(Overload, ErrorsInsideCount) {
  good_frame();
  const bool passive = rig.last().passive;
  rig.play("0 ..!");
  EXPECT_EQ(rig.tec(), tec_ + (GetParam().own_frame ? 8 : 0));
  rig.expect_rec(rec_, GetParam().own_frame ? 0 : 8);
  EXPECT_EQ(rig.play(rep(14, ".")), (passive ? "111111" : "000000") + kDelimiter);
  rig.play("0 ...... 111 0");
  EXPECT_EQ(rig.last().errors, kErrForm);
  EXPECT_EQ(rig.tec(), tec_ + (GetParam().own_frame ? 16 : 0));
  rig.expect_rec(rec_, GetParam().own_frame ? 0 : 9);
}

// OV-06, VA-06: the frame before stands: delivered or sent, once, and not repeated.
TEST_P(Overload, FrameBeforeStaysValid) {
  good_frame();
  rig.play("0");
  expect_overload_frame();
  EXPECT_EQ(rig.play(rep(60, ".")), rep(60, "1"));
  EXPECT_EQ(rig.sent(), GetParam().own_frame ? 1u : 0u);
  EXPECT_EQ(rig.delivered(), GetParam().own_frame ? 0u : 1u);
}

// OV-07, IF-07, IF-08, IF-09: three bits of intermission, and the suspend time for who owes it.
TEST_P(Overload, IntermissionAndSuspendTimeFollow) {
  good_frame();
  rig.play("0");
  rig.request({.id = 0x0F0});
  expect_overload_frame();
  const std::string gap = kIntermission + (suspends() ? "11111111" : "");
  EXPECT_EQ(rig.play(rep(static_cast<int>(gap.size()) + 6, ".")), gap + "000011");
}

// OV-08, IF-05, PF-36: INT3 is a start of frame, also right after an overload frame.
TEST_P(Overload, DominantInInt3IsAStartOfFrame) {
  good_frame();
  rig.play("11");
  const std::string first = rig.receive(kGv1);
  EXPECT_EQ(first, rep(44, "1") + "0" + rep(8, "1"));
  rig.play("0");
  expect_overload_frame();
  rig.play("11");
  EXPECT_EQ(rig.receive(kGv1), first);
  EXPECT_EQ(rig.delivered(), GetParam().own_frame ? 2u : 3u);
}

}  // namespace
}  // namespace vericansim
