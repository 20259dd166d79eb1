// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The filter table of the Rx FIFO: formats, masks, sizes (flexcan.md section 4).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <tuple>

#include "mailbox/rx_fifo_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kReceiver = RxFifoRig::kReceiver;
constexpr std::uint32_t kAll = 0xFFFFFFFF;
constexpr std::uint32_t kFar = 0xABABABAB;  // fits none of the random frames below

/// Format A element of exactly this frame.
std::uint32_t element_a(const Frame &frame) {
  return (std::uint32_t{frame.remote} << 31) | (std::uint32_t{frame.extended} << 30) |
         (frame.extended ? frame.id << 1 : frame.id << 19);
}

Frame base(std::uint32_t id, bool remote = false) {
  Frame frame;
  frame.id = id;
  frame.remote = remote;
  return frame;
}

Frame extended(std::uint32_t id, bool remote = false) {
  Frame frame = base(id, remote);
  frame.extended = true;
  return frame;
}

/// Element of the table that takes the frame, by the rules: the first one.
struct Table {
  unsigned format;
  unsigned own;          ///< words with a mask of their own
  std::uint32_t global;  ///< mask of the others
  std::vector<FilterWord> words;

  [[nodiscard]] std::optional<unsigned> find(const Frame &frame) const {
    const unsigned per_word = format == 0 ? 1 : format == 1 ? 2 : 4;
    for (unsigned k = 0; k < words.size(); ++k) {
      const FilterWord filter{words[k].word, k < own ? words[k].mask : global};
      if (const auto element = filter_element(format, filter, frame))
        return per_word * k + *element;
    }
    return std::nullopt;
  }
};

// Format, BCC, RFFN.
class Filters : public ::testing::TestWithParam<std::tuple<unsigned, bool, unsigned>> {
 protected:
  std::uint32_t random() { return static_cast<std::uint32_t>(rng_()); }

  /// Frames from a small world, so that they often meet an element and often just miss it.
  Frame random_frame() {
    Frame frame = random() % 2 == 0 ? base(0x2A5) : extended((0x2A5u << 18) | 0x1B3C5);
    frame.remote = random() % 4 == 0;
    if (random() % 2 == 0) frame.id ^= 1u << (random() % (frame.extended ? 29 : 11));
    frame.dlc = 0;
    return frame;
  }

  std::uint32_t random_word(unsigned format) {
    const auto half = [&] { return element_a(random_frame()) >> 16; };
    const auto byte = [&] {
      const Frame frame = random_frame();
      if (random() % 4 != 0) return kFar & 0xFF;
      return (frame.extended ? frame.id >> 21 : frame.id >> 3) & 0xFF;
    };
    if (format == 0) return element_a(random_frame());
    if (format == 1) return (half() << 16) | half();
    return (byte() << 24) | (byte() << 16) | (byte() << 8) | byte();
  }

  /// Few zeros; in a long table almost none, or its first words would take every frame.
  std::uint32_t random_mask(unsigned rffn) {
    const std::uint32_t mask = random() | random() | random();
    return rffn == 0 ? mask : mask | random() | random();
  }

  std::mt19937 rng_{7};
};

// FX-4.a, FX-4.d, FX-4.e, FX-4.f, FX-4.g, FX-4.h, FX-4.i, FX-3.5.g, FX-3.5.h, FX-RXFIR.IDHIT
TEST_P(Filters, FirstElementThatFitsTakesTheFrame) {
  const auto [format, bcc, rffn] = GetParam();
  RxFifoRig rig{{.format = format, .rffn = rffn, .bcc = bcc}};
  unsigned accepted = 0, refused = 0;
  for (unsigned round = 0; round < 12; ++round) {
    Table table{.format = format,
                .own = bcc ? std::min(8 + 2 * rffn, 32u) : 0,
                .global = random_mask(rffn),
                .words = {}};
    if (round % 2 == 1) table.global = kAll;
    for (unsigned k = 0; k < 8 * (rffn + 1); ++k) {
      table.words.push_back({random_word(format), random_mask(rffn)});
      if (k >= 3 && random() % (4 * rffn + 4) != 0) table.words[k].word = kFar;
      rig.set_filter(k, table.words[k]);
    }
    rig.write(kReceiver, reg::kRxfgmask, table.global);
    rig.go(kReceiver);
    if (round == 0) rig.go(RxFifoRig::kSender);
    for (unsigned i = 0; i < 12; ++i) {
      const Frame frame = random_frame();
      rig.send(frame);
      const auto element = table.find(frame);
      ASSERT_EQ(rig.available(), element.has_value()) << "round " << round << " frame " << i;
      ++(element ? accepted : refused);
      if (!element) continue;
      const FifoOutput entry = rig.output();
      ASSERT_EQ(entry.idhit, *element) << "round " << round << " frame " << i;
      ASSERT_EQ(mb_frame(entry.words), frame);
      rig.pop();
    }
    ASSERT_TRUE(rig.freeze(kReceiver));
  }
  EXPECT_EQ(accepted > 20, format != 3) << accepted;
  EXPECT_GT(refused, 10u);
}

