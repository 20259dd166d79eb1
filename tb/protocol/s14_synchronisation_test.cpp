// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 14, synchronisation, on the whole engine at the resolution of a time quantum.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "protocol/timing_pair.hpp"
#include "protocol/timing_places.hpp"
#include "protocol/timing_reference.hpp"

namespace vericansim {
namespace {

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;

// 10 quanta of 4 clocks, sample point at the end of quantum 7

constexpr BitTiming kTen{.prescaler = 4, .prop = 4, .ps1 = 3, .ps2 = 2, .sjw = 2};
constexpr std::uint64_t kTq = kTen.prescaler;
constexpr std::uint64_t kBit = kTen.clocks_per_bit();

/// Periods of the DUT's samples relative to the first clock of the bit in which they were cleared.
std::vector<std::uint64_t> sample_offsets(const TimingBench &bench, std::uint64_t start) {
  std::vector<std::uint64_t> offsets;
  for (const TimingBench::Sample &sample : bench.samples())
    offsets.push_back(sample.period - start);
  return offsets;
}

/// Lets a receiver see `levels`, one a quantum, from the start of an ID bit behind a recessive one;
/// returns where it sampled, in quanta.
std::vector<unsigned> receive_quanta(const std::string &levels) {
  TimingBench bench{{.timing = kTen}};
  reach_received(bench, Field::kId);
  bench.clear_records();
  const std::uint64_t start = bench.now();
  for (unsigned q = 0; q < levels.size(); ++q)
    bench.pin(bench.in_quantum(start, q), levels[q] == '0' ? kD : kR);
  bench.run(levels.size() * kTq);
  std::vector<unsigned> at;
  for (const std::uint64_t offset : sample_offsets(bench, start)) at.push_back(offset / kTq);
  return at;
}

// SY-01: the edge to recessive may come early or late, nothing moves.
TEST(Synchronisation, EdgeToRecessiveNeverSynchronises) {
  for (const char *second_bit : {"1111111111", "0011111111", "0000111111", "0000000001"})
    EXPECT_EQ(receive_quanta(std::string{"0000000000"} + second_bit + "1111111111"),
              (std::vector<unsigned>{7, 17, 27}))
        << second_bit;
}

// SY-02: after a dominant sample an edge does nothing, neither in PHASE_SEG2 nor in the next bit.
TEST(Synchronisation, NoEdgeCountsAfterADominantSample) {
  EXPECT_EQ(receive_quanta("000000001000000000000"), (std::vector<unsigned>{7, 17}));
  EXPECT_EQ(receive_quanta("000000000010000000000"), (std::vector<unsigned>{7, 17}));
  EXPECT_EQ(receive_quanta("000000000011110000000"), (std::vector<unsigned>{7, 17}));
}

// SY-03: of two edges before the sample only the first moves it.
TEST(Synchronisation, OnlyOneSynchronisationBetweenTwoSamples) {
  EXPECT_EQ(receive_quanta("010100000000000000000"), (std::vector<unsigned>{7, 17}));
  EXPECT_EQ(receive_quanta("101100000000000000000"), (std::vector<unsigned>{8, 18}));
  EXPECT_EQ(receive_quanta("110010000000000000000"), (std::vector<unsigned>{9, 19}));
}

// SY-04, SY-06, SY-15, SY-17: a dominant pulse of one quantum, at any clock of an idle bit, moves
// the grid of all later bits to itself; it is sampled recessive, the node stays idle, and the next
// pulse moves the grid again.
TEST(Synchronisation, PulseOfOneQuantumInIdleMovesTheGridOnly) {
  for (std::uint64_t at = 0; at < kBit; ++at) {
    TimingBench bench{{.timing = kTen}};
    bench.start();
    for (int pulse = 0; pulse < 2; ++pulse) {
      const std::uint64_t begin = bench.now() + at;
      bench.pin(begin, kD);
      bench.pin(begin + kTq, std::nullopt);
      bench.run_until(begin + kTq);
      bench.clear_records();
      bench.run_bits(4);
      const std::uint64_t seen = begin + TimingBench::kSynchroniser;
      for (const TimingBench::Sample &sample : bench.samples()) {
        // PROP + PS1 to PROP + PS1 + 1 quanta after the edge, and whole bits later.
        const std::uint64_t behind = (sample.period + 1 - seen) % kBit;
        EXPECT_GE(behind, 7 * kTq) << at;
        EXPECT_LE(behind, 8 * kTq) << at;
        EXPECT_EQ(sample.value, kR);
        EXPECT_EQ(sample.field, Field::kIdle);
      }
    }
    EXPECT_TRUE(bench.tx_edges().empty());
  }
}

/// A node with a pending frame sees the SOF of others in clock `at` of INT3 or of an idle bit.
void start_beside_foreign_sof(Field field, std::uint64_t at) {
  SCOPED_TRACE("clock " + std::to_string(at));
  TimingBench bench{{.timing = kTen}};
  send_frame(bench);
  const Frame second{.id = 0x2AA, .dlc = 0};  // ID28 dominant, ID27 recessive
  if (field == Field::kInt) {
    bench.dut().request(second);
    bench.run_to(Field::kInt, 2);
  } else {
    bench.run_to(Field::kIdle, 2);
    bench.dut().request(second);
  }
  bench.clear_records();
  const std::uint64_t edge = bench.now() + at;
  bench.pin(edge, kD);
  bench.pin(edge + kBit, std::nullopt);
  bench.run_bits(5);
  const std::uint64_t seen = edge + TimingBench::kSynchroniser;
  ASSERT_GE(bench.tx_edges().size(), 2u);
  const std::uint64_t fall = bench.tx_edges()[0].period;
  const std::uint64_t rise = bench.tx_edges()[1].period;
  ASSERT_EQ(bench.tx_edges()[0].level, kD);
  const std::uint64_t sample = bench.samples()[0].period;
  if (seen <= sample) {  // sampled dominant: joins, ID28 follows one bit after the edge
    EXPECT_EQ(bench.samples()[0].value, kD);
    EXPECT_GE(fall, seen + kBit - kTq);
    EXPECT_LE(fall, seen + kBit);
    EXPECT_EQ(rise, fall + kBit);
  } else {  // the bit ends at once: own SOF in the next quantum, ID27 two bits after the edge
    EXPECT_GT(fall, seen);
    EXPECT_LE(fall, seen + kTq);
    EXPECT_GE(rise, seen + 2 * kBit - kTq);
    EXPECT_LE(rise, seen + 2 * kBit);
  }
}

// SY-13, SY-05, IF-06: every clock of INT3; after the bit's end the own SOF is out anyway.
TEST(Synchronisation, PendingFrameStartsOnAForeignEdgeAnywhereInInt3) {
  for (std::uint64_t at = 0; at + 2 < kBit; ++at) start_beside_foreign_sof(Field::kInt, at);
}

// SY-13, SY-05, IF-14: the same in idle.
TEST(Synchronisation, PendingFrameStartsOnAForeignEdgeAnywhereInIdle) {
  for (std::uint64_t at = 0; at + 2 < kBit; ++at) start_beside_foreign_sof(Field::kIdle, at);
}

// SY-11: a transmitter follows early edges of others; its bits keep their order and their length
// counts from the foreign edge. The frame is intact for the partner, which follows it.
TEST(Synchronisation, TransmitterFollowsEarlyEdgesWithoutShiftingItsBits) {
  for (unsigned early = 1; early <= kTen.ps2; ++early) {
    TimingBench bench{{.timing = kTen}};
    send_frame(bench);
    bench.run_to([](const TimingBench &b) {  // last r before a d bit
      return b.place().field() == Field::kId && b.sent() == kR && b.last_sample() == kR;
    });
    const std::uint64_t edge = bench.in_quantum(bench.now(), kTen.quanta() - early);
    bench.pin(edge, kD);
    bench.pin(bench.now() + kBit + kTq, std::nullopt);
    ASSERT_TRUE(bench.run_while_not([&] { return !bench.dut().sent().empty(); }, 120));
    bench.run_bits(3);
    ASSERT_EQ(bench.partner().received().size(), 1u) << early;
    EXPECT_EQ(bench.partner().received()[0], kPairsFrame);
    EXPECT_EQ(bench.dut().events().failed, 0u);
  }
}

// SY-16: shortened to nothing but one clock of PHASE_SEG2, the decision of the sample still goes
// out at the end of the bit: a bit error there is answered with the flag in the very next bit.
TEST(Synchronisation, DecisionIsReadyWhenPhaseSeg2IsShortest) {
  TimingBench bench{{.timing = {.prescaler = 1, .prop = 3, .ps1 = 4, .ps2 = 1, .sjw = 1}}};
  reach_sent(bench, Field::kData, kD);
  bench.clear_records();
  bench.pin(kR);
  bench.run_to(Field::kErrFlag, 0);
  EXPECT_EQ(bench.sent(), kD);
  EXPECT_EQ(bench.now(), bench.samples()[0].period + 2);  // sample, one clock of PS2, flag
}

/// May the bit that begins at this place synchronise hard (SY-05)?
bool takes_hard_edges(const PlaceTracker &place) {
  const Field f = place.field();
  return f == Field::kIdle || f == Field::kSuspend || f == Field::kInteg || f == Field::kBusOff ||
         (f == Field::kInt && place.left() <= 1);
}

/// Noise of random width on the pin of a node that sends and receives, judged by the reference in
/// every quantum. Returns where it first disagreed.
std::string live_beside_reference(const BitTiming &t, std::uint32_t seed) {
  std::mt19937 rng{seed};
  TimingBench bench{{.timing = t}};
  bench.start();
  TimingReference reference{t};
  bool hard = true;
  for (int n = 0; n < 4000; ++n) {
    if (n % 97 == 0 && !bench.dut().pending()) bench.dut().request(kPairsFrame);
    if (n % 61 == 0 && !bench.partner().pending()) bench.partner().request(kPairsFrame);
    if (rng() % 23 == 0) {
      bench.pin(bench.now(), (rng() & 1) != 0 ? kR : kD);
      bench.pin(bench.now() + rng() % (3 * t.prescaler), std::nullopt);
    }
    if (bench.place().fresh()) hard = takes_hard_edges(bench.place());
    bench.run(t.prescaler - 1);
    const Trace at = bench.trace();
    const TimingReference::Quantum want = reference.step(at.rx, at.tx, hard);
    if (at.sample != want.sample || at.boundary != want.last)
      return "seed " + std::to_string(seed) + ", quantum " + std::to_string(n);
    bench.run(1);
  }
  return {};
}

// SY-21, SY-05, SY-12: frames, errors and noise in all states; each quantum as the reference says.
TEST(Synchronisation, EngineAgreesWithTheReferenceUnderNoise) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    EXPECT_EQ(live_beside_reference({4, 4, 3, 2, 1 + seed % 2}, seed), "");
    EXPECT_EQ(live_beside_reference({3, 2, 8, 4, 1 + seed % 4}, seed), "");
  }
}

/// Frames of the long run: 200, or VERICAN_FRAMES of the environment (the rule wants 100,000).
unsigned long_run_frames() {
  const char *text = std::getenv("VERICAN_FRAMES");
  return text == nullptr ? 200 : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

// SY-20, BT-08, BT-09: two free-running nodes at the largest tolerance that CAN knows (1.58 %),
// longest distance between edges, error flags in between: no error but those asked for.
TEST(Synchronisation, LongRunOfTwoNodesAtTheLimitOfTolerance) {
  const BitTiming t{8, 1, 4, 4, 4};
  const double limit_ppm = 1e6 * 4 / (2.0 * (13 * 10 - 4));
  const unsigned frames = long_run_frames();
  for (const double ppm : {limit_ppm, -limit_ppm}) {
    const PairResult r = exchange({.timing = t, .error_ppm = ppm, .disturb_every = 17}, frames);
    EXPECT_EQ(r.sent, frames);
    EXPECT_EQ(r.received, frames);
    EXPECT_GT(r.disturbed, 0u);
    EXPECT_EQ(r.failed, r.disturbed);
  }
}

}  // namespace
}  // namespace vericansim
