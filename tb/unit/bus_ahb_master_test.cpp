// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AhbMaster and AhbChecker against a slave written here: pipelining, waits, errors, lanes, bursts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "node/ahb_master.hpp"
#include "node/task.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A memory of bytes with a number of wait states for each address, and errors above 0x1000.
class Slave {
 public:
  std::map<std::uint32_t, std::uint8_t> bytes;
  std::map<std::uint32_t, unsigned> waits;
  bool short_error = false;  // breaks the rule of two cycles
  std::vector<AhbRequest> requests;

  // One cycle: answers for the transfer in its data phase, then takes the request.
  AhbResponse cycle(const AhbRequest &request) {
    requests.push_back(request);
    AhbResponse response = answer(request);
    if (response.hready) {
      phase_.reset();
      if (request.htrans == AhbTrans::kNonseq || request.htrans == AhbTrans::kSeq) {
        phase_ = request;
        left_ = waits.contains(request.haddr) ? waits.at(request.haddr) : 0;
        error_ = request.haddr >= 0x1000;
      }
    }
    return response;
  }

 private:
  AhbResponse answer(const AhbRequest &request) {
    if (!phase_) return {0xDEADBEEF, true, false};
    if (left_ != 0) {
      --left_;
      return {0xDEADBEEF, false, false};
    }
    if (error_ && !short_error) {
      error_ = false;
      second_ = true;
      return {0xDEADBEEF, false, true};
    }
    if (error_ || second_) {
      error_ = second_ = false;
      return {0xDEADBEEF, true, true};
    }
    return {transfer(request.hwdata), true, false};
  }

  std::uint32_t transfer(std::uint32_t wdata) {
    std::uint32_t word = 0;
    const std::uint32_t base = phase_->haddr & ~3u;
    for (unsigned lane = 0; lane < 4; ++lane) {
      const std::uint32_t size = 1u << static_cast<unsigned>(phase_->hsize);
      const bool used = base + lane >= phase_->haddr && base + lane < phase_->haddr + size;
      if (phase_->hwrite && used)
        bytes[base + lane] = static_cast<std::uint8_t>(wdata >> (8 * lane));
      word |= static_cast<std::uint32_t>(bytes[base + lane]) << (8 * lane);
    }
    return word;
  }

  std::optional<AhbRequest> phase_;
  unsigned left_ = 0;
  bool error_ = false;
  bool second_ = false;
};

struct AhbTest : ::testing::Test {
  AhbMaster master;
  Slave slave;
  unsigned run() {
    unsigned cycles = 0;
    for (; master.active() && cycles < 1000; ++cycles) master.clock(slave.cycle(master.request()));
    return cycles;
  }
};

TEST_F(AhbTest, TransfersFollowEachOtherWithoutAGap) {
  for (std::uint32_t i = 0; i < 8; ++i)
    master.submit({.address = 4 * i, .write = true, .data = 100 + i});
  std::vector<AhbMaster::Ticket> reads;
  for (std::uint32_t i = 0; i < 8; ++i) reads.push_back(master.submit({.address = 4 * i}));
  EXPECT_EQ(run(), 17u);  // 16 address phases and one last data phase
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(master.result(reads[i]).data, 100 + i);
  EXPECT_THAT(master.checker().violations(), IsEmpty());
}

TEST_F(AhbTest, BytesAndHalfWordsUseTheirLanesOnly) {
  master.submit({.address = 0, .write = true, .data = 0x44332211});
  master.submit({.address = 1, .write = true, .size = AhbSize::kByte, .data = 0xAA});
  master.submit({.address = 2, .write = true, .size = AhbSize::kHalf, .data = 0xCCBB});
  const auto word = master.submit({.address = 0});
  const auto byte = master.submit({.address = 3, .size = AhbSize::kByte});
  const auto half = master.submit({.address = 0, .size = AhbSize::kHalf});
  run();
  EXPECT_EQ(master.result(word).data, 0xCCBBAA11u);
  EXPECT_EQ(master.result(byte).data, 0xCCu);
  EXPECT_EQ(master.result(half).data, 0xAA11u);
}

