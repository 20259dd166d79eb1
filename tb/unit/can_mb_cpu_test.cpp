// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_cpu alone: what the buffers' blocks are told of a C/S word that the CPU has written.
#include <gtest/gtest.h>

#include "Vcan_mb_cpu.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class MbCpu : public ::testing::Test {
 protected:
  MbCpu() { cpu_.reset(); }
  void write(unsigned idx, unsigned lanes, unsigned code) {
    cpu_->wr_done_i = 1;
    cpu_->kind_i = 0;
    cpu_->idx_i = idx;
    cpu_->be_i = lanes;
    cpu_->code_i = code;
    cpu_.settle();
    cpu_.clock();
    cpu_->wr_done_i = 0;
    cpu_.settle();
  }
  LeafModel<Vcan_mb_cpu> cpu_;
};

// Without the top byte the code may be any, without the others IDE may be: never less than a code
// that may be sent, never more than a word that is EMPTY for certain.
TEST_F(MbCpu, PartsOfAWordAreNotTakenForMore) {  // FX-3.4.g
  for (unsigned lanes = 1; lanes < 16; ++lanes) {
    for (unsigned code = 0; code < 16; ++code) {
      write(lanes, lanes, code);
      EXPECT_TRUE(cpu_->csw_o);
      EXPECT_EQ(cpu_->csw_idx_o, lanes);
      EXPECT_EQ(cpu_->csw_act_o != 0, (lanes & 8) == 0 || code == 0xC || code == 0xE)
          << lanes << " " << code;
      EXPECT_EQ(cpu_->csw_empty_o != 0, lanes == 15 && code == 4) << lanes << " " << code;
      cpu_.clock();
      cpu_.settle();
      EXPECT_FALSE(cpu_->csw_o);
    }
  }
}

// Words of the filter table are no C/S words, whatever they hold.
TEST_F(MbCpu, FilterWordsAreNoCsWords) {  // FX-4.a, FX-ESR2.VPS
  cpu_->fen_i = cpu_->cmd_mb_i = cpu_->ready_i = 1;
  cpu_->first_i = 10;
  for (unsigned idx = 6; idx < 14; ++idx) {
    cpu_->cmd_wr_i = 1;
    cpu_->cmd_idx_i = idx;
    cpu_.clock();
    cpu_->cmd_wr_i = 0;
    write(idx, 15, 0xC);
    EXPECT_EQ(cpu_->csw_o != 0, idx >= 10) << idx;
    cpu_.clock();
  }
}

}  // namespace
}  // namespace vericansim
