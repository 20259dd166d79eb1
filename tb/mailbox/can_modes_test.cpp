// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Modes: disable, freeze, normal, soft reset, and their limits in time (flexcan.md section 2).
#include <gtest/gtest.h>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kFreezeRequest = reg::kMcrFrz | reg::kMcrHalt;
constexpr std::uint32_t kNotRdy = 1u << 27;
constexpr unsigned kBit = 8;  // clocks

class Modes : public ::testing::Test {
 protected:
  Modes() : rig_{2} {
    for (unsigned n = 0; n < 2; ++n) {
      rig_.configure(n);
      rig_.go(n);
    }
  }
  std::uint32_t mcr(unsigned n = 0) { return rig_.read(n, reg::kMcr); }
  bool mcr_gets(std::uint32_t mask, std::uint32_t value, unsigned clocks, unsigned n = 0) {
    return rig_.run_until([&] { return (mcr(n) & mask) == value; }, clocks);
  }
  // Node `n` is in the middle of a frame that node `sender` sends.
  void frame_under_way(unsigned sender) {
    rig_.put_tx(sender, 40, {.id = 0x155, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(sender) == Field::kData; }, 4000));
  }
  MailboxRig rig_;
};

TEST_F(Modes, NormalModeShowsNoAcknowledge) {
  EXPECT_EQ(mcr() & (reg::kMcrFrzAck | reg::kMcrLpmAck | kNotRdy), 0u);
}

TEST_F(Modes, FreezeInIdleIsImmediate) {  // 2.2
  EXPECT_TRUE(rig_.freeze(0, 4 * kBit));
  EXPECT_EQ(mcr() & (reg::kMcrFrzAck | reg::kMcrLpmAck | kNotRdy), reg::kMcrFrzAck | kNotRdy);
}

TEST_F(Modes, FreezeWaitsForTheEndOfTheFrame) {  // 2.2: sender and receiver
  rig_.put_rx(0, 3, {.id = 0x155});
  frame_under_way(1);
  EXPECT_TRUE(rig_.freeze(0, 200 * kBit));
  EXPECT_EQ(rig_.flags(0), 1u << 3) << "the frame under way was received";
  EXPECT_TRUE(rig_.wait_flag(1, 40)) << "and acknowledged";
  EXPECT_EQ(rig_.read(1, reg::kEcr), 0u);
}

TEST_F(Modes, FreezeLetsTheOwnFrameEnd) {
  frame_under_way(0);
  EXPECT_TRUE(rig_.freeze(0, 200 * kBit));
  EXPECT_EQ(rig_.flags(0), 1ull << 40);
  EXPECT_EQ(rig_.read(0, reg::mb(40)) >> 24, 0x8u);
}

TEST_F(Modes, LeavingFreezeDoesNotWaitForTheBus) {  // 2.2, 8.2: 250 us whatever the bit rate
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kMcr, mcr() & ~reg::kMcrHalt);
  EXPECT_TRUE(mcr_gets(reg::kMcrFrzAck | kNotRdy, 0, 8));
}

TEST_F(Modes, TimerStandsStillInFreezeMode) {  // 2.2, section 6
  ASSERT_TRUE(rig_.freeze(0));
  const std::uint32_t timer = rig_.read(0, reg::kTimer);
  rig_.run(20 * kBit);
  EXPECT_EQ(rig_.read(0, reg::kTimer), timer);
  rig_.go(0);
  EXPECT_GT(rig_.read(0, reg::kTimer), timer);
}

TEST_F(Modes, DisableFromFreezeAndBackIsImmediate) {  // 2.1
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck | reg::kMcrFrzAck, reg::kMcrLpmAck, 8));
  rig_.write(0, reg::kMcr, mcr() & ~reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck | reg::kMcrFrzAck, reg::kMcrFrzAck, 8));
}

TEST_F(Modes, DisableInIdle) {  // 2.1
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck, reg::kMcrLpmAck, 4 * kBit));
}

