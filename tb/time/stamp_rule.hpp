// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference bit of a frame from its bits alone (TM-21), for tests.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "model/frame_codec.hpp"

namespace vericansim {

/// Index of the first bit behind the arbitration field: r1 or r0.
inline std::size_t first_behind_arbitration(const std::vector<WireBit> &bits) {
  for (std::size_t i = 0; i < bits.size(); ++i)
    if (bits[i].field >= Field::kR1 && bits[i].field <= Field::kCrc) return i;
  throw std::logic_error("a frame without a control field");
}

/// Index of the reference bit: the first behind the arbitration field that is dominant behind a
/// recessive one, stuff bits included.
inline std::size_t reference_bit(const std::vector<WireBit> &bits) {
  for (std::size_t i = first_behind_arbitration(bits);
       i < bits.size() && bits[i].field <= Field::kCrc; ++i)
    if (bits[i].level == Level::kDominant && bits[i - 1].level == Level::kRecessive) return i;
  throw std::logic_error("a frame without a reference bit");
}

}  // namespace vericansim
