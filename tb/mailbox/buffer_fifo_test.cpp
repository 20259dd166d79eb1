// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The receive FIFO against the model of the buffers (flexcan.md 4): filters bit by bit, table
// sizes, fill levels, pops at every clock around a move-in, the order of FIFO and mailboxes.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kElement0 = 0x0E0;
constexpr Frame kHit{.id = 0x123, .dlc = 1, .data = {0x42}};
constexpr Frame kMiss{.id = 0x2DC, .dlc = 1, .data = {0x24}};

Frame numbered(unsigned number) {
  Frame frame = kHit;
  frame.data[0] = static_cast<std::uint8_t>(number);
  return frame;
}

// The element of this format that stands for a frame, in all its parts.
std::uint32_t element_for(const Frame &frame, unsigned idam) {
  const std::uint32_t rem = frame.remote ? 1 : 0, ext = frame.extended ? 1 : 0;
  if (idam == 1) {
    const std::uint32_t half =
        (rem << 15) | (ext << 14) | (frame.extended ? frame.id >> 15 : frame.id << 3);
    return (half << 16) | half;
  }
  if (idam == 2) return 0x01010101u * (frame.extended ? frame.id >> 21 : frame.id >> 3);
  return (rem << 31) | (ext << 30) | (frame.extended ? frame.id << 1 : frame.id << 19);
}

// Elements 0 to 8 * (RFFN + 1) - 1 for `frame`.
void fill_table(BufferRig &rig, const Frame &frame) {
  for (unsigned i = 0; i < rig.config().filter_elements(); ++i)
    rig.write(kElement0 + 4 * i, element_for(frame, rig.config().idam));
}

void set_masks(BufferRig &rig, std::uint32_t mask) {
  for (unsigned i = 0; i < rig.config().num_mb; ++i) rig.write(reg::rximr(i), mask);
  rig.write(reg::kRxfgmask, mask);
}

// Takes everything out, with a look at each frame.
void drain(BufferRig &rig) {
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned word = 0; word < 4; ++word) rig.read(reg::mb(0, word));
    rig.read(reg::kRxfir);
    rig.write(reg::kIflag1, 0xE0);
    rig.read(reg::kIflag1);
  }
}

class FifoFormat : public ::testing::TestWithParam<std::tuple<unsigned, bool>> {};

// FX-4.d, FX-4.e, FX-4.f, FX-4.g, FX-MCR.IDAM, FX-1.9.c, FX-3.5.g: every bit of the filter and of
// the mask, for the four kinds of frames, in each part of an element. FX-4.h, FX-4.i: masks of
// both BCC settings. FX-RXFIR.IDHIT, FX-4.c.
TEST_P(FifoFormat, EveryBit) {
  const auto [idam, bcc] = GetParam();
  BufferRig rig{{.num_mb = 16, .maxmb = 15, .bcc = bcc, .fen = true, .idam = idam}};
  for (unsigned kind = 0; kind < 4 && !HasFailure(); ++kind) {
    const bool extended = (kind & 1) != 0, remote = (kind & 2) != 0;
    const Frame frame{
        .id = extended ? 0x0AAAB555u : 0x2AAu, .extended = extended, .remote = remote};
    for (unsigned bit = 0; bit < 32; ++bit) {
      for (const bool compared : {true, false}) {
        SCOPED_TRACE(testing::Message() << "kind " << kind << " bit " << bit << ' ' << compared);
        rig.freeze();
        set_masks(rig, 0xFFFFFFFF);
        // Nothing fits but, perhaps, element 2 and its parts.
        Frame other = frame;
        other.id ^= extended ? 0x1FFFFFFF : 0x7FF;
        fill_table(rig, other);
        rig.write(kElement0 + 8, element_for(frame, idam) ^ (1u << bit));
        if (!compared && bcc) rig.write(reg::rximr(2), ~(1u << bit));
        if (!compared && !bcc) rig.write(reg::kRxfgmask, ~(1u << bit));
        rig.go();
        rig.receive(frame);
        rig.read(reg::kIflag1);
        rig.read(reg::kRxfir);
        rig.read(reg::mb(0));
        rig.read(reg::mb(0, 1));
        rig.write(reg::kIflag1, 0xE0);
      }
    }
  }
}

