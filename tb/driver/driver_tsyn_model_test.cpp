// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a follower takes of SYNC and FUP, beside a model of the rules (TM-51 to TM-55): random
// frames that are nearly right, at times near the limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>

#include "verican/tsyn.h"

namespace vericansim {
namespace {

using Data = std::array<std::uint8_t, 8>;
using Ids = std::array<std::uint8_t, 16>;
constexpr std::uint64_t kSecond = 1'000'000'000;

// TM-52: CRC8H2F, bit by bit.
std::uint8_t crc8h2f(const Data &data, const Ids &ids) {
  unsigned rest = 0xFF;
  const auto add = [&rest](std::uint8_t byte) {
    for (int bit = 7; bit >= 0; --bit) {
      const bool out = ((rest >> 7 ^ byte >> bit) & 1u) != 0;
      rest = (rest << 1 & 0xFF) ^ (out ? 0x2Fu : 0u);
    }
  };
  std::for_each(data.begin() + 2, data.end(), add);
  add(ids.at(data[2] % 16));
  return static_cast<std::uint8_t>(rest ^ 0xFF);
}

struct Frame {
  Data data{};
  unsigned dlc = 8;
};

class Model {
 public:
  struct Sync {
    unsigned sc;
    std::uint64_t stamp, second;
  };
  struct Setting {
    unsigned domain, jump_width, crc;
    std::uint64_t timeout_ns, silence_ns;
    std::optional<Ids> sync_ids, fup_ids;
  };
  explicit Model(Setting setting) : set{std::move(setting)} {}

  verican_tsyn_heard_t take(const Frame &frame, std::uint64_t now) {
    const auto wrong = wrong_by_itself(frame);
    if (wrong) {
      if (*wrong == VERICAN_TSYN_CRC && is_fup(frame)) due.reset();
      return refuse(*wrong);
    }
    return is_fup(frame) ? fup(frame.data, now) : sync(frame.data, now);
  }

  Setting set;
  std::optional<Sync> last, due;  ///< last SYNC taken; the one whose FUP is due
  std::uint64_t local = 0, master = 0;
  std::array<unsigned, VERICAN_TSYN_CAUSES> refused{};
  std::array<unsigned, 3> user{};
  bool sub_domain = false;

