// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TIMER, stamps, and TIMER set to 0 by a reception (flexcan.md 2.10, section 6).
#include <gtest/gtest.h>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks

class Timer : public ::testing::Test {
 protected:
  Timer() : rig_{2, 16} {
    for (unsigned n = 0; n < 2; ++n) rig_.configure(n);
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
  }
  std::uint32_t timer() { return rig_.read(0, reg::kTimer); }
  void write_timer(std::uint32_t value) { rig_.write(0, reg::kTimer, value); }
  void use_tsyn() {
    ASSERT_TRUE(rig_.freeze(0));
    rig_.write(0, reg::kCtrl, kTiming8 | 1u << 5);
    for (unsigned mb = 0; mb < 2; ++mb) rig_.put_rx(0, mb, {.id = 0x100 + mb});
    rig_.go(0);
  }
  // A frame from node 1, until it is over.
  void receive(std::uint32_t id) {
    rig_.put_tx(1, 8, {.id = id});
    ASSERT_TRUE(rig_.wait_flag(1, 8));
    rig_.clear_flag(1, 8);
  }
  MailboxRig rig_;
};

TEST_F(Timer, CountsBitsOnAnIdleBusAndWraps) {  // FX-6.a, FX-MAP.TIMER
  write_timer(0xFFF0);
  const std::uint32_t first = timer();
  EXPECT_NEAR(first, 0xFFF0, 1);
  rig_.run(100 * kBit - 3);
  EXPECT_NEAR(timer(), (first + 100) & 0xFFFF, 1);
}

TEST_F(Timer, CountsTheBitsOfAFrameToo) {  // FX-6.a: bit time, not bits of the frame
  receive(0x155);
  write_timer(0);
  const Time begin = rig_.bus().now();
  receive(0x155);
  receive(0x2AA);
  const Time bits = (rig_.bus().now() - begin) / (kBit * 125 * kNanosecond);
  EXPECT_NEAR(timer(), static_cast<double>(bits), 2.0);
}

TEST_F(Timer, StandsInFreezeDisableAndStopModeWhereItCanBeWritten) {  // FX-6.b
  const auto stands = [&] {
    write_timer(0x1234);
    EXPECT_EQ(timer(), 0x1234u);
    rig_.run(50 * kBit);
    EXPECT_EQ(timer(), 0x1234u);
  };
  ASSERT_TRUE(rig_.freeze(0));
  stands();
  rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) | reg::kMcrMdis);
  rig_.run(4);
  stands();
  rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) & ~reg::kMcrMdis);
  rig_.node(0).request_stop(true);
  rig_.run(4);
  stands();
  rig_.node(0).request_stop(false);
  rig_.go(0);
  EXPECT_GT(timer(), 0x1234u);
}

// FX-6.c: a model of TIMER counts the samples of the node; where the first bit of the identifier
// begins, or anywhere in it, is the stamp. Own frames and others, and strictly increasing.
TEST_F(Timer, StampIsTimerAtTheIdentifier) {
  rig_.put_rx(0, 3, {.id = 0x155});
  std::uint32_t last = 0;
  for (unsigned i = 0; i < 20; ++i) {
    const bool own = i % 2 == 0;
    rig_.run(i * 3);
    if (own) rig_.put_tx(0, 8, {.id = 0x155});
    if (!own) rig_.put_tx(1, 8, {.id = 0x155});
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(0) == Field::kId; }, 400));
    // The field is the identifier from the sample point of SOF on; a read takes three clocks.
    const std::uint32_t at_id = timer();
    ASSERT_TRUE(rig_.wait_flag(0, own ? 8 : 3));
    const std::uint32_t stamp = rig_.read(0, reg::mb(own ? 8 : 3)) & 0xFFFF;
    EXPECT_GE(stamp + 1, at_id) << i;
    EXPECT_LE(stamp, at_id + 1) << i;
    EXPECT_GT(stamp, last);
    last = stamp;
    rig_.write(0, reg::kIflag1, ~0u);
    rig_.write(1, reg::kIflag1, ~0u);
    timer();
    rig_.run(12 * kBit);
  }
}

TEST_F(Timer, SoftResetZeroesIt) {  // FX-2.3.b, FX-MAP.TIMER
  write_timer(0x4321);
  rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
  rig_.run(3 * kBit);
  EXPECT_EQ(timer(), 0u);
}

TEST_F(Timer, TsynZeroesItForTheFirstBufferOnly) {  // FX-2.10.a, FX-CTRL1.TSYN
  ASSERT_NO_FATAL_FAILURE(use_tsyn());
  write_timer(0x4000);
  receive(0x101);
  EXPECT_GT(timer(), 0x4000u);
  receive(0x100);
  EXPECT_LT(timer(), 30u);
}

TEST_F(Timer, WithoutTsynNothingZeroesIt) {  // FX-CTRL1.TSYN
  rig_.put_rx(0, 0, {.id = 0x100});
  write_timer(0x4000);
  receive(0x100);
  EXPECT_GT(timer(), 0x4000u);
}

// FX-2.10.a: a write of the CPU in any clock around the reception: before it, or in its clock, it
// is discarded.
TEST_F(Timer, WriteBesideTsyn) {
  ASSERT_NO_FATAL_FAILURE(use_tsyn());
  bool later = false;
  unsigned early = 0, late = 0;
  for (unsigned k = 0; k < 70 * kBit; ++k) {
    // The same clock of a bit each time, so that the frame begins as many clocks from here.
    const auto boundary = [&] { return (rig_.node(1).trace() & kTraceBoundary) != 0; };
    ASSERT_TRUE(rig_.run_until(boundary, 2 * kBit));
    rig_.put_tx(1, 8, {.id = 0x100});
    rig_.run(k);
    rig_.node(0).ahb().submit({.address = reg::kTimer, .write = true, .data = 0x8000});
    rig_.run(71 * kBit - k);
    const bool survived = timer() >= 0x8000;
    ASSERT_TRUE(survived || !later) << k << ": discarded after the reception";
    later |= survived;
    ++(survived ? late : early);
    rig_.write(0, reg::kIflag1, ~0u);
    rig_.write(1, reg::kIflag1, ~0u);
    rig_.run(12 * kBit);
  }
  EXPECT_GT(early, 50 * kBit) << "the frame ends after some 50 bits";
  EXPECT_GT(late, 4 * kBit);
}

// CTRL1.PRESDIV: clocks of a time quantum less one; with TIMER, which counts bits, as the measure.
TEST(TimerRate, FollowsPresdiv) {  // FX-CTRL1.PRESDIV, FX-6.a, BT-02
  for (const unsigned presdiv : {0u, 1u, 2u, 4u, 9u, 30u}) {
    MailboxRig rig{1};
    RigConfig config;
    config.ctrl |= presdiv << 24;
    rig.configure(0, config);
    rig.go(0);
    const unsigned bit = 8 * (presdiv + 1);
    rig.write(0, reg::kTimer, 0);
    rig.run(50 * bit);
    EXPECT_NEAR(rig.read(0, reg::kTimer), 50, 1) << presdiv;
  }
}

}  // namespace
}  // namespace vericansim
