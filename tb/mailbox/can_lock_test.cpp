// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Reception into buffers: matching, codes, lock, serviced, overrun, BUSY
// (flexcan.md 3.2, 3.5, 3.6).
#include <gtest/gtest.h>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kEmpty = 4, kFull = 2, kOverrun = 6;

// Node 0 receives, node 1 sends from MB 40.
class Reception : public ::testing::Test {
 protected:
  explicit Reception(std::uint32_t mcr = reg::kMcrBcc | reg::kMcrSrxDis) : rig_{2} {
    rig_.configure(0, {.mcr = mcr});
    rig_.configure(1);
    rig_.go(1);
  }
  void go() { rig_.go(0); }
  // Sends a frame and runs until it and its move into the buffer are over.
  void send(const Frame &frame) {
    rig_.put_tx(1, 40, frame);
    ASSERT_TRUE(rig_.wait_flag(1, 40));
    rig_.clear_flag(1, 40);
    rig_.run(60);
  }
  static Frame numbered(unsigned number, std::uint32_t id = 0x123) {
    return {.id = id,
            .dlc = 8,
            .data = {static_cast<std::uint8_t>(number), 0x11, 0x22, 0x33, 0x44, 0x55, 0x66,
                     static_cast<std::uint8_t>(0x70 + number)}};
  }
  // Code without the side effects of a C/S read: the lock is given back.
  unsigned code(unsigned mb) {
    const unsigned code = (rig_.read(0, reg::mb(mb)) >> 24) & 0xF;
    return code;
  }
  void unlock() { rig_.read(0, reg::kTimer); }
  // Buffer 5 has frame 0, which has been read and is locked thereby (its words are returned), and
  // frame 1 waits for it; its flag is clear.
  MbWords lock_while_another_waits() {
    rig_.put_rx(0, 5, {.id = 0x123});
    go();
    send(numbered(0));
    const MbWords words = rig_.get(0, 5);
    rig_.clear_flag(0, 5);
    send(numbered(1));
    return words;
  }
  MailboxRig rig_;
};

TEST_F(Reception, WritesEveryWordOfTheBuffer) {  // 3.1
  rig_.put_rx(0, 3, {.id = 0x2345678, .extended = true});
  go();
  send({.id = 0x2345678, .extended = true, .dlc = 5, .data = {1, 2, 3, 4, 5}});
  const MbWords words = rig_.get(0, 3);
  EXPECT_EQ(words.cs & 0xFFFF0000, 0x02650000u) << "FULL, SRR, IDE, DLC; 31:28 and 23 zero";
  EXPECT_EQ(words.id, 0x02345678u);
  EXPECT_EQ(words.low, 0x01020304u);
  EXPECT_EQ(words.high, 0x05000000u);
  EXPECT_EQ(rig_.flags(0), 1u << 3);
}

TEST_F(Reception, ReceivedIdReplacesTheProgrammedOne) {  // 3.5
  rig_.put_rx(0, 3, {.id = 0x120}, 0x7F0u << 18);
  rig_.write(0, reg::mb(3, 1), (0x120u << 18) | 0xE0000000);
  go();
  send(numbered(1, 0x12B));
  EXPECT_EQ(rig_.get(0, 3).id, 0x12Bu << 18);
}

TEST_F(Reception, MaskBitsOfZeroDoNotCompare) {  // 1.9, every bit of a base identifier
  for (unsigned bit = 0; bit < 11; ++bit) rig_.put_rx(0, bit, {.id = 0x2AA}, ~(1u << (18 + bit)));
  rig_.put_rx(0, 20, {.id = 0x2AA});
  go();
  for (unsigned bit = 0; bit < 11; ++bit) {
    send(numbered(bit, 0x2AA ^ (1u << bit)));
    EXPECT_EQ(rig_.flags(0), 1u << bit);
    rig_.clear_flag(0, bit);
  }
}

