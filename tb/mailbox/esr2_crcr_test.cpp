// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ESR2 and CRCR (flexcan.md 1.7, 1.8), against a model that looks at the codes, and the codec.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "mailbox/tx_rig.hpp"
#include "model/frame_codec.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kEsr2 = 0x038, kCrcr = 0x044, kVps = 1u << 14, kImb = 1u << 13;

unsigned lptm(std::uint32_t esr2) { return (esr2 >> 16) & 0x7F; }

TEST(Crcr, OfEveryFrameSent) {  // FX-CRCR.TXCRC, FX-CRCR.MBCRC, FX-MAP.CRCR, FX-MAP.ESR2
  TxRig rig;
  rig.join();
  EXPECT_EQ(rig.read(0, kCrcr), 0u);
  std::mt19937 rng{4};
  for (unsigned i = 0; i < 40; ++i) {
    Frame frame{.extended = rng() % 2 != 0, .remote = rng() % 4 == 0};
    frame.id = static_cast<std::uint32_t>(rng()) & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
    frame.dlc = rng() % 9;
    for (unsigned b = 0; b < frame.payload_size(); ++b)
      frame.data[b] = static_cast<std::uint8_t>(rng());
    const unsigned mb = rng() % 64;
    rig.put_tx(0, mb, frame);
    ASSERT_TRUE(rig.wait_flag(0, mb));
    ASSERT_EQ(rig.read(0, kCrcr), (mb << 16) | encode_frame(frame).crc);
    rig.clear_flag(0, mb);
    rig.write(0, reg::mb(mb), kInactiveWord);
    // A frame that is received, or fails, is none that was sent.
    if (i % 8 == 0) {
      const std::uint32_t before = rig.read(0, kCrcr);
      rig.put_tx(1, 30, {.id = 0x111});
      ASSERT_TRUE(rig.wait_flag(1, 30));
      rig.clear_flag(1, 30);
      ASSERT_EQ(rig.read(0, kCrcr), before);
      ASSERT_TRUE(rig.freeze(1));
      rig.put_tx(0, mb ^ 1, {.id = 0x123});
      rig.run(1500);
      rig.write(0, reg::mb(mb ^ 1), 0x09000000);
      ASSERT_TRUE(rig.wait_flag(0, mb ^ 1));
      ASSERT_NE(rig.read(0, reg::kEcr), 0u) << "it has failed";
      ASSERT_EQ(rig.read(0, kCrcr), before);
      rig.clear_flag(0, mb ^ 1);
      rig.go(1);
    }
  }
  ASSERT_TRUE(rig.freeze(0));
  EXPECT_NE(rig.read(0, kCrcr), 0u);
  rig.write(0, kCrcr, 0);
  EXPECT_NE(rig.read(0, kCrcr), 0u) << "read only";
  rig.write(0, reg::kMcr, reg::kMcrSoftRst);
  rig.run(20);
  EXPECT_EQ(rig.read(0, kCrcr), 0u);
  EXPECT_EQ(rig.read(0, kEsr2), 0u);
}

class Esr2 : public ::testing::Test {
 protected:
  void start(std::uint32_t mcr = 0, std::uint32_t ctrl = 0) {
    RigConfig config;
    config.mcr |= mcr;
    config.ctrl |= ctrl;
    rig_ = std::make_unique<TxRig>(2, config);
    for (unsigned mb = 0; mb < 64; ++mb) set(mb, 0x4);
  }
  void set(unsigned mb, unsigned code, std::uint32_t id = 0) {
    rig_->write(0, reg::mb(mb, 1), id);
    rig_->write(0, reg::mb(mb), code << 24 | 8u << 16);  // time for both passes
    code_[mb] = code;
    id_[mb] = id;
  }
  std::uint32_t scanned() {
    rig_->run(600);  // a pass for the winner and one for ESR2
    return rig_->read(0, kEsr2);
  }
  // Nodes that cannot send keep everything as it is: listen-only.
  void expect_model(bool lprio, bool lbuf) {
    unsigned inactive = 64, last = 0;
    for (unsigned mb = 64; mb-- > 0;)
      if ((code_[mb] & 7) == 0) inactive = mb;
    std::uint64_t worst = 0;
    for (unsigned mb = 0; mb < 64; ++mb) {
      if (code_[mb] != 0xC && code_[mb] != 0xE) continue;
      const std::uint64_t prio = lprio ? id_[mb] >> 29 : 0;
      const std::uint64_t value = (prio << 32) | ((id_[mb] & 0x1FFC0000) << 1);
      if (lbuf || value >= worst) last = mb;
      worst = std::max(worst, value);
    }
    const std::uint32_t esr2 = scanned();
    ASSERT_EQ(esr2 & kVps, kVps);
    ASSERT_EQ(esr2 & kImb, inactive < 64 ? kImb : 0);
    ASSERT_EQ(lptm(esr2), inactive < 64 ? inactive : last);
    ASSERT_EQ(esr2 & ~(0x7Fu << 16 | kVps | kImb), 0u);
  }
  std::unique_ptr<TxRig> rig_;
  std::array<unsigned, 64> code_{};
  std::array<std::uint32_t, 64> id_{};
};

