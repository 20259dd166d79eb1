// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus-off as software sees it: entry, progress, BOFF_REC in every order (flexcan.md 2.8, section
// 7).
#include <gtest/gtest.h>

#include <optional>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks
constexpr Time kClock = 125 * kNanosecond;
// From the entry: the rest of its bit, then 128 times 11 bits.
constexpr unsigned kRecovery = 128 * 11 * kBit;

class BusOffRecovery : public ::testing::Test {
 protected:
  BusOffRecovery() : rig_{2, 16} {
    for (unsigned n = 0; n < 2; ++n) rig_.configure(n);
    rig_.put_rx(1, 3, {.id = 0x155}, 0);
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
  }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }
  std::uint32_t ecr() { return rig_.read(0, reg::kEcr); }
  void hold(bool on) { rig_.write(0, reg::kCtrl, kTiming8 | (on ? reg::kCtrlBoffRec : 0)); }
  [[nodiscard]] bool off() { return decode_trace(rig_.node(0).trace()).bus_off; }
  // TEC 250, then a bit error in the SOF of an own frame.
  void enter(std::uint32_t boff_rec) {
    ASSERT_TRUE(rig_.freeze(0));
    rig_.write(0, reg::kEcr, 250);
    hold(boff_rec != 0);
    rig_.go(0);
    const Time now = rig_.bus().now();
    deaf_.emplace(0, Effect::kRecessive, Window{now, now + 12 * kBit * kClock});
    rig_.bus().add(*deaf_);
    rig_.put_tx(0, 8, {.id = 0x155, .dlc = 1, .data = {7}});
    ASSERT_TRUE(rig_.run_until([&] { return off(); }, 12 * kBit));
    since_ = rig_.bus().now();
  }
  // Clocks from the entry until it is over; no more than `limit` from now.
  unsigned over(unsigned limit) {
    EXPECT_TRUE(rig_.run_until([&] { return !off(); }, limit));
    return static_cast<unsigned>((rig_.bus().now() - since_) / kClock);
  }
  std::optional<LevelFault> deaf_;
  MailboxRig rig_;
  Time since_ = 0;
};

// The peer's error frame after the broken SOF, and the node's own last bits, cost two sequences.
constexpr unsigned kSlack = 3 * 11 * kBit;

TEST_F(BusOffRecovery, EntryIsReportedOnce) {  // FX-2.8.a, FX-7.d, FX-ESR1.BOFF_INT, BO-06
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.run(4);
  EXPECT_EQ(esr() & 0x36, 0x26u) << "FLT_CONF 1x, BOFF_INT, ERR_INT";
  EXPECT_EQ(ecr() & 0xFF, 0u) << "TEC reads 0 and counts sequences";
  rig_.write(0, reg::kEsr, reg::kEsrInterrupts);
  rig_.run(kRecovery + kSlack);
  EXPECT_EQ(ecr() & 0xFF, 128u);
  EXPECT_EQ(esr() & 0x20336, 0x20u) << "no flag, no warning on the way";
}

TEST_F(BusOffRecovery, CountsASequenceEveryElevenBits) {  // FX-2.8.a, BO-02
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.run(kSlack);
  for (unsigned i = 0; i < 12; ++i) {
    const std::uint32_t before = ecr() & 0xFF;
    rig_.run(10 * 11 * kBit - 4);  // with the clocks of the read
    EXPECT_NEAR(ecr() & 0xFF, before + 10, 1);
  }
}

// What software writes to TEC cannot shorten it.
TEST_F(BusOffRecovery, WritingEcrLeavesTheSequencesCounted) {  // BO-02, FX-ECR.TEC
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.run(kSlack + 20 * 11 * kBit);
  ASSERT_TRUE(rig_.freeze(0));
  const std::uint32_t before = ecr();
  ASSERT_NEAR(before, 20, 3);
  rig_.write(0, reg::kEcr, 0x557F);
  EXPECT_EQ(ecr(), 0x5500 | before);
  rig_.write(0, reg::kEcr, 0);
  EXPECT_EQ(ecr(), before);
  EXPECT_TRUE(off());
  rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) & ~(reg::kMcrFrz | reg::kMcrHalt));
  rig_.run((kRecovery / 128) * 100);
  EXPECT_TRUE(off());
  EXPECT_LT(ecr() & 0xFF, 128u);
}

