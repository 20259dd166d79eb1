// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortBlock: ports of one byte each that two Verilated models have side by side in the same order,
// compared and copied many at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace vericansim {

/// Some ports of a block, given as bytes 0xFF of `mask`, byte 0 of mask[0] being the first port of
/// the block. The block of each model must have 8 * Words bytes; those not in the mask are kept.
template <std::size_t Words>
struct PortBlock {
  std::array<std::uint64_t, Words> mask;

  /// Whether a port of the two blocks, which begin at `a` and `b`, differs.
  [[nodiscard]] bool differ(const void *a, const void *b) const {
    const auto x = load(a), y = load(b);
    std::uint64_t changed = 0;
    for (std::size_t i = 0; i < Words; ++i) changed |= (x[i] ^ y[i]) & mask[i];
    return changed != 0;
  }

  /// The ports of the block at `from` go to that at `to`.
  void copy(void *to, const void *from) const {
    auto x = load(to);
    const auto y = load(from);
    for (std::size_t i = 0; i < Words; ++i) x[i] = (x[i] & ~mask[i]) | (y[i] & mask[i]);
    std::memcpy(to, x.data(), sizeof x);
  }

  /// Whether member `port` lies `place` bytes behind member `first` of the same object, as `other`
  /// does behind `first_other` of another, each of one byte. A constant after optimisation.
  template <typename A, typename B>
  [[nodiscard]] static bool aligned(std::ptrdiff_t place, const A &first, const A &port,
                                    const B &first_other, const B &other) {
    return sizeof(A) == 1 && sizeof(B) == 1 && &port - &first == place &&
           &other - &first_other == place;
  }

 private:
  using Bytes = std::array<std::uint64_t, Words>;
  static Bytes load(const void *block) {
    Bytes bytes;
    std::memcpy(bytes.data(), block, sizeof bytes);
    return bytes;
  }
};

}  // namespace vericansim