TEST_F(Modes, NoHandshakeHangsOnABusStuckDominant) {  // section 10 item 3
  LevelFault stuck{kAllNodes, Effect::kDominant, {rig_.bus().now(), kSecond}};
  rig_.bus().add(stuck);
  rig_.run(40 * kBit);
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck, reg::kMcrLpmAck, 4 * kBit));
  rig_.write(0, reg::kMcr, mcr() & ~reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck, 0, 8));
  EXPECT_TRUE(rig_.freeze(0, 4 * kBit));
  EXPECT_TRUE(rig_.freeze(1, 4 * kBit));
}

TEST_F(Modes, DisableWhileReceivingTakesLessThanTwoBits) {  // 8.2: 250 us at 10 kbit/s
  frame_under_way(1);
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck, reg::kMcrLpmAck, 2 * kBit));
  EXPECT_EQ(rig_.node(0).tx(), Level::kRecessive);
}

TEST_F(Modes, DisableLetsTheOwnFrameEnd) {  // 2.1
  frame_under_way(0);
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  EXPECT_TRUE(mcr_gets(reg::kMcrLpmAck, reg::kMcrLpmAck, 200 * kBit));
  EXPECT_EQ(rig_.flags(0), 1ull << 40);
}

TEST_F(Modes, EverythingIsReadableInDisableMode) {  // section 0 item 9
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kEcr, 0x1122);
  rig_.write(0, reg::mb(5, 1), 0x12345678);
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  rig_.run(8);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0x1122u);
  EXPECT_EQ(rig_.read(0, reg::mb(5, 1)), 0x12345678u);
  EXPECT_EQ(rig_.read(0, reg::rximr(5)), 0xFFFFFFFFu);
  rig_.write(0, reg::kEcr, 0);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0x1122u) << "written in freeze mode only";
}

TEST_F(Modes, WithdrawnFreezeRequestLeavesTheNodeOnTheBus) {
  frame_under_way(0);
  rig_.write(0, reg::kMcr, mcr() | kFreezeRequest);
  rig_.run(kBit);
  rig_.write(0, reg::kMcr, mcr() & ~reg::kMcrHalt);
  EXPECT_TRUE(rig_.wait_flag(0, 40));
  EXPECT_EQ(mcr() & reg::kMcrFrzAck, 0u);
  rig_.put_tx(0, 41, {.id = 1});
  EXPECT_TRUE(rig_.wait_flag(0, 41));
}

// ---- Soft reset (2.3)

class SoftReset : public Modes {
 protected:
  // The bare word that Linux writes; FRZ and HALT are zero in it.
  void soft_reset(unsigned limit = 2 * kBit + 8) {
    rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
    EXPECT_TRUE(mcr_gets(reg::kMcrSoftRst, 0, limit));
    EXPECT_EQ(mcr(), 0x5980000F) << "already in freeze mode when SOFT_RST reads 0";
  }
};

TEST_F(SoftReset, FromNormalModeWithinTwoBits) { soft_reset(); }

TEST_F(SoftReset, FromTheMiddleOfAFrame) {
  frame_under_way(0);
  soft_reset();
  EXPECT_EQ(rig_.node(0).tx(), Level::kRecessive);
  EXPECT_EQ(rig_.read(0, reg::mb(40)) >> 24, 0xCu) << "buffers survive";
  rig_.run(100 * kBit);
  EXPECT_EQ(rig_.flags(0), 0u) << "no bus participation afterwards";
}

