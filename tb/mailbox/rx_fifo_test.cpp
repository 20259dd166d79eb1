// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The Rx FIFO as the CPU sees it: fill, order, output, flags, and its place in the buffers
// (flexcan.md section 4).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "mailbox/rx_fifo_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kReceiver = RxFifoRig::kReceiver;
constexpr unsigned kDepth = 6;

/// Different in every part: kind, identifier, length and data.
Frame numbered(unsigned n) {
  Frame frame;
  frame.extended = n % 3 == 1;
  frame.remote = n % 5 == 4;
  frame.id = frame.extended ? 0x15A5A000 + n : 0x100 + n;
  frame.dlc = static_cast<std::uint8_t>(n % 9);
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(0x11 * n + i);
  return frame;
}

class RxFifo : public ::testing::Test {
 protected:
  void send(unsigned from, unsigned count) {
    for (unsigned n = from; n < from + count; ++n) rig_.send(numbered(n));
  }
  void expect_output(unsigned n) {
    const FifoOutput entry = rig_.output();
    EXPECT_EQ(mb_frame(entry.words), numbered(n)) << "frame " << n;
    EXPECT_EQ(entry.words.cs >> 23, 0u) << "CODE and reserved bits read 0";
  }

  RxFifoRig rig_;
};

TEST_F(RxFifo, FramesComeOutInTheOrderTheyCameIn) {  // FX-4.b, FX-4.c, FX-4.n
  rig_.join();
  EXPECT_EQ(rig_.iflag(), 0u);
  send(0, kDepth);
  for (unsigned n = 0; n < kDepth; ++n) {
    EXPECT_TRUE(rig_.available());
    expect_output(n);
    rig_.pop();
  }
  EXPECT_FALSE(rig_.available());
}

// Mailboxes first (MRP) all the same: the search for one has to end.
TEST_F(RxFifo, WorksWithoutAnyMailboxAboveIt) {  // FX-4.a, FX-4.l, FX-MCR.MAXMB
  for (const unsigned maxmb : {7u, 5u, 0u}) {
    ASSERT_TRUE(rig_.freeze(kReceiver));
    rig_.write(kReceiver, reg::kCtrl2, maxmb == 5 ? 0 : reg::kCtrl2Mrp);
    rig_.write(kReceiver, reg::kMcr, (rig_.read(kReceiver, reg::kMcr) & ~0x7Fu) | maxmb);
    rig_.join();
    send(0, kDepth);
    for (unsigned n = 0; n < kDepth; ++n) {
      ASSERT_TRUE(rig_.available()) << "MAXMB " << maxmb;
      expect_output(n);
      rig_.pop();
    }
  }
}

TEST_F(RxFifo, RingGoesRoundWithAnyFill) {  // FX-4.b
  rig_.join();
  unsigned in = 0, out = 0;
  for (unsigned fill = 1; fill <= kDepth; ++fill) {
    for (unsigned round = 0; round < 5; ++round) {
      for (; in < out + fill; ++in) rig_.send(numbered(in));
      for (unsigned n = 0; n < fill; ++n, ++out) {
        expect_output(out);
        rig_.pop();
      }
      EXPECT_FALSE(rig_.available());
    }
  }
  EXPECT_EQ(rig_.iflag() & reg::kIflagFifoOvf, 0u);
}

// The flag is in byte 0. Where another byte is written, the data lines carry ones there.
TEST_F(RxFifo, IsTakenFromByAWriteOfTheFlagsByte) {  // FX-4.n
  rig_.join();
  send(0, 3);
  const auto write = [this](unsigned byte, AhbSize size, std::uint32_t data) {
    const std::uint32_t address = reg::kIflag1 + byte;
    rig_.access(kReceiver, {.address = address, .write = true, .size = size, .data = data});
  };
  for (const unsigned byte : {1u, 2u, 3u}) write(byte, AhbSize::kByte, 0);
  write(2, AhbSize::kHalf, 0);
  expect_output(0);
  write(0, AhbSize::kByte, reg::kIflagFifo);
  expect_output(1);
  write(0, AhbSize::kHalf, reg::kIflagFifo);
  expect_output(2);
}

