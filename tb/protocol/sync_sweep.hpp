// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The sweep SY-19: one edge with a phase error in every kind of bit, and what the rules say of it.
#pragma once

#include <string>
#include <vector>

#include "model/fault_confinement.hpp"
#include "protocol/timing_places.hpp"

namespace vericansim {

/// A place where the sweep puts its edge: the bench is brought to the first clock of a bit whose
/// predecessor was sampled recessive.
struct SweepPlace {
  const char *name;
  Role role;
  Level sent;
  bool hard;
  bool early_edges;  ///< false: SY-21 has no case for an edge after the sample point
  void (*reach)(TimingBench &);
};

[[nodiscard]] const std::vector<SweepPlace> &sweep_places();

/// Puts an edge with phase error `e` (quanta; -PS2..PROP+PS1) there and compares this sample, the
/// next SYNC_SEG and the next sample with SY-06, SY-08 and SY-10, to the clock. Returns what
/// differs, empty if nothing does. The prescaler must be 4 or more, for the edge has to pass the
/// synchroniser within its quantum.
[[nodiscard]] std::string check_edge(const SweepPlace &place, const BitTiming &timing, int e);

}  // namespace vericansim