TEST_F(SoftReset, KeepsAndClearsWhatSection2Says) {
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kEcr, 0x4455);
  rig_.write(0, reg::kTimer, 0x1234);
  rig_.write(0, reg::kImask1, 0xFF);
  rig_.write(0, reg::kImask2, 0xFF);
  rig_.write(0, reg::kCtrl, 0x01234567 & 0xFFFFDCFF);
  rig_.write(0, reg::kRxgmask, 0x55AA55AA);
  rig_.write(0, reg::rximr(7), 0x11223344);
  rig_.write(0, reg::mb(9, 2), 0xCAFEBABE);
  soft_reset();
  for (std::uint32_t gone :
       {reg::kEcr, reg::kTimer, reg::kImask1, reg::kImask2, reg::kIflag1, reg::kEsr})
    EXPECT_EQ(rig_.read(0, gone), 0u) << std::hex << gone;
  EXPECT_EQ(rig_.read(0, reg::kCtrl), 0x01234567u & 0xFFFFD0FFu) << "warning masks need WRN_EN";
  EXPECT_EQ(rig_.read(0, reg::kRxgmask), 0x55AA55AAu);
  EXPECT_EQ(rig_.read(0, reg::rximr(7)), 0x11223344u);
  EXPECT_EQ(rig_.read(0, reg::mb(9, 2)), 0xCAFEBABEu);
}

TEST_F(SoftReset, IsIgnoredInDisableMode) {
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrMdis);
  rig_.run(4 * kBit);
  rig_.write(0, reg::kImask1, 0x77);
  rig_.write(0, reg::kMcr, mcr() | reg::kMcrSoftRst);
  EXPECT_EQ(mcr() & reg::kMcrSoftRst, 0u);
  rig_.run(10);
  EXPECT_EQ(rig_.read(0, reg::kImask1), 0x77u);
}

class BusOff : public ::testing::Test {
 protected:
  // A receiver that hears nothing: each SOF is a bit error, each bit of the error flag another.
  BusOff() : deaf_{0, Effect::kRecessive, {kMillisecond, 5 * kMillisecond}} {
    rig_.bus().add(deaf_);
    rig_.configure(0, {.ctrl = kTiming8 | reg::kCtrlBoffRec});
    rig_.go(0);
    rig_.run_until([&] { return rig_.bus().now() > kMillisecond; }, 10000);
    rig_.put_tx(0, 1, {.id = 0x100});
    EXPECT_TRUE(rig_.run_until([&] { return (esr() & 0x20) != 0; }, 4000));
  }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }
  LevelFault deaf_;
  MailboxRig rig_;
};

TEST_F(BusOff, IsReported) {  // 1.4, 2.8, section 7
  EXPECT_EQ(esr() & 0x30034, 0x20024u) << "FLT_CONF 1x, BOFF_INT, TWRN_INT; no RWRN_INT";
  EXPECT_EQ(esr() & 0x300, 0u) << "no warning status in bus-off";
  rig_.write(0, reg::kEsr, 0x00030006);
  EXPECT_EQ(esr() & 0x30006, 0u);
}

TEST_F(BusOff, SoftResetEndsItWithoutBoffInt) {  // 2.3, erratum e7322
  rig_.write(0, reg::kEsr, 0x00030006);
  rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
  EXPECT_TRUE(
      rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrSoftRst) == 0; }, 3 * kBit));
  EXPECT_EQ(esr(), 0u);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0u);
  rig_.run_until([&] { return rig_.bus().now() > 5 * kMillisecond; }, 80000);
  rig_.go(0);
  EXPECT_EQ(esr() & 0x34, 0u);
}

TEST_F(BusOff, FreezeIsImmediate) {  // 2.2, erratum ERR009595
  EXPECT_TRUE(rig_.freeze(0, 2 * kBit));
}

TEST_F(BusOff, DisableIsImmediate) {  // 2.1
  rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) | reg::kMcrMdis);
  EXPECT_TRUE(
      rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrLpmAck) != 0; }, 2 * kBit));
}

TEST(ListenOnly, FreezeWorksAndFltConfReadsPassive) {  // 2.4
  MailboxRig rig{1};
  rig.configure(0, {.ctrl = kTiming8 | reg::kCtrlLom});
  rig.go(0);
  EXPECT_EQ((rig.read(0, reg::kEsr) >> 4) & 3, 1u);
  EXPECT_TRUE(rig.freeze(0, 64));
}

}  // namespace
}  // namespace vericansim
