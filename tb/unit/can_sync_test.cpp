// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_sync alone: the pin arrives after two clocks, and reads recessive during reset.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "Vcan_sync.h"
#include "Vcan_sync___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

// BT-06: a constant delay of two clocks, no level lost, none invented.
TEST(CanSync, EveryLevelArrivesTwoClocksLater) {
  LeafModel<Vcan_sync> sync;
  sync->can_rx_i = 1;
  sync.reset();
  std::mt19937 rng{1};
  std::vector<unsigned> pin{1, 1};
  for (int i = 0; i < 1000; ++i) {
    sync->can_rx_i = rng() & 1;
    pin.push_back(sync->can_rx_i);
    sync.clock();
    ASSERT_EQ(sync->rx_o, pin[pin.size() - 2]);
  }
}

// IF-17: a dominant pin is not seen while the reset lasts.
TEST(CanSync, ResetShowsRecessive) {
  LeafModel<Vcan_sync> sync;
  sync->can_rx_i = 0;
  sync->rst_ni = 0;
  for (int i = 0; i < 4; ++i) {
    sync.clock();
    EXPECT_EQ(sync->rx_o, 1);
  }
  sync->rst_ni = 1;
  sync.clock();
  EXPECT_EQ(sync->rx_o, 1);
  sync.clock();
  EXPECT_EQ(sync->rx_o, 0);
}

}  // namespace
}  // namespace vericansim
