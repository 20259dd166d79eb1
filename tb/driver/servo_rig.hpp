// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ServoRig: the servo with pairs whose offsets are given, of a clock with 62.5 ns (16 MHz).
#pragma once

#include <cstdint>

#include "verican/servo.h"

namespace vericansim {

inline constexpr std::uint64_t kIncrement16MHz = 0x3E'8000'0000;
inline constexpr std::int64_t kSecondNs = 1'000'000'000;

class ServoRig {
 public:
  explicit ServoRig(std::uint8_t filter = 8) : ServoRig{defaults(filter)} {}
  explicit ServoRig(const verican_servo_config_t &config) {
    result = verican_servo_init(&servo, &config);
  }
  static verican_servo_config_t defaults(std::uint8_t filter = 8) {
    verican_servo_config_t config{};
    verican_servo_config_default(&config);
    config.filter = filter;
    return config;
  }

  /// A pair `wait` behind the last one, the own clock ahead by `offset` ns; handled 1 ms later. The
  /// correction is applied.
  verican_correction_t pair(std::int64_t offset, std::int64_t wait = kSecondNs) {
    master += wait;
    verican_sync_pair_t pair{};
    pair.master = static_cast<std::uint64_t>(master);
    pair.local = static_cast<std::uint64_t>(master + offset);
    pair.now = pair.local + 1'000'000;
    pair.increment = increment;
    verican_correction_t correction{};
    verican_servo_pair(&servo, &pair, &correction);
    increment = correction.increment;
    return correction;
  }
  /// Pairs without an offset until LOCKED, and then some.
  void lock(unsigned pairs = 12) {
    for (unsigned n = 0; n < pairs; ++n) pair(0);
  }
  [[nodiscard]] bool poll(std::int64_t behind_last) {
    return verican_servo_poll(&servo, static_cast<std::uint64_t>(master + behind_last));
  }
  [[nodiscard]] verican_sync_state_t state() const {
    return static_cast<verican_sync_state_t>(servo.state);
  }

  verican_result_t result{};
  verican_servo_t servo{};
  std::int64_t master = 1'700'000'000 * kSecondNs;
  std::uint64_t increment = kIncrement16MHz;
};

}  // namespace vericansim
