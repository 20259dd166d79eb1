// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See time_sync_model.hpp.
#include "model/time_sync_model.hpp"

#include <algorithm>
#include <limits>

namespace vericansim {

namespace {

constexpr std::uint64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kStep = 1 << 20, kStepLocked = 1 << 12;  // ns, TM-103
constexpr std::uint64_t kIncrementMask = (1ULL << 40) - 1;
constexpr unsigned kFullPairs = 8, kAcquiringPairs = 12;
constexpr unsigned kMostPairs = 255;

// Big-endian word in bytes 4 to 7 (time-spec.md section 7.1).
std::uint64_t word(const Frame &frame) {
  std::uint64_t value = 0;
  for (unsigned i = 4; i < 8; ++i) value = value * 256 + frame.data[i];
  return value;
}

}  // namespace

std::uint32_t TimeSyncSetting::ctrl_word() const {
  return (enable ? 1u : 0u) | domain << 4 | (halve ? 1u << 8 : 0u) | (pps ? 1u << 9 : 0u) |
         ki << 16 | kd << 21 | tmo << 24;
}

std::uint32_t TimeSyncSetting::id_word() const { return extended ? 1u << 31 | id : id << 18; }

std::uint32_t TimeSyncSetting::delay_word() const {
  return static_cast<std::uint32_t>(delay) & 0xFFFFFF;
}

// TM-101, but for the sequence counter.
bool TimeSyncModel::mine(const Frame &frame) const {
  return setting_.enable && !frame.remote && frame.dlc == 8 && frame.id == setting_.id &&
         frame.extended == setting_.extended && frame.data[2] >> 4 == setting_.domain;
}

std::optional<TimeSyncAction> TimeSyncModel::frame(const Frame &frame, std::uint64_t stamp,
                                                   std::uint64_t increment) {
  if (!mine(frame)) return {};
  const unsigned type = frame.data[0], sc = frame.data[2] & 15;
  if (type == 0x10 || type == 0x20) {
    waiting_ = true;
    sc_ = sc;
    stamp_ = stamp;
    seconds_ = word(frame);
    return {};
  }
  if ((type != 0x18 && type != 0x28) || !waiting_ || sc != sc_) return {};
  waiting_ = false;
  const std::uint64_t whole = kSecondNs * (seconds_ + (frame.data[3] & 3));
  return pair(whole, whole + word(frame), increment);
}

// TM-102 to TM-104.
std::optional<TimeSyncAction> TimeSyncModel::pair(std::uint64_t whole, std::uint64_t master,
                                                  std::uint64_t increment) {
  const auto o = static_cast<std::int64_t>(
      stamp_ - master - static_cast<std::uint64_t>(std::int64_t{setting_.delay}));
  using Limits = std::numeric_limits<std::int32_t>;
  offset_ = static_cast<std::int32_t>(std::clamp<std::int64_t>(o, Limits::min(), Limits::max()));
  const bool locked = state_ == State::kLocked;
  const std::int64_t limit = locked ? kStepLocked : kStep;
  const bool large = o >= limit || o <= -limit;
  if (locked && large && !leap_) {
    leap_ = true;
    return {};
  }
  leap_ = false;
  TimeSyncAction action;
  action.shift = static_cast<std::int64_t>(-static_cast<std::uint64_t>(o));
  if (large && state_ == State::kAcquiring) {
    action.increment = setting_.nominal;
    state_ = State::kUnsynchronised;
    pairs_ = 0;
    return action;
  }
  if (large || state_ == State::kUnsynchronised || state_ == State::kHoldover) {
    if (setting_.pps && (large || state_ == State::kUnsynchronised)) action.whole = whole;
    state_ = State::kAcquiring;
    pairs_ = 0;
    return action;
  }
  const bool light = locked || pairs_ >= kFullPairs;
  const unsigned k = light ? setting_.ki - setting_.kd : setting_.ki;
  const std::uint64_t change = static_cast<std::uint64_t>(o) << k;
  action.increment = (increment - change) & kIncrementMask;
  if (light && setting_.halve) {
    const std::int64_t half = o >= 0 ? o / 2 : (o - 1) / 2;
    action.shift = -half;
  }
  pairs_ = std::min(pairs_ + 1, kMostPairs);
  if (pairs_ == kAcquiringPairs) state_ = State::kLocked;
  return action;
}

void TimeSyncModel::timeout() {
  if (state_ == State::kAcquiring || state_ == State::kLocked) state_ = State::kHoldover;
}

}  // namespace vericansim
