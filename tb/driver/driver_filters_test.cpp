// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Filters: what is received is exactly what the definition of verican_filter_t says, through
// mailboxes and through each format of the FIFO (flexcan.md 1.9, 3.5, 4).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "driver/driver_node.hpp"
#include "driver/fake_core.hpp"

namespace vericansim {
namespace {

using Filters = std::vector<verican_filter_t>;

constexpr auto kStd = VERICAN_SELECT_ONLY_0, kExt = VERICAN_SELECT_ONLY_1;
constexpr auto kData = VERICAN_SELECT_ONLY_0, kRemote = VERICAN_SELECT_ONLY_1;
constexpr auto kBoth = VERICAN_SELECT_BOTH;

// The definition, in the words of the header.
bool accepts(const verican_filter_t &filter, const verican_frame_t &frame) {
  const bool extended = (frame.flags & VERICAN_FRAME_EXTENDED) != 0;
  const bool remote = (frame.flags & VERICAN_FRAME_REMOTE) != 0;
  if (filter.ide != kBoth && (filter.ide == kExt) != extended) return false;
  if (filter.rtr != kBoth && (filter.rtr == kRemote) != remote) return false;
  const std::uint32_t id = extended && filter.ide == kBoth ? frame.id >> 18 : frame.id;
  return ((id ^ filter.id) & filter.mask) == 0;
}

struct Case {
  const char *name;
  verican_rx_mode_t rx_mode;
  verican_fifo_format_t format;
  Filters filters;
};

class DriverFilters : public ::testing::TestWithParam<Case> {
 protected:
  // Identifiers that a filter takes, or takes but for one bit, and any.
  verican_frame_t make() {
    const Filters &filters = GetParam().filters;
    verican_frame_t frame = driver_frame(0, random_() % 3);
    frame.flags = static_cast<std::uint8_t>(random_() & 3);
    const bool extended = (frame.flags & VERICAN_FRAME_EXTENDED) != 0;
    frame.id = random_();
    if (!filters.empty() && random_() % 8 != 0) {
      const verican_filter_t &near = filters[random_() % filters.size()];
      std::uint32_t id = near.id, mask = near.mask;
      if (extended && near.ide != kExt) id <<= 18, mask <<= 18;
      if (!extended && near.ide == kExt) id >>= 18, mask >>= 18;
      frame.id = (id & mask) | (frame.id & ~mask);
      if (random_() % 2 == 0) frame.id ^= 1u << random_() % 29;
    }
    frame.id &= extended ? 0x1FFFFFFF : 0x7FF;
    return frame;
  }

  void set_up() {
    bus_[1].config.rx_mode = GetParam().rx_mode;
    bus_[1].config.fifo_format = GetParam().format;
    ASSERT_EQ(verican_init(&bus_[1].dev, &bus_[1].config), VERICAN_OK);
    ASSERT_EQ(verican_set_filters(&bus_[1].dev, GetParam().filters.data(),
                                  static_cast<std::uint16_t>(GetParam().filters.size())),
              VERICAN_OK);
    ASSERT_EQ(verican_start(&bus_[1].dev), VERICAN_OK);
    ASSERT_EQ(bus_[0].up(), VERICAN_OK);
    bus_.run(20 * kMicrosecond);
  }

  DriverBus bus_{2};
  std::mt19937 random_{11};
};

// FX-3.5.c, FX-3.5.f, FX-4.d, FX-4.e, FX-4.f, FX-4.g, FX-4.h
TEST_P(DriverFilters, AcceptWhatTheyAreDefinedToAccept) {
  set_up();
  unsigned accepted = 0;
  constexpr unsigned kFrames = 200;
  for (unsigned k = 0; k < kFrames; ++k) {
    const verican_frame_t frame = make();
    bus_[0].events.clear();
    ASSERT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return !bus_[0].events.empty(); }));
    bus_.run(20 * kMicrosecond);
    const auto frames = bus_[1].received();
    const bool expected =
        std::any_of(GetParam().filters.begin(), GetParam().filters.end(),
                    [&](const verican_filter_t &filter) { return accepts(filter, frame); });
    EXPECT_EQ(frames.size(), expected ? 1u : 0u)
        << "id " << std::hex << frame.id << " flags " << unsigned{frame.flags};
    if (frames.size() == 1) {
      EXPECT_EQ(frames[0].id, frame.id);
      EXPECT_EQ(frames[0].flags, frame.flags);
    }
    accepted += expected ? 1 : 0;
  }
  if (GetParam().filters.empty()) {
    EXPECT_EQ(accepted, 0u);
  } else {
    EXPECT_GT(accepted, kFrames / 20);  // the test is worth something
  }
}