INSTANTIATE_TEST_SUITE_P(FormatBccRffn, Filters,
                         ::testing::Combine(::testing::Range(0u, 4u), ::testing::Bool(),
                                            ::testing::Values(0u, 1u, 15u)),
                         [](const auto &test) {
                           return std::string{"ABCD"[std::get<0>(test.param)]} +
                                  (std::get<1>(test.param) ? "Own" : "Global") + "Rffn" +
                                  std::to_string(std::get<2>(test.param));
                         });

// A word that fits nothing, but for one that fits exactly: its place is its number.
TEST(FilterTable, EveryWordOfTheLongestTableIsLookedAt) {  // FX-4.a, FX-4.c, FX-RXFIR.IDHIT
  RxFifoRig rig{{.format = 0, .rffn = 15}};
  for (unsigned k = 0; k < 128; ++k) rig.set_filter(k, {element_a(base(0x400 + k)), kAll});
  rig.write(kReceiver, reg::kRxfgmask, kAll);
  rig.join();
  for (unsigned k = 0; k < 128; ++k) {
    rig.send(base(0x400 + k));
    ASSERT_TRUE(rig.available()) << k;
    const FifoOutput entry = rig.output();
    ASSERT_EQ(entry.idhit, k);
    ASSERT_EQ(entry.words.cs >> 23, 0u) << "CODE reads 0 with any number";
    rig.pop();
  }
  rig.send(base(0x480));
  EXPECT_FALSE(rig.available());
}

// The same with two and four elements in a word, upper bits first.
TEST(FilterTable, EveryHalfOfTheLongestTableIsLookedAt) {  // FX-4.e, FX-RXFIR.IDHIT
  RxFifoRig rig{{.format = 1, .rffn = 15}};
  const auto half = [](unsigned e) { return element_a(base(0x400 + e)) >> 16; };
  for (unsigned k = 0; k < 128; ++k) rig.set_filter(k, {half(2 * k) << 16 | half(2 * k + 1), kAll});
  rig.write(kReceiver, reg::kRxfgmask, kAll);
  rig.join();
  for (unsigned e = 0; e < 256; ++e) {
    rig.send(base(0x400 + e));
    ASSERT_TRUE(rig.available()) << e;
    ASSERT_EQ(rig.output().idhit, e);
    rig.pop();
  }
}

// An element of format C is eight bits, so each half of the table in turn has all values.
TEST(FilterTable, EveryByteOfTheLongestTableIsLookedAt) {  // FX-4.f, FX-RXFIR.IDHIT
  RxFifoRig rig{{.format = 2, .rffn = 15}};
  rig.write(kReceiver, reg::kRxfgmask, kAll);
  for (const unsigned from : {0u, 256u}) {
    for (unsigned k = 0; k < 128; ++k) {
      const unsigned value = 4 * k - from;
      const bool here = value < 256;
      rig.set_filter(k, {here ? 0x00010203 + 0x01010101 * value : kFar, kAll});
    }
    rig.go(kReceiver);
    if (from == 0) rig.go(RxFifoRig::kSender);
    for (unsigned value = 0; value < 256; ++value) {
      rig.send(base(value << 3));
      ASSERT_TRUE(rig.available()) << value;
      const unsigned expected = from != 0 && value == (kFar & 0xFF) ? 0 : from + value;
      ASSERT_EQ(rig.output().idhit, expected) << value;
      rig.pop();
    }
    ASSERT_TRUE(rig.freeze(kReceiver));
  }
}