// FX-ESR2.LPTM, FX-ESR2.IMB, FX-ESR2.VPS
TEST_F(Esr2, AfterAnyWrites) {
  std::mt19937 rng{5};
  for (unsigned mode = 0; mode < 4; ++mode) {
    const bool lprio = (mode & 1) != 0, lbuf = (mode & 2) != 0;
    start(lprio ? kMcrLprioEn : 0, reg::kCtrlLom | (lbuf ? reg::kCtrlLbuf : 0));
    rig_->join();
    for (unsigned round = 0; round < 60; ++round) {
      SCOPED_TRACE(round);
      constexpr std::array<unsigned, 6> kCodes{0x0, 0x8, 0x4, 0xC, 0xE, 0xA};
      for (unsigned i = rng() % 6 + 1; i > 0; --i) {
        const bool idle = round % 3 != 0;
        set(rng() % 64, kCodes[idle ? 2 + rng() % 4 : rng() % 6], rng() & 0xFFFC0000);
      }
      expect_model(lprio, lbuf);
      if (round % 3 == 0)
        for (unsigned mb = 0; mb < 64; ++mb)
          if ((code_[mb] & 7) == 0) set(mb, 0x4);
    }
  }
}

TEST_F(Esr2, VpsClearsWithEveryCsWriteAndComesBack) {  // FX-ESR2.VPS
  start();
  rig_->join();
  ASSERT_EQ(scanned() & kVps, kVps);
  for (unsigned mb : {0u, 5u, 63u}) {
    const auto results =
        rig_->burst(0, {{.address = reg::mb(mb), .write = true, .data = 0x04000000},
                        {.address = kEsr2},
                        {.address = kEsr2}});
    EXPECT_EQ(results[1].data & kVps, 0u) << "in the transfer behind the write";
    EXPECT_EQ(results[2].data & kVps, 0u);
    EXPECT_EQ(scanned() & kVps, kVps);
    const auto other = rig_->burst(0, {{.address = reg::mb(mb, 2), .write = true, .data = 5},
                                       {.address = kEsr2},
                                       {.address = kEsr2}});
    EXPECT_EQ(other[1].data & other[2].data & kVps, kVps) << "data words do not matter";
  }
}

// With the SOF the winner has left the buffers, and the next one is looked for.
TEST_F(Esr2, VpsClearsAtTheStartOfAPassThatNoWriteCaused) {  // FX-ESR2.VPS
  start();
  rig_->join();
  rig_->occupy(true);
  set(9, 0xC, 0x100u << 18);
  set(30, 0xC, 0x200u << 18);
  ASSERT_EQ(scanned() & kVps, kVps);
  rig_->occupy(false);
  bool cleared = false, sent = false;
  for (unsigned i = 0; i < 5000 && !sent; ++i) {
    const auto results = rig_->burst(0, {{.address = kEsr2}, {.address = reg::kIflag1}});
    cleared = cleared || (results[0].data & kVps) == 0;
    sent = (results[1].data & (1u << 9)) != 0;
  }
  EXPECT_TRUE(sent);
  EXPECT_TRUE(cleared);
  EXPECT_EQ(scanned() & kVps, kVps);
}

TEST_F(Esr2, BlockedWritesDoNotClearVps) {  // FX-ESR2.VPS
  start(kMcrAen);
  rig_->join();
  set(7, 0xC, 0x100u << 18);
  ASSERT_TRUE(rig_->run_until([&] { return rig_->field(0) == Field::kCrc; }, 2000));
  EXPECT_EQ(rig_->read(0, kEsr2) & kVps, kVps);
  const auto results =
      rig_->burst(0, {{.address = reg::mb(7), .write = true, .data = kInactiveWord},
                      {.address = kEsr2},
                      {.address = kEsr2}});
  EXPECT_EQ(results[2].data & kVps, kVps);
}

