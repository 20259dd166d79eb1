// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SYNC and FUP of AUTOSAR CanTSyn: as a master writes them, and as a follower takes them. What the
// bytes mean is decoded here anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string_view>
#include <vector>

#include "verican/tsyn.h"

namespace vericansim {
namespace {

using Data = std::array<std::uint8_t, 8>;
constexpr std::uint64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kSilence = 3 * kSecond;

// CRC8H2F as its definition says it: division of the message, start and end inverted.
std::uint8_t crc8h2f(const std::vector<std::uint8_t> &bytes) {
  unsigned rest = 0xFF;
  for (const std::uint8_t byte : bytes)
    for (int bit = 7; bit >= 0; --bit) {
      const unsigned in = byte >> bit & 1u, out = rest >> 7 & 1u;
      rest = (rest << 1 & 0xFF) ^ ((in ^ out) != 0 ? 0x2Fu : 0u);
    }
  return static_cast<std::uint8_t>(rest ^ 0xFF);
}

std::uint32_t big_endian(const Data &data) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i < 8; ++i) word = word * 256 + data[i];
  return word;
}

verican_tsyn_rules_t rules_of(std::uint8_t domain = 3) {
  verican_tsyn_rules_t rules{};
  verican_tsyn_rules_default(&rules);
  rules.domain = domain;
  return rules;
}

// 16 data identifiers for each of the two.
struct Ids {
  std::array<std::uint8_t, 16> sync{}, fup{};
  Ids() {
    for (std::uint8_t i = 0; i < 16; ++i) {
      sync.at(i) = static_cast<std::uint8_t>(0x40 + 7 * i);
      fup.at(i) = static_cast<std::uint8_t>(0xF0 - 5 * i);
    }
  }
};

/// A master and a follower; own time of the follower is `now`.
struct Pair {
  Pair() : rules{rules_of()} {}
  Data sync(std::uint64_t t0) {
    Data data{};
    verican_tsyn_write_sync(&sender, &rules, t0, data.data());
    return data;
  }
  Data fup(std::uint64_t t1) {
    Data data{};
    EXPECT_TRUE(verican_tsyn_write_fup(&sender, &rules, t1, data.data()));
    return data;
  }
  verican_tsyn_heard_t take(const Data &data, std::uint8_t dlc = 8) {
    return verican_tsyn_receive(&receiver, &rules, data.data(), dlc, now, kSilence, &pair);
  }
  [[nodiscard]] std::vector<unsigned> refused() const {
    return {std::begin(receiver.refused), std::end(receiver.refused)};
  }
  verican_tsyn_rules_t rules;
  verican_tsyn_sender_t sender{};
  verican_tsyn_receiver_t receiver{};
  verican_sync_pair_t pair{};
  std::uint64_t now = 77 * kSecond;
};

// What refused() is with some counts.
std::vector<unsigned> counts(
    std::initializer_list<std::pair<verican_tsyn_cause_t, unsigned>> some) {
  std::vector<unsigned> all(VERICAN_TSYN_CAUSES);
  for (const auto &[cause, count] : some) all.at(cause) = count;
  return all;
}

// TM-52: the check value of the CRC, the vectors of the rule, and random messages.
TEST(CanTSyn, CrcVectors) {
  constexpr std::string_view digits = "123456789";
  ASSERT_EQ(crc8h2f({digits.begin(), digits.end()}), 0xDF);
  std::array<std::uint8_t, 16> ids{};
  ids[5] = 0x0A;
  EXPECT_EQ(verican_tsyn_crc8(Data{0, 0, 0x35, 0x00, 0x65, 0x53, 0xF1, 0x00}.data(), ids.data()),
            0xF4);
  EXPECT_EQ(verican_tsyn_crc8(Data{0, 0, 0x35, 0x00, 0x07, 0x5B, 0xCD, 0x15}.data(), ids.data()),
            0x6C);
  std::mt19937 dice{52};
  const Ids lists;
  for (int n = 0; n < 1000; ++n) {
    Data data{};
    for (std::uint8_t &byte : data) byte = static_cast<std::uint8_t>(dice());
    std::vector<std::uint8_t> covered{data.begin() + 2, data.end()};
    covered.push_back(lists.sync.at(data[2] & 0xF));
    ASSERT_EQ(verican_tsyn_crc8(data.data(), lists.sync.data()), crc8h2f(covered));
  }
}

