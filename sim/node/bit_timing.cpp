// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BitTiming: see bit_timing.hpp.
#include "node/bit_timing.hpp"

#include "bus/range.hpp"

namespace vericansim {

void BitTiming::validate() const {
  require_range("bit timing: prescaler", prescaler, 1, 256);
  require_range("bit timing: PROP_SEG", prop, 1, 8);
  require_range("bit timing: PHASE_SEG1", ps1, 1, 8);
  require_range("bit timing: PHASE_SEG2", ps2, 1, 8);
  require_range("bit timing: SJW", sjw, 1, 4);
}

std::uint32_t BitTiming::ctrl_fields() const {
  validate();
  return (prescaler - 1) << 24 | (sjw - 1) << 22 | (ps1 - 1) << 19 | (ps2 - 1) << 16 | (prop - 1);
}

}  // namespace vericansim