TEST(FilterTable, EndsWhereRffnSays) {  // FX-4.a, FX-CTRL2.RFFN
  RxFifoRig rig;
  for (unsigned rffn : {0u, 1u, 7u, 14u, 4u, 12u}) {
    ASSERT_TRUE(rig.freeze(kReceiver));
    rig.set({.format = 0, .rffn = rffn, .bcc = false});
    const unsigned words = 8 * (rffn + 1);
    for (unsigned k = 0; k <= words; ++k)
      rig.write(kReceiver, reg::filter(k), element_a(base(0x100 + k)));
    rig.write(kReceiver, reg::kRxfgmask, kAll);
    rig.join();
    rig.send(base(0x100 + words));
    EXPECT_FALSE(rig.available()) << "that is a mailbox";
    rig.send(base(0x100 + words - 1));
    EXPECT_TRUE(rig.available());
    rig.pop();
  }
}

TEST(FilterTable, KeepsAllBitsOfItsWords) {  // FX-4.a
  RxFifoRig rig{{.rffn = 15}};
  std::mt19937 rng{1};
  std::array<std::uint32_t, 128> words;
  for (unsigned k = 0; k < words.size(); ++k) {
    words[k] = k % 3 == 0 ? kAll : static_cast<std::uint32_t>(rng());
    rig.write(kReceiver, reg::filter(k), words[k]);
  }
  for (unsigned k = 0; k < words.size(); ++k)
    EXPECT_EQ(rig.read(kReceiver, reg::filter(k)), words[k]) << k;
  rig.write(kReceiver, reg::mb(38), kAll);
  EXPECT_EQ(rig.read(kReceiver, reg::mb(38)), 0x0F7FFFFFu) << "a mailbox again";
}

// As NXP's driver does it: in freeze mode the whole table, at the end FEN.
TEST(FilterTable, MayBeWrittenBeforeFen) {  // FX-4.a
  for (const unsigned rffn : {0u, 3u}) {
    RxFifoRig rig{{.format = 0, .rffn = rffn}};
    const unsigned words = 8 * (rffn + 1);
    const auto frame = [](unsigned k) {
      return k % 2 == 0 ? base(0x605 + k, k % 3 == 0) : extended(0x1A345678 + k, k % 3 == 0);
    };
    const std::uint32_t mcr = rig.read(kReceiver, reg::kMcr);
    rig.write(kReceiver, reg::kMcr, mcr & ~reg::kMcrFen);
    for (unsigned k = 0; k < words; ++k)
      rig.write(kReceiver, reg::filter(k), k % 5 == 4 ? kAll : element_a(frame(k)));
    rig.write(kReceiver, reg::kRxfgmask, kAll);
    for (unsigned k = 0; k < 32; ++k) rig.write(kReceiver, reg::rximr(k), kAll);
    rig.write(kReceiver, reg::kMcr, mcr | reg::kMcrFen);
    for (unsigned k = 0; k < words; ++k)
      EXPECT_EQ(rig.read(kReceiver, reg::filter(k)), k % 5 == 4 ? kAll : element_a(frame(k))) << k;
    rig.join();
    rig.send(base(0x005));
    EXPECT_FALSE(rig.available()) << "no word has lost a bit";
    for (unsigned k = 0; k < words; ++k) {
      rig.send(frame(k));
      EXPECT_EQ(rig.available(), k % 5 != 4) << k;
      if (rig.available()) rig.pop();
    }
  }
}

TEST(FilterTable, WordsTakeBytesAndHalves) {  // FX-4.a
  RxFifoRig rig;
  for (unsigned k : {0u, 1u, 3u, 4u}) {
    rig.access(
        kReceiver,
        {.address = reg::filter(k) + 3, .write = true, .size = AhbSize::kByte, .data = 0xAB});
    rig.access(kReceiver,
               {.address = reg::filter(k), .write = true, .size = AhbSize::kHalf, .data = 0xCDEF});
    EXPECT_EQ(rig.read(kReceiver, reg::filter(k)), 0xAB00CDEFu) << k;
  }
}

