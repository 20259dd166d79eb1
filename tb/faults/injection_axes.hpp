// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The axes of the error injection matrix (rule book 19.1): start counters, frames, reactions of LT.
#pragma once

#include <string>
#include <vector>

#include "faults/injection_rig.hpp"
#include "model/frame.hpp"
#include "model/frame_codec.hpp"

namespace vericansim {

/// All start counters of 19.1, in TEC alone, in REC alone and in both; active and passive.
[[nodiscard]] const std::vector<StartCounters> &all_counters();
/// A choice of them that holds every state and every limit.
[[nodiscard]] const std::vector<StartCounters> &main_counters();
[[nodiscard]] std::string name_of(const StartCounters &counters);
/// "A", or what makes the state passive: "P(tec)", "P(rec)", "P(both)".
[[nodiscard]] std::string state_of(const StartCounters &counters);

/// A frame as it stands on the wire.
struct Stream {
  std::string name;
  Frame frame;
  EncodeOptions options;
};

/// Base and extended, data and remote, DLC 0, 1, 8 and 15, runs of 1 to 5 equal bits, final stuff
/// bits of both levels.
[[nodiscard]] const std::vector<Stream> &all_streams();
/// Frames whose reserved bits or SRR have the level that transmitters do not send (FF-05).
[[nodiscard]] const std::vector<Stream> &odd_streams();

/// What LT does after the disturbed bit: it first plays `now`; with `go` it then goes on with the
/// wire of the scene, and with `flag` only until the DUT shows a flag, which it answers with that.
struct Reaction {
  std::string name;
  std::string now;
  bool go = false;
  std::string flag;
};

/// L0, L1, L2 and Lk with k = 1..16 at once after the disturbed bit.
[[nodiscard]] std::vector<Reaction> plain_reactions();
/// LT goes on with its frame: to its end, or until the DUT's flag.
[[nodiscard]] std::vector<Reaction> going_reactions();
/// The disturbed bit was the SOF of another frame: with a low, with a high identifier.
[[nodiscard]] std::vector<Reaction> starting_reactions();
/// One list behind the other.
[[nodiscard]] std::vector<Reaction> join(std::vector<std::vector<Reaction>> lists);

/// The frames that starting_reactions() send.
inline const Frame kLowFrame{.id = 0x001, .dlc = 1, .data = {0xA5}};
inline const Frame kHighFrame{.id = 0x7A5, .dlc = 1, .data = {0x3C}};

}  // namespace vericansim
