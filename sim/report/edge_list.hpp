// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EdgeList: the changes of a level over time, one to three bytes each.
#pragma once

#include <cstdint>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// Changes of one level as distances in ticks, packed (seven bits a byte, low ones first). Times
/// are rounded to the nearest tick from the start, so rounding does not add up.
class EdgeList {
 public:
  /// Length of a tick, ps.
  static constexpr Time kTick = kNanosecond;
  /// A distance in the list of the report that stands for "so many ticks without a change".
  static constexpr std::uint32_t kLongest = 0xFFFFFFFF;

  EdgeList() = default;
  EdgeList(Time start, Level level) : start_{start}, initial_{level}, level_{level} {}

  /// The level from `time` on (ps, never decreasing); the level that is there already is no change.
  void change(Time time, Level level);

  [[nodiscard]] Level initial() const { return initial_; }
  /// Distances as the report has them, those that are too long split.
  [[nodiscard]] std::vector<std::uint32_t> distances() const;

 private:
  Time start_ = 0;
  Level initial_ = Level::kRecessive;
  Level level_ = Level::kRecessive;
  Time last_ = 0;  // ticks from start_
  std::vector<std::uint8_t> packed_;
};

}  // namespace vericansim