// A word that software writes again as it is, by words and by bytes, fits in every clock of the
// pass over the table: what is read is never what the RAM returns for a word that is being written.
TEST(FilterTable, MayBeWrittenInTheClockOfItsRead) {  // FX-4.a, FX-4.d
  RxFifoRig rig{{.format = 0}};
  const auto frame = [](unsigned k) { return base(0x523 + k, k % 2 != 0); };
  for (unsigned k = 0; k < 8; ++k) rig.set_filter(k, {element_a(frame(k)), kAll});
  rig.join();
  for (const AhbSize size : {AhbSize::kWord, AhbSize::kByte}) {
    for (unsigned k = 0; k < 8; ++k) {
      for (unsigned clocks = 0; clocks < 24; ++clocks) {
        rig.put_tx(RxFifoRig::kSender, 0, frame(k));
        const auto control = [&] { return rig.field(kReceiver) == Field::kR0; };
        ASSERT_TRUE(rig.run_until(control, 400));
        rig.run(clocks);
        const unsigned lane = size == AhbSize::kByte ? 2 + k / 4 : 0;
        rig.access(kReceiver,
                   {.address = reg::filter(k) + lane,
                    .write = true,
                    .size = size,
                    .data = size == AhbSize::kByte ? element_a(frame(k)) >> (8 * lane) & 0xFF
                                                   : element_a(frame(k))});
        ASSERT_TRUE(rig.wait_flag(RxFifoRig::kSender, 0));
        rig.clear_flag(RxFifoRig::kSender, 0);
        EXPECT_TRUE(rig.available()) << "word " << k << ", clock " << clocks;
        if (!rig.available()) continue;
        EXPECT_EQ(rig.output().idhit, k) << "clock " << clocks;
        rig.pop();
      }
    }
  }
}

// The first 8 + 2 x RFFN words, at most 32, have RXIMR of the same number, the others RXFGMASK.
TEST(FilterTable, MaskOfEachWord) {  // FX-4.h
  for (unsigned rffn : {0u, 1u, 12u, 15u}) {
    RxFifoRig rig{{.format = 0, .rffn = rffn}};
    const unsigned words = 8 * (rffn + 1), own = std::min(8 + 2 * rffn, 32u);
    for (unsigned k = 0; k < words; ++k) rig.write(kReceiver, reg::filter(k), element_a(base(k)));
    for (unsigned n = 0; n < 64; ++n) rig.write(kReceiver, reg::rximr(n), kAll);
    rig.write(kReceiver, reg::kRxfgmask, kAll);
    rig.go(RxFifoRig::kSender);
    for (unsigned k : {0u, 7u, own - 1, own, words - 1}) {
      if (k >= words) continue;
      if (k < 64) rig.write(kReceiver, reg::rximr(k), 0);  // fits everything, where it counts
      rig.go(kReceiver);
      rig.send(extended(0x1FFFFFFF, true));
      EXPECT_EQ(rig.available(), k < own) << "rffn " << rffn << " word " << k;
      if (k < own) {
        EXPECT_EQ(rig.output().idhit, k);
        rig.pop();
      }
      ASSERT_TRUE(rig.freeze(kReceiver));
      if (k < 64) rig.write(kReceiver, reg::rximr(k), kAll);
    }
    rig.write(kReceiver, reg::kRxfgmask, 0);
    rig.go(kReceiver);
    rig.send(extended(0x1FFFFFFF, true));
    EXPECT_EQ(rig.available(), own < words) << "rffn " << rffn;
    if (own < words) {
      EXPECT_EQ(rig.output().idhit, own);
    }
  }
}

TEST(FilterTable, GlobalMaskForAllWithoutBcc) {  // FX-4.i
  RxFifoRig rig{{.format = 0, .bcc = false}};
  for (unsigned k = 0; k < 8; ++k) rig.write(kReceiver, reg::filter(k), element_a(base(k)));
  for (std::uint32_t other : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask})
    rig.write(kReceiver, other, 0);
  rig.write(kReceiver, reg::kRxfgmask, kAll);
  rig.join();
  rig.send(base(0x123));
  EXPECT_FALSE(rig.available()) << "no other mask counts";
  rig.send(base(6));
  EXPECT_EQ(rig.output().idhit, 6u);
}

