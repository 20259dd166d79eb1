// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ESR1 and ECR against errors that come in any clock: nothing is lost, nothing is reported twice
// (flexcan.md 1.3, 1.4, section 7).
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks
constexpr std::uint32_t kErrors = 0xFC00, kAckErr = 1u << 13;
constexpr std::uint32_t kTwrnInt = 1u << 17, kRwrnInt = 1u << 16;
// A frame that nobody acknowledges, its error flag and delimiter, and intermission.
constexpr unsigned kAttempt = 70 * kBit;

// One node alone whose every attempt ends with an ACK error.
class ErrorStatus : public ::testing::Test {
 protected:
  ErrorStatus() : rig_{1, 16} {
    rig_.configure(0);
    rig_.go(0);
  }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }
  std::uint32_t ecr() { return rig_.read(0, reg::kEcr); }
  void preset(std::uint32_t ecr) {
    ASSERT_TRUE(rig_.freeze(0, 4000));
    rig_.write(0, reg::kEcr, ecr);
    rig_.go(0);
    rig_.write(0, reg::kEsr, reg::kEsrInterrupts);
    esr();
  }
  void align() {
    const auto boundary = [&] { return (rig_.node(0).trace() & kTraceBoundary) != 0; };
    ASSERT_TRUE(rig_.run_until(boundary, 2 * kBit));
  }
  // One attempt from a fixed clock of a bit, with an access `k` clocks into it; its result.
  std::uint32_t attempt(unsigned k, const AhbTransfer &transfer) {
    align();
    rig_.write(0, reg::kExtControl, 2);  // one-shot
    rig_.put_tx(0, 8, {.id = 0x123});
    rig_.run(k);
    const AhbMaster::Ticket ticket = rig_.node(0).ahb().submit(transfer);
    rig_.run(kAttempt - k);
    return rig_.node(0).ahb().result(ticket).data;
  }
  MailboxRig rig_;
};

// FX-1.4.b, FX-ESR1.ACK_ERR: a read in every clock: either it returns the error, or the next does.
TEST_F(ErrorStatus, AReadInAnyClockSeesEachErrorOnce) {
  unsigned by_first = 0;
  for (unsigned k = 0; k < kAttempt - 10; ++k) {
    if (k % 8 == 0) preset(0);
    const std::uint32_t first = attempt(k, {.address = reg::kEsr}) & kErrors;
    const std::uint32_t second = esr() & kErrors;
    ASSERT_EQ(first ^ second, kAckErr) << k;
    ASSERT_EQ(first & second, 0u) << k;
    by_first += first != 0;
  }
  EXPECT_GT(by_first, 50u);
}

// FX-1.4.a, FX-1.5.e, FX-7.b: clearing ERR_INT in every clock: the line rises for each error all
// the same.
TEST_F(ErrorStatus, AClearInAnyClockLosesNoErrorInterrupt) {
  rig_.write(0, reg::kCtrl, kTiming8 | reg::kCtrlErrMsk);
  unsigned cleared = 0;
  for (unsigned k = 0; k < kAttempt - 10; ++k) {
    if (k % 8 == 0) preset(0);
    align();
    rig_.write(0, reg::kExtControl, 2);
    rig_.put_tx(0, 8, {.id = 0x123});
    unsigned rises = 0;
    bool before = false;
    for (unsigned i = 0; i < kAttempt; ++i) {
      if (i == k)
        rig_.node(0).ahb().submit({.address = reg::kEsr, .write = true, .data = reg::kEsrErrInt});
      rig_.run(1);
      const bool line = (rig_.node(0).irq_lines() & kIrqError) != 0;
      rises += line && !before;
      before = line;
    }
    ASSERT_EQ(rises, 1u) << k;
    cleared += !before;
    rig_.write(0, reg::kEsr, reg::kEsrErrInt);
    EXPECT_EQ(esr() & kErrors, kAckErr) << "W1C leaves the error bits";
    if (HasFailure()) return;
  }
  EXPECT_GT(cleared, 50u);
}

// FX-7.b: ERR_INT again with each error, also while the error bit is still set.
TEST_F(ErrorStatus, ErrIntWithEachErrorThoughTheBitIsSet) {
  for (unsigned i = 0; i < 4; ++i) {
    attempt(0, {.address = reg::kMcr});
    EXPECT_EQ(rig_.access(0, {.address = reg::kEsr, .size = AhbSize::kByte}).data & 2, 2u);
    rig_.write(0, reg::kEsr, reg::kEsrErrInt);
  }
  EXPECT_EQ(esr() & kErrors, kAckErr) << "the byte reads left it";
}

