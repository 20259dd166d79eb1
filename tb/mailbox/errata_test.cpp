// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Errata of real FlexCANs (flexcan.md 9): a test for each, that the core does not have it.
#include <gtest/gtest.h>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr Frame kFirst{.id = 0x2AA, .dlc = 1, .data = {0x5A}};
constexpr Frame kSecond{.id = 0x155, .dlc = 2, .data = {0xA5, 0xC3}};
constexpr Frame kForeign{.id = 0x700, .dlc = 0};
constexpr BufferConfig kSmall{.num_mb = 16, .maxmb = 15};

class Errata : public ::testing::Test {
 protected:
  Errata() : rig_{kSmall} {}

  void write_at(std::uint64_t clock, std::uint32_t address, std::uint32_t data) {
    rig_.at(clock, {.address = address, .write = true, .data = data});
  }
  void put_at(std::uint64_t clock, unsigned mb, const Frame &frame) {
    const MbWords words = mb_words(frame, kTxActive);
    write_at(clock, reg::mb(mb, 2), words.low);
    write_at(clock, reg::mb(mb, 3), words.high);
    write_at(clock, reg::mb(mb, 1), words.id);
    write_at(clock, reg::mb(mb), words.cs);
  }
  // Runs the peer's next frame to its start.
  void start_foreign() {
    const std::uint64_t frames = rig_.frames_started();
    rig_.peer_sends(kForeign);
    ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 400));
  }
  // TEC = 255 and an error: the core is in bus-off.
  void into_bus_off() {
    rig_.freeze();
    rig_.write(reg::kEcr, 0x00FF);
    rig_.write(reg::kCtrl, ctrl_of(kSmall) | reg::kCtrlBoffRec);
    rig_.write(reg::kMcr, mcr_of(kSmall));
    rig_.disturb(20);
    rig_.put_tx(3, kFirst);
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field() == Field::kBusOff; }, 4000));
  }
  std::uint32_t mcr() { return rig_.read(reg::kMcr); }
  BufferRig rig_;
};

// FX-9.ERR005829: activated at any clock of a frame, a buffer is sent; so are the others, and the
// drivers' workaround (code 8 written twice to MB0) is harmless.
TEST_F(Errata, Err005829ActivationIsNeverLost) {
  rig_.go();
  for (unsigned offset = 0; offset < 60 * BufferRig::kBit && !HasFailure(); ++offset) {
    SCOPED_TRACE(testing::Message() << "clock " << offset);
    const std::uint64_t sent = rig_.sent().size();
    start_foreign();
    rig_.put_tx(9, kSecond);
    put_at(rig_.start_clock() + 60 + offset, 5, kFirst);
    write_at(rig_.start_clock() + 60 + offset, reg::mb(0), kTxInactive << 24);
    write_at(rig_.start_clock() + 60 + offset, reg::mb(0), kTxInactive << 24);
    rig_.quiet();
    EXPECT_EQ(rig_.sent().size(), sent + 2);
  }
  rig_.compare();
}

// FX-9.ERR006032: activated on an idle bus, then taken back and written anew at any clock: what
// goes out is one frame or the other, never a mixture (BufferRig compares every frame sent).
TEST_F(Errata, Err006032NoMixedFrame) {
  rig_.go();
  for (unsigned offset = 0; offset < 40 * BufferRig::kBit && !HasFailure(); ++offset) {
    SCOPED_TRACE(testing::Message() << "clock " << offset);
    rig_.put_tx(5, kFirst);
    write_at(rig_.clocks() + offset, reg::mb(5), kTxInactive << 24);
    put_at(rig_.clocks() + offset, 5, kSecond);
    rig_.quiet();
    EXPECT_EQ(rig_.sent().back(), kSecond);
  }
  rig_.compare();
}

// FX-9.ERR008341: freeze and disable mode requested at every clock of a frame, as sender and as
// receiver: reached in bounded time, left again, and the next frame is good.
TEST_F(Errata, Err008341LowPowerRequestsNeverHang) {
  rig_.go();
  for (unsigned offset = 0; offset < 60 * BufferRig::kBit && !HasFailure(); offset += 1) {
    SCOPED_TRACE(testing::Message() << "clock " << offset);
    if (offset % 2 == 0) {
      rig_.peer_sends(kForeign);
    } else {
      rig_.put_tx(5, kFirst);
    }
    rig_.run(offset);
    const bool disable = offset % 4 >= 2;
    const std::uint32_t wanted = disable ? 1u << 20 : reg::kMcrFrzAck;
    rig_.write(reg::kMcr,
               mcr_of(kSmall) | (disable ? reg::kMcrMdis : reg::kMcrFrz | reg::kMcrHalt));
    ASSERT_TRUE(rig_.run_until([&] { return (mcr() & wanted) != 0; }, 200 * BufferRig::kBit));
    rig_.go();
    rig_.quiet();
  }
}

