// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HardFrames: frames that make synchronisation hard: few edges, and senders that stay together far
// into arbitration.
#pragma once

#include <cstdint>
#include <random>

#include "model/frame.hpp"

namespace vericansim {

/// Frames for up to four senders. Runs of equal bits are mostly five long, so that with stuff bits
/// ten bits lie between two edges that synchronise (BT-09); for some frames identifiers differ from
/// a common one in one bit, so that who leads changes anywhere in arbitration.
class HardFrames {
 public:
  explicit HardFrames(std::uint64_t seed) : random_{seed} {}

  /// The next frame of `sender`, 0..3, when `sent` frames have been on the bus. No two senders have
  /// an identifier in common.
  [[nodiscard]] Frame next(unsigned sender, unsigned sent);
  [[nodiscard]] std::uint64_t random() { return random_(); }

 private:
  [[nodiscard]] std::uint64_t runs();

  std::mt19937_64 random_;
  unsigned epoch_ = ~0u;
  std::uint64_t common_ = 0;  // 29 bits
  bool extended_ = false;
};

}  // namespace vericansim
