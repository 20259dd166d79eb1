// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Events: ESR1, IFLAG, IMASK, interrupt lines (flexcan.md 1.4, 1.5, sections 5 and 7).
#include <gtest/gtest.h>

#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kAckErr = 1u << 13, kTwrnInt = 1u << 17, kRwrnInt = 1u << 16;

// One node alone: each attempt to send ends with an ACK error.
class Alone : public ::testing::Test {
 protected:
  Alone() : rig_{1} {
    rig_.configure(0);
    rig_.go(0);
  }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }
  std::uint32_t tec() { return rig_.read(0, reg::kEcr) & 0xFF; }
  void send() { rig_.put_tx(0, 10, {.id = 0x123}); }
  // Clears everything, then waits for the next ACK error without reading ESR1.
  void next_error() {
    const std::uint32_t before = tec();
    ASSERT_TRUE(rig_.run_until([&] { return tec() != before; }, 4000));
  }
  MailboxRig rig_;
};

TEST_F(Alone, ErrorBitsClearOnReadAndComeBackWithTheNextError) {  // 1.4
  send();
  next_error();
  EXPECT_EQ(esr() & 0xFC00, kAckErr);
  EXPECT_EQ(esr() & 0xFC00, 0u);
  EXPECT_EQ(esr() & reg::kEsrErrInt, reg::kEsrErrInt) << "reads leave the W1C bits alone";
  next_error();
  EXPECT_EQ(esr() & 0xFC00, kAckErr);
}

TEST_F(Alone, ByteReadBesideTheErrorBitsLeavesThem) {
  send();
  next_error();
  rig_.access(0, {.address = reg::kEsr, .size = AhbSize::kByte});
  EXPECT_EQ(esr() & 0xFC00, kAckErr);
}

TEST_F(Alone, NoErrorIsLostWhileTheCpuReadsEsrInEveryClock) {
  send();
  unsigned seen = 0;
  for (std::uint32_t counter = 0, round = 0; counter < 120; ++round) {
    // Bursts of changing length, so that reads meet the error in each clock of a bit.
    std::vector<AhbTransfer> transfers(4 + round % 7, AhbTransfer{.address = reg::kEsr});
    transfers.push_back({.address = reg::kEcr});
    const auto results = rig_.burst(0, transfers);
    for (std::size_t i = 0; i + 1 < results.size(); ++i) seen += (results[i].data & kAckErr) != 0;
    counter = results.back().data & 0xFF;
  }
  rig_.run(10);
  seen += (esr() & kAckErr) != 0;
  EXPECT_EQ(seen, tec() / 8);
}

TEST_F(Alone, ErrIntIsSetAgainByEachError) {  // section 7
  send();
  for (unsigned i = 0; i < 3; ++i) {
    next_error();
    EXPECT_EQ(esr() & reg::kEsrErrInt, reg::kEsrErrInt);
    rig_.write(0, reg::kEsr, reg::kEsrErrInt);
    EXPECT_EQ(esr() & reg::kEsrErrInt, 0u);
  }
}

TEST_F(Alone, TxWarningOnceOnTheWayUp) {  // 1.4, section 7
  send();
  while (tec() < 88) EXPECT_EQ(esr() & kTwrnInt, 0u);
  next_error();
  rig_.run(4);
  EXPECT_EQ(esr() & (kTwrnInt | kRwrnInt | 0x300), kTwrnInt | 0x200);
  rig_.write(0, reg::kEsr, kTwrnInt);
  next_error();
  EXPECT_EQ(esr() & (kTwrnInt | 0x200), 0x200u) << "crossing only";
}

TEST_F(Alone, FltConfFollowsTheCounters) {  // section 7
  send();
  while (tec() < 120) EXPECT_EQ(esr() & 0x30, 0u);
  next_error();
  rig_.run(4);
  EXPECT_EQ(esr() & 0x30, 0x10u);
}

TEST_F(Alone, NoWarningFlagsWithoutWrnEn) {  // 1.1 bit 21
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 0x3F);
  rig_.go(0);
  send();
  ASSERT_TRUE(rig_.run_until([&] { return tec() >= 104; }, 20000));
  EXPECT_EQ(esr() & (kTwrnInt | 0x200), 0x200u);
}

TEST_F(Alone, LinesAreGatedByTheirMasksAndStayUntilCleared) {  // section 5
  send();
  ASSERT_TRUE(rig_.run_until([&] { return tec() >= 96; }, 20000));
  rig_.run(4);
  EXPECT_EQ(rig_.node(0).irq_lines(), 0);
  const std::uint32_t ctrl = rig_.read(0, reg::kCtrl);
  rig_.write(0, reg::kCtrl, ctrl | reg::kCtrlErrMsk);
  rig_.run(4);
  EXPECT_EQ(rig_.node(0).irq_lines(), kIrqAll | kIrqError);
  rig_.write(0, reg::kCtrl, ctrl | (1u << 11));
  rig_.run(4);
  EXPECT_EQ(rig_.node(0).irq_lines(), kIrqAll | kIrqTxWarning);
  rig_.run(100);
  EXPECT_EQ(rig_.node(0).irq_lines(), kIrqAll | kIrqTxWarning);
  rig_.write(0, reg::kEsr, kTwrnInt);
  rig_.run(4);
  EXPECT_EQ(rig_.node(0).irq_lines(), 0);
}

