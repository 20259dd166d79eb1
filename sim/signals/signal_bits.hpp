// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the bits of a signal are in a frame's data.
#pragma once

#include "signals/database.hpp"

namespace vericansim {

/// Calls use(place, weight) for each bit of the signal, from its least significant one (weight 0)
/// on. Bit n of byte k has the place 8 * k + n.
template <typename Use>
void for_each_bit(const Signal &signal, Use use) {
  if (signal.little_endian) {
    for (unsigned weight = 0; weight < signal.length; ++weight) use(signal.start + weight, weight);
    return;
  }
  // Down from the most significant bit: to bit 0 of a byte, then on from bit 7 of the next one.
  unsigned place = signal.start;
  for (unsigned weight = signal.length; weight-- > 0;) {
    use(place, weight);
    place = place % 8 == 0 ? place + 15 : place - 1;
  }
}

/// Ones where a raw value has the bits of the signal.
[[nodiscard]] inline std::uint64_t mask_of(const Signal &signal) {
  return ~std::uint64_t{0} >> (64 - signal.length);
}

/// Bytes that a frame needs to hold the signal.
[[nodiscard]] inline unsigned bytes_needed(const Signal &signal) {
  unsigned last = 0;
  for_each_bit(signal, [&](unsigned place, unsigned) { last = last < place ? place : last; });
  return last / 8 + 1;
}

}  // namespace vericansim
