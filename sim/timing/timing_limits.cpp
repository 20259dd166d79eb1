// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Limits of clocks and delays: see timing_limits.hpp and docs/integration.md.
#include "timing/timing_limits.hpp"

#include <algorithm>
#include <cmath>

namespace vericansim {
namespace {

constexpr double kBitsBetweenEdges = 10;  // BT-09
constexpr double kLongestFrame = 147;     // bits from SOF to the CRC delimiter, with stuff bits

/// One bus, everything in quanta.
class Limits {
 public:
  Limits(const BitTiming &timing, double quantum_ns, const BusDelays &delays)
      : t_{timing},
        quanta_{static_cast<double>(timing.quanta())},
        loop_{2 * (delays.one_way_ns + delays.core_ns) / quantum_ns},
        core_{delays.core_ns / quantum_ns},
        this_core_{delays.this_core} {}

  /// BT-07: the bit of the other end of the bus is there at the sample point, 13 bits after the
  /// last synchronisation. SYNC_SEG gives this core a quantum of its delay back.
  [[nodiscard]] double sampled_in_time() const {
    const double returned = this_core_ ? std::min(1.0, core_) : 0;
    return (t_.prop + t_.ps1 - (loop_ - returned)) / (2 * (13 * quanta_ - t_.ps2));
  }

  /// BT-08, exactly: the sum of both clocks' errors over ten bits is SJW, over 13 bits PS2.
  [[nodiscard]] double synchronised() const {
    return std::min(t_.sjw / (2 * kBitsBetweenEdges * quanta_ + t_.sjw),
                    t_.ps2 / (26 * quanta_ - t_.ps2));
  }

  /// Two neighbours followed the same sender until the far end of the bus won arbitration, whose
  /// edges come later by the loop delay. Both move SJW towards them with each edge, and away from
  /// each other by their clocks. Then the fast one acknowledges, and the slow one still has to
  /// sample a recessive CRC delimiter.
  [[nodiscard]] bool neighbours_agree(double error) const {
    const double drift = 2 * kBitsBetweenEdges * quanta_ * error;  // from edge to edge
    const double late = std::floor(loop_ + drift);
    const double moves = std::floor(late / t_.sjw);  // of both by SJW
    const double rest = late - moves * t_.sjw;       // then the slow one is in place
    const double apart = drift * (moves + 1) + std::max(0.0, drift - t_.sjw + rest);
    const double most = 2 * quanta_ * error * kLongestFrame;
    return std::min(apart, most) + early() * (1 - error) <= t_.ps2 * (1 + error);
  }

 private:
  /// How much earlier one node's bit may begin than that of a neighbour who follows the same edges:
  /// they measure to the quantum, less what an edge between them takes.
  [[nodiscard]] double early() const { return std::max(this_core_ ? -1.0 : 0.0, 1 - core_); }

  const BitTiming &t_;
  double quanta_, loop_, core_;
  bool this_core_;
};

}  // namespace

double textbook_limit(const BitTiming &timing) {
  const double quanta = timing.quanta();
  const double phase = std::min(timing.ps1, timing.ps2);
  return std::min(phase / (2 * (13 * quanta - timing.ps2)), timing.sjw / (20 * quanta));
}

bool clocks_hold(const BitTiming &timing, double quantum_ns, const BusDelays &delays,
                 double error) {
  const Limits limits{timing, quantum_ns, delays};
  return error <=
             std::min({limits.sampled_in_time(), limits.synchronised(), textbook_limit(timing)}) &&
         limits.neighbours_agree(error);
}

}  // namespace vericansim
