// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 15: when a frame is valid, for the receiver and for the transmitter; and what follows
// from the difference.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

class Validity : public ::testing::TestWithParam<Counters> {};

INSTANTIATE_TEST_SUITE_P(States, Validity, ::testing::Values(kActive, kPassive, kPassiveByRec));

// VA-01, VA-05, PF-55: valid with EOF6, one bit before nothing is known; dominant EOF6 kills it.
TEST_P(Validity, ReceiverDeliversAtEof6) {
  for (int eof = 1; eof <= 7; ++eof) {
    ErrorRig rig(GetParam());
    rig.play(kGv1Bits + "1 0 1" + rep(eof - 1, "1"));
    EXPECT_EQ(rig.delivered(), eof == 7 ? 1u : 0u) << eof;
    rig.play("0" + rep(40, "."));
    EXPECT_EQ(rig.delivered(), eof == 7 ? 1u : 0u) << eof;
  }
}

// VA-01, VA-05: no error at all: one delivery, whole, at the sample point of EOF6.
TEST_P(Validity, GoodFrameIsDeliveredOnceAndWhole) {
  ErrorRig rig(GetParam());
  rig.play(kGv1Bits + "1 0 1 11111");
  EXPECT_EQ(rig.delivered(), 0u);
  rig.play("1");
  ASSERT_EQ(rig.delivered(), 1u);
  EXPECT_EQ(rig.dut().received()[0], kGv1);
  rig.play(rep(60, "."));
  EXPECT_EQ(rig.delivered(), 1u);
}

// VA-02, ED-10: a transmitter needs EOF7 too.
TEST_P(Validity, TransmitterSucceedsAtEof7) {
  for (int eof = 1; eof <= 7; ++eof) {
    ErrorRig rig(GetParam());
    rig.send(kGv1);
    rig.play(rep(44, ".") + "0 ." + rep(eof - 1, ".") + "0");
    EXPECT_TRUE(rig.last().failed) << eof;
    EXPECT_EQ(rig.sent(), 0u) << eof;
    rig.play(rep(30, "."));
    EXPECT_EQ(rig.sent(), 0u) << eof;
    EXPECT_TRUE(rig.dut().pending()) << eof;
  }
}

// VA-02, VA-06: success with the sample point of EOF7, not before; INT1 or INT2 dominant change
// nothing, and the frame is not repeated.
TEST_P(Validity, SuccessStandsWhateverFollows) {
  for (const char *after : {"1111", "0", "10", "110"}) {
    ErrorRig rig(GetParam());
    rig.send(kGv1);
    rig.play(rep(44, ".") + "0 . ......");
    EXPECT_EQ(rig.sent(), 0u);
    rig.play(".");
    EXPECT_EQ(rig.sent(), 1u);
    rig.play(after + rep(50, "."));
    EXPECT_EQ(rig.sent(), 1u);
    EXPECT_FALSE(rig.dut().pending());
    EXPECT_EQ(rig.dut().events().failed, 0u);
  }
}

// DUT 0 sends, 1 and 2 receive; the frame goes on until the bus is idle for a while.
class ThreeNodes : public ::testing::Test {
 protected:
  void run() { bench.run_bits(200); }
  [[nodiscard]] std::size_t copies(unsigned i) { return bench.dut(i).received().size(); }
  void start() {
    judge.start();
    judge.request(0, kGv1);
  }
  ~ThreeNodes() override {
    EXPECT_TRUE(judge.agrees()) << judge.report();
    EXPECT_TRUE(assertions.hold()) << assertions.report();
  }

  CoreBench bench{3};
  Lockstep judge{bench};
  Assertions assertions{bench};
};

// VA-03, PF-28: the transmitter alone sees EOF7 dominant: all receivers have the frame twice.
TEST_F(ThreeNodes, DominantEof7AtTheTransmitterDuplicatesTheFrame) {
  start();
  bench.invert(0, {.frame = 1, .field = Field::kEof, .index = 6});
  run();
  EXPECT_EQ(bench.dut(0).sent().size(), 1u);
  EXPECT_EQ(bench.dut(0).events().started, 2u);
  EXPECT_EQ(copies(1), 2u);
  EXPECT_EQ(copies(2), 2u);
}

// VA-03: one receiver alone sees EOF6 dominant; its flag is the others' EOF7.
TEST_F(ThreeNodes, DominantEof6AtOneReceiverDuplicatesTheFrameForTheOthers) {
  start();
  bench.invert(1, {.frame = 1, .field = Field::kEof, .index = 5});
  run();
  EXPECT_EQ(bench.dut(0).sent().size(), 1u);
  EXPECT_EQ(copies(1), 1u);
  EXPECT_EQ(copies(2), 2u);
}

// VA-03: and if the transmitter dies before it can repeat, that receiver never gets the frame.
TEST_F(ThreeNodes, TransmitterThatDiesLeavesAnInconsistentOmission) {
  start();
  bench.invert(1, {.frame = 1, .field = Field::kEof, .index = 5});
  ASSERT_TRUE(bench.run_until([&] { return bench.last(0).failed; }, 80));
  judge.cancel(0);
  run();
  EXPECT_EQ(bench.dut(0).sent().size(), 0u);
  EXPECT_EQ(copies(1), 0u);
  EXPECT_EQ(copies(2), 1u);
}

// VA-04: a passive receiver's local error is its own loss: one transmission, the other has it.
TEST_F(ThreeNodes, PassiveReceiversLocalErrorForcesNoRepetition) {
  judge.preset_counters(1, 140, 0);
  start();
  bench.invert(1, {.frame = 1, .field = Field::kDlc, .index = 2, .stuff = true});
  run();
  EXPECT_EQ(bench.dut(0).events().started, 1u);
  EXPECT_EQ(bench.dut(0).sent().size(), 1u);
  EXPECT_EQ(copies(1), 0u);
  EXPECT_EQ(copies(2), 1u);
  EXPECT_EQ(bench.last(1).rec, 1u);
}

// VA-04, EF-01: an active one in its place makes everybody start again.
TEST_F(ThreeNodes, ActiveReceiversLocalErrorForcesARepetition) {
  start();
  bench.invert(1, {.frame = 1, .field = Field::kDlc, .index = 2, .stuff = true});
  run();
  EXPECT_EQ(bench.dut(0).events().started, 2u);
  EXPECT_EQ(copies(1), 1u);
  EXPECT_EQ(copies(2), 1u);
}

// VA-05, RO-05: of a frame that breaks off in any bit nothing is delivered, and the next one is
// whole.
TEST_P(Validity, BrokenFrameLeavesNothingBehind) {
  const Frame next{.id = 0x3A5, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};
  for (std::size_t n = 14; n < 53; ++n) {
    ErrorRig rig(GetParam());
    rig.play(whole(kGv1).substr(0, n) + "00000000 0000000" + rep(30, "1"));
    EXPECT_EQ(rig.delivered(), n >= 52 ? 1u : 0u) << n;
    rig.dut().received().clear();
    rig.receive(next);
    ASSERT_EQ(rig.delivered(), 1u) << n;
    EXPECT_EQ(rig.dut().received()[0], next) << n;
  }
}

}  // namespace
}  // namespace vericansim
