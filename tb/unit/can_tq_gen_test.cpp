// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_tq_gen alone: every quantum has as many clocks as the prescaler says.
#include <gtest/gtest.h>

#include "Vcan_tq_gen.h"
#include "Vcan_tq_gen___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class CanTqGen : public testing::Test {
 protected:
  /// Reset, then a stopped clock with the prescaler in place, as the core does.
  void start(unsigned prescaler) {
    tq_->run_i = 0;
    tq_->presdiv_i = prescaler - 1;
    tq_.reset();
    tq_.clock();
    tq_->run_i = 1;
    tq_.settle();
  }
  /// Clocks of the quantum that begins now; 0 if it does not end within 1000.
  unsigned quantum() {
    for (unsigned clocks = 1; clocks <= 1000; ++clocks) {
      const bool last = tq_->tq_o != 0;
      tq_.clock();
      if (last) return clocks;
    }
    return 0;
  }
  LeafModel<Vcan_tq_gen> tq_;
};

// BT-01, BT-02, BT-04: prescaler 1 to 256, the first quantum after the start included.
TEST_F(CanTqGen, EveryQuantumHasPrescalerClocks) {
  for (unsigned prescaler = 1; prescaler <= 256; ++prescaler) {
    start(prescaler);
    for (int i = 0; i < 4; ++i) ASSERT_EQ(quantum(), prescaler) << "quantum " << i;
  }
}

// BT-05: stopping within a quantum and starting again gives a whole one.
TEST_F(CanTqGen, QuantumAfterAStopIsWhole) {
  for (unsigned stop_after = 0; stop_after < 9; ++stop_after) {
    start(5);
    for (unsigned i = 0; i < stop_after; ++i) tq_.clock();
    tq_->run_i = 0;
    tq_.clock();
    tq_.clock();
    tq_->run_i = 1;
    tq_.settle();
    EXPECT_EQ(quantum(), 5u) << "stopped after " << stop_after << " clocks";
    EXPECT_EQ(quantum(), 5u);
  }
}

// BT-01: a count that is beyond the prescaler, as an upset flip-flop makes it (here: a prescaler
// that shrinks), ends the quantum at once, and the next one is whole.
TEST_F(CanTqGen, CountBeyondThePrescalerEndsTheQuantum) {
  for (const unsigned prescaler : {1u, 2u, 5u, 100u}) {
    start(256);
    for (unsigned i = 0; i < 150; ++i) tq_.clock();
    tq_->presdiv_i = prescaler - 1;
    tq_.settle();
    EXPECT_LE(quantum(), 2u) << prescaler;
    EXPECT_EQ(quantum(), prescaler);
  }
}

}  // namespace
}  // namespace vericansim
