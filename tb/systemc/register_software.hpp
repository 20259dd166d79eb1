// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Small software that works the registers by hand, for tests that want to see each access.
#pragma once

#include <cstdint>

#include "model/registers.hpp"
#include "node/bit_timing.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {

/// 16 clocks a bit: 500 kbit/s at 8 MHz.
inline constexpr BitTiming kPlainTiming{.prescaler = 1, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 2};
/// MCR of a node on the bus: 64 buffers, does not hear itself.
inline constexpr std::uint32_t kPlainRun = reg::kMcrSrxDis | 63;

/// The way of docs/integration.md, "Registers": up to the bus. Buffer 0 receives everything and
/// buffer 8 sends; both interrupt.
inline void join(Master &cpu) {
  cpu.write32(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | kPlainRun);
  while ((cpu.read32(reg::kMcr) & reg::kMcrLpmAck) != 0) {
  }
  while ((cpu.read32(reg::kMcr) & reg::kMcrFrzAck) == 0) {
  }
  cpu.write32(reg::kCtrl, kPlainTiming.ctrl_fields());
  for (unsigned n = 0; n < 64; ++n) {
    cpu.write32(reg::mb(n), 0);
    for (unsigned word = 1; word < 4; ++word) cpu.write32(reg::mb(n, word), 0);
  }
  cpu.write32(reg::kRxgmask, 0);
  cpu.write32(reg::mb(0), reg::kCodeRxEmpty);
  cpu.write32(reg::mb(8), reg::kCodeTxInactive);
  cpu.write32(reg::kImask1, 0x101);
  cpu.write32(reg::kMcr, kPlainRun);
  while ((cpu.read32(reg::kMcr) & reg::kMcrFrzAck) != 0) {
  }
}

/// Sends a base frame of two bytes from buffer 8.
inline void send_plain(Master &cpu, std::uint32_t id, std::uint16_t data) {
  cpu.write32(reg::mb(8, 1), id << 18);
  cpu.write32(reg::mb(8, 2), std::uint32_t{data} << 16);
  cpu.write32(reg::mb(8), reg::kCodeTxData | (2u << 16));
}

}  // namespace vericansim
