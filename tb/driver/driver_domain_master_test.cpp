// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The master of a time domain, frame by frame and to the ns: when SYNC and FUP go out, when it
// gives up, when a candidate begins and ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "driver/domain_rig.hpp"

namespace vericansim {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::uint64_t kR = 200'000'000;  // ns
constexpr std::uint64_t kStart = 50 * kRigSecond + 123;

DomainRig::Waiting only(DomainRig &rig) {
  const auto all = rig.waiting();
  EXPECT_THAT(all, SizeIs(1));
  return all.empty() ? DomainRig::Waiting{} : all.front();
}

// A pair of another master, the own clock right; 94 is what the stamp is late by.
void pair(DomainRig &rig, std::uint32_t id, unsigned sc, std::uint64_t stamp) {
  const std::uint64_t master = stamp - 94;
  rig.hear(id, sync_of(sc, master / kRigSecond), stamp);
  rig.set_time(stamp + 400'000);
  rig.hear(id, fup_of(sc, master % kRigSecond), stamp + 300'000);
}

// TM-50: SYNC every R from the start on, not 1 ns sooner; FUP as soon as SYNC was sent, with its
// counter and the time that the stamp tells.
TEST(Master, SyncAndFup) {
  verican_tsyn_config_t config = DomainRig::config_of();
  config.masters[0] = 0x0ABC'DEF0u | VERICAN_TSYN_EXTENDED;
  config.rules.domain = 6;
  DomainRig rig{config, true, kStart};
  for (unsigned n = 0; n < 20; ++n) {
    const std::uint64_t due = kStart + n * kR;
    rig.poll_at(due - 1);
    EXPECT_THAT(rig.waiting(), IsEmpty());
    rig.poll_at(due);
    const auto sync = only(rig);
    EXPECT_EQ(sync.id, 0x0ABC'DEF0u | VERICAN_TSYN_EXTENDED);
    EXPECT_EQ(sync.dlc, 8u);
    EXPECT_EQ(sync.data, sync_of(n % 16, due / kRigSecond, 6));
    const std::uint64_t t1 = due + 1'300'000 + n;
    rig.sent(sync.mailbox, t1 + kRigSentLate);
    EXPECT_EQ(rig.last_told, VERICAN_OK);
    const auto fup = only(rig);
    EXPECT_EQ(fup.id, sync.id);
    EXPECT_EQ(fup.data, fup_of(n % 16, t1 - due / kRigSecond * kRigSecond, 6));
    rig.poll_at(t1 + 1'000'000);
    EXPECT_THAT(rig.waiting(), SizeIs(1));  // FUP goes out once
    rig.sent(fup.mailbox, t1 + 2'000'000);
    EXPECT_EQ(rig.last_told, VERICAN_ERR_EMPTY);  // nothing depends on when it was sent
    EXPECT_EQ(rig.core.depth, 0u);
  }
}

// TM-50: a poll that comes late by R at most keeps the rhythm, one that is later begins a new one.
TEST(Master, LatePolls) {
  const auto next = [](std::uint64_t late) {
    DomainRig rig{DomainRig::config_of(), true, kStart};
    rig.poll_at(kStart + late);
    rig.sent(only(rig).mailbox, kStart + late + 1000);
    rig.sent(only(rig).mailbox, kStart + late + 2000);
    std::uint64_t low = kStart + late, high = low + 3 * kR;  // first poll that sends
    for (const std::uint64_t due : {kStart + kR, kStart + late + kR}) {
      rig.poll_at(due - 1);
      if (!rig.waiting().empty()) return low;
      rig.poll_at(due);
      if (!rig.waiting().empty()) return due;
    }
    return high;
  };
  EXPECT_EQ(next(0), kStart + kR);
  EXPECT_EQ(next(kR / 2), kStart + kR);
  EXPECT_EQ(next(kR + 1), kStart + kR + 1 + kR);
}

// TM-50: the application sets the clock of the master back, or ahead: SYNC goes out within R.
TEST(Master, TheClockIsSet) {
  for (const std::int64_t by : {-60'000'000'000L, -250'000'000L, 3'600'000'000'000L}) {
    DomainRig rig{DomainRig::config_of(), true, 7200 * kRigSecond};
    std::uint64_t now = 7200 * kRigSecond;
    const auto syncs_in = [&](std::uint64_t duration) {
      unsigned syncs = 0;
      for (const std::uint64_t end = now + duration; now < end; now += 10'000'000) {
        rig.poll_at(now);
        for (const auto &frame : rig.waiting()) {
          syncs += frame.data[0] == 0x10 ? 1 : 0;
          rig.sent(frame.mailbox, now + kRigSentLate);
        }
      }
      return syncs;
    };
    EXPECT_EQ(syncs_in(10 * kR), 10u);
    now += static_cast<std::uint64_t>(by);
    EXPECT_GE(syncs_in(kR), 1u) << by;
    EXPECT_EQ(syncs_in(10 * kR), 10u) << by;
  }
}

// TM-89: what was heard before is as old as before: a candidate whose clock is set back waits for a
// better master no longer than else, and takes over when that falls silent.
TEST(Master, TheClockOfACandidateIsSetBack) {
  DomainRig rig{DomainRig::config_of(2, 1), true, kStart};
  std::uint64_t now = kStart;
  for (unsigned n = 0; n < 20; ++n, now += kR) {
    pair(rig, 0x010, n % 16, now);
    rig.poll_at(now + 1'000'000);
    EXPECT_FALSE(rig.status().sending);
  }
  now -= 30 * kRigSecond;
  rig.poll_at(now);
  EXPECT_FALSE(rig.status().sending);
  for (unsigned n = 0; n < 40 && !rig.status().sending; ++n) rig.poll_at(now += kR / 4);
  EXPECT_TRUE(rig.status().sending);
}

// TM-50: exactly R late is not too late.
TEST(Master, LateByAnInterval) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  rig.poll_at(kStart + kR);
  rig.sent(only(rig).mailbox, kStart + kR + 1000);
  rig.sent(only(rig).mailbox, kStart + kR + 2000);
  rig.poll_at(kStart + kR + 3000);
  EXPECT_THAT(rig.waiting(), SizeIs(1));  // that of kStart + R
}

// TM-50: SYNC may wait for R, and is aborted behind it; the next one goes out at once.
TEST(Master, SyncWaitsForR) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  rig.poll_at(kStart);
  for (const std::uint64_t later : {std::uint64_t{1}, kR / 2, kR}) {
    rig.poll_at(kStart + later);
    EXPECT_EQ(only(rig).data, sync_of(0, 50)) << later;
    EXPECT_EQ(rig.dev.stats.aborted, 0u);
  }
  rig.poll_at(kStart + kR + 1);
  EXPECT_EQ(rig.dev.stats.aborted, 1u);
  EXPECT_EQ(only(rig).data, sync_of(1, 50));
  EXPECT_EQ(rig.core.depth, 0u);
}

// TM-50: a SYNC that failed has no FUP, and the next one comes in its time.
TEST(Master, SyncThatFailed) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  rig.poll_at(kStart);
  rig.failed(only(rig).mailbox);
  EXPECT_THAT(rig.waiting(), IsEmpty());
  rig.poll_at(kStart + kR - 1);
  EXPECT_THAT(rig.waiting(), IsEmpty());
  rig.poll_at(kStart + kR);
  EXPECT_EQ(only(rig).data, sync_of(1, 50));
}

// TM-50: without a mailbox no counter is used up, and FUP waits until there is one; it is that of
// the last SYNC even if another SYNC could not go out meanwhile, in another second.
TEST(Master, NoMailbox) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  const unsigned foreign = rig.fill();
  rig.poll_at(kStart);
  rig.sent(foreign, 1);
  EXPECT_EQ(rig.last_told, VERICAN_ERR_EMPTY);
  rig.poll_at(kStart + kR);
  DomainRig::Waiting sync{};
  for (const auto &frame : rig.waiting())
    if (frame.id == 0x010) sync = frame;
  EXPECT_EQ(sync.data, sync_of(0, 50));
  // The application takes SYNC's mailbox before FUP can have it.
  rig.on_sent = [&rig] {
    verican_frame_t other{};
    other.id = 0x700;
    EXPECT_EQ(verican_send(&rig.dev, &other, nullptr), VERICAN_OK);
  };
  const std::uint64_t t1 = 50 * kRigSecond + 987'654'321;
  rig.sent(sync.mailbox, t1 + kRigSentLate);
  const auto fups = [&rig] {
    std::vector<FrameData> all;
    for (const auto &frame : rig.waiting())
      if (frame.id == 0x010) all.push_back(frame.data);
    return all;
  };
  EXPECT_THAT(fups(), IsEmpty());
  rig.poll_at(51 * kRigSecond + 500);  // SYNC is due and has no mailbox either
  EXPECT_THAT(fups(), IsEmpty());
  EXPECT_EQ(rig.core.depth, 0u);
  rig.on_sent = {};
  rig.sent(foreign, 2);
  rig.poll_at(51 * kRigSecond + 600);
  EXPECT_THAT(fups(), ::testing::ElementsAre(fup_of(0, 987'654'321)));
}

// TM-50: a SYNC that finds no mailbox goes out with the first poll behind the one that is free,
// with the time of then, and the rhythm stays.
TEST(Master, NoMailboxForAWhile) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  const unsigned foreign = rig.fill();
  const auto syncs = [&rig] {
    std::vector<DomainRig::Waiting> own;
    for (const auto &frame : rig.waiting())
      if (frame.id == 0x010) own.push_back(frame);
    return own;
  };
  const std::uint64_t free = kStart + kR / 2;
  for (const std::uint64_t now : {kStart, kStart + kR / 4, free}) {
    rig.poll_at(now);
    EXPECT_THAT(syncs(), IsEmpty());
  }
  rig.sent(foreign, 1);
  rig.poll_at(free + 1000);
  ASSERT_THAT(syncs(), SizeIs(1));
  EXPECT_EQ(syncs()[0].data, sync_of(0, (free + 1000) / kRigSecond));
  for (unsigned n = 0; n < 2; ++n) rig.sent(syncs().at(0).mailbox, free + 2000 + n);
  rig.poll_at(kStart + kR - 1);
  EXPECT_THAT(syncs(), IsEmpty());
  rig.poll_at(kStart + kR);
  ASSERT_THAT(syncs(), SizeIs(1));
  EXPECT_EQ(syncs()[0].data, sync_of(1, 50));
}

