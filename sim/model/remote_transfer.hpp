// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteTransfer: the block transfer that is open (section 5).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "model/frame.hpp"

namespace vericansim {

/// State of BLOCK and DATA; at most one transfer is open (RN-42).
struct RemoteTransfer {
  enum class Kind : std::uint8_t { kNone = 0, kRead = 1, kWrite = 2 };  ///< as op of BLOCK

  Kind kind = Kind::kNone;
  std::uint8_t tag = 0;
  unsigned address = 0;  ///< of the next byte
  unsigned done = 0;     ///< bytes
  unsigned left = 0;     ///< bytes
  std::uint8_t seq = 0;  ///< of the next frame
  unsigned gap = 0;      ///< ms between frames of a read
  unsigned wait = 0;     ///< ms until the next may come
  unsigned idle = 0;     ///< ms without a frame of a write
  /// An answer of BLOCK that is not yet in the queue.
  std::optional<Frame> answer;

  [[nodiscard]] bool open() const { return kind != Kind::kNone; }
};

}  // namespace vericansim
