// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The judges beside a frame that an error destroys in its first bits.
#include <gtest/gtest.h>

#include <string>

#include "random/judged_run.hpp"

namespace vericansim {
namespace {

/// Node a saturates the bus; node b, with 64 buffers and 8 clocks a bit, sends its last buffer from
/// 1 ms on, beside a CPU that reads without a pause. The bus is recessive for a bit from `at` ns
/// on: both have the error at the same time where both begin a frame, so that no flag is longer
/// than six bits.
Scenario destroyed_at(unsigned at) {
  std::string reads;
  for (unsigned i = 0; i < 600; ++i) reads += ", read MB20.DATA0";
  return parse_scenario(
      "retry.yaml",
      "judge: lockstep\nbitrate: 1000000\ndrain: 0\nduration: 1400 us\nnodes:\n"
      "  - {name: a, timing: {brp: 1, prop: 3, ps1: 2, ps2: 2, sjw: 1}, mailboxes: 16, tx_buffers: "
      "2}\n"
      "  - {name: b, timing: {brp: 1, prop: 3, ps1: 2, ps2: 2, sjw: 1}, software: none}\n"
      "traffic:\n"
      "  - {node: a, id: 0x121, dlc: 0, period: saturated}\n"
      "faults:\n"
      "  - {kind: recessive, node: all, from: " +
          std::to_string(at) +
          " ns, for: 1 us}\n"
          "accesses:\n"
          "  - {node: b, at: 5 us, do: [write MCR 0x5000000F, until MCR 0x1100000 0x1000000,"
          " write MCR 0x5002003F, write CTRL1 0x90002, write MB63.ID 0x1400000,"
          " write MCR 0x4002003F, until MCR 0x1000000 0]}\n"
          "  - {node: b, at: 1 ms, do: [write MB63.CS 0xC000000" +
          reads + "]}\n");
}

// IF-03, IF-07: the frame begins right behind the intermission, whichever of its first bits was
// destroyed: there is no time to look at all buffers again.
TEST(JudgedRetry, AfterAnErrorInItsFirstBits) {
  constexpr unsigned kHalves = 40;  // of bits: from before its SOF into its identifier
  unsigned errors = 0;
  for (unsigned half = 0; half < kHalves; ++half) {
    const JudgedRun run = run_judged(destroyed_at(1'035'000 + half * 500));
    for (const std::string &finding : run.findings)
      ADD_FAILURE() << half << " half bits: " << finding;
    errors += run.counts.errors != 0 ? 1 : 0;
    EXPECT_GE(run.frames, 15u);
  }
  EXPECT_GT(errors, kHalves / 4);
}

}  // namespace
}  // namespace vericansim
