// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mode alone: every state with every request, and the way out of codes that are no state
// (flexcan.md section 2, ERR008341).
#include <gtest/gtest.h>

#include "Vcan_mode.h"
#include "Vcan_mode___024root.h"
#include "unit/leaf_model.hpp"

// Verilator's own (5.006): evaluates all logic that is not clocked. A register that a test
// overwrites is nothing that eval() looks at.
void Vcan_mode___024root___eval_settle(Vcan_mode___024root *root);

namespace vericansim {
namespace {

// What software and the system can see.
enum Mode { kDisabled, kFrozen, kRunning, kHalting, kResetting, kStopped };

/// Overwrites the state as upset flip-flops do. Not in a netlist of cells, which has no variable
/// for it: false. (tb/netlist/equal.py proves that such a netlist is equal in every state.)
template <typename Root>
bool upset(Root *root, unsigned state) {
  if constexpr (requires { root->can_mode__DOT__state_q; }) {
    root->can_mode__DOT__state_q = state;
    Vcan_mode___024root___eval_settle(root);
    return true;
  } else {
    static_assert(!kHasRegisters<Root>, "the register has another name");
    return false;
  }
}

class CanMode : public testing::Test {
 protected:
  static constexpr unsigned kSettle = 3;  // quiet clocks before the engine counts as stopped
  void SetUp() override {
    mode_->scrub_i = 0;
    mode_->stop_ok_i = 1;
    mode_->busy_i = mode_->transmitter_i = mode_->running_i = 0;
    mode_->wake_i = mode_->stop_req_i = mode_->soft_rst_i = 0;
    mode_->mdis_i = mode_->freeze_i = 1;
    mode_.reset();
  }
  // The engine runs when it is told to, and stops a clock after `stops_` is set.
  void clock(unsigned clocks = 1) {
    for (unsigned i = 0; i < clocks; ++i) {
      mode_.settle();
      mode_->running_i = mode_->run_o || (mode_->running_i && !stops_);
      mode_.settle();
      clears_ += mode_->clear_o;
      mode_.clock();
    }
  }
  Mode mode() {
    mode_.settle();
    if (mode_->disabled_o) return kDisabled;
    if (mode_->stop_o) return kStopped;
    if (mode_->frz_ack_o) return kFrozen;
    if (mode_->soft_rst_o) return kResetting;
    return mode_->run_o ? kRunning : kHalting;
  }
  void request(bool mdis, bool stop, bool freeze) {
    mode_->mdis_i = mdis;
    mode_->stop_req_i = stop;
    mode_->freeze_i = freeze;
  }
  void soft_reset() {
    mode_->soft_rst_i = 1;
    clock();
    mode_->soft_rst_i = 0;
  }
  // Brings it into a mode by requests alone.
  void enter(Mode mode) {
    SetUp();
    stops_ = mode != kHalting && mode != kResetting;
    request(mode == kDisabled, mode == kStopped, mode == kFrozen);
    clock(4);
    if (mode == kHalting) request(false, false, true);
    if (mode == kHalting) clock(2);
    if (mode == kResetting) soft_reset();
    ASSERT_EQ(this->mode(), mode);
    clears_ = 0;
  }
  LeafModel<Vcan_mode> mode_;
  bool stops_ = true;
  unsigned clears_ = 0;
};

// FX-2.a: hard reset is disable mode; it lasts until the buffers are cleared.
TEST_F(CanMode, HardResetIsDisableMode) {
  mode_->scrub_i = 1;
  mode_.reset();
  request(false, false, true);
  clock(5);
  EXPECT_EQ(mode(), kDisabled);
  mode_->scrub_i = 0;
  clock();
  EXPECT_EQ(mode(), kFrozen);
}

// FX-2.1.b, FX-2.1.d, FX-2.2.d, FX-2.9.a, FX-9.ERR008341: from every mode to the one that is asked
// for; disable before stop before freeze.
TEST_F(CanMode, EveryModeLeadsToTheOneAskedFor) {
  for (const Mode from : {kDisabled, kStopped, kFrozen, kRunning, kHalting}) {
    for (unsigned requests = 0; requests < 8; ++requests) {
      SCOPED_TRACE(testing::Message() << "from " << from << " requests " << requests);
      enter(from);
      const bool mdis = requests & 1, stop = requests & 2, freeze = requests & 4;
      request(mdis, stop, freeze);
      stops_ = true;
      clock(4 + kSettle);
      EXPECT_EQ(mode(), mdis ? kDisabled : stop ? kStopped : freeze ? kFrozen : kRunning);
      EXPECT_EQ(mode_->lpm_ack_o, mdis || stop);
      EXPECT_EQ(clears_, 0u);
    }
  }
}

// FX-2.1.b, FX-2.2.d: from a mode without the engine one clock is enough.
TEST_F(CanMode, WithoutTheEngineAModeIsReachedInOneClock) {
  for (const Mode from : {kDisabled, kStopped, kFrozen})
    for (unsigned requests = 0; requests < 8; ++requests) {
      enter(from);
      const bool mdis = requests & 1, stop = requests & 2, freeze = requests & 4;
      request(mdis, stop, freeze);
      clock();
      EXPECT_EQ(mode(), mdis ? kDisabled : stop ? kStopped : freeze ? kFrozen : kRunning);
    }
}

// FX-2.3.a, FX-2.3.d, FX-9.ERR008341: soft reset ends in freeze mode, after one clear pulse, from
// everywhere but disable and stop mode.
TEST_F(CanMode, SoftResetFromEveryMode) {
  for (const Mode from : {kFrozen, kRunning, kHalting, kResetting}) {
    SCOPED_TRACE(from);
    enter(from);
    mode_->freeze_i = 1;  // what can_regs does with the request
    soft_reset();
    EXPECT_EQ(mode(), kResetting);
    EXPECT_FALSE(mode_->run_o);
    stops_ = true;
    clock(3 + kSettle);
    EXPECT_EQ(mode(), kFrozen);
    EXPECT_EQ(clears_, 1u);
  }
}

// Where the engine stands already there is nothing to wait for, however long it has stood.
TEST_F(CanMode, SoftResetInFreezeModeIsDoneAtOnce) {  // FX-2.3.b
  for (unsigned stood = 0; stood < 8; ++stood) {
    enter(kRunning);
    request(false, false, true);
    clock(3 + kSettle + stood);
    ASSERT_EQ(mode(), kFrozen);
    clears_ = 0;
    soft_reset();
    ASSERT_EQ(mode(), kResetting);
    clock(2);
    EXPECT_EQ(mode(), kFrozen) << stood;
    EXPECT_EQ(clears_, 1u) << stood;
  }
}

// FX-2.3.b: nothing is cleared before the engine stands and no move is under way.
TEST_F(CanMode, SoftResetWaitsForEngineAndMoves) {
  enter(kRunning);
  mode_->freeze_i = 1;
  stops_ = false;
  mode_->busy_i = 1;
  soft_reset();
  clock(10);
  EXPECT_EQ(mode(), kResetting);
  stops_ = true;
  clock(10);
  EXPECT_EQ(mode(), kResetting);
  EXPECT_EQ(clears_, 0u);
  mode_->busy_i = 0;
  clock(2 + kSettle);
  EXPECT_EQ(mode(), kFrozen);
  EXPECT_EQ(clears_, 1u);
}

// FX-2.1.a, FX-2.2.a: freeze waits for a frame of either side, low power for an own one only.
TEST_F(CanMode, WhoWaitsForAFrame) {
  struct Case {
    bool mdis, stop, freeze, transmitter, waits;
  };
  for (const Case c : {Case{false, false, true, false, true}, Case{false, false, true, true, true},
                       Case{true, false, false, false, false}, Case{true, false, false, true, true},
                       Case{false, true, false, false, false}, Case{false, true, false, true, true},
                       Case{true, false, true, false, false}}) {
    enter(kRunning);
    mode_->stop_ok_i = 0;
    mode_->transmitter_i = c.transmitter;
    request(c.mdis, c.stop, c.freeze);
    clock(20);
    EXPECT_EQ(mode() == kRunning, c.waits);
    mode_->stop_ok_i = 1;
    clock(4 + kSettle);
    EXPECT_EQ(mode(), c.mdis ? kDisabled : c.stop ? kStopped : kFrozen);
  }
}

// FX-2.2.a: the acknowledge comes after the moves.
TEST_F(CanMode, AcknowledgeWaitsForMoves) {
  enter(kRunning);
  mode_->busy_i = 1;
  request(false, false, true);
  clock(20);
  EXPECT_EQ(mode(), kHalting);
  mode_->busy_i = 0;
  clock(kSettle);
  EXPECT_EQ(mode(), kHalting);
  clock();
  EXPECT_EQ(mode(), kFrozen);
}

// FX-2.1.a, FX-2.2.a, FX-2.3.d: ... which may begin some clocks after the engine has stopped.
TEST_F(CanMode, AcknowledgeWaitsForAMoveThatBeginsLate) {
  for (const Mode from : {kHalting, kResetting}) {
    for (unsigned late = 0; late < kSettle; ++late) {
      SCOPED_TRACE(testing::Message() << "from " << from << " after " << late);
      enter(from);
      mode_->freeze_i = 1;
      stops_ = true;
      clock(1 + late);
      ASSERT_EQ(mode_->running_i, 0);
      mode_->busy_i = 1;
      clock(20);
      EXPECT_EQ(mode(), from);
      mode_->busy_i = 0;
      clock(1 + kSettle + (from == kResetting));  // which clears in a clock of its own
      EXPECT_EQ(mode(), kFrozen);
    }
  }
}

TEST_F(CanMode, LowPowerFromFreezeWaitsForAMove) {
  for (const bool stop : {false, true}) {
    enter(kFrozen);
    mode_->busy_i = 1;
    request(!stop, stop, true);
    clock(20);
    EXPECT_EQ(mode(), kFrozen);
    mode_->busy_i = 0;
    clock();
    EXPECT_EQ(mode(), stop ? kStopped : kDisabled);
  }
}

// FX-2.2.d: leaving freeze mode waits for nothing, a move under way included.
TEST_F(CanMode, FreezeIsLeftDuringAMove) {
  enter(kFrozen);
  mode_->busy_i = 1;
  request(false, false, false);
  clock();
  EXPECT_EQ(mode(), kRunning);
}

// Withdrawn before it was acknowledged.
TEST_F(CanMode, AWithdrawnRequestLeadsBack) {
  enter(kHalting);
  request(false, false, false);
  clock(2);
  EXPECT_EQ(mode(), kHalting) << "the engine has not stopped yet";
  stops_ = true;
  clock(3 + kSettle);
  EXPECT_EQ(mode(), kRunning);
}

// FX-2.9.a: a wake-up counts until the request has gone away.
TEST_F(CanMode, WakeUpHoldsUntilTheRequestGoes) {
  for (const bool freeze : {false, true}) {
    enter(kStopped);
    mode_->freeze_i = freeze;
    mode_->wake_i = 1;
    clock();
    mode_->wake_i = 0;
    clock(10);
    EXPECT_EQ(mode(), freeze ? kFrozen : kRunning);
    mode_->stop_req_i = 0;
    clock();
    mode_->stop_req_i = 1;
    clock(4 + kSettle);
    EXPECT_EQ(mode(), kStopped);
  }
}

// FX-2.9.a: a hard reset forgets the wake-up, though the request has stayed.
TEST_F(CanMode, RequestCountsAgainAfterAHardReset) {
  enter(kStopped);
  mode_->wake_i = 1;
  clock();
  mode_->wake_i = 0;
  clock(2);
  EXPECT_EQ(mode(), kRunning);
  mode_->rst_ni = 0;
  clock();
  mode_->rst_ni = 1;
  clock(2);
  EXPECT_EQ(mode(), kStopped);
}

// FX-9.ERR008341: codes that are no state lead to freeze mode, everything cleared, off the bus.
TEST_F(CanMode, IllegalStateRecoversThroughASoftReset) {
  constexpr unsigned kIllegal = 7;
  enter(kRunning);
  if (!upset(mode_->rootp, kIllegal)) GTEST_SKIP();
  mode_.clock();
  EXPECT_EQ(mode(), kResetting);
  mode_->freeze_i = 1;  // what can_regs does with the clear pulse
  clock(5);
  EXPECT_EQ(mode(), kFrozen);
  EXPECT_EQ(clears_, 1u);
}

}  // namespace
}  // namespace vericansim
