// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Jobs and filters of BCM mode in simulated time. Examples of filters: socketcand's
// doc/protocol.md; semantics: Linux, Documentation/networking/can.rst.
#include "bridge/socketcand_broadcast.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bridge/socketcand_words.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

can_frame frame_of(canid_t id, std::vector<unsigned char> data) {
  can_frame frame{};
  frame.can_id = id;
  frame.len = static_cast<__u8>(data.size());
  std::copy(data.begin(), data.end(), frame.data);
  return frame;
}

class SocketcandJobs : public testing::Test {
 protected:
  // Times of frames up to `end`, looked at each 100 us.
  std::vector<Time> times(Time end) {
    std::vector<Time> result;
    for (; now_ <= end; now_ += 100 * kMicrosecond)
      while (const auto frame = manager_.due(now_)) {
        result.push_back(now_ / kMillisecond);
        last_ = *frame;
      }
    return result;
  }

  BroadcastManager manager_;
  Time now_ = 0;
  can_frame last_{};
};

// can.rst: starting the timer leads simultaneously to emit a frame.
TEST_F(SocketcandJobs, FirstAtOnceThenEachInterval) {
  now_ = 3 * kMillisecond;
  manager_.add_job(frame_of(0x123, {1}), 5 * kMillisecond, now_);
  EXPECT_THAT(times(20 * kMillisecond), ElementsAre(3, 8, 13, 18));
}

TEST_F(SocketcandJobs, UpdateKeepsTheTimes) {
  manager_.add_job(frame_of(0x123, {1}), 5 * kMillisecond, 0);
  EXPECT_THAT(times(7 * kMillisecond), ElementsAre(0, 5));
  manager_.update_job(frame_of(0x123, {0x11, 0x22, 0x33}));
  EXPECT_THAT(times(12 * kMillisecond), ElementsAre(10));
  EXPECT_EQ(last_.len, 3);
  EXPECT_EQ(last_.data[2], 0x33);
}

TEST_F(SocketcandJobs, DeleteEndsTheJobWithThisIdAlone) {
  manager_.add_job(frame_of(0x123, {}), 5 * kMillisecond, 0);
  manager_.add_job(frame_of(0x123 | CAN_EFF_FLAG, {}), 4 * kMillisecond, 0);
  EXPECT_THAT(times(0), ElementsAre(0, 0));
  manager_.delete_job(0x123);
  EXPECT_THAT(times(9 * kMillisecond), ElementsAre(4, 8));
  EXPECT_EQ(last_.can_id, 0x123 | CAN_EFF_FLAG);
}

TEST_F(SocketcandJobs, WhatIsNotThereIsAnError) {
  EXPECT_THROW(manager_.update_job(frame_of(0x123, {})), CommandError);
  EXPECT_THROW(manager_.delete_job(0x123), CommandError);
  EXPECT_THROW(manager_.unsubscribe(0x123), CommandError);
  EXPECT_THROW(manager_.add_job(frame_of(0x123, {}), 0, 0), CommandError);
}

TEST_F(SocketcandJobs, JobsAndFiltersAreLimited) {
  for (canid_t id = 0; id < BroadcastManager::kMost; ++id) {
    manager_.add_job(frame_of(id, {}), kSecond, 0);
    manager_.subscribe(id, 0);
  }
  EXPECT_NO_THROW(manager_.add_job(frame_of(0, {}), kSecond, 0));
  EXPECT_THROW(manager_.add_job(frame_of(0x7FF, {}), kSecond, 0), CommandError);
  EXPECT_THROW(manager_.subscribe(0x7FF, 0), CommandError);
}

// A busy bus: what is late by less than kCatchUp comes, older periods are counted.
TEST_F(SocketcandJobs, PeriodsThatAreTooLateAreLeftOutAndCounted) {
  manager_.add_job(frame_of(0x123, {}), 10 * kMillisecond, 0);
  now_ = 500 * kMillisecond;
  EXPECT_EQ(times(now_).size(), 11U);  // 400, 410 ... 500 ms
  EXPECT_EQ(manager_.missed(), 40U);   // 0, 10 ... 390 ms
}

TEST_F(SocketcandJobs, ASlowJobIsSentLateRatherThanNever) {
  manager_.add_job(frame_of(0x123, {}), kSecond, 0);
  now_ = 500 * kMillisecond;
  EXPECT_EQ(times(now_).size(), 1U);
  EXPECT_EQ(manager_.missed(), 0U);
}

