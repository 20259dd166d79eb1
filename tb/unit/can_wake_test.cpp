// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_wake alone: which levels wake the core, clock by clock (flexcan.md 2.9; MO-14).
#include <gtest/gtest.h>

#include <string>

#include "Vcan_wake.h"
#include "Vcan_wake___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kFilter = 6;  // default of FilterClocks

class CanWake : public testing::Test {
 protected:
  void SetUp() override {
    wake_->rx_i = 1;
    wake_->enable_i = 0;
    wake_.reset();
    wake_->enable_i = 1;
  }
  // Clocks with the levels of `line` ('0' is dominant); the index of the first pulse, or -1.
  int wakes_at(const std::string &line) {
    int at = -1;
    for (unsigned i = 0; i < line.size(); ++i) {
      wake_->rx_i = line[i] == '1';
      wake_.settle();
      if (wake_->wake_o && at < 0) at = static_cast<int>(i);
      pulses_ += wake_->wake_o;
      wake_.clock();
    }
    return at;
  }
  LeafModel<Vcan_wake> wake_;
  unsigned pulses_ = 0;
};

// FX-2.9.a: any edge, however short.
TEST_F(CanWake, AnyEdgeWakesWithoutTheFilter) {
  EXPECT_EQ(wakes_at("1101"), 2);
  EXPECT_EQ(pulses_, 1u);
}

// FX-2.9.a: an edge, not a level; a bus that is dominant from the start has to be recessive first.
TEST_F(CanWake, DominantFromTheStartDoesNotWake) {
  for (const bool filter : {false, true}) {
    SetUp();
    wake_->filter_i = filter;
    EXPECT_EQ(wakes_at("00000000000000000000"), -1);
    EXPECT_EQ(wakes_at("100000000000"), filter ? static_cast<int>(kFilter) : 1);
  }
}

// FX-MCR.WAK_SRC: the filtered line needs kFilter dominant clocks in a row.
TEST_F(CanWake, TheFilterStopsShortPulses) {
  wake_->filter_i = 1;
  for (unsigned length = 1; length < kFilter; ++length)
    EXPECT_EQ(wakes_at("1" + std::string(length, '0') + "1"), -1) << length;
  EXPECT_EQ(wakes_at("1" + std::string(kFilter, '0') + "1"), static_cast<int>(kFilter));
}

TEST_F(CanWake, ARecessiveClockRestartsTheFilter) {
  wake_->filter_i = 1;
  EXPECT_EQ(wakes_at("1000001000001000000"), 18);
}

TEST_F(CanWake, OnePulseAWake) {
  for (const bool filter : {false, true}) {
    SetUp();
    pulses_ = 0;
    wake_->filter_i = filter;
    wakes_at("11" + std::string(40, '0'));
    EXPECT_EQ(pulses_, 1u);
  }
}

// FX-2.9.a: only in stop mode with SLF_WAK; what was seen before does not count.
TEST_F(CanWake, NothingWhileNotEnabled) {
  wake_->enable_i = 0;
  EXPECT_EQ(wakes_at("1100011100"), -1);
  wake_->enable_i = 1;
  EXPECT_EQ(wakes_at("0000"), -1);
  EXPECT_EQ(wakes_at("10"), 1);
}

}  // namespace
}  // namespace vericansim