// Random tables, masks and identifiers of few bits, so that several elements fit: the first counts.
TEST_P(FifoFormat, RandomTables) {
  const auto [idam, bcc] = GetParam();
  const unsigned seed = 10 * idam + (bcc ? 1 : 0);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 rng{seed};
  BufferRig rig{{.num_mb = 16, .maxmb = 15, .bcc = bcc, .fen = true, .idam = idam}};
  const auto random_frame = [&] {
    const bool extended = rng() % 2 != 0;
    const std::uint32_t low = rng() % 4;
    return Frame{.id = extended ? (low << 27) | (low << 15) | low : (low << 9) | low,
                 .extended = extended,
                 .remote = rng() % 3 == 0,
                 .dlc = static_cast<std::uint8_t>(rng() % 9)};
  };
  for (unsigned round = 0; round < 15 && !HasFailure(); ++round) {
    ASSERT_TRUE(rig.freeze());
    for (unsigned i = 0; i < 8; ++i) {
      rig.write(kElement0 + 4 * i, element_for(random_frame(), idam));
      rig.write(reg::rximr(i), 0xFFFFFFFF << (rng() % 33 / 2));
    }
    rig.write(reg::kRxfgmask, 0xFFFFFFFF << (rng() % 17));
    rig.put_rx(9, random_frame());
    rig.go();
    for (unsigned i = 0; i < 9; ++i) rig.receive(random_frame());
    rig.compare();
    drain(rig);
  }
}

std::string format_name(const ::testing::TestParamInfo<std::tuple<unsigned, bool>> &test) {
  return std::string{"ABCD"[std::get<0>(test.param)]} + (std::get<1>(test.param) ? "Bcc" : "NoBcc");
}

INSTANTIATE_TEST_SUITE_P(All, FifoFormat,
                         ::testing::Combine(::testing::Range(0u, 4u), ::testing::Bool()),
                         format_name);

class FifoTable : public ::testing::TestWithParam<unsigned> {};

// FX-4.a, FX-CTRL2.RFFN, FX-4.h, FX-4.j: each element of each table size, the masks it has, the
// first mailbox behind the table. FX-1.5.d: no flag in the area. FX-9.e050443: nothing else moves.
TEST_P(FifoTable, EveryElement) {
  const unsigned rffn = GetParam();
  BufferRig rig{{.num_mb = 64, .maxmb = 63, .fen = true, .rffn = rffn}};
  const unsigned first = rig.config().first_mailbox();
  set_masks(rig, 0xFFFFFFFF);
  fill_table(rig, kMiss);
  rig.put_rx(first, {.id = 0x555});
  rig.put_rx(63, {.id = 0x555});
  rig.go();
  for (unsigned element = 0; element < rig.config().filter_elements() && !HasFailure(); ++element) {
    SCOPED_TRACE(testing::Message() << "element " << element);
    ASSERT_TRUE(rig.freeze());
    rig.write(kElement0 + 4 * element, element_for({.id = 0x122}, 0));
    const bool own_mask = element < std::min(32u, 8 + 2 * rffn);
    rig.write(own_mask ? reg::rximr(element) : reg::kRxfgmask, ~(1u << 19));
    rig.go();
    rig.receive(kHit);
    rig.read(reg::kIflag1);
    EXPECT_EQ(rig.read(reg::kRxfir), element);
    rig.write(reg::kIflag1, 0xE0);
    ASSERT_TRUE(rig.freeze());
    rig.write(kElement0 + 4 * element, element_for(kMiss, 0));
    rig.write(own_mask ? reg::rximr(element) : reg::kRxfgmask, 0xFFFFFFFF);
    rig.go();
  }
  rig.receive({.id = 0x555});
  EXPECT_EQ((std::uint64_t{rig.read(reg::kIflag2)} << 32) | rig.read(reg::kIflag1),
            std::uint64_t{1} << first);
  rig.compare();
}

INSTANTIATE_TEST_SUITE_P(EveryRffn, FifoTable, ::testing::Range(0u, 16u));

// MRP and BCC as the bits of a number.
class FifoOrder : public ::testing::TestWithParam<unsigned> {
 protected:
  FifoOrder()
      : rig_{{.num_mb = 16,
              .maxmb = 15,
              .bcc = (GetParam() & 1) != 0,
              .fen = true,
              .mrp = (GetParam() & 2) != 0}} {
    set_masks(rig_, 0xFFFFFFFF);
    fill_table(rig_, kHit);
  }
  void fill(unsigned count) {
    for (unsigned i = 0; i < count; ++i) rig_.receive(numbered(i));
  }
  BufferRig rig_;
};

// FX-4.b, FX-4.m, FX-4.n, FX-4.o, FX-4.p, FX-1.5.c, FX-MCR.FEN: fill 0 to 8, flags and output at
// each step; then out again, and once more from the empty FIFO.
TEST_P(FifoOrder, FillOverflowAndDrain) {
  rig_.go();
  for (unsigned i = 0; i < 8; ++i) {
    rig_.receive(numbered(i));
    EXPECT_EQ(rig_.read(reg::kIflag1), (i >= 6 ? 0x80u : 0) | (i >= 4 ? 0x40u : 0) | 0x20u);
    rig_.compare();
  }
  rig_.write(reg::kIflag1, 0xC0);
  for (unsigned i = 0; i < 8; ++i) {
    EXPECT_EQ(rig_.read(reg::kIflag1), i < 6 ? 0x20u : 0u);
    if (i < 6) {
      EXPECT_EQ(rig_.read(reg::mb(0, 2)) >> 24, i);
    }
    rig_.compare();
    rig_.write(reg::kIflag1, 0x20);
  }
  fill(2);
  rig_.compare();
}

