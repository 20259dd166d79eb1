// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ServoModel: the whole servo as the rules say it (TM-80 to TM-87, TM-89), with 128-bit integers
// and without limits of its own: which pairs count, which filter is in use, what the clock gets.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "driver/servo_reference.hpp"
#include "verican/servo.h"

namespace vericansim {

inline Wide size_of(Wide value) { return value < 0 ? -value : value; }

class ServoModel {
 public:
  explicit ServoModel(const verican_servo_config_t &config) : config_{config} {}

  struct Outcome {
    std::int64_t shift = 0;
    std::uint64_t increment = 0;
    bool slew = false;
    unsigned events = 0;
  };

  Outcome take(const verican_sync_pair_t &pair) {
    Outcome out;
    out.increment = pair.increment;
    const verican_sync_state_t before = state;
    decide(pair, out);
    if (state != before) out.events |= VERICAN_SERVO_STATE;
    return out;
  }

  /// TM-87: silence.
  bool poll(std::uint64_t now) {
    const bool follows = state == VERICAN_SYNC_LOCKED || state == VERICAN_SYNC_ACQUIRING;
    if (!follows || silence(now) <= Wide{config_.hold_after} * config_.interval_us * 1000)
      return false;
    state = state == VERICAN_SYNC_LOCKED ? VERICAN_SYNC_HOLDOVER : VERICAN_SYNC_UNSYNCHRONISED;
    forget();
    return true;
  }

  /// TM-89: another master.
  void forget() {
    history.points.clear();
    pairs_ = 0;
    leaps_.clear();
    dropped_ = false;
  }

  /// TM-87: E up to whole ns, in holdover ppb of each ms begun, and 1 ns.
  [[nodiscard]] std::uint64_t bound(std::uint64_t now) const {
    const Wide error = (Wide{error_} + 255) / 256;
    if (state != VERICAN_SYNC_HOLDOVER) return static_cast<std::uint64_t>(error);
    const Wide ms = silence(now) / 1'000'000 + 1;
    return static_cast<std::uint64_t>(error + ms * config_.drift_ppb / 1000 + 1);
  }

  /// TM-85: 6 E + 2 T, 1/256 ns.
  [[nodiscard]] std::int64_t gate(std::uint64_t increment) const {
    return static_cast<std::int64_t>(6 * error_ + 2 * period(increment));
  }
  /// TM-86: as it holds now, ns.
  [[nodiscard]] std::int64_t leap() const {
    const std::int64_t interval = state == VERICAN_SYNC_LOCKED ? 0 : config_.interval_us;
    return std::int64_t{config_.leap_ns} + interval;
  }
  /// TM-84: the length in use.
  [[nodiscard]] unsigned filter() const { return config_.filter != 0 ? config_.filter : chosen_; }
  /// What the servo is not told to take away, ns.
  [[nodiscard]] std::int64_t base() const { return base_; }

  verican_sync_state_t state = VERICAN_SYNC_UNSYNCHRONISED;
  ServoReference history;

 private:
  static Wide period(std::uint64_t increment) { return increment >> 24; }
  [[nodiscard]] Wide silence(std::uint64_t now) const {
    return std::max<Wide>(static_cast<std::int64_t>(now - last_), 0);
  }

  void decide(const verican_sync_pair_t &pair, Outcome &out) {
    const auto whole =
        static_cast<std::int64_t>(pair.local - pair.master) - config_.delay_ns - base_;
    const Wide late = floor_of(Wide{128} * pair.latency * Wide{pair.increment}, Wide{1} << 32);
    const Wide x = Wide{256} * whole - late;
    const bool first = state == VERICAN_SYNC_UNSYNCHRONISED;
    if (first) begin(pair.increment);
    if (first || size_of(x) > Wide{256} * leap()) {
      if (state == VERICAN_SYNC_LOCKED && !means_it(whole, gate(pair.increment))) {
        out.events |= VERICAN_SERVO_LEAP;
        return;
      }
      step(whole, out);
      accept(pair, -late, out);
      return;
    }
    leaps_.clear();
    if (drops(x, gate(pair.increment))) {
      out.events |= VERICAN_SERVO_OUTLIER;
    } else {
      accept(pair, x, out);
    }
  }

