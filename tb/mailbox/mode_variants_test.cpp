// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Normal mode and its variants: listen-only, loop-back, self-reception, triple sampling (flexcan.md
// 2.4 to 2.7).
#include <gtest/gtest.h>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks
constexpr Time kClock = 125 * kNanosecond;
constexpr std::uint32_t kNoSrxDis = reg::kMcrBcc;

// Node 0 is the one in question, 1 sends, 2 acknowledges.
class ModeVariants : public ::testing::Test {
 protected:
  ModeVariants() : rig_{3, 16} {}
  void start(const RigConfig &config) {
    for (unsigned n = 0; n < 3; ++n) {
      rig_.configure(n, n == 0 ? config : RigConfig{});
      rig_.put_rx(n, 3, {.id = 0x155}, 0);
    }
    for (unsigned n = 0; n < 3; ++n) rig_.go(n);
  }
  // Runs, and counts the dominant clocks of node 0.
  unsigned dominant(unsigned clocks) {
    unsigned count = 0;
    for (unsigned i = 0; i < clocks; ++i) {
      rig_.run(1);
      count += rig_.node(0).tx() == Level::kDominant;
    }
    return count;
  }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }
  MailboxRig rig_;
};

TEST_F(ModeVariants, ListenOnlyReceivesAndIsSilent) {  // FX-2.4.a, FX-CTRL1.LOM, MO-01
  start({.ctrl = kTiming8 | reg::kCtrlLom});
  rig_.put_tx(0, 8, {.id = 0x001});
  rig_.put_tx(1, 8, {.id = 0x155, .dlc = 1, .data = {9}});
  EXPECT_EQ(dominant(100 * kBit), 0u);
  EXPECT_EQ(rig_.flags(0), 1u << 3);
  EXPECT_EQ(mb_frame(rig_.get(0, 3)), (Frame{.id = 0x155, .dlc = 1, .data = {9}}));
  EXPECT_EQ(rig_.read(0, reg::mb(8)) >> 24, 0xCu) << "pending";
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kCtrl, kTiming8);
  rig_.go(0);
  EXPECT_TRUE(rig_.wait_flag(0, 8)) << "sent after it";
}

TEST_F(ModeVariants, ListenOnlyFreezesTheCounters) {  // FX-2.4.a, FC-22
  start({.ctrl = kTiming8 | reg::kCtrlLom});
  const Time now = rig_.bus().now();
  LevelFault noise{0, Effect::kDominant, {now, now + 100 * kBit * kClock}};
  rig_.bus().add(noise);
  EXPECT_EQ(dominant(200 * kBit), 0u);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0u);
  EXPECT_NE(esr() & 0x0C00, 0u) << "it has seen errors";
  EXPECT_EQ(esr() & 0x30, 0x10u) << "FX-2.4.b";
}

TEST_F(ModeVariants, LoopBackReceivesOwnFramesAndLeavesThePinsAlone) {  // FX-2.5.a, MO-04
  start({.mcr = kNoSrxDis, .ctrl = kTiming8 | reg::kCtrlLpb});
  const Time now = rig_.bus().now();
  LevelFault noise{0, Effect::kFlip, {now, now + 100 * kBit * kClock}};
  rig_.bus().add(noise);
  const Frame frame{.id = 0x155, .dlc = 2, .data = {1, 2}};
  rig_.put_tx(0, 8, frame);
  EXPECT_EQ(dominant(120 * kBit), 0u);
  EXPECT_EQ(rig_.flags(0), 1u << 8 | 1u << 3);
  EXPECT_EQ(mb_frame(rig_.get(0, 3)), frame);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0u);
  EXPECT_EQ(esr() & 0xFC02, 0u) << "no acknowledge is asked for";
  EXPECT_EQ(rig_.flags(1) | rig_.flags(2), 0u);
}

TEST_F(ModeVariants, LoopBackWithSrxDisSendsOnly) {  // FX-2.5.a, FX-MCR.SRX_DIS
  start({.ctrl = kTiming8 | reg::kCtrlLpb});
  rig_.put_tx(0, 8, {.id = 0x155});
  EXPECT_TRUE(rig_.wait_flag(0, 8));
  rig_.run(20 * kBit);
  EXPECT_EQ(rig_.flags(0), 1u << 8);
}

TEST_F(ModeVariants, SelfReception) {  // FX-2.6.a, FX-MCR.SRX_DIS, MO-06
  for (const bool disabled : {false, true}) {
    MailboxRig rig{2, 16};
    rig.configure(0, {.mcr = disabled ? reg::kMcrBcc | reg::kMcrSrxDis : kNoSrxDis});
    rig.configure(1);
    rig.put_rx(0, 3, {.id = 0x155}, 0);
    for (unsigned n = 0; n < 2; ++n) rig.go(n);
    const Frame frame{.id = 0x155, .dlc = 1, .data = {5}};
    rig.put_tx(0, 8, frame);
    ASSERT_TRUE(rig.wait_flag(0, 8));
    rig.run(4 * kBit);
    EXPECT_EQ(rig.flags(0), disabled ? 1u << 8 : 1u << 8 | 1u << 3);
    if (!disabled) {
      EXPECT_EQ(mb_frame(rig.get(0, 3)), frame);
    }
  }
}

TEST_F(ModeVariants, OwnFrameThatLostIsNotSelfReceived) {  // FX-2.6.a, MO-06
  start({.mcr = kNoSrxDis});
  rig_.put_tx(0, 8, {.id = 0x2AA, .dlc = 1, .data = {1}});
  rig_.put_tx(1, 8, {.id = 0x155, .dlc = 1, .data = {2}});
  ASSERT_TRUE(rig_.wait_flag(1, 8));
  rig_.run(4 * kBit);
  EXPECT_EQ(mb_frame(rig_.get(0, 3)), (Frame{.id = 0x155, .dlc = 1, .data = {2}}));
}

// FX-2.7.a, FX-CTRL1.SMP: one wrong clock, wherever in a bit, is outvoted by two good samples;
// with a single sample the same disturbance is an error somewhere.
TEST_F(ModeVariants, TripleSamplingOutvotesAWrongSample) {
  for (const bool triple : {false, true}) {
    unsigned errors = 0;
    for (unsigned clock = 0; clock < kBit; ++clock) {
      MailboxRig rig{2, 16};
      rig.configure(0, {.ctrl = kTiming8 | (triple ? reg::kCtrlSmp : 0)});
      rig.configure(1);
      for (unsigned n = 0; n < 2; ++n) rig.go(n);
      // In the second of two dominant bits, so that no edge is near.
      PlaceFault glitch{
          0,
          {.frame = 1, .field = Field::kDlc, .index = 1, .first_clock = clock, .last_clock = clock},
          Effect::kRecessive};
      rig.bus().add(glitch);
      rig.put_tx(1, 8, {.id = 0x155, .dlc = 0});
      ASSERT_TRUE(rig.wait_flag(1, 8));
      EXPECT_GT(glitch.hits(), 0u);
      errors += (rig.read(0, reg::kEsr) & 0xFC00) != 0 || rig.read(1, reg::kEcr) != 0;
    }
    EXPECT_EQ(errors != 0, !triple) << errors;
  }
}

}  // namespace
}  // namespace vericansim
