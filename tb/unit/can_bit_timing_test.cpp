// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_bit_timing alone, quantum by quantum: against closed formulas, and against the reference of
// the synchronisation rules under random levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "Vcan_bit_timing.h"
#include "Vcan_bit_timing___024root.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "protocol/timing_reference.hpp"
#include "verilated.h"

namespace vericansim {
namespace {

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;

struct Event {
  bool sample = false;
  Level bit = kR;
  bool last = false;
  bool edge = false;
};

/// The block, driven one quantum at a time; a quantum is `clocks` clocks.
class BitTimer {
 public:
  explicit BitTimer(const BitTiming &timing, bool triple = false, unsigned clocks = 1)
      : clocks_{clocks} {
    set(timing);
    top_.smp_i = triple;
    top_.rx_i = 1;
    top_.tx_i = 1;
    top_.rst_ni = 0;
    edge();
    top_.rst_ni = 1;
    edge();
    top_.run_i = 1;
  }
  ~BitTimer() { top_.final(); }

  /// The segments, also while it runs.
  void set(const BitTiming &timing) {
    top_.propseg_i = timing.prop - 1;
    top_.pseg1_i = timing.ps1 - 1;
    top_.pseg2_i = timing.ps2 - 1;
    top_.rjw_i = timing.sjw - 1;
  }
  /// Level that the node sends in the current bit, and whether the next one synchronises hard.
  void sends(Level level) { top_.tx_i = static_cast<unsigned>(level); }
  void next_hard(bool hard) { top_.hard_i = hard; }

  Event quantum(Level bus) {
    top_.rx_i = static_cast<unsigned>(bus);
    for (unsigned i = 1; i < clocks_; ++i) {
      top_.tq_i = 0;
      top_.eval();
      EXPECT_FALSE(top_.sample_o || top_.boundary_o || top_.edge_o) << "within a quantum";
      edge();
    }
    top_.tq_i = 1;
    top_.eval();
    const Event event{top_.sample_o != 0, static_cast<Level>(top_.bit_o), top_.boundary_o != 0,
                      top_.edge_o != 0};
    edge();
    return event;
  }
  /// Stops for a clock, by reset or not: SYNC_SEG follows.
  void stop(bool reset) {
    top_.tq_i = 0;
    top_.run_i = reset;
    top_.rst_ni = !reset;
    edge();
    top_.rst_ni = top_.run_i = 1;
  }
  /// Runs to the start of the next bit with a quiet bus.
  void finish_bit() {
    for (int i = 0; i < 30; ++i) {
      if (quantum(kR).last) return;
    }
    FAIL() << "the bit does not end";
  }
  /// One whole bit at a level; false if it did not end by itself after `quanta`.
  bool bit(Level level, unsigned quanta) {
    for (unsigned i = 1; i <= quanta; ++i) {
      if (quantum(level).last) return i == quanta;
    }
    return false;
  }

