// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of the pcapng format (IETF draft-ietf-opsawg-pcapng) that its reader and writer share.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vericansim::pcapng {

/// Types of blocks.
inline constexpr std::uint32_t kSection = 0x0A0D0D0A, kInterface = 1, kOldPacket = 2,
                               kSimplePacket = 3, kPacket = 6;
/// The section's mark of its byte order, as a little-endian reader sees it.
inline constexpr std::uint32_t kLittleEndian = 0x1A2B3C4D, kBigEndian = 0x4D3C2B1A;
/// Options of an interface, of a packet, and the end of either.
inline constexpr std::uint16_t kName = 2, kResolution = 9, kOffset = 14, kFlags = 2,
                               kEndOfOptions = 0;
/// Ways of a packet, in its flags.
inline constexpr std::uint32_t kInbound = 1, kOutbound = 2;

/// `size` with what fills up to four bytes.
constexpr std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

}  // namespace vericansim::pcapng
