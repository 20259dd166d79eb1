// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// UserAccess: one access of user logic to the memory of can_remote.
#pragma once

#include <cstdint>

namespace vericansim {

/// One access at the user port of can_remote.
struct UserAccess {
  bool write = false;
  unsigned lanes = 0;  ///< usr_be_i: bit i: byte i is written
  unsigned word = 0;   ///< address / 4, 0..1023
  std::uint32_t data = 0;
};

/// Puts an access, or none, onto the pins of a Verilated can_remote.
template <typename Model>
inline void show_access(Model &top, const UserAccess *access) {
  const UserAccess shown = access != nullptr ? *access : UserAccess{};
  top.usr_req_i = access != nullptr;
  top.usr_we_i = shown.write;
  // Lanes and data of a read are nobody's business, so they are those of a write that hurts.
  const bool reads = access != nullptr && !shown.write;
  top.usr_be_i = static_cast<std::uint8_t>(reads ? 0xF : shown.lanes);
  top.usr_addr_i = static_cast<std::uint16_t>(shown.word);
  top.usr_wdata_i = reads ? ~shown.data : shown.data;
}

}  // namespace vericansim
