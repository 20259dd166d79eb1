// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A core with message buffers and the follower: its registers, and one pair as software sees it:
// TM-02, TM-03, TM-100, TM-104.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vcan_top_sync.h"
#include "model/frame_codec.hpp"
#include "model/registers.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

// Section 6 of the rules.
constexpr std::uint32_t kTstat = 0x1108, kTctrl = 0x1104, kTimelo = 0x1110, kTimehi = 0x1114;
constexpr std::uint32_t kTsctrl = 0x1180, kTsid = 0x1184, kTsdly = 0x1188, kTsstat = 0x118C,
                        kTsofs = 0x1190;

/// 20 ns a clock, 8 clocks a bit.
class FollowerRegs : public testing::Test {
 protected:
  FollowerRegs() {
    top_->can_rx_i = 1;
    top_->be_i = 0xF;
    top_.reset();
    clocks(300);
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) tick();
  }
  void tick() {
    top_.clock();
    ++cycles_;
  }
  void command(std::uint32_t address, bool write) {
    top_->req_i = 1;
    top_->addr_i = address / 4;
    top_->we_i = write;
    tick();
    top_->req_i = 0;
  }
  std::uint32_t read(std::uint32_t address) {
    command(address, false);
    top_.settle();
    while (top_->ready_o == 0) tick();
    const std::uint32_t data = top_->rdata_o;
    tick();
    return data;
  }
  void write(std::uint32_t address, std::uint32_t data) {
    command(address, true);
    top_->wdata_i = data;
    top_.settle();
    while (top_->ready_o == 0) tick();
    tick();
  }
  void go() {
    write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt);
    clocks(20);
    write(reg::kCtrl, 2u << 19 | 1u << 16 | 1u);
    write(reg::kMcr, 15);
    clocks(200);
  }
  void send(const Frame &frame) {
    for (const Level level : levels_of(encode_frame(frame, {.ack_slot = Level::kRecessive}).bits))
      for (unsigned i = 0; i < 8; ++i) {
        top_->can_rx_i = level == Level::kRecessive && top_->can_tx_o != 0 ? 1 : 0;
        tick();
      }
    clocks(600);
  }
  void pair(std::uint32_t seconds, std::uint32_t ns, Frame as = {.id = 0x77}, unsigned count = 1) {
    as.dlc = 8;
    as.data = {0x10, 0, static_cast<std::uint8_t>(0x20 | count % 16)};
    for (unsigned i = 0; i < 4; ++i) as.data[4 + i] = static_cast<uint8_t>(seconds >> (24 - 8 * i));
    send(as);
    as.data[0] = 0x18;
    for (unsigned i = 0; i < 4; ++i) as.data[4 + i] = static_cast<uint8_t>(ns >> (24 - 8 * i));
    send(as);
  }
  /// Pairs of a master that agrees, one in each 8,192 clocks; `ahead` ns too much in each.
  void pairs(unsigned count, int ahead, const Frame &as = {.id = 0x77}) {
    for (; count != 0; --count) {
      const std::uint64_t begin = cycles_;
      const auto ns = static_cast<std::uint32_t>(20 * (begin - epoch_) + 1'000'000);
      pair(60, ns + static_cast<std::uint32_t>(ahead), as, ++sequence_);
      clocks(static_cast<unsigned>(8'192 - (cycles_ - begin)));
    }
  }
  std::uint32_t state() { return read(kTsstat) & 3; }
  LeafModel<Vcan_top_sync> top_;
  std::uint64_t cycles_ = 0, epoch_ = 0;
  unsigned sequence_ = 0;
};

// TM-02, TM-03: what the parameters say after a reset, whatever the mode; what can be written.
TEST_F(FollowerRegs, ReadAndWrite) {
  EXPECT_EQ(read(0x1008) >> 12 & 3, 3u);
  EXPECT_EQ(read(kTsctrl), 0x1F460120u);
  EXPECT_EQ(read(kTsid), 0x01DC0000u);
  EXPECT_EQ(read(kTsdly), 0x00FFFFE2u);
  EXPECT_EQ(read(kTsstat), 0u);
  EXPECT_EQ(read(kTsofs), 0u);
  for (const auto &[address, bits] : {std::pair{kTsctrl, 0x3F7F03F1u},
                                      {kTsid, 0x9FFFFFFFu},
                                      {kTsdly, 0x00FFFFFFu},
                                      {kTsstat, 0u},
                                      {kTsofs, 0u},
                                      {0x1194u, 0u},
                                      {0x11FCu, 0u}}) {
    for (const std::uint32_t pattern : {0xFFFFFFFFu, 0u, 0xA5C3965Au, 0x5A3C69A5u, 0u}) {
      write(address, pattern);
      EXPECT_EQ(read(address), pattern & bits) << std::hex << address;
    }
    for (unsigned lane = 0; lane < 4; ++lane) {
      top_->be_i = 1U << lane;
      write(address, 0xFFFFFFFF);
      top_->be_i = 0xF;
      EXPECT_EQ(read(address), 0xFFU << 8 * lane & bits) << std::hex << address;
      write(address, 0);
    }
  }
  top_.reset();
  clocks(300);
  EXPECT_EQ(read(kTsctrl), 0x1F460120u);
  EXPECT_EQ(read(kTsid), 0x01DC0000u);
  EXPECT_EQ(read(kTsdly), 0x00FFFFE2u);
}

// Masks, TIMER and stamps share a port: each has its own words in a core without own masks, too.
TEST_F(FollowerRegs, TimerBesideGroupMasks) {
  write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt);
  clocks(20);
  write(reg::kRxgmask, 0x1234'5678);
  write(reg::kTimer, 0xA55A);
  EXPECT_EQ(read(reg::kTimer), 0xA55Au);
  EXPECT_EQ(read(reg::kRxgmask), 0x1234'5678u);
  EXPECT_EQ(read(0x1400), 0u) << "the stamp of buffer 0";
  write(reg::kRxgmask, 0xFFFF'FFFF);
  EXPECT_EQ(read(reg::kTimer), 0xA55Au) << "TIMER stands in freeze mode";
}

// TIMEHI is of the last read of TIMELO, whatever stands on the address lines meanwhile: no
// command, one that is withdrawn, or one that is given up before a wait state ends.
TEST_F(FollowerRegs, NoCommandIsNoReadOfTimelo) {
  const auto read_late = [this] {
    write(kTimelo, 0xFFFF'F000);
    write(kTimehi, 0);
    clocks(10);
    EXPECT_GT(read(kTimelo), 0xFFFF'F000u);
    clocks(400);
  };
  read_late();
  top_->addr_i = kTimelo / 4;
  top_->we_i = 0;
  clocks(4);
  EXPECT_EQ(read(kTimehi), 0u) << "no command";
  read_late();
  top_->cancel_i = 1;
  command(kTimelo, false);
  top_->cancel_i = 0;
  EXPECT_EQ(read(kTimehi), 0u) << "a command that is withdrawn";
  read_late();
  command(reg::mb(0), false);
  top_.settle();
  EXPECT_FALSE(top_->ready_o);
  command(kTimelo, false);
  top_.settle();
  EXPECT_TRUE(top_->ready_o);
  tick();
  EXPECT_EQ(read(kTimehi), 0u) << "a command that is not taken";
  read(kTimelo);
  EXPECT_EQ(read(kTimehi), 1u) << "it was late enough";
}

// Read data is 0 in all clocks but those of a read, so that wrappers may OR it (can_top).
TEST_F(FollowerRegs, NoDataWithoutARead) {
  for (const std::uint32_t address : {kTsctrl, kTctrl, std::uint32_t{reg::kMcr}}) {
    SCOPED_TRACE(address);
    const std::uint32_t data = read(address);
    ASSERT_NE(data, 0u);
    top_->addr_i = address / 4;
    top_->we_i = 0;
    tick();
    top_.settle();
    EXPECT_EQ(top_->rdata_o, 0u) << "no command";
    top_->wdata_i = data;
    command(address, true);
    top_.settle();
    EXPECT_EQ(top_->rdata_o, 0u) << "a write";
    tick();
    EXPECT_EQ(read(address), data);
  }
}

// TM-40: HOLD is the CPU's beside the follower, too.
TEST_F(FollowerRegs, ABufferMayBeHeld) {
  constexpr std::uint32_t kTtx = 0x1140, kTtxmb = 0x1144, kHold = 1u << 31;
  write(kTtx, 1'000'000'000);  // in a second
  for (const std::uint32_t held : {kHold | 5, 5u, kHold | 9, 0u}) {
    write(kTtxmb, held);
    clocks(4);
    EXPECT_EQ(read(kTtxmb), held);
  }
}

// TM-40, TM-41: a number beyond the buffers of a smaller core holds none of them, also not the one
// that its lower bits name: that one is started, and does not give way to a worse one.
TEST_F(FollowerRegs, ANumberBeyondHoldsNoBuffer) {
  constexpr std::uint32_t kTtx = 0x1140, kTtxmb = 0x1144, kHold = 1u << 31;
  constexpr std::uint32_t kBetter = 0x123 << 18, kWorse = 0x7FE << 18;  // differ in the first bit
  constexpr unsigned kBuffer = 3, kOther = 7, kBits = 20;
  for (const bool other : {false, true})
    for (const unsigned number : {kBuffer, 16 + kBuffer, 32 + kBuffer, 48 + kBuffer}) {
      SCOPED_TRACE(testing::Message() << number << ' ' << other);
      top_.reset();
      clocks(300);
      go();
      write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 15);
      clocks(20);
      write(kTtx, 1'000'000'000);  // in a second
      write(kTtxmb, kHold | number);
      write(reg::mb(kBuffer, 1), kBetter);
      write(reg::mb(kBuffer), 0xCu << 24);
      write(reg::mb(kOther, 1), kWorse);
      if (other) write(reg::mb(kOther), 0xCu << 24);
      write(reg::kMcr, 15);
      const auto listen = [this] {
        top_->can_rx_i = top_->can_tx_o;
        tick();
      };
      for (unsigned i = 0; top_->can_tx_o != 0 && i < 8 * kBits; ++i) listen();
      const bool started = top_->can_tx_o == 0;
      for (unsigned i = 0; i < 8; ++i) listen();
      const bool better = top_->can_tx_o == 0;
      EXPECT_EQ(started, other || number != kBuffer);
      EXPECT_EQ(better, number != kBuffer);
      EXPECT_EQ(read(kTtxmb), kHold | number) << "it is said to be held until then";
    }
}

// TM-27, section 6 of the rules: a core has as many stamps as buffers; behind them nothing is, and
// a write there is no other stamp's.
TEST_F(FollowerRegs, StampsEndWithTheBuffers) {
  constexpr std::uint32_t kStamps = 0x1400, kUpper = 0x5A5A'0000;
  write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt);
  clocks(20);
  for (const std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask}) write(mask, 0);
  go();
  write(kTimelo, 0);
  write(kTimehi, kUpper);
  clocks(8);
  for (const unsigned mb : {0u, 3u, 9u, 15u}) {
    SCOPED_TRACE(mb);
    write(reg::mb(mb), 0x4u << 24);
    const std::uint32_t before = read(kTimelo);
    send({.id = 0x123, .dlc = 1});
    EXPECT_EQ(read(reg::mb(mb)) >> 24, 2u) << "full";
    const std::uint32_t at = read(kStamps + 8 * mb);
    EXPECT_GT(at, before);
    EXPECT_LT(at, read(kTimelo));
    EXPECT_EQ(read(kStamps + 8 * mb + 4), kUpper);
    for (std::uint32_t beyond = kStamps + 8 * 16; beyond < 0x1800; beyond += 4) {
      ASSERT_EQ(read(beyond), 0u) << std::hex << beyond;
      write(beyond, 0xFFFF'FFFF);
    }
    EXPECT_EQ(read(kStamps + 8 * mb), at);
    write(reg::mb(mb), 0);
  }
}

// TM-104: EN = 0 leaves the clock alone; a pair then sets it, and state, offset, flag and interrupt
// tell of it. The clock goes on as the CPU commands.
TEST_F(FollowerRegs, APairSetsTheClock) {
  go();
  pair(50, 9);
  EXPECT_EQ(read(kTsstat) & 3, 0u);
  EXPECT_EQ(read(kTimehi), 0u);
  write(kTctrl, 1u << 20 | 0x31);
  write(kTsctrl, read(kTsctrl) | 1);
  pair(60, 9);
  const std::uint64_t low = read(kTimelo), now = std::uint64_t{read(kTimehi)} << 32 | low;
  EXPECT_GT(now, 60'000'000'000u);  // SYNC was at 60 s and 9 ns; two frames of 20 us each ago
  EXPECT_LT(now, 60'000'080'000u);
  EXPECT_EQ(read(kTsstat), 0x11u);
  EXPECT_EQ(read(kTstat) & 1u << 5, 1u << 5);
  EXPECT_NE(top_->irq_time_o, 0);
  EXPECT_EQ(read(kTsofs), 0x80000000u);  // more than 2 s behind
  write(kTstat, 1u << 5);
  EXPECT_EQ(top_->irq_time_o, 0);
  write(kTimelo, 5);
  write(kTimehi, 7);
  clocks(4);
  EXPECT_EQ(read(kTimelo) >> 12, 0u);
  EXPECT_EQ(read(kTimehi), 7u);
}

// TM-102: what the clock is set to counts TSDLY as the way from the master.
TEST_F(FollowerRegs, TheDelayIsThatOfTheRegister) {
  constexpr std::uint32_t kDelay = 500'000;
  go();
  write(kTsdly, kDelay);
  write(kTsctrl, read(kTsctrl) | 1);
  pair(60, 9);
  const std::uint64_t low = read(kTimelo), now = std::uint64_t{read(kTimehi)} << 32 | low;
  EXPECT_GT(now, 60'000'000'000u + kDelay);  // two frames of 20 us each ago
  EXPECT_LT(now, 60'000'080'000u + kDelay);
}

// TM-102, TM-103, TM-104: offset and state as software sees them, from the first pair to the last,
// with a base and an extended identifier.
TEST_F(FollowerRegs, StateAndOffsetFollowThePairs) {
  constexpr unsigned kTmo = 20;  // 2^20 ns: six pairs
  go();
  write(kTsctrl, kTmo << 24 | 2u << 21 | 6u << 16 | 2u << 4 | 1u);
  for (const Frame &as : {Frame{.id = 0x77}, Frame{.id = 0x1A5C'3E77, .extended = true},
                          Frame{.id = 0x05A3'C188, .extended = true}}) {
    SCOPED_TRACE(as.id);
    write(kTsid, as.extended ? 1u << 31 | as.id : as.id << 18);
    epoch_ = cycles_;
    pairs(2, 0, as);
    EXPECT_EQ(state(), 1u);
    pairs(20, 0, as);
    EXPECT_EQ(state(), 2u);
    EXPECT_EQ(read(kTsstat) >> 4 & 0xF, sequence_ % 16);
    EXPECT_LE(read(kTsofs) + 20, 40u) << "to a clock";
    pairs(1, 1000, as);
    EXPECT_LE(read(kTsofs) + 1020, 40u) << "behind the master";
    pairs(as.extended ? 20 : 260, 0, as);
    EXPECT_EQ(state(), 2u);
    EXPECT_EQ(read(kTsstat) >> 8 == 255, !as.extended) << "pairs, no more are counted";
    clocks((1u << kTmo) / 20 + 100);
    EXPECT_EQ(state(), 3u);
    pairs(2, 0, as);
    EXPECT_EQ(state(), 1u) << "without a step";
    EXPECT_LE(read(kTsstat) >> 8, 2u);
    EXPECT_LE(read(kTsofs) + 20, 40u);
    write(kTsctrl, read(kTsctrl) & ~1u);
    clocks(4);
    EXPECT_EQ(state(), 0u);
    write(kTsctrl, read(kTsctrl) | 1u);
  }
  pairs(2, 0, {.id = 0x05A3'C188, .extended = true});
  EXPECT_EQ(state(), 1u);
  top_.reset();
  clocks(300);
  EXPECT_EQ(read(kTsstat), 0u);
  EXPECT_EQ(read(kTsofs), 0u);
}

}  // namespace
}  // namespace vericansim