TEST_F(Reception, IdeIsAlwaysComparedWithoutEacen) {  // 3.5, first row
  rig_.put_rx(0, 3, {.id = 0x123}, 0);
  rig_.put_rx(0, 4, {.id = 0, .extended = true}, 0);
  go();
  send({.id = 0x7654321, .extended = true, .dlc = 1});
  EXPECT_EQ(rig_.flags(0), 1u << 4);
  send({.id = 0x321, .dlc = 1});
  EXPECT_EQ(rig_.flags(0), 3u << 3);
}

TEST_F(Reception, RemoteFramesAreNotStored) {  // 3.5, RRS = 0
  rig_.put_rx(0, 3, {.id = 0x123}, 0);
  go();
  send({.id = 0x123, .remote = true, .dlc = 4});
  EXPECT_EQ(rig_.flags(0), 0u);
  EXPECT_EQ(code(3), kEmpty);
}

TEST_F(Reception, BuffersBeyondMaxmbDoNotMatch) {
  rig_.put_rx(0, 16, {.id = 0x123});
  rig_.write(0, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | reg::kMcrBcc | 15);
  go();
  send(numbered(1));
  EXPECT_EQ(rig_.flags(0), 0u);
}

TEST_F(Reception, InactiveAndOtherCodesDoNotMatch) {  // 3.2
  for (unsigned code = 0; code < 16; ++code) {
    if (code == kEmpty || code == kFull || code == kOverrun || code == 0xC || code == 0xE) continue;
    MbWords words = mb_words({.id = 0x123}, code);
    rig_.put(0, code, words);
  }
  go();
  send(numbered(1));
  EXPECT_EQ(rig_.flags(0), 0u);
}

TEST_F(Reception, LowestFreeBufferThenTheLastOneOverruns) {  // 3.5, BCC = 1
  for (unsigned mb : {5u, 9u, 60u}) rig_.put_rx(0, mb, {.id = 0x123});
  go();
  for (unsigned i = 0; i < 5; ++i) send(numbered(i));
  EXPECT_EQ(mb_frame(rig_.get(0, 5)), numbered(0));
  EXPECT_EQ(mb_frame(rig_.get(0, 9)), numbered(1));
  const MbWords last = rig_.get(0, 60);
  EXPECT_EQ(mb_frame(last), numbered(4));
  EXPECT_EQ(last.code(), kOverrun);
}

TEST_F(Reception, ServicedFullBufferIsFree) {  // section 0 item 7; 3.2 rows 2 and 3
  rig_.put_rx(0, 5, {.id = 0x123});
  rig_.put_rx(0, 9, {.id = 0x123});
  go();
  for (unsigned i = 0; i < 4; ++i) {
    send(numbered(i));
    const MbWords words = rig_.get(0, 5);
    EXPECT_EQ(words.code(), kFull);
    EXPECT_EQ(mb_frame(words), numbered(i));
    rig_.clear_flag(0, 5);
    unlock();
  }
  EXPECT_EQ(code(9), kEmpty);
}

TEST_F(Reception, OverrunServicedGetsFullAgain) {  // 3.2 rows 4 and 5
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  send(numbered(1));
  EXPECT_EQ(code(5), kOverrun);
  unlock();
  send(numbered(2));
  EXPECT_EQ(code(5), kFull);
  rig_.read(0, reg::mb(7));  // a C/S read of another buffer unlocks too
  send(numbered(3));
  EXPECT_EQ(code(5), kFull);
}

TEST_F(Reception, ClearingTheFlagNeitherUnlocksNorServices) {  // section 5, 3.6
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  rig_.clear_flag(0, 5);
  send(numbered(1));
  EXPECT_EQ(code(5), kOverrun) << "the flag was cleared, the buffer not read";
  EXPECT_EQ(rig_.flags(0), 1u << 5);
}

