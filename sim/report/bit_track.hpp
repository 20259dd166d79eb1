// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BitTrack: follows one node bit by bit: place in the frame, begin and length of each bit.
#pragma once

#include <cstdint>

#include "bus/clock.hpp"
#include "bus/trace.hpp"
#include "bus/types.hpp"
#include "node/bit_timing.hpp"

namespace vericansim {

/// One bit of one node.
struct TrackedBit {
  Time time = 0;                ///< of the sample point, ps
  double start = 0;             ///< where the bit begins, ps
  double tq = 0;                ///< time quantum, ps, error of the clock included
  unsigned quanta = 0;          ///< of a nominal bit
  Field field = Field::kInteg;  ///< as in the trace, but SOF for every node's SOF
  std::uint8_t index = 0;       ///< bits of the field before it, stuff bits not counted
  bool stuff = false;
  Level rx = Level::kRecessive, tx = Level::kRecessive;
  bool transmitter = false;
  bool begins = false;       ///< a frame begins: this is its SOF
  int lengthened = 0;        ///< quanta by which it was longer before its sample point
  int previous_changed = 0;  ///< quanta by which the bit before turned out longer or shorter

  /// True if the node takes no part in the traffic of the bus in this bit.
  [[nodiscard]] bool quiet() const { return field <= Field::kIdle || field == Field::kSuspend; }
  /// True from SOF to EOF7.
  [[nodiscard]] bool in_frame() const { return field >= Field::kSof && field <= Field::kEof; }
};

/// The bits of a node, from its records. Where a bit begins follows from the distance of the sample
/// points: a positive phase error lengthens a bit before its sample point, a negative one shortens
/// the bit before behind its sample point, and a hard synchronisation ends the bit before (rule
/// book 14).
class BitTrack {
 public:
  BitTrack(const BitTiming &timing, const Clock &clock) : timing_{timing}, clock_{&clock} {}

  /// The next bit of the node.
  const TrackedBit &take(const BitRecord &record);
  [[nodiscard]] const TrackedBit &bit() const { return bit_; }
  /// From the begin of a nominal bit to its sample point, quanta.
  [[nodiscard]] unsigned sample_quanta() const { return 1 + timing_.prop + timing_.ps1; }
  [[nodiscard]] const BitTiming &timing() const { return timing_; }

 private:
  void place(const BitRecord &record, const TrackedBit &before);
  void measure(const TrackedBit &before);

  BitTiming timing_;
  const Clock *clock_;
  TrackedBit bit_;
  std::uint8_t left_ = 0;
};

}  // namespace vericansim
