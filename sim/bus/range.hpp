// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Range checks of what callers hand to the simulator.
#pragma once

#include <cstdint>

#include "bus/types.hpp"

namespace vericansim {

/// Throws std::invalid_argument "WHAT must be LOW to HIGH, got VALUE".
[[noreturn]] void refuse_range(const char *what, std::uint64_t value, std::uint64_t low,
                               std::uint64_t high);

/// As refuse_range() unless `value` is `low` to `high`.
constexpr void require_range(const char *what, std::uint64_t value, std::uint64_t low,
                             std::uint64_t high) {
  if (value < low || value > high) refuse_range(what, value, low, high);
}

/// Length of a bit. Throws std::invalid_argument unless `bitrate` is 1000 to 1,000,000 bit/s.
[[nodiscard]] Time bit_time_of(double bitrate);

}  // namespace vericansim