// TM-50: T4 of 4 s and more has no FUP.
TEST(Master, FupOfFourSeconds) {
  for (const std::uint64_t t4 : {4 * kRigSecond - 1, 4 * kRigSecond}) {
    verican_tsyn_config_t config = DomainRig::config_of();
    config.servo.interval_us = 5'000'000;
    DomainRig rig{config, true, kStart};
    rig.poll_at(kStart);
    rig.sent(only(rig).mailbox, 50 * kRigSecond + t4 + kRigSentLate);
    EXPECT_THAT(rig.waiting(), SizeIs(t4 < 4 * kRigSecond ? 1 : 0));
    rig.poll_at(kStart + 4 * kRigSecond);
    EXPECT_THAT(rig.waiting(), SizeIs(t4 < 4 * kRigSecond ? 1 : 0));
  }
}

/// A candidate of three that has become master: nobody was heard.
void become_master(DomainRig &rig, std::uint8_t rank) {
  const std::uint64_t wait = 3 * kR + rank * kR / 2;
  rig.poll_at(kStart + wait);
  EXPECT_FALSE(rig.status().sending);
  rig.poll_at(kStart + wait + 1);
  EXPECT_TRUE(rig.status().sending);
}

// TM-89: three SYNCs in a row that do not get out, and the candidate is cut off; one that gets out
// between them begins the count anew.
TEST(Master, CutBehindThree) {
  DomainRig rig{DomainRig::config_of(3, 1), true, kStart};
  become_master(rig, 1);
  std::uint64_t now = rig.time;
  for (int n = 0; n < 2; ++n) rig.poll_at(now += kR + 1);
  EXPECT_TRUE(rig.status().sending);
  rig.sent(only(rig).mailbox, now);
  rig.sent(only(rig).mailbox, now);
  rig.poll_at(now += kR + 1);
  for (int n = 0; n < 2; ++n) rig.poll_at(now += kR + 1);
  EXPECT_TRUE(rig.status().sending);
  EXPECT_FALSE(rig.tsyn.cut);
  rig.poll_at(now += kR + 1);
  EXPECT_FALSE(rig.status().sending);
  EXPECT_TRUE(rig.tsyn.cut);
  EXPECT_THAT(rig.waiting(), IsEmpty());
}

