// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockNode: the clock register of a node on its oscillator (docs/time-spec.md, TM-10), and its
// stamps (TM-26), in closed form.
#pragma once

#include <cstdint>

#include "timesync/oscillator.hpp"
#include "verican/servo.h"

namespace vericansim {

/// Half clocks from an edge at the receive pin to its stamp, as TCAP.RXLAT tells software: two
/// synchroniser flip-flops, 1.5 clocks on average.
inline constexpr std::uint8_t kReceiveLatency = 3;

/// A clock register; the increment is the nominal one at first. Edges are those of the oscillator,
/// by number, and never go back.
class ClockNode {
 public:
  ClockNode(const Oscillator &oscillator, std::uint64_t start_ns);

  /// TIME behind an edge, ns.
  [[nodiscard]] std::uint64_t at(std::int64_t edge) const;
  /// TIME at `t`.
  [[nodiscard]] std::uint64_t now(Nanoseconds t) { return at(oscillator.last_edge(t)); }
  /// Shift and rate from an edge on; what is to be slewed goes at once.
  void apply(std::int64_t edge, const verican_correction_t &correction);
  /// The continuous reading of section 0, less that of `other`, ns.
  [[nodiscard]] Nanoseconds ahead_of(ClockNode &other, Nanoseconds t);
  /// The stamp of a frame whose reference edge reaches the receive pin at `edge`.
  [[nodiscard]] std::uint64_t receive_stamp(Nanoseconds edge);
  /// The increment, 2^-32 ns.
  [[nodiscard]] std::uint64_t increment() const { return increment_; }

  Oscillator oscillator;

 private:
  [[nodiscard]] Nanoseconds since_edge(Nanoseconds t);
  [[nodiscard]] std::uint64_t carries(std::uint64_t clocks) const;

  std::uint64_t increment_;
  // NS, FR and C of TM-10 behind edge_.
  std::uint64_t whole_;
  std::uint32_t fraction_ = 0;
  bool carry_ = false;
  std::int64_t edge_ = 0;
};

}  // namespace vericansim
