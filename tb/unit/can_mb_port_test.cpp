// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_port alone: who comes first at the read port and at the write port.
#include <gtest/gtest.h>

#include "Vcan_mb_port.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class MbPort : public ::testing::Test {
 protected:
  MbPort() {
    port_->cmd_be_i = 0xF;
    port_.reset();
    for (unsigned i = 0; i < 300; ++i) port_.clock();  // every row is cleared
    port_.settle();
    EXPECT_FALSE(port_->scrub_o);
  }
  void clock() {
    port_.clock();
    port_.settle();
  }
  /// A read of the CPU in its command phase, in every clock from now on; or none.
  void reads(bool on) {
    port_->cmd_slot_i = port_->cmd_rd_i = on;
    port_.settle();
  }
  /// The same for writes.
  void writes(bool on) {
    port_->cmd_wr_i = on;
    port_.settle();
  }
  void engine(bool on) {
    port_->eng_req_i = on;
    port_.settle();
  }
  LeafModel<Vcan_mb_port> port_;
};

TEST_F(MbPort, CpuReadsBeforeAnEngineThatWasNotRefused) {
  engine(true);
  for (unsigned i = 0; i < 3; ++i, clock()) EXPECT_TRUE(port_->eng_gnt_o);
  reads(true);
  EXPECT_FALSE(port_->eng_gnt_o);
  clock();
  EXPECT_TRUE(port_->ready_o) << "no wait state";
}

TEST_F(MbPort, EngineThatWasRefusedReadsBeforeTheCpu) {
  engine(true);
  reads(true);
  unsigned grants = 0;
  for (unsigned i = 0; i < 30; ++i, clock()) {
    grants += port_->eng_gnt_o;
    reads(port_->ready_o != 0);  // a command only where it is taken
  }
  EXPECT_GE(grants, 10u) << "one slot in three at the least";
  for (unsigned waits = 0; port_->ready_o == 0; ++waits, clock()) ASSERT_LE(waits, 1u);
}

TEST_F(MbPort, EngineRefusedByAnInsertionReadsBeforeTheCpu) {
  engine(true);
  port_->ins_req_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->ins_gnt_o);
  EXPECT_FALSE(port_->eng_gnt_o);
  clock();
  port_->ins_req_i = 0;
  reads(true);
  EXPECT_TRUE(port_->eng_gnt_o);
  clock();
  EXPECT_FALSE(port_->ready_o) << "the CPU waits for one clock";
  clock();
  EXPECT_TRUE(port_->ready_o);
}

// A serviced mark goes first once; a CPU that writes in every clock does not keep it out.
TEST_F(MbPort, ServicedMarkComesBeforeAWriteThatHasNotWaited) {  // FX-3.6.g
  writes(true);
  clock();
  port_->svc_req_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->svc_gnt_o);
  EXPECT_FALSE(port_->ready_o);
  clock();
  EXPECT_FALSE(port_->svc_gnt_o) << "another one";
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, SecondHalfOfACopyComesBeforeAWriteThatHasNotWaited) {
  writes(true);
  clock();
  port_->copy_i = 1;
  port_.settle();
  EXPECT_FALSE(port_->hold_o);
  EXPECT_FALSE(port_->ready_o);
  clock();
  EXPECT_TRUE(port_->hold_o) << "another one";
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, NobodyWaitsInReset) {
  engine(true);
  reads(true);
  clock();
  clock();
  EXPECT_FALSE(port_->ready_o);
  port_->rst_ni = 0;
  port_.settle();
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, EngineWriteThatWasRefusedComesBeforeTheCpu) {
  writes(true);
  clock();
  port_->ewr_req_i = 1;
  port_.settle();
  EXPECT_FALSE(port_->ewr_gnt_o);
  EXPECT_TRUE(port_->ready_o);
  clock();
  EXPECT_TRUE(port_->ewr_gnt_o);
  EXPECT_FALSE(port_->ready_o);
}

}  // namespace
}  // namespace vericansim