// FX-9.ERR009595: freeze mode from bus-off: at once, and nothing on the wire is hurt.
TEST_F(Errata, Err009595FreezeFromBusOff) {
  for (unsigned offset = 0; offset < 30 && !HasFailure(); ++offset) {
    into_bus_off();
    rig_.peer_sends(kForeign);
    rig_.run(200 + 7 * offset);
    EXPECT_TRUE(rig_.freeze(64)) << "freeze mode is reached within a few bits";
    EXPECT_EQ(rig_.node().tx(), Level::kRecessive);
    rig_.soft_reset();
    rig_.write(reg::mb(3), 0);
    rig_.configure(kSmall);
    rig_.write(reg::kCtrl, ctrl_of(kSmall));
    rig_.peer().preset_counters(0, 0);
    rig_.peer_forgets();
    rig_.go();
    rig_.quiet();
    ASSERT_TRUE(rig_.freeze());
  }
}

// FX-9.e7322, FX-2.3.e: a soft reset in bus-off sets no BOFF_INT and ends bus-off.
TEST_F(Errata, E7322SoftResetInBusOffSetsNoFlag) {
  into_bus_off();
  EXPECT_NE(rig_.read(reg::kEsr) & reg::kEsrBoffInt, 0u);
  rig_.soft_reset();
  EXPECT_EQ(rig_.read(reg::kEsr) & (reg::kEsrInterrupts | 0x30), 0u);
  EXPECT_EQ(rig_.read(reg::kEcr), 0u);
  rig_.write(reg::mb(3), 0);
  rig_.configure(kSmall);
  rig_.go();
  EXPECT_EQ(rig_.read(reg::kEsr) & (reg::kEsrInterrupts | 0x30), 0u);
}

// FX-9.e2656: an abort request lives as long as its attempt; the buffer can be used again, and
// another one is not hit by it.
TEST_F(Errata, E2656AnAbortRequestEndsWithItsAttempt) {
  BufferConfig config = kSmall;
  config.aen = true;
  rig_.configure(config);
  rig_.go();
  for (const bool fails : {false, true}) {
    const std::uint64_t frames = rig_.frames_started();
    rig_.put_tx(5, kFirst);
    ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 400));
    if (fails) rig_.disturb(30);
    rig_.run_bits(10);
    rig_.write(reg::mb(5), kTxAbort << 24);
    rig_.quiet();
    EXPECT_EQ((rig_.read(reg::mb(5)) >> 24) & 0xF, unsigned{fails ? kTxAbort : kTxInactive});
    EXPECT_EQ(rig_.read(reg::kIflag1), 1u << 5);
    rig_.write(reg::kIflag1, 1u << 5);
    for (const unsigned mb : {5u, 6u}) rig_.put_tx(mb, kSecond);
    rig_.quiet();
    EXPECT_EQ(rig_.read(reg::kIflag1), 3u << 5) << "both are sent";
    EXPECT_EQ((rig_.read(reg::mb(5)) >> 24) & 0xF, unsigned{kTxInactive});
    rig_.write(reg::kIflag1, 3u << 5);
    rig_.compare();
  }
}

// FX-9.e050443: with the FIFO in use, full and overflowing, no mailbox changes.
TEST_F(Errata, E050443TheFifoLeavesMailboxesAlone) {
  BufferConfig config = kSmall;
  config.fen = true;
  rig_.configure(config);
  for (unsigned i = 0; i < 8; ++i) rig_.write(0x0E0 + 4 * i, 0x700u << 19);
  for (unsigned mb = 8; mb < 16; ++mb)
    rig_.put(mb, {.cs = mb << 24 | 0x1234, .id = mb << 18, .low = ~mb, .high = mb});
  rig_.write(reg::mb(12), 0);  // these would be sent
  rig_.write(reg::mb(14), 0);
  rig_.go();
  for (unsigned i = 0; i < 12; ++i) rig_.receive(kForeign);
  rig_.compare();
  for (unsigned i = 0; i < 7; ++i) rig_.write(reg::kIflag1, 0xE0);
  rig_.compare();
}

