// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults with stand-in nodes: each changes what it should, where and when it should, and nothing
// else.
#include "bus/faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;
constexpr ClockConfig kMegahertz{.frequency_hz = 1e6};

// Drives one character of a pattern an edge ('0', '1'; recessive afterwards) and keeps what it saw.
class StandIn : public Node {
 public:
  StandIn(const std::string &name, std::string pattern = "", const ClockConfig &clock = kMegahertz)
      : Node{name, clock}, pattern_{std::move(pattern)} {}

  void clock(Level rx) override {
    seen_.push_back(rx == kD ? '0' : '1');
    last_ = oscillator().next();
    drive(edge_ < pattern_.size() && pattern_[edge_] == '0' ? kD : kR);
    ++edge_;
  }
  [[nodiscard]] std::uint64_t trace() const override {
    return edge_ <= words_.size() ? words_[edge_ - 1] : 0;
  }

  void show(std::vector<std::uint64_t> words) { words_ = std::move(words); }
  [[nodiscard]] const std::string &seen() const { return seen_; }
  [[nodiscard]] Time last() const { return last_; }

 private:
  std::string pattern_;
  std::size_t edge_ = 0;
  std::string seen_;
  Time last_ = 0;
  std::vector<std::uint64_t> words_;
};

struct FaultTest : ::testing::Test {
  Bus bus;
  StandIn a{"a", "110011"};  // seen by all as 1110011111
  StandIn b{"b"};
  StandIn c{"c"};
  void SetUp() override {
    bus.add(a);
    bus.add(b);
    bus.add(c);
  }
  void run(Fault &fault) {
    bus.add(fault);
    bus.run_until(9 * kMicrosecond);
  }
};

TEST_F(FaultTest, ForcedBusIsForcedForEverybodyWithinItsWindow) {
  LevelFault fault{kAllNodes, Effect::kDominant, {5 * kMicrosecond, 7 * kMicrosecond}};
  run(fault);
  for (const StandIn *node : {&a, &b, &c}) EXPECT_EQ(node->seen(), "1110000111");
}

TEST_F(FaultTest, StuckRecessiveBusHidesADominantDriver) {
  LevelFault fault{kAllNodes, Effect::kRecessive, {}};
  run(fault);
  for (const StandIn *node : {&a, &b, &c}) EXPECT_EQ(node->seen(), "1111111111");
  EXPECT_EQ(bus.level(), kR);
}

TEST_F(FaultTest, FlipConcernsOneReceiver) {
  LevelFault fault{1, Effect::kFlip, {2 * kMicrosecond, 4 * kMicrosecond}};
  run(fault);
  EXPECT_EQ(a.seen(), "1110011111");
  EXPECT_EQ(b.seen(), "1101011111");
  EXPECT_EQ(c.seen(), "1110011111");
}

TEST_F(FaultTest, CutNodeHearsOnlyItselfAndIsNotHeard) {
  StandIn d{"d", "11111100"};
  bus.add(d);
  CutFault fault{0, {}};
  run(fault);
  EXPECT_EQ(a.seen(), "1110011111");
  EXPECT_EQ(b.seen(), "1111111001");
}

TEST_F(FaultTest, ShortedTransmitterIsDominantForAll) {
  ShortFault fault{2, {6 * kMicrosecond, 8 * kMicrosecond}};
  run(fault);
  for (const StandIn *node : {&a, &b, &c}) EXPECT_EQ(node->seen(), "1110010011");
}

TEST_F(FaultTest, SeveralFaultsAddUp) {
  ShortFault shorted{2, {6 * kMicrosecond, 8 * kMicrosecond}};
  CutFault cut{2, {7 * kMicrosecond, 8 * kMicrosecond}};  // the cable of the shorted node breaks
  bus.add(shorted);
  run(cut);
  EXPECT_EQ(a.seen(), "1110010111");
  EXPECT_EQ(c.seen(), "1110010011");
}

