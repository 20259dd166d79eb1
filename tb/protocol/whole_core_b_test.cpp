// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rules of sections 11 to 18 that need message buffers and registers: storage, status, hand-over.
#include <gtest/gtest.h>

#include <random>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks
constexpr std::uint32_t kExact = 0x1FFFFFFF;

Frame numbered(std::uint32_t id, std::uint32_t number) {
  Frame frame{.id = id, .dlc = 8};
  for (unsigned i = 0; i < 4; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(number >> (8 * i));
    frame.data[4 + i] = static_cast<std::uint8_t>(~number >> (8 * i));
  }
  return frame;
}

// PF-57, VA-05, AR-13: thirty frames back to back while both CPUs read buffer memory in every
// clock: each is stored whole before the next can be.
TEST(Storage, IsCompleteThoughTheMemoryIsBusyAllTheTime) {
  constexpr unsigned kFrames = 30;
  MailboxRig rig{2, 64};
  for (const unsigned n : {0u, 1u}) rig.configure(n);
  for (unsigned i = 0; i < kFrames; ++i) rig.put_rx(1, i, numbered(0x200 + i, 0), kExact);
  for (const unsigned n : {0u, 1u}) rig.go(n);
  for (unsigned i = 0; i < kFrames; ++i) rig.put_tx(0, 30 + i, numbered(0x200 + i, 0x1234567 * i));
  unsigned turn = 0;
  // Data words of buffers: a read of C/S would lock the buffer.
  const auto hammer = [&turn]() -> AhbTransfer {
    ++turn;
    return {.address = reg::mb(turn * 7 % 60, 2 + turn % 2)};
  };
  rig.hammer(0, hammer);
  rig.hammer(1, hammer);
  rig.run(kFrames * 140 * kBit);
  rig.hammer(0, nullptr);
  rig.hammer(1, nullptr);
  rig.run(10);
  for (unsigned i = 0; i < kFrames; ++i) {
    const MbWords words = rig.get(1, i);
    EXPECT_EQ(words.code(), 0x2u) << i;
    EXPECT_EQ(mb_frame(words), numbered(0x200 + i, 0x1234567 * i)) << i;
  }
  EXPECT_EQ(rig.flags(0), ((1ULL << kFrames) - 1) << 30);
  EXPECT_FALSE(rig.violated());
}

// Two senders with several buffers each, and a receiver with one buffer for each of theirs.
class HandOver : public ::testing::Test {
 protected:
  static constexpr unsigned kBuffers = 6;

  HandOver() {
    for (unsigned n = 0; n < 3; ++n) rig_.configure(n);
    for (unsigned s = 0; s < 2; ++s) {
      for (unsigned b = 0; b < kBuffers; ++b)
        rig_.put_rx(2, rx(s, b), numbered(id(s, b), 0), kExact);
    }
    for (unsigned n = 0; n < 3; ++n) rig_.go(n);
  }
  static unsigned rx(unsigned s, unsigned b) { return s * kBuffers + b; }
  static std::uint32_t id(unsigned s, unsigned b) { return 0x100 + 0x10 * b + s; }
  // The request of buffer b has ended: once, with its frame at the receiver, and nothing twice.
  void settle(unsigned s, unsigned b) {
    rig_.clear_flag(s, 20 + b);
    const MbWords words = rig_.get(2, rx(s, b));
    EXPECT_EQ(words.code(), 0x2u) << "sender " << s << " buffer " << b;
    EXPECT_EQ(mb_frame(words), numbered(id(s, b), number_[s][b]));
    rig_.clear_flag(2, rx(s, b));
    rig_.read(2, reg::kTimer);
    EXPECT_EQ(rig_.read(s, reg::mb(20 + b)) >> 24, 0x8u);
    number_[s][b] = 0;
  }

  MailboxRig rig_{3, 64};
  std::uint32_t number_[2][kBuffers] = {};  // of the request under way, 0: none
};