// `count` exact identifiers.
Filters exact(unsigned count, verican_select_t ide, verican_select_t rtr, std::uint32_t mask) {
  Filters filters;
  for (unsigned k = 0; k < count; ++k) {
    const std::uint32_t id = ide == kExt ? 0x1234567 + k * 0x10F051 : 0x101 + k * 11;
    filters.push_back({id & mask, mask, ide, rtr});
  }
  return filters;
}

const Filters kMixed{{0x123, 0x7FF, kStd, kData},
                     {0x400, 0x700, kStd, kBoth},
                     {0x12345678, 0x1FFFFFFF, kExt, kRemote},
                     {0x0ABC0000, 0x1FFF0000, kExt, kBoth},
                     {0x550, 0x7F0, kBoth, kBoth}};
const Filters kMixedB{{0x123, 0x7FF, kStd, kData},
                      {0x400, 0x700, kStd, kBoth},
                      {0x12348000, 0x1FFF8000, kExt, kRemote},
                      {0x0ABC0000, 0x1FFC0000, kExt, kBoth},
                      {0x550, 0x7F0, kBoth, kBoth}};
const Filters kMixedC{{0x120, 0x7F8, kBoth, kBoth}, {0x400, 0x700, kBoth, kBoth}};
const Filters kAll{{0, 0, kBoth, kBoth}};

constexpr auto kMb = VERICAN_RX_MAILBOXES;
constexpr auto kFifo = VERICAN_RX_FIFO;
constexpr auto kA = VERICAN_FIFO_FORMAT_A;
constexpr auto kB = VERICAN_FIFO_FORMAT_B;
constexpr auto kC = VERICAN_FIFO_FORMAT_C;

INSTANTIATE_TEST_SUITE_P(
    Sets, DriverFilters,
    ::testing::Values(Case{"MailboxesAll", kMb, kA, kAll}, Case{"MailboxesNone", kMb, kA, {}},
                      Case{"MailboxesMixed", kMb, kA, kMixed},
                      Case{"MailboxesMany", kMb, kA, exact(50, kStd, kData, 0x7FF)},
                      Case{"FormatAAll", kFifo, kA, kAll}, Case{"FormatANone", kFifo, kA, {}},
                      Case{"FormatAMixed", kFifo, kA, kMixed},
                      Case{"FormatABlocks", kFifo, kA, exact(100, kExt, kData, 0x1FFFFFFF)},
                      Case{"FormatBAll", kFifo, kB, kAll}, Case{"FormatBMixed", kFifo, kB, kMixedB},
                      Case{"FormatBBlocks", kFifo, kB, exact(61, kStd, kData, 0x7FF)},
                      Case{"FormatCAll", kFifo, kC, kAll}, Case{"FormatCMixed", kFifo, kC, kMixedC},
                      Case{"FormatCBlocks", kFifo, kC, exact(70, kBoth, kBoth, 0x7F8)}),
    [](const auto &set) { return set.param.name; });

// ---- What does not fit

class DriverFilterLimits : public ::testing::Test {
 protected:
  verican_result_t set(const Filters &filters) {
    return verican_set_filters(&dev_, filters.data(), static_cast<std::uint16_t>(filters.size()));
  }
  void fifo(verican_fifo_format_t format, unsigned num_mb = 64) {
    config_.rx_mode = kFifo;
    config_.fifo_format = format;
    core_.word(VERICAN_XCONFIG_OFFSET) = num_mb;
    ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
  }

  FakeCore core_;
  verican_config_t config_ = core_.config();
  verican_t dev_{};
};

TEST_F(DriverFilterLimits, OneMailboxEach) {
  ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
  EXPECT_EQ(set(exact(56, kStd, kData, 0x7FF)), VERICAN_OK);
  EXPECT_EQ(set(exact(57, kStd, kData, 0x7FF)), VERICAN_ERR_SPACE);
}

TEST_F(DriverFilterLimits, WithoutCtrl2AFilterForBothFormatsTakesTwoAndRemoteFramesAreOut) {
  core_.lossy = VERICAN_CTRL2_OFFSET;
  core_.lost_bits = ~0u;
  ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
  EXPECT_EQ(set(exact(28, kBoth, kData, 0x7FF)), VERICAN_OK);
  EXPECT_EQ(set(exact(29, kBoth, kData, 0x7FF)), VERICAN_ERR_SPACE);
  EXPECT_EQ(set({{0, 0, kStd, kRemote}}), VERICAN_ERR_UNSUPPORTED);
  // Formats take turns in the mailboxes.
  ASSERT_EQ(set(kAll), VERICAN_OK);
  for (unsigned mb = 0; mb < 56; ++mb)
    EXPECT_EQ(core_.word(VERICAN_MB_CS_OFFSET(mb)), mb % 2 == 0 ? 0x04000000u : 0x04200000u) << mb;
}