TEST_F(FaultTest, ObserverSeesTheFaultOnTheBus) {
  struct Watcher : BusObserver {
    unsigned interests() const override { return kLevels; }
    void on_level(Time t, Level level) override { levels.emplace_back(t, level); }
    std::vector<std::pair<Time, Level>> levels;
  } watcher;
  bus.add(watcher);
  LevelFault fault{kAllNodes, Effect::kDominant, {6 * kMicrosecond, 8 * kMicrosecond}};
  run(fault);
  EXPECT_THAT(watcher.levels, ElementsAre(Pair(2'000'000, kD), Pair(4'000'000, kR),
                                          Pair(6'000'000, kD), Pair(8'000'000, kR)));
}

TEST_F(FaultTest, ClockDriftBeginsAtItsTime) {
  ASSERT_TRUE(bus.lockstep());
  ClockFault fault{1, 4'500'000, -100'000};  // period 1.111 us
  run(fault);
  EXPECT_EQ(b.last(), 5'000'000 + 3 * 1'111'111);
  EXPECT_EQ(a.last(), 9'000'000);
}

// ---- Places

std::uint64_t word(Field field, unsigned left, bool boundary = false, bool stuff = false,
                   bool start = false) {
  return (boundary ? kTraceBoundary : 0) | (static_cast<std::uint64_t>(field) << 38) |
         (static_cast<std::uint64_t>(left) << 32) | (stuff ? 1ULL << 43 : 0) |
         (start ? kTraceStart : 0);
}

// Two clocks a bit: IDLE, start in it, ID 10, ID 9 (stuff), ID 9, ID 8.
const std::vector<std::uint64_t> kTrace = {word(Field::kIdle, 0, true),
                                           word(Field::kIdle, 0),
                                           word(Field::kId, 10, true, false, true),
                                           word(Field::kId, 10),
                                           word(Field::kId, 9, true, true),
                                           word(Field::kId, 9, false, true),
                                           word(Field::kId, 9, true),
                                           word(Field::kId, 9),
                                           word(Field::kId, 8, true),
                                           word(Field::kId, 8)};

TEST(PlaceTracker, CountsBitsOfAFieldWithoutStuffBits) {
  PlaceTracker tracker;
  std::string indices;
  for (const std::uint64_t w : kTrace) {
    tracker.clocked(w);
    if (tracker.field() == Field::kId && tracker.fresh()) {
      indices += std::to_string(tracker.index()) + (tracker.stuff() ? "s " : " ");
    }
  }
  EXPECT_EQ(indices, "0 1s 1 2 ");
  EXPECT_EQ(tracker.frame(), 1u);
}

// EF-06: the second flag begins at once; EF-03: a passive one goes on, however its count does.
TEST(PlaceTracker, ANewErrorFlagBeginsWithItsFirstBit) {
  PlaceTracker tracker;
  std::string indices;
  for (const unsigned left : {5, 5, 4, 4, 3, 5, 4}) {
    tracker.clocked(word(Field::kErrFlag, left, true));
    tracker.clocked(word(Field::kErrFlag, left));
    indices += std::to_string(tracker.index());
  }
  EXPECT_EQ(indices, "0012301");
}

struct PlaceCase {
  const char *name;
  PlaceSpec place;
  const char *seen;  // at b, whose bus is recessive all the time
};

class PlaceTest : public ::testing::TestWithParam<PlaceCase> {};

// b shows kTrace; what it samples one edge after a place was entered belongs to that bit.
TEST_P(PlaceTest, HitsTheNamedBitOnly) {
  Bus bus;
  StandIn a{"a"};
  StandIn b{"b"};
  b.show(kTrace);
  bus.add(a);
  bus.add(b);
  PlaceFault fault{1, GetParam().place, Effect::kFlip};
  bus.add(fault);
  bus.run_until(10 * kMicrosecond);
  EXPECT_EQ(b.seen(), GetParam().seen);
  EXPECT_EQ(a.seen(), "11111111111");
}

INSTANTIATE_TEST_SUITE_P(
    Places, PlaceTest,
    ::testing::Values(
        PlaceCase{"Index", {.field = Field::kId, .index = 0}, "11110011111"},
        PlaceCase{"Left", {.field = Field::kId, .left = 8}, "11111111110"},
        PlaceCase{"StuffBit", {.field = Field::kId, .stuff = true}, "11111100111"},
        PlaceCase{"NoStuffBit", {.field = Field::kId, .index = 1, .stuff = false}, "11111111001"},
        PlaceCase{"LaterFrame", {.frame = 2, .field = Field::kId}, "11111111111"},
        PlaceCase{"FirstFrame", {.frame = 1, .field = Field::kId, .index = 0}, "11110011111"},
        PlaceCase{"FirstQuantum",
                  {.field = Field::kId, .index = 0, .first_clock = 0, .last_clock = 0},
                  "11110111111"},
        PlaceCase{"SecondQuantum",
                  {.field = Field::kId, .index = 0, .first_clock = 1, .last_clock = 1},
                  "11111011111"}),
    [](const auto &each) { return each.param.name; });

TEST(PlaceFault, MayHitSomebodyElse) {
  Bus bus;
  StandIn a{"a"};
  StandIn b{"b"};
  b.show(kTrace);
  bus.add(a);
  bus.add(b);
  PlaceFault fault{1, {.field = Field::kId, .index = 0}, Effect::kDominant, 0};
  bus.add(fault);
  bus.run_until(10 * kMicrosecond);
  EXPECT_EQ(b.seen(), "11111111111");
  EXPECT_THAT(a.seen(), ::testing::AnyOf("11110011111", "11111001111"));
  EXPECT_EQ(fault.hits(), 1u);
}

// ---- Noise

// Counts the calls of each of its functions, and asks for some of them.
class CountingFault : public Fault {
 public:
  explicit CountingFault(unsigned hooks) : hooks_{hooks} {}
  [[nodiscard]] unsigned hooks() const override { return hooks_; }
  [[nodiscard]] std::uint64_t unheard(NodeId, Time) override {
    called_ |= kUnheard;
    return 0;
  }
  [[nodiscard]] std::uint64_t babbling(Time) override {
    called_ |= kBabbling;
    return 0;
  }
  [[nodiscard]] Level level(NodeId, Time, Level level) override {
    called_ |= kLevel;
    return level;
  }
  void clocked(NodeId, Time, std::uint64_t) override { called_ |= kClocked; }
  [[nodiscard]] unsigned called() const { return called_; }

 private:
  unsigned hooks_;
  unsigned called_ = 0;
};

// A fault that leaves the levels alone does not keep the bus from its fast way either.
TEST(FaultHooks, NoOthersAreCalled) {
  for (unsigned hooks = 0; hooks <= Fault::kAllHooks; ++hooks) {
    Bus bus;
    StandIn a{"a", "110011"}, b{"b"};
    bus.add(a);
    bus.add(b);
    CountingFault fault{hooks};
    bus.add(fault);
    bus.run_for(10 * kMicrosecond);
    EXPECT_EQ(fault.called(), hooks);
    EXPECT_EQ(bus.lockstep(), (hooks & ~Fault::kClocked) == 0) << hooks;
    EXPECT_EQ(b.seen().substr(0, 8), "11100111");
  }
}

TEST(Noise, GlitchesComeAtTheirRateAndOnlyAtTheVictim) {
  Bus bus;
  StandIn a{"a"};
  StandIn b{"b"};
  bus.add(a);
  bus.add(b);
  NoiseFault fault{{.per_ns = 1e-5, .glitch = 3 * kMicrosecond, .victim = 1}};  // one in 100 us
  bus.add(fault);
  bus.run_until(kSecond / 10);
  const auto hit = std::count(b.seen().begin(), b.seen().end(), '0');
  EXPECT_NEAR(fault.hits(), 1000.0, 4 * std::sqrt(1000.0));  // Poisson, four sigma
  const auto edges = static_cast<double>(b.seen().size());
  EXPECT_NEAR(static_cast<double>(hit), edges * (1 - std::exp(-3.0 * fault.hits() / edges)),
              0.02 * fault.hits());
  EXPECT_EQ(a.seen().find('0'), std::string::npos);
}

// A Poisson process has its rate also where glitches overlap: of the time e^(-rate * glitch) is
// undisturbed.
TEST(Noise, GlitchesKeepTheirRateWhereTheyOverlap) {
  Bus bus;
  StandIn a{"a"};
  bus.add(a);
  NoiseFault fault{{.per_ns = 1e-3, .glitch = kMicrosecond}};
  bus.add(fault);
  bus.run_until(kSecond / 10);
  EXPECT_NEAR(fault.hits(), 1e5, 4 * std::sqrt(1e5));
  const auto size = static_cast<double>(a.seen().size());
  const auto hit = static_cast<double>(std::count(a.seen().begin(), a.seen().end(), '0'));
  EXPECT_NEAR(hit / size, 1 - std::exp(-1.0), 0.01);
}

// The next glitch may be farther away than time goes.
TEST(Noise, MayBeAsGoodAsNone) {
  Bus bus;
  StandIn a{"a"};
  bus.add(a);
  NoiseFault fault{{.per_ns = 1e-20, .glitch = kMicrosecond}};
  bus.add(fault);
  bus.run_until(kMillisecond);
  EXPECT_EQ(fault.hits(), 0U);
}

TEST(Noise, IsGivenByItsSeed) {
  std::string seen[3];
  for (unsigned i = 0; i < 3; ++i) {
    Bus bus;
    StandIn a{"a"};
    bus.add(a);
    NoiseFault fault{{.per_ns = 1e-4, .glitch = kMicrosecond, .seed = i == 2 ? 2u : 1u}};
    bus.add(fault);
    bus.run_until(kMillisecond);
    seen[i] = a.seen();
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_NE(seen[0], seen[2]);
}

TEST(Noise, RefusesWhatIsNoProbability) {
  EXPECT_THROW(NoiseFault({.per_bit = 1.5}), std::invalid_argument);
  EXPECT_THROW(NoiseFault({.per_ns = -0.1}), std::invalid_argument);
}

TEST(Noise, RefusesGlitchesThatDoNotLastAndVictimsThatAreNoNodes) {
  EXPECT_THROW(NoiseFault({.per_ns = 0.1, .glitch = 0}), std::invalid_argument);
  EXPECT_THROW(NoiseFault({.per_ns = 0.1, .glitch = -1}), std::invalid_argument);
  EXPECT_NO_THROW(NoiseFault({.per_bit = 0.1, .glitch = 0}));
  for (const NodeId nobody : {NodeId{Bus::kMaxNodes}, kBusPoint})
    EXPECT_THROW(NoiseFault({.per_bit = 0.1, .victim = nobody}), std::invalid_argument);
}

// A fault of no node never takes effect, and a run with it would count as one with a fault.
TEST(Faults, RefuseNodesThatCannotBe) {
  for (const NodeId nobody : {NodeId{Bus::kMaxNodes}, kAllNodes, kBusPoint}) {
    EXPECT_THROW(CutFault(nobody, {}), std::invalid_argument) << nobody;
    EXPECT_THROW(ShortFault(nobody, {}), std::invalid_argument) << nobody;
    EXPECT_THROW(PlaceFault(nobody, {}, Effect::kFlip), std::invalid_argument) << nobody;
  }
  EXPECT_NO_THROW(CutFault(Bus::kMaxNodes - 1, {}));
  EXPECT_THROW(LevelFault(Bus::kMaxNodes, Effect::kFlip, {}), std::invalid_argument);
  EXPECT_THROW(PlaceFault(0, {}, Effect::kFlip, Bus::kMaxNodes), std::invalid_argument);
  EXPECT_THROW(ScheduledFaults{}.add(Bus::kMaxNodes, Effect::kFlip, {}), std::invalid_argument);
  for (const NodeId many : {kAllNodes, kBusPoint}) {
    EXPECT_NO_THROW(LevelFault(many, Effect::kFlip, {})) << many;
    EXPECT_NO_THROW(PlaceFault(0, {}, Effect::kFlip, many)) << many;
  }
  Bus bus;
  EXPECT_THROW(bus.set_delay(0, Bus::kMaxNodes, 1), std::invalid_argument);
}

// The bus is as it was before.
TEST(Faults, AClockFaultNeedsANodeOfTheBusAndAnErrorThatAClockMayHave) {
  StandIn a("a");
  Bus bus;
  bus.add(a);
  for (const auto &[node, ppm] : {std::pair{NodeId{1}, 5.0}, {kAllNodes, 5.0}, {0, 100'001.0}}) {
    ClockFault fault{node, kMicrosecond, ppm};
    EXPECT_THROW(bus.add(fault), std::invalid_argument) << node;
  }
  EXPECT_FALSE(bus.has_faults());
  EXPECT_NO_THROW(bus.run_for(5 * kMicrosecond));
}

}  // namespace
}  // namespace vericansim