 private:
  static bool is_fup(const Frame &frame) { return frame.data[0] == 0x18 || frame.data[0] == 0x28; }
  static bool has_crc(const Frame &frame) { return frame.data[0] == 0x20 || frame.data[0] == 0x28; }
  verican_tsyn_heard_t refuse(verican_tsyn_cause_t cause) {
    ++refused.at(cause);
    return VERICAN_TSYN_NOTHING;
  }
  // TM-52 to TM-55, in the order in which causes are told.
  [[nodiscard]] std::optional<verican_tsyn_cause_t> wrong_by_itself(const Frame &frame) const {
    constexpr std::array<std::uint8_t, 6> other{0x34, 0x3C, 0x44, 0x4C, 0x54, 0x64};
    constexpr std::array<std::uint8_t, 4> known{0x10, 0x18, 0x20, 0x28};
    if (frame.dlc == 0) return VERICAN_TSYN_TYPE;
    if (std::ranges::count(other, frame.data[0]) > 0) return VERICAN_TSYN_OTHER;
    if (frame.dlc != 8 || std::ranges::count(known, frame.data[0]) == 0) return VERICAN_TSYN_TYPE;
    const bool validated = set.crc == VERICAN_TSYN_CRC_VALIDATED;
    const bool without = set.crc == VERICAN_TSYN_CRC_NOT_VALIDATED;
    if (has_crc(frame) ? without : validated) return VERICAN_TSYN_TYPE;
    if (frame.data[2] / 16 != set.domain) return VERICAN_TSYN_DOMAIN;
    if (!has_crc(frame) || set.crc == VERICAN_TSYN_CRC_IGNORED) return {};
    const auto &ids = is_fup(frame) ? set.fup_ids : set.sync_ids;
    if (ids && crc8h2f(frame.data, *ids) == frame.data[1]) return {};
    return VERICAN_TSYN_CRC;
  }
  static std::uint64_t word(const Data &data) {
    std::uint64_t value = 0;
    for (std::size_t i = 4; i < 8; ++i) value = value * 256 + data[i];
    return value;
  }
  // TM-53.
  verican_tsyn_heard_t sync(const Data &data, std::uint64_t now) {
    const unsigned sc = data[2] % 16;
    const bool repeats = due && due->sc == sc;
    if (last && now - last->stamp <= set.silence_ns && !repeats) {
      const unsigned jump = (sc + 16 - last->sc) % 16;
      if (jump == 0 || jump > set.jump_width) return refuse(VERICAN_TSYN_SC);
    }
    if (due && !repeats) refuse(VERICAN_TSYN_MISSING);
    last = due = Sync{sc, now, word(data)};
    user[0] = data[3];
    user[1] = data[1];
    return VERICAN_TSYN_SYNC;
  }
  // TM-51, TM-54.
  verican_tsyn_heard_t fup(const Data &data, std::uint64_t now) {
    if (!due) return refuse(VERICAN_TSYN_MISSING);
    const Sync of = *due;
    due.reset();
    if (data[2] % 16 != of.sc) return refuse(VERICAN_TSYN_SC);
    if (now - of.stamp > set.timeout_ns) return refuse(VERICAN_TSYN_LATE);
    if (word(data) >= kSecond) return refuse(VERICAN_TSYN_TYPE);
    sub_domain = data[3] / 4 % 2 != 0;
    user[2] = data[1];
    local = of.stamp;
    master = (of.second + data[3] % 4) * kSecond + word(data);
    return VERICAN_TSYN_PAIR;
  }
};

class Twins {
 public:
  explicit Twins(std::uint64_t seed) : dice_{seed}, model_{setting()} {
    const Model::Setting &set = model_.set;
    rules_.domain = static_cast<std::uint8_t>(set.domain);
    rules_.jump_width = static_cast<std::uint8_t>(set.jump_width);
    rules_.crc = static_cast<std::uint8_t>(set.crc);
    rules_.fup_timeout_us = static_cast<std::uint32_t>(set.timeout_ns / 1000);
    rules_.sync_ids = set.sync_ids ? set.sync_ids->data() : nullptr;
    rules_.fup_ids = set.fup_ids ? set.fup_ids->data() : nullptr;
  }
  Twins(const Twins &) = delete;

  verican_tsyn_heard_t step() {
    const Frame frame = some_frame();
    now_ += pause();
    const auto expected = model_.take(frame, now_);
    const auto got = verican_tsyn_receive(&receiver_, &rules_, frame.data.data(),
                                          static_cast<std::uint8_t>(frame.dlc), now_,
                                          model_.set.silence_ns, &pair_);
    EXPECT_EQ(got, expected);
    EXPECT_EQ(pair_.local, model_.local);
    EXPECT_EQ(pair_.master, model_.master);
    EXPECT_TRUE(std::ranges::equal(receiver_.refused, model_.refused));
    EXPECT_TRUE(std::ranges::equal(receiver_.user, model_.user));
    EXPECT_EQ(receiver_.sub_domain, model_.sub_domain);
    return got;
  }
  [[nodiscard]] const auto &refused() const { return model_.refused; }

