// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeSyncModel: the follower without a CPU as its rules say it (docs/time-spec.md, TM-101 to
// TM-104), in whole numbers of 64 bits.
#pragma once

#include <cstdint>
#include <optional>

#include "model/frame.hpp"

namespace vericansim {

/// What the registers TSCTRL, TSID and TSDLY hold.
struct TimeSyncSetting {
  bool enable = true;
  unsigned domain = 0;      ///< 0 to 15
  bool halve = false;       ///< PHALF
  unsigned ki = 0, kd = 0;  ///< 0 to 31, 0 to 3; kd <= ki
  unsigned tmo = 37;        ///< holdover after 2^tmo ns
  bool pps = false;
  bool extended = false;  ///< of the identifier
  std::uint32_t id = 0;
  std::int32_t delay = 0;               ///< ns, 24 bits
  std::uint64_t nominal = 20ULL << 32;  ///< TimeInc: increment after a reset

  /// The registers' words.
  [[nodiscard]] std::uint32_t ctrl_word() const;
  [[nodiscard]] std::uint32_t id_word() const;
  [[nodiscard]] std::uint32_t delay_word() const;
};

/// What a pair does to the clock.
struct TimeSyncAction {
  std::int64_t shift = 0;                  ///< ns to add
  std::optional<std::uint64_t> increment;  ///< new one, 40 bits: ns and 2^-32 ns a clock
  std::optional<std::uint64_t> whole;  ///< with PPS, of a step: the whole second of the pair, ns
  bool ends_slew = true;               ///< what is left of a slew becomes 0

  friend bool operator==(const TimeSyncAction &, const TimeSyncAction &) = default;
};

/// The follower.
class TimeSyncModel {
 public:
  enum class State : std::uint8_t { kUnsynchronised, kAcquiring, kLocked, kHoldover };

  explicit TimeSyncModel(const TimeSyncSetting &setting) : setting_{setting} {}

  /// A frame that ended without error, its stamp, and the increment of the clock then. An action if
  /// it was the FUP of a pair that is not ignored.
  std::optional<TimeSyncAction> frame(const Frame &frame, std::uint64_t stamp,
                                      std::uint64_t increment);
  /// 2^tmo ns have passed since the last pair.
  void timeout();

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] unsigned pairs() const { return pairs_; }
  [[nodiscard]] unsigned sc() const { return sc_; }
  /// As TSOFS tells it: the last offset, cut to 32 bits.
  [[nodiscard]] std::int32_t offset() const { return offset_; }

 private:
  [[nodiscard]] bool mine(const Frame &frame) const;
  std::optional<TimeSyncAction> pair(std::uint64_t whole, std::uint64_t master,
                                     std::uint64_t increment);

  TimeSyncSetting setting_;
  State state_ = State::kUnsynchronised;
  unsigned pairs_ = 0, sc_ = 0;
  std::int32_t offset_ = 0;
  bool waiting_ = false, leap_ = false;
  std::uint64_t stamp_ = 0, seconds_ = 0;
};

}  // namespace vericansim