class SocketcandFilters : public testing::Test {
 protected:
  // First data bytes of what a frame makes visible.
  std::vector<int> see(Time time, canid_t id, std::vector<unsigned char> data) {
    std::vector<PortMessage> out;
    manager_.receive({.frame = frame_of(id, std::move(data)), .time = time}, out);
    return first_bytes(out);
  }
  std::vector<int> release(Time time) {
    std::vector<PortMessage> out;
    manager_.release(time, out);
    return first_bytes(out);
  }
  static std::vector<int> first_bytes(const std::vector<PortMessage> &messages) {
    std::vector<int> bytes;
    for (const auto &message : messages) bytes.push_back(message.frame.data[0]);
    return bytes;
  }

  BroadcastManager manager_;
};

TEST_F(SocketcandFilters, NothingIsSeenWithoutASubscription) {
  EXPECT_THAT(see(0, 0x123, {1}), ElementsAre());
}

TEST_F(SocketcandFilters, ASubscriptionShowsAllOfItsIdAlone) {
  manager_.subscribe(0x123, 0);
  EXPECT_THAT(see(0, 0x123, {1}), ElementsAre(1));
  EXPECT_THAT(see(1, 0x123, {1}), ElementsAre(1));
  EXPECT_THAT(see(2, 0x124, {1}), ElementsAre());
  EXPECT_THAT(see(3, 0x123 | CAN_EFF_FLAG, {1}), ElementsAre());
  EXPECT_THAT(see(4, 0x123 | CAN_RTR_FLAG, {}), ElementsAre());
  manager_.unsubscribe(0x123);
  EXPECT_THAT(see(5, 0x123, {1}), ElementsAre());
}

// "< filter 0 0 123 8 FF 00 F8 00 00 00 00 00 >"
TEST_F(SocketcandFilters, AFilterShowsChangesUnderItsMask) {
  manager_.filter(0x123, 0, 0xFF00F80000000000U);
  EXPECT_THAT(see(0, 0x123, {1, 2, 0x08}), ElementsAre(1));  // the first one
  EXPECT_THAT(see(1, 0x123, {1, 9, 0x0F, 7}), ElementsAre());
  EXPECT_THAT(see(2, 0x123, {1, 9, 0x10}), ElementsAre(1));
  EXPECT_THAT(see(3, 0x123, {4, 9, 0x10}), ElementsAre(4));
  EXPECT_THAT(see(4, 0x123, {4}), ElementsAre(4));  // what is not there is 0
  EXPECT_THAT(see(5, 0x123, {4}), ElementsAre());
}

// The multiplex example of the protocol: ids 33 and ED in the first byte.
TEST_F(SocketcandFilters, AMuxFilterHasAMaskForEachValue) {
  manager_.mux_filter(0x123, 0, {0xFF00000000000000U, 0x33FFFFFFFFFFFFFFU, 0xED0000000000FFFFU});
  EXPECT_THAT(see(0, 0x123, {0x33, 1}), ElementsAre(0x33));
  EXPECT_THAT(see(1, 0x123, {0xED, 1}), ElementsAre(0xED));
  EXPECT_THAT(see(2, 0x123, {0x56, 1}), ElementsAre());
  EXPECT_THAT(see(3, 0x123, {0x33, 1}), ElementsAre());
  EXPECT_THAT(see(4, 0x123, {0xED, 2}), ElementsAre());
  EXPECT_THAT(see(5, 0x123, {0x33, 2}), ElementsAre(0x33));
  EXPECT_THAT(see(6, 0x123, {0xED, 2, 0, 0, 0, 0, 0, 1}), ElementsAre(0xED));
}

TEST_F(SocketcandFilters, AThrottleHoldsTheNewestBack) {
  manager_.subscribe(0x123, 10 * kMillisecond);
  EXPECT_THAT(see(kMillisecond, 0x123, {1}), ElementsAre(1));
  EXPECT_THAT(see(2 * kMillisecond, 0x123, {2}), ElementsAre());
  EXPECT_TRUE(manager_.awaits_time());
  EXPECT_THAT(see(3 * kMillisecond, 0x123, {3}), ElementsAre());
  EXPECT_THAT(release(10 * kMillisecond), ElementsAre());
  EXPECT_THAT(release(11 * kMillisecond), ElementsAre(3));
  EXPECT_FALSE(manager_.awaits_time());
  EXPECT_THAT(see(20 * kMillisecond, 0x123, {4}), ElementsAre());
  EXPECT_THAT(release(21 * kMillisecond), ElementsAre(4));
  EXPECT_THAT(see(40 * kMillisecond, 0x123, {5}), ElementsAre(5));
}

}  // namespace
}  // namespace vericansim
