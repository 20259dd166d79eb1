// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_tx of a core without status registers: it has no passes for them.
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "Vcan_mb_tx_bare.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBuffers = 16;
constexpr std::uint32_t kActive = 0xC000000;

class MbTxBare : public ::testing::Test {
 protected:
  MbTxBare() {
    tx_.reset();
    tx_->maxmb_i = kBuffers - 1;
    tx_->running_i = 1;
    tx_.settle();
  }
  /// One clock in which every slot that is asked for is given; `written`: a C/S word of the CPU.
  void clock(std::optional<unsigned> written = {}) {
    const bool insertion = tx_->ins_req_o != 0, scan = !insertion && tx_->scan_req_o != 0;
    const unsigned row = insertion ? tx_->ins_idx_o : tx_->scan_idx_o;
    tx_->ins_gnt_i = insertion;
    tx_->scan_gnt_i = scan;
    tx_.settle();
    const std::uint32_t cs = cs_[row], id = id_[row];
    tx_.clock();
    if (insertion || scan) {
      tx_->cs_i = cs;
      tx_->id_i = id;
    }
    tx_->cs_written_i = tx_->cs_written_act_i = written.has_value();
    tx_->cs_written_idx_i = written.value_or(0);
    tx_->start_i = tx_->fresh_i = 0;
    tx_.settle();
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  void activate(unsigned buffer, std::uint32_t id) {
    cs_[buffer] = kActive;
    id_[buffer] = id << 18;
    clock(buffer);
  }
  std::array<std::uint32_t, kBuffers> cs_{}, id_{};
  LeafModel<Vcan_mb_tx_bare> tx_;
};

// A pass that nobody has asked for goes on when a winner comes meanwhile. When that winner goes on
// the bus, the pass for the next one begins with the first buffer, wherever the other was.
TEST_F(MbTxBare, PassForTheNextWinnerBeginsWithTheFirstBuffer) {  // FX-3.3.f
  for (unsigned moment = 0; moment < 2 * kBuffers + 4; ++moment) {
    tx_->running_i = 0;
    cs_ = {};
    tx_->off_i = 0;
    clock();
    tx_->running_i = 1;
    clocks(60);
    tx_->fresh_i = 1;
    clock();
    clocks(4);
    activate(0, 0x200);
    clocks(6);
    activate(9, 0x100);
    clocks(6 + moment);
    ASSERT_TRUE(tx_->settled_o) << moment;
    ASSERT_EQ(tx_->best_idx_o, 9) << moment;
    tx_->cur_idx_i = 9;
    tx_->start_i = 1;
    clock();
    tx_->off_i = 1;
    clocks(60);
    ASSERT_TRUE(tx_->settled_o) << moment;
    EXPECT_EQ(tx_->best_idx_o, 0) << moment;
  }
}

}  // namespace
}  // namespace vericansim
