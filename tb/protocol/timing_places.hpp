// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Ways to bring a TimingBench to a place in the bit stream.
#pragma once

#include "protocol/timing_bench.hpp"

namespace vericansim {

/// Pairs of equal bits: no stuff bit in ID and data, and each level follows a recessive one
/// somewhere.
inline const Frame kPairsFrame{.id = 0x333, .dlc = 2, .data = {0x33, 0x33}};

/// Starts the bench; the partner (DUT) begins to send kPairsFrame.
void receive_frame(TimingBench &bench);
void send_frame(TimingBench &bench);

/// The DUT sends kPairsFrame and stands at the first clock of a bit of `field` in which it sends
/// `level`, behind a bit sampled recessive.
void reach_sent(TimingBench &bench, Field field, Level level);
/// The DUT receives kPairsFrame and stands at a bit of `field`, not its first, behind a bit sampled
/// recessive.
void reach_received(TimingBench &bench, Field field);

}  // namespace vericansim