/// The same, cut off; the time.
std::uint64_t cut_off(DomainRig &rig) {
  become_master(rig, 1);
  std::uint64_t now = rig.time;
  for (int n = 0; n < 3; ++n) rig.poll_at(now += kR + 1);
  EXPECT_TRUE(rig.tsyn.cut);
  return now;
}

// TM-89: who is cut off sends a frame without data, one at a time, until it gets out; then it
// listens as long as at the start.
TEST(Master, ProbesUntilItIsHeard) {
  DomainRig rig{DomainRig::config_of(3, 1), true, kStart};
  std::uint64_t now = cut_off(rig);
  rig.poll_at(now += 1000);
  const auto probe = only(rig);
  EXPECT_EQ(probe.id, 0x011u);
  EXPECT_EQ(probe.dlc, 0u);
  rig.poll_at(now += 10 * kR);
  EXPECT_THAT(rig.waiting(), SizeIs(1));
  EXPECT_EQ(rig.core.depth, 0u);
  rig.failed(probe.mailbox);
  EXPECT_EQ(rig.last_told, VERICAN_OK);
  EXPECT_TRUE(rig.tsyn.cut);
  EXPECT_FALSE(rig.status().sending);
  rig.poll_at(now += 1000);
  const std::uint64_t heard = now + 500;
  rig.sent(only(rig).mailbox, heard + kRigSentLate);
  EXPECT_FALSE(rig.tsyn.cut);
  EXPECT_THAT(rig.waiting(), IsEmpty());
  rig.poll_at(heard + 3 * kR + kR / 2);
  EXPECT_FALSE(rig.status().sending);
  rig.poll_at(heard + 3 * kR + kR / 2 + 1);
  EXPECT_TRUE(rig.status().sending);
  EXPECT_EQ(only(rig).dlc, 8u);
  // It has as many misses before it as the first time.
  now = rig.time;
  for (int n = 0; n < 2; ++n) rig.poll_at(now += kR + 1);
  EXPECT_TRUE(rig.status().sending);
}

