// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Range checks: see range.hpp.
#include "bus/range.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace vericansim {

void refuse_range(const char *what, std::uint64_t value, std::uint64_t low, std::uint64_t high) {
  throw std::invalid_argument(fmt::format("{} must be {} to {}, got {}", what, low, high, value));
}

Time bit_time_of(double bitrate) {
  if (!(bitrate >= 1e3 && bitrate <= 1e6))
    throw std::invalid_argument(
        fmt::format("bit rate must be 1000 to 1000000 bit/s, got {}", bitrate));
  return static_cast<Time>(std::llround(1e12 / bitrate));
}

}  // namespace vericansim
