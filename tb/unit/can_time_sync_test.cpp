// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_sync alone against its rules and its model: TM-101 to TM-104.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>

#include "harness/depth.hpp"
#include "unit/time_sync_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint64_t kSecond = 1'000'000'000;
constexpr unsigned kUnsynchronised = 0, kAcquiring = 1, kLocked = 2, kHoldover = 3;

/// 16 MHz and a pair a second.
TimeSyncSetting usual() { return {.domain = 5, .ki = 8, .kd = 2, .id = 0x123}; }

/// A pair whose offset is `o`; the master's time is any.
void pair(SyncRig &rig, unsigned sc, std::int64_t o) {
  const std::uint32_t seconds = 1'700'000'000 + sc, ns = 999'999'000;
  rig.sync(sc, seconds, kSecond * (seconds + 2) + ns + static_cast<std::uint64_t>(o));
  rig.fup(sc, 2, ns);
}

/// The same pair for the model.
std::optional<TimeSyncAction> pair(TimeSyncModel &model, const TimeSyncSetting &setting,
                                   unsigned sc, std::int64_t o, std::uint64_t increment) {
  const std::uint32_t seconds = 1'700'000'000 + sc, ns = 999'999'000;
  model.frame(SyncMessage::make(setting, 0x10, sc, 0, seconds),
              kSecond * (seconds + 2) + ns + static_cast<std::uint64_t>(o), increment);
  auto action = model.frame(SyncMessage::make(setting, 0x18, sc, 2, ns), 0, increment);
  if (action && action->whole) *action->whole &= 0xFFFFFFFF;  // the compare unit has 32 bits
  return action;
}

/// The first pair and twelve more: locked.
void lock(SyncRig &rig) {
  for (unsigned sc = 0; sc < 13; ++sc) {
    EXPECT_NE(rig.state(), kLocked);
    pair(rig, sc, 100);
    rig.settle();
  }
  ASSERT_EQ(rig.state(), kLocked);
}

// TM-101: both types of either message, every domain and counter, both formats of identifier.
TEST(CanTimeSync, Accepts) {
  for (const bool extended : {false, true})
    for (unsigned sc = 0; sc < 16; ++sc) {
      TimeSyncSetting setting = usual();
      setting.domain = 15 - sc;
      setting.extended = extended;
      setting.id = extended ? 0x1ABCDE00 | sc : 0x400 | sc;
      SyncRig rig{setting};
      rig.sync(sc, 7, 12345, sc % 2 == 0 ? 0x10 : 0x20);
      // Others come between: a frame with another identifier, one of another type, a remote one.
      Frame other = SyncMessage::make(setting, 0x10, sc, 0, 99);
      other.id ^= 1;
      rig.frame(other, 1);
      rig.frame(SyncMessage::make(setting, 0x34, sc, 0, 99), 2);
      rig.frame({.id = setting.id, .extended = extended, .remote = true, .dlc = 8}, 3);
      EXPECT_FALSE(rig.settle());
      rig.fup(sc, 3, 500, sc % 4 < 2 ? 0x18 : 0x28);
      const auto action = rig.settle();
      ASSERT_TRUE(action);
      EXPECT_EQ(action->shift, static_cast<std::int64_t>(10 * kSecond + 500) - 12345);
      EXPECT_EQ(rig.sc(), sc);
      EXPECT_EQ(rig.state(), kAcquiring);
    }
}

// TM-101: the second SYNC counts, whatever its counter; and one that ended with an error does not.
TEST(CanTimeSync, SecondSyncReplaces) {
  SyncRig rig{usual()};
  for (const unsigned second : {4u, 5u}) {
    rig.sync(4, 70, 1000);
    rig.sync(second, 80, 2000);
    for (unsigned bytes = 0; bytes <= 8; ++bytes)
      rig.frame(SyncMessage::make(rig.setting(), 0x10, 9, 0, 90), 3000, false, bytes);
    if (second != 4) {
      rig.fup(4, 0, 0);
      EXPECT_FALSE(rig.settle());
    }
    rig.fup(second, 0, 0);
    const auto action = rig.settle();
    ASSERT_TRUE(action);
    EXPECT_EQ(action->shift, static_cast<std::int64_t>(80 * kSecond) - 2000);
  }
}

