// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 19: an even sample of each part of the error injection matrix, and the lists that the
// matrix is made of. `make campaign` runs all of it (docs/error-injection.md), and with mutants
// three times this sample (harness/depth.hpp).
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <set>
#include <stdexcept>
#include <utility>

#include "faults/injection_axes.hpp"
#include "faults/section.hpp"
#include "harness/depth.hpp"

namespace vericansim {
namespace {

constexpr std::uint64_t kSeed = 1;

const Sections &sections() {
  static const Sections kAll = all_sections(kSeed);
  return kAll;
}

const Section &section(const std::string &name) {
  for (const auto &one : sections()) {
    if (one->grid().name() == name) return *one;
  }
  throw std::invalid_argument("no part " + name);
}

/// One of several tests that share a sample.
struct Slice {
  unsigned number;
  unsigned of;
};

void PrintTo(const Slice &slice, std::ostream *out) { *out << slice.number; }

class ErrorMatrix : public ::testing::TestWithParam<Slice> {
 protected:
  /// Runs this slice of a sample of `count` cases, thrice as many with VERICAN_WHOLE_TESTS; stops
  /// at the first that fails.
  static void sample(const std::string &name, std::size_t count) {
    count *= depth(1, 3);
    const Section &part = section(name);
    const Spread spread{part.grid().size(), count};
    ASSERT_EQ(spread.count(), count) << name << " has fewer cases";
    RuleBins bins;
    for (std::size_t i = GetParam().number; i < spread.count(); i += GetParam().of) {
      const std::size_t index = spread.at(i);
      const Outcome outcome = part.run(part.grid().digits(index), &bins);
      ASSERT_EQ(outcome.report, "")
          << "error_campaign --seed " << kSeed << " --run " << part.grid().id(index);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Slices, ErrorMatrix, ::testing::Values(Slice{0, 2}, Slice{1, 2}));

// MX-01, MX-02, MX-03, MX-04, MX-05, MX-26, MX-28, TH-02, TH-03: any bit of a frame that the DUT
// sends, and of intermission, suspend time and idle behind it.
TEST_P(ErrorMatrix, AnyBitOfASentFrameInverted) { sample("send", 5'400); }

// MX-06, MX-07, MX-08, MX-09, MX-10, MX-11, MX-12, MX-27: any bit of a received frame, and of the
// gap; LT falls silent, flags at once, or goes on until it sees the DUT's flag.
TEST_P(ErrorMatrix, AnyBitOfAReceivedFrameInverted) { sample("receive", 6'700); }

// MX-13, MX-17, MX-18, MX-19, MX-20, MX-21, MX-23, MX-30, ED-09, ED-12, EF-02: flag, delimiter wait
// and delimiter of error and overload frames.
TEST_P(ErrorMatrix, AnyBitOfErrorHandlingInverted) { sample("handling", 4'700); }

// MX-11, MX-13, MX-14, MX-15, MX-16, IF-05, IF-06, IF-10, OV-03, OV-08, TH-05: DEL8 or EOF7 to
// idle after every story, with and without a frame that waits; also as SOF of another frame.
TEST_P(ErrorMatrix, AnyBitOfTheGapInverted) { sample("gap", 2'000); }

// MX-02, MX-03, AR-02, AR-04, AR-07, TH-05: arbitration lost at each position, with a stuff bit
// before it, in its place, and behind it; LT goes on with the winner.
TEST_P(ErrorMatrix, ArbitrationLostAtEveryPosition) { sample("loss", 2'000); }

// MX-31: the mandatory pairs, their second disturbance at any bit that follows the first.
TEST_P(ErrorMatrix, MandatoryPairs) { sample("pairs", 2'000); }

// MX-15 to MX-23, MX-31: two to six disturbances at random, any start value of the counters.
TEST_P(ErrorMatrix, RandomDisturbances) { sample("random-1", 2'700); }

// MX-24, MO-01, MO-02, FC-22: as a listener: nothing sent, nothing counted, in step again.
TEST_P(ErrorMatrix, ListenerStaysSilentWhateverIsInverted) { sample("listen", 1'000); }

// MX-25, MO-09: a frame that is tried once.
TEST_P(ErrorMatrix, OneShotIsNotRepeated) { sample("one-shot", 1'400); }

// MO-04, FF-06: a node in loop-back does not care for its pin; an FD-tolerant one steps aside.
TEST_P(ErrorMatrix, LoopBackAndFdTolerance) {
  sample("loop-back", 200);
  sample("fd-tolerant", 400);
}

// MX-22, IN-01, IN-03, IN-04, BO-01, BO-02, BO-05, BO-07: integration, and any bit of bus-off until
// the DUT is back and has sent its frame.
TEST_P(ErrorMatrix, IntegrationAndBusOff) {
  sample("integration", 300);
  sample("bus-off", 200);
}

// MX-26, MX-27, MX-28, MX-29, MX-30, TH-05: each start value of a counter with each kind of step.
TEST_P(ErrorMatrix, EveryStartValueOfTheCounters) { sample("counters", 1'000); }

// TH-03, SY-01 to SY-18: a level forced for some clocks at any clock of any bit; the reference node
// says where samples and edges are.
TEST_P(ErrorMatrix, LevelsForcedForSomeClocks) {
  for (const char *name : {"clock-8clk", "clock-10clk-sjw2", "clock-10clk-sjw4", "clock-16clk"}) {
    sample(name, 700);
  }
}

// 19.5 item 6: the table has its parts, with all their cases, and every value of 19.1.
TEST(ErrorMatrixTable, HasAllValuesOfTheRuleBook) {
  std::map<std::string, std::size_t> sizes;
  for (const auto &part : sections()) sizes[part->grid().name()] = part->grid().size();
  // Whoever changes a part on purpose changes its size here; none is lost or shrinks by chance.
  const std::map<std::string, std::size_t> wanted{
      {"send", 585'466},
      {"receive", 1'056'325},
      {"handling", 492'404},
      {"gap", 148'176},
      {"loss", 109'275},
      {"pairs", 197'780},
      {"listen", 99'400},
      {"one-shot", 169'974},
      {"loop-back", 19'880},
      {"fd-tolerant", 27'260},
      {"integration", 10'584},
      {"bus-off", 11'280},
      {"counters", 12'288},
      {"random-1", 200'000},
      {"clock-8clk", 78'336},
      {"clock-10clk-sjw2", 97'920},
      {"clock-10clk-sjw4", 97'920},
      {"clock-16clk", 156'672},
      {"sync", 8'391},
  };
  EXPECT_EQ(sizes, wanted);
  for (const unsigned value : {0, 1, 95, 96, 119, 120, 126, 127, 128, 247, 248, 255}) {
    const auto has = [value](const auto member) {
      for (const StartCounters &c : all_counters()) {
        if (c.*member == value) return true;
      }
      return false;
    };
    EXPECT_TRUE(has(&StartCounters::tec)) << value;
    EXPECT_TRUE(has(&StartCounters::rec)) << value;
  }
}

// 19.1: base and extended, data and remote, DLC 0, 1, 8, 15; and bits behind 1 to 5 equal ones of
// either level.
TEST(ErrorMatrixTable, FramesHaveAllShapesOfTheRuleBook) {
  std::set<std::pair<bool, bool>> kinds;
  std::set<unsigned> lengths;
  std::set<std::pair<Level, unsigned>> runs;
  for (const Stream &stream : all_streams()) {
    kinds.insert({stream.frame.extended, stream.frame.remote});
    lengths.insert(stream.frame.dlc);
    const EncodedFrame frame = encode_frame(stream.frame, stream.options);
    unsigned run = 1;
    for (std::size_t i = 1; i < frame.stuffed_length; ++i) {
      runs.insert({frame.bits[i - 1].level, run});
      run = frame.bits[i].level == frame.bits[i - 1].level ? run + 1 : 1;
    }
  }
  EXPECT_EQ(kinds.size(), 4u);
  for (const unsigned dlc : {0, 1, 8, 15}) EXPECT_EQ(lengths.count(dlc), 1u) << dlc;
  EXPECT_EQ(runs.size(), 10u);
}

// Every case has a name of its own that leads back to it; a sample holds no case twice.
TEST(ErrorMatrixTable, NamesLeadBackToTheirCase) {
  for (const auto &part : sections()) {
    const Grid &grid = part->grid();
    const Spread spread{grid.size(), 50};
    std::set<std::string> names;
    for (std::size_t i = 0; i < spread.count(); ++i) {
      const std::string id = grid.id(spread.at(i));
      names.insert(id);
      EXPECT_EQ(grid.find(id), spread.at(i)) << id;
    }
    EXPECT_EQ(names.size(), spread.count()) << grid.name();
  }
}

}  // namespace
}  // namespace vericansim