// FX-9.37718: two frames under way, one waiting for a locked buffer and one arriving; taking either
// buffer away at any clock around the end of the frame does not touch the other.
TEST_F(Errata, Forum37718TwoPendingFrames) {
  rig_.go();
  const Frame frame{.id = 0x123, .dlc = 2, .data = {1, 2}};
  for (int offset = -40; offset < 60 && !HasFailure(); ++offset) {
    for (const unsigned victim : {5u, 9u}) {
      SCOPED_TRACE(testing::Message() << "clock " << offset << " MB" << victim);
      rig_.write(reg::kIflag1, 0xFFFF);
      rig_.write(reg::mb(9), 0);
      rig_.put_rx(5, frame);
      rig_.receive(frame);
      rig_.read_cs(5);
      rig_.receive(frame);  // waits
      rig_.put_rx(9, frame);
      const std::uint64_t frames = rig_.frames_started();
      rig_.peer_sends({.id = 0x123, .dlc = 2, .data = {3, 4}});
      ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 400));
      write_at(rig_.start_clock() + 57 * BufferRig::kBit + offset, reg::mb(victim), 0);
      rig_.quiet();
      rig_.compare();
    }
  }
}

// FX-9.e3407: a request that was sent and became a receive buffer, and gets no answer, does not
// keep others from being sent.
TEST_F(Errata, E3407ARequestWithoutAnswerHoldsUpNobody) {
  rig_.go();
  rig_.put_tx(5, {.id = 0x2AA, .remote = true, .dlc = 1});
  rig_.put_tx(6, kSecond);
  rig_.quiet();
  for (unsigned i = 0; i < 3; ++i) {
    rig_.put_tx(4 + 3 * i, kSecond);
    rig_.quiet();
  }
  EXPECT_EQ(rig_.sent().size(), 5u);
  rig_.compare();
  rig_.receive(kFirst);  // what the buffer was waiting for comes now
  EXPECT_EQ((rig_.read(reg::mb(5)) >> 24) & 0xF, unsigned{kRxFull});
}

// FX-9.e5295, FX-MAP.MECR: there is no memory error: all words can be read before they are written,
// and the ECC registers of other parts read 0.
TEST_F(Errata, E5295NoMemoryError) {
  for (std::uint32_t address = 0x080; address < 0xC00; address += 4)
    EXPECT_FALSE(rig_.node().access({.address = address}).error) << std::hex << address;
  for (std::uint32_t address = 0xAE0; address < 0xB00; address += 4) {
    rig_.node().access({.address = address, .write = true, .data = ~0u});
    EXPECT_EQ(rig_.node().access({.address = address}).data, 0u);
  }
  rig_.go();
  rig_.receive(kFirst);
  EXPECT_EQ(mcr() & reg::kMcrFrzAck, 0u);
}

// FX-9.e2424, FX-CTRL1.CLK_SRC: the clock source bit changes in disable mode only, and traffic does
// not notice.
TEST_F(Errata, E2424ClockSourceIsStorageOnly) {
  rig_.go();
  rig_.put_rx(3, kFirst);
  for (unsigned i = 0; i < 4; ++i) {
    rig_.write(reg::kCtrl, ctrl_of(kSmall) | (1u << 13));
    EXPECT_EQ(rig_.read(reg::kCtrl) & (1u << 13), (i % 2) << 13) << "not in normal mode";
    rig_.write(reg::kMcr, mcr_of(kSmall) | reg::kMcrMdis);
    ASSERT_TRUE(rig_.run_until([&] { return (mcr() & (1u << 20)) != 0; }, 2000));
    rig_.write(reg::kCtrl, ctrl_of(kSmall) | ((i + 1) % 2) << 13);
    EXPECT_EQ(rig_.read(reg::kCtrl) & (1u << 13), ((i + 1) % 2) << 13);
    rig_.go();
    rig_.receive(kFirst);
  }
  EXPECT_NE(rig_.read(reg::kIflag1) & (1u << 3), 0u);
}

// FX-9.imx, FX-5.TWRN: the warning interrupt is there; becoming error passive raises no interrupt
// of its own.
TEST_F(Errata, ImxWarningsAreWiredAndPassiveIsNot) {
  rig_.write(reg::kEcr, 95);
  rig_.write(reg::kMcr, mcr_of(kSmall));
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field() == Field::kIdle; }, 4000));
  rig_.write(reg::kCtrl, ctrl_of(kSmall) | 0x0C00);  // warning interrupts only
  rig_.disturb(20);
  rig_.put_tx(3, kFirst);
  rig_.quiet();
  EXPECT_NE(rig_.read(reg::kEsr) & (1u << 17), 0u);
  EXPECT_NE(rig_.node().irq_lines() & kIrqTxWarning, 0);
  rig_.write(reg::kEsr, reg::kEsrInterrupts);
  rig_.freeze();
  rig_.write(reg::kEcr, 127);
  rig_.write(reg::kMcr, mcr_of(kSmall));
  rig_.disturb(20);
  rig_.put_tx(3, kFirst);
  ASSERT_TRUE(rig_.run_until([&] { return (rig_.read(reg::kEsr) & 0x30) == 0x10; }, 4000));
  EXPECT_EQ(rig_.node().irq_lines(), 0) << "no interrupt with the warning masks alone";
}

}  // namespace
}  // namespace vericansim
