// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The same scenario in the C++ simulator and in SystemC, and what was seen of it in each: every
// clock of the AHB, every change of the wire.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/ahb_checker.hpp"
#include "systemc/driver_program.hpp"
#include "systemc/verican_tlm.hpp"

namespace vericansim {

/// One clock of an AHB, as settled at its end; clocks without a row were idle.
struct AhbRow {
  std::uint64_t cycle = 0;
  AhbRequest request;
  AhbResponse response;
};

/// A change of a level.
struct Change {
  Time time = 0;
  Level level = Level::kRecessive;
  friend bool operator==(const Change &, const Change &) = default;
};

/// What was seen of one run.
struct Seen {
  std::vector<std::vector<AhbRow>> ahb;  ///< of each node
  std::vector<std::vector<Change>> tx;   ///< of each node
  std::vector<Change> level;             ///< at the star point
  std::vector<verican_stats_t> stats;    ///< of each driver
  std::vector<std::vector<verican_frame_t>> received;
  std::vector<std::vector<std::uint32_t>> registers;  ///< of each node at the end, without TIMER
};

/// A node with software.
struct ScenarioNode {
  ClockConfig clock;
  Link link;
  DriverProgram::Settings program;
  unsigned num_mb = 64;
};

/// Nodes, and one that spoils the bus: it is dominant from each of the times for its length, in
/// clocks of `spoiler_clock`.
struct Story {
  std::vector<ScenarioNode> nodes;
  ClockConfig spoiler_clock;
  std::vector<std::pair<std::uint64_t, unsigned>> spoils;  ///< clock, length; in order; none:
                                                           ///< no such node
  Time end = 0;
};

/// How the SystemC run differs from the plain one.
struct SystemcVariant {
  TlmTiming timing = TlmTiming::kCycleExact;
  bool clk_ports = false;       ///< clocks come through clk; else the modules' own
  unsigned delta_lag = 0;       ///< delta cycles by which node n's clock comes late, times n + 1
  Time quantum = kMicrosecond;  ///< loosely timed
  bool debugger = false;        ///< one reads all registers again and again
  unsigned shifted_start = 0;   ///< clocks by which the last node starts late
};

Seen run_in_simulator(const Story &scenario);
/// Once in a process.
Seen run_in_systemc(const Story &scenario, const SystemcVariant &variant);

/// The first difference in words, or nothing.
std::string first_difference(const Seen &expected, const Seen &found);

}  // namespace vericansim
