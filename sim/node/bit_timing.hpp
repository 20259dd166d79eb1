// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BitTiming: the settings of a bit in clocks and time quanta, as a user thinks of them (BT-01).
#pragma once

#include <cstdint>

namespace vericansim {

/// Bit timing in clocks and time quanta (not register encodings). Default: 8 clocks a bit.
struct BitTiming {
  unsigned prescaler = 1;  ///< clocks per time quantum, 1..256
  unsigned prop = 3;       ///< PROP_SEG, 1..8 tq
  unsigned ps1 = 2;        ///< PHASE_SEG1, 1..8 tq
  unsigned ps2 = 2;        ///< PHASE_SEG2, 1..8 tq
  unsigned sjw = 1;        ///< 1..4 tq

  [[nodiscard]] constexpr unsigned quanta() const { return 1 + prop + ps1 + ps2; }
  [[nodiscard]] constexpr unsigned clocks_per_bit() const { return prescaler * quanta(); }
  /// Throws std::invalid_argument naming the first value that is out of range (BT-02; 4..25 tq).
  void validate() const;
  /// The timing fields of CTRL: PRESDIV, RJW, PSEG1, PSEG2, PROPSEG (flexcan.md 1.2). Throws as
  /// validate().
  [[nodiscard]] std::uint32_t ctrl_fields() const;

  friend bool operator==(const BitTiming &, const BitTiming &) = default;
};

}  // namespace vericansim
