// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packets of captures that hold frames of SocketCAN, whatever file they stand in.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "trace/log_builder.hpp"
#include "trace/text.hpp"

namespace vericansim {

/// Link types (tcpdump.org, LINKTYPE_...) that a packet can have.
inline constexpr int kLinkSocketCan = 227, kLinkCooked = 113, kLinkCooked2 = 276;

/// True if frames can be read from packets of this type.
[[nodiscard]] bool is_can_link(int link_type);
/// "227 (SocketCAN), 113 (Linux cooked), 276 (Linux cooked, version 2)", for messages.
extern const char *const kCanLinks;

/// Where a packet comes from.
struct PacketSource {
  int link_type = kLinkSocketCan;
  bool big_endian = false;  ///< byte order of the recording computer: of identifiers in cooked ones
  std::string interface;    ///< its name, if the file has one
  Direction direction = Direction::kUnknown;
};

/// Adds the frame of a packet to `log`; one that holds none is counted as skipped. Throws
/// InputError if it is cut short or contradicts itself.
void add_can_packet(std::span<const std::uint8_t> bytes, const PacketSource &source,
                    std::int64_t ns, LogBuilder &log, const text::Place &place);

/// The packet of link type 227 for a frame.
[[nodiscard]] std::string can_packet(const Frame &frame);
/// The same for a CAN FD frame or error message.
[[nodiscard]] std::string can_packet(const ForeignEntry &entry);

}  // namespace vericansim