// TM-89: a probe that finds no mailbox is tried again.
TEST(Master, ProbeWithoutAMailbox) {
  DomainRig rig{DomainRig::config_of(3, 1), true, kStart};
  const std::uint64_t now = cut_off(rig);
  const unsigned foreign = rig.fill();
  rig.poll_at(now + 1000);
  EXPECT_EQ(rig.core.depth, 0u);
  rig.sent(foreign, 1);
  rig.poll_at(now + 2000);
  unsigned probes = 0;
  for (const auto &frame : rig.waiting()) probes += frame.id == 0x011 ? 1 : 0;
  EXPECT_EQ(probes, 1u);
}

// TM-50: SYNC may end in any moment in which it is given up: one that was sent has its FUP.
TEST(Master, SyncThatEndsWhileItIsGivenUp) {
  unsigned late = 0;
  for (unsigned place = 0; place < 12; ++place) {
    DomainRig rig{DomainRig::config_of(), true, kStart};
    rig.poll_at(kStart);
    const unsigned mailbox = only(rig).mailbox;
    unsigned left = place;
    rig.core.on_open = [&] {
      if (left-- > 0) return;
      rig.core.on_open = nullptr;
      const auto frames = rig.waiting();
      if (!frames.empty() && frames[0].data[0] == 0x10) rig.sent(mailbox, kStart + kR);
    };
    rig.poll_at(kStart + kR + 1);
    const auto waiting = rig.waiting();
    const auto fups = std::count_if(waiting.begin(), waiting.end(),
                                    [](const auto &frame) { return frame.data[0] == 0x18; });
    if (rig.dev.stats.sent == 1) {
      EXPECT_EQ(fups, 1) << "place " << place;
    } else {
      ++late;
    }
  }
  EXPECT_GT(late, 0u);
  EXPECT_LT(late, 12u);
}

