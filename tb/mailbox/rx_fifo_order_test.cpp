// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rx FIFO and mailboxes side by side: who gets a frame, and that neither disturbs the other
// (flexcan.md section 4).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <tuple>

#include "bus/faults.hpp"
#include "mailbox/rx_fifo_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kReceiver = RxFifoRig::kReceiver, kSender = RxFifoRig::kSender;
constexpr unsigned kDepth = 6;
constexpr std::uint32_t kAll = 0xFFFFFFFF;

Frame frame_of(std::uint32_t id, bool remote = false) {
  Frame frame;
  frame.id = id;
  frame.remote = remote;
  frame.dlc = 1;
  if (!remote) frame.data[0] = static_cast<std::uint8_t>(id);
  return frame;
}

enum class Mailboxes { kNone, kFree, kTaken, kTakenThenFree };
enum class Place { kNowhere, kFifo, kFirst, kSecond };

/// The rules of section 4 and of 3.5, told as a list.
Place expected(bool bcc, bool mrp, bool filter, bool full, Mailboxes mailboxes) {
  Place mailbox = Place::kNowhere;
  if (mailboxes == Mailboxes::kFree) mailbox = Place::kFirst;
  // None is free: the last one with the queue, the first one without.
  if (mailboxes == Mailboxes::kTaken) mailbox = bcc ? Place::kSecond : Place::kFirst;
  // The queue looks further for a free one.
  if (mailboxes == Mailboxes::kTakenThenFree) mailbox = bcc ? Place::kSecond : Place::kFirst;
  if (!filter || full) return mailbox;
  if (!mrp || mailbox == Place::kNowhere) return Place::kFifo;
  if (bcc && mailboxes == Mailboxes::kTaken) return Place::kFifo;  // rather than an overrun
  return mailbox;
}

// BCC, MRP, an element fits, the FIFO is full, mailboxes.
class Order : public ::testing::TestWithParam<std::tuple<bool, bool, bool, bool, Mailboxes>> {};

TEST_P(Order, FrameGoesWhereTheRulesSay) {  // FX-4.k, FX-4.l, FX-4.m, FX-CTRL2.MRP
  const auto [bcc, mrp, filter, full, mailboxes] = GetParam();
  constexpr unsigned kFirst = 10, kSecond = 12, kFiller = 0x7F0, kId = 0x123;
  RxFifoRig rig{{.format = 0, .bcc = bcc, .ctrl2 = mrp ? reg::kCtrl2Mrp : 0}};
  // Elements: the filler always, the frame if it is to fit.
  for (unsigned k = 0; k < 8; ++k)
    rig.set_filter(k, {(k == 3 && filter ? kId : kFiller) << 19, kAll});
  for (std::uint32_t mask : {reg::kRxfgmask, reg::kRxgmask}) rig.write(kReceiver, mask, kAll);
  for (unsigned mb : {kFirst, kSecond}) {
    rig.write(kReceiver, reg::rximr(mb), kAll);
    rig.write(kReceiver, reg::mb(mb, 1), kId << 18);
  }
  const std::uint32_t empty = reg::kCodeRxEmpty, taken = 0x02000000;
  rig.write(kReceiver, reg::mb(kFirst),
            mailboxes == Mailboxes::kNone   ? 0
            : mailboxes == Mailboxes::kFree ? empty
                                            : taken);
  rig.write(kReceiver, reg::mb(kSecond),
            mailboxes == Mailboxes::kNone    ? 0
            : mailboxes == Mailboxes::kTaken ? taken
                                             : empty);
  rig.join();
  if (full)
    for (unsigned i = 0; i < kDepth; ++i) rig.send(frame_of(kFiller));
  rig.write(kReceiver, reg::kIflag1, reg::kIflagFifoWarn);
  rig.send(frame_of(kId));

  const Place place = expected(bcc, mrp, filter, full, mailboxes);
  const std::uint32_t flags = rig.iflag();
  EXPECT_EQ((flags >> kFirst) & 1, place == Place::kFirst);
  EXPECT_EQ((flags >> kSecond) & 1, place == Place::kSecond);
  EXPECT_EQ((flags & reg::kIflagFifoOvf) != 0, filter && full && place == Place::kNowhere);
  const unsigned code = rig.get(kReceiver, place == Place::kFirst ? kFirst : kSecond).code();
  if (place == Place::kFirst || place == Place::kSecond) {
    const bool overrun = mailboxes == Mailboxes::kTaken ||
                         (mailboxes == Mailboxes::kTakenThenFree && place == Place::kFirst);
    EXPECT_EQ(code, overrun ? 6u : 2u);
  }
  const auto frames = rig.drain();
  EXPECT_EQ(frames.size(), (full ? kDepth : 0) + (place == Place::kFifo ? 1 : 0));
  if (place == Place::kFifo) {
    EXPECT_EQ(frames.back(), frame_of(kId));
  }
}

