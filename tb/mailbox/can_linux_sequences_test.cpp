// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The access sequences of the Linux driver, one by one, with its time limits (flexcan.md 8.2).
#include <gtest/gtest.h>

#include <vector>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned k250us = 2000;  // clocks at 8 MHz

class LinuxDriver : public ::testing::Test {
 protected:
  LinuxDriver() : rig_{2} { rig_.run(300); }

  std::uint32_t mcr(unsigned n) { return rig_.read(n, reg::kMcr); }
  void write_mcr(unsigned n, std::uint32_t value) { rig_.write(n, reg::kMcr, value); }
  void poll(unsigned n, std::uint32_t mask, bool set, unsigned clocks) {
    ASSERT_TRUE(rig_.run_until([&] { return ((mcr(n) & mask) != 0) == set; }, clocks))
        << std::hex << mask;
  }

  void probe(unsigned n) {
    EXPECT_EQ(mcr(n), 0xD890000Fu);
    write_mcr(n, mcr(n) | reg::kMcrMdis);
    poll(n, reg::kMcrLpmAck, true, k250us);
    rig_.write(n, reg::kCtrl, rig_.read(n, reg::kCtrl) | (1u << 13));  // CLK_SRC
    EXPECT_EQ(rig_.read(n, reg::kCtrl), 1u << 13);
    write_mcr(n, mcr(n) & ~reg::kMcrMdis);
    poll(n, reg::kMcrLpmAck, false, k250us);
    write_mcr(n, mcr(n) | reg::kMcrFrz | reg::kMcrHalt);
    poll(n, reg::kMcrFrzAck, true, 20000);
    write_mcr(n, mcr(n) | (1u << 29) | reg::kMcrSupv);
    EXPECT_NE(mcr(n) & (1u << 29), 0u) << "the driver gives up without an Rx FIFO";
    write_mcr(n, mcr(n) | reg::kMcrMdis);
    poll(n, reg::kMcrLpmAck, true, k250us);
  }

  void chip_start(unsigned n) {
    write_mcr(n, mcr(n) & ~reg::kMcrMdis);
    poll(n, reg::kMcrLpmAck, false, k250us);
    write_mcr(n, reg::kMcrSoftRst);
    poll(n, reg::kMcrSoftRst, false, k250us);
    const std::uint32_t timing = kTiming8 | (1u << 13);
    rig_.write(n, reg::kCtrl,
               rig_.read(n, reg::kCtrl) & ~(reg::kCtrlLpb | reg::kCtrlSmp | reg::kCtrlLom));
    rig_.write(n, reg::kCtrl, timing);
    write_mcr(n, mcr(n) | reg::kMcrFrz | reg::kMcrHalt);
    poll(n, reg::kMcrFrzAck, true, 8000);
    write_mcr(n, (mcr(n) & ~0x7Fu) | reg::kMcrSupv | reg::kMcrWrnEn | reg::kMcrBcc |
                     reg::kMcrSrxDis | 0x200 | 63);
    EXPECT_EQ(mcr(n), 0x59A3023Fu);
    const std::uint32_t ctrl = (timing & ~0x2000u) | reg::kCtrlBoffRec | reg::kCtrlLbuf;
    rig_.write(n, reg::kCtrl, ctrl);
    EXPECT_EQ(rig_.read(n, reg::kCtrl), ctrl | 0x2000u) << "CLK_SRC is kept outside disable mode";
    for (unsigned mb = 1; mb < 63; ++mb) rig_.write(n, reg::mb(mb), 0x04000000);
    rig_.write(n, reg::mb(0), 0x08000000);
    rig_.write(n, reg::mb(63), 0x08000000);
    for (std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask})
      rig_.write(n, mask, 0);
    for (unsigned mb = 0; mb < 64; ++mb) rig_.write(n, reg::rximr(mb), 0);
    write_mcr(n, mcr(n) & ~reg::kMcrHalt);
    poll(n, reg::kMcrFrzAck, false, k250us);
    EXPECT_EQ(mcr(n), 0x40A3023Fu);
    rig_.write(n, reg::kCtrl, ctrl | 0x8C00);  // TWRN, RWRN, BOFF masks
    EXPECT_EQ(rig_.read(n, reg::kCtrl), ctrl | 0xAC00u);
    rig_.write(n, reg::kImask2, 0xFFFFFFFF);
    rig_.write(n, reg::kImask1, 0xFFFFFFFE);
  }

  void xmit(unsigned n, const Frame &frame) {
    const MbWords words = mb_words(frame, 0xC);
    rig_.write(n, reg::mb(63, 2), words.low);
    if (frame.dlc > 4) rig_.write(n, reg::mb(63, 3), words.high);
    rig_.write(n, reg::mb(63, 1), words.id);
    rig_.write(n, reg::mb(63), words.cs);
    for (unsigned i = 0; i < 2; ++i) rig_.write(n, reg::mb(0), 0x08000000);  // ERR005829
  }

  // The interrupt handler in mailbox mode; frames received are appended.
  void irq(unsigned n, std::vector<Frame> &received, unsigned &sent) {
    std::uint64_t pending = rig_.flags(n) & 0x7FFFFFFFFFFFFFFE;
    for (unsigned mb = 1; mb < 63; ++mb) {
      if (((pending >> mb) & 1) == 0) continue;
      const MbWords words = rig_.get(n, mb);
      EXPECT_EQ(words.code(), 2u);
      EXPECT_EQ(words.cs >> 28, 0u);
      received.push_back(mb_frame(words));
      rig_.clear_flag(n, mb);
      rig_.read(n, reg::kTimer);
    }
    if ((rig_.read(n, reg::kIflag2) >> 31) != 0) {
      EXPECT_EQ(rig_.read(n, reg::mb(63)) >> 24, 0x8u);
      rig_.write(n, reg::mb(63), 0x08000000);
      rig_.write(n, reg::kIflag2, 0x80000000);
      ++sent;
    }
    rig_.write(n, reg::kEsr, rig_.read(n, reg::kEsr) & 0x30007);
  }

  MailboxRig rig_;
};

