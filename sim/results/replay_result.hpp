// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayResult: what has become of a recording that a node has sent.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// A node that should have every frame of the recording.
struct ReplayReceiver {
  std::string node;
  std::uint64_t expected = 0;    ///< frames that were on the bus and that its core stores
  std::uint64_t received = 0;    ///< of these, bit-exact and in order
  std::string first_difference;  ///< empty if it has all
};

/// One recording.
struct ReplayResult {
  std::string node;
  std::string file;
  std::uint64_t frames = 0;     ///< to be sent, in a loop up to the end of the run
  std::uint64_t sent = 0;       ///< of these, on the bus and acknowledged, bit-exact and in order
  std::uint64_t late = 0;       ///< due before the end of the run, and not sent
  std::uint64_t skipped = 0;    ///< entries of the log that are no classical frames
  Time recorded = 0;            ///< between the first and the last frame in the log
  Time longest_gap = 0;         ///< between two frames
  std::uint64_t after_gap = 0;  ///< number of the frame after it
  bool none_of_share = false;   ///< the frames of the recording are those of other nodes
  std::string failure;  ///< why not all could be sent: nothing to send, given up; empty: all well
  std::vector<std::string> warnings;  ///< of the recording, as in CanLog
  std::vector<ReplayReceiver> receivers;
  [[nodiscard]] bool ok() const;
};

/// Gaps from this one on are told to people.
inline constexpr Time kLongGap = 3600 * kSecond;

/// "yes, at 2 nodes", or "NO: " and why: whether every frame came, bit-exact and in order.
[[nodiscard]] std::string verdict(const ReplayResult &replay);

/// Lines for people.
[[nodiscard]] std::string to_text(const std::vector<ReplayResult> &replays);
/// Everything, times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const ReplayResult &replay);

/// "2.5 days", for long times.
[[nodiscard]] std::string long_time(Time time);

}  // namespace vericansim