// However few mailboxes there are beyond those that the filters need.
TEST_F(DriverFilterLimits, WithoutCtrl2AFilterForBothFormatsHasBothFirst) {
  core_.lossy = VERICAN_CTRL2_OFFSET;
  core_.lost_bits = ~0u;
  for (const unsigned room : {3u, 5u}) {
    config_.tx_mailboxes = static_cast<std::uint8_t>(64 - room);
    ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
    ASSERT_EQ(set({{0x100, 0x7FF, kStd, kBoth}, {0x200, 0x7FF, kBoth, kBoth}}), VERICAN_OK);
    for (unsigned mb = 0; mb < room; ++mb) {
      const unsigned turn = mb % 3;  // one mailbox for the first filter, then two
      EXPECT_EQ(core_.word(VERICAN_MB_ID_OFFSET(mb)) >> 18, turn == 0 ? 0x100u : 0x200u) << mb;
      EXPECT_EQ(core_.word(VERICAN_MB_CS_OFFSET(mb)), turn == 2 ? 0x04200000u : 0x04000000u) << mb;
    }
  }
}

TEST_F(DriverFilterLimits, FormatsThatCannotSayIt) {
  fifo(kB);
  EXPECT_EQ(set({{0, 0x1FFFFFFF, kExt, kData}}), VERICAN_ERR_RANGE) << "15 low bits";
  EXPECT_EQ(set({{0, 0x1FFF8000, kExt, kData}}), VERICAN_OK);
  fifo(kC);
  EXPECT_EQ(set({{0, 0x7FF, kBoth, kBoth}}), VERICAN_ERR_RANGE) << "3 low bits";
  EXPECT_EQ(set({{0, 0x7F8, kStd, kBoth}}), VERICAN_ERR_RANGE) << "format";
  EXPECT_EQ(set({{0, 0x7F8, kBoth, kData}}), VERICAN_ERR_RANGE) << "kind";
  EXPECT_EQ(set({{0, 0x7F8, kBoth, kBoth}}), VERICAN_OK);
}

TEST_F(DriverFilterLimits, SizeOfTheTable) {  // FX-CTRL2.RFFN, FX-4.a
  fifo(kA);
  EXPECT_EQ(set(exact(8, kStd, kData, 0x7FF)), VERICAN_OK);
  EXPECT_EQ(core_.word(VERICAN_CTRL2_OFFSET) >> 24, 0u);
  EXPECT_EQ(set(exact(9, kStd, kData, 0x7FF)), VERICAN_OK);
  EXPECT_EQ(core_.word(VERICAN_CTRL2_OFFSET) >> 24, 1u);
  EXPECT_EQ(set(exact(128, kExt, kData, 0x1FFFFFFF)), VERICAN_OK);
  EXPECT_EQ(core_.word(VERICAN_CTRL2_OFFSET) >> 24, 15u);
  EXPECT_EQ(set(exact(129, kExt, kData, 0x1FFFFFFF)), VERICAN_ERR_SPACE);
  // Eleven masks need three blocks: one has 8 of them, two have 10, three 12.
  EXPECT_EQ(set(exact(11, kStd, kBoth, 0x7F0)), VERICAN_OK);
  EXPECT_EQ(core_.word(VERICAN_CTRL2_OFFSET) >> 24, 2u);
  // 32 words have masks of their own, others must be exact.
  EXPECT_EQ(set(exact(32, kStd, kBoth, 0x7F0)), VERICAN_OK);
  EXPECT_EQ(set(exact(33, kStd, kBoth, 0x7F0)), VERICAN_ERR_SPACE);
  fifo(kA, 16);  // mailboxes 8.. transmit: no room for more than eight words
  EXPECT_EQ(set(exact(8, kStd, kData, 0x7FF)), VERICAN_OK);
  EXPECT_EQ(set(exact(9, kStd, kData, 0x7FF)), VERICAN_ERR_SPACE);
}

// PK-42: a core that does not keep MCR.BCC has one mask for the whole table, RXFGMASK.
TEST_F(DriverFilterLimits, WithoutOwnMasksAllFiltersOfTheTableHaveTheSame) {
  core_.mcr_never = VERICAN_MCR_BCC_MASK;
  fifo(kA);
  EXPECT_EQ(set({{0x120, 0x7F0, kStd, kData}, {0x340, 0x7FF, kStd, kData}}),
            VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(set({{0x120, 0x7F0, kStd, kData}, {0x340, 0x7F0, kStd, kBoth}}),
            VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(set({{0x120, 0x7F0, kStd, kData}, {0x340, 0x7F0, kStd, kData}}), VERICAN_OK);
  // Format A: bits 31 and 30 kind and format, 29:19 a base identifier (flexcan.md, filter element).
  EXPECT_EQ(core_.word(VERICAN_RXFGMASK_OFFSET), 0xC0000000u | 0x7F0u << 19);
  EXPECT_EQ(core_.word(VERICAN_RXIMR_OFFSET(0)), 0u);
}

}  // namespace
}  // namespace vericansim