INSTANTIATE_TEST_SUITE_P(BccMrpFilterFullMailboxes, Order,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(), ::testing::Bool(),
                                            ::testing::Bool(),
                                            ::testing::Values(Mailboxes::kNone, Mailboxes::kFree,
                                                              Mailboxes::kTaken,
                                                              Mailboxes::kTakenThenFree)));

TEST(FifoAndMailboxes, RoomThatComesDuringTheFrameIsUsed) {  // FX-4.k
  RxFifoRig rig;
  rig.put_rx(kReceiver, 20, frame_of(0x100), 0);
  rig.join();
  for (unsigned i = 0; i < kDepth; ++i) rig.send(frame_of(0x100 + i));
  rig.put_tx(kSender, 60, frame_of(0x1FF));
  ASSERT_TRUE(rig.run_until([&] { return rig.field(kReceiver) == Field::kCrc; }, 2000));
  rig.pop();
  ASSERT_TRUE(rig.wait_flag(kSender, 60));
  rig.run(24);
  const auto frames = rig.drain();
  ASSERT_EQ(frames.size(), kDepth);
  EXPECT_EQ(frames.back().id, 0x1FFu);
  EXPECT_EQ(rig.iflag() >> 20, 0u);
}

TEST(FifoAndMailboxes, FirstMailboxIsBehindTheTable) {  // FX-4.a, FX-4.j, FX-CTRL2.RFFN
  for (unsigned rffn : {0u, 5u, 15u}) {
    RxFifoRig rig{{.format = 3, .rffn = rffn}};  // the FIFO takes nothing
    const unsigned first = rig.first_mailbox();
    // What would be buffers without the FIFO are words of the table, whatever they look like.
    for (unsigned mb = 0; mb < first; ++mb) {
      rig.write(kReceiver, reg::rximr(mb), 0);
      rig.write(kReceiver, reg::mb(mb), reg::kCodeRxEmpty);
    }
    rig.write(kReceiver, reg::rximr(first), kAll);
    rig.write(kReceiver, reg::mb(first, 1), 0x321u << 18);
    rig.write(kReceiver, reg::mb(first), reg::kCodeRxEmpty);
    rig.join();
    rig.send(frame_of(0x322));
    EXPECT_EQ(rig.flags(kReceiver), 0u) << "its own RXIMR counts";
    rig.send(frame_of(0x321));
    EXPECT_EQ(rig.flags(kReceiver), std::uint64_t{1} << first);
    const MbWords words = rig.get(kReceiver, first);
    EXPECT_EQ(words.code(), 2u);
    EXPECT_EQ(mb_frame(words), frame_of(0x321));
  }
}

TEST(FifoAndMailboxes, FifoLeavesBuffersAbove8Alone) {  // FX-9.e050443
  RxFifoRig rig;
  for (unsigned mb = 8; mb < 64; ++mb)
    rig.put(kReceiver, mb, {0x08000000u | mb, 0x01000000u + mb, 3 * mb, 5 * mb});
  rig.join();
  for (unsigned i = 0; i < 3 * kDepth; ++i) {
    rig.send(frame_of(0x200 + i));
    if (i % 3 != 0) rig.pop();
  }
  for (unsigned mb = 8; mb < 64; ++mb)
    EXPECT_EQ(rig.get(kReceiver, mb), (MbWords{0x08000000u | mb, 0x01000000u + mb, 3 * mb, 5 * mb}))
        << mb;
}