TEST_F(Reception, LockedBufferKeepsItsFrameUntilUnlocked) {  // 3.6
  const MbWords before = lock_while_another_waits();
  EXPECT_EQ(rig_.get(0, 5), before);
  EXPECT_EQ(rig_.flags(0), 0u) << "not moved in yet";
  unlock();
  rig_.run(30);
  EXPECT_EQ(rig_.flags(0), 1u << 5) << "moved in after the unlock: sets the flag again";
  const MbWords after = rig_.get(0, 5);
  EXPECT_EQ(mb_frame(after), numbered(1));
  EXPECT_EQ(after.code(), kFull) << "the unlock serviced it";
}

TEST_F(Reception, LaterFrameReplacesTheWaitingOne) {  // 3.5
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  rig_.get(0, 5);
  for (unsigned i = 1; i < 4; ++i) send(numbered(i));
  unlock();
  rig_.run(30);
  EXPECT_EQ(mb_frame(rig_.get(0, 5)), numbered(3));
}

TEST_F(Reception,
       OtherBuffersReceiveWhileOneIsLockedAndOneFrameWaits) {  // errata: bound to its index
  rig_.put_rx(0, 5, {.id = 0x123});
  rig_.put_rx(0, 6, {.id = 0x124});
  go();
  send(numbered(0));
  rig_.get(0, 5);
  send(numbered(1));
  for (unsigned i = 0; i < 3; ++i) {
    send(numbered(i + 10, 0x124));
    EXPECT_EQ(rig_.flags(0) & (1u << 6), 1u << 6);
    EXPECT_EQ(rig_.read(0, reg::mb(6, 2)) >> 24, i + 10);
    rig_.clear_flag(0, 6);
  }
  unlock();
  rig_.run(30);
  EXPECT_EQ(mb_frame(rig_.get(0, 5)), numbered(1));
}

TEST_F(Reception, WriteToOwnCsCancelsTheWaitingFrameAndTheLock) {  // 3.4, 3.6
  lock_while_another_waits();
  rig_.write(0, reg::mb(5), 0x04000000);
  unlock();
  rig_.run(60);
  EXPECT_EQ(rig_.flags(0), 0u);
  EXPECT_EQ(code(5), kEmpty);
  send(numbered(2));
  EXPECT_EQ(mb_frame(rig_.get(0, 5)), numbered(2));
}

TEST_F(Reception, EmptyBufferIsNotLockedByReading) {  // 3.6
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  EXPECT_EQ(code(5), kEmpty);
  send(numbered(0));
  EXPECT_EQ(rig_.flags(0), 1u << 5);
}

// Without the FIFO nothing is behind RXFIR: its read is not one of buffer 0, whose C/S word the
// core reads for it, so that it neither locks it nor makes it serviced.
TEST_F(Reception, RxfirWithoutTheFifoIsNoReadOfBuffer0) {  // FX-3.6.a, FX-MAP.RXFIR
  rig_.put_rx(0, 0, {.id = 0x123});
  go();
  send(numbered(0));
  ASSERT_EQ(rig_.flags(0), 1u);
  rig_.clear_flag(0, 0);
  EXPECT_EQ(rig_.read(0, reg::kRxfir), 0u);
  send(numbered(1));
  EXPECT_EQ(rig_.flags(0), 1u) << "locked: the frame waits";
  rig_.read(0, reg::kRxfir);
  unlock();
  send(numbered(2));
  const MbWords words = rig_.get(0, 0);
  EXPECT_EQ(mb_frame(words), numbered(2));
  EXPECT_EQ(words.code(), kOverrun) << "nobody has read it";
}

// Nor does a read of RXFIR without the FIFO end the lock of the buffer that has been read.
TEST_F(Reception, RxfirWithoutTheFifoKeepsTheLock) {  // FX-3.6.e, FX-MAP.RXFIR
  const MbWords before = lock_while_another_waits();
  EXPECT_EQ(rig_.read(0, reg::kRxfir), 0u);
  rig_.run(60);
  EXPECT_EQ(rig_.flags(0), 0u) << "moved in: unlocked";
  EXPECT_EQ(rig_.read(0, reg::mb(5, 2)), before.low);
}

