// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlBench: see rtl_bench.hpp.
#include "timesync/rtl_bench.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace vericansim {
namespace {

// An error frame, suspended transmission and intermission are over by then.
constexpr int kCalmBits = 40;
// Before software runs, all nodes are clocked again for so long.
constexpr int kLastBits = 3;

}  // namespace

RtlBench::RtlBench(const SyncCase &setting, IdleGaps gaps, std::uint64_t seed,
                   const std::function<double(unsigned)> &error_of, Accepted accepted)
    : setting_{setting},
      gaps_{gaps},
      bit_{std::llround(static_cast<double>(kSecond) / setting.bitrate)},
      dice_{seed},
      called_(setting.followers + 1) {
  for (unsigned n = 0; n <= setting.followers; ++n) {
    const std::string name = n == 0 ? "master" : "follower" + std::to_string(n);
    stations_.push_back(std::make_unique<RtlStation>(bus, name, clock_of(n, error_of(n)),
                                                     static_cast<std::uint32_t>(setting.bitrate)));
  }
  traffic_ = std::make_unique<RtlTraffic>(
      bus, setting, dice_(),
      [this](Time when, std::function<void()> software) { at(when, std::move(software)); });
  traffic_->on_error = [this] {
    if (on_error) on_error();
  };
  traffic_->others_send = [this] { return !stations_silent(); };
  for (const auto &station : stations_) station->start(accepted.id, accepted.mask);
}

ClockConfig RtlBench::clock_of(unsigned node, double error_ppm) {
  const SyncClocks &clocks = setting_.clocks;
  ClockConfig config;
  config.frequency_hz = clocks.frequency_hz;
  config.error_ppm = error_ppm;
  config.phase = static_cast<Time>(uniform(0, 1e12 / clocks.frequency_hz));
  config.seed = dice_() + node;
  if (clocks.wander > 0) {
    config.wander = Wander::kFree;
    config.wander_density = clocks.wander;
  } else if (clocks.sine_ppm > 0) {
    config.wander = Wander::kSine;
    config.wander_ppm = clocks.sine_ppm;
    config.wander_period = std::llround(clocks.sine_period_s * static_cast<double>(kSecond));
  }
  return config;
}

double RtlBench::uniform(double low, double high) {
  return std::uniform_real_distribution<double>{low, high}(dice_);
}

void RtlBench::at(Time when, std::function<void()> software) {
  software_.push({when, order_++, std::move(software)});
}

void RtlBench::call_handlers() {
  for (unsigned n = 0; n < size(); ++n) {
    if (!stations_[n]->interrupted() || called_[n]) continue;
    called_[n] = true;
    const double latency =
        uniform(static_cast<double>(latency_least), static_cast<double>(latency_most));
    at(bus.now() + std::llround(latency), [this, n] {
      handler(n);
      called_[n] = false;
    });
  }
}

void RtlBench::run(Time end) {
  while (true) {
    call_handlers();
    const Time due = software_.empty() ? end : std::min(end, software_.top().when);
    if (bus.now() < due) {
      advance(due);
    } else if (software_.empty() || software_.top().when > end) {
      return;
    } else {
      const auto work = software_.top().run;
      software_.pop();
      work();
      calm_ = bus.now() + kCalmBits * bit_;
    }
  }
}

bool RtlBench::stations_silent() const {
  return std::all_of(stations_.begin(), stations_.end(),
                     [](const auto &station) { return station->silent(); });
}

bool RtlBench::silent() const {
  return traffic_->silent() && stations_silent() &&
         std::none_of(stations_.begin(), stations_.end(),
                      [](const auto &station) { return station->interrupted(); });
}

// What is early comes over a cable that is shorter for once.
void RtlBench::displace() {
  if (setting_.displaced == 0 || !silent()) return;
  for (unsigned n = 1; n < size(); ++n) {
    const bool early = uniform(0, 1) < setting_.displaced;
    bus.set_delay(0, n, (early ? std::llround(uniform(0, kEarly) * 1e3) : kEarly * kNanosecond));
  }
}

SyncLook RtlBench::look(const std::function<std::uint8_t(unsigned n)> &state_of) {
  SyncLook look{bus.now(), {}};
  const auto master = stations_[0]->reading();
  for (unsigned n = 1; n < size(); ++n)
    look.followers.push_back({ahead(stations_[n]->reading(), master), state_of(n)});
  return look;
}

void RtlBench::advance(Time until) {
  if (gaps_ == IdleGaps::kClocked) return bus.run_until(until);
  if (!silent()) calm_ = bus.now() + kCalmBits * bit_;
  if (bus.now() >= calm_) skip(until);
  bus.run_until(std::min(until, bus.now() + kCalmBits * bit_));
}

// In pieces, if a compare unit or a clock that wanders bounds them.
void RtlBench::skip(Time until) {
  const Time last = until - kLastBits * bit_;
  while (bus.now() < last && bus.skip(last) && last - bus.now() > kLastBits * bit_) {
  }
}

}  // namespace vericansim
