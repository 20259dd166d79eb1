// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What of a remote node's memory the bus can write at all, and entries of its map that can never
// have an effect (section 8 of docs/remote-node.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/remote_config.hpp"

namespace vericansim {

/// Addresses from `first` to below `end`.
struct RemoteArea {
  unsigned first = 0, end = 0;
};

/// Memory, configuration and the tables that the node has, in order of address.
[[nodiscard]] std::vector<RemoteArea> remote_areas(const RemoteConfig &config);
/// "0x0 to 0xDFF, 0xF00 to 0xF1F".
[[nodiscard]] std::string to_text(const std::vector<RemoteArea> &areas);
/// The area with this address; none: a pair of zeros.
[[nodiscard]] RemoteArea area_of(const std::vector<RemoteArea> &areas, std::uint64_t address);

/// An entry of the map (RN-65).
struct RemoteMapEntry {
  unsigned id = 0, mask = 0, address = 0, flags = 0, time_out = 0;
  /// Bytes that it writes of each frame; 0: as many as the frame has.
  [[nodiscard]] unsigned length() const { return flags & 0x0F; }
  /// Bytes it writes from `address` on: those of a frame, or a copy of the bits that are not
  /// compared.
  [[nodiscard]] unsigned span() const;
};

/// Why no frame, or no time-out, can ever make the entry do what it is there for, at a node of this
/// number; empty: one can.
[[nodiscard]] std::string why_never(const RemoteMapEntry &entry, const RemoteConfig &config,
                                    unsigned number);

}  // namespace vericansim
