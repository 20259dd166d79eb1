// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_core alone: what it tells the buffers and others only if they ask for it.
#include <gtest/gtest.h>

#include "Vcan_core.h"
#include "node/trace.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class CanCore : public ::testing::Test {
 protected:
  CanCore() {
    core_->can_rx_i = 1;
    core_->propseg_i = core_->pseg1_i = core_->pseg2_i = 2;
    core_.reset();
    core_->run_i = 1;
  }
  LeafModel<Vcan_core> core_;
};

// A presented frame may be replaced only where the engine cannot be about to take it, AR-13.
TEST_F(CanCore, TicksAreSamplePointsThatAreAskedFor) {
  unsigned ticks = 0;
  for (unsigned i = 0; i < 400; ++i) {
    core_->tick_req_i = i < 200;
    core_.settle();
    ASSERT_EQ(core_->tick_o != 0, i < 200 && decode_trace(core_->trace_o).sample) << i;
    ticks += core_->tick_o;
    core_.clock();
  }
  EXPECT_EQ(ticks, 20u);
}

TEST_F(CanCore, LevelOfTheBusIsRecessiveUnlessAskedFor) {  // FX-2.9.a
  core_->can_rx_i = 0;
  for (unsigned i = 0; i < 4; ++i) core_.clock();
  EXPECT_TRUE(core_->rx_level_o);
  core_->rx_req_i = 1;
  core_.settle();
  EXPECT_FALSE(core_->rx_level_o);
}

}  // namespace
}  // namespace vericansim
