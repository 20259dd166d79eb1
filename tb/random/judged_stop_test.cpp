// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The judges beside a node that software takes off the bus and puts back.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "random/judged_run.hpp"

namespace vericansim {
namespace {

constexpr unsigned kClocksPerBit = 8;  // of 125 ns

/// The head of a scenario that lasts `duration`, up to its nodes.
std::string scenario_of(const std::string &duration) {
  return "judge: lockstep\nbitrate: 1000000\ndrain: 0\nduration: " + duration + "\nnodes:\n";
}

/// A node; `more`: further keys.
std::string node(const std::string &name, const std::string &more) {
  return "  - {name: " + name + ", timing: {brp: 1, prop: 3, ps1: 2, ps2: 2, sjw: 1}" + more +
         "}\n";
}

/// A frame each 240 us; node b receives into MB2, whose C/S word is read before and behind a stop
/// by `stop` (MCR) that is asked for `phase` clocks into a bit.
Scenario stopped_at(const std::string &stop, const std::string &ack, unsigned phase) {
  const std::string at = std::to_string(1'400'000'000 + phase * 125'000) + " ps";
  return parse_scenario(
      "stop.yaml",
      scenario_of("3 ms") + node("a", ", mailboxes: 16") +
          node("b", ", mailboxes: 16, software: none") +
          "traffic:\n"
          "  - {node: a, id: 0x121, dlc: 0, period: 240 us}\n"
          "accesses:\n"
          "  - {node: b, at: 5 us, do: [write MCR 0x5000000F, until MCR 0x1100000 0x1000000,"
          " write MCR 0x5002000F, write CTRL1 0x90002, write MB2.ID 0x4840000, write MB2.CS "
          "0x4000000,"
          " write MCR 0x4002000F, until MCR 0x1000000 0]}\n"
          "  - {node: b, at: 1300 us, do: [read MB2.CS, read TIMER]}\n"
          "  - {node: b, at: " +
          at + ", do: [write MCR " + stop + ", until MCR " + ack + " " + ack +
          ", write MCR 0x4002000F, until MCR 0x1100000 0]}\n"
          "  - {node: b, at: 2900 us, do: [read MB2.CS, read TIMER]}\n");
}

// FX-6.b: TIMER, and with it every later stamp, stands from the clock in which the node leaves the
// bus; a bit that is sampled in the clock before counts, one that is sampled behind it does not.
TEST(JudgedStop, StampsGoOnFromTheClockOfTheStop) {
  unsigned judged = 0;
  for (unsigned phase = 0; phase < 2 * kClocksPerBit; ++phase) {
    for (const auto &[stop, ack] : {std::pair{"0xC002000F", "0x100000"},      // MDIS, LPMACK
                                    std::pair{"0x5002000F", "0x1000000"}}) {  // HALT, FRZACK
      const JudgedRun run = run_judged(stopped_at(stop, ack, phase));
      for (const std::string &finding : run.findings)
        ADD_FAILURE() << stop << ", phase " << phase << ": " << finding;
      EXPECT_FALSE(run.cut_short);
      EXPECT_GE(run.frames, 10u);
      EXPECT_GE(run.counts.accesses, 12u);
      ++judged;
    }
  }
  EXPECT_EQ(judged, 4 * kClocksPerBit);
}

/// Node b, whose REC the frames before have brought from 10 to 5 (FC-10), receives a frame from
/// 1,440 us on, and leaves the bus for disable mode `clock` clocks behind that; `faults`: what else
/// befalls it.
Scenario disabled_in_a_frame(unsigned clock, const std::string &faults) {
  const std::string at = std::to_string(1'440'000'000 + clock * 125'000) + " ps";
  return parse_scenario(
      "frame.yaml",
      scenario_of("2 ms") + node("a", ", mailboxes: 16") + node("c", ", mailboxes: 16") +
          node("b", ", mailboxes: 16, software: none") +
          "traffic:\n"
          "  - {node: a, id: 0x121, dlc: 0, period: 240 us}\n" +
          faults +
          "accesses:\n"
          "  - {node: b, at: 5 us, do: [write MCR 0x5000000F, until MCR 0x1100000 0x1000000,"
          " write MCR 0x5002000F, write CTRL1 0x90002, write ECR 0xA00, write MB2.ID 0x4840000,"
          " write MB2.CS 0x4000000, write MCR 0x4002000F, until MCR 0x1000000 0]}\n"
          "  - {node: b, at: 1300 us, do: [read MB2.CS, read TIMER]}\n"
          "  - {node: b, at: " +
          at +
          ", do: [write MCR 0xC002000F, until MCR 0x100000 0x100000, write MCR 0x4002000F,"
          " until MCR 0x1100000 0, read ECR, read IFLAG1, read MB2.CS, read TIMER]}\n");
}

// FX-2.1.a: a receiver leaves within a frame. What its last sampled bit brings about, an error, the
// frame, a count, it has brought about.
TEST(JudgedStop, WithinAFrameTheLastBitCounts) {
  const auto fault = [](const char *what) {
    return std::string{"faults:\n  - {node: b, kind: "} + what + "}\n";
  };
  constexpr unsigned kBegin = 29 * kClocksPerBit, kEnd = 49 * kClocksPerBit;  // errors to EOF7
  for (const auto &[faults, fails] :
       {std::pair{std::string{}, false},
        std::pair{fault("dominant, from: 1465 us, for: 7 us"), true},  // STUFF ERROR
        std::pair{fault("flip, from: 1455 us, for: 1 us"), true}}) {   // CRC ERROR
    unsigned errors = 0;
    for (unsigned clock = kBegin; clock < kEnd; ++clock) {
      const JudgedRun run = run_judged(disabled_in_a_frame(clock, faults));
      for (const std::string &finding : run.findings)
        ADD_FAILURE() << faults << clock << " clocks: " << finding;
      EXPECT_EQ(run.counts.stops, 1u);
      errors += run.counts.errors != 0 ? 1 : 0;
    }
    EXPECT_EQ(errors != 0, fails) << faults;
    EXPECT_LT(errors, kEnd - kBegin) << faults << "never before the error";
  }
}

/// Node a saturates the bus. Node b, with a frame that waits in its last buffer, leaves the bus,
/// and is back `bits` bit times behind a moment in the frames of a.
Scenario back_after(unsigned bits) {
  const std::string back = std::to_string(1500 + bits) + " us";
  return parse_scenario(
      "back.yaml",
      scenario_of("2 ms") + node("a", ", mailboxes: 16, tx_buffers: 2") +
          node("b", ", software: none") + node("c", ", mailboxes: 16") +
          "traffic:\n"
          "  - {node: a, id: 0x121, dlc: 0, period: saturated}\n"
          "accesses:\n"
          "  - {node: b, at: 5 us, do: [write MCR 0x5000000F, until MCR 0x1100000 0x1000000,"
          " write MCR 0x5002003F, write CTRL1 0x90002, write MB63.ID 0x1FFC0000,"
          " write MB63.CS 0xC000000, write MCR 0x4002003F, until MCR 0x1000000 0]}\n"
          "  - {node: b, at: 1 ms, do: [write MCR 0xC002003F, until MCR 0x100000 0x100000]}\n"
          "  - {node: b, at: " +
          back + ", do: [write MCR 0x4002003F]}\n");
}

// A pass over all buffers begins when the node is back: with 64 of them at 8 clocks a bit it is
// longer than the 11 bits for which the node integrates, so the frame may miss the first
// opportunity, like one that is written that late.
TEST(JudgedStop, BackWithinAFrameItMayMissTheFirstOpportunity) {
  constexpr unsigned kPeriod = 51;  // bits from frame to frame, at most
  for (unsigned bits = 0; bits < kPeriod; ++bits) {
    const JudgedRun run = run_judged(back_after(bits));
    for (const std::string &finding : run.findings) ADD_FAILURE() << bits << " bits: " << finding;
    EXPECT_FALSE(run.cut_short);
    EXPECT_GE(run.frames, 35u);
  }
}

/// Node b is alone on the bus and goes bus-off with its first frame; while it recovers, its
/// software takes it off the bus `phase` clocks into a sequence of 11 recessive bits.
Scenario stopped_in_bus_off(unsigned phase) {
  const std::string at = std::to_string(1'700'000'000 + phase * 125'000) + " ps";
  return parse_scenario(
      "bus-off.yaml",
      scenario_of("4 ms") + node("b", ", mailboxes: 16, software: none") +
          "faults:\n"
          "  - {kind: recessive, node: b, from: 1010 us, for: 4 us}\n"
          "accesses:\n"
          "  - {node: b, at: 5 us, do: [write MCR 0x5000000F, until MCR 0x1100000 0x1000000,"
          " write MCR 0x5002000F, write CTRL1 0x90002, write ECR 0xFF, write MB2.ID 0,"
          " write MB2.CS 0x8000000, write MCR 0x4002000F, until MCR 0x1000000 0]}\n"
          "  - {node: b, at: 1000 us, do: [write MB2.CS 0xC080000]}\n"
          "  - {node: b, at: " +
          at +
          ", do: [check ESR1 0x20 0x20, write MCR 0x5002000F, until MCR 0x1000000 0x1000000,"
          " write MCR 0x4002000F, until MCR 0x1000000 0]}\n"
          "  - {node: b, at: 3900 us, do: [check ESR1 0x30 0]}\n");
}

// BO-02: a recessive bit that is sampled around a stop counts; behind it the next sequence begins
// anew.
TEST(JudgedStop, RecoverySequencesCountUpToTheStop) {
  unsigned judged = 0;
  for (unsigned phase = 0; phase < 11 * kClocksPerBit; ++phase) {
    const JudgedRun run = run_judged(stopped_in_bus_off(phase));
    for (const std::string &finding : run.findings) ADD_FAILURE() << phase << ": " << finding;
    EXPECT_EQ(run.counts.bus_offs, 1u);
    EXPECT_EQ(run.counts.stops, 1u);
    ++judged;
  }
  EXPECT_EQ(judged, 11 * kClocksPerBit);
}

}  // namespace
}  // namespace vericansim
