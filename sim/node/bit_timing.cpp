// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BitTiming: see bit_timing.hpp.
#include "node/bit_timing.hpp"

#include <stdexcept>
#include <string>

namespace vericansim {
namespace {

void check_range(const char *what, unsigned value, unsigned low, unsigned high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument(std::string{"bit timing: "} + what + " must be " +
                              std::to_string(low) + " to " + std::to_string(high) + ", got " +
                              std::to_string(value));
}

}  // namespace

void BitTiming::validate() const {
  check_range("prescaler", prescaler, 1, 256);
  check_range("PROP_SEG", prop, 1, 8);
  check_range("PHASE_SEG1", ps1, 1, 8);
  check_range("PHASE_SEG2", ps2, 1, 8);
  check_range("SJW", sjw, 1, 4);
  check_range("time quanta per bit", quanta(), 4, 25);
}

std::uint32_t BitTiming::ctrl_fields() const {
  return (prescaler - 1) << 24 | (sjw - 1) << 22 | (ps1 - 1) << 19 | (ps2 - 1) << 16 | (prop - 1);
}

}  // namespace vericansim