// TM-89: a better master is heard: the own SYNC is taken back, and its time runs from that SYNC on.
TEST(Master, YieldsToABetterOne) {
  DomainRig rig{DomainRig::config_of(3, 1), true, kStart};
  become_master(rig, 1);
  EXPECT_EQ(rig.status().master, VERICAN_MASTER_NONE);
  EXPECT_THAT(rig.waiting(), SizeIs(1));
  const std::uint64_t stamp = rig.time + 5'000;
  // The own rank and a worse one are no reason.
  rig.hear(0x011, sync_of(0, 50), stamp);
  rig.hear(0x012, sync_of(0, 50), stamp);
  EXPECT_TRUE(rig.status().sending);
  EXPECT_THAT(rig.waiting(), SizeIs(1));
  rig.hear(0x010, sync_of(0, 50), stamp);
  EXPECT_FALSE(rig.status().sending);
  EXPECT_EQ(rig.status().master, 0);
  EXPECT_THAT(rig.waiting(), IsEmpty());
  EXPECT_EQ(rig.dev.stats.aborted, 1u);
  rig.poll_at(stamp + 3 * kR + kR / 2);
  EXPECT_FALSE(rig.status().sending);
  rig.poll_at(stamp + 3 * kR + kR / 2 + 1);
  EXPECT_TRUE(rig.status().sending);
}

