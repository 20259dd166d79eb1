// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Calendar against the protocol of include/uapi/linux/um_timetravel.h.
#include <gtest/gtest.h>

#include <stdexcept>

#include "linux/calendar.hpp"

namespace vericansim {
namespace {

constexpr std::uint64_t kMidnight = 1'700'000'000'000'000'000ULL;

class CalendarTest : public ::testing::Test {
 protected:
  TimeMessage say(TimeOp op, std::uint64_t time = 0, std::uint64_t now = 0) {
    return calendar.answer({static_cast<std::uint32_t>(op), ++seq, time}, now);
  }

  Calendar calendar{kMidnight};
  std::uint32_t seq = 40;
};

TEST_F(CalendarTest, EveryMessageIsAcknowledgedWithItsNumber) {
  for (const TimeOp op : {TimeOp::kStart, TimeOp::kRequest, TimeOp::kUpdate, TimeOp::kGet,
                          TimeOp::kGetTod, TimeOp::kWait}) {
    const TimeMessage ack = say(op, 1000);
    EXPECT_EQ(ack.op, static_cast<std::uint32_t>(TimeOp::kAck));
    EXPECT_EQ(ack.seq, seq);
  }
}

TEST_F(CalendarTest, AGuestRunsExactlyWhenItWantedTo) {
  (void)say(TimeOp::kRequest, 9000);
  (void)say(TimeOp::kRequest, 5000);  // replaces the first
  EXPECT_FALSE(calendar.waiting());
  (void)say(TimeOp::kWait);
  ASSERT_TRUE(calendar.waiting());
  EXPECT_EQ(calendar.goal(), 5000U);
  const TimeMessage run = calendar.run();
  EXPECT_EQ(run.op, static_cast<std::uint32_t>(TimeOp::kRun));
  EXPECT_EQ(run.time, 5000U);
  EXPECT_FALSE(calendar.waiting());
  EXPECT_EQ(calendar.goal(), Calendar::kNever) << "a request is spent when it is granted";
  EXPECT_EQ(calendar.guest_time(), 5000U);
}

TEST_F(CalendarTest, TimeStandsStillForAGuestThatRuns) {
  (void)say(TimeOp::kRequest, 5000);
  (void)say(TimeOp::kWait);
  (void)calendar.run();
  EXPECT_EQ(say(TimeOp::kGet, 0, 7777).time, 5000U) << "accesses have taken the simulator further";
}

TEST_F(CalendarTest, AnInterruptedGuestLearnsTheTimeButNotMoreThanItAskedFor) {
  (void)say(TimeOp::kRequest, 5000);
  (void)say(TimeOp::kWait);
  EXPECT_EQ(say(TimeOp::kGet, 0, 3000).time, 3000U);
  EXPECT_EQ(say(TimeOp::kGet, 0, 2000).time, 3000U) << "never backwards";
  EXPECT_EQ(say(TimeOp::kGet, 0, 6000).time, 5000U) << "its event at 5000 would be in its past";
  (void)say(TimeOp::kRequest, 3000);
  EXPECT_EQ(calendar.run().time, 5000U);
}

TEST_F(CalendarTest, TheTimeOfDayGoesWithTheGuestsClock) {
  EXPECT_EQ(say(TimeOp::kGetTod).time, kMidnight);
  (void)say(TimeOp::kUpdate, 123);
  EXPECT_EQ(say(TimeOp::kGetTod).time, kMidnight + 123);
}

TEST_F(CalendarTest, WhatNoGuestSaysIsRefused) {
  EXPECT_THROW((void)say(TimeOp::kRun), std::runtime_error);
  EXPECT_THROW((void)say(TimeOp::kFreeUntil), std::runtime_error);
  EXPECT_THROW((void)say(static_cast<TimeOp>(77)), std::runtime_error);
  EXPECT_THROW((void)calendar.run(), std::logic_error) << "it does not wait";
}

}  // namespace
}  // namespace vericansim
