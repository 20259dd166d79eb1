// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Worst-case response times on CAN: the exact analysis of Davis, Burns, Bril and Lukkien (2007).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// A periodic or sporadic message; its place in the list is its priority (first = highest).
struct MessageSpec {
  unsigned bytes = 8;     ///< 0..8
  bool extended = false;  ///< 29-bit identifier
  Time period = 0;        ///< or least distance, ps, above 0
  Time jitter = 0;        ///< of queuing, ps
};

/// Longest frame with `bytes` of data including the three bits of intermission: 55 + 10 s bits with
/// 11-bit identifiers, 80 + 10 s with 29-bit ones (worst-case stuffing).
[[nodiscard]] constexpr unsigned worst_case_bits(unsigned bytes, bool extended) {
  return (extended ? 80U : 55U) + 10U * bytes;
}

/// Response times from the event that queues a message until its end on the bus (jitter included),
/// one for each message; nothing for messages whose load with those above reaches or exceeds the
/// bus. Error-free bus, blocking by the longest frame of lower priority. `bit_time` in ps.
[[nodiscard]] std::vector<std::optional<Time>> response_times(
    const std::vector<MessageSpec> &messages, Time bit_time);

/// Load of the bus by worst-case frames, 0..1 and above.
[[nodiscard]] double worst_case_load(const std::vector<MessageSpec> &messages, Time bit_time);

}  // namespace vericansim