// TM-50: byte by byte, without CRC and with it.
TEST(CanTSyn, MasterMessages) {
  std::mt19937_64 dice{50};
  const Ids ids;
  for (const bool with_crc : {false, true}) {
    Pair bus;
    bus.rules.user[0] = 0xA0;
    bus.rules.user[1] = 0xA1;
    bus.rules.user[2] = 0xA2;
    bus.rules.sub_domain = with_crc;
    bus.rules.sync_ids = with_crc ? ids.sync.data() : nullptr;
    bus.rules.fup_ids = with_crc ? ids.fup.data() : nullptr;
    for (unsigned n = 0; n < 200; ++n) {
      const std::uint64_t t0 = dice() % (4'000'000'000 * kSecond), t1 = t0 + dice() % (3 * kSecond);
      const Data sync = bus.sync(t0), fup = bus.fup(t1);
      const unsigned sc = n % 16;
      ASSERT_EQ(sync[0], with_crc ? 0x20 : 0x10);
      ASSERT_EQ(fup[0], with_crc ? 0x28 : 0x18);
      const auto crc = [](const Data &data, std::uint8_t id) {
        return crc8h2f({data[2], data[3], data[4], data[5], data[6], data[7], id});
      };
      ASSERT_EQ(sync[1], with_crc ? crc(sync, ids.sync.at(sc)) : 0xA1);
      ASSERT_EQ(fup[1], with_crc ? crc(fup, ids.fup.at(sc)) : 0xA2);
      ASSERT_EQ(sync[2], 0x30 + sc);
      ASSERT_EQ(fup[2], 0x30 + sc);
      ASSERT_EQ(sync[3], 0xA0);
      ASSERT_EQ(fup[3] >> 2, with_crc ? 1 : 0);
      ASSERT_LT(big_endian(fup), kSecond);
      const std::uint64_t told = (big_endian(sync) + (fup[3] & 3u)) * kSecond + big_endian(fup);
      ASSERT_EQ(told, t1);
    }
  }
}

// TM-51: all seconds that FUP can tell, around their boundaries; 4 s and more have no FUP.
TEST(CanTSyn, EverySecondBoundary) {
  for (const std::uint64_t second : {0ull, 1ull, 1'700'000'000ull, 0xFFFF'FFFFull}) {
    for (const std::uint64_t into : {0ull, 1ull, 999'999'999ull}) {
      for (std::uint64_t later = 0; later <= 4; ++later) {
        for (const int around : {-1, 0, 1}) {
          const std::uint64_t t1 = (second + later) * kSecond + static_cast<std::uint64_t>(around);
          if (t1 + 1 < second * kSecond + into + 1) continue;
          Pair bus;
          EXPECT_EQ(bus.take(bus.sync(second * kSecond + into)), VERICAN_TSYN_SYNC);
          const std::uint64_t stamp = bus.now;
          bus.now += 300'000;
          Data fup{};
          const bool told = verican_tsyn_write_fup(&bus.sender, &bus.rules, t1, fup.data());
          ASSERT_EQ(told, t1 < (second + 4) * kSecond);
          if (!told) continue;
          ASSERT_EQ(bus.take(fup), VERICAN_TSYN_PAIR);
          ASSERT_EQ(bus.pair.master, t1);
          ASSERT_EQ(bus.pair.local, stamp);
        }
      }
    }
  }
}

// TM-50: a master whose clock was set back meanwhile has no FUP.
TEST(CanTSyn, NoFupBeforeSync) {
  Pair bus;
  bus.sync(10 * kSecond);
  Data fup{};
  EXPECT_FALSE(verican_tsyn_write_fup(&bus.sender, &bus.rules, 10 * kSecond - 1, fup.data()));
}

// TM-53: a SYNC that comes again before its FUP replaces the first; one behind it does not.
TEST(CanTSyn, RepeatedSync) {
  Pair bus;
  const Data sync = bus.sync(5 * kSecond);
  EXPECT_EQ(bus.take(sync), VERICAN_TSYN_SYNC);
  bus.now += 250'000;
  EXPECT_EQ(bus.take(sync), VERICAN_TSYN_SYNC);
  const std::uint64_t second_stamp = bus.now;
  bus.now += 250'000;
  EXPECT_EQ(bus.take(bus.fup(5 * kSecond + 9)), VERICAN_TSYN_PAIR);
  EXPECT_EQ(bus.pair.local, second_stamp);
  EXPECT_EQ(bus.refused(), counts({}));
  EXPECT_EQ(bus.take(sync), VERICAN_TSYN_NOTHING);
  EXPECT_EQ(bus.refused(), counts({{VERICAN_TSYN_SC, 1}}));
}

// TM-53: every step of the counter against every width.
TEST(CanTSyn, JumpWidth) {
  for (std::uint8_t width = 1; width <= 15; ++width) {
    for (std::uint8_t jump = 1; jump <= 15; ++jump) {
      Pair bus;
      bus.rules.jump_width = width;
      bus.sender.sc = 9;
      bus.take(bus.sync(0));
      bus.take(bus.fup(5));
      bus.sender.sc = static_cast<std::uint8_t>((9 + jump) % 16);
      bus.now += kSecond;
      const auto heard = bus.take(bus.sync(kSecond));
      ASSERT_EQ(heard, jump <= width ? VERICAN_TSYN_SYNC : VERICAN_TSYN_NOTHING);
      // Behind the timeout any counter will do.
      bus.sender.sc = 9;
      bus.now += kSilence + 1;
      EXPECT_EQ(bus.take(bus.sync(kSecond)), VERICAN_TSYN_SYNC);
    }
  }
}

// TM-54: a case for each cause, at each of the two messages, and what becomes of the pair.
TEST(CanTSyn, Refusals) {
  const Ids ids;
  const auto refused = [&ids](auto damage, bool of_fup) {
    Pair bus;
    bus.rules.sync_ids = ids.sync.data();
    bus.rules.fup_ids = ids.fup.data();
    bus.rules.crc = VERICAN_TSYN_CRC_VALIDATED;
    Data sync = bus.sync(kSecond), fup = bus.fup(kSecond + 5);
    if (!of_fup) damage(bus, sync);
    bus.take(sync);
    if (!of_fup) return bus.refused();
    damage(bus, fup);
    EXPECT_EQ(bus.take(fup), VERICAN_TSYN_NOTHING);
    return bus.refused();
  };
  const auto rewritten = [](const Ids &lists, Data &data, bool fup) {
    data[1] = verican_tsyn_crc8(data.data(), fup ? lists.fup.data() : lists.sync.data());
  };
  for (const bool fup : {false, true}) {
    EXPECT_EQ(refused([](Pair &, Data &data) { data[0] = 0x11; }, fup),
              counts({{VERICAN_TSYN_TYPE, 1}}));
    EXPECT_EQ(refused([](Pair &, Data &data) { data[1] ^= 1; }, fup),
              counts({{VERICAN_TSYN_CRC, 1}}));
    EXPECT_EQ(refused([](Pair &, Data &data) { data[2] ^= 0x10; }, fup),
              counts({{VERICAN_TSYN_DOMAIN, 1}}));
  }
  EXPECT_EQ(refused(
                [&](Pair &, Data &data) {
                  data[2] ^= 1;
                  rewritten(ids, data, true);
                },
                true),
            counts({{VERICAN_TSYN_SC, 1}}));
  EXPECT_EQ(refused(
                [&](Pair &, Data &data) {
                  data = {0x28, 0, data[2], 0, 0x3B, 0x9A, 0xCA, 0x00};  // 10^9 ns
                  rewritten(ids, data, true);
                },
                true),
            counts({{VERICAN_TSYN_TYPE, 1}}));
  EXPECT_EQ(refused([](Pair &bus, Data &) { bus.now += 100'000'001; }, true),
            counts({{VERICAN_TSYN_LATE, 1}}));
}

// TM-54: FUP is accepted once, up to its timeout; what is missing is counted.
TEST(CanTSyn, FupOnce) {
  Pair bus;
  bus.take(bus.sync(kSecond));
  const Data fup = bus.fup(kSecond + 5);
  bus.now += 100'000'000;
  EXPECT_EQ(bus.take(fup), VERICAN_TSYN_PAIR);
  EXPECT_EQ(bus.take(fup), VERICAN_TSYN_NOTHING);
  EXPECT_EQ(bus.refused(), counts({{VERICAN_TSYN_MISSING, 1}}));
  bus.take(bus.sync(2 * kSecond));
  bus.take(bus.sync(3 * kSecond));
  EXPECT_EQ(bus.refused(), counts({{VERICAN_TSYN_MISSING, 2}}));
  EXPECT_EQ(bus.take(bus.fup(3 * kSecond + 5)), VERICAN_TSYN_PAIR);
}

// TM-54: a FUP of another SYNC ends the wait; one of another domain is none of ours.
TEST(CanTSyn, WhatBecomesOfThePair) {
  Pair bus;
  bus.take(bus.sync(kSecond));
  Data fup = bus.fup(kSecond + 5);
  fup[2] ^= 0x10;
  bus.take(fup);
  fup[2] ^= 0x10;
  EXPECT_EQ(bus.take(fup), VERICAN_TSYN_PAIR);
  const Ids ids;
  bus.rules.sync_ids = ids.sync.data();
  bus.rules.fup_ids = ids.fup.data();
  bus.rules.crc = VERICAN_TSYN_CRC_VALIDATED;
  bus.take(bus.sync(2 * kSecond));
  fup = bus.fup(2 * kSecond + 5);
  fup[1] ^= 1;
  bus.take(fup);
  fup[1] ^= 1;
  EXPECT_EQ(bus.take(fup), VERICAN_TSYN_NOTHING);
  bus.rules = rules_of();
  bus.take(bus.sync(2 * kSecond));
  fup = bus.fup(2 * kSecond + 5);
  fup[2] ^= 1;
  bus.take(fup);
  fup[2] ^= 1;
  EXPECT_EQ(bus.take(fup), VERICAN_TSYN_NOTHING);
}

// TM-52: which frames the four ways of reception take.
TEST(CanTSyn, CrcOfReception) {
  const Ids ids;
  struct Row {
    verican_tsyn_crc_t crc;
    bool without, right, wrong;
  };
  for (const Row &row : {Row{VERICAN_TSYN_CRC_IGNORED, true, true, true},
                         Row{VERICAN_TSYN_CRC_VALIDATED, false, true, false},
                         Row{VERICAN_TSYN_CRC_NOT_VALIDATED, true, false, false},
                         Row{VERICAN_TSYN_CRC_OPTIONAL, true, true, false}}) {
    const auto paired = [&](bool with_crc, std::uint8_t damage) {
      Pair bus;
      bus.rules.crc = static_cast<std::uint8_t>(row.crc);
      if (with_crc) {
        bus.rules.sync_ids = ids.sync.data();
        bus.rules.fup_ids = ids.fup.data();
      }
      Data sync = bus.sync(kSecond), fup = bus.fup(kSecond + 5);
      sync[1] ^= damage;
      fup[1] ^= damage;
      bus.take(sync);
      return bus.take(fup) == VERICAN_TSYN_PAIR;
    };
    EXPECT_EQ(paired(false, 0), row.without) << row.crc;
    EXPECT_EQ(paired(true, 0), row.right) << row.crc;
    EXPECT_EQ(paired(true, 0x80), row.wrong) << row.crc;
  }
}

// TM-52: a CRC that nobody can check is not taken for right.
TEST(CanTSyn, CrcWithoutIds) {
  Pair bus;
  bus.rules.crc = VERICAN_TSYN_CRC_OPTIONAL;
  EXPECT_EQ(bus.take({0x20, 0, 0x30, 0, 0, 0, 0, 1}), VERICAN_TSYN_NOTHING);
  EXPECT_EQ(bus.refused(), counts({{VERICAN_TSYN_CRC, 1}}));
}

// TM-55: the other messages of the protocol are counted apart and change nothing; short frames and
// unknown types are errors. No count wraps.
TEST(CanTSyn, OtherTypes) {
  Pair bus;
  bus.take(bus.sync(kSecond));
  for (const std::uint8_t type : Data{0x34, 0x3C, 0x44, 0x4C, 0x54, 0x64, 0x54, 0x64})
    EXPECT_EQ(bus.take({type, 0, 0x30}), VERICAN_TSYN_NOTHING);
  EXPECT_EQ(bus.take({0x54}, 1), VERICAN_TSYN_NOTHING);  // the type alone tells
  EXPECT_EQ(bus.refused(), counts({{VERICAN_TSYN_OTHER, 9}}));
  for (const int dlc : {0, 1, 7, 9, 15})
    bus.take(bus.fup(kSecond + 5), static_cast<std::uint8_t>(dlc));
  EXPECT_EQ(bus.refused(), counts({{VERICAN_TSYN_OTHER, 9}, {VERICAN_TSYN_TYPE, 5}}));
  for (int n = 0; n < 70'000; ++n) bus.take({0x7F});
  EXPECT_EQ(bus.receiver.refused[VERICAN_TSYN_TYPE], 0xFFFF);
  EXPECT_EQ(bus.take(bus.fup(kSecond + 5)), VERICAN_TSYN_PAIR);
}

// TM-51: what else the messages tell.
TEST(CanTSyn, UserBytesAndSubDomain) {
  Pair bus;
  bus.rules.user[0] = 1;
  bus.rules.user[1] = 2;
  bus.rules.user[2] = 3;
  bus.rules.sub_domain = true;
  bus.take(bus.sync(kSecond));
  bus.take(bus.fup(kSecond));
  EXPECT_THAT(bus.receiver.user, ::testing::ElementsAre(1, 2, 3));
  EXPECT_TRUE(bus.receiver.sub_domain);
  verican_tsyn_cause_t cause{};
  EXPECT_TRUE(verican_tsyn_is_sync(&bus.rules, bus.sync(1).data(), 8, &cause));
  EXPECT_FALSE(verican_tsyn_is_sync(&bus.rules, bus.fup(1).data(), 8, &cause));
  EXPECT_EQ(cause, VERICAN_TSYN_CAUSES);
  EXPECT_FALSE(verican_tsyn_is_sync(&bus.rules, bus.sync(1).data(), 7, &cause));
  EXPECT_EQ(cause, VERICAN_TSYN_TYPE);
  EXPECT_EQ(verican_tsyn_rules_default(nullptr), VERICAN_ERR_NULL);
}

}  // namespace
}  // namespace vericansim