// TM-89: a frame that is not out is not taken back; only waiting ones are.
TEST(Master, YieldsBetweenSyncs) {
  DomainRig rig{DomainRig::config_of(3, 1), true, kStart};
  become_master(rig, 1);
  rig.sent(only(rig).mailbox, rig.time);
  EXPECT_THAT(rig.waiting(), SizeIs(1));  // FUP
  rig.hear(0x010, sync_of(0, 50), rig.time + 5'000);
  EXPECT_THAT(rig.waiting(), SizeIs(1));
  EXPECT_EQ(rig.dev.stats.aborted, 0u);
  EXPECT_FALSE(rig.status().sending);
}

// TM-89: a better candidate takes over from a worse master with that one's time: once it is locked.
TEST(Master, TakesOverOnceLocked) {
  verican_tsyn_config_t config = DomainRig::config_of(3, 0);
  config.servo.filter = 1;
  DomainRig rig{config, true, kStart};
  std::uint64_t stamp = kStart;
  for (unsigned n = 0; n < 3; ++n) pair(rig, 0x012, n, stamp += kR);
  ASSERT_EQ(rig.status().state, VERICAN_SYNC_ACQUIRING);
  rig.poll_at(kStart + 3 * kR + 1'000'000);
  EXPECT_FALSE(rig.status().sending);
  pair(rig, 0x012, 3, stamp += kR);
  ASSERT_EQ(rig.status().state, VERICAN_SYNC_LOCKED);
  rig.poll_at(stamp + 1'000'000);
  EXPECT_TRUE(rig.status().sending);
  EXPECT_EQ(rig.status().master, VERICAN_MASTER_NONE);
  EXPECT_EQ(only(rig).data, sync_of(0, 50));
  // Its next SYNC comes R later, however long it had waited.
  rig.sent(only(rig).mailbox, rig.time);
  rig.sent(only(rig).mailbox, rig.time);
  const std::uint64_t began = rig.time;
  rig.poll_at(began + kR - 1);
  EXPECT_THAT(rig.waiting(), IsEmpty());
  rig.poll_at(began + kR);
  EXPECT_THAT(rig.waiting(), SizeIs(1));
}

// TM-87: who sends follows nobody: its own silence is no holdover, and tells nothing.
TEST(Master, IsNotInHoldover) {
  verican_tsyn_config_t config = DomainRig::config_of(3, 0);
  config.servo.filter = 1;
  unsigned told = 0;
  config.user = &told;
  config.on_event = [](void *user, verican_tsyn_t *, std::uint8_t events) {
    *static_cast<unsigned *>(user) += (events & VERICAN_SERVO_STATE) != 0 ? 1 : 0;
  };
  DomainRig rig{config, true, kStart};
  std::uint64_t stamp = kStart;
  for (unsigned n = 0; n < 4; ++n) pair(rig, 0x012, n, stamp += kR);
  rig.poll_at(stamp + 1'000'000);
  ASSERT_TRUE(rig.status().sending);
  const unsigned before = told;
  rig.poll_at(stamp + 20 * kR);
  EXPECT_EQ(rig.status().state, VERICAN_SYNC_LOCKED);
  EXPECT_EQ(told, before);
}

// TM-91: a start is one from the beginning, whatever was under way.
TEST(Master, StartsAnew) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  rig.poll_at(kStart);
  ASSERT_THAT(rig.waiting(), SizeIs(1));
  rig.set_time(kStart + 1000);
  EXPECT_EQ(verican_tsyn_start_master(&rig.tsyn), VERICAN_OK);
  rig.poll_at(kStart + 1000);
  EXPECT_THAT(rig.waiting(), SizeIs(2));
  EXPECT_EQ(verican_tsyn_start_follower(&rig.tsyn), VERICAN_OK);
  rig.poll_at(kStart + 10 * kR);
  EXPECT_FALSE(rig.status().sending);
  EXPECT_THAT(rig.waiting(), SizeIs(2));
}

