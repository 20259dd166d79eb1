// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A flip of a remote node's flip-flop under traffic, and what it took to make the node work again.
#pragma once

#include <cstdint>

#include "softerror/remote/flop_remote.hpp"

namespace vericansim {

/// What it takes until the node answers and writes as it should, in the order of the attempts.
enum class RemoteCure : std::uint8_t {
  kNone,     ///< nothing
  kRestart,  ///< STATE 81 of the host
  kAssign,   ///< RESTART, then SELECT and ASSIGN: its number is another
  kReset,    ///< rst_ni: the node hangs
  kNever,    ///< not even that: the test bench is wrong
};

struct RemoteOutcome {
  RemoteCure cure = RemoteCure::kNone;
  bool babbled = false;     ///< dominant for longer than any rule allows
  bool wrong_sent = false;  ///< a frame under an identifier of the host (RN-10)
};

/// Clocks from the node's first within which flips shall lie: all of the traffic.
inline constexpr std::uint64_t kFlipFrom = 6'000, kFlipTo = 40'000;

/// Throws std::runtime_error if the traffic without a flip (flip.clock behind its end) is not as it
/// should be.
RemoteOutcome run_flip(const FlopFlip &flip);

}  // namespace vericansim
