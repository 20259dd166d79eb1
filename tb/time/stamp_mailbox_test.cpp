// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Stamps of frames in the rows of their buffers: TM-20 to TM-28 on the whole core.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "model/frame_codec.hpp"
#include "time/stamp_rule.hpp"
#include "time/time_rig.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

constexpr unsigned kClocksPerBit = 8;  // kTiming8
constexpr unsigned kSync = 2;          // synchroniser of the receive pin, clocks
constexpr std::uint32_t kPointSof = 0x30, kPointEdge = 0x31, kPointEof = 0x32, kTxpin = 4;

std::size_t reference_bit(const Frame &frame) { return reference_bit(encode_frame(frame).bits); }

Frame data_frame(std::uint32_t id, bool extended, unsigned dlc) {
  Frame frame;
  frame.id = id;
  frame.extended = extended;
  frame.dlc = static_cast<std::uint8_t>(dlc);
  for (unsigned i = 0; i < dlc && i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(0x11 * i);
  return frame;
}

/// Node 0 sends, the others receive in buffer 5.
class StampMailbox : public testing::Test {
 protected:
  explicit StampMailbox(unsigned nodes = 3) : time_{nodes} { rig_.run(400); }
  void bring_up(std::uint32_t tctrl, const RigConfig &config = {}) {
    for (unsigned n = 0; n < rig_.node_count(); ++n) {
      rig_.configure(n, config);
      rig_.write(n, reg::kRxgmask, 0);
      rig_.write(n, kTctrl, tctrl);
    }
    for (unsigned n = 0; n < rig_.node_count(); ++n) rig_.go(n);
  }
  /// Sends a frame and returns the edge at which its SOF began.
  std::uint64_t send(const Frame &frame, unsigned mb = 8) {
    const std::size_t falls = time_.node(0).falls().size();
    rig_.put_tx(0, mb, frame);
    EXPECT_TRUE(rig_.wait_flag(0, mb));
    rig_.clear_flag(0, mb);
    rig_.run(20);
    return time_.node(0).falls().at(falls);
  }
  /// Stamps: at the sender, at the others.
  static std::uint64_t sent_at(std::uint64_t sof, std::size_t bit) {
    return (sof + kClocksPerBit * bit) * kTimeStep;
  }
  static std::uint64_t received_at(std::uint64_t sof, std::size_t bit) {
    return sent_at(sof, bit) + kSync * kTimeStep;
  }

  TimeRig time_;
  MailboxRig &rig_ = time_.rig;
};

// TM-20, TM-21, TM-25, TM-27, TM-28: reference edge of frames of both formats, at the sender in the
// row of the buffer that sent, at the receivers in that of the buffer that took it.
TEST_F(StampMailbox, ReferenceEdge) {
  bring_up(kPointEdge);
  std::mt19937 random{19};
  for (unsigned i = 0; i < 60; ++i) {
    const bool extended = i % 2 != 0;
    const Frame frame = data_frame(random() & (extended ? 0x1FFFFFFFu : 0x7FFu), extended,
                                   static_cast<unsigned>(random() % 9));
    for (unsigned n = 1; n < 3; ++n) rig_.put_rx(n, 5, frame, {});
    const std::uint64_t sof = send(frame);
    const std::size_t bit = reference_bit(frame);
    EXPECT_EQ(time_.stamp(0, 8), sent_at(sof, bit)) << i;
    for (unsigned n = 1; n < 3; ++n) {
      EXPECT_EQ(rig_.get(n, 5).code(), 2u) << i;
      EXPECT_EQ(time_.stamp(n, 5), received_at(sof, bit)) << i;
      rig_.clear_flag(n, 5);
      rig_.read(n, reg::kTimer);
    }
  }
}

// TM-25: TXPIN: the sender stamps at its own receive pin.
TEST_F(StampMailbox, OwnPin) {
  bring_up(kPointEdge | kTxpin);
  const Frame frame = data_frame(0x080, false, 8);
  const std::uint64_t sof = send(frame);
  EXPECT_EQ(time_.stamp(0, 8), received_at(sof, reference_bit(frame)));
}

// TM-21, TM-25, TM-26: in loop-back a node receives what it sends, without the synchroniser and
// whatever is on the pin: with TXPIN, too, the stamps are those of its transmit flip-flop, in the
// row of the buffer that sent and in that of the one that took the frame.
TEST_F(StampMailbox, LoopBack) {
  constexpr unsigned kSample = 6;  // clocks into a bit: SYNC_SEG 1, PROP_SEG 2, PHASE_SEG1 3
  bring_up(kPointEdge, {.mcr = reg::kMcrBcc, .ctrl = kTiming8 | reg::kCtrlLpb});
  const Frame frame = data_frame(0x123, false, 3);
  const auto bits = encode_frame(frame).bits;
  for (const std::uint32_t tctrl :
       {kPointEdge, kPointEdge | kTxpin, kPointSof, kPointSof | kTxpin}) {
    SCOPED_TRACE(tctrl);
    rig_.write(0, kTctrl, tctrl);
    rig_.put_rx(0, 5, frame, {});
    rig_.put_tx(0, 8, frame);
    ASSERT_TRUE(rig_.wait_flag(0, 8));
    ASSERT_TRUE(rig_.wait_flag(0, 5));
    const std::size_t bit = (tctrl & ~kTxpin) == kPointSof ? 0 : reference_bit(bits);
    const std::size_t before = kClocksPerBit * (bits.size() - 2 - bit) + kSample;  // to EOF6
    const std::uint64_t expected = (time_.node(0).valids().back() - before) * kTimeStep;
    EXPECT_EQ(time_.stamp(0, 8), expected);
    EXPECT_EQ(time_.stamp(0, 5), expected);
    for (const unsigned mb : {5u, 8u}) rig_.clear_flag(0, mb);
  }
}

// TM-24: start of frame, and the sample point of EOF6.
TEST_F(StampMailbox, SofAndEof) {
  const Frame frame = data_frame(0x123, false, 3);
  const std::size_t eof6 = encode_frame(frame).bits.size() - 2;
  bring_up(kPointSof);
  for (unsigned n = 1; n < 3; ++n) rig_.put_rx(n, 5, frame, {});
  std::uint64_t sof = send(frame);
  EXPECT_EQ(time_.stamp(0, 8), sent_at(sof, 0));
  for (unsigned n = 1; n < 3; ++n) EXPECT_EQ(time_.stamp(n, 5), received_at(sof, 0));

  for (unsigned n = 0; n < 3; ++n) rig_.write(n, kTctrl, kPointEof);
  sof = send(frame);
  // TIME at the end of the clock of the sample point (SPLAT: two half clocks behind its beginning).
  EXPECT_EQ(time_.stamp(0, 8), time_.node(0).valids().back() * kTimeStep);
  for (unsigned n = 1; n < 3; ++n)
    EXPECT_EQ(time_.stamp(n, 5), time_.node(n).valids().back() * kTimeStep);
  // SYNC_SEG 1, PROP_SEG 2, PHASE_SEG1 3: six clocks into the bit, and SJW 1 behind the ACK.
  const std::uint64_t ideal = (sof + kClocksPerBit * eof6 + 6) * kTimeStep;
  EXPECT_GE(time_.stamp(0, 8), ideal);
  EXPECT_LE(time_.stamp(0, 8), ideal + kTimeStep);
}

// TM-24, TM-25: POINT and TXPIN that are written within a frame are those of the next frame.
TEST_F(StampMailbox, ChangedWithinAFrame) {
  const Frame frame = data_frame(0x123, false, 3);
  const std::size_t reference = reference_bit(frame);
  std::uint32_t tctrl = kPointSof;
  bring_up(tctrl);
  for (unsigned n = 1; n < 3; ++n) rig_.put_rx(n, 5, frame, {});
  for (const std::uint32_t next : {kPointEdge, kPointEof, kPointEdge | kTxpin, kPointEdge,
                                   kPointSof, kPointSof | kTxpin, kPointEof, kPointSof}) {
    const std::size_t falls = time_.node(0).falls().size();
    rig_.put_tx(0, 8, frame);
    ASSERT_TRUE(rig_.run_until([&] { return time_.node(0).falls().size() > falls; }, 1000));
    rig_.run(3 * kClocksPerBit);
    for (unsigned n = 0; n < 3; ++n) rig_.write(n, kTctrl, next);
    ASSERT_TRUE(rig_.wait_flag(0, 8));
    rig_.clear_flag(0, 8);
    rig_.run(20);
    const std::uint64_t sof = time_.node(0).falls().at(falls);
    const std::size_t bit = (tctrl & ~kTxpin) == kPointSof ? 0 : reference;
    for (unsigned n = 0; n < 3; ++n) {
      const bool pin = n != 0 || (tctrl & kTxpin) != 0;
      const std::uint64_t expected = tctrl == kPointEof ? time_.node(n).valids().back() * kTimeStep
                                     : pin              ? received_at(sof, bit)
                                                        : sent_at(sof, bit);
      EXPECT_EQ(time_.stamp(n, n == 0 ? 8 : 5), expected) << n << ' ' << std::hex << tctrl;
    }
    tctrl = next;
  }
}

// TM-27: a locked buffer keeps its stamp with its frame; the waiting frame brings its own.
TEST_F(StampMailbox, LockedBuffer) {
  bring_up(kPointEdge, {.mcr = reg::kMcrSrxDis});
  const Frame first = data_frame(0x155, false, 2), second = data_frame(0x155, false, 5);
  rig_.put_rx(1, 5, first, {});
  const std::uint64_t sof1 = send(first);
  rig_.get(1, 5);  // locks
  const std::uint64_t sof2 = send(second);
  EXPECT_EQ(time_.stamp(1, 5), received_at(sof1, reference_bit(first)));
  rig_.read(1, reg::kTimer);
  rig_.run(50);
  EXPECT_EQ(rig_.get(1, 5).cs >> 16 & 0xF, 5u);
  EXPECT_EQ(time_.stamp(1, 5), received_at(sof2, reference_bit(second)));
}

// TM-27: the row of buffer 0 is that of the output of the Rx FIFO.
TEST_F(StampMailbox, FifoOutput) {
  bring_up(kPointEdge, {.mcr = reg::kMcrBcc | reg::kMcrSrxDis | reg::kMcrFen});
  std::vector<std::uint64_t> expected;
  for (unsigned i = 0; i < 4; ++i) {
    const Frame frame = data_frame(0, false, i);
    const std::uint64_t sof = send(frame, 20);
    expected.push_back(received_at(sof, reference_bit(frame)));
  }
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_EQ(rig_.get(1, 0).cs >> 16 & 0xF, i);
    EXPECT_EQ(time_.stamp(1, 0), expected[i]) << i;
    rig_.write(1, reg::kIflag1, 1u << 5);
    rig_.run(10);
  }
}

