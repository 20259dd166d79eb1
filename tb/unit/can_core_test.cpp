// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_core alone: what it tells the buffers and others only if they ask for it.
#include <gtest/gtest.h>

#include <array>

#include "Vcan_core.h"
#include "bus/trace.hpp"
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
  /// What the core tells in single clocks of a frame that goes well.
  [[nodiscard]] std::array<bool, 7> pulses() {
    return {core_->start_o != 0,  core_->stamp_o != 0,      core_->tx_next_o != 0,
            core_->rx_hdr_o != 0, core_->rx_byte_we_o != 0, core_->rx_valid_o != 0,
            core_->tx_ok_o != 0};
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

// A node that stands is not in step, although its field is still that of the bit before.
TEST_F(CanCore, IsInStepOnlyWhileItRuns) {  // FX-ESR1.SYNCH
  for (unsigned phase = 0; phase < 10; ++phase) {
    core_.reset();
    core_->run_i = 1;
    for (unsigned i = 0; i < 200 + phase; ++i) core_.clock();
    ASSERT_TRUE(core_->synch_o) << phase;
    core_->run_i = 0;
    core_.clock();
    ASSERT_FALSE(core_->running_o) << phase;
    EXPECT_FALSE(core_->synch_o) << phase;
  }
}

// FX-6.b: TIMER stands with the engine, in whichever clock of a bit that is told to stop.
TEST_F(CanCore, TimerStandsWhenTheEngineDoes) {
  unsigned stops = 0;
  for (unsigned phase = 0; phase < 30; ++phase) {
    core_.reset();
    core_->run_i = 1;
    for (unsigned i = 0; i < 100 + phase; ++i) core_.clock();
    core_->run_i = 0;
    core_.clock();
    ASSERT_FALSE(core_->running_o);
    const unsigned stopped_at = core_->timer_o;
    EXPECT_NEAR(stopped_at, (100 + phase) / 10, 1) << phase;
    for (unsigned i = 0; i < 30; ++i) core_.clock();
    EXPECT_EQ(core_->timer_o, stopped_at) << phase;
    ++stops;
  }
  EXPECT_EQ(stops, 30u);
}

// From the reset on, without a clock: the node is off the bus.
TEST_F(CanCore, ResetStopsTheEngine) {
  for (unsigned i = 0; i < 200; ++i) core_.clock();
  ASSERT_TRUE(core_->running_o);
  core_->run_i = core_->rst_ni = 0;
  core_.settle();
  EXPECT_FALSE(core_->running_o);
  EXPECT_FALSE(core_->synch_o);
}

// A hard reset in the very clock of a pulse ends it: the engine stands then, and a pulse that
// stayed would last until it runs again. In loop-back mode (MO-04) one frame gives them all.
TEST_F(CanCore, ResetEndsEveryPulse) {
  constexpr unsigned kFrame = 1000;  // clocks: 11 bits of integration, a frame with one byte
  for (unsigned kind = 0; kind < pulses().size(); ++kind) {
    core_->lpb_i = core_->run_i = core_->tx_req_i = 1;
    core_->tx_dlc_i = 1;
    unsigned waited = 0;
    for (; waited < kFrame && !pulses()[kind]; ++waited) core_.clock();
    ASSERT_LT(waited, kFrame) << "pulse " << kind << " never came";
    core_.reset();
    EXPECT_EQ(pulses(), (std::array<bool, 7>{})) << "pulse " << kind;
  }
}

}  // namespace
}  // namespace vericansim