TEST_F(BusOffRecovery, AutomaticWithoutBoffRec) {  // FX-2.8.b, FX-2.8.e, BO-05, BO-07
  ASSERT_NO_FATAL_FAILURE(enter(0));
  const unsigned clocks = over(kRecovery + kSlack);
  EXPECT_GE(clocks, kRecovery - 11 * kBit);
  EXPECT_EQ(ecr(), 0u);
  EXPECT_EQ(esr() & 0x330, 0u);
  EXPECT_EQ(rig_.read(0, reg::mb(8)) >> 24, 0xCu) << "still active";
  EXPECT_TRUE(rig_.wait_flag(0, 8)) << "and sent now";
  EXPECT_EQ(mb_frame(rig_.get(1, 3)), (Frame{.id = 0x155, .dlc = 1, .data = {7}}));
}

TEST_F(BusOffRecovery, BuffersTakenBackInBusOffAreNotSent) {  // FX-2.8.e
  ASSERT_NO_FATAL_FAILURE(enter(0));
  rig_.write(0, reg::mb(8), reg::kCodeTxInactive);
  over(kRecovery + kSlack);
  rig_.run(200 * kBit);
  EXPECT_EQ(rig_.flags(1), 0u);
  EXPECT_EQ(rig_.flags(0), 0u);
}

TEST_F(BusOffRecovery, BoffRecHolds) {  // FX-2.8.c, FX-CTRL1.BOFF_REC
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.run(3 * kRecovery);
  EXPECT_TRUE(off());
}

TEST_F(BusOffRecovery, ClearedAfterTheSequencesElevenBitsAreEnough) {  // FX-2.8.c
  ASSERT_NO_FATAL_FAILURE(enter(1));
  for (unsigned k = 0; k < 11 * kBit; k += 5) {
    rig_.run(kRecovery + kSlack + k);
    ASSERT_TRUE(off());
    hold(false);
    const Time cleared = rig_.bus().now();
    over(12 * kBit);
    EXPECT_LE(rig_.bus().now() - cleared, 12 * kBit * kClock);
    rig_.write(0, reg::mb(8), reg::kCodeTxInactive);
    ASSERT_NO_FATAL_FAILURE(enter(1));
  }
}

TEST_F(BusOffRecovery, ClearedBeforeTheSequencesItIsAsIfAutomatic) {  // FX-2.8.c
  ASSERT_NO_FATAL_FAILURE(enter(0));
  const unsigned automatic = over(kRecovery + kSlack);
  rig_.run(200 * kBit);
  for (const unsigned part : {1u, 4u, 7u}) {
    ASSERT_NO_FATAL_FAILURE(enter(1));
    rig_.run(kRecovery / 8 * part);
    hold(false);
    EXPECT_NEAR(over(kRecovery + kSlack), automatic, 2 * 11 * kBit);
    rig_.run(200 * kBit);
  }
}

TEST_F(BusOffRecovery, SetAgainAtOnceItCountsForTheNextTime) {  // FX-2.8.d
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.run(kRecovery / 2);
  hold(false);
  hold(true);
  over(kRecovery);
  rig_.run(200 * kBit);
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.run(2 * kRecovery);
  EXPECT_TRUE(off());
}

TEST_F(BusOffRecovery, SetDuringBusOffItDoesNotHoldThisOne) {  // FX-2.8.d
  ASSERT_NO_FATAL_FAILURE(enter(0));
  rig_.run(kRecovery / 2);
  hold(true);
  over(kRecovery);
}

TEST_F(BusOffRecovery, ADominantBitRestartsItsSequenceOnly) {  // BO-02
  ASSERT_NO_FATAL_FAILURE(enter(0));
  rig_.run(kRecovery / 2 + 3 * kBit);
  const Time now = rig_.bus().now();
  LevelFault one{0, Effect::kDominant, {now, now + kBit * kClock}};
  rig_.bus().add(one);
  const unsigned clocks = over(kRecovery);
  EXPECT_LE(clocks, kRecovery + kSlack);
}

// MB(63) and the like: a frame of the others is no business of a node in bus-off.
TEST_F(BusOffRecovery, NothingIsReceivedInBusOff) {  // BO-01
  rig_.put_rx(0, 3, {.id = 0x155});
  ASSERT_NO_FATAL_FAILURE(enter(1));
  rig_.write(0, reg::mb(8), reg::kCodeTxInactive);
  rig_.run(100 * kBit);
  rig_.put_tx(1, 8, {.id = 0x155});
  rig_.run(400 * kBit);
  EXPECT_EQ(rig_.flags(0), 0u);
  EXPECT_EQ(rig_.flags(1), 0u) << "no acknowledge from it either";
}

}  // namespace
}  // namespace vericansim