// TM-27: under a CPU that reads a stamp in every clock, at 8 clocks a bit.
TEST_F(StampMailbox, BusyCpu) {
  bring_up(kPointEdge);
  const Frame frame = data_frame(0x2AA, false, 0);
  rig_.put_rx(1, 5, frame, {});
  for (unsigned i = 0; i < 40; ++i) {
    rig_.hammer(1, [i] { return AhbTransfer{.address = stamp(5) + 4 * (i % 2)}; });
    rig_.hammer(0, [i] { return AhbTransfer{.address = stamp(8) + 4 * (i % 2)}; });
    const std::uint64_t sof = send(frame);
    rig_.hammer(0, nullptr);
    rig_.hammer(1, nullptr);
    const std::uint64_t expected = sent_at(sof, reference_bit(frame));
    EXPECT_EQ(time_.stamp(0, 8), expected) << i;
    EXPECT_EQ(time_.stamp(1, 5), expected + kSync * kTimeStep) << i;
    EXPECT_LE(rig_.max_waits(), 1u);
    rig_.clear_flag(1, 5);
    rig_.get(1, 5);
    rig_.read(1, reg::kTimer);
  }
}

// TM-24, TM-27: the same at EOF6, where the stamp comes behind the frame that is to be moved.
TEST_F(StampMailbox, BusyCpuAtEof) {
  bring_up(kPointEof);
  const Frame frame = data_frame(0x2AA, false, 0);
  rig_.put_rx(1, 5, frame, {});
  for (unsigned i = 0; i < 40; ++i) {
    rig_.hammer(1, [i] { return AhbTransfer{.address = stamp(5) + 4 * (i % 2)}; });
    (void)send(frame);
    rig_.hammer(1, nullptr);
    EXPECT_EQ(time_.stamp(1, 5), time_.node(1).valids().back() * kTimeStep) << i;
    rig_.clear_flag(1, 5);
    rig_.get(1, 5);
    rig_.read(1, reg::kTimer);
  }
}