TEST_F(RxFifo, NextFrameIsAtTheOutputInTheTransferAfterThePop) {  // FX-4.n
  rig_.join();
  send(0, 3);
  for (unsigned n = 1; n < 3; ++n) {
    const auto seen =
        rig_.burst(kReceiver, {{.address = reg::kIflag1, .write = true, .data = reg::kIflagFifo},
                               {.address = reg::mb(0, 0)},
                               {.address = reg::kIflag1},
                               {.address = reg::mb(0, 1)},
                               {.address = reg::mb(0, 2)},
                               {.address = reg::mb(0, 3)}});
    EXPECT_NE(seen[2].data & reg::kIflagFifo, 0u) << "one is left";
    const MbWords words{seen[1].data, seen[3].data, seen[4].data, seen[5].data};
    EXPECT_EQ(mb_frame(words), numbered(n));
  }
  const auto last =
      rig_.burst(kReceiver, {{.address = reg::kIflag1, .write = true, .data = reg::kIflagFifo},
                             {.address = reg::kIflag1}});
  EXPECT_EQ(last[1].data, 0u);
}

TEST_F(RxFifo, TakingFromAnEmptyFifoHasNoEffect) {  // FX-4.p
  rig_.join();
  for (unsigned i = 0; i < 3; ++i) rig_.pop();
  send(0, 2);
  expect_output(0);
  rig_.pop();
  expect_output(1);
  rig_.pop();
  rig_.pop();
  EXPECT_FALSE(rig_.available());
  send(2, kDepth);
  EXPECT_EQ(rig_.drain().size(), kDepth);
}

TEST_F(RxFifo, WarningComesWithTheFifthFrame) {  // FX-4.o
  rig_.join();
  send(0, 4);
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifo);
  send(4, 1);
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifo | reg::kIflagFifoWarn);
  rig_.write(kReceiver, reg::kIflag1, reg::kIflagFifoWarn);
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifo) << "plain write-1-clears";
  send(5, 1);
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifo) << "5 -> 6 is no warning";
  rig_.pop();
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifo) << "6 -> 5 is none either";
  rig_.pop();
  send(6, 1);
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifo | reg::kIflagFifoWarn) << "again 4 -> 5";
  rig_.drain();
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifoWarn) << "stays until it is cleared";
}

TEST_F(RxFifo, SeventhFrameIsLostAndSaysSo) {  // FX-4.b, FX-4.m
  rig_.join();
  send(0, kDepth);
  EXPECT_EQ(rig_.iflag() & reg::kIflagFifoOvf, 0u);
  send(6, 1);
  EXPECT_NE(rig_.iflag() & reg::kIflagFifoOvf, 0u);
  for (unsigned n = 0; n < kDepth; ++n) {
    expect_output(n);
    rig_.pop();
  }
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifoOvf | reg::kIflagFifoWarn);
  rig_.write(kReceiver, reg::kIflag1, reg::kIflagFifoOvf);
  EXPECT_EQ(rig_.iflag(), reg::kIflagFifoWarn);
  send(7, 1);
  expect_output(7);
}

TEST_F(RxFifo, FlagsOfBuffers0To4AreUnused) {  // FX-1.5.d
  rig_.join();
  send(0, kDepth + 1);
  EXPECT_EQ(rig_.iflag() & 0x1Fu, 0u);
  rig_.write(kReceiver, reg::kIflag1, 0x1F);
  expect_output(0);
  rig_.drain();
  EXPECT_EQ(rig_.iflag() & 0x1Fu, 0u);
}

