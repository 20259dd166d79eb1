// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Normal mode and its variants: listen-only, loop-back, self-reception, triple sampling (flexcan.md
// 2.4 to 2.7), tolerance of CAN FD frames (XCTRL).
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"
#include "model/frame_codec.hpp"

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

// MO-02, FX-ESR1.SYNCH, FX-ESR1.IDLE, FX-ESR1.RX, FX-ESR1.STF_ERR: a listener that joins anew.
TEST_F(ModeVariants, ListenOnlyIsNotInStepAfterAnError) {
  start({.ctrl = kTiming8 | reg::kCtrlLom});
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(0) == Field::kIdle; }, 30 * kBit));
  rig_.put_tx(1, 8, {.id = 0x155, .dlc = 8, .data = {0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55}});
  rig_.put_tx(1, 9, {.id = 0x156, .dlc = 1, .data = {2}});
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(0) == Field::kData; }, 60 * kBit));
  const Time now = rig_.bus().now();
  LevelFault noise{0, Effect::kRecessive, {now, now + 7 * kBit * kClock}};
  rig_.bus().add(noise);
  constexpr std::uint32_t kLive = 1u << 18 | 1u << 7 | 1u << 6 | 1u << 3;  // SYNCH, IDLE, TX, RX
  constexpr std::uint32_t kStuff = 1u << 10;
  EXPECT_EQ(esr() & (kLive | kStuff), 1u << 18 | 1u << 3);
  rig_.run(10 * kBit);
  EXPECT_EQ(esr() & (kLive | kStuff), kStuff);
  ASSERT_TRUE(rig_.wait_flag(1, 8));
  rig_.put_rx(0, 3, {.id = 0x156}, 0);
  EXPECT_TRUE(rig_.run_until([&] { return (esr() & kLive) == (1u << 18 | 1u << 3); }, 20 * kBit));
  EXPECT_TRUE(rig_.wait_flag(0, 3)) << "the next frame";
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

constexpr std::uint32_t kFdTol = 1u << 0;                   // XCTRL
constexpr unsigned kTec = 17, kRec = 33;                    // node 0 begins with them
constexpr std::uint32_t kErrors = 0xFC00, kStf = 1u << 10;  // ESR1

// Frames with a recessive FDF bit, which nobody here can send: a script drives the bus.
class FdTolerance : public ModeVariants {
 protected:
  FdTolerance() {
    start({});
    rig_.put_rx(0, 4, kExtended);
    rig_.bus().add(script_);
  }
  void prepare(bool tolerant) {
    ASSERT_TRUE(rig_.freeze(0));
    rig_.write(0, reg::kExtControl, tolerant ? kFdTol : 0);
    rig_.write(0, reg::kEcr, kRec << 8 | kTec);
    rig_.write(0, reg::kIflag1, 0xFFFF);
    rig_.go(0);
    esr();  // clears the error bits
  }
  // The frame with its FDF bit, which is r0 or, if it is extended, r1; nobody has acknowledged it.
  static std::vector<WireBit> fd_bits(const Frame &frame) {
    const Level r = Level::kRecessive;
    return encode_frame(frame, {.r0 = frame.extended ? Level::kDominant : r,
                                .r1 = frame.extended ? r : Level::kDominant,
                                .ack_slot = r})
        .bits;
  }
  static bool is_fdf(const WireBit &bit) {
    return !bit.is_stuff && bit.level == Level::kRecessive &&
           (bit.field == Field::kR0 || bit.field == Field::kR1);
  }
  // On the whole bus; returns the dominant clocks of node 0 until the bus has long been idle.
  unsigned play(const std::vector<WireBit> &bits) {
    Time at = rig_.bus().now();
    for (const WireBit &bit : bits) {
      const Time end = at + kBit * kClock;
      if (bit.level == Level::kDominant) script_.add(kAllNodes, Effect::kDominant, {at, end});
      at = end;
    }
    return dominant((static_cast<unsigned>(bits.size()) + 40) * kBit);
  }
  void expect_counters(unsigned rec) { EXPECT_EQ(rig_.read(0, reg::kEcr), rec << 8 | kTec); }
  void expect_next_frame_received() {
    rig_.put_tx(1, 8, {.id = 0x2AA, .dlc = 1, .data = {7}});
    EXPECT_TRUE(rig_.wait_flag(0, 3));
    EXPECT_EQ(esr() & kErrors, 0u);
  }
  static constexpr Frame kBase{.id = 0x155, .dlc = 2, .data = {0xA5, 0x3C}};
  static constexpr Frame kExtended{
      .id = 0x12345678, .extended = true, .dlc = 2, .data = {0xA5, 0x3C}};
  ScheduledFaults script_;
};

// Classic nodes take either level of the reserved bit (FF-05), a tolerant one stays out: no
// acknowledge, no reception, not even REC - 1.
TEST_F(FdTolerance, RecessiveReservedBit) {  // FF-05, FF-06
  for (const bool tolerant : {false, true}) {
    for (const Frame &frame : {kBase, kExtended}) {
      SCOPED_TRACE(testing::Message() << "FDTOL " << tolerant << ", IDE " << frame.extended);
      prepare(tolerant);
      EXPECT_EQ(play(fd_bits(frame)), tolerant ? 0u : kBit);
      EXPECT_EQ(rig_.flags(0), tolerant ? 0u : frame.extended ? 1u << 4 : 1u << 3);
      EXPECT_EQ(esr() & kErrors, 0u);
      expect_counters(tolerant ? kRec : kRec - 1);
      expect_next_frame_received();
    }
  }
}

// What follows the FDF bit is no CAN 2.0 frame: six dominant bits are a stuff error for classic
// nodes, which they flag, and nothing for a tolerant one.
TEST_F(FdTolerance, FormOfAnotherProtocol) {  // FF-06, ST-06, IN-05
  for (const bool tolerant : {false, true}) {
    for (const Frame &frame : {kBase, kExtended}) {
      SCOPED_TRACE(testing::Message() << "FDTOL " << tolerant << ", IDE " << frame.extended);
      prepare(tolerant);
      std::vector<WireBit> bits = fd_bits(frame);
      bits.erase(std::find_if(bits.begin(), bits.end(), is_fdf) + 1, bits.end());
      bits.insert(bits.end(), 6, {.level = Level::kDominant});
      EXPECT_EQ(play(bits), tolerant ? 0u : 6 * kBit) << "error flag";
      EXPECT_EQ(rig_.flags(0), 0u);
      EXPECT_EQ(esr() & kErrors, tolerant ? 0u : kStf);
      expect_counters(tolerant ? kRec : kRec + 1);
      expect_next_frame_received();
    }
  }
}

}  // namespace
}  // namespace vericansim