// TM-27, TM-28: a read of a word that is being written gets the old one or the new one.
TEST_F(StampMailbox, OldOrNew) {
  bring_up(kPointEdge);
  const Frame data = data_frame(0x2AA, false, 0);
  // Its reference bit, r1, comes before the header is known and buffers are looked at.
  Frame remote = data_frame(0x0AAAAAAA, true, 0);
  remote.remote = true;
  rig_.put_rx(1, 5, data, {});
  send(data);
  for (unsigned i = 0; i < 12; ++i) {
    const unsigned n = i % 2, mb = n == 0 ? 8 : 5;
    const Frame &frame = n == 0 ? remote : data;
    rig_.get(1, 5);
    rig_.read(1, reg::kTimer);
    rig_.clear_flag(1, 5);
    const std::uint64_t before = time_.stamp(n, mb);
    rig_.run(i * 7);
    const std::size_t falls = time_.node(0).falls().size();
    rig_.put_tx(0, 8, frame);
    std::vector<std::uint32_t> seen;
    while (seen.size() < 900) {
      const std::vector<AhbTransfer> reads(21 + i, {.address = stamp(mb)});
      for (const AhbResult &result : rig_.burst(n, reads)) seen.push_back(result.data);
    }
    rig_.clear_flag(0, 8);
    const std::uint64_t sof = time_.node(0).falls().at(falls);
    const std::uint64_t after = sent_at(sof, reference_bit(frame)) + n * kSync * kTimeStep;
    EXPECT_EQ(time_.stamp(n, mb), after);
    unsigned changes = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      ASSERT_TRUE(seen[k] == before || seen[k] == after) << std::hex << seen[k];
      changes += k > 0 && seen[k] != seen[k - 1] ? 1 : 0;
    }
    EXPECT_EQ(changes, 1u);
  }
}

