// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases of register fuzzing: sequences of AHB transfers, drawn at random or read from a file.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "node/ahb_master.hpp"

namespace vericansim::fuzz {

using Random = std::mt19937_64;

/// A number from 0 to `below` - 1.
inline std::uint64_t draw(Random &random, std::uint64_t below) { return random() % below; }
/// True `percent` times of 100.
inline bool chance(Random &random, unsigned percent) { return random() % 100 < percent; }

/// One case: transfers back to back, but for their own pauses.
using RegisterCase = std::vector<AhbTransfer>;

/// 8 to 64 transfers: every register and buffer, reserved and unmapped addresses, all sizes and
/// alignments, bursts with BUSY, pauses with IDLE; data at random, at corners, and such as drivers
/// write. `users`: some without privilege.
[[nodiscard]] RegisterCase draw_case(Random &random, bool users);

/// One line: "W 00000080 2 0C080000 hprot 3 burst 0 trans 2 pause 0" (size as in HSIZE).
[[nodiscard]] std::string to_text(const AhbTransfer &transfer);

/// What an episode of cases is; one file of text, which --replay takes.
struct Episode {
  std::uint64_t seed = 0;  ///< core, mode, traffic and pins
  std::vector<RegisterCase> cases;
};
[[nodiscard]] std::string to_text(const Episode &episode);
/// Throws InputError with the line that is none.
[[nodiscard]] Episode parse_episode(const std::string &text, const std::string &file);

/// What the documentation says of an access: the ERROR response for sizes above a word, unaligned
/// addresses and those beyond the window of 8 KiB (docs/integration.md).
[[nodiscard]] bool expects_error(const AhbTransfer &transfer);

}  // namespace vericansim::fuzz
