// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Time and levels: the two quantities of a bus.
#pragma once

#include <cstdint>
#include <limits>

namespace vericansim {

/// Simulated time in picoseconds; 2^63 ps are 106 days.
using Time = std::int64_t;

/// Real time in nanoseconds, of any clock that never goes back.
using WallTime = std::int64_t;

inline constexpr Time kPicosecond = 1;
inline constexpr Time kNanosecond = 1'000;
inline constexpr Time kMicrosecond = 1'000'000;
inline constexpr Time kMillisecond = 1'000'000'000;
inline constexpr Time kSecond = 1'000'000'000'000;

/// The last time that a bus can reach; a span from here or from anywhere that goes beyond ends
/// here.
inline constexpr Time kEndOfTime = std::numeric_limits<Time>::max() - 1;

/// `span` (not negative) behind `time`, at most the end of time.
constexpr Time time_behind(Time time, Time span) {
  return span < kEndOfTime - time ? time + span : kEndOfTime;
}

/// A level on the wire. The bus is the AND of its drivers: one dominant node wins (rule book, 0).
enum class Level : std::uint8_t { kDominant = 0, kRecessive = 1 };

/// Wired AND of two drivers.
constexpr Level operator&(Level a, Level b) {
  return (a == Level::kRecessive && b == Level::kRecessive) ? Level::kRecessive : Level::kDominant;
}

/// The opposite level.
constexpr Level operator!(Level a) {
  return a == Level::kDominant ? Level::kRecessive : Level::kDominant;
}

}  // namespace vericansim