TEST_F(Esr2, CompletionFillsIn) {  // flexcan.md 1.7: IMB = 0 and a frame ends
  start();
  rig_->join();
  set(9, 0xC, 0x100u << 18);
  set(30, 0xC, 0x200u << 18);
  ASSERT_TRUE(rig_->run_until([&] { return rig_->field(0) == Field::kCrc; }, 2000));
  std::uint32_t esr2 = rig_->read(0, kEsr2);
  EXPECT_EQ(esr2 & (kVps | kImb), kVps);
  EXPECT_EQ(lptm(esr2), 30u) << "the one on the bus does not count";
  ASSERT_TRUE(rig_->wait_flag(0, 9));
  esr2 = rig_->read(0, kEsr2);
  EXPECT_EQ(esr2 & (kVps | kImb), kVps | kImb);
  EXPECT_EQ(lptm(esr2), 9u);
}

// flexcan.md 1.7: the same with a pass under way, which has looked at the buffer before its end.
TEST_F(Esr2, CompletionDuringAPassCounts) {
  start();
  rig_->join();
  for (unsigned clocks = 0; clocks < 80; clocks += 5) {
    SCOPED_TRACE(clocks);
    set(9, 0xC, 0x100u << 18);
    ASSERT_TRUE(rig_->run_until([&] { return rig_->field(0) == Field::kAckDel; }, 2000));
    rig_->run(clocks);
    set(40, 0x4);  // nothing new, but it starts the pass
    ASSERT_TRUE(rig_->wait_flag(0, 9));
    const std::uint32_t esr2 = scanned();
    EXPECT_EQ(esr2 & (kVps | kImb), kVps | kImb);
    EXPECT_EQ(lptm(esr2), 9u);
    rig_->clear_flag(0, 9);
  }
}

// A remote frame that was sent leaves a buffer that waits for the answer, an answer one that waits
// for the next request: neither is inactive, so that software that looks for a free buffer must not
// be sent there.
TEST_F(Esr2, CompletionThatLeavesNoInactiveBuffer) {  // FX-ESR2.IMB, flexcan.md 1.7, 3.2
  start();
  set(9, 0xA, 0x300u << 18);
  rig_->join();
  rig_->put_tx(0, 7, {.id = 0x200, .remote = true});
  ASSERT_TRUE(rig_->wait_flag(0, 7));
  EXPECT_EQ(rig_->code(7), 0x4u);
  EXPECT_EQ(scanned() & (kVps | kImb), kVps);
  rig_->put_tx(1, 5, {.id = 0x300, .remote = true});
  ASSERT_TRUE(rig_->wait_flag(0, 9));
  EXPECT_EQ(rig_->code(9), 0xAu);
  EXPECT_EQ(scanned() & (kVps | kImb), kVps);
}

TEST_F(Esr2, BuffersOutsideTheArbitrationDoNotCount) {  // FX-MCR.MAXMB
  start(0, reg::kCtrlLom);
  set(50, 0x8);
  rig_->write(0, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 40);
  rig_->join();
  EXPECT_EQ(scanned() & (kVps | kImb), kVps);
  set(40, 0x8);
  EXPECT_EQ(scanned(), (40u << 16) | kVps | kImb);
}

// Neither the places of the Rx FIFO nor words of its filter table that look like C/S words are
// buffers.
TEST_F(Esr2, AreaOfTheRxFifoDoesNotCount) {  // FX-ESR2.IMB, FX-ESR2.LPTM, flexcan.md section 4
  for (const unsigned rffn : {0u, 1u, 15u}) {
    SCOPED_TRACE(rffn);
    start(reg::kMcrFen, reg::kCtrlLom);
    rig_->write(0, reg::kCtrl2, reg::ctrl2_rffn(rffn));
    const unsigned first = 8 + 2 * rffn;
    for (unsigned mb = 6; mb < first; ++mb) set(mb, mb % 3 * 4 + 4, 0x7FFu << 18);  // 4, 8, 12
    rig_->join();
    for (const unsigned code : {0x4u, 0xCu, 0x0u, 0x8u}) {
      set(first - 1, code, 0x7FFu << 18);
      EXPECT_EQ(scanned(), kVps) << code;
    }
    set(50, 0xC, 0x100u << 18);
    EXPECT_EQ(scanned(), (50u << 16) | kVps);
    set(first, 0x8);
    EXPECT_EQ(scanned(), (first << 16) | kVps | kImb);
  }
}

}  // namespace
}  // namespace vericansim
