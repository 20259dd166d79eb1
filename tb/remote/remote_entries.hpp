// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Entries of producers and maps as bytes (RN-63, RN-65), for tests of the RTL and of its model.
#pragma once

#include <vector>

namespace vericansim {

/// Bits of a producer's mode, above its length.
namespace mode {
constexpr unsigned kOn = 0x80;
constexpr unsigned kTriggers = 0x40;
constexpr unsigned kChange = 0x20;
constexpr unsigned kCyclic = 0x10;
}  // namespace mode

/// Where entry `k` of a table lies.
constexpr unsigned producer_at(unsigned k) { return 0xF40 + 8 * k; }
constexpr unsigned map_at(unsigned k) { return 0xF80 + 8 * k; }

/// A producer's five bytes.
inline std::vector<unsigned> producer_bytes(unsigned a, unsigned mode, unsigned period,
                                            unsigned gap = 0) {
  return {a, mode, period & 0xFF, period >> 8, gap};
}

/// A map entry that is on.
inline std::vector<unsigned> map_bytes(unsigned id, unsigned mask, unsigned address, unsigned flags,
                                       unsigned time_out = 0) {
  return {id & 0xFF,      id >> 8 | 0x80, mask & 0xFF, mask >> 8,
          address & 0xFF, address >> 8,   flags,       time_out};
}

}  // namespace vericansim