TEST_F(Alone, OneShotStartsOnceAndReportsAbort) {  // extension page; MO-09
  rig_.write(0, reg::kExtControl, 2);
  send();
  EXPECT_TRUE(rig_.wait_flag(0, 10));
  EXPECT_EQ(rig_.read(0, reg::mb(10)) >> 24, 0x9u);
  rig_.run(2000);
  EXPECT_EQ(tec(), 8u);
}

TEST(RxWarning, ReceiverCountsUp) {  // 1.4: RWRN_INT and RX_WRN
  MailboxRig rig{2};
  LevelFault flip{0, Effect::kDominant, {500 * kMicrosecond, kMillisecond}};
  rig.bus().add(flip);
  rig.configure(0);
  rig.configure(1);
  rig.go(0);
  rig.go(1);
  // A receiver that sees the bus stuck dominant after its error flag adds 8 every eight bits.
  ASSERT_TRUE(rig.run_until([&] { return ((rig.read(0, reg::kEcr) >> 8) & 0xFF) >= 96; }, 12000));
  rig.run(4);
  EXPECT_EQ(rig.read(0, reg::kEsr) & (kTwrnInt | kRwrnInt | 0x300), kRwrnInt | 0x100);
}

TEST(Flags, EachBufferHasItsBitAndItsMask) {  // FX-1.5.a, FX-1.5.b, FX-5.MB
  MailboxRig rig{2};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  for (unsigned mb = 0; mb < 64; ++mb) {
    rig.put_tx(0, mb, {.id = 0x100 + mb});
    ASSERT_TRUE(rig.wait_flag(0, mb));
    EXPECT_EQ(rig.flags(0), 1ull << mb);
    EXPECT_EQ(rig.node(0).irq_lines(), 0);
    rig.write(0, reg::kImask1, mb < 32 ? 1u << mb : 0);
    rig.write(0, reg::kImask2, mb < 32 ? 0 : 1u << (mb - 32));
    rig.run(4);
    EXPECT_EQ(rig.node(0).irq_lines(), kIrqAll | kIrqMb);
    rig.write(0, mb < 32 ? reg::kIflag1 : reg::kIflag2, ~(1u << (mb % 32)));
    EXPECT_EQ(rig.flags(0), 1ull << mb) << "zero clears nothing";
    rig.clear_flag(0, mb);
    EXPECT_EQ(rig.flags(0), 0u);
    rig.run(4);
    EXPECT_EQ(rig.node(0).irq_lines(), 0);
  }
}

TEST(Flags, SettingBeatsClearingInTheSameClock) {  // 1.5: the CPU clears in every clock
  MailboxRig rig{2};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  for (unsigned i = 0; i < 8; ++i) {
    rig.put_tx(0, 7, {.id = 0x100});
    // W1C and read in turn: each flag must be seen, whichever of the two clocks it comes in.
    bool seen = false;
    for (unsigned j = 0; j < 1000 && !seen; ++j) {
      std::vector<AhbTransfer> transfers;
      for (unsigned k = 0; k < i % 2; ++k) transfers.push_back({.address = reg::kIflag2});
      transfers.push_back({.address = reg::kIflag1});
      transfers.push_back({.address = reg::kIflag1, .write = true, .data = 1u << 9});
      for (const AhbResult &result : rig.burst(0, transfers))
        seen |= (result.data & (1u << 7)) != 0;
    }
    EXPECT_TRUE(seen);
    rig.clear_flag(0, 7);
  }
}

TEST(Completion, CodeAndStampAreThereBeforeTheFlag) {  // 3.3
  MailboxRig rig{2};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  rig.put_tx(0, 7, {.id = 0x100});
  std::vector<AhbResult> results;
  do {
    results = rig.burst(
        0, {{.address = reg::kIflag1}, {.address = reg::mb(7)}, {.address = reg::kIflag1}});
    const bool active = (results[1].data >> 24) == 0xC;
    EXPECT_FALSE(active && results[0].data != 0);
  } while (results[0].data == 0);
  EXPECT_EQ(results[1].data >> 16, 0x0800u);
  EXPECT_NE(results[1].data & 0xFFFF, 0u);
}

TEST(Completion, RemoteFrameBufferTurnsIntoAnEmptyOne) {  // 3.2, 3.7
  MailboxRig rig{2};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  rig.put_tx(0, 7, {.id = 0x100, .remote = true, .dlc = 3});
  ASSERT_TRUE(rig.wait_flag(0, 7));
  EXPECT_EQ(rig.read(0, reg::mb(7)) & 0x0F7F0000, 0x04130000u);
  rig.clear_flag(0, 7);
  rig.put_tx(1, 9, {.id = 0x100, .dlc = 3, .data = {1, 2, 3}});
  ASSERT_TRUE(rig.wait_flag(0, 7));
  EXPECT_EQ(mb_frame(rig.get(0, 7)), (Frame{.id = 0x100, .dlc = 3, .data = {1, 2, 3}}));
}

}  // namespace
}  // namespace vericansim
