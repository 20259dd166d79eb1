// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HardwareFollower: see hardware_follower.hpp.
#include "timesync/hardware_follower.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace vericansim {
namespace {

TimeSyncSetting setting_of(const SyncCase &setting, std::uint32_t id) {
  const double period = 1e9 / setting.clocks.frequency_hz;
  TimeSyncSetting result;
  result.id = id;
  const FollowerGains gains = gains_of(setting);
  result.ki = gains.ki;
  result.kd = gains.kd;
  result.halve = !setting.restless;
  // Holdover as the driver's: three intervals, here a power of two of ns.
  result.tmo = static_cast<unsigned>(std::ceil(std::log2(3e9 * setting.interval_s)));
  result.delay = static_cast<std::int32_t>(std::lround(kReceiveLatency * period / 2));
  result.nominal = static_cast<std::uint64_t>(std::llround(period * 4294967296.0));
  return result;
}

}  // namespace

// 2^32 / (R f).
FollowerGains gains_of(const SyncCase &setting) {
  const double clocks = setting.interval_s * setting.clocks.frequency_hz;
  return {static_cast<unsigned>(std::lround(32 - std::log2(clocks))), setting.restless ? 1U : 2U};
}

HardwareFollower::HardwareFollower(const SyncCase &setting, std::uint32_t id)
    : setting_{setting_of(setting, id)}, model_{setting_} {}

std::optional<SyncAction> HardwareFollower::frame(const std::uint8_t (&data)[8],
                                                  std::uint64_t stamp, std::int64_t edge,
                                                  ClockNode &clock) {
  Frame frame{.id = setting_.id, .dlc = 8};
  std::copy(std::begin(data), std::end(data), frame.data.begin());
  const std::uint8_t before = state(clock.at(edge));
  const auto action = model_.frame(frame, stamp, clock.increment());
  if (!action) return {};
  const std::uint64_t increment = action->increment.value_or(clock.increment());
  clock.apply(edge, {action->shift, increment, false, 0});
  last_ = clock.at(edge);
  SyncAction done{.shift = action->shift, .increment = increment};
  done.state = state(last_);
  done.events = VERICAN_SERVO_ACCEPTED;
  if (model_.pairs() == 0) done.events |= VERICAN_SERVO_STEP;
  if (done.state != before) done.events |= VERICAN_SERVO_STATE;
  return done;
}

std::uint8_t HardwareFollower::state(std::uint64_t now) {
  const auto silence = static_cast<std::int64_t>(now - last_);
  if (silence >= std::int64_t{1} << setting_.tmo) model_.timeout();
  return static_cast<std::uint8_t>(model_.state());
}

}  // namespace vericansim
