// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Two free-running engines on a bus: what comes of their frames when clocks differ and cables are
// long.
#pragma once

#include <cstdint>

#include "node/core_node.hpp"

namespace vericansim {

struct PairConfig {
  BitTiming timing;
  double clock_hz = 80e6;
  double error_ppm = 0;  ///< first node this much slow, second this much fast
  Time delay = 0;        ///< from either TX pin to the other's RX pin, ps
  Time phase = 0;        ///< first clock edge of the second node, ps
  bool triple_sampling = false;
  unsigned disturb_every = 0;  ///< flips a stuff bit for one receiver in every n-th frame; 0: never
};

struct PairResult {
  unsigned sent = 0;        ///< frames that their sender calls sent
  unsigned received = 0;    ///< of those, frames that came out equal at the other node
  unsigned failed = 0;      ///< attempts that ended in an error or lost arbitration
  unsigned disturbed = 0;   ///< bits that have been flipped
  std::uint8_t errors = 0;  ///< kinds of errors seen, TraceError
};

/// The longest distance between edges that stuffing allows, five d and five r, all through the data
/// field (BT-09; GV-7).
inline const Frame kLongEdgesFrame{
    .id = 0x078, .dlc = 8, .data = {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}};

/// Both nodes send `frames` frames in turn, kLongEdgesFrame and random ones. Gives up after three
/// times the time that takes.
PairResult exchange(const PairConfig &config, unsigned frames);

/// Both nodes want to send at once, `rounds` times: identifiers that differ in one random bit.
/// Received counts both frames of a round.
PairResult contend(const PairConfig &config, unsigned rounds);

}  // namespace vericansim