// FX-1.4.a: bits 15:10 are cleared by the read that returns them, and so by one that has their
// byte.
TEST_F(ErrorStatus, AReadOfOtherBytesLeavesTheErrorBits) {
  for (const auto &[offset, size, clears] : {std::tuple{0u, AhbSize::kByte, false},
                                             {2u, AhbSize::kByte, false},
                                             {3u, AhbSize::kByte, false},
                                             {2u, AhbSize::kHalf, false},
                                             {1u, AhbSize::kByte, true},
                                             {0u, AhbSize::kHalf, true}}) {
    preset(0);
    attempt(0, {.address = reg::kMcr});
    const AhbResult read = rig_.access(0, {.address = reg::kEsr + offset, .size = size});
    if (clears) EXPECT_EQ(read.data << 8 * offset & kErrors, kAckErr) << offset;
    EXPECT_EQ(esr() & kErrors, clears ? 0u : kAckErr) << offset;
  }
}

// FX-7.a, FX-ESR1.FLT_CONF: alone TEC rises to 128 and stays there.
TEST_F(ErrorStatus, AloneItNeverGoesBusOff) {
  rig_.put_tx(0, 8, {.id = 0x123});
  rig_.run(40 * kAttempt);
  EXPECT_EQ(ecr(), 128u);
  EXPECT_EQ(esr() & 0x334, 0x210u);
}

// FX-7.c, FX-ESR1.TWRN_INT, FX-ESR1.TX_WRN: from below 96 to 96 or more, each time, and then only.
TEST_F(ErrorStatus, TxWarningAtEachCrossing) {
  for (unsigned tec = 80; tec <= 120; ++tec) {
    preset(tec);
    EXPECT_EQ((esr() & 0x200) != 0, tec >= 96);
    attempt(0, {.address = reg::kMcr});
    EXPECT_EQ(ecr(), tec + 8);
    EXPECT_EQ(esr() & kTwrnInt, tec < 96 && tec + 8 >= 96 ? kTwrnInt : 0u) << tec;
  }
}

// FX-ESR1.RWRN_INT, FX-ESR1.RX_WRN, FX-7.c: the same for REC.
TEST_F(ErrorStatus, RxWarningAtEachCrossing) {
  std::vector<std::unique_ptr<LevelFault>> faults;
  for (const unsigned rec : {94u, 95u, 96u, 97u, 110u}) {
    preset(rec << 8);
    EXPECT_EQ((esr() & 0x100) != 0, rec >= 96);
    const Time now = rig_.bus().now();
    // A dominant phase without stuff bits: a receiver's error, counted once.
    faults.push_back(std::make_unique<LevelFault>(0, Effect::kDominant,
                                                  Window{now, now + 7 * kBit * 125 * kNanosecond}));
    rig_.bus().add(*faults.back());
    rig_.run(60 * kBit);
    EXPECT_EQ(ecr(), (rec + 1) << 8);
    EXPECT_EQ(esr() & kRwrnInt, rec == 95 ? kRwrnInt : 0u) << rec;
  }
}

// FX-ESR1.RX_WRN, FX-ESR1.TX_WRN: bus-off takes TEC away, not REC, and is no new crossing.
TEST_F(ErrorStatus, RxWarningStaysInBusOff) {
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kCtrl, kTiming8 | 1u << 6);  // BOFF_REC: it stays
  preset(110u << 8 | 255);
  PlaceFault fault{0, {.frame = 1, .field = Field::kId}, Effect::kRecessive};
  rig_.bus().add(fault);
  attempt(0, {.address = reg::kMcr});
  ASSERT_GT(fault.hits(), 0u);
  ASSERT_EQ(esr() & 0x20, 0x20u) << "FLT_CONF 1x";
  EXPECT_EQ(ecr() >> 8, 110u);
  EXPECT_EQ(esr() & 0x300, 0x100u);
  EXPECT_EQ(esr() & kRwrnInt, 0u);
}

// FX-MCR.WRN_EN, FX-CTRL1.TWRN_MSK, FX-CTRL1.RWRN_MSK: without it no flag, and masks that read 0.
TEST_F(ErrorStatus, WithoutWrnEnThereAreNoWarnings) {
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 15);
  preset(90);
  rig_.write(0, reg::kCtrl, kTiming8 | 0xC00);
  EXPECT_EQ(rig_.read(0, reg::kCtrl) & 0xC00, 0u);
  attempt(0, {.address = reg::kMcr});
  EXPECT_EQ(esr() & (kTwrnInt | kRwrnInt | 0x200), 0x200u) << "the status is there";
  EXPECT_EQ(rig_.node(0).irq_lines(), 0);
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | reg::kMcrWrnEn | 15);
  EXPECT_EQ(rig_.read(0, reg::kCtrl) & 0xC00, 0u) << "what could not be written is not there";
  EXPECT_EQ(esr() & kTwrnInt, 0u) << "nor a crossing of before";
}

