// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_rate alone: the search for the bit rate, RN-73. On buses: rtl_rate_test.
#include <gtest/gtest.h>

#include "Vcan_rn_rate.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kRows = 8;
constexpr unsigned kSearch = 15;  // a row that the table has not
constexpr unsigned kEdges = 256;  // so many without a valid frame are no right rate

class CanRnRate : public testing::Test {
 protected:
  CanRnRate() {
    rate_->level_i = 1;
    rate_.reset();
    rate_->rate_i = kSearch;
  }
  void begin() {
    rate_->start_i = 1;
    rate_.clock();
  }
  void pulse(CData &pin) {
    pin = 1;
    rate_.clock();
    pin = 0;
    rate_.clock();
  }
  void error() { pulse(rate_->error_i); }
  void valid() { pulse(rate_->valid_i); }
  void sample_point() {
    rate_->tick_i = 1;
    rate_.clock();
    rate_->tick_i = 0;
  }
  /// A dominant bit between recessive ones, each with a sample point or none.
  void dominant_bit(bool sampled) {
    for (const int level : {0, 1}) {
      rate_->level_i = level;
      rate_.clock();
      if (sampled) sample_point();
    }
  }
  void edges(unsigned count) {
    for (unsigned i = 0; i < count; ++i) dominant_bit(true);
  }
  [[nodiscard]] unsigned row() {
    rate_.settle();
    return rate_->row_o;
  }
  LeafModel<Vcan_rn_rate> rate_;
};

// A row of the table is taken as it is.
TEST_F(CanRnRate, AGivenRowNeedsNoSearch) {
  for (unsigned given = 0; given < kRows; ++given) {
    rate_->rate_i = given;
    rate_->start_i = 0;
    rate_.clock();
    EXPECT_EQ(rate_->start_o, 0) << given;
    begin();
    EXPECT_EQ(rate_->start_o, 1) << given;
    EXPECT_EQ(rate_->listen_o, 0) << given;
    EXPECT_EQ(row(), given);
  }
}

// RN-70: INIT until user logic has set up the RAM, LISTEN behind it.
TEST_F(CanRnRate, ListensOnlyWhenTheRamIsSetUp) {
  for (unsigned given = kRows; given <= kSearch; ++given) {
    rate_.reset();
    rate_->rate_i = given;
    rate_->start_i = 0;
    for (int clocks = 0; clocks < 10; ++clocks) {
      rate_.clock();
      EXPECT_EQ(rate_->listen_o, 0) << given;
    }
    begin();
    EXPECT_EQ(rate_->listen_o, 1) << given;
    EXPECT_EQ(rate_->run_o, 1) << given;
    EXPECT_EQ(rate_->start_o, 0) << given;
    EXPECT_EQ(row(), 0U) << given;
  }
}

// RN-73: two errors without a valid frame; the rates in turn, the engine stopped in between.
TEST_F(CanRnRate, TwoErrorsAreTheNextRate) {
  begin();
  for (unsigned rate = 0; rate < 2 * kRows; ++rate) {
    EXPECT_EQ(row(), rate % kRows);
    error();
    EXPECT_EQ(row(), rate % kRows);
    EXPECT_EQ(rate_->run_o, 1);
    rate_->error_i = 1;
    rate_.clock();
    EXPECT_EQ(rate_->run_o, 0);
    rate_->error_i = 0;
    rate_.clock();
    EXPECT_EQ(rate_->run_o, 1);
  }
}

// RN-73: a valid frame takes an error back.
TEST_F(CanRnRate, AValidFrameBetweenErrorsKeepsTheRate) {
  begin();
  error();
  valid();
  error();
  EXPECT_EQ(row(), 0U);
  EXPECT_EQ(rate_->start_o, 0);
  error();
  EXPECT_EQ(row(), 1U);
}

// RN-73: two valid frames at the same rate; then it is kept until the node has been on the bus.
TEST_F(CanRnRate, TwoValidFramesAreTheRightRate) {
  begin();
  valid();
  error();
  error();
  EXPECT_EQ(row(), 1U);
  valid();
  EXPECT_EQ(rate_->start_o, 0);  // the first was at another rate
  EXPECT_EQ(rate_->listen_o, 1);
  valid();
  EXPECT_EQ(rate_->start_o, 1);
  EXPECT_EQ(rate_->listen_o, 0);
  error();
  error();
  EXPECT_EQ(row(), 1U);
  rate_->run_i = 1;
  rate_.clock();
  error();
  error();
  EXPECT_EQ(row(), 1U);
  EXPECT_EQ(rate_->listen_o, 0);
}

// RN-73: edges without a sample point between them are closer than two bits, an error.
TEST_F(CanRnRate, EdgesWithoutASamplePointAreErrors) {
  begin();
  dominant_bit(false);
  dominant_bit(false);  // one error
  EXPECT_EQ(row(), 0U);
  dominant_bit(true);  // two
  EXPECT_EQ(row(), 1U);
  edges(20);
  EXPECT_EQ(row(), 1U);
}

// RN-73: so many edges without a valid frame are no right rate; the count begins anew with the rate
// and with a valid frame.
TEST_F(CanRnRate, EdgesWithoutAFrameAreTheNextRate) {
  begin();
  for (unsigned rate = 0; rate < 3; ++rate) {
    edges(kEdges - 1);
    EXPECT_EQ(row(), rate);
    edges(1);
    EXPECT_EQ(row(), rate + 1);
  }
  edges(kEdges - 1);
  valid();
  edges(kEdges - 1);
  EXPECT_EQ(row(), 3U);
  edges(1);
  EXPECT_EQ(row(), 4U);
}

// Nothing that was before the search counts.
TEST_F(CanRnRate, ADominantBusAtResetIsNoEdgeTooMany) {
  rate_->start_i = 1;
  rate_->level_i = 1;
  rate_->rst_ni = 0;
  rate_.clock();
  rate_->rst_ni = 1;
  rate_->level_i = 0;
  rate_.clock();
  EXPECT_EQ(rate_->listen_o, 1);
  EXPECT_EQ(rate_->run_o, 1);
  EXPECT_EQ(row(), 0U);
}

}  // namespace
}  // namespace vericansim