 private:
  template <class Number>
  Number in(Number low, Number high) {
    return std::uniform_int_distribution<Number>{low, high}(dice_);
  }
  Model::Setting setting() {
    const auto ids = [this]() -> std::optional<Ids> {
      if (in(0, 9) == 0) return {};
      Ids some{};
      for (std::uint8_t &id : some) id = static_cast<std::uint8_t>(in(0, 255));
      return some;
    };
    const auto timeout = in<std::uint64_t>(1, 5'000'000) * 1000;
    return {in(0u, 15u), in(1u, 15u), in(0u, 3u), timeout, in<std::uint64_t>(1, 9) * kSecond,
            ids(),       ids()};
  }
  // Right behind each other, or as long behind the last SYNC as a limit, more or less 1 ns.
  std::uint64_t pause() {
    const std::uint64_t near = in<std::uint64_t>(0, 2) - 1;
    const std::uint64_t since = model_.last ? now_ - model_.last->stamp : 0;
    const std::uint64_t timeout = model_.set.timeout_ns, silence = model_.set.silence_ns;
    const int kind = in(0, 7);
    if (kind == 0 && since < timeout - 1) return timeout - since + near;
    if (kind == 1 && since < silence - 1) return silence - since + near;
    return in<std::uint64_t>(1, 1'000'000);
  }
  Frame some_frame() {
    Frame frame;
    const bool fup = model_.due ? in(0, 3) > 0 : in(0, 5) == 0;
    const bool crc = model_.set.crc != VERICAN_TSYN_CRC_NOT_VALIDATED && in(0, 1) == 0;
    frame.data[0] = static_cast<std::uint8_t>((fup ? 0x18 : 0x10) + (crc ? 0x10 : 0));
    const unsigned last = model_.last ? model_.last->sc : 0;
    const unsigned sc = fup ? last : (last + static_cast<unsigned>(in(0, 2))) % 16;
    frame.data[2] = static_cast<std::uint8_t>(model_.set.domain * 16 + sc);
    frame.data[1] = static_cast<std::uint8_t>(in(0, 255));
    frame.data[3] = static_cast<std::uint8_t>(in(0, 255));
    const auto value =
        in(0, 3) > 0 ? in<std::uint64_t>(0, kSecond - 1) : kSecond - 1 + in<std::uint64_t>(0, 1);
    for (unsigned i = 0; i < 4; ++i)
      frame.data.at(4 + i) = static_cast<std::uint8_t>(value >> (24 - 8 * i));
    damage(frame);
    const auto &ids = fup ? model_.set.fup_ids : model_.set.sync_ids;
    if (crc && ids && in(0, 9) > 0) frame.data[1] = crc8h2f(frame.data, *ids);
    return frame;
  }
  void damage(Frame &frame) {
    switch (in(0, 15)) {
      case 0: frame.data[0] = static_cast<std::uint8_t>(in(0, 255)); return;
      case 1: frame.data[0] ^= static_cast<std::uint8_t>(1 << in(0, 7)); return;
      case 2: frame.data[2] = static_cast<std::uint8_t>(in(0, 255)); return;
      case 3: frame.data[2] ^= static_cast<std::uint8_t>(in(0, 15)); return;
      case 4: frame.dlc = in(0u, 15u); return;
      case 5:
        frame.data[0] = Data{0x34, 0x3C, 0x44, 0x4C, 0x54, 0x64, 0x30, 0x08}.at(in(0u, 7u));
        return;
      default: return;
    }
  }

  std::mt19937_64 dice_;
  Model model_;
  verican_tsyn_rules_t rules_{};
  verican_tsyn_receiver_t receiver_{};
  verican_sync_pair_t pair_{};
  std::uint64_t now_ = 5 * kSecond;
};

// TM-51 to TM-55: what is taken, why not, and what it tells.
TEST(CanTSyn, ReceiverAgainstModel) {
  std::array<unsigned, VERICAN_TSYN_CAUSES> refused{};
  std::array<unsigned, 3> heard{};
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Twins twins{seed};
    for (int n = 0; n < 300; ++n) {
      ++heard.at(twins.step());
      ASSERT_FALSE(::testing::Test::HasFailure()) << "seed " << seed << ", frame " << n;
    }
    for (std::size_t i = 0; i < refused.size(); ++i) refused.at(i) += twins.refused().at(i);
  }
  for (const unsigned count : refused) EXPECT_GT(count, 1000u);
  for (const unsigned count : heard) EXPECT_GT(count, 10'000u);
}

}  // namespace
}  // namespace vericansim