TEST(FilterTable, RemAndExtAreComparedUnderTheMask) {  // FX-4.d, FX-4.e, FX-3.5.g
  for (unsigned format : {0u, 1u}) {
    RxFifoRig rig{{.format = format}};
    const std::uint32_t word = format == 0 ? 0xC0000000 : 0xC000C000;  // REM=1, EXT=1
    for (unsigned k = 0; k < 8; ++k) rig.set_filter(k, {word, word});
    rig.join();
    for (const Frame &frame : {base(5), base(5, true), extended(5), extended(5, true)}) {
      rig.send(frame);
      EXPECT_EQ(rig.available(), frame.remote && frame.extended);
    }
  }
}

TEST(FilterTable, FormatCTakesRemoteFramesOfBothKinds) {  // FX-4.f
  for (std::uint32_t rrs : {0u, reg::kCtrl2Rrs, reg::kCtrl2Rrs | reg::kCtrl2Eacen}) {
    RxFifoRig rig{{.format = 2, .ctrl2 = rrs}};
    for (unsigned k = 0; k < 8; ++k) rig.set_filter(k, {0x11A51122, kAll});
    rig.join();
    const std::uint32_t tail = 0x12345;
    for (const Frame &frame : {base(0xA5 << 3 | 5), base(0xA5 << 3 | 2, true),
                               extended(0xA5u << 21 | tail), extended(0xA5u << 21 | tail, true)}) {
      rig.send(frame);
      ASSERT_TRUE(rig.available());
      EXPECT_EQ(mb_frame(rig.output().words), frame);
      EXPECT_EQ(rig.output().idhit, 1u);
      rig.pop();
      Frame other = frame;
      other.id ^= frame.extended ? 1u << 21 : 1u << 3;
      rig.send(other);
      EXPECT_FALSE(rig.available());
    }
  }
}

TEST(FilterTable, FormatCWithoutMasksTakesEverything) {  // FX-4.q
  RxFifoRig rig{{.format = 2}};
  for (unsigned k = 0; k < 8; ++k) rig.write(kReceiver, reg::filter(k), 0x5A17C300 + k);
  rig.join();
  for (const Frame &frame : {base(0), base(0x7FF, true), extended(0x1FFFFFFF), extended(5, true)}) {
    rig.send(frame);
    ASSERT_TRUE(rig.available());
    EXPECT_EQ(mb_frame(rig.output().words), frame);
    EXPECT_EQ(rig.output().idhit, 0u);
    rig.pop();
  }
}

TEST(FilterTable, EndsAtTheLastBufferOfASmallCore) {  // FX-4.a
  for (unsigned num_mb : {16u, 32u}) {
    RxFifoRig rig{{.format = 0, .rffn = 15, .num_mb = num_mb}};
    const unsigned words = 4 * (num_mb - 6);
    for (unsigned k = 0; k < words; ++k) {
      rig.write(kReceiver, reg::filter(k), element_a(base(k + 1)));
      if (k < num_mb) rig.write(kReceiver, reg::rximr(k), kAll);
    }
    rig.write(kReceiver, reg::kRxfgmask, kAll);
    rig.join();
    rig.send(base(words));
    ASSERT_TRUE(rig.available());
    EXPECT_EQ(rig.output().idhit, words - 1);
    rig.pop();
    rig.send(base(words + 1));
    EXPECT_FALSE(rig.available());
    // Nor do the places of the FIFO follow the table: here they hold what would be an element.
    Frame bait = base(1);
    bait.dlc = 8;
    for (unsigned i = 0; i < 8; ++i)
      bait.data[i] = static_cast<std::uint8_t>(element_a(base(words + 2)) >> (24 - 8 * (i % 4)));
    rig.send(bait);
    EXPECT_EQ(rig.output().idhit, 0u);
    rig.pop();
    rig.send(base(words + 2));
    EXPECT_FALSE(rig.available());
  }
}

}  // namespace
}  // namespace vericansim