// TM-101: each thing that may be wrong, alone.
TEST(CanTimeSync, Refuses) {
  SyncRig rig{usual()};
  const Frame good = SyncMessage::make(usual(), 0x10, 3, 0, 70);
  const Frame fup = SyncMessage::make(usual(), 0x18, 3, 0, 70);
  const auto refused = [&rig](const Frame &first, const Frame &second) {
    rig.frame(first, 1000);
    rig.frame(second, 2000);
    return !rig.settle();
  };
  const auto with = [](Frame frame, auto change) {
    change(frame);
    return frame;
  };
  for (unsigned bit = 0; bit < 11; ++bit)
    EXPECT_TRUE(refused(with(good, [bit](Frame &f) { f.id ^= 1u << bit; }), fup)) << bit;
  EXPECT_TRUE(refused(with(good,
                           [](Frame &f) {
                             f.extended = true;
                             f.id <<= 18;
                           }),
                      fup));
  for (unsigned dlc = 0; dlc < 16; ++dlc) {
    if (dlc == 8) continue;
    const Frame frame = with(good, [dlc](Frame &f) { f.dlc = static_cast<std::uint8_t>(dlc); });
    EXPECT_TRUE(refused(frame, fup)) << dlc;
  }
  for (unsigned type = 0; type < 256; ++type) {
    if (type == 0x10 || type == 0x20) continue;
    const Frame frame =
        with(good, [type](Frame &f) { f.data[0] = static_cast<std::uint8_t>(type); });
    EXPECT_TRUE(refused(frame, fup)) << type;
  }
  for (unsigned bit = 0; bit < 8; ++bit)
    EXPECT_TRUE(refused(
        with(good, [bit](Frame &f) { f.data[2] ^= static_cast<std::uint8_t>(1u << bit); }), fup));
  // The FUP alone, and what is wrong with it; the SYNC goes on waiting.
  rig.frame(good, 1000);
  for (unsigned type = 0; type < 256; ++type)
    if (type != 0x18 && type != 0x28 && type != 0x10 && type != 0x20) {
      rig.frame(with(fup, [type](Frame &f) { f.data[0] = static_cast<std::uint8_t>(type); }), 1);
      EXPECT_FALSE(rig.settle()) << type;
    }
  for (unsigned bit = 0; bit < 8; ++bit) {
    rig.frame(with(fup, [bit](Frame &f) { f.data[2] ^= static_cast<std::uint8_t>(1u << bit); }), 1);
    EXPECT_FALSE(rig.settle());
  }
  rig.frame(fup, 1, false);
  EXPECT_FALSE(rig.settle());
  rig.frame(fup, 1);
  EXPECT_TRUE(rig.settle());
  rig.frame(fup, 1);  // the same again
  EXPECT_FALSE(rig.settle());
}

// TM-104: EN = 0 touches nothing, and forgets a SYNC that waits.
TEST(CanTimeSync, Disabled) {
  TimeSyncSetting setting = usual();
  SyncRig rig{setting};
  rig.sync(3, 70, 1000);
  setting.enable = false;
  rig.configure(setting);
  rig.fup(3, 0, 0);
  EXPECT_FALSE(rig.settle());
  pair(rig, 4, 100);
  EXPECT_FALSE(rig.settle());
  setting.enable = true;
  rig.configure(setting);
  rig.fup(4, 0, 0);
  EXPECT_FALSE(rig.settle());
  lock(rig);
  setting.enable = false;
  rig.configure(setting);
  rig.clock();
  rig.clock();
  EXPECT_EQ(rig.state(), 0u);
}