TEST_F(RxFifo, StampIsThatOfTheFrame) {  // FX-4.c
  rig_.join();
  send(0, 1);
  const unsigned first = rig_.output().words.cs & 0xFFFF;
  rig_.pop();
  send(0, 1);
  const unsigned second = rig_.output().words.cs & 0xFFFF;
  EXPECT_GT((second - first) & 0xFFFF, 46u) << "a frame of no data is 47 bits";
  EXPECT_LT((second - first) & 0xFFFF, 500u);
}

TEST_F(RxFifo, EngineAreaCannotBeWritten) {  // FX-4.a
  rig_.join();
  send(0, 2);
  for (std::uint32_t address = reg::mb(0); address < reg::filter(0); address += 4)
    rig_.write(kReceiver, address, 0x0CFFFFFF);
  expect_output(0);
  rig_.pop();
  expect_output(1);
  rig_.run(3000);
  EXPECT_EQ(rig_.flags(kReceiver) & ~std::uint64_t{0xE0}, 0u) << "nothing was sent";
  EXPECT_EQ(rig_.read(RxFifoRig::kSender, reg::kIflag1), 0u);
}

// The area of the FIFO is buffers like any other once FEN is 0, for all transfers but the one that
// is on its way while FEN is written (docs/integration.md). FX-MCR.FEN
TEST_F(RxFifo, EngineAreaIsBuffersOnceFenIsZero) {
  const std::uint32_t mcr = rig_.read(kReceiver, reg::kMcr);
  for (unsigned later = 1; later < 5; ++later) {
    const std::uint32_t word = reg::mb(3, 2), value = 0x1234'5600 + later;
    rig_.write(kReceiver, reg::kMcr, mcr);
    std::vector<AhbTransfer> transfers{
        {.address = reg::kMcr, .write = true, .data = mcr & ~reg::kMcrFen}};
    transfers.resize(1 + later, {.address = reg::kCtrl});
    transfers.push_back({.address = word, .write = true, .data = value});
    rig_.burst(kReceiver, transfers);
    EXPECT_EQ(rig_.read(kReceiver, word), value) << later << " transfers later";
  }
}

// The access right behind that of FEN is one to the filter table: all its bits are kept.
TEST_F(RxFifo, AreaBeginsWithTheWriteOfFen) {  // FX-4.a, FX-MCR.FEN
  ASSERT_TRUE(rig_.freeze(kReceiver));
  // AEN is set, with which no C/S word is kept whole.
  const std::uint32_t mcr = (rig_.read(kReceiver, reg::kMcr) & ~reg::kMcrFen) | 1u << 12;
  for (const unsigned mb : {6u, 7u, 8u}) {
    rig_.write(kReceiver, reg::kMcr, mcr);
    const auto results =
        rig_.burst(kReceiver, {{.address = reg::kMcr, .write = true, .data = mcr | reg::kMcrFen},
                               {.address = reg::mb(mb), .write = true, .data = 0xFFFFFFFF},
                               {.address = reg::mb(mb)}});
    EXPECT_EQ(results[2].data, mb < 8 ? 0xFFFFFFFFu : 0x0F7FFFFFu) << mb;
  }
}

TEST_F(RxFifo, ReadingTheOutputLocksNothing) {  // FX-4.c
  rig_.join();
  send(0, 1);
  rig_.read(kReceiver, reg::mb(0));
  send(1, kDepth);  // more than would fit if it were not for the pop below
  expect_output(0);
  rig_.pop();
  send(6, 1);
  EXPECT_EQ(rig_.drain().size(), kDepth);
}

