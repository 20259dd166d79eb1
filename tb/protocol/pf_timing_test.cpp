// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Pitfalls of section 18 that concern bit timing and synchronisation, each as its scenario.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/timing_bench.hpp"
#include "protocol/timing_pair.hpp"
#include "protocol/timing_places.hpp"

namespace vericansim {
namespace {

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;

/// A receiver sees an edge in quantum `quantum` of a bit behind a recessive one; returns where it
/// sampled that bit and the next one, in quanta from the bit's start.
std::vector<std::uint64_t> samples_after_edge(const BitTiming &t, unsigned quantum) {
  TimingBench bench{{.timing = t}};
  reach_received(bench, Field::kId);
  bench.clear_records();
  const std::uint64_t start = bench.now();
  bench.pin(kR);
  bench.pin(bench.in_quantum(start, quantum), kD);
  bench.run_bits(3);
  return {(bench.samples()[0].period - start) / t.prescaler,
          (bench.samples()[1].period - start) / t.prescaler};
}

/// The partner sends `frame`; true if the DUT received it without any error.
bool receives(TimingBench &bench, const Frame &frame) {
  bench.partner().request(frame);
  const std::size_t before = bench.dut().received().size();
  const bool got = bench.run_while_not([&] { return bench.dut().received().size() > before; }, 200);
  return got && bench.dut().received().back() == frame && bench.dut().events().errors == 0;
}

// PF-14, SY-11: SJW = 1, PS2 = 4; others pull dominant three quanta before an own edge to dominant.
// The level sequence on the wire is that of the frame, no bit is shifted.
TEST(PitfallTiming, EarlyEdgeBeyondSjwShiftsNoBit) {
  const BitTiming t{4, 3, 4, 4, 1};
  TimingBench bench{{.timing = t}};
  send_frame(bench);
  bench.run_to([](const TimingBench &b) {
    return b.place().field() == Field::kId && b.sent() == kR && b.last_sample() == kR;
  });
  const std::uint64_t start = bench.now();
  bench.clear_records();
  bench.pin(bench.in_quantum(start, t.quanta() - 3), kD);
  bench.pin(start + t.clocks_per_bit() + t.prescaler, std::nullopt);
  ASSERT_TRUE(bench.run_while_not([&] { return !bench.dut().sent().empty(); }, 100));
  // The next own edge: shortened by SJW only.
  EXPECT_EQ(bench.tx_edges()[0].period, start + (t.quanta() - 1) * t.prescaler);
  EXPECT_EQ(bench.partner().received(), std::vector<Frame>{kPairsFrame});
  EXPECT_EQ(bench.dut().events().errors, 0u);
}

// PF-21, BT-10: triple sampling with prescaler 1 and the longest loop delay: the ACK bit still
// counts, as sender and as receiver.
TEST(PitfallTiming, TripleSamplingWithPrescalerOneLosesNoAcknowledge) {
  const BitTiming t{1, 6, 4, 4, 1};
  TimingBench bench{{.timing = t, .triple_sampling = true}};
  // Two of the three samples must see the level, so one quantum less than with single sampling.
  const unsigned longest = t.prop + t.ps1 - 1 - TimingBench::kSynchroniser;
  bench.loop_delay(longest, longest);
  send_frame(bench);
  ASSERT_TRUE(bench.run_while_not([&] { return !bench.dut().sent().empty(); }, 100));
  EXPECT_EQ(bench.dut().events().errors, 0u);
  EXPECT_TRUE(receives(bench, kLongEdgesFrame));
  EXPECT_EQ(bench.partner().events().errors, 0u);
}

// PF-22, SY-05, SY-06: ten thousand idle bits, then a SOF at each clock of a bit.
TEST(PitfallTiming, FrameAfterLongIdleIsReceivedInEveryPhase) {
  for (const bool triple : {false, true}) {
    for (const unsigned prescaler : {1u, 4u}) {
      const BitTiming t{prescaler, 4, 3, 2, 1};
      TimingBench bench{{.timing = t, .triple_sampling = triple}};
      bench.start();
      bench.run_bits(10'000);
      for (unsigned phase = 0; phase < t.clocks_per_bit(); ++phase) {
        // Moves the DUT's grid against the partner's by one clock more each time.
        bench.pin(bench.now() + phase, kD);
        bench.pin(bench.now() + phase + t.prescaler, std::nullopt);
        bench.run_bits(3);
        EXPECT_TRUE(receives(bench, kLongEdgesFrame)) << prescaler << " " << phase;
        bench.run_bits(20);
      }
    }
  }
}

// PF-29, BT-04: TSEG1 = 16, SJW = 4, e = +4: the sample moves by four, no counter overflows.
TEST(PitfallTiming, LongestSegmentIsLengthenedByFour) {
  EXPECT_EQ(samples_after_edge({4, 8, 8, 8, 4}, 4), (std::vector<std::uint64_t>{20, 45}));
  EXPECT_EQ(samples_after_edge({4, 8, 8, 8, 4}, 16), (std::vector<std::uint64_t>{20, 45}));
}

// PF-30, SY-12: a receiver follows an edge that is two quanta late.
TEST(PitfallTiming, ReceiverFollowsALateEdge) {
  EXPECT_EQ(samples_after_edge({4, 4, 3, 4, 3}, 2), (std::vector<std::uint64_t>{9, 21}));
}

// PF-31, SY-07: the edge in each quantum of PHASE_SEG2 (8..11), exact to the quantum.
TEST(PitfallTiming, EarlyEdgesAreExact) {
  const BitTiming t{4, 4, 3, 4, 2};
  EXPECT_EQ(samples_after_edge(t, 11)[1], 11u + 7);  // e = -1
  EXPECT_EQ(samples_after_edge(t, 10)[1], 10u + 7);  // e = -2
  EXPECT_EQ(samples_after_edge(t, 9)[1], 10u + 7);   // e = -3, residue -1
  EXPECT_EQ(samples_after_edge(t, 8)[1], 10u + 7);   // e = -4, residue -2
}

// PF-32, SY-06, SY-13: a frame is pending and the SOF of others begins in PHASE_SEG2 of INT3: the
// own SOF follows in the next quantum, the first ID bit counts from the foreign edge.
TEST(PitfallTiming, HardSynchronisationInPhaseSeg2OfTheThirdIntermissionBit) {
  const BitTiming t{4, 3, 2, 4, 1};
  for (unsigned quantum = 6; quantum <= 9; ++quantum) {
    TimingBench bench{{.timing = t}};
    send_frame(bench);
    bench.dut().request({.id = 0x2AA});
    bench.run_to(Field::kInt, 2);
    bench.clear_records();
    const std::uint64_t start = bench.now();
    bench.pin(bench.in_quantum(start, quantum), kD);
    bench.pin(start + 2 * t.clocks_per_bit(), std::nullopt);
    bench.run_bits(4);
    ASSERT_GE(bench.tx_edges().size(), 2u);
    const std::uint64_t sync = start + quantum * t.prescaler;  // SYNC_SEG of the SOF
    EXPECT_EQ(bench.tx_edges()[0].period, sync + t.prescaler) << quantum;
    EXPECT_EQ(bench.tx_edges()[1].period, sync + 2 * t.clocks_per_bit()) << quantum;
  }
}

// PF-42, SY-08: SJW = 1, e = +3 moves the sample by one.
TEST(PitfallTiming, SjwIsTheMostAnEdgeCanMove) {
  EXPECT_EQ(samples_after_edge({4, 4, 3, 4, 1}, 3)[0], 8u);
}

// PF-45, SY-08: positive resynchronisation is limited however late the edge.
TEST(PitfallTiming, LateEdgeIsLimited) {
  for (unsigned e = 2; e <= 7; ++e) EXPECT_EQ(samples_after_edge({4, 4, 3, 4, 2}, e)[0], 9u) << e;
}

// PF-53, SY-10: own edges late by 1 to PROP quanta: the frame is as long as without.
TEST(PitfallTiming, OwnDelayedEdgesStretchNothing) {
  const BitTiming t{4, 6, 3, 3, 3};
  std::vector<std::uint64_t> lengths;
  for (unsigned delay = 0; delay <= t.prop * t.prescaler - TimingBench::kSynchroniser; ++delay) {
    TimingBench bench{{.timing = t}};
    bench.loop_delay(delay, delay);
    send_frame(bench);
    bench.run_to(Field::kSof, 0);
    const std::uint64_t sof = bench.now();
    ASSERT_TRUE(bench.run_while_not([&] { return !bench.dut().sent().empty(); }, 100));
    lengths.push_back(bench.samples().back().period - sof);
    EXPECT_EQ(lengths.back(), lengths.front()) << delay;
  }
}

// PF-54, SY-03: a dominant bit with a glitch to recessive in its third quantum: the second edge
// does nothing.
TEST(PitfallTiming, SecondEdgeInABitDoesNothing) {
  const BitTiming t{4, 4, 3, 4, 3};
  TimingBench bench{{.timing = t}};
  reach_received(bench, Field::kId);
  bench.clear_records();
  const std::uint64_t start = bench.now();
  bench.pin(bench.in_quantum(start, 0), kD);
  bench.pin(bench.in_quantum(start, 3), kR);
  bench.pin(bench.in_quantum(start, 4), kD);
  bench.run_bits(2);
  EXPECT_EQ((bench.samples()[0].period - start) / t.prescaler, 7u);
  EXPECT_EQ((bench.samples()[1].period - start) / t.prescaler, 12u + 7);
}

// PF-58, CR-05, SY-15: a glitch that ends before the sample point, then a frame at once, at any
// distance within the next bit: CRC and stuffing start anew, the frame is received.
TEST(PitfallTiming, GlitchInIdleLeavesNoState) {
  const BitTiming t{4, 4, 3, 2, 2};
  for (unsigned at = 0; at < t.clocks_per_bit(); ++at) {
    TimingBench bench{{.timing = t}};
    bench.start();
    EXPECT_TRUE(receives(bench, kPairsFrame));
    bench.run_bits(8);
    bench.partner().request(kLongEdgesFrame);  // its SOF comes with the partner's next bit
    bench.pin(bench.now() + at, kD);
    bench.pin(bench.now() + at + 3, std::nullopt);
    ASSERT_TRUE(bench.run_while_not([&] { return bench.dut().received().size() == 2; }, 170)) << at;
    EXPECT_EQ(bench.dut().received()[1], kLongEdgesFrame);
    EXPECT_EQ(bench.dut().events().errors, 0u) << at;
  }
}

}  // namespace
}  // namespace vericansim
