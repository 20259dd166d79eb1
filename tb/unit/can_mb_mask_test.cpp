// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_mask alone (flexcan.md 3.5): what is compared is compared under the mask that it asks for,
// whoever else takes read slots meanwhile.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <random>

#include "Vcan_mb_mask.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr std::array<std::uint32_t, 4> kMasks{0x1FFC0000, 0x000ABCDE, 0xDFFFFFFF, 0x00F00F00};

class MbMask : public ::testing::TestWithParam<unsigned> {
 protected:
  MbMask() {
    mask_->clear_i = mask_->req_i = mask_->gnt_i = mask_->all_i = 0;
    mask_.reset();
  }
  /// One clock; a slot that is wanted is had, or not. Whether it was one for the comparison.
  bool clock(bool slot) {
    mask_.settle();
    mask_->gnt_i = slot && mask_->req_o;
    mask_.settle();
    const bool load = mask_->gnt_i && mask_->load_o, compared = mask_->gnt_o;
    loads_ += load;
    const unsigned row = mask_->want_i;
    mask_.clock();
    // What is read is there for a clock.
    mask_->msg_i = load ? kMasks[row] : static_cast<std::uint32_t>(random_());
    mask_.settle();
    return compared;
  }
  unsigned loads_ = 0;  ///< slots in which a mask was read
  std::mt19937 random_{GetParam()};
  LeafModel<Vcan_mb_mask> mask_;
};

TEST_P(MbMask, IsTheOneThatIsAskedFor) {  // FX-3.5.k
  unsigned compared = 0;
  for (unsigned i = 0; i < 20'000; ++i) {
    mask_->req_i = random_() % 4 != 0;
    if (random_() % 8 == 0) mask_->want_i = random_() % 4;
    mask_->clear_i = random_() % 50 == 0;
    if (mask_->clear_i) mask_->all_i = random_() % 4 == 0;  // of a frame
    const bool all = mask_->all_i, cleared = mask_->clear_i;
    const unsigned want = mask_->want_i;
    if (!clock(random_() % 3 != 0) || cleared) continue;
    ++compared;
    ASSERT_EQ(mask_->mask_o, all ? 0xFFFFFFFF : kMasks[want]) << i;
  }
  EXPECT_GT(compared, 2'000u);
}

// A frame reads its masks anew: they may have been written since the one before.
TEST_P(MbMask, IsReadAnewForEachFrame) {  // FX-3.5.k
  mask_->req_i = 1;
  for (unsigned frame = 0; frame < 3; ++frame) {
    mask_->clear_i = 1;
    clock(false);
    mask_->clear_i = 0;
    unsigned clocks = 0;
    while (!clock(true)) ASSERT_LT(++clocks, 5u);
    EXPECT_EQ(clocks, 2u);
    EXPECT_TRUE(clock(true)) << "the mask stays";
  }
}

// A mask takes one read slot, and none while it is in use, so that the slots of a match can be
// counted (docs/architecture.md). That another one would be wanted, as when the match goes back to
// the buffer before, does not end its use.
TEST_P(MbMask, IsReadOnceForAsLongAsItIsUsed) {  // FX-3.5.k
  mask_->clear_i = 1;
  clock(false);
  std::optional<unsigned> in_use;
  for (unsigned i = 0; i < 20'000; ++i) {
    mask_->req_i = random_() % 4 != 0;
    if (random_() % 4 == 0) mask_->want_i = random_() % 4;
    mask_->clear_i = random_() % 50 == 0;
    const unsigned before = loads_, want = mask_->want_i;
    clock(mask_->clear_i == 0 && random_() % 3 != 0);
    if (mask_->clear_i != 0) in_use.reset();
    if (loads_ == before) continue;
    ASSERT_NE(in_use, want) << i;
    in_use = want;
  }
  EXPECT_GT(loads_, 1'000u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MbMask, ::testing::Values(1u, 2u, 3u));

}  // namespace
}  // namespace vericansim