// TM-53, TM-54, TM-84, TM-86, TM-87: what is so if nobody asks for something else.
// Whatever was there before.
TEST(Master, Defaults) {
  verican_tsyn_config_t config = DomainRig::config_of(4, 3);
  config.delay_request = config.delay_response = 7;
  config.user = &config;
  config.on_event = [](void *, verican_tsyn_t *, std::uint8_t) {};
  ASSERT_EQ(verican_tsyn_config_default(&config), VERICAN_OK);
  EXPECT_EQ(config.master_count, 1);
  EXPECT_EQ(config.rank, 0);
  for (const std::uint32_t master : config.masters) EXPECT_EQ(master, 0u);
  EXPECT_EQ(config.delay_request, 0u);
  EXPECT_EQ(config.delay_response, 0u);
  EXPECT_EQ(config.on_event, nullptr);
  EXPECT_EQ(config.user, nullptr);
  EXPECT_EQ(config.rules.jump_width, 15);
  EXPECT_EQ(config.rules.fup_timeout_us, 100'000u);
  EXPECT_EQ(config.servo.interval_us, 1'000'000u);
  EXPECT_EQ(config.servo.leap_ns, 100'000u);
  EXPECT_EQ(config.servo.drift_ppb, 100u);
  EXPECT_EQ(config.servo.hold_after, 3);
  EXPECT_EQ(config.servo.filter, 0);
  verican_tsyn_rules_t rules{nullptr, nullptr, 1, 2, 3, 4, true, {5, 6, 7}};
  ASSERT_EQ(verican_tsyn_rules_default(&rules), VERICAN_OK);
  EXPECT_EQ(rules.domain, 0);
  EXPECT_EQ(rules.crc, VERICAN_TSYN_CRC_IGNORED);
  EXPECT_FALSE(rules.sub_domain);
  EXPECT_EQ(rules.user[2], 0);
}

// What a configuration may have, both ends of it.
TEST(Master, EndsOfTheConfiguration) {
  const auto result = [](auto change) {
    verican_tsyn_config_t config = DomainRig::config_of(4, 3);
    change(config);
    DomainRig rig{DomainRig::config_of(), true, kStart};
    return verican_tsyn_init(&rig.tsyn, &rig.dev, &config);
  };
  EXPECT_EQ(result([](auto &) {}), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.rank = 4; }), VERICAN_ERR_RANGE);
  EXPECT_EQ(result([](auto &c) { c.master_count = 3; }), VERICAN_ERR_RANGE);
  EXPECT_EQ(result([](auto &c) { c.rules.domain = 15; }), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.rules.jump_width = 1; }), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.rules.jump_width = 15; }), VERICAN_OK);
  EXPECT_EQ(result([](auto &c) { c.rules.crc = 3; }), VERICAN_OK);
}

// Identifiers that frames can have, and masters in the order in which they win arbitration.
TEST(Master, IdentifiersOfTheConfiguration) {
  constexpr std::uint32_t kExtended = VERICAN_TSYN_EXTENDED;
  const auto result = [](const std::vector<std::uint32_t> &masters, std::uint32_t request = 0,
                         std::uint32_t response = 0) {
    verican_tsyn_config_t config = DomainRig::config_of(static_cast<std::uint8_t>(masters.size()));
    std::copy(masters.begin(), masters.end(), config.masters);
    config.delay_request = request;
    config.delay_response = response;
    DomainRig rig{DomainRig::config_of(), true, kStart};
    return verican_tsyn_init(&rig.tsyn, &rig.dev, &config);
  };
  EXPECT_EQ(result({0x7FF}), VERICAN_OK);
  EXPECT_EQ(result({0x800}), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({kExtended | 0x1FFFFFFF}), VERICAN_OK);
  EXPECT_EQ(result({kExtended | 0x20000000}), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({0xFFFFFFFF}), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({0x10}, 0x7FF, kExtended | 0x1FFFFFFF), VERICAN_OK);
  EXPECT_EQ(result({0x10}, 0x800, 0x20), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({0x10}, 0x20, 0x18FF1234), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({0x100, 0x101}), VERICAN_OK);
  EXPECT_EQ(result({0x100, 0x080}), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({0x100, 0x100}), VERICAN_ERR_RANGE);
  // AR-06: of equal leading bits the base frame wins.
  EXPECT_EQ(result({0x100, kExtended | 0x100U << 18}), VERICAN_OK);
  EXPECT_EQ(result({kExtended | 0x100U << 18, 0x100}), VERICAN_ERR_RANGE);
  EXPECT_EQ(result({kExtended | 0xFFU << 18, 0x100}), VERICAN_OK);
}

// What was refused is not begun with.
TEST(Master, ARefusedServoIsNoDomain) {
  DomainRig rig{DomainRig::config_of(), true, kStart};
  verican_tsyn_config_t config = DomainRig::config_of();
  config.servo.filter = 5;
  verican_tsyn_t tsyn{};
  EXPECT_EQ(verican_tsyn_init(&tsyn, &rig.dev, &config), VERICAN_ERR_RANGE);
  EXPECT_NE(verican_tsyn_start_follower(&tsyn), VERICAN_OK);
}

}  // namespace
}  // namespace vericansim
