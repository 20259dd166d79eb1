// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_top alone: its native port, with a master that holds a command until it is taken.
#include <gtest/gtest.h>

#include <vector>

#include "Vcan_top.h"
#include "model/registers.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

struct Command {
  std::uint32_t address = 0;
  bool write = false;
  std::uint32_t data = 0;
};

class CanTop : public ::testing::Test {
 protected:
  CanTop() {
    top_->can_rx_i = 1;
    top_->be_i = 0xF;
    top_.reset();
    for (unsigned i = 0; i < 300; ++i) top_.clock();  // the buffers are cleared
  }
  /// Commands one after the other without a pause; returns what the reads gave.
  std::vector<std::uint32_t> run(const std::vector<Command> &commands) {
    std::vector<std::uint32_t> out;
    const Command *data_phase = nullptr;
    for (auto next = commands.begin(); next != commands.end() || data_phase != nullptr;) {
      const bool any = next != commands.end();
      top_->req_i = any;
      top_->addr_i = any ? next->address / 4 : 0;
      top_->we_i = any && next->write;
      top_->wdata_i = data_phase != nullptr ? data_phase->data : 0;
      top_.settle();
      const bool ready = top_->ready_o != 0;
      if (ready && data_phase != nullptr && !data_phase->write) out.push_back(top_->rdata_o);
      waits_ += ready ? 0 : 1;
      top_.clock();
      if (!ready) continue;
      data_phase = any ? &*next : nullptr;
      if (any) ++next;
    }
    top_->req_i = 0;
    return out;
  }
  LeafModel<Vcan_top> top_;
  unsigned waits_ = 0;
};

// A register's command that is there while a buffer's access waits is taken once, with its own
// data, when the wait is over. With AEN = 1 and an ended buffer all writes to buffers wait.
TEST_F(CanTop, CommandCountsWhereItIsTaken) {
  constexpr std::uint32_t kAen = 1u << 12;
  run({{reg::kMcr, true, reg::kMcrFrz | reg::kMcrHalt}});
  for (unsigned i = 0; i < 10; ++i) top_.clock();
  run({{reg::kMcr, true, reg::kMcrFrz | reg::kMcrHalt | kAen | 15},
       {reg::mb(0), true, 0x09000000}});
  EXPECT_EQ(run({{reg::kIflag1}}), std::vector<std::uint32_t>{1});
  waits_ = 0;
  EXPECT_EQ(run({{reg::mb(1, 2), true, ~0u}, {reg::kIflag1, true, 0}, {reg::kIflag1}}),
            std::vector<std::uint32_t>{1});
  EXPECT_EQ(waits_, 1u);
  EXPECT_EQ(run({{reg::mb(1, 2), true, ~0u}, {reg::kIflag1}, {reg::mb(1, 2)}}),
            (std::vector<std::uint32_t>{1, ~0u}));
}

// An abort that is done at once sets a flag. A hard reset clears all flags, and no line waits for
// its end.
TEST_F(CanTop, NoInterruptInReset) {
  run({{reg::kMcr, true, reg::kMcrFrz | reg::kMcrHalt}});
  for (unsigned i = 0; i < 10; ++i) top_.clock();
  run({{reg::kMcr, true, reg::kMcrFrz | reg::kMcrHalt | 1u << 12 | 15},
       {reg::kImask1, true, 1},
       {reg::mb(0), true, 0x09000000}});
  for (unsigned i = 0; i < 4; ++i) top_.clock();
  EXPECT_TRUE(top_->irq_o && top_->irq_mb_o);
  top_->rst_ni = 0;
  for (unsigned i = 0; i < 3; ++i) {
    top_.settle();
    EXPECT_FALSE(top_->irq_o || top_->irq_mb_o) << i;
    top_.clock();
  }
  top_->rst_ni = 1;
  top_.clock();
  EXPECT_FALSE(top_->irq_o || top_->irq_mb_o);
}

}  // namespace
}  // namespace vericansim
