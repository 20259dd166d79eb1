// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Delay of the bus by the way back, the messages of IEEE 1588 over CAN (P4), and who of several
// masters is heard.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "verican/delay.h"
#include "verican/tsyn.h"

namespace vericansim {
namespace {

using Data = std::array<std::uint8_t, 8>;

// One exchange on a bus with these delays, the follower's clock ahead by `offset` and then shifted.
bool exchange(verican_delay_t &delay, std::int64_t forth, std::int64_t back, std::int64_t offset,
              std::int64_t shift, std::int32_t &result) {
  const std::int64_t sync = 1'000'000, request = 8'000'000;
  verican_sync_pair_t pair{};
  pair.master = static_cast<std::uint64_t>(sync);
  pair.local = static_cast<std::uint64_t>(sync + forth + offset);
  if (!verican_delay_pair(&delay, &pair, shift)) return false;
  verican_delay_sent(&delay, static_cast<std::uint64_t>(request + offset + shift));
  return verican_delay_response(&delay, static_cast<std::uint64_t>(request + back), &result);
}

// TM-58: the same both ways: the delay, whatever the clocks are; the mean of eight is to the
// nearest.
TEST(DelayMeasure, Symmetric) {
  for (const std::int64_t offset : {0, 700, -90'000'000}) {
    verican_delay_t delay{};
    ASSERT_EQ(verican_delay_start(&delay, 8), VERICAN_OK);
    std::int32_t result = -1;
    for (int n = 0; n < 7; ++n) {
      EXPECT_FALSE(exchange(delay, 200 + n, 200 + n, offset, 35 - offset, result));
    }
    EXPECT_EQ(result, -1);
    EXPECT_TRUE(exchange(delay, 207, 207, offset, 0, result));
    EXPECT_EQ(result, 204);                                  // 203.5
    EXPECT_FALSE(exchange(delay, 1, 1, offset, 0, result));  // nobody asked
  }
}

// TM-58: half of what the ways differ stays in it. A clock that is ahead by more than the delay is
// long makes sums below zero.
TEST(DelayMeasure, Asymmetric) {
  verican_delay_t delay{};
  std::int32_t result = 0;
  verican_delay_start(&delay, 1);
  EXPECT_TRUE(exchange(delay, 300, 100, 5'000, 0, result));
  EXPECT_EQ(result, 200);
  verican_delay_start(&delay, 1);
  EXPECT_TRUE(exchange(delay, -301, 0, 0, 0, result));
  EXPECT_EQ(result, -151);  // -150.5
}

// TM-58: quantised by one clock of 62.5 ns at each of the two receivers, eight exchanges scatter by
// 0.07 T.
TEST(DelayMeasure, MeanOfEight) {
  std::mt19937_64 dice{58};
  std::uniform_real_distribution<double> within{-31.25, 31.25};
  double squares = 0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    verican_delay_t delay{};
    std::int32_t result = 0;
    verican_delay_start(&delay, 8);
    for (int n = 0; n < 8; ++n)
      exchange(delay, std::llround(500 + within(dice)), std::llround(500 + within(dice)), 0, 0,
               result);
    squares += (result - 500.0) * (result - 500.0);
  }
  EXPECT_LE(std::sqrt(squares / kRuns), 0.075 * 62.5);
}

// TM-58: responses to others, or without a request, count for nothing.
TEST(DelayMeasure, OutOfTurn) {
  verican_delay_t delay{};
  std::int32_t result = 0;
  EXPECT_FALSE(verican_delay_response(&delay, 1, &result));
  verican_delay_sent(&delay, 1);
  EXPECT_FALSE(verican_delay_response(&delay, 1, &result));
  verican_delay_start(&delay, 1);
  const verican_sync_pair_t pair{};
  EXPECT_TRUE(verican_delay_pair(&delay, &pair, 0));
  EXPECT_FALSE(verican_delay_response(&delay, 1, &result));  // not sent yet
  EXPECT_EQ(verican_delay_start(nullptr, 8), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_delay_start(&delay, 0), VERICAN_ERR_RANGE);
}

// TM-58: who answers late answers an older request: the master had that one before it sent the SYNC
// of the pair. The answer to the newer one still counts. One second between two pairs.
TEST(DelayMeasure, AnswerToAnOlderRequest) {
  constexpr std::uint64_t kSecond = 1'000'000'000, kDelay = 250;
  for (const std::int64_t ahead : {0LL, 700LL, -90'000'000LL}) {  // of the own clock
    const auto own = [&](std::uint64_t t) { return t + static_cast<std::uint64_t>(ahead); };
    verican_delay_t delay{};
    verican_delay_start(&delay, 1);
    std::int32_t result = -1;
    for (std::uint64_t n = 1; n <= 3; ++n) {  // no answer
      const verican_sync_pair_t pair{.local = own(n * kSecond + kDelay),
                                     .master = n * kSecond,
                                     .now = 0,
                                     .increment = 0,
                                     .latency = 0};
      ASSERT_TRUE(verican_delay_pair(&delay, &pair, 0));
      verican_delay_sent(&delay, own(n * kSecond + 8'000'000));
    }
    for (std::uint64_t n = 1; n <= 2; ++n)
      EXPECT_FALSE(verican_delay_response(&delay, n * kSecond + 8'000'000 + kDelay, &result));
    EXPECT_EQ(result, -1);
    EXPECT_TRUE(verican_delay_response(&delay, 3 * kSecond + 8'000'000 + kDelay, &result));
    EXPECT_EQ(result, 250);
  }
}

// TM-58: a request that went between SYNC and FUP is answered behind that SYNC, too: until the next
// pair there is no other one.
TEST(DelayMeasure, RequestBetweenSyncAndFup) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  verican_delay_t delay{};
  verican_delay_start(&delay, 2);
  verican_sync_pair_t pair{};
  const auto ask = [&](std::uint64_t at) {
    pair.master = at;
    pair.local = at + 300;
    return verican_delay_pair(&delay, &pair, 0);
  };
  std::int32_t result = -1;
  ASSERT_TRUE(ask(kSecond));
  verican_delay_sent(&delay, 2 * kSecond + 1'000);
  EXPECT_FALSE(ask(2 * kSecond));
  EXPECT_FALSE(verican_delay_response(&delay, 2 * kSecond + 1'300, &result));
  EXPECT_TRUE(ask(3 * kSecond));
  verican_delay_sent(&delay, 3 * kSecond + 1'000);
  EXPECT_TRUE(verican_delay_response(&delay, 3 * kSecond + 1'300, &result));
  EXPECT_EQ(result, 300);
}

// TM-58: an exchange whose mean no delay can be, because of a response that is none or a clock that
// was set meanwhile, does not count; those behind it do.
TEST(DelayMeasure, WhatCannotBe) {
  constexpr std::int64_t kMost = INT32_MAX, kLeast = INT32_MIN;
  for (const std::int64_t wrong : {INT64_MAX, INT64_MIN, kMost << 32, kMost + 1, kLeast - 1}) {
    verican_delay_t delay{};
    verican_delay_start(&delay, 3);
    std::int32_t result = -1;
    verican_sync_pair_t pair{};
    const auto response = [&](std::uint64_t master) {
      pair.local += 1'000'000'000;
      pair.master += 1'000'000'000;
      EXPECT_TRUE(verican_delay_pair(&delay, &pair, 1'000));  // forth
      verican_delay_sent(&delay, pair.local + 8'000'000);
      return verican_delay_response(&delay, pair.master + master, &result);
    };
    EXPECT_FALSE(response(8'001'000));
    for (int n = 0; n < 3; ++n)
      EXPECT_FALSE(response(static_cast<std::uint64_t>(wrong) + 7'999'000)) << wrong;
    EXPECT_FALSE(response(8'001'000));
    EXPECT_TRUE(response(8'001'000)) << wrong;
    EXPECT_EQ(result, 1'000) << wrong;
  }
}

// TM-58: the longest that can be measured, as often as can be.
TEST(DelayMeasure, TheLongest) {
  for (const std::int64_t sum : {INT32_MAX, INT32_MIN}) {
    verican_delay_t delay{};
    verican_delay_start(&delay, 255);
    std::int32_t result = 0;
    for (int n = 1; n <= 255; ++n) EXPECT_EQ(exchange(delay, sum - 7, 7, 0, 0, result), n == 255);
    EXPECT_EQ(result, sum > 0 ? 0x4000'0000 : -0x4000'0000);
  }
}

// TM-80: cable of 40 m, transceivers of 150 ns.
TEST(DelayMeasure, OfCable) {
  EXPECT_EQ(verican_delay_of_cable(40, 150), 350);
  EXPECT_EQ(verican_delay_of_cable(0xFFFF, 0xFFFF), 6 * 0xFFFF);
}

// TM-57: times are 64 bits, big-endian.
TEST(P4Messages, Times) {
  Data data{};
  verican_p4_write_time(0x0123'4567'89AB'CDEF, data.data());
  EXPECT_EQ(data, (Data{0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF}));
  EXPECT_EQ(verican_p4_read_time(data.data()), 0x0123'4567'89AB'CDEFu);
  EXPECT_EQ(verican_p4_read_time(Data{0xFF, 0, 0, 0, 0, 0, 0, 1}.data()), 0xFF00'0000'0000'0001u);
}

// TM-57: an exchange of the third follower: 15 ms behind FollowUp the request, 2 ms behind the
// response the report; delay 250 ns, the clock 40 us ahead.
TEST(P4Messages, Exchange) {
  constexpr std::uint64_t kMs = 1'000'000;
  constexpr std::int64_t kAhead = 40'000;
  verican_p4_t p4{};
  p4.number = 3;
  Data data{}, out{};
  verican_p4_on_sync(&p4, 100 * kMs + 250 + kAhead);
  verican_p4_write_time(100 * kMs, data.data());
  const std::uint64_t followed = 101 * kMs + kAhead;
  // The delay is not known yet: the offset has it in itself.
  EXPECT_EQ(verican_p4_on_follow_up(&p4, data.data(), followed), kAhead + 250);
  verican_p4_shifted(&p4, -(kAhead + 250));
  const std::uint64_t due = 116 * kMs - 250;  // by the corrected clock
  EXPECT_EQ(verican_p4_poll(&p4, due - 1, out.data()), 0u);
  EXPECT_EQ(verican_p4_poll(&p4, due, out.data()), 0x003u);
  EXPECT_EQ(verican_p4_poll(&p4, due + kMs, out.data()), 0u);  // once
  // Sent at 117 ms of the master's time, 250 ns less by this clock; 250 ns later it is there.
  verican_p4_on_sent(&p4, 117 * kMs - 250);
  verican_p4_write_time(117 * kMs + 250, data.data());
  EXPECT_TRUE(verican_p4_on_response(&p4, data.data(), 118 * kMs));
  EXPECT_EQ(p4.delay, 250);
  EXPECT_FALSE(verican_p4_on_response(&p4, data.data(), 118 * kMs));  // of another follower
  EXPECT_EQ(verican_p4_poll(&p4, 120 * kMs - 1, out.data()), 0u);
  EXPECT_EQ(verican_p4_poll(&p4, 120 * kMs, out.data()), 0x005u);
  EXPECT_EQ(out, (Data{0, 0, 0, 250, 0, 0, 0x9D, 0x3A}));  // 40,250
  // The next Sync: the delay is known, the rest is what the clock was wrong by.
  verican_p4_on_sync(&p4, 1100 * kMs + 250 - 250);
  verican_p4_write_time(1100 * kMs, data.data());
  EXPECT_EQ(verican_p4_on_follow_up(&p4, data.data(), 1101 * kMs), -250);
}

// TM-57: once the offset is corrected, the delay is (TM2 - TS2) / 2 if it was taken for 0.
TEST(P4Messages, DelayAfterCorrection) {
  std::mt19937_64 dice{57};
  for (int n = 0; n < 1000; ++n) {
    verican_p4_t p4{};
    p4.number = 1;
    const std::uint64_t tm1 = dice() >> 2, ts1 = tm1 + dice() % 1'000'000 - 500'000;
    const std::uint64_t ts2 = tm1 + 9'000'000, tm2 = ts2 + dice() % 5'000;
    Data data{};
    verican_p4_on_sync(&p4, ts1);
    verican_p4_write_time(tm1, data.data());
    verican_p4_shifted(&p4, -verican_p4_on_follow_up(&p4, data.data(), ts1));
    verican_p4_on_sent(&p4, ts2);
    verican_p4_write_time(tm2, data.data());
    ASSERT_TRUE(verican_p4_on_response(&p4, data.data(), tm2));
    ASSERT_EQ(p4.delay, static_cast<std::int32_t>((tm2 - ts2 + 1) / 2));
  }
}

constexpr std::uint64_t kR = 1'000'000'000;

// TM-89: the best that was heard in the last three intervals is followed.
TEST(Masters, TheBestHeardOfLate) {
  verican_masters_t masters{};
  verican_masters_start(&masters, 1'000'000, 0);
  EXPECT_FALSE(verican_masters_alive(&masters, 0));
  EXPECT_TRUE(verican_masters_hear(&masters, 2, kR));
  EXPECT_TRUE(verican_masters_hear(&masters, 1, kR + 5));
  EXPECT_FALSE(verican_masters_hear(&masters, 2, 2 * kR));
  EXPECT_FALSE(verican_masters_hear(&masters, 3, 4 * kR + 5));
  EXPECT_TRUE(verican_masters_hear(&masters, 2, 4 * kR + 6));  // 1 is silent
  EXPECT_TRUE(verican_masters_hear(&masters, 0, 4 * kR + 7));
  EXPECT_TRUE(verican_masters_alive(&masters, 7 * kR + 7));
  EXPECT_FALSE(verican_masters_alive(&masters, 7 * kR + 8));
}

// TM-89: candidates begin one after the other, the best first, also when nobody was heard at all.
TEST(Masters, CandidatesWaitByRank) {
  for (std::uint8_t rank = 0; rank < VERICAN_MASTERS; ++rank) {
    verican_masters_t masters{};
    verican_masters_start(&masters, 1'000'000, 100 * kR);
    const std::uint64_t wait = 3 * kR + rank * kR / 2;
    EXPECT_FALSE(verican_masters_may_send(&masters, rank, 100 * kR + wait));
    EXPECT_TRUE(verican_masters_may_send(&masters, rank, 100 * kR + wait + 1));
    if (rank == 0) continue;
    verican_masters_hear(&masters, 0, 110 * kR);
    verican_masters_hear(&masters, 3, 120 * kR);  // a worse one is no reason to wait
    EXPECT_FALSE(verican_masters_may_send(&masters, rank, 110 * kR + wait));
    EXPECT_EQ(verican_masters_may_send(&masters, rank, 110 * kR + wait + 1), true);
  }
}

// TM-89: who begins anew has heard nobody.
TEST(Masters, StartForgets) {
  verican_masters_t masters{};
  verican_masters_start(&masters, 1'000'000, 0);
  verican_masters_hear(&masters, 0, kR);
  verican_masters_start(&masters, 1'000'000, kR);
  EXPECT_FALSE(verican_masters_alive(&masters, kR));
  EXPECT_TRUE(verican_masters_hear(&masters, 3, kR));
}

// TM-89: a step of the own clock does not change how long ago something was.
TEST(Masters, OwnClockSteps) {
  for (const std::int64_t shift : {std::int64_t{1'700'000'000} * 1'000'000'000, -std::int64_t{5}}) {
    verican_masters_t masters{};
    verican_masters_start(&masters, 1'000'000, 10 * kR);
    verican_masters_hear(&masters, 0, 11 * kR);
    verican_masters_shift(&masters, shift);
    const std::uint64_t later = 14 * kR + static_cast<std::uint64_t>(shift);
    EXPECT_TRUE(verican_masters_alive(&masters, later));
    EXPECT_FALSE(verican_masters_alive(&masters, later + 1));
    EXPECT_FALSE(verican_masters_may_send(&masters, 1, later + kR / 2));
    EXPECT_TRUE(verican_masters_may_send(&masters, 1, later + kR / 2 + 1));
  }
}

}  // namespace
}  // namespace vericansim
