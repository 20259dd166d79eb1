// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// pcapng captures, in and out. Not by libpcap, which reads them, but tells neither the interface of
// a packet nor its name, and writes none.
#pragma once

#include <string>
#include <string_view>

#include "trace/log.hpp"

namespace vericansim {

/// Reads a capture of either byte order with any resolution of time. Packets of link types that are
/// not CAN (can_packet.hpp) are counted as skipped, as are CAN FD frames and error messages. The
/// channel of an entry is its interface's name. Throws InputError with the number of the block.
[[nodiscard]] CanLog parse_pcapng(std::string_view bytes, const std::string &path);

/// A capture of link type 227 with an interface for each channel ("can0" where there is none),
/// nanoseconds, and directions where they are known. Holds all that a CanLog holds.
[[nodiscard]] std::string pcapng_bytes(const CanLog &log);

}  // namespace vericansim