// TM-104: EN = 0 in any clock in which a pair is worked off ends that: from then on the follower
// commands nothing, also when EN is 1 again, until the next pair, which it takes for its first.
TEST(CanTimeSync, DisabledWhileAPairIsWorkedOff) {
  constexpr unsigned kWork = 520;  // clocks
  unsigned cut = 0, done = 0;
  for (const unsigned count : {1u, 70u})
    for (unsigned from = 0; from < kWork; ++from) {
      SCOPED_TRACE(testing::Message() << count << " clocks from " << from << " on");
      TimeSyncSetting setting = usual();
      setting.pps = true;
      SyncRig rig{setting};
      pair(rig, 0, 100);
      ASSERT_TRUE(rig.settle());
      rig.upset(true);  // so that the pair arms the compare unit, too
      pair(rig, 1, 40);
      const std::uint64_t off = rig.clock_count() - rig.valid_at() + from;
      rig.disable(from, count);
      const auto action = rig.settle();
      rig.clocks(100);
      EXPECT_EQ(rig.state(), kUnsynchronised);
      if (action) {
        EXPECT_LE(rig.latency(), off);
      }
      ++(action && action->whole ? done : cut);
      pair(rig, 2, -77);
      EXPECT_EQ(rig.settle(),
                (TimeSyncAction{77, {}, kSecond * (1'700'000'000 + 2 + 2) & 0xFFFFFFFF}));
    }
  EXPECT_GT(cut, kWork / 2);
  EXPECT_GT(done, 0u);
}

// TM-101, TM-102, TM-104: software takes EN away for some clocks while a pair is on the bus. It
// makes nothing of the pair, or what the pair says.
TEST(CanTimeSync, DisabledAmidAPair) {
  constexpr unsigned kPair = 480;  // clocks
  unsigned left = 0, taken = 0;
  for (const unsigned count : {1u, 9u, 200u})
    for (unsigned from = 0; from < kPair; ++from) {
      SyncRig rig{usual()};
      rig.disable(from, count);
      pair(rig, 4, 100);
      const auto action = rig.settle();
      ASSERT_EQ(action.value_or(TimeSyncAction{-100, {}, {}}), (TimeSyncAction{-100, {}, {}}))
          << count << " clocks from " << from << " on";
      ++(action ? taken : left);
    }
  EXPECT_GT(left, kPair);
  EXPECT_GT(taken, 0u);
}

// TM-103: software changes KI, KD, PHALF or all of them in any clock in which a pair may be worked
// off: the pair is corrected by the old settings or by the new ones, shift and rate alike.
TEST(CanTimeSync, SettingsChangedAmidAPair) {
  constexpr unsigned kWork = 460;  // clocks
  constexpr std::int64_t kOffset = 1001;
  const TimeSyncSetting old = usual();
  TimeSyncSetting halves = usual(), less = usual(), other = usual(), all = usual();
  halves.halve = true;
  less.kd = 1;
  other.ki = all.ki = 6;
  all.kd = 1;
  all.halve = true;
  const auto shift_by = [](const TimeSyncSetting &by) {
    return by.halve ? -(kOffset - 1) / 2 : -kOffset;
  };
  const auto rate_by = [](std::uint64_t increment, const TimeSyncSetting &by) {
    return increment - (static_cast<std::uint64_t>(kOffset) << (by.ki - by.kd));
  };
  for (const auto &[from, to] :
       {std::pair{old, halves}, {halves, old}, {old, less}, {old, other}, {old, all}, {all, old}}) {
    SyncRig rig{from};
    lock(rig);
    for (unsigned at = 0; at < kWork; ++at) {
      SCOPED_TRACE(testing::Message() << from.ctrl_word() << " to " << to.ctrl_word() << ' ' << at);
      rig.configure(from);
      while (rig.clock_count() % 64 != 0) rig.clock();
      const std::uint64_t before = rig.increment();
      pair(rig, at, kOffset);
      rig.clocks(at);
      rig.configure(to);
      const auto action = rig.settle();
      ASSERT_TRUE(action && action->increment);
      const auto corrected_by = [&](const TimeSyncSetting &by) {
        return action->shift == shift_by(by) && *action->increment == rate_by(before, by);
      };
      ASSERT_TRUE(corrected_by(from) || corrected_by(to)) << action->shift;
    }
  }
}

// TM-101: a hard reset forgets a SYNC that waits. Behind it the counter is 0, too.
TEST(CanTimeSync, HardReset) {
  SyncRig rig{usual()};
  rig.sync(0, 70, 1000);
  rig.clocks(100);
  rig.reset();
  rig.fup(0, 0, 0);
  EXPECT_FALSE(rig.settle());
  EXPECT_EQ(rig.state(), 0u);
}

// TM-102: random pairs, all 64 bits, in time; TSOFS stays at its ends.
TEST(CanTimeSync, OffsetExact) {
  std::mt19937_64 random{102};
  TimeSyncSetting setting = usual();
  SyncRig rig{setting};
  std::uint64_t longest = 0;
  unsigned wrong = 0, beyond = 0;
  const unsigned pairs = depth(10'000U, 100'000U);
  for (unsigned i = 0; i < pairs; ++i) {
    if (i % 100 == 0) {
      setting.delay = static_cast<std::int32_t>(random() % (1u << 24)) - (1 << 23);
      rig.configure(setting);
    }
    // Never locked: every offset is a step, or one of the few between two that are not.
    const auto seconds = static_cast<std::uint32_t>(i % 64 == 0 ? ~0ULL : random());
    const auto ns = static_cast<std::uint32_t>(i % 2 == 0 ? random() % kSecond : random());
    const unsigned ovs = random() % 4, sc = random() % 16;
    const std::uint64_t master = kSecond * (std::uint64_t{seconds} + ovs) + ns;
    // Any stamp, one near the ends of 32 bits, or any within them.
    std::uint64_t stamp = random();
    if (i % 4 == 1) stamp = master + (random() % 2 << 32) - (1ULL << 31) + random() % 4096 - 2048;
    if (i % 4 == 2) stamp = master + (random() >> 32) - (1ULL << 31);
    const auto o = static_cast<std::int64_t>(
        stamp - master - static_cast<std::uint64_t>(std::int64_t{setting.delay}));
    rig.sync(sc, seconds, stamp);
    rig.fup(sc, ovs, ns);
    const auto action = rig.settle();
    longest = std::max(longest, rig.latency());
    const std::int64_t shown =
        std::min<std::int64_t>(std::max<std::int64_t>(o, INT32_MIN), INT32_MAX);
    beyond += shown != o ? 1 : 0;
    wrong +=
        !action || action->shift != static_cast<std::int64_t>(0 - static_cast<std::uint64_t>(o))
            ? 1
            : 0;
    wrong += rig.offset() != shown ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(beyond, pairs / 10);
  EXPECT_LT(longest, 512u);  // 4,096 are allowed
}

/// An offset below 2^12 ns, below 2^20 ns, around these, or beyond; `calm`: mostly the first.
std::int64_t any_offset(std::mt19937_64 &random, bool calm) {
  const std::int64_t sign = random() % 2 == 0 ? 1 : -1;
  const unsigned power = random() % 2 == 0 ? 12 : 20;
  switch (random() % (calm ? 400 : 8)) {
    case 0: return sign * ((1 << power) + static_cast<std::int64_t>(random() % 4) - 2);
    case 1: return sign * static_cast<std::int64_t>(random() >> (random() % 40 + 4));
    case 2: return 0;
    default: break;
  }
  return sign * static_cast<std::int64_t>(random() % (1u << (random() % (calm ? 12 : 21))));
}

// TM-103: every command, bit by bit, and what software reads.
TEST(CanTimeSync, AgainstModel) {
  std::mt19937_64 random{103};
  unsigned locked = 0, ignored = 0, halves = 0, full = 0, anew = 0;
  for (unsigned run = 0; run < 120; ++run) {
    TimeSyncSetting setting = usual();
    setting.ki = random() % 32;
    setting.kd = random() % (std::min(setting.ki, 3u) + 1);
    setting.halve = random() % 2 == 0;
    setting.pps = random() % 2 == 0;
    setting.delay = static_cast<std::int32_t>(random() % 2000) - 1000;
    SyncRig rig{setting, random() >> 24};
    TimeSyncModel model{setting};
    for (unsigned i = 0; i < (run == 0 ? 300u : 60u); ++i) {
      const auto seconds = static_cast<std::uint32_t>(random());
      const auto ns = static_cast<std::uint32_t>(random() % kSecond);
      const unsigned ovs = random() % 4, sc = random() % 16;
      const std::uint64_t stamp = kSecond * (std::uint64_t{seconds} + ovs) + ns +
                                  static_cast<std::uint64_t>(std::int64_t{setting.delay}) +
                                  static_cast<std::uint64_t>(any_offset(random, run % 2 == 0));
      const std::uint64_t increment = rig.increment();
      const Frame frames[2] = {SyncMessage::make(setting, 0x20, sc, 0, seconds),
                               SyncMessage::make(setting, 0x28, sc, 0xFC | ovs, ns)};
      rig.frame(frames[0], stamp);
      rig.frame(frames[1], 77);
      model.frame(frames[0], stamp, increment);
      const unsigned before = rig.state();
      auto expected = model.frame(frames[1], 77, increment);
      // The compare unit has 32 bits.
      if (expected && expected->whole) *expected->whole &= 0xFFFFFFFF;
      ASSERT_EQ(rig.settle(), expected) << run << ' ' << i;
      ASSERT_EQ(rig.state(), static_cast<unsigned>(model.state())) << run << ' ' << i;
      ASSERT_EQ(rig.pairs(), model.pairs());
      ASSERT_EQ(rig.sc(), model.sc());
      ASSERT_EQ(rig.offset(), model.offset());
      locked += before == kLocked ? 1 : 0;
      ignored += expected ? 0 : 1;
      halves += before == kLocked && setting.halve && expected && expected->increment ? 1 : 0;
      anew += before == kAcquiring && rig.state() == kUnsynchronised ? 1 : 0;
      full = std::max(full, model.pairs());
    }
  }
  EXPECT_GT(locked, 1000u);
  EXPECT_GT(ignored, 20u);
  EXPECT_GT(halves, 500u);
  EXPECT_GT(anew, 200u);
  EXPECT_EQ(full, 255u);
}

// TM-103: at both ends of both limits, to the ns.
TEST(CanTimeSync, Limits) {
  for (const std::int64_t sign : {1, -1}) {
    for (const std::int64_t less : {1, 0}) {
      SyncRig acquiring{usual()};
      pair(acquiring, 0, 0);
      acquiring.settle();
      const std::int64_t far = sign * ((1 << 20) - less);
      pair(acquiring, 1, far);
      const std::uint64_t followed =
          (acquiring.increment() - (static_cast<std::uint64_t>(far) << 8)) & ((1ULL << 40) - 1);
      EXPECT_EQ(acquiring.settle(),
                (TimeSyncAction{-far, less == 0 ? usual().nominal : followed, {}}));
      EXPECT_EQ(acquiring.pairs(), less == 0 ? 0u : 1u);
      EXPECT_EQ(acquiring.state(), less == 0 ? kUnsynchronised : kAcquiring);
      // Behind a new increment a pair only shifts, however little it is off.
      pair(acquiring, 2, 100);
      EXPECT_EQ(acquiring.settle()->increment.has_value(), less != 0);
      EXPECT_EQ(acquiring.state(), kAcquiring);
      SyncRig locked{usual()};
      lock(locked);
      const std::int64_t off = sign * ((1 << 12) - less);
      pair(locked, 10, off);
      EXPECT_EQ(locked.settle().has_value(), less != 0);
      EXPECT_EQ(locked.state(), kLocked);
      if (less != 0) continue;
      pair(locked, 11, off);
      EXPECT_EQ(locked.settle(), (TimeSyncAction{-off, {}, {}}));  // the rate is kept
      EXPECT_EQ(locked.state(), kAcquiring);
    }
  }
}

// TM-141: where an upset has changed what the compare unit waits for, a pair arms it with the whole
// second, as a step does; without PPS nobody does.
TEST(CanTimeSync, ArmsAnewBehindAnUpset) {
  for (const bool pps : {true, false})
    for (const bool upset : {true, false}) {
      TimeSyncSetting setting = usual();
      setting.pps = pps;
      SyncRig rig{setting};
      lock(rig);
      rig.upset(upset);
      pair(rig, 10, 40);
      const auto action = rig.settle();
      ASSERT_TRUE(action);
      EXPECT_EQ(action->whole.has_value(), pps && upset);
      if (action->whole) {
        EXPECT_EQ(*action->whole, kSecond * (1'700'000'000 + 10 + 2) & 0xFFFFFFFF);
      }
    }
}

// TM-104: no pair for 2^TMO ns, to 200 clocks and one in 4,096: holdover. The next pair shifts,
// leaves the rate and begins the twelve anew; ignored pairs count as pairs here.
TEST(CanTimeSync, Holdover) {
  for (const std::uint64_t increment : {0x3E80000000ULL, 0x1400000000ULL, 0x0AFFFFFFFFULL})
    for (const unsigned tmo : {17u, 18u, 20u}) {
      SCOPED_TRACE(testing::Message() << increment << ' ' << tmo);
      TimeSyncSetting setting = usual();
      setting.tmo = tmo;
      setting.ki = setting.kd = 0;  // the increment stays about what it is
      SyncRig rig{setting, increment};
      lock(rig);
      const unsigned changes = rig.changes();
      for (unsigned i = 0; i < 4; ++i) {  // every pair begins it anew
        rig.clocks(static_cast<unsigned>((1ULL << tmo << 32) / increment / 2));
        pair(rig, i, i == 1 ? 1 << 24 : 0);
        EXPECT_EQ(rig.settle().has_value(), i != 1);
        ASSERT_EQ(rig.state(), kLocked);
      }
      EXPECT_EQ(rig.changes(), changes);
      const std::uint64_t last = rig.valid_at();
      while (rig.state() == kLocked && rig.clock_count() < last + 1000000) rig.clock();
      EXPECT_EQ(rig.state(), kHoldover);
      EXPECT_EQ(rig.changes(), changes + 1);
      const double ns = static_cast<double>(rig.clock_count() - last) *
                        static_cast<double>(increment) / 4294967296.0;
      const double expected = static_cast<double>(1ULL << tmo);
      EXPECT_GE(ns, expected * (1 - 1.0 / 4096));
      EXPECT_LE(ns,
                expected * (1 + 1.0 / 4096) + 260 * static_cast<double>(increment) / 4294967296.0);
      pair(rig, 4, 500);
      EXPECT_EQ(rig.settle(), (TimeSyncAction{-500, {}, {}}));
      EXPECT_EQ(rig.state(), kAcquiring);
      EXPECT_EQ(rig.pairs(), 0u);
      EXPECT_EQ(rig.changes(), changes + 2);
    }
}

// TM-104, TM-31: behind a holdover the compare unit is left as it is, or its output would jump; but
// a pair as far off as TM-103 asks of a step, and one behind an upset (TM-141), arms it.
TEST(CanTimeSync, HoldoverLeavesThePulses) {
  for (const bool pps : {true, false})
    for (const bool upset : {true, false})
      for (const std::int64_t o : {0, (1 << 20) - 1, 1 - (1 << 20), 1 << 20, -(1 << 20)}) {
        SCOPED_TRACE(testing::Message() << pps << ' ' << upset << ' ' << o);
        TimeSyncSetting setting = usual();
        setting.tmo = 17;
        setting.pps = pps;
        SyncRig rig{setting};
        TimeSyncModel model{setting};
        for (unsigned sc = 0; sc < 13; ++sc) pair(model, setting, sc, 100, 0);
        model.timeout();
        lock(rig);
        while (rig.state() == kLocked && rig.clock_count() < 1000000) rig.clock();
        ASSERT_EQ(rig.state(), kHoldover);
        rig.upset(upset);
        pair(rig, 13, o);
        TimeSyncAction expected{-o, {}, {}};
        if (pps && (upset || std::abs(o) >= 1 << 20))
          expected.whole = kSecond * (1'700'000'000 + 13 + 2) & 0xFFFFFFFF;
        EXPECT_EQ(rig.settle(), expected);
        EXPECT_EQ(rig.state(), kAcquiring);
        EXPECT_EQ(rig.pairs(), 0u);
        if (upset) continue;  // which the model knows nothing of
        EXPECT_EQ(pair(model, setting, 13, o, 0), expected);
        EXPECT_EQ(static_cast<unsigned>(model.state()), kAcquiring);
        EXPECT_EQ(model.pairs(), 0u);
      }
}

// TM-104: a command of the CPU goes through alone, whatever the follower is about to do; one of the
// follower in that clock is lost, and every other one is done.
TEST(CanTimeSync, CpuWins) {
  using namespace time_cmd;
  SyncRig rig{usual()};
  lock(rig);
  unsigned lost = 0;
  for (const unsigned cmd : {kSet, kShift, kRate, kSlew, kArm})
    for (unsigned at = 0; at < 450; ++at) {
      while (rig.clock_count() % 64 != 0) rig.clock();  // so that it always takes as long
      pair(rig, at, 40);
      rig.clocks(at);
      rig.clock(cmd);
      EXPECT_TRUE(rig.foreign());
      const auto action = rig.settle();
      ASSERT_TRUE(action);
      const unsigned done = (action->shift == -40 ? 1 : 0) + (action->increment ? 1 : 0) +
                            (action->ends_slew ? 1 : 0);
      ASSERT_GE(done, 2u) << cmd << ' ' << at;
      lost += 3 - done;
    }
  EXPECT_EQ(lost, 15u);  // shift, end of a slew and rate, for each command
}

}  // namespace
}  // namespace vericansim
