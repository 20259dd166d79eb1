// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SysTick: the 24-bit timer of the Cortex-M3 (ARMv7-M, B3.3).
#pragma once

#include <cstdint>

namespace vericansim::firmware {

/// The timer. Its reference clock (CSR.CLKSOURCE = 0) is the CPU clock divided by kReference.
class SysTick {
 public:
  static constexpr unsigned kReference = 8;

  /// One CPU clock. True if the timer reached 0 and asks for its exception.
  bool clock() {
    if ((csr_ & kEnable) == 0) return false;
    if ((csr_ & kClockSource) == 0 && ++divider_ % kReference != 0) return false;
    return count();
  }

  /// Word registers CSR, RVR, CVR, CALIB at `offset` 0, 4, 8, 12. Reading CSR clears COUNTFLAG.
  [[nodiscard]] std::uint32_t read(std::uint32_t offset);
  void write(std::uint32_t offset, std::uint32_t value);

 private:
  static constexpr std::uint32_t kEnable = 1, kTickInt = 2, kClockSource = 4, kCountFlag = 1 << 16,
                                 kMask24 = 0xFF'FFFF;

  bool count();

  std::uint32_t csr_ = 0, reload_ = 0, value_ = 0;
  unsigned divider_ = 0;
};

}  // namespace vericansim::firmware