// PF-56, AR-13, RO-03: requests at random clocks amid foreign traffic, in both senders: each ends
// exactly once, none is forgotten, none is sent twice.
TEST_F(HandOver, EveryRequestEndsExactlyOnce) {
  std::mt19937 random{57};
  std::uint32_t requests = 0;
  for (unsigned round = 0; round < 1500; ++round) {
    const unsigned s = random() % 2;
    const unsigned b = random() % kBuffers;
    if (number_[s][b] == 0) {
      number_[s][b] = ++requests;
      rig_.put_tx(s, 20 + b, numbered(id(s, b), requests));
    }
    rig_.run(random() % 400);
    for (unsigned other = 0; other < 2; ++other) {
      const std::uint64_t flags = rig_.flags(other) >> 20;
      for (unsigned k = 0; k < kBuffers; ++k) {
        if ((flags >> k & 1) != 0) settle(other, k);
      }
    }
  }
  rig_.run(2 * kBuffers * 140 * kBit);
  for (unsigned s = 0; s < 2; ++s) {
    for (unsigned b = 0; b < kBuffers; ++b) {
      if (number_[s][b] != 0) settle(s, b);
    }
  }
  rig_.run(200 * kBit);
  EXPECT_EQ(rig_.flags(0) | rig_.flags(1) | rig_.flags(2), 0u);
  EXPECT_GT(requests, 300u);
}

// A sender that stops hearing the bus for a while and goes off, beside a healthy node.
class Recovery : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kWarnings = 0x00030300;  // TWRN_INT, RWRN_INT, TX_WRN, RX_WRN

  Recovery() : deaf_{0, Effect::kRecessive, {kMillisecond, 2 * kMillisecond}} {
    rig_.bus().add(deaf_);
    for (const unsigned n : {0u, 1u}) rig_.configure(n, {.mcr = reg::kMcrBcc | reg::kMcrWrnEn});
    rig_.put_rx(1, 0, {.id = 0x100, .dlc = 8}, kExact);
    for (const unsigned n : {0u, 1u}) rig_.go(n);
    rig_.run_until([&] { return rig_.bus().now() > kMillisecond; }, 10'000);
    rig_.put_tx(0, 20, numbered(0x100, 42));
    EXPECT_TRUE(rig_.run_until([&] { return (esr() & 0x20) != 0; }, 8000));
  }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }

  LevelFault deaf_;
  MailboxRig rig_{2, 64};
};

// PF-12, BO-06, BO-05, FC-23: bus-off is reported once; the count of the recovery moves no warning
// flag and no warning status; afterwards the counters are 0 and the frame goes out.
TEST_F(Recovery, MovesNoWarningFlag) {
  EXPECT_EQ(esr() & reg::kEsrBoffInt, reg::kEsrBoffInt);
  rig_.write(0, reg::kEsr, reg::kEsrInterrupts);
  unsigned polls = 0;
  while ((esr() & 0x20) != 0 && ++polls < 4000) {
    EXPECT_EQ(esr() & (kWarnings | reg::kEsrBoffInt), 0u) << polls;
    rig_.run(5 * kBit);
  }
  EXPECT_GT(polls, 200u);  // 1408 bits
  EXPECT_EQ(esr() & 0x30, 0u);
  EXPECT_EQ(rig_.read(0, reg::kEcr) & 0xFFFF, 0u);
  ASSERT_TRUE(rig_.wait_flag(1, 0));
  EXPECT_EQ(mb_frame(rig_.get(1, 0)), numbered(0x100, 42));
  EXPECT_EQ(esr() & (kWarnings | reg::kEsrBoffInt), 0u);
}

// MO-06, MO-04: loop-back: a sender's own frame lands in its own buffer if self-reception is on,
// and only then.
TEST(SelfReception, FollowsItsBit) {
  for (const bool off : {false, true}) {
    MailboxRig rig{2, 64};
    rig.configure(
        0, {.mcr = reg::kMcrBcc | (off ? reg::kMcrSrxDis : 0), .ctrl = kTiming8 | reg::kCtrlLpb});
    rig.configure(1);
    rig.put_rx(0, 0, {.id = 0x155, .dlc = 8}, kExact);
    rig.put_rx(1, 0, {.id = 0x155, .dlc = 8}, kExact);
    for (const unsigned n : {0u, 1u}) rig.go(n);
    rig.put_tx(0, 20, numbered(0x155, 7));
    ASSERT_TRUE(rig.wait_flag(0, 20));
    rig.run(20 * kBit);
    EXPECT_EQ(rig.flags(0) & 1, off ? 0u : 1u);
    EXPECT_EQ(rig.flags(1), 0u);  // the pin stays recessive
  }
}

}  // namespace
}  // namespace vericansim