TEST_F(RxFifo, IsEmptiedByAToggleOfFen) {  // FX-MCR.FEN
  rig_.join();
  send(0, kDepth + 1);
  ASSERT_TRUE(rig_.freeze(kReceiver));
  EXPECT_EQ(rig_.iflag(), 0xE0u);
  const std::uint32_t mcr = rig_.read(kReceiver, reg::kMcr);
  rig_.write(kReceiver, reg::kMcr, mcr & ~reg::kMcrFen);
  EXPECT_EQ(rig_.iflag(), 0u);
  rig_.write(kReceiver, reg::kMcr, mcr);
  EXPECT_EQ(rig_.iflag(), 0u);
  rig_.go(kReceiver);
  send(7, 1);
  expect_output(7);
}

// The flags are gone in the transfer behind the write, whether they were those of the FIFO or those
// of buffers 5 to 7.
TEST_F(RxFifo, ToggleOfFenClearsItsFlagsAtOnce) {  // FX-MCR.FEN
  rig_.join();
  send(0, kDepth + 1);
  ASSERT_TRUE(rig_.freeze(kReceiver));
  const std::uint32_t fifo = rig_.read(kReceiver, reg::kMcr), none = fifo & ~reg::kMcrFen;
  ASSERT_EQ(rig_.iflag(), 0xE0u);
  const auto flags_behind = [&](std::uint32_t mcr) {
    const auto results = rig_.burst(
        kReceiver, {{.address = reg::kMcr, .write = true, .data = mcr}, {.address = reg::kIflag1}});
    return results[1].data;
  };
  EXPECT_EQ(flags_behind(none), 0u);
  for (unsigned mb = 4; mb < 9; ++mb) rig_.put_rx(kReceiver, mb, {.id = 0x100 + mb}, ~0u);
  rig_.go(kReceiver);
  for (unsigned mb = 4; mb < 9; ++mb) rig_.send({.id = 0x100 + mb});
  ASSERT_TRUE(rig_.freeze(kReceiver));
  ASSERT_EQ(rig_.iflag(), 0x1F0u);
  EXPECT_EQ(flags_behind(fifo), 0x100u);
}

// Neither the mark of the buffer that was locked, nor the frame that waited for it, gets into the
// words of the table that now lie there.
TEST_F(RxFifo, TableGrowsOverALockedBuffer) {  // FX-4.a, FX-3.6.g, FX-CTRL2.RFFN
  for (const bool waits : {false, true}) {
    for (unsigned k = 0; k < 8; ++k) rig_.set_filter(k, {0x7E << 24, ~0u});
    rig_.put_rx(kReceiver, 8, {.id = 0x111}, ~0u);
    rig_.join();
    for (unsigned i = 0; i < (waits ? 2u : 1u); ++i) {
      rig_.send({.id = 0x111, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
      if (i == 0) {
        ASSERT_EQ(rig_.get(kReceiver, 8).code(), 2u);
      }
    }
    ASSERT_TRUE(rig_.freeze(kReceiver));
    rig_.write(kReceiver, reg::kCtrl2, reg::ctrl2_rffn(1));
    for (unsigned k = 8; k < 16; ++k) rig_.write(kReceiver, reg::filter(k), 0x01010101 * k);
    rig_.write(kReceiver, reg::kIflag1, ~0u);
    rig_.read(kReceiver, reg::kTimer);
    rig_.run(100);
    for (unsigned k = 8; k < 16; ++k)
      EXPECT_EQ(rig_.read(kReceiver, reg::filter(k)), 0x01010101 * k) << k;
    EXPECT_EQ(rig_.iflag(), 0u);
    rig_.write(kReceiver, reg::kCtrl2, 0);
  }
}

TEST_F(RxFifo, IsEmptiedBySoftReset) {  // FX-2.3.b
  rig_.join();
  send(0, kDepth + 1);
  rig_.write(kReceiver, reg::kMcr, reg::kMcrSoftRst);
  rig_.run(50);
  EXPECT_EQ(rig_.iflag(), 0u);
  rig_.set({});
  EXPECT_EQ(rig_.iflag(), 0u);
  rig_.go(kReceiver);
  send(7, 2);
  expect_output(7);
}

}  // namespace
}  // namespace vericansim
