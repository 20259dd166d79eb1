// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame: a CAN 2.0 data or remote frame as a user thinks of it.
#pragma once

#include <array>
#include <cstdint>

namespace vericansim {

/// The largest identifier of a format.
constexpr std::uint32_t highest_id(bool extended) { return extended ? 0x1FFFFFFF : 0x7FF; }

/// Throws std::invalid_argument that says what `id` was and what is allowed.
[[noreturn]] void refuse_id(const char *what, std::uint32_t id, bool extended);

/// As refuse_id() unless `id` fits 11 or, if `extended`, 29 bits.
constexpr void require_id(const char *what, std::uint32_t id, bool extended) {
  if (id > highest_id(extended)) refuse_id(what, id, extended);
}

/// A data or remote frame. `dlc` is the raw code on the wire, 0..15 (FF-07); only payload_size()
/// bytes of `data` mean something and the others are zero.
struct Frame {
  std::uint32_t id = 0;   ///< 11 bits (0..0x7FF) or, if `extended`, 29 bits (0..0x1FFFFFFF)
  bool extended = false;  ///< IDE: 29-bit identifier
  bool remote = false;    ///< RTR: remote frame, carries no data
  std::uint8_t dlc = 0;   ///< 0..15; 9..15 mean eight bytes (FF-07, FF-08)
  std::array<std::uint8_t, 8> data{};

  /// Bytes that travel in the data field: min(dlc, 8), or 0 for a remote frame (FF-03).
  [[nodiscard]] constexpr unsigned payload_size() const {
    if (remote) return 0;
    return dlc > 8 ? 8u : dlc;
  }

  /// The word in which a controller's registers hold bytes `first` to `first` + 3 (0 or 4), the
  /// most significant first.
  [[nodiscard]] constexpr std::uint32_t data_word(unsigned first) const {
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) word = (word << 8) | data[first + i];
    return word;
  }

  /// Throws std::invalid_argument if the identifier does not fit its format or dlc > 15. All that
  /// takes frames does so with this, and cuts nothing off.
  void validate() const;

  friend bool operator==(const Frame &, const Frame &) = default;
};

}  // namespace vericansim
