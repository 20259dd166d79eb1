// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The register map as a table, for tests.
#pragma once

#include <cstdint>

#include "harness/core_build.hpp"

namespace vericansim {

/// A register, or an array of them. Words that name bits have a 1 for each bit that is so.
struct RegisterRow {
  const char *name = "";
  std::uint32_t offset = 0;  ///< bytes, of the first one
  unsigned count = 1;        ///< 0 stands for NumMb
  unsigned stride = 4;       ///< bytes
  int first_buffer = -1;     ///< the buffer that bit 0 stands for; -1: bits are no buffers
  unsigned min_num_mb = 16;  ///< smaller cores have not got it
  bool in_ram = false;       ///< not reset by hardware without the feature clear_ram
  bool adds_num_mb = false;  ///< `reset` is to be raised by NumMb
  std::uint32_t reset = 0;   ///< value after the hard reset
  std::uint32_t after_soft_reset =
      0;                   ///< value after the soft reset, of the bits that are not kept
  std::uint32_t kept = 0;  ///< bits kept over the soft reset
  std::uint32_t live = 0;  ///< bits that show a state
  /// Bits by access, those that are not plainly stored.
  std::uint32_t ro = 0, w1c = 0, rc = 0, w1s = 0, wo = 0;
  /// Stored bits, by when a write counts.
  std::uint32_t any = 0, freeze = 0, disable = 0, wrn_en = 0;
  /// Bits that are there only with a feature, and what they read without.
  std::uint32_t needs_fifo = 0, needs_abort = 0, needs_status = 0, needs_own_masks = 0;
  std::uint32_t needs_wake = 0, needs_extras = 0, needs_clear_ram = 0, needs_time_unit = 0;
  std::uint32_t needs_time_sync = 0;
  std::uint32_t without = 0;
  bool without_adds_last_mb = false;  ///< `without` is to be raised by NumMb - 1

  /// The bits that a core with these features lacks.
  [[nodiscard]] constexpr std::uint32_t missing(const Features &has) const {
    return (has.fifo ? 0 : needs_fifo) | (has.abort ? 0 : needs_abort) |
           (has.status ? 0 : needs_status) | (has.own_masks ? 0 : needs_own_masks) |
           (has.wake ? 0 : needs_wake) | (has.extras ? 0 : needs_extras) |
           (has.clear_ram ? 0 : needs_clear_ram) | (has.time_unit ? 0 : needs_time_unit) |
           (has.time_sync ? 0 : needs_time_sync);
  }
};

inline constexpr RegisterRow kRegisterTable[] = {
#include "mailbox/register_table.inc"
};

}  // namespace vericansim