// FX-MCR.WRN_EN: nor do they outlast it by a transfer.
TEST_F(ErrorStatus, WarningsGoWithWrnEn) {
  preset(0);
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kEcr, 0x6060);
  ASSERT_EQ(esr() & (kTwrnInt | kRwrnInt), kTwrnInt | kRwrnInt);
  const std::uint32_t mcr = rig_.read(0, reg::kMcr);
  const auto results =
      rig_.burst(0, {{.address = reg::kMcr, .write = true, .data = mcr & ~reg::kMcrWrnEn},
                     {.address = reg::kEsr}});
  EXPECT_EQ(results[1].data & (kTwrnInt | kRwrnInt), 0u);
  rig_.write(0, reg::kMcr, mcr);
  EXPECT_EQ(esr() & (kTwrnInt | kRwrnInt), 0u);
}

// FX-ECR.TEC, FX-ECR.REC: written in freeze mode only, by byte too.
TEST_F(ErrorStatus, CountersAreWrittenInFreezeModeOnly) {
  preset(0x1122);
  rig_.write(0, reg::kEcr, 0x3344);
  EXPECT_EQ(ecr(), 0x1122u);
  ASSERT_TRUE(rig_.freeze(0));
  rig_.access(0, {.address = reg::kEcr + 1, .write = true, .size = AhbSize::kByte, .data = 0x55});
  EXPECT_EQ(ecr(), 0x5522u);
  rig_.access(0, {.address = reg::kEcr, .write = true, .size = AhbSize::kByte, .data = 0x66});
  EXPECT_EQ(ecr(), 0x5566u);
}

// A fault at one place of the first frame that node 1 sends, seen by `node`, and the error bit that
// it has to bring.
struct Kind {
  const char *name;
  std::uint32_t bit;
  unsigned node;
  PlaceSpec place;
  Effect effect;
};

class ErrorKinds : public ::testing::TestWithParam<Kind> {};

// FX-ESR1.BIT1_ERR, FX-ESR1.BIT0_ERR, FX-ESR1.ACK_ERR, FX-ESR1.CRC_ERR, FX-ESR1.FRM_ERR,
// FX-ESR1.STF_ERR, FX-1.4.a, FX-9.imx: its bit and no other, until it is read; ERR_INT stays, and
// no other flag is set.
TEST_P(ErrorKinds, SetsItsBitUntilItIsRead) {
  const Kind &kind = GetParam();
  MailboxRig rig{3, 16};
  for (unsigned n = 0; n < 3; ++n) rig.configure(n);
  for (unsigned n = 0; n < 3; ++n) rig.go(n);
  PlaceFault fault{kind.node, kind.place, kind.effect};
  rig.bus().add(fault);
  rig.put_tx(1, 8, {.id = 0x155, .dlc = 1, .data = {0xA5}});
  ASSERT_TRUE(rig.wait_flag(1, 8));
  EXPECT_GT(fault.hits(), 0u);
  EXPECT_EQ(rig.read(kind.node, reg::kEsr) & (kErrors | reg::kEsrInterrupts),
            kind.bit | reg::kEsrErrInt);
  EXPECT_EQ(rig.read(kind.node, reg::kEsr) & (kErrors | reg::kEsrInterrupts), reg::kEsrErrInt);
}

INSTANTIATE_TEST_SUITE_P(
    All, ErrorKinds,
    ::testing::Values(
        Kind{"Bit1",
             1u << 15,
             1,
             {.frame = 1, .field = Field::kData, .index = 0},
             Effect::kDominant},
        Kind{"Bit0",
             1u << 14,
             1,
             {.frame = 1, .field = Field::kData, .index = 1},
             Effect::kRecessive},
        Kind{"Ack", 1u << 13, 1, {.frame = 1, .field = Field::kAck}, Effect::kRecessive},
        Kind{"Crc",
             1u << 12,
             0,
             {.frame = 1, .field = Field::kData, .index = 1},
             Effect::kRecessive},
        Kind{"Form",
             1u << 11,
             0,
             {.frame = 1, .field = Field::kCrcDel, .stuff = false},
             Effect::kDominant},
        Kind{"Stuff", 1u << 10, 0, {.frame = 1, .field = Field::kId}, Effect::kDominant}),
    [](const auto &each) { return each.param.name; });

// FX-ESR1.IDLE, FX-ESR1.TX, FX-ESR1.RX, FX-ESR1.SYNCH: live, for sender and receiver.
TEST(LiveStatus, FollowsTheFrame) {
  MailboxRig rig{2, 16};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  const auto status = [&](unsigned n) { return rig.read(n, reg::kEsr) & 0x400C8; };
  EXPECT_EQ(status(0), 0u) << "frozen: not synchronised";
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  EXPECT_EQ(status(0), 0x40080u);
  rig.put_tx(0, 8, {.id = 0x155, .dlc = 8});
  ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kData; }, 400));
  EXPECT_EQ(status(0), 0x40040u);
  EXPECT_EQ(status(1), 0x40008u);
  ASSERT_TRUE(rig.wait_flag(0, 8));
  rig.run(12 * kBit);
  EXPECT_EQ(status(0), 0x40080u);
  EXPECT_EQ(status(1), 0x40080u);
}

}  // namespace
}  // namespace vericansim
