// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 13, bit timing parameters, on the whole engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "protocol/timing_bench.hpp"
#include "protocol/timing_pair.hpp"
#include "protocol/timing_places.hpp"

namespace vericansim {
namespace {

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;

/// The DUT sends kPairsFrame; true if the partner got it and nothing went wrong.
bool send_one(TimingBench &bench) {
  send_frame(bench);
  const bool sent = bench.run_while_not([&] { return !bench.dut().sent().empty(); }, 100);
  bench.run_bits(4);
  return sent && bench.dut().events().failed == 0 && bench.dut().events().errors == 0 &&
         bench.partner().received() == std::vector<Frame>{kPairsFrame};
}

/// TX edges of the DUT that do not stand a whole number of bits behind its SOF.
unsigned edges_off_grid(const TimingBench &bench) {
  unsigned off = 0;
  for (const TimingBench::TxEdge &edge : bench.tx_edges()) {
    off += (edge.period - bench.tx_edges().front().period) % bench.timing().clocks_per_bit() != 0;
  }
  return off;
}

// BT-01, BT-02, BT-05: prescalers and segments; all TX edges whole bits apart, to the clock.
TEST(BitTimingRules, OwnEdgesStandWholeBitsApart) {
  for (const unsigned prescaler : {1u, 2u, 3u, 10u, 64u, 256u}) {
    for (const BitTiming &t : {BitTiming{prescaler, 3, 2, 2, 1}, BitTiming{prescaler, 5, 2, 2, 2},
                               BitTiming{prescaler, 8, 8, 8, 4}}) {
      SCOPED_TRACE(describe(t));
      TimingBench bench{{.timing = t}};
      EXPECT_TRUE(send_one(bench));
      EXPECT_GT(bench.tx_edges().size(), 20u);
      EXPECT_EQ(edges_off_grid(bench), 0u);
    }
  }
}

// BT-04, BT-03, PF-29: the extremes, each as sender and as receiver.
TEST(BitTimingRules, ExtremeSettingsCarryFrames) {
  for (const BitTiming &t :
       {BitTiming{1, 8, 8, 8, 4}, BitTiming{256, 8, 8, 8, 4},  // 25 tq, TSEG1 16, SJW 4
        BitTiming{1, 3, 2, 2, 2}, BitTiming{256, 3, 2, 2, 2},  // 8 tq
        BitTiming{1, 4, 2, 1, 1}, BitTiming{2, 1, 1, 1, 1},    // TSEG2 1
        BitTiming{1, 8, 8, 1, 1}, BitTiming{1, 1, 4, 4, 4}}) {
    SCOPED_TRACE(describe(t));
    TimingBench bench{{.timing = t}};
    EXPECT_TRUE(send_one(bench));
    bench.partner().request(kLongEdgesFrame);
    EXPECT_TRUE(bench.run_while_not([&] { return !bench.partner().sent().empty(); }, 150));
    EXPECT_EQ(bench.dut().received(), std::vector<Frame>{kLongEdgesFrame});
    EXPECT_EQ(bench.dut().events().errors, 0u);
  }
}

// BT-06: from any clock of a quantum on: a dominant bit that ends PS2 early is still sampled
// dominant, one that ends one quantum earlier is not.
TEST(BitTimingRules, DominantBitMayBeShortByPhaseSeg2AndNoMore) {
  for (const BitTiming &t : {BitTiming{4, 4, 3, 2, 1}, BitTiming{4, 2, 3, 6, 3}}) {
    for (unsigned shortened = t.ps2; shortened <= t.ps2 + 1; ++shortened) {
      for (unsigned at = 0; at < t.clocks_per_bit(); ++at) {
        SCOPED_TRACE(describe(t) + " at clock " + std::to_string(at));
        TimingBench bench{{.timing = t}};
        bench.start();
        const std::uint64_t edge = bench.now() + at;
        bench.pin(edge, kD);
        bench.pin(edge + (t.quanta() - shortened) * t.prescaler, std::nullopt);
        bench.run_bits(3);
        EXPECT_EQ(bench.dut().idle(), shortened > t.ps2);
      }
    }
  }
}

// BT-06: the same for a bit inside a frame, which a receiver follows.
TEST(BitTimingRules, ShortDominantBitInsideAFrame) {
  for (const unsigned shortened : {2u, 3u}) {
    TimingBench bench{{.timing = {4, 4, 3, 2, 1}}};
    reach_received(bench, Field::kId);
    bench.clear_records();
    bench.pin(bench.in_quantum(bench.now(), 0), kD);
    bench.pin(bench.in_quantum(bench.now(), 10 - shortened), kR);
    bench.run_bits(1);
    ASSERT_EQ(bench.samples().size(), 1u);
    EXPECT_EQ(bench.samples()[0].value, shortened <= 2 ? kD : kR);
  }
}

// BT-03: the ACK and the flag leave in time with the shortest PHASE_SEG2, at one clock a quantum.
TEST(BitTimingRules, AcknowledgeFollowsTheDelimiterWithShortestPhaseSeg2) {
  TimingBench bench{{.timing = {1, 4, 4, 1, 1}}};
  receive_frame(bench);
  bench.run_to(Field::kAck, 0);
  EXPECT_EQ(bench.tx_edges().back().level, kD);
  EXPECT_EQ(bench.tx_edges().back().period, bench.now());
  EXPECT_EQ(bench.samples().back().period + 2, bench.now());
}

/// Largest error of each clock by BT-08, in ppm.
double tolerance_ppm(const BitTiming &t) {
  const double phase = std::min(t.ps1, t.ps2);
  const double after_flag = phase / (2.0 * (13.0 * t.quanta() - t.ps2));
  const double between_edges = t.sjw / (20.0 * t.quanta());
  return 1e6 * std::min(after_flag, between_edges);
}

// BT-08, BT-09, SY-20: at the limit there is no error but those that were asked for; error flags
// are followed too.
TEST(BitTimingRules, ClocksAtTheLimitOfToleranceMakeNoErrors) {
  for (const BitTiming &t : {BitTiming{8, 1, 4, 4, 4}, BitTiming{8, 5, 2, 2, 2},
                             BitTiming{8, 8, 8, 8, 4}, BitTiming{8, 3, 2, 2, 1}}) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(describe(t) + " ppm " + std::to_string(sign * tolerance_ppm(t)));
      const PairResult r =
          exchange({.timing = t, .error_ppm = sign * tolerance_ppm(t), .disturb_every = 5}, 40);
      EXPECT_EQ(r.sent, 40u);
      EXPECT_EQ(r.received, 40u);
      EXPECT_GT(r.disturbed, 0u);
      EXPECT_EQ(r.failed, r.disturbed);
    }
  }
}