TEST_F(AhbTest, WaitStatesAreCountedAndHoldTheAddressPhase) {
  slave.waits = {{4, 3}};
  master.submit({.address = 0});
  const auto slow = master.submit({.address = 4});
  const auto next = master.submit({.address = 8});
  EXPECT_EQ(run(), 7u);
  EXPECT_EQ(master.result(slow).waits, 3u);
  EXPECT_EQ(master.result(next).waits, 0u);
  EXPECT_EQ(master.checker().max_waits(), 3u);
  EXPECT_EQ(master.checker().wait_states(), 3u);
  EXPECT_THAT(master.checker().violations(), IsEmpty());
}

TEST_F(AhbTest, ErrorResponseTakesTwoCyclesAndIsReported) {
  const auto bad = master.submit({.address = 0x1000});
  const auto good = master.submit({.address = 0});
  EXPECT_EQ(run(), 4u);
  EXPECT_TRUE(master.result(bad).error);
  EXPECT_EQ(master.result(bad).waits, 0u);
  EXPECT_FALSE(master.result(good).error);
  EXPECT_THAT(master.checker().violations(), IsEmpty());
}

TEST_F(AhbTest, CheckerSeesAnErrorOfASingleCycle) {
  slave.short_error = true;
  master.submit({.address = 0x1000});
  run();
  EXPECT_THAT(master.checker().violations(), ElementsAre(HasSubstr("single cycle")));
}

TEST_F(AhbTest, BurstsWrapAndCarrySeq) {
  master.submit_burst(0x38, AhbBurst::kWrap4, true, {1, 2, 3, 4});
  run();
  std::vector<std::uint32_t> addresses;
  for (const AhbRequest &r : slave.requests) {
    if (r.htrans >= AhbTrans::kNonseq) addresses.push_back(r.haddr);
  }
  EXPECT_THAT(addresses, ElementsAre(0x38, 0x3C, 0x30, 0x34));
  EXPECT_EQ(slave.requests[0].htrans, AhbTrans::kNonseq);
  EXPECT_EQ(slave.requests[1].htrans, AhbTrans::kSeq);
  EXPECT_EQ(slave.bytes[0x34], 4);
  EXPECT_THAT(master.checker().violations(), IsEmpty());
}

TEST_F(AhbTest, BusyAndIdleCyclesArePutIn) {
  master.submit({.address = 0, .burst = AhbBurst::kIncr});
  master.submit({.address = 4, .burst = AhbBurst::kIncr, .trans = AhbTrans::kSeq, .pause = 2});
  master.submit({.address = 0x40, .pause = 1});
  run();
  std::string kinds;
  for (const AhbRequest &r : slave.requests) kinds += "IBNS"[static_cast<int>(r.htrans)];
  EXPECT_EQ(kinds, "NBBSINI");
  EXPECT_THAT(master.checker().violations(), IsEmpty());
}

TEST(AhbChecker, NamesWhatMasterAndSlaveMustNotDo) {
  AhbChecker checker;
  AhbRequest read{.haddr = 0, .htrans = AhbTrans::kNonseq};
  checker.clock(read, {});
  read.haddr = 4;
  checker.clock(read, {.hready = false});
  read.haddr = 8;  // moved under a wait state
  checker.clock(read, {.hready = true});
  checker.clock({}, {});
  checker.clock({}, {.hready = false});  // nothing to wait for
  checker.clock({}, {});
  checker.clock({.haddr = 0x20, .htrans = AhbTrans::kSeq}, {});  // SEQ without a burst
  EXPECT_THAT(checker.violations(),
              ElementsAre(HasSubstr("address phase changed"), HasSubstr("wait state without"),
                          HasSubstr("SEQ without"), HasSubstr("SEQ address")));
}

Task<std::uint32_t> add(AhbMaster &master, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t x = (co_await master.read(a)).data;
  const std::uint32_t y = (co_await master.read(b)).data;
  static_cast<void>(co_await master.write(0x80, x + y));
  co_return x + y;
}

TEST_F(AhbTest, CoroutinesWaitForTheirTransfers) {
  slave.bytes = {{0, 5}, {4, 7}};
  Task<std::uint32_t> task = add(master, 0, 4);
  EXPECT_FALSE(task.done());
  run();
  ASSERT_TRUE(task.done());
  EXPECT_EQ(task.result(), 12u);
  EXPECT_EQ(slave.bytes[0x80], 12);
}

}  // namespace
}  // namespace vericansim