 private:
  void edge() { rising_edge(top_, top_.clk_i); }
  SerialContext context_;
  Vcan_bit_timing top_{&context_, "can_bit_timing"};
  unsigned clocks_;
};

/// Where sample points and ends of bits stood, in quanta.
struct Grid {
  std::vector<unsigned> samples;
  std::vector<unsigned> ends;  ///< the first quantum after each
};

/// Runs `quanta` with the bus dominant in [from, to), and recessive else.
Grid run(BitTimer &timer, unsigned quanta, unsigned from, unsigned to) {
  Grid grid;
  for (unsigned t = 0; t < quanta; ++t) {
    const Event event = timer.quantum(t >= from && t < to ? kD : kR);
    if (event.sample) grid.samples.push_back(t);
    if (event.last) grid.ends.push_back(t + 1);
  }
  return grid;
}

std::string name(const BitTiming &t) {
  return "PROP " + std::to_string(t.prop) + " PS1 " + std::to_string(t.ps1) + " PS2 " +
         std::to_string(t.ps2) + " SJW " + std::to_string(t.sjw);
}

/// Shortest, longest and ordinary segments, each with every SJW that BT-03 allows.
std::vector<BitTiming> settings() {
  std::vector<BitTiming> all;
  const unsigned segments[][3] = {{1, 1, 1}, {1, 1, 2}, {1, 4, 4}, {3, 2, 2}, {5, 2, 2},
                                  {8, 8, 8}, {8, 8, 1}, {1, 8, 8}, {8, 1, 1}, {4, 3, 3}};
  for (const auto &s : segments) {
    for (unsigned sjw = 1; sjw <= std::min({4u, s[1], s[2]}); ++sjw) {
      all.push_back({.prescaler = 1, .prop = s[0], .ps1 = s[1], .ps2 = s[2], .sjw = sjw});
    }
  }
  return all;
}

// BT-03: stopped anywhere in a bit, by reset or without, it goes on with a whole one.
TEST(CanBitTiming, BitAfterAStopIsWhole) {
  const BitTiming timing{.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 4, .sjw = 1};
  for (const bool reset : {false, true}) {
    for (unsigned at = 0; at < 10; ++at) {
      BitTimer timer{timing};
      for (unsigned i = 0; i < at; ++i) timer.quantum(kR);
      timer.stop(reset);
      EXPECT_TRUE(timer.bit(kR, 10)) << at << (reset ? " reset" : " stopped");
    }
  }
}

// BT-01, BT-02, BT-05: every setting of the three segments, 4 to 25 quanta.
TEST(CanBitTiming, BitHasOneQuantumMoreThanItsSegmentsAndSamplesBeforePhaseSeg2) {
  for (unsigned prop = 1; prop <= 8; ++prop) {
    for (unsigned ps1 = 1; ps1 <= 8; ++ps1) {
      for (unsigned ps2 = 1; ps2 <= 8; ++ps2) {
        BitTimer timer{{.prop = prop, .ps1 = ps1, .ps2 = ps2, .sjw = 1}};
        const unsigned length = 1 + prop + ps1 + ps2;
        const Grid grid = run(timer, 5 * length, 0, 0);
        ASSERT_EQ(grid.ends.size(), 5u) << prop << ps1 << ps2;
        for (unsigned i = 0; i < 5; ++i) {
          EXPECT_EQ(grid.ends[i], (i + 1) * length);
          EXPECT_EQ(grid.samples[i], i * length + prop + ps1);
        }
      }
    }
  }
}

// BT-05: between two quanta nothing happens, however long a quantum is.
TEST(CanBitTiming, WaitsForTheQuantum) {
  BitTimer timer{{.prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 1}, false, 7};
  const Grid grid = run(timer, 16, 0, 0);
  EXPECT_EQ(grid.samples, (std::vector<unsigned>{5, 13}));
  EXPECT_EQ(grid.ends, (std::vector<unsigned>{8, 16}));
}

// SY-19, SY-07, SY-08, SY-10, SY-11, SY-12, PF-30, PF-31, PF-42: the sweep, by formula. The edge
// lies in the second of three bits; the first stands for "last sample recessive".
TEST(CanBitTiming, EdgeMovesTheNextSampleByItsPhaseErrorButAtMostBySjw) {
  for (const BitTiming &t : settings()) {
    const int n = static_cast<int>(t.quanta());
    const int before_sample = static_cast<int>(t.prop + t.ps1);
    const int sjw = static_cast<int>(t.sjw);
    for (int e = -static_cast<int>(t.ps2); e <= before_sample; ++e) {
      for (const Level sent : {kD, kR}) {
        SCOPED_TRACE(name(t) + " e " + std::to_string(e) + (sent == kD ? " sends d" : " sends r"));
        BitTimer timer{t};
        timer.next_hard(false);
        timer.finish_bit();
        timer.sends(sent);
        const int at = e >= 0 ? e : n + e;
        const Grid grid = run(timer, 60, static_cast<unsigned>(at), 60);
        const int late = (e > 0 && sent == kR) ? std::min(e, sjw) : 0;
        const int early = e < 0 ? std::min(-e, sjw) : 0;
        const int next_sync = n + late - early;
        // Within SJW the quantum of the edge is SYNC_SEG itself: the level follows at its end.
        const int next_level = next_sync + (e < 0 && -e <= sjw ? 1 : 0);
        ASSERT_GE(grid.samples.size(), 2u);
        EXPECT_EQ(grid.samples[0], static_cast<unsigned>(before_sample + late));
        EXPECT_EQ(grid.samples[1], static_cast<unsigned>(next_sync + before_sample));
        EXPECT_EQ(grid.ends[0], static_cast<unsigned>(next_level));
        EXPECT_EQ(grid.ends[1], static_cast<unsigned>(next_sync + n));
      }
    }
  }
}

// SY-06, PF-32: not limited by SJW, in every quantum of the bit; the edge's quantum is SYNC_SEG.
TEST(CanBitTiming, HardSynchronisationMakesTheEdgesQuantumSyncSeg) {
  for (const BitTiming &t : settings()) {
    for (unsigned at = 0; at < t.quanta(); ++at) {
      SCOPED_TRACE(name(t) + " edge in quantum " + std::to_string(at));
      BitTimer timer{t};
      timer.next_hard(true);
      timer.finish_bit();
      const Grid grid = run(timer, 60, at, 60);
      const unsigned before_sample = t.prop + t.ps1;
      std::vector<unsigned> samples;
      if (at > before_sample) samples.push_back(before_sample);
      samples.push_back(at + before_sample);
      ASSERT_GE(grid.samples.size(), samples.size());
      EXPECT_TRUE(std::equal(samples.begin(), samples.end(), grid.samples.begin()));
      // After the sample point the bit ends at once, so that an own frame starts (SY-13).
      EXPECT_EQ(grid.ends[0], at > before_sample ? at + 1 : at + t.quanta());
    }
  }
}

// SY-05, SY-06, IF-16: on the bus anew the node integrates and has sampled nothing yet, so that the
// first edge synchronises hard. The dominant bits from before the stop do not count (SY-02).
TEST(CanBitTiming, FirstEdgeAfterAStopSynchronisesWhateverWasSampledBefore) {
  const BitTiming t{.prop = 3, .ps1 = 2, .ps2 = 4, .sjw = 1};
  for (const bool reset : {false, true}) {
    for (unsigned at = 0; at < t.prop + t.ps1; ++at) {
      SCOPED_TRACE(std::string{reset ? "reset" : "stopped"} + ", edge in " + std::to_string(at));
      BitTimer timer{t};
      for (unsigned i = 0; i < 2 * t.quanta(); ++i) timer.quantum(kD);
      timer.stop(reset);
      const Grid grid = run(timer, 30, at, 30);
      ASSERT_FALSE(grid.samples.empty());
      EXPECT_EQ(grid.samples[0], at + t.prop + t.ps1);
      ASSERT_FALSE(grid.ends.empty());
      EXPECT_EQ(grid.ends[0], at + t.quanta());
    }
  }
}

// SY-09: the worked examples, PS2 = 4 and SJW = 2; and an edge five quanta late.
TEST(CanBitTiming, WorkedExamplesOfTheRuleBook) {
  const BitTiming t{.prop = 3, .ps1 = 4, .ps2 = 4, .sjw = 2};  // 12 quanta, PS2 is 8..11
  const struct {
    unsigned edge, next_sample;
  } kExamples[] = {{11, 11 + 7},  // e = -1: that quantum is SYNC_SEG
                   {10, 10 + 7},  // e = -2: the same
                   {9, 10 + 7},   // e = -3: PS2 ends after its second quantum
                   {8, 10 + 7}};  // e = -4: the same
  for (const auto &example : kExamples) {
    BitTimer timer{t};
    timer.next_hard(false);
    timer.finish_bit();
    EXPECT_EQ(run(timer, 24, example.edge, 99).samples[1], example.next_sample) << example.edge;
  }
  BitTimer timer{t};
  timer.next_hard(false);
  timer.finish_bit();
  EXPECT_EQ(run(timer, 24, 5, 99).samples[0], 7u + 2u);
}

// SY-01, SY-02, SY-03, PF-54: rising edges, edges after a dominant sample and second edges do
// nothing.
TEST(CanBitTiming, OnlyTheFirstFallingEdgeAfterARecessiveSampleCounts) {
  const BitTiming t{.prop = 3, .ps1 = 4, .ps2 = 4, .sjw = 4};  // 12 quanta, sample in 7
  const auto samples = [&](const std::string &levels) {
    BitTimer timer{t};
    timer.next_hard(false);
    timer.finish_bit();
    std::vector<unsigned> at;
    for (unsigned i = 0; i < levels.size(); ++i) {
      if (timer.quantum(levels[i] == '0' ? kD : kR).sample) at.push_back(i);
    }
    return at;
  };
  EXPECT_EQ(samples("000111111111"
                    "111111111111"),
            (std::vector<unsigned>{7, 19}));
  // Glitch to r in the dominant bit: in PROP, in PS1, in PS2.
  EXPECT_EQ(samples("001000000000"
                    "000000000000"),
            (std::vector<unsigned>{7, 19}));
  EXPECT_EQ(samples("000001000000"
                    "000000000000"),
            (std::vector<unsigned>{7, 19}));
  EXPECT_EQ(samples("000000000100"
                    "000000000000"),
            (std::vector<unsigned>{7, 19}));
  // Two edges before the sample: the first counts (+2), the second does not.
  EXPECT_EQ(samples("110010000000"
                    "00000000000000"),
            (std::vector<unsigned>{9, 21}));
}

// SY-04: a dominant pulse of one quantum synchronises although it is sampled recessive.
TEST(CanBitTiming, PulseOfOneQuantumSynchronises) {
  BitTimer timer{{.prop = 3, .ps1 = 4, .ps2 = 4, .sjw = 4}};
  timer.next_hard(false);
  timer.finish_bit();
  EXPECT_EQ(run(timer, 30, 3, 4).samples, (std::vector<unsigned>{10, 22}));
}

// SY-16: a lengthened and a shortened bit are followed by nominal ones.
TEST(CanBitTiming, NextBitHasNominalLengthAgain) {
  const BitTiming t{.prop = 3, .ps1 = 4, .ps2 = 4, .sjw = 3};
  for (const unsigned edge : {6u, 9u}) {
    BitTimer timer{t};
    timer.next_hard(false);
    timer.finish_bit();
    const Grid grid = run(timer, 60, edge, 60);
    for (std::size_t i = 2; i < grid.samples.size(); ++i) {
      EXPECT_EQ(grid.samples[i] - grid.samples[i - 1], t.quanta());
    }
  }
}

// PF-29, BT-04: the longest TSEG1 lengthened by the largest SJW: 29 quanta.
TEST(CanBitTiming, LongestBitWithLongestLengthening) {
  BitTimer timer{{.prop = 8, .ps1 = 8, .ps2 = 8, .sjw = 4}};
  timer.next_hard(false);
  timer.finish_bit();
  const Grid grid = run(timer, 60, 16, 60);
  EXPECT_EQ(grid.samples[0], 20u);
  EXPECT_EQ(grid.ends[0], 29u);
}

// BT-10: majority of the sample point and the two quanta before it; its place does not move.
TEST(CanBitTiming, TripleSamplingTakesTheMajorityAtTheSamePlace) {
  const BitTiming t{.prop = 3, .ps1 = 4, .ps2 = 4, .sjw = 1};  // sample in 7
  for (unsigned pattern = 0; pattern < 8; ++pattern) {
    BitTimer timer{t, true};
    timer.next_hard(false);
    timer.finish_bit();
    timer.sends(kD);  // late edges do not move the sample
    for (unsigned i = 0; i < 5; ++i) EXPECT_FALSE(timer.quantum(kD).sample);
    EXPECT_FALSE(timer.quantum((pattern & 4) != 0 ? kR : kD).sample);
    EXPECT_FALSE(timer.quantum((pattern & 2) != 0 ? kR : kD).sample);
    const Event event = timer.quantum((pattern & 1) != 0 ? kR : kD);
    ASSERT_TRUE(event.sample);
    const bool two = (pattern & (pattern - 1)) != 0;
    EXPECT_EQ(event.bit, two ? kR : kD) << pattern;
  }
}

/// One random life of the block beside the reference; returns the first difference.
std::string compare(const BitTiming &timing, bool triple, std::mt19937 &rng) {
  BitTimer timer{timing, triple};
  TimingReference reference{timing, triple};
  bool hard = true;
  Level sent = kR;
  Level bus = kR;
  for (int t = 0; t < 1500; ++t) {
    // Mostly long levels, sometimes glitches; a node that hard-synchronises sends recessive.
    if (rng() % 5 == 0) bus = !bus;
    const bool next_hard = (rng() & 3) == 0;
    timer.next_hard(next_hard);
    timer.sends(sent);
    const Event got = timer.quantum(bus);
    const TimingReference::Quantum want = reference.step(bus, sent, hard);
    if (got.sample != want.sample || got.last != want.last || got.edge != want.edge ||
        (got.sample && got.bit != want.bit)) {
      return name(timing) + ", quantum " + std::to_string(t);
    }
    if (got.last) {
      hard = next_hard;
      sent = hard || (rng() & 1) != 0 ? kR : kD;
    }
  }
  return {};
}

// SY-19, SY-21, SY-06, SY-08, SY-10, BT-10: any levels, any settings, both kinds of sampling.
TEST(CanBitTiming, AgreesWithTheReferenceUnderRandomLevels) {
  std::mt19937 rng{1};
  for (int round = 0; round < 600; ++round) {
    BitTiming t;
    t.prop = 1 + rng() % 8;
    t.ps1 = 1 + rng() % 8;
    t.ps2 = 1 + rng() % 8;
    t.sjw = 1 + rng() % std::min({4u, t.ps1, t.ps2});
    ASSERT_EQ(compare(t, (round & 1) != 0, rng), "");
  }
}

// BT-05: after reset the first quantum is SYNC_SEG.
TEST(CanBitTiming, FirstBitIsWhole) {
  const BitTiming t{.prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 1};
  BitTimer timer{t};
  EXPECT_TRUE(timer.bit(kR, t.quanta()));
}

// BT-05: a position beyond the sample point, as an upset flip-flop makes it (here: segments that
// shrink), is sampled at once, and the segments in use are always those of the inputs.
TEST(CanBitTiming, PositionBeyondTheSamplePointEndsTheBit) {
  BitTimer timer({.prop = 8, .ps1 = 8, .ps2 = 2});
  for (int i = 0; i < 12; ++i) EXPECT_FALSE(timer.quantum(kR).sample);
  timer.set({.prop = 2, .ps1 = 3, .ps2 = 2});
  const Grid grid = run(timer, 24, 0, 0);
  ASSERT_GE(grid.ends.size(), 3u);
  EXPECT_LE(grid.samples[0], 3u);
  EXPECT_EQ(grid.ends[0] - grid.samples[0], 3u);
  EXPECT_EQ(grid.ends[1] - grid.ends[0], 8u);
  EXPECT_EQ(grid.ends[2] - grid.ends[1], 8u);
}

}  // namespace
}  // namespace vericansim