TEST_F(LinuxDriver, ProbeStartTransmitReceiveStop) {
  for (unsigned n = 0; n < 2; ++n) probe(n);
  for (unsigned n = 0; n < 2; ++n) chip_start(n);
  std::vector<Frame> received[2], expected;
  unsigned sent[2] = {0, 0};
  for (unsigned i = 0; i < 150; ++i) {
    Frame frame{.id = (i * 37) & 0x7FF, .dlc = static_cast<std::uint8_t>(i % 9)};
    for (unsigned k = 0; k < frame.payload_size(); ++k)
      frame.data[k] = static_cast<std::uint8_t>(i + k);
    xmit(i % 2, frame);
    expected.push_back(frame);
    const unsigned before = sent[i % 2];
    ASSERT_TRUE(
        rig_.run_until([&] { return (rig_.node(i % 2).irq_lines() & kIrqAll) != 0; }, 3000));
    irq(i % 2, received[i % 2], sent[i % 2]);
    EXPECT_EQ(sent[i % 2], before + 1);
    rig_.run(20);
    irq(1 - i % 2, received[1 - i % 2], sent[1 - i % 2]);
  }
  for (unsigned n = 0; n < 2; ++n) {
    std::vector<Frame> from_other;
    for (unsigned i = 1 - n; i < expected.size(); i += 2) from_other.push_back(expected[i]);
    EXPECT_EQ(received[n], from_other);
    write_mcr(n, mcr(n) | reg::kMcrFrz | reg::kMcrHalt);
    poll(n, reg::kMcrFrzAck, true, 8000);
    write_mcr(n, mcr(n) | reg::kMcrMdis);
    poll(n, reg::kMcrLpmAck, true, k250us);
    EXPECT_EQ(rig_.read(n, reg::kEcr), 0u) << "readable on a downed interface";
  }
}

TEST_F(LinuxDriver, RestartOutOfNormalModeDropsWhatWasPending) {
  probe(0);
  chip_start(0);
  xmit(0, {.id = 0x123, .dlc = 1});  // nobody acknowledges: repeated for ever
  rig_.run(5000);
  chip_start(0);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0u);
  rig_.run(5000);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0u) << "the driver has rewritten MB63: nothing to send";
}

}  // namespace
}  // namespace vericansim
