// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of the buffers by itself: what it lets a CPU see of a frame that is moving in
// (flexcan.md 3.5, 3.6), and what not.
#include <gtest/gtest.h>

#include "model/buffer_model.hpp"
#include "model/registers.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 3;
constexpr std::uint32_t kFlag = 1u << kMb;
constexpr Frame kOld{.id = 0x123, .dlc = 8, .data = {1, 1, 1, 1, 1, 1, 1, 1}};
constexpr Frame kNew{.id = 0x123, .dlc = 8, .data = {2, 2, 2, 2, 2, 2, 2, 2}};
constexpr std::uint32_t kOldData = 0x01010101, kNewData = 0x02020202;
constexpr std::uint32_t kOldCs = 0x02080000, kNewCs = 0x02080001;  // FULL, stamps 0 and 1
constexpr std::uint32_t kBusy = 1u << 24;

/// kOld is stored; kNew came while the CPU had locked the buffer, and TIMER has just been read.
class MoveIn : public ::testing::Test {
 protected:
  MoveIn() : model_{BufferConfig{.num_mb = 16, .maxmb = 15}} {
    model_.cpu_write(reg::mb(kMb, 1), 0x123u << 18, tick());
    model_.cpu_write(reg::mb(kMb), kRxEmpty << 24, tick());
    receive(kOld, 0);
    read_cs(kOldCs);
    receive(kNew, 1);
    model_.cpu_read(reg::kTimer, 0, tick());
  }

  std::uint64_t tick() { return now_ += 2; }
  void receive(const Frame &frame, std::uint16_t stamp) {
    model_.frame_started(false, tick());
    model_.header(frame, stamp, now_ += 100);
    model_.received(frame, now_ += 500);
    now_ += 200;
  }
  void read_cs(std::uint32_t value) { model_.cpu_read(reg::mb(kMb), value, tick()); }
  void read_data(unsigned word, std::uint32_t value) {
    model_.cpu_read(reg::mb(kMb, word), value, tick());
  }
  void read_flag(bool set) { model_.cpu_read(reg::kIflag1, set ? kFlag : 0, tick()); }
  void clear_flag() { model_.cpu_write(reg::kIflag1, kFlag, tick()); }
  void wait() { now_ += 2 * model_.windows().move_in; }

  std::uint64_t now_ = 0;
  BufferModel model_;
};

// Words first, then the flag.
TEST_F(MoveIn, FlagAfterWords) {
  read_cs(kOldCs | kBusy);
  read_data(2, kNewData);
  clear_flag();  // that of kOld
  read_flag(false);
  read_flag(true);
  read_cs(kNewCs);
  EXPECT_TRUE(model_.ok()) << model_.failure();
}

TEST_F(MoveIn, WordsAreOldOrNew) {
  read_data(2, kNewData);
  read_data(3, kOldData);
  EXPECT_TRUE(model_.ok()) << model_.failure();
  read_data(3, 0x01010202);
  EXPECT_FALSE(model_.ok());
}

TEST_F(MoveIn, BusyUntilItIsOver) {
  read_data(2, kNewData);
  read_cs(kOldCs);
  EXPECT_FALSE(model_.ok());
}

TEST_F(MoveIn, CodeWithAllWords) {
  read_cs(kOldCs | kBusy);
  read_cs(kNewCs);
  EXPECT_TRUE(model_.ok()) << model_.failure();
  read_data(2, kOldData);
  EXPECT_FALSE(model_.ok());
}

TEST_F(MoveIn, EndsInTime) {
  read_cs(kOldCs | kBusy);
  wait();
  read_cs(kOldCs | kBusy);
  EXPECT_FALSE(model_.ok());
}

TEST_F(MoveIn, FlagInTime) {
  clear_flag();
  read_cs(kOldCs | kBusy);
  wait();
  read_flag(false);
  EXPECT_FALSE(model_.ok());
}

// The CPU is back before the move has begun: the frame waits for the next unlock.
TEST_F(MoveIn, LockedAgain) {
  read_cs(kOldCs);
  wait();
  read_data(2, kOldData);
  read_cs(kOldCs);
  EXPECT_TRUE(model_.ok()) << model_.failure();
  model_.cpu_read(reg::kTimer, 0, tick());
  wait();
  read_data(2, kNewData);
  read_cs(kNewCs);
  EXPECT_TRUE(model_.ok()) << model_.failure();
}

TEST_F(MoveIn, NotIntoALockedBuffer) {
  read_cs(kOldCs);
  wait();
  read_data(2, kNewData);
  EXPECT_FALSE(model_.ok());
}

TEST_F(MoveIn, NotBusyWhileLocked) {
  read_cs(kOldCs);
  read_cs(kOldCs | kBusy);
  EXPECT_FALSE(model_.ok());
}

// BUSY says that the word is not to be relied on: its stamp may be either frame's and does not tell
// how stamps stand to the reference count.
TEST(MoveInUnlocked, StampBesideBusyIsOfEitherFrame) {
  for (const std::uint32_t shown : {0x07080000u, 0x07080048u}) {
    BufferModel model{BufferConfig{.num_mb = 16, .maxmb = 15}};
    model.cpu_write(reg::mb(kMb, 1), 0x123u << 18, 2);
    model.cpu_write(reg::mb(kMb), kRxEmpty << 24, 4);
    std::uint64_t now = 1000;
    for (const std::uint16_t stamp : {0x0, 0x48}) {
      model.frame_started(false, now += 500);
      model.header(kOld, stamp, now += 100);
      model.received(kOld, now += 500);
    }
    model.cpu_read(reg::mb(kMb), shown, now + 10);
    model.cpu_read(reg::mb(kMb), 0x06080048, now + 300);
    EXPECT_TRUE(model.ok()) << model.failure();
    model.cpu_read(reg::mb(kMb), 0x06080047, now + 400);
    EXPECT_FALSE(model.ok()) << "this one told how stamps stand";
  }
}

// A C/S write cuts the move short: words of either frame, but no flag.
TEST_F(MoveIn, CutShort) {
  read_cs(kOldCs | kBusy);
  clear_flag();
  model_.cpu_write(reg::mb(kMb), 0, tick());
  EXPECT_TRUE(model_.ok()) << model_.failure();
  read_data(2, kNewData);
  read_data(3, kOldData);
  EXPECT_TRUE(model_.ok()) << model_.failure();
}

}  // namespace
}  // namespace vericansim
