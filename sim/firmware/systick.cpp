// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SysTick: see systick.hpp.
#include "firmware/systick.hpp"

namespace vericansim::firmware {

// A reload of 0 stops the timer when it gets there; the clock after 0 loads the reload value.
bool SysTick::count() {
  if (value_ == 0) {
    value_ = reload_;
    return false;
  }
  if (--value_ != 0) return false;
  csr_ |= kCountFlag;
  return (csr_ & kTickInt) != 0;
}

std::uint32_t SysTick::read(std::uint32_t offset) {
  switch (offset) {
    case 0: {
      const std::uint32_t value = csr_;
      csr_ &= ~kCountFlag;
      return value;
    }
    case 4: return reload_;
    case 8: return value_;
    default: return 1U << 30;  // SKEW: the reference is no exact 10 ms; TENMS unknown
  }
}

void SysTick::write(std::uint32_t offset, std::uint32_t value) {
  switch (offset) {
    case 0: csr_ = (csr_ & kCountFlag) | (value & (kEnable | kTickInt | kClockSource)); break;
    case 4: reload_ = value & kMask24; break;
    case 8:  // any write clears the counter and COUNTFLAG, without an exception
      value_ = 0;
      csr_ &= ~kCountFlag;
      break;
    default: break;
  }
}

}  // namespace vericansim::firmware
