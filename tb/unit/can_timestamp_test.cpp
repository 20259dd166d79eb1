// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_timestamp alone: what wins when clear, write and count meet (flexcan.md 2.10, section 6).
#include <gtest/gtest.h>

#include "Vcan_timestamp.h"
#include "Vcan_timestamp___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

struct Event {
  bool clear = false, write = false, sample = false;
  unsigned lanes = 3;
};

class CanTimestamp : public testing::Test {
 protected:
  void SetUp() override {
    timer_.reset();
    timer_->wdata_i = 0x1234;
  }
  unsigned after(const Event &event) {
    timer_->clear_i = event.clear;
    timer_->we_i = event.write;
    timer_->be_i = event.lanes;
    timer_->sample_i = event.sample;
    timer_.clock();
    return timer_->timer_o;
  }
  LeafModel<Vcan_timestamp> timer_;
};

// FX-6.a
TEST_F(CanTimestamp, CountsBitsAndWraps) {
  EXPECT_EQ(timer_->timer_o, 0u);
  for (unsigned i = 1; i <= 0x10000; ++i) {
    ASSERT_EQ(after({}), (i - 1) & 0xFFFF);
    ASSERT_EQ(after({.sample = true}), i & 0xFFFF);
  }
}

// FX-2.10.a: a write in the clock of the clear is discarded; FX-6.b: it beats the count.
TEST_F(CanTimestamp, ClearBeatsWriteBeatsCount) {
  for (const bool sample : {false, true}) {
    EXPECT_EQ(after({.write = true, .sample = sample}), 0x1234u);
    EXPECT_EQ(after({.clear = true, .write = true, .sample = sample}), 0u);
    after({.write = true});
    EXPECT_EQ(after({.clear = true, .sample = sample}), 0u);
  }
}

TEST_F(CanTimestamp, WritesByByte) {
  EXPECT_EQ(after({.write = true, .lanes = 1}), 0x0034u);
  EXPECT_EQ(after({.write = true, .lanes = 2}), 0x1234u);
  EXPECT_EQ(after({.write = true, .lanes = 0}), 0x1234u);
  timer_->wdata_i = 0xABCD;
  EXPECT_EQ(after({.write = true, .lanes = 2}), 0xAB34u);
  EXPECT_EQ(after({.write = true, .lanes = 0}), 0xAB34u);
}

}  // namespace
}  // namespace vericansim