// Neither TIMER nor another C/S word is read between: either would end the lock as well.
TEST_F(Reception, SoftResetEndsTheLock) {  // FX-2.3.b
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  rig_.read(0, reg::mb(5));
  rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
  ASSERT_TRUE(
      rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrFrzAck) != 0; }, 100));
  rig_.configure(0);
  go();
  send(numbered(1));
  EXPECT_EQ(rig_.read(0, reg::mb(5, 2)) >> 24, 1u) << "the buffer is locked still";
}

TEST_F(Reception, PendingFrameMovesInWhenUnlockedInFreezeMode) {  // 2.2
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  rig_.get(0, 5);
  send(numbered(1));
  EXPECT_TRUE(rig_.freeze(0, 200)) << "a waiting frame does not hold up freeze mode";
  unlock();
  rig_.run(30);
  EXPECT_EQ(mb_frame(rig_.get(0, 5)), numbered(1));
}

TEST_F(Reception, BusyOrWholeButNeverTorn) {  // 3.2, 3.5: the CPU reads in every clock of the move
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  unsigned busy = 0;
  for (unsigned i = 1; i < 60; ++i) {
    rig_.put_tx(1, 40, numbered(i));
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(1) == Field::kEof; }, 4000));
    rig_.run(i % 16);
    bool seen = false;
    while (!seen) {
      const std::uint32_t cs = rig_.read(0, reg::mb(5));
      busy += (cs >> 24) & 1;
      if (((cs >> 24) & 1) != 0) continue;
      const unsigned low = rig_.read(0, reg::mb(5, 2)) >> 24,
                     high = rig_.read(0, reg::mb(5, 3)) & 0xF;
      ASSERT_EQ(low & 0xF, high) << "torn";
      seen = low == i;
      unlock();
    }
    ASSERT_TRUE(rig_.wait_flag(1, 40));
    rig_.clear_flag(1, 40);
  }
  EXPECT_GT(busy, 0u) << "BUSY was met";
}

TEST_F(Reception, LockTakenInAnyClockAroundTheMoveHolds) {  // 3.6
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  send(numbered(0));
  for (unsigned offset = 0; offset < 90; ++offset) {
    rig_.put_tx(1, 40, numbered(offset));
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(1) == Field::kEof; }, 4000));
    rig_.run(offset);
    const std::uint32_t cs = rig_.read(0, reg::mb(5));
    if ((cs & reg::kCodeRxBusy) == 0) {
      const std::uint32_t low = rig_.read(0, reg::mb(5, 2));
      rig_.run(80);
      EXPECT_EQ(rig_.read(0, reg::mb(5)), cs) << "moved into a locked buffer, offset " << offset;
      EXPECT_EQ(rig_.read(0, reg::mb(5, 2)), low) << "offset " << offset;
    }
    unlock();
    ASSERT_TRUE(rig_.wait_flag(1, 40));
    rig_.clear_flag(1, 40);
    rig_.run(60);
    EXPECT_EQ(mb_frame(rig_.get(0, 5)), numbered(offset));
    unlock();
  }
}

class LegacyMasks : public Reception {
 protected:
  LegacyMasks() : Reception{reg::kMcrSrxDis} {}
};

TEST_F(LegacyMasks, FirstMatchTakesItFreeOrNot) {  // 3.5, BCC = 0
  rig_.put_rx(0, 5, {.id = 0x123});
  rig_.put_rx(0, 9, {.id = 0x123});
  go();
  send(numbered(0));
  send(numbered(1));
  EXPECT_EQ(rig_.flags(0), 1u << 5);
  EXPECT_EQ(code(5), kOverrun);
}

