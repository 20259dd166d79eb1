// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The data of SYNC and FUP (docs/time-spec.md, 7.1), for tests: they do not use the driver's.
#pragma once

#include <array>
#include <cstdint>

namespace vericansim {

/// What the eight bytes say.
struct TsynData {
  unsigned type = 0;       ///< byte 0: 0x10 SYNC, 0x18 FUP, and others
  unsigned user = 0;       ///< byte 1: of the user, or the CRC
  unsigned domain = 0;     ///< 0 to 15
  unsigned sc = 0;         ///< sequence counter, modulo 16
  unsigned byte3 = 0;      ///< of SYNC: of the user; of FUP: SGW and whole seconds
  std::uint32_t word = 0;  ///< seconds or nanoseconds

  [[nodiscard]] std::array<std::uint8_t, 8> bytes() const {
    const auto low = [](std::uint32_t value) { return static_cast<std::uint8_t>(value); };
    return {low(type),      low(user),       low(domain << 4 | sc % 16),
            low(byte3),     low(word >> 24), low(word >> 16),
            low(word >> 8), low(word)};
  }
};

}  // namespace vericansim
