// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the bytes of a transfer lie on a bus of 32 bits, little-endian.
#pragma once

#include <cstdint>

#include "node/bus_master.hpp"

namespace vericansim {

/// Bits that `data` of a transfer is shifted by on the bus.
inline unsigned lane_shift(const AhbTransfer &transfer) { return 8 * (transfer.address & 3); }

/// The bits of `data` that count.
inline std::uint32_t value_mask(AhbSize size) {
  if (size == AhbSize::kByte) return 0xFF;
  return size == AhbSize::kHalf ? 0xFFFF : 0xFFFFFFFF;
}

/// What the write data lines carry. The lanes that the transfer does not use carry the complement,
/// so that a slave which takes a wrong lane is found out.
inline std::uint32_t to_lanes(const AhbTransfer &transfer) {
  if (transfer.lanes >= 0 || transfer.size >= AhbSize::kWord) return transfer.data;
  const std::uint32_t mask = value_mask(transfer.size) << lane_shift(transfer);
  const std::uint32_t copies = transfer.size == AhbSize::kByte
                                   ? (transfer.data & 0xFF) * 0x01010101u
                                   : (transfer.data & 0xFFFF) * 0x00010001u;
  return (copies & mask) | (~copies & ~mask);
}

/// What a transfer has read, of the word on the bus.
inline std::uint32_t from_lanes(const AhbTransfer &transfer, std::uint32_t word) {
  if (transfer.lanes >= 0 || transfer.size >= AhbSize::kWord) return word;
  return (word >> lane_shift(transfer)) & value_mask(transfer.size);
}

/// Its byte lanes, bit 0: bits 7:0.
inline std::uint8_t lanes_of(const AhbTransfer &transfer) {
  if (transfer.lanes >= 0) return static_cast<std::uint8_t>(transfer.lanes & 0xF);
  if (transfer.size >= AhbSize::kWord) return 0xF;
  const unsigned bytes = transfer.size == AhbSize::kByte ? 0x1 : 0x3;
  return static_cast<std::uint8_t>((bytes << (transfer.address & 3)) & 0xF);
}

}  // namespace vericansim
