// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_filter: the element found, the rows it reads and the clocks it takes, for random tables
// (flexcan.md section 4).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>

#include "Vcan_mb_filter.h"
#include "Vcan_mb_filter___024root.h"
#include "mailbox/rx_fifo_rig.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBuffers = 64, kRxfgmaskRow = kBuffers + 3;

class MbFilter : public ::testing::TestWithParam<unsigned> {  // format
 protected:
  MbFilter() {
    top_.reset();
    top_->idam_i = GetParam();
  }

  std::uint32_t random() { return static_cast<std::uint32_t>(rng_()); }

  void configure(unsigned rffn, bool bcc) {
    top_->rffn_i = rffn;
    top_->bcc_i = bcc;
    top_->first_i = 8 + 2 * rffn;
    words_ = 8 * (rffn + 1);
    own_ = bcc ? std::min(8 + 2 * rffn, 32u) : 0;
  }

  /// Mostly words and masks far from the frame; identifiers differ in few bits.
  void fill() {
    const unsigned density = random() % 16;
    for (auto &word : table_) {
      word = random() % 16 < density ? 0x24924924u ^ (1u << (random() % 32)) : ~0x24924924u;
    }
    for (auto &mask : masks_) mask = random() | random() | random() | random();
  }

  Frame random_frame() {
    Frame frame;
    frame.extended = random() % 2 == 0;
    frame.remote = random() % 2 == 0;
    frame.id = (0x12492492u ^ (1u << (random() % 29))) >> (frame.extended ? 0 : 18);
    return frame;
  }

  /// Clocks until the filter is done.
  unsigned run(const Frame &frame, unsigned refuse) {
    top_->start_i = 1;
    top_->gnt_i = 0;
    top_.clock();
    top_->start_i = 0;
    top_->id_i = frame.extended ? frame.id : frame.id << 18;
    top_->ide_i = frame.extended;
    top_->rtr_i = frame.remote;
    unsigned clocks = 0;
    for (top_.settle(); top_->busy_o != 0 && clocks < 2000; ++clocks) {
      top_->gnt_i = top_->req_o != 0 && random() % 4 >= refuse;
      const unsigned k = 4 * (top_->idx_o - 6) + top_->word_o, row = top_->mask_row_o;
      const bool granted = top_->gnt_i != 0;
      EXPECT_TRUE(!granted || row == (k < own_ ? k : kRxfgmaskRow)) << "word " << k;
      top_.clock();
      if (granted && k < table_.size()) {
        top_->data_i = table_[k];
        top_->mask_i = masks_[row];
      }
      top_.settle();
    }
    return clocks;
  }

  std::optional<unsigned> expected(const Frame &frame) const {
    static constexpr unsigned kElements[] = {1, 2, 4, 1};
    for (unsigned k = 0; k < words_; ++k) {
      const FilterWord filter{table_[k], masks_[k < own_ ? k : kRxfgmaskRow]};
      if (const auto element = filter_element(GetParam(), filter, frame))
        return kElements[GetParam()] * k + *element;
    }
    return std::nullopt;
  }

  unsigned words_ = 8, own_ = 8;
  std::array<std::uint32_t, 128> table_{};
  std::array<std::uint32_t, 2 * kBuffers> masks_{};
  std::mt19937 rng_{5};
  LeafModel<Vcan_mb_filter> top_;
};

// FX-4.d, FX-4.e, FX-4.f, FX-4.g, FX-4.h, FX-4.i
TEST_P(MbFilter, FindsTheFirstElementThatFits) {
  unsigned hits = 0;
  for (unsigned round = 0; round < 2000; ++round) {
    configure(round % 16, random() % 2 == 0);
    fill();
    const Frame frame = random_frame();
    run(frame, random() % 3);
    const auto element = expected(frame);
    ASSERT_EQ(top_->hit_o != 0, element.has_value()) << "round " << round;
    if (!element) continue;
    ASSERT_EQ(top_->idhit_o, *element) << "round " << round;
    ++hits;
  }
  EXPECT_EQ(hits > 200, GetParam() != 3) << hits;
  EXPECT_LT(hits, 1900u);
}

TEST_P(MbFilter, TakesOneClockForEachWordAndTwoMore) {  // FX-CTRL2.RFFN
  table_.fill(0);
  masks_.fill(0xFFFFFFFF);
  Frame frame;
  frame.id = 0x7FF;
  for (unsigned rffn = 0; rffn < 16; ++rffn) {
    configure(rffn, true);
    EXPECT_EQ(run(frame, 0), 8 * (rffn + 1) + 2);
    EXPECT_FALSE(top_->hit_o);
  }
}

TEST_P(MbFilter, ForgetsTheLastFrame) {
  configure(0, true);
  masks_.fill(0);
  run(random_frame(), 0);
  EXPECT_EQ(top_->hit_o != 0, GetParam() != 3);
  masks_.fill(0xFFFFFFFF);
  table_.fill(0);
  Frame frame;
  frame.id = 0x7FF;
  run(frame, 0);
  EXPECT_FALSE(top_->hit_o);
}

INSTANTIATE_TEST_SUITE_P(Format, MbFilter, ::testing::Range(0u, 4u),
                         [](const auto &test) { return std::string(1, "ABCD"[test.param]); });

}  // namespace
}  // namespace vericansim