TEST(FifoAndMailboxes, LockedMailboxKeepsItsFrameWhileTheFifoFills) {  // FX-4.c, FX-3.5.o
  RxFifoRig rig{{.format = 0, .ctrl2 = reg::kCtrl2Mrp}};
  for (unsigned k = 0; k < 8; ++k) rig.set_filter(k, {0x400u << 19, 0x400u << 19});
  rig.put_rx(kReceiver, 30, frame_of(0x055), kAll);
  rig.join();
  rig.send(frame_of(0x055));
  EXPECT_EQ(rig.get(kReceiver, 30).code(), 2u);  // locked from here on
  rig.clear_flag(kReceiver, 30);
  rig.send(frame_of(0x055));
  EXPECT_EQ(rig.iflag(), 0u) << "it waits";
  for (unsigned i = 0; i < 4; ++i) rig.send(frame_of(0x400 + i));
  const auto frames = rig.drain();
  ASSERT_EQ(frames.size(), 4u);
  for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(frames[i], frame_of(0x400 + i));
  EXPECT_EQ(rig.iflag(), 0u) << "reading the FIFO does not unlock it";
  rig.read(kReceiver, reg::kTimer);
  rig.run(16);
  EXPECT_EQ(rig.iflag(), 1u << 30);
}

TEST(FifoAndMailboxes, OwnFramesOnlyWithoutSrxDis) {  // FX-MCR.SRX_DIS, FX-3.5.r
  for (std::uint32_t srx_dis : {0u, reg::kMcrSrxDis}) {
    RxFifoRig rig{{.mcr = srx_dis}};
    rig.join();
    rig.put_tx(kReceiver, 40, frame_of(0x155));
    ASSERT_TRUE(rig.wait_flag(kReceiver, 40));
    rig.run(24);
    const auto frames = rig.drain();
    ASSERT_EQ(frames.size(), srx_dis == 0 ? 1u : 0u);
    if (srx_dis == 0) {
      EXPECT_EQ(frames[0], frame_of(0x155));
    }
  }
}

// The receiver alone sees a wrong bit; the sender repeats the frame (FX-3.5.p).
TEST(FifoAndMailboxes, FrameWithAnErrorIsStoredNowhere) {
  for (Field field : {Field::kData, Field::kCrc, Field::kCrcDel, Field::kEof}) {
    std::deque<LevelFault> faults;  // they outlive the bus
    RxFifoRig rig{{.format = 0}};
    for (unsigned k = 0; k < 8; ++k) rig.set_filter(k, {0x400u << 19, 0x400u << 19});
    rig.put_rx(kReceiver, 20, frame_of(0x055), kAll);
    rig.join();
    for (const Frame &frame : {frame_of(0x400), frame_of(0x055)}) {
      rig.put_tx(kSender, 60, frame);
      ASSERT_TRUE(rig.run_until([&] { return rig.field(kReceiver) == field; }, 4000));
      const Time now = rig.bus().now();
      rig.bus().add(faults.emplace_back(kReceiver, Effect::kFlip, Window{now, now + kMicrosecond}));
      ASSERT_TRUE(rig.run_until([&] { return rig.field(kReceiver) == Field::kErrFlag; }, 400));
      rig.run(8);
      EXPECT_EQ(rig.iflag(), 0u);
      ASSERT_TRUE(rig.wait_flag(kSender, 60));
      rig.run(24);
      EXPECT_EQ(rig.iflag(), frame.id == 0x055 ? 1u << 20 : reg::kIflagFifo);
      EXPECT_EQ(rig.drain().size(), frame.id == 0x055 ? 0u : 1u);
      rig.clear_flag(kSender, 60);
    }
  }
}

TEST(FifoAndMailboxes, TsynCountsFromTheFirstMailbox) {  // FX-2.10.a
  RxFifoRig rig{{.format = 3, .rffn = 1, .ctrl = kTiming8 | (1u << 5)}};
  rig.put_rx(kReceiver, rig.first_mailbox() + 1, frame_of(0x011), kAll);
  rig.put_rx(kReceiver, rig.first_mailbox(), frame_of(0x010), kAll);
  rig.join();
  rig.run(8 * 200);
  rig.send(frame_of(0x011));
  EXPECT_GT(rig.read(kReceiver, reg::kTimer), 200u);
  rig.send(frame_of(0x010));
  EXPECT_LT(rig.read(kReceiver, reg::kTimer), 20u);
}

}  // namespace
}  // namespace vericansim
