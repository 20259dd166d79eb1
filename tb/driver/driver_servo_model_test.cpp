// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The servo beside a model of its rules: the same pairs, silences and changes of the master to
// both, everything that comes out compared. Offsets lie by preference where a rule has its limit.
#include <gtest/gtest.h>

#include <random>

#include "driver/servo_model.hpp"
#include "driver/servo_rig.hpp"

namespace vericansim {
namespace {

class Twins {
 public:
  Twins(const verican_servo_config_t &config, std::uint64_t seed)
      : dice_{seed}, config_{config}, model_{config} {
    EXPECT_EQ(verican_servo_init(&servo_, &config), VERICAN_OK);
    increment_ = in(std::uint64_t{10} << 32, std::uint64_t{200} << 32);
  }

  /// A pair, or `also` something else.
  void act(bool also = true) {
    switch (also ? in(0, 19) : 19) {
      case 0: return fall_silent();
      case 1:
        EXPECT_EQ(verican_servo_forget(&servo_), VERICAN_OK);
        model_.forget();
        return;
      case 2:  // a rate that somebody else has set
        increment_ = in(std::uint64_t{10} << 32, std::uint64_t{200} << 32);
        return;
      default: return pair();
    }
  }
  [[nodiscard]] unsigned events() const { return events_; }
  [[nodiscard]] unsigned states() const { return states_; }

 private:
  template <class Number>
  Number in(Number low, Number high) {
    return std::uniform_int_distribution<Number>{low, high}(dice_);
  }
  /// Own time less the master's, ns, without what is known of it; `late` is the latency.
  std::int64_t offset(std::int64_t late) {
    const std::int64_t near = in<std::int64_t>(-1, 1), sign = in(0, 1) == 0 ? 1 : -1;
    switch (in(0, 9)) {
      case 0:  // the gate itself, in whole ns
        return sign * (model_.gate(increment_) / 256) + late + near;
      case 1: return sign * model_.leap() + late + near;
      case 2:
      case 3:  // leaps that agree, or just not
        if (in(0, 2) == 0) leap_ = sign * in<std::int64_t>(400'000, 9'000'000'000);
        return leap_ += sign * (model_.gate(increment_) / 256 + near);
      case 4: return sign * in<std::int64_t>(0, 2'000);
      default: return in<std::int64_t>(-60, 60);
    }
  }
  void pair() {
    const std::uint64_t interval = std::uint64_t{config_.interval_us} * 1000;
    verican_sync_pair_t pair{};
    pair.increment = increment_;
    pair.latency = static_cast<std::uint8_t>(in(0, 9));
    const auto late = static_cast<std::int64_t>(pair.latency * increment_ >> 33);
    now_ += in(interval / 2, interval + interval / 2);
    pair.local = now_;
    pair.master = now_ - static_cast<std::uint64_t>(model_.base() + config_.delay_ns) -
                  static_cast<std::uint64_t>(offset(late));
    pair.now = now_ + in<std::uint64_t>(0, 20'000'000);
    verican_correction_t got{};
    ASSERT_EQ(verican_servo_pair(&servo_, &pair, &got), VERICAN_OK);
    const ServoModel::Outcome expected = model_.take(pair);
    ASSERT_EQ(got.events, expected.events);
    ASSERT_EQ(got.shift, expected.shift);
    ASSERT_EQ(got.increment, expected.increment);
    ASSERT_EQ(got.slew, expected.slew);
    events_ |= got.events;
    now_ = pair.now + static_cast<std::uint64_t>(got.shift);
    compare();
  }
  void fall_silent() {
    const std::uint64_t limit = std::uint64_t{config_.interval_us} * 1000 * config_.hold_after;
    const auto since = static_cast<std::uint64_t>(servo_.last);
    const std::uint64_t later = since + limit + in<std::uint64_t>(0, 2) - 1;
    now_ = std::max(now_, later);
    ASSERT_EQ(verican_servo_poll(&servo_, later), model_.poll(later));
    compare();
  }
  void compare() {
    ASSERT_EQ(servo_.state, static_cast<unsigned>(model_.state));
    ASSERT_EQ(servo_.filter, model_.filter());
    const std::uint64_t then = now_ + in<std::uint64_t>(0, 4'000'000'000) - 1'000'000;
    ASSERT_EQ(verican_servo_bound(&servo_, then), model_.bound(then));
    states_ |= 1u << servo_.state;
  }

  std::mt19937_64 dice_;
  verican_servo_config_t config_;
  ServoModel model_;
  verican_servo_t servo_{};
  std::uint64_t now_ = std::uint64_t{1'700'000'000} * 1'000'000'000, increment_ = 0;
  std::int64_t leap_ = 5'000'000;
  unsigned events_ = 0, states_ = 0;
};

verican_servo_config_t some_config(std::mt19937_64 &dice, unsigned run) {
  verican_servo_config_t config{};
  verican_servo_config_default(&config);
  config.filter = static_cast<std::uint8_t>(run % 3 == 0 ? 0 : 1u << run % 5);
  config.interval_us = static_cast<std::uint32_t>(50'000 + dice() % 400'000);
  config.leap_ns = static_cast<std::uint32_t>(50'000 + dice() % 100'000);
  config.drift_ppb = static_cast<std::uint32_t>(dice() % 5'000);
  config.delay_ns = static_cast<std::int32_t>(dice() % 2'000) - 500;
  config.hold_after = static_cast<std::uint8_t>(1 + dice() % 4);
  config.keep_offset = run % 11 == 7;
  config.keep_rate = run % 13 == 5;
  return config;
}

// TM-80 to TM-87, TM-89: bit by bit.
TEST(Servo, AgainstModel) {
  std::mt19937_64 dice{8087};
  unsigned events = 0, states = 0;
  for (unsigned run = 0; run < 600; ++run) {
    Twins twins{some_config(dice, run), dice()};
    for (unsigned n = 0; n < 150; ++n) {
      twins.act();
      ASSERT_FALSE(::testing::Test::HasFailure()) << "run " << run << ", step " << n;
    }
    events |= twins.events();
    states |= twins.states();
  }
  EXPECT_EQ(events, 0x1Fu);
  EXPECT_EQ(states, 0xFu);
}

// TM-84: the filters go on learning evenly, however many pairs there have been.
TEST(Servo, AgainstModelForLong) {
  std::mt19937_64 dice{8084};
  for (int run = 0; run < 20; ++run) {
    Twins twins{some_config(dice, 0), dice()};
    for (unsigned n = 0; n < 1500; ++n) {
      twins.act(false);
      ASSERT_FALSE(::testing::Test::HasFailure()) << "run " << run << ", step " << n;
    }
  }
}

}  // namespace
}  // namespace vericansim