  // TM-84: each mean begins with T.
  void begin(std::uint64_t increment) {
    misses_.fill(static_cast<std::int64_t>(period(increment)));
    learned_ = errors_ = 0;
  }
  // TM-86: three in a row, each within the gate of the last.
  bool means_it(std::int64_t whole, std::int64_t gate) {
    if (!leaps_.empty() && 256 * size_of(Wide{whole} - leaps_.back()) > gate) leaps_.clear();
    leaps_.push_back(whole);
    return leaps_.size() >= 3;
  }
  // TM-85.
  bool drops(Wide x, std::int64_t gate) {
    const bool may = state == VERICAN_SYNC_LOCKED || pairs_ >= 4;
    const bool drop = may && size_of(x) > gate && !dropped_;
    if (history.points.size() >= 2) {
      errors_ = std::min(errors_ + 1, 8);
      error_ += (static_cast<std::int64_t>(std::min<Wide>(size_of(x), gate)) - error_) / errors_;
    }
    dropped_ = drop;
    return drop;
  }
  void step(std::int64_t whole, Outcome &out) {
    forget();
    state = VERICAN_SYNC_ACQUIRING;
    out.events |= VERICAN_SERVO_STEP;
    (config_.keep_offset ? base_ : out.shift) += config_.keep_offset ? whole : -whole;
  }
  // TM-84.
  void learn(std::int64_t local, Wide x) {
    if (history.points.size() < 2) return;
    learned_ = std::min(learned_ + 1, 255);
    if (config_.filter != 0) return;
    const Wide ticks = floor_of(Wide{local} - history.points.back().local, 4096);
    const int weight = std::min(learned_ + 1, 16);
    for (std::size_t i = 0; i < misses_.size(); ++i) {
      const std::size_t n = std::min<std::size_t>(history.points.size(), (1u << i) + 1);
      const ServoReference::Line line = history.fit(n);
      const Wide miss = size_of(line.a + floor_of(Wide{line.b} * ticks, Wide{1} << 24) - x);
      misses_[i] += static_cast<std::int64_t>((miss - misses_[i]) / weight);
    }
    const std::int64_t best = *std::min_element(misses_.begin(), misses_.end());
    for (std::size_t i = 0; i < misses_.size(); ++i)
      if (4 * misses_[i] <= 5 * best) chosen_ = 1u << i;
  }
  void accept(const verican_sync_pair_t &pair, Wide x, Outcome &out) {
    const std::int64_t local = static_cast<std::int64_t>(pair.local) + out.shift;
    learn(local, x);
    history.points.push_back({local, static_cast<std::int64_t>(x)});
    const std::size_t room = config_.filter != 0 ? config_.filter + 1u : 17u;
    if (history.points.size() > room) history.points.erase(history.points.begin());
    const std::size_t n = std::min<std::size_t>(history.points.size(), filter() + 1);
    const auto due = history.correct(n, static_cast<std::int64_t>(pair.now) + out.shift,
                                     out.increment, config_.keep_offset, config_.keep_rate);
    drop_old();
    out.slew = state == VERICAN_SYNC_LOCKED && size_of(due.exact) <= 256 * 1000;
    out.shift += due.shift;
    out.increment = due.increment;
    out.events |= VERICAN_SERVO_ACCEPTED;
    last_ = static_cast<std::uint64_t>(history.points.back().local);
    if (state == VERICAN_SYNC_LOCKED) return;
    ++pairs_;
    const bool chosen = config_.filter != 0 || learned_ >= 10;
    state = pairs_ >= 4 && chosen ? VERICAN_SYNC_LOCKED : VERICAN_SYNC_ACQUIRING;
  }
  // The history ends before a point that is 2^25 - 1 ticks old or 2^20 ns off, and keeps the
  // newest.
  void drop_old() {
    std::vector<ServoReference::Point> &points = history.points;
    for (std::size_t i = points.size() - 1; i-- > 0;) {
      const Wide age = -floor_of(Wide{points[i].local} - points.back().local, 4096);
      if (age < (1 << 25) - 1 && size_of(points[i].x) < 256 * (1 << 20)) continue;
      points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i + 1));
      return;
    }
  }

  verican_servo_config_t config_;
  std::int64_t base_ = 0, error_ = 0;
  std::uint64_t last_ = 0;
  std::array<std::int64_t, 5> misses_{};
  unsigned chosen_ = 16;
  int learned_ = 0, errors_ = 0, pairs_ = 0;
  std::vector<std::int64_t> leaps_;
  bool dropped_ = false;
};

}  // namespace vericansim
