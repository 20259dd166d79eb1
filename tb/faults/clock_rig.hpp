// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockRig: one engine and one partner on a wire, clock by clock; a ReferenceNode that sees the
// same pin as the engine says in every clock what must come out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "faults/injection_axes.hpp"
#include "faults/reference_node.hpp"
#include "harness/test_wave.hpp"
#include "node/core_node.hpp"

namespace vericansim {

/// The wire is quiet and both nodes are idle after the constructor. The partner is a ReferenceNode,
/// too: it acknowledges, flags and sends as the rules say.
class ClockRig {
 public:
  ClockRig(const BitTiming &timing, const StartCounters &counters);

  /// The DUT (else the partner) sends `frame`.
  void request(const Frame &frame, bool dut);
  /// From `offset` clocks after the coming bit's first clock on, the DUT's pin has this level for
  /// `clocks`; the bit itself is the one that run_bit() runs next.
  void force(unsigned offset, unsigned clocks, Level level);
  /// One bit of the DUT, as the reference has it.
  void run_bit();
  void run_bits(unsigned bits);
  /// Until both nodes are idle with nothing to send; then the partner sends one more frame.
  void finish();

  [[nodiscard]] ReferenceNode &reference() { return reference_; }
  /// What differed first; empty if nothing did. The rig stands still after that.
  [[nodiscard]] std::string report() const { return report_; }

 private:
  void clock();
  void compare(std::uint64_t word, bool sample);
  void compare_counters();
  void differs(const std::string &what);
  [[nodiscard]] bool rests();

  CoreNode dut_;
  ReferenceNode reference_;
  ReferenceNode partner_;
  TestWave wave_{{&dut_}};
  std::uint64_t now_ = 0;
  std::uint64_t force_from_ = 0;
  std::uint64_t force_to_ = 0;
  Level forced_ = Level::kDominant;
  unsigned settle_ = 0;  // clocks until the counters have followed a sample
  std::string report_;
};

}  // namespace vericansim
