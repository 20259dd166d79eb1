// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The follower of a time domain, frame by frame: what it does to the clock, whom it follows, how it
// measures the delay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "driver/domain_rig.hpp"
#include "driver/servo_model.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr std::uint64_t kR = 200'000'000;  // ns
using Writes = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// TM-82, TM-91: the rate whenever a pair is accepted, the shift as it is due, nothing otherwise. A
// step ends what is left of a slew.
Writes writes_of(const ServoModel::Outcome &outcome) {
  Writes writes;
  if ((outcome.events & VERICAN_SERVO_ACCEPTED) == 0) return writes;
  writes.emplace_back(0x1118, outcome.increment >> 32);
  writes.emplace_back(0x111C, static_cast<std::uint32_t>(outcome.increment));
  const auto shift = static_cast<std::uint64_t>(outcome.shift);
  if (shift == 0) return writes;
  if (outcome.slew) {
    writes.emplace_back(0x1128, static_cast<std::uint32_t>(shift));
  } else {
    writes.emplace_back(0x1128, 0);
    writes.emplace_back(0x1120, static_cast<std::uint32_t>(shift));
    writes.emplace_back(0x1124, shift >> 32);
  }
  return writes;
}

// TM-80, TM-82, TM-91: SYNC and FUP in, register accesses out, beside the model of the servo.
TEST(Follower, WritesWhatTheServoWants) {
  unsigned none = 0, ones = 0, slews = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 dice{seed};
    verican_tsyn_config_t config = DomainRig::config_of();
    config.servo.filter = static_cast<std::uint8_t>(seed % 3 == 0 ? 0 : 1u << seed % 5);
    config.servo.delay_ns = 300;
    std::vector<unsigned> events;
    config.user = &events;
    config.on_event = [](void *user, verican_tsyn_t *, std::uint8_t event) {
      static_cast<std::vector<unsigned> *>(user)->push_back(event);
    };
    DomainRig rig{config, false};
    ServoModel model{config.servo};
    std::uint64_t increment = 0x3E'8000'0000, stamp = rig.time;
    std::int64_t shift = 0;
    for (unsigned n = 0; n < 60; ++n) {
      const std::uint64_t far = n == 0 ? 77 * kRigSecond : dice() % 20 == 0 ? 4'000 : dice() % 60;
      const std::uint64_t master = stamp - kRigLate - 300 + far - 30;
      const std::uint64_t now = stamp + 500'000;
      rig.clock_writes.clear();
      ASSERT_EQ(rig.hear(0x010, sync_of(n % 16, master / kRigSecond), stamp), VERICAN_OK);
      ASSERT_THAT(rig.clock_writes, IsEmpty());
      rig.set_time(now);
      ASSERT_EQ(rig.hear(0x010, fup_of(n % 16, master % kRigSecond), stamp + 300'000), VERICAN_OK);
      const auto expected = model.take({stamp, master, now, increment, 3});
      ASSERT_THAT(rig.clock_writes, ElementsAreArray(writes_of(expected))) << seed << " " << n;
      ASSERT_EQ(events.size(), n + 1);
      ASSERT_EQ(events.back(), expected.events);
      increment = expected.increment;
      if (expected.shift != 0) shift = expected.shift;
      none += expected.shift == 0 ? 1 : 0;
      ones += std::abs(expected.shift) == 1 ? 1 : 0;
      slews += expected.slew && expected.shift != 0 ? 1 : 0;
      const std::uint64_t moved = now + static_cast<std::uint64_t>(expected.shift);
      rig.set_time(moved);
      const auto status = rig.status();
      ASSERT_EQ(status.state, model.state);
      ASSERT_EQ(status.filter, model.filter());
      ASSERT_EQ(status.shift_ns, shift);
      ASSERT_EQ(status.bound_ns, model.bound(moved));
      ASSERT_EQ(status.delay_ns, 300);
      ASSERT_EQ(status.master, 0);
      ASSERT_FALSE(status.sending);
      ASSERT_EQ(rig.core.depth, 0u);
      stamp = moved + kR - 500'000;
    }
  }
  EXPECT_GT(none, 50u);
  EXPECT_GT(ones, 50u);
  EXPECT_GT(slews, 500u);
}

// A pair at its stamp, the clock `ahead` ns; 94 are what the stamp is late by, to the nearest, so
// that a clock that is right is not corrected.
void pair(DomainRig &rig, unsigned sc, std::uint64_t stamp, std::uint32_t id = 0x010,
          std::uint64_t ahead = 0) {
  const std::uint64_t master = stamp - 94 - ahead;
  rig.hear(id, sync_of(sc, master / kRigSecond), stamp);
  rig.set_time(stamp + 400'000);
  rig.hear(id, fup_of(sc, master % kRigSecond), stamp + 300'000);
}

// TM-53, TM-82: the clock steps between two SYNCs: it is as long as before since the last one, be
// the step forward or back.
TEST(Follower, StepIsNoSilence) {
  for (const std::int64_t step : {1'000, -1'000}) {
    verican_tsyn_config_t config = DomainRig::config_of();
    config.rules.jump_width = 1;
    DomainRig rig{config, false, 5'000 * kRigSecond};
    const std::uint64_t stamp = rig.time;
    const auto ahead = static_cast<std::uint64_t>(-step) * kRigSecond;
    pair(rig, 3, stamp, 0x010, ahead);
    const std::uint64_t last = stamp - ahead;  // by the clock that has stepped
    EXPECT_EQ(rig.refused(VERICAN_TSYN_SC), 0u);
    rig.hear(0x010, sync_of(9, 1), last + 3 * kR);
    EXPECT_EQ(rig.refused(VERICAN_TSYN_SC), 1u) << step;
    rig.hear(0x010, sync_of(9, 1), last + 3 * kR + 1);
    EXPECT_EQ(rig.refused(VERICAN_TSYN_SC), 1u) << step;
  }
}

// TM-89: nor is it one of the masters.
TEST(Follower, StepIsNoLossOfTheMaster) {
  DomainRig rig{DomainRig::config_of(2, 1), true, 5'000 * kRigSecond};
  rig.poll_at(rig.time + 100);
  const std::uint64_t stamp = rig.time;
  pair(rig, 3, stamp, 0x010, static_cast<std::uint64_t>(-1'000) * kRigSecond);
  const std::uint64_t last = stamp + 1'000 * kRigSecond;
  rig.poll_at(last + 3 * kR + kR / 2);
  EXPECT_FALSE(rig.status().sending);
  rig.poll_at(last + 3 * kR + kR / 2 + 1);
  EXPECT_TRUE(rig.status().sending);
}

// TM-87: nor does a clock that somebody sets back keep holdover away: it comes when no pair has
// been accepted for three intervals, as ever.
TEST(Follower, HoldoverOfAClockThatIsSetBack) {
  verican_tsyn_config_t config = DomainRig::config_of();
  config.servo.filter = 1;
  DomainRig rig{config, false};
  std::uint64_t now = rig.time;
  for (unsigned n = 0; n < 4; ++n) pair(rig, n, now += kR);
  rig.poll_at(now);
  ASSERT_EQ(rig.status().state, VERICAN_SYNC_LOCKED);
  now -= 30 * kRigSecond;
  rig.poll_at(now);
  rig.poll_at(now + 2 * kR);
  EXPECT_EQ(rig.status().state, VERICAN_SYNC_LOCKED);
  rig.poll_at(now + 3 * kR + 1);
  EXPECT_EQ(rig.status().state, VERICAN_SYNC_HOLDOVER);
}

// TM-53: three intervals of silence, or as many as are configured, and the counter begins anew.
TEST(Follower, CounterBehindSilence) {
  verican_tsyn_config_t config = DomainRig::config_of();
  config.rules.jump_width = 1;
  config.servo.hold_after = 5;
  DomainRig rig{config, false};
  const std::uint64_t stamp = rig.time;
  pair(rig, 3, stamp);
  rig.hear(0x010, sync_of(9, 1), stamp + 5 * kR);
  EXPECT_EQ(rig.refused(VERICAN_TSYN_SC), 1u);
  rig.hear(0x010, sync_of(9, 1), stamp + 5 * kR + 1);
  EXPECT_EQ(rig.refused(VERICAN_TSYN_SC), 1u);
}

// TM-89: a better master: its counter is its own, what the other one began is forgotten, and so is
// the history.
TEST(Follower, ABetterMaster) {
  verican_tsyn_config_t config = DomainRig::config_of(3, 0);
  config.rules.jump_width = 1;
  DomainRig rig{config, false};
  std::uint64_t stamp = rig.time;
  pair(rig, 3, stamp, 0x011);
  pair(rig, 4, stamp += kR, 0x011);
  EXPECT_EQ(rig.status().master, 1);
  EXPECT_EQ(rig.tsyn.servo.count, 2);
  rig.hear(0x011, sync_of(5, 1), stamp += kR);
  pair(rig, 12, stamp += 1'000'000, 0x010);
  EXPECT_EQ(rig.status().master, 0);
  EXPECT_EQ(rig.tsyn.servo.count, 1);
  rig.hear(0x011, fup_of(5, 1), stamp + 400'000);  // nobody's any more
  rig.hear(0x012, sync_of(5, 1), stamp + 500'000);
  EXPECT_EQ(rig.status().master, 0);
  for (const unsigned refused : rig.status().refused) EXPECT_EQ(refused, 0u);
  // The other one is heard again when this one is silent for 3 R.
  rig.hear(0x011, sync_of(9, 1), stamp + 3 * kR);
  EXPECT_EQ(rig.status().master, 0);
  rig.hear(0x011, sync_of(9, 1), stamp + 3 * kR + 1);
  EXPECT_EQ(rig.status().master, 1);
}

// TM-54, TM-91: the status tells each cause apart, and the sub-domain.
TEST(Follower, StatusTellsTheCauses) {
  verican_tsyn_config_t config = DomainRig::config_of();
  config.rules.jump_width = 1;
  config.rules.fup_timeout_us = 1000;
  config.rules.crc = VERICAN_TSYN_CRC_OPTIONAL;
  DomainRig rig{config, false};
  const std::uint64_t stamp = rig.time;
  const auto times = [](unsigned count, const auto &what) {
    for (unsigned n = 0; n < count; ++n) what();
  };
  rig.hear(0x010, sync_of(0, 1), stamp);  // from now on it is followed
  times(1, [&] { rig.hear(0x010, message(0x11, 0, 0, 0, 0), stamp); });
  times(2, [&] { rig.hear(0x010, message(0x20, 0, 0, 0, 0), stamp); });  // nobody has its ids
  times(3, [&] { rig.hear(0x010, sync_of(0, 1, 5), stamp); });
  times(4, [&] { rig.hear(0x010, sync_of(7, 1), stamp); });
  rig.hear(0x010, fup_of(0, 1), stamp + 1'000'001);
  times(6, [&] { rig.hear(0x010, fup_of(0, 1), stamp); });
  times(7, [&] { rig.hear(0x010, message(0x34, 0, 0, 0, 0), stamp); });
  EXPECT_THAT(rig.status().refused, ElementsAre(1, 2, 3, 4, 1, 6, 7));
  EXPECT_FALSE(rig.status().sub_domain);
  rig.hear(0x010, sync_of(1, 1), stamp + kR);
  rig.hear(0x010, message(0x18, 0, 1, 4, 5), stamp + kR);
  EXPECT_TRUE(rig.status().sub_domain);
  EXPECT_EQ(verican_tsyn_start_follower(&rig.tsyn), VERICAN_OK);  // begins anew
  EXPECT_THAT(rig.status().refused, ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_EQ(rig.status().master, VERICAN_MASTER_NONE);
}

// Identifiers of 11 and of 29 bits are different ones; a remote frame is no message.
TEST(Follower, Identifiers) {
  verican_tsyn_config_t config = DomainRig::config_of();
  config.masters[0] = 0x010u | VERICAN_TSYN_EXTENDED;
  DomainRig rig{config, false};
  EXPECT_EQ(rig.hear(0x010, sync_of(0, 1), rig.time), VERICAN_ERR_EMPTY);
  EXPECT_EQ(rig.hear(0x010, sync_of(0, 1), rig.time, 8, VERICAN_FRAME_EXTENDED), VERICAN_OK);
  EXPECT_EQ(rig.status().master, 0);
  EXPECT_EQ(rig.refused(VERICAN_TSYN_TYPE), 0u);
  rig.hear(0x010, sync_of(1, 1), rig.time, 8, VERICAN_FRAME_EXTENDED | VERICAN_FRAME_REMOTE);
  EXPECT_EQ(rig.refused(VERICAN_TSYN_TYPE), 1u);
}

verican_tsyn_config_t with_delay(std::uint8_t masters = 1) {
  verican_tsyn_config_t config = DomainRig::config_of(masters);
  config.delay_request = 0x020;
  config.delay_response = 0x1234'5678u | VERICAN_TSYN_EXTENDED;
  return config;
}

FrameData time_of(std::uint64_t time) {
  FrameData data{};
  for (unsigned i = 0; i < 8; ++i) data.at(i) = static_cast<std::uint8_t>(time >> (56 - 8 * i));
  return data;
}

// TM-58: a request behind each pair; by hand: the clock was 700 ns ahead when SYNC came and is
// right behind it, the request took 400 ns: (700 - 700 + 400) / 2; the second one 600 ns: 200 and
// 300.
TEST(Follower, MeasuresTheDelay) {
  DomainRig rig{with_delay(), false};
  std::uint64_t stamp = rig.time;
  pair(rig, 0, stamp, 0x010, 5'000);
  EXPECT_THAT(rig.waiting(), IsEmpty());  // nobody has asked
  EXPECT_EQ(verican_tsyn_measure(&rig.tsyn, 2), VERICAN_OK);
  stamp += kR - 5'000;
  for (const std::uint64_t way : {400u, 600u}) {
    rig.clock_writes.clear();
    pair(rig, way == 400 ? 1 : 2, stamp, 0x010, way == 400 ? 700 : 0);
    EXPECT_EQ(rig.core.depth, 0u);
    const auto requests = rig.waiting();
    ASSERT_EQ(requests.size(), 1u);
    EXPECT_EQ(requests[0].id, 0x020u);
    EXPECT_EQ(requests[0].dlc, 0u);
    EXPECT_EQ(rig.status().delay_ns, 0);
    // What is left of the offset is in the way forth, and 1 ns of the stamp, cut to 93.
    std::int64_t left = way == 400 ? 701 : 1;
    for (const auto &[offset, value] : rig.clock_writes)
      if (offset == 0x1120 || offset == 0x1128) left += static_cast<std::int32_t>(value);
    const std::uint64_t out = stamp + 2'000'000;
    rig.sent(requests[0].mailbox, out + kRigSentLate);
    EXPECT_EQ(rig.last_told, VERICAN_OK);
    const std::uint64_t master = out + way - static_cast<std::uint64_t>(left);
    const std::uint32_t id = 0x1234'5678;
    EXPECT_EQ(rig.hear(id, time_of(9), stamp, 7, VERICAN_FRAME_EXTENDED), VERICAN_ERR_EMPTY);
    EXPECT_EQ(rig.hear(id, {}, stamp, 8, VERICAN_FRAME_EXTENDED | VERICAN_FRAME_REMOTE),
              VERICAN_ERR_EMPTY);
    EXPECT_EQ(rig.hear(id, time_of(master), stamp, 8, VERICAN_FRAME_EXTENDED), VERICAN_OK);
    stamp += kR;
  }
  EXPECT_EQ(rig.status().delay_ns, (200 + 300) / 2);
  pair(rig, 3, stamp);
  EXPECT_THAT(rig.waiting(), IsEmpty());  // done
}

// TM-58: other frames of the node end nothing, nor does a request that failed; the next pair asks
// again. A pair that is not accepted asks for nothing.
TEST(Follower, RequestThatFails) {
  verican_tsyn_config_t config = with_delay();
  config.servo.filter = 1;
  DomainRig rig{config, false};
  verican_tsyn_measure(&rig.tsyn, 1);
  const std::uint64_t stamp = rig.time;
  pair(rig, 0, stamp);
  unsigned request = rig.waiting().at(0).mailbox;
  const std::uint32_t id = 0x1234'5678;
  verican_frame_t frame{};
  frame.id = 0x300;
  std::uint8_t other = 0;
  ASSERT_EQ(verican_send(&rig.dev, &frame, &other), VERICAN_OK);
  rig.sent(other, stamp);
  EXPECT_EQ(rig.last_told, VERICAN_ERR_EMPTY);
  rig.failed(request);
  EXPECT_EQ(rig.last_told, VERICAN_OK);
  rig.hear(id, time_of(stamp), stamp, 8, VERICAN_FRAME_EXTENDED);
  EXPECT_EQ(rig.status().delay_ns, 0);
  EXPECT_TRUE(rig.tsyn.delay.wanted == 1);
  ASSERT_EQ(verican_send(&rig.dev, &frame, &other), VERICAN_OK);
  EXPECT_EQ(other, request);  // the mailbox of a request that is over is anybody's
  rig.sent(other, stamp);
  EXPECT_EQ(rig.last_told, VERICAN_ERR_EMPTY);
  for (unsigned n = 1; n < 6; ++n) {
    pair(rig, n, stamp + n * kR);
    request = rig.waiting().at(0).mailbox;
    rig.failed(request);
  }
  pair(rig, 6, stamp + 6 * kR, 0x010, 50'000'000);  // a leap
  EXPECT_THAT(rig.waiting(), IsEmpty());
  rig.fill();
  pair(rig, 7, stamp + 7 * kR);  // no mailbox
  EXPECT_FALSE(rig.tsyn.delaying);
  EXPECT_EQ(rig.core.depth, 0u);
}

// TM-58: a request that still waits for the bus is that of the next pair, too: answers to two could
// not be told from each other.
TEST(Follower, RequestThatWaits) {
  DomainRig rig{with_delay(), false};
  verican_tsyn_measure(&rig.tsyn, 1);
  std::uint64_t stamp = rig.time;
  for (unsigned n = 0; n < 3; ++n) {
    if (n != 0) stamp += kR;
    pair(rig, n, stamp);
    ASSERT_EQ(rig.waiting().size(), 1u) << n;
  }
  const std::uint64_t out = stamp + 2'000'000;
  rig.sent(rig.waiting().at(0).mailbox, out + kRigSentLate);
  rig.hear(0x1234'5678, time_of(out + 600), stamp, 8, VERICAN_FRAME_EXTENDED);
  EXPECT_NEAR(rig.status().delay_ns, 300, 1);
}

// Of a request that waited when the device was initialised anew nobody hears: the next pair asks
// again.
TEST(Follower, RequestThatIsGoneWithTheDevice) {
  DomainRig rig{with_delay(), false};
  verican_tsyn_measure(&rig.tsyn, 1);
  std::uint64_t stamp = rig.time;
  pair(rig, 0, stamp);
  ASSERT_EQ(rig.waiting().size(), 1u);
  rig.start_device();
  ASSERT_THAT(rig.waiting(), IsEmpty());
  stamp += kR;
  pair(rig, 1, stamp);
  ASSERT_EQ(rig.waiting().size(), 1u);
  const std::uint64_t out = stamp + 2'000'000;
  rig.sent(rig.waiting().at(0).mailbox, out + kRigSentLate);
  rig.hear(0x1234'5678, time_of(out + 600), stamp, 8, VERICAN_FRAME_EXTENDED);
  EXPECT_NEAR(rig.status().delay_ns, 300, 1);
}

// TM-58: only who is the master answers, with the time of the request.
TEST(Follower, OnlyTheMasterAnswers) {
  DomainRig follower{with_delay(), false};
  EXPECT_EQ(follower.hear(0x020, {}, 77 + kRigLate, 0), VERICAN_ERR_EMPTY);
  EXPECT_THAT(follower.waiting(), IsEmpty());
  DomainRig master{with_delay(), true};
  const std::uint64_t time = 0x0123'4567'89AB'CDEF;
  EXPECT_EQ(master.hear(0x020, {}, time + kRigLate, 0), VERICAN_OK);
  const auto responses = master.waiting();
  ASSERT_EQ(responses.size(), 1u);
  EXPECT_EQ(responses[0].id, 0x1234'5678u | VERICAN_TSYN_EXTENDED);
  EXPECT_EQ(responses[0].dlc, 8u);
  EXPECT_EQ(responses[0].data, time_of(time));
}

}  // namespace
}  // namespace vericansim