// TM-27: while a stamp is copied to the row of a buffer, all that the CPU reads with that number is
// what it is: the words of the frame, which was there before, and its mask; the stamp is the old
// one or the new one.
TEST_F(StampMailbox, ReadsBesideTheCopy) {
  constexpr std::uint32_t kMask = 0x5FFC'0123, kAhead = 0x0123'4567;
  constexpr unsigned kReads = 60;
  bring_up(kPointEdge);
  const Frame frame = data_frame(0x2AA, false, 8);
  ASSERT_TRUE(rig_.freeze(1));
  rig_.write(1, reg::rximr(5), kMask);
  rig_.put_rx(1, 5, frame, {});
  rig_.go(1);
  send(frame);
  const MbWords words = rig_.get(1, 5);
  std::uint32_t high = 0;
  const auto upper = [&] { return time_.stamp(1, 5) >> 32; };
  const auto reads_at = [&](std::uint32_t address, unsigned clock) {
    rig_.write(1, kTimelo, 0);
    rig_.write(1, kTimehi, high += kAhead);
    rig_.put_tx(0, 8, frame);
    EXPECT_TRUE(rig_.run_until([&] { return rig_.field(1) == Field::kEof; }, 2000));
    rig_.run(clock);
    const std::vector<AhbTransfer> reads(kReads, {.address = address});
    const auto seen = rig_.burst(1, reads);
    rig_.read(1, reg::kTimer);
    EXPECT_TRUE(rig_.wait_flag(0, 8));
    rig_.clear_flag(0, 8);
    return seen;
  };
  for (const unsigned clock : {0u, 1u}) {  // a read takes two
    for (const auto &[address, value] : {std::pair{reg::mb(5, 1), words.id},
                                         {reg::mb(5, 2), words.low},
                                         {reg::mb(5, 3), words.high},
                                         {reg::rximr(5), kMask}})
      for (const AhbResult &result : reads_at(address, clock))
        ASSERT_EQ(result.data, value) << std::hex << address << ' ' << clock;
    const std::uint64_t before = upper();
    unsigned old = 0, fresh = 0;
    for (const AhbResult &result : reads_at(stamp(5) + 4, clock)) {
      old += result.data == before ? 1 : 0;
      fresh += result.data == before + kAhead ? 1 : 0;
    }
    EXPECT_EQ(old + fresh, kReads);
    EXPECT_GT(old, 20u);
    EXPECT_GT(fresh, 20u);
  }
}

// TM-28: a frame whose buffer is rewritten while it is sent leaves no stamp there.
TEST_F(StampMailbox, RewrittenBuffer) {
  bring_up(kPointEdge);
  const Frame frame = data_frame(0x300, false, 8);
  const std::size_t falls = time_.node(0).falls().size();
  rig_.put_tx(0, 8, frame);
  rig_.run_until([&] { return time_.node(0).falls().size() > falls; }, 4000);
  rig_.run(8);
  // In the identifier: the frame on the bus is no longer the buffer's.
  rig_.put_rx(0, 8, frame, {});
  rig_.run(1500);
  EXPECT_EQ(rig_.get(0, 8).code(), 4u);
  EXPECT_EQ(time_.stamp(0, 8), 0u);
}

}  // namespace
}  // namespace vericansim