TEST_F(LegacyMasks, ThreeGlobalMasks) {  // 1.9: RX14MASK, RX15MASK, RXGMASK for all others
  rig_.write(0, reg::kRxgmask, 0x700u << 18);
  rig_.write(0, reg::kRx14mask, 0x070u << 18);
  rig_.write(0, reg::kRx15mask, 0x007u << 18);
  for (unsigned mb : {13u, 14u, 15u, 16u}) rig_.put_rx(0, mb, {.id = 0x111});
  go();
  send(numbered(0, 0x122));
  EXPECT_EQ(rig_.flags(0), 1u << 13);
  send(numbered(0, 0x212));
  EXPECT_EQ(rig_.flags(0), 3u << 13);
  send(numbered(0, 0x221));
  EXPECT_EQ(rig_.flags(0), 7u << 13);
  send(numbered(0, 0x222));
  EXPECT_EQ(rig_.flags(0), 7u << 13);
}

TEST_F(LegacyMasks, EmptyBufferIsLockedByReading) {  // 3.6, F3 with IRMQ = 0
  rig_.put_rx(0, 5, {.id = 0x123});
  go();
  EXPECT_EQ(code(5), kEmpty);
  send(numbered(0));
  EXPECT_EQ(rig_.flags(0), 0u);
  unlock();
  rig_.run(30);
  EXPECT_EQ(rig_.flags(0), 1u << 5);
  EXPECT_EQ(code(5), kFull);
}

TEST(SelfReception, OwnFramesAreStoredUnlessSrxDis) {  // 2.6
  for (bool disabled : {false, true}) {
    MailboxRig rig{2};
    rig.configure(0, {.mcr = reg::kMcrBcc | (disabled ? reg::kMcrSrxDis : 0)});
    rig.configure(1);
    rig.put_rx(0, 3, {.id = 0x123});
    rig.go(0);
    rig.go(1);
    rig.put_tx(0, 40, {.id = 0x123, .dlc = 2, .data = {7, 8}});
    ASSERT_TRUE(rig.wait_flag(0, 40));
    EXPECT_EQ(rig.flags(0), (1ull << 40) | (disabled ? 0 : 1u << 3));
    const MbWords words = rig.get(0, 3);
    EXPECT_EQ(words.code(), disabled ? kEmpty : kFull);
    EXPECT_EQ(words.low, disabled ? 0u : 0x07080000u);
  }
}

TEST(TimeStamp, BothSidesStampTheSameBit) {  // section 6: consecutive frames, increasing stamps
  MailboxRig rig{2};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  rig.put_rx(0, 3, {.id = 0x123});
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  std::uint16_t last = 0;
  for (unsigned n = 0; n < 2; ++n) rig.write(n, reg::kTimer, 0);
  for (unsigned i = 0; i < 5; ++i) {
    rig.put_tx(1, 40, {.id = 0x123, .dlc = 8});
    ASSERT_TRUE(rig.wait_flag(1, 40));
    rig.clear_flag(1, 40);
    ASSERT_TRUE(rig.wait_flag(0, 3));
    const auto sent = static_cast<std::uint16_t>(rig.read(1, reg::mb(40)));
    const auto received = static_cast<std::uint16_t>(rig.get(0, 3).cs);
    rig.clear_flag(0, 3);
    rig.read(0, reg::kTimer);
    EXPECT_NEAR(sent, received, 1);
    EXPECT_GT(received, last);
    last = received;
  }
}

TEST(TimeStamp, TsynClearsTimerOnReceptionIntoBuffer0) {  // 2.10
  MailboxRig rig{2};
  rig.configure(0, {.ctrl = kTiming8 | (1u << 5)});
  rig.configure(1);
  rig.put_rx(0, 0, {.id = 0x123});
  rig.put_rx(0, 1, {.id = 0x124});
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  for (std::uint32_t id : {0x124u, 0x123u}) {
    rig.write(0, reg::kTimer, 0x4000);
    rig.put_tx(1, 40, {.id = id});
    ASSERT_TRUE(rig.wait_flag(1, 40));
    rig.clear_flag(1, 40);
    const std::uint32_t timer = rig.read(0, reg::kTimer);
    if (id == 0x123)
      EXPECT_LT(timer, 20u);
    else
      EXPECT_GT(timer, 0x4000u);
  }
}

}  // namespace
}  // namespace vericansim
