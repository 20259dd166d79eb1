// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See board_rig.hpp. The sequence is that of flexcan.md 8.2, shortened.
#include "linux/board_rig.hpp"

#include "model/registers.hpp"
#include "node/bit_timing.hpp"

namespace vericansim::test {

void bring_up(const RegisterPort &port, unsigned n) {
  const auto write = [&](std::uint32_t offset, std::uint32_t value) {
    port.write(0x1000 * n + offset, value);
  };
  constexpr std::uint32_t kMode = reg::kMcrFrz | reg::kMcrSrxDis | reg::kMcrBcc | 63;
  write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 15);
  while ((port.read(0x1000 * n + reg::kMcr) & reg::kMcrFrzAck) == 0) {
  }
  write(reg::kMcr, kMode | reg::kMcrHalt);
  write(reg::kCtrl, BitTiming{}.ctrl_fields());
  for (unsigned buffer = 0; buffer < 64; ++buffer) {
    write(reg::mb(buffer), 0);
    write(reg::rximr(buffer), 0);
  }
  write(reg::mb(1), reg::kCodeRxEmpty);
  write(reg::mb(63), reg::kCodeTxInactive);
  write(reg::kImask1, 1u << 1);
  write(reg::kImask2, 1u << 31);
  write(reg::kMcr, kMode);
}

void send_frame(const RegisterPort &port, unsigned n, std::uint32_t id, std::uint32_t data) {
  port.write(0x1000 * n + reg::mb(63, 1), id << 18);
  port.write(0x1000 * n + reg::mb(63, 2), data);
  port.write(0x1000 * n + reg::mb(63), reg::kCodeTxData | 4u << 16);
}

}  // namespace vericansim::test