// BT-08: the test above can fail: at twice the limit frames are lost.
TEST(BitTimingRules, ClocksFarBeyondTheLimitMakeErrors) {
  for (const BitTiming &t : {BitTiming{8, 1, 4, 4, 4}, BitTiming{8, 5, 2, 2, 2}}) {
    const PairResult r = exchange({.timing = t, .error_ppm = 2.2 * tolerance_ppm(t)}, 10);
    EXPECT_GT(r.failed, 0u) << describe(t);
  }
}

// BT-07: PROP_SEG holds both ways of the cable and both synchronisers: arbitration works at every
// ID bit, in every phase of the two clocks. With twice that it cannot.
TEST(BitTimingRules, PropSegMustHoldTheCableTwice) {
  const BitTiming t{4, 5, 2, 2, 2};
  const Time clock = 12'500;  // 80 MHz
  const Time cable = clock * (t.prop * t.prescaler / 2 - TimingBench::kSynchroniser);
  for (Time phase = 0; phase < 5 * clock; phase += 7'001) {
    const PairResult r = contend({.timing = t, .delay = cable, .phase = phase}, 11);
    EXPECT_EQ(r.received, 22u) << phase;
    EXPECT_EQ(r.errors, 0u) << phase;
  }
  const PairResult far = contend({.timing = t, .delay = 2 * cable + 4 * clock * 4}, 11);
  EXPECT_NE(far.errors, 0u);
}

// BT-12, SY-10: own bits may come back as late as one quantum before the sample point's, with both
// edges unequally late; nothing is stretched or shifted.
TEST(BitTimingRules, LoopDelayUpToTheSamplePointChangesNothing) {
  for (const BitTiming &t : {BitTiming{4, 5, 2, 2, 2}, BitTiming{1, 8, 8, 8, 4}}) {
    const unsigned limit = (t.prop + t.ps1 - 1) * t.prescaler - TimingBench::kSynchroniser;
    for (unsigned fall = 0; fall <= limit; ++fall) {
      const unsigned least = fall > t.prescaler ? fall - t.prescaler : 0;
      for (unsigned rise = least; rise <= std::min(limit, fall + t.prescaler); ++rise) {
        TimingBench bench{{.timing = t}};
        bench.loop_delay(fall, rise);
        EXPECT_TRUE(send_one(bench)) << describe(t) << " " << fall << " " << rise;
        EXPECT_EQ(edges_off_grid(bench), 0u);
      }
    }
  }
}

// BT-12: beyond the sample point the node does not see its own SOF: a bit error is right.
TEST(BitTimingRules, LoopDelayBeyondTheSamplePointIsABitError) {
  const BitTiming t{4, 5, 2, 2, 2};
  const unsigned sample = (1 + t.prop + t.ps1) * t.prescaler - TimingBench::kSynchroniser;
  TimingBench bench{{.timing = t}};
  bench.loop_delay(sample, sample);
  EXPECT_FALSE(send_one(bench));
  EXPECT_NE(bench.dut().events().errors & kErrBit0, 0);
}

// BT-10: one disturbed quantum of the three before and at the sample point is outvoted; with single
// sampling the one at the sample point is not. The sample points stand where they stood.
TEST(BitTimingRules, TripleSamplingOutvotesOneQuantum) {
  for (const bool triple : {true, false}) {
    for (unsigned q = 5; q <= 7; ++q) {  // sample point at the end of quantum 7
      TimingBench bench{{.timing = {4, 4, 3, 2, 1}, .triple_sampling = triple}};
      reach_received(bench, Field::kId);
      bench.clear_records();
      const std::uint64_t start = bench.now();
      bench.pin(bench.in_quantum(start, 0), kD);
      bench.pin(bench.in_quantum(start, q), kR);
      bench.pin(bench.in_quantum(start, q + 1), kD);
      bench.run_bits(1);
      ASSERT_EQ(bench.samples().size(), 1u);
      EXPECT_EQ(bench.samples()[0].value, triple || q != 7 ? kD : kR) << q;
      EXPECT_EQ(bench.samples()[0].period, start + 8 * 4 - 1) << q;
    }
  }
}

// BT-10: frames pass with triple sampling, drifting clocks included.
TEST(BitTimingRules, TripleSamplingCarriesFrames) {
  const BitTiming t{8, 5, 2, 2, 2};
  const PairResult r =
      exchange({.timing = t, .error_ppm = tolerance_ppm(t) / 2, .triple_sampling = true}, 20);
  EXPECT_EQ(r.received, 20u);
  EXPECT_EQ(r.errors, 0u);
}

}  // namespace
}  // namespace vericansim
