// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_lock alone (flexcan.md 3.6): what locks, what unlocks, and the mark that follows.
#include <gtest/gtest.h>

#include <utility>

#include "Vcan_mb_lock.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kEmpty = 0x4, kFull = 0x2, kOverrun = 0x6;

class MbLock : public ::testing::Test {
 protected:
  MbLock() {
    lock_->bcc_i = 1;
    lock_.reset();
  }
  void clock() {
    lock_.clock();
    lock_->cs_rd_i = lock_->timer_rd_i = lock_->cs_written_i = lock_->serviced_gnt_i = 0;
    lock_.settle();
  }
  void read(unsigned idx, unsigned code, bool serviced = false) {
    lock_->cs_rd_i = 1;
    lock_->idx_i = idx;
    lock_->code_i = code;
    lock_->serviced_i = serviced;
    clock();
  }
  void read_timer() {
    lock_->timer_rd_i = 1;
    clock();
  }
  void write(unsigned idx) {
    begin_write(idx);
    lock_->cs_written_i = 1;
    lock_->cs_written_idx_i = idx;
    clock();
  }
  /// Its data phase.
  void begin_write(unsigned idx, bool code = true) {
    lock_->idx_i = idx;
    lock_->be3_i = code;
    clock();
  }
  LeafModel<Vcan_mb_lock> lock_;
};

TEST_F(MbLock, ReadOfAnotherBufferUnlocksAndServices) {  // FX-3.6.c, FX-3.6.e, FX-3.6.g
  for (const unsigned other : {kEmpty, kFull, 0x8u}) {
    read(5, kOverrun);
    EXPECT_TRUE(lock_->lock_o);
    read(9, other);
    EXPECT_EQ(lock_->lock_o != 0, other == kFull);
    EXPECT_TRUE(lock_->serviced_req_o);
    EXPECT_EQ(lock_->serviced_idx_o, 5);
    EXPECT_TRUE(lock_->serviced_ovr_o);
    lock_->serviced_gnt_i = 1;
    clock();
    EXPECT_FALSE(lock_->serviced_req_o);
    write(9);
  }
}

// The mark would be written over the new code; a write without one leaves it.
TEST_F(MbLock, NoMarkInTheClockBehindACsWrite) {  // FX-3.6.g
  for (const auto &[written, code] : {std::pair{5u, true}, {5u, false}, {6u, true}}) {
    read(5, kFull);
    read_timer();
    EXPECT_TRUE(lock_->serviced_req_o);
    begin_write(written, code);
    lock_->cs_written_i = 1;
    lock_->cs_written_idx_i = written;
    lock_.settle();
    const bool stays = written != 5 || !code;
    EXPECT_EQ(lock_->serviced_req_o != 0, stays);
    clock();
    EXPECT_EQ(lock_->serviced_req_o != 0, stays);
  }
}

TEST_F(MbLock, ReadOfTheSameBufferKeepsTheLock) {  // FX-3.6.e
  read(5, kFull);
  read(5, kFull);
  EXPECT_TRUE(lock_->lock_o);
  EXPECT_FALSE(lock_->serviced_req_o);
}

// The mark waits for its turn, whatever buffer the last C/S write was to; a new one takes it away.
TEST_F(MbLock, MarkWaitsUntilItIsGranted) {  // FX-3.6.g, FX-3.4.g
  for (const bool rewritten : {false, true}) {
    write(5);
    read(5, kFull);
    read_timer();
    EXPECT_FALSE(lock_->lock_o);
    for (unsigned i = 0; i < 10; ++i, clock()) EXPECT_TRUE(lock_->serviced_req_o);
    if (rewritten) {
      write(5);
    } else {
      lock_->serviced_gnt_i = 1;
      clock();
    }
    EXPECT_FALSE(lock_->serviced_req_o);
  }
}

TEST_F(MbLock, OneMarkForEachLock) {  // FX-3.6.g
  read(5, kFull);
  read_timer();
  EXPECT_TRUE(lock_->serviced_req_o);
  lock_->serviced_gnt_i = 1;
  clock();
  read_timer();
  EXPECT_FALSE(lock_->serviced_req_o);
  read(9, kEmpty);
  EXPECT_FALSE(lock_->serviced_req_o);
}

TEST_F(MbLock, NoMarkWithoutAnUnreadFrame) {  // FX-3.6.g
  read(5, kFull, true);
  EXPECT_TRUE(lock_->lock_o);
  read_timer();
  EXPECT_FALSE(lock_->serviced_req_o) << "has one already";
  lock_->bcc_i = 0;
  read(5, kEmpty);
  EXPECT_TRUE(lock_->lock_o);
  read_timer();
  EXPECT_FALSE(lock_->serviced_req_o) << "nothing was read";
}

}  // namespace
}  // namespace vericansim