// FX-4.k, FX-4.l, FX-4.m, FX-CTRL2.MRP, FX-3.7.d: FIFO and mailboxes both fit; mailboxes empty,
// full, serviced, locked, or waiting to answer; random.
TEST_P(FifoOrder, FifoOrMailbox) {
  const unsigned seed = 77 + GetParam();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 rng{seed};
  rig_.go();
  for (unsigned step = 0; step < 400 && !HasFailure(); ++step) {
    const unsigned mb = 8 + rng() % 8;
    switch (rng() % 8) {
      case 0: rig_.put_rx(mb, kHit, rng() % 3 == 0 ? 0u : unsigned{kRxEmpty}); break;
      case 1: rig_.read_cs(mb); break;
      case 2: rig_.read(reg::kTimer); break;
      case 3: rig_.write(reg::kIflag1, rng() % 2 != 0 ? 0x20 : 0xFFFFFFC0); break;
      default: rig_.receive(numbered(step)); break;
    }
    rig_.read(reg::kIflag1);
    if (step % 10 == 9) rig_.compare_quietly();
    if (step % 50 == 49) rig_.compare();
  }
}

// FX-4.n, FX-4.p, FX-1.5.e: a pop at every clock around a move-in, from every fill.
TEST_P(FifoOrder, PopAtEveryClock) {
  rig_.go();
  rig_.receive(kHit);
  const std::uint64_t length = rig_.end_clock() - rig_.start_clock();
  drain(rig_);
  for (unsigned level = 0; level <= 6; ++level) {
    for (int offset = -12; offset <= 40 && !HasFailure(); ++offset) {
      SCOPED_TRACE(testing::Message() << "fill " << level << " clock " << offset);
      fill(level);
      const std::uint64_t frames = rig_.frames_started();
      rig_.peer_sends(numbered(0x80));
      ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 400));
      rig_.at(rig_.start_clock() + length + offset,
              {.address = reg::kIflag1, .write = true, .data = 0xE0});
      rig_.quiet();
      drain(rig_);
    }
  }
}

// FX-MCR.FEN, FX-2.3.b: a change of FEN and a soft reset empty the FIFO and clear its flags.
TEST_P(FifoOrder, FenAndSoftResetEmptyIt) {
  const BufferConfig with = rig_.config();
  BufferConfig without = with;
  without.fen = false;
  rig_.go();
  fill(7);
  rig_.configure(without);
  EXPECT_EQ(rig_.read(reg::kIflag1), 0u);
  rig_.configure(with);
  EXPECT_EQ(rig_.read(reg::kIflag1), 0u);
  fill(3);
  EXPECT_EQ(rig_.read(reg::mb(0, 2)) >> 24, 0u);
  rig_.soft_reset();
  EXPECT_EQ(rig_.read(reg::kIflag1), 0u);
  rig_.configure(with);
  rig_.go();
  fill(1);
  EXPECT_EQ(rig_.read(reg::kIflag1), 0x20u);
  rig_.compare();
}

// FX-4.q, FX-4.r: Linux: format C, masks 0, the table as it is; one frame after the other.
TEST_P(FifoOrder, AsLinuxReadsIt) {
  BufferConfig config = rig_.config();
  config.idam = 2;
  rig_.configure(config);
  set_masks(rig_, 0);
  rig_.go();
  const Frame frames[] = {{.id = 0x7FF, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}},
                          {.id = 0x1ABCDEF0, .extended = true, .remote = true, .dlc = 4},
                          {.id = 0, .dlc = 0}};
  for (const Frame &frame : frames) rig_.receive(frame);
  for (const Frame &frame : frames) {
    ASSERT_NE(rig_.read(reg::kIflag1) & 0x20, 0u);
    MbWords words{.cs = rig_.read(reg::mb(0)), .id = rig_.read(reg::mb(0, 1))};
    if (frame.dlc > 0 && !frame.remote) words.low = rig_.read(reg::mb(0, 2));
    if (frame.dlc > 4 && !frame.remote) words.high = rig_.read(reg::mb(0, 3));
    rig_.write(reg::kIflag1, 0x20);
    rig_.read(reg::kTimer);
    EXPECT_EQ(mb_frame(words), frame);
    EXPECT_EQ(words.code(), 0u);
  }
  EXPECT_EQ(rig_.read(reg::kIflag1), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, FifoOrder, ::testing::Range(0u, 4u), [](const auto &test) {
  return std::string{(test.param & 2) != 0 ? "MailboxesFirst" : "FifoFirst"} +
         ((test.param & 1) != 0 ? "Bcc" : "NoBcc");
});

}  // namespace
}  // namespace vericansim
