// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bus kernel with stand-in nodes: order of events, wired AND, delays, actions, observers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <map>
#include <memory>
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
constexpr ClockConfig kMegahertz{.frequency_hz = 1e6};  // edges at 0, 1, 2, ... us

// Drives from a given edge on what a table says, and keeps what it saw.
class StandIn : public Node {
 public:
  StandIn(const std::string &name, const ClockConfig &clock, std::map<unsigned, Level> plan = {})
      : Node{name, clock}, plan_{std::move(plan)} {}

  void clock(Level rx) override {
    seen_.push_back(rx == kD ? '0' : '1');
    times_.push_back(oscillator().next());
    if (const auto it = plan_.find(edge_); it != plan_.end()) drive(it->second);
    ++edge_;
  }

  [[nodiscard]] const std::string &seen() const { return seen_; }
  [[nodiscard]] const std::vector<Time> &times() const { return times_; }

 private:
  std::map<unsigned, Level> plan_;
  unsigned edge_ = 0;
  std::string seen_;
  std::vector<Time> times_;
};

struct Watcher : BusObserver {
  unsigned interests() const override { return kLevels | kNodeLevels; }
  void on_level(Time t, Level level) override { levels.emplace_back(t, level); }
  void on_node_tx(NodeId node, Time t, Level level) override {
    if (node == 0) tx.emplace_back(t, level);
  }
  void on_node_rx(NodeId node, Time t, Level level) override {
    if (node == 1) rx.emplace_back(t, level);
  }
  std::vector<std::pair<Time, Level>> levels, tx, rx;
};

TEST(BusKernel, EverybodySamplesWhatWasDrivenBeforeTheEdge) {
  for (const bool swapped : {false, true}) {  // the order of adding must not matter
    Bus bus;
    StandIn a{"a", kMegahertz, {{2, kD}, {4, kR}}};
    StandIn b{"b", kMegahertz};
    bus.add(swapped ? b : a);
    bus.add(swapped ? a : b);
    EXPECT_TRUE(bus.lockstep());
    bus.run_until(6 * kMicrosecond);
    EXPECT_EQ(a.seen(), "1110011");
    EXPECT_EQ(b.seen(), "1110011");
  }
}

// The same by events: another frequency keeps the bus out of lockstep.
TEST(BusKernel, EventsGiveTheSameAsLockstep) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{2, kD}, {4, kR}}};
  StandIn b{"b", kMegahertz};
  StandIn other{"other", {.frequency_hz = 3.3e6}};
  bus.add(a);
  bus.add(b);
  bus.add(other);
  EXPECT_FALSE(bus.lockstep());
  bus.run_until(6 * kMicrosecond);
  EXPECT_EQ(a.seen(), "1110011");
  EXPECT_EQ(b.seen(), "1110011");
}

TEST(BusKernel, OneDominantNodeWins) {  // rule book 0: AND of all drivers
  Bus bus;
  StandIn a{"a", kMegahertz, {{0, kD}, {2, kR}}};
  StandIn b{"b", kMegahertz, {{1, kD}, {4, kR}}};
  StandIn c{"c", kMegahertz};
  bus.add(a);
  bus.add(b);
  bus.add(c);
  bus.run_until(6 * kMicrosecond);
  EXPECT_EQ(c.seen(), "1000011");
  EXPECT_EQ(bus.level(), kR);
}

TEST(BusKernel, EveryNodeIsClockedAtItsOwnTimes) {
  Bus bus;
  StandIn a{"a", {.frequency_hz = 2e6, .phase = 100}};
  StandIn b{"b", {.frequency_hz = 5e5, .phase = 7}};
  bus.add(a);
  bus.add(b);
  bus.run_until(2 * kMicrosecond);
  EXPECT_THAT(a.times(), ElementsAre(100, 500'100, 1'000'100, 1'500'100));
  EXPECT_THAT(b.times(), ElementsAre(7));
  EXPECT_EQ(bus.now(), 2 * kMicrosecond);
  bus.step();
  EXPECT_EQ(bus.now(), 2'000'007);
}

struct Delay {
  Time time;
  const char *seen;  // by the receiver, if the sender is dominant after its edges 2 and 3
};

class CableTest : public ::testing::TestWithParam<Delay> {};

TEST_P(CableTest, LevelArrivesAfterItsDelay) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{2, kD}, {4, kR}}};
  StandIn b{"b", kMegahertz};
  bus.add(a, {.cable = GetParam().time / 2});
  bus.add(b, {.cable = GetParam().time - GetParam().time / 2});
  bus.run_until(9 * kMicrosecond);
  EXPECT_EQ(b.seen(), GetParam().seen);
  EXPECT_EQ(a.seen(), "1110011111");  // its own level is at its own transceiver at once
}

INSTANTIATE_TEST_SUITE_P(Delays, CableTest,
                         ::testing::Values(Delay{0, "1110011111"}, Delay{1, "1110011111"},
                                           Delay{kMicrosecond - 1, "1110011111"},
                                           Delay{kMicrosecond, "1111001111"},
                                           Delay{3 * kMicrosecond, "1111110011"}));

TEST(BusKernel, TransceiverDelaysConcernTheNodeItself) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{2, kD}, {4, kR}}};
  bus.add(a, {.transmitter = 600 * kNanosecond, .receiver = 400 * kNanosecond});
  EXPECT_EQ(bus.delay(0, 0), kMicrosecond);
  bus.run_until(7 * kMicrosecond);
  EXPECT_EQ(a.seen(), "11110011");
}

TEST(BusKernel, PairwiseDelaysOverrideTheLinks) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{2, kD}, {3, kR}}};
  StandIn b{"b", kMegahertz};
  StandIn c{"c", kMegahertz};
  bus.add(a);
  bus.add(b);
  bus.add(c);
  bus.set_delay(0, 1, 2 * kMicrosecond);
  EXPECT_EQ(bus.delay(0, 1), 2 * kMicrosecond);
  EXPECT_EQ(bus.delay(1, 0), 0);
  bus.run_until(7 * kMicrosecond);
  EXPECT_EQ(b.seen(), "11111011");
  EXPECT_EQ(c.seen(), "11101111");
}

// A pulse is on its way when the delay becomes shorter: what comes behind it does not overtake it.
TEST(BusKernel, AShorterDelayKeepsTheOrderOfASource) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{0, kD}, {3, kR}, {14, kD}}};
  StandIn b{"b", kMegahertz};
  StandIn c{"c", kMegahertz, {{4, kD}, {5, kR}}};
  bus.add(a);
  bus.add(b);
  bus.add(c);
  bus.set_delay(0, 1, 9 * kMicrosecond);
  bus.set_delay(2, 1, 4 * kMicrosecond);
  bus.at(2 * kMicrosecond, [&] { bus.set_delay(0, 1, kMicrosecond); });
  bus.run_until(17 * kMicrosecond);
  EXPECT_EQ(b.seen(), "111111111011111100");
}

// Two short pulses of two nodes are on the same wire at the same time.
TEST(BusKernel, SeveralChangesTravelAtOnce) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{0, kD}, {1, kR}, {3, kD}, {4, kR}}};
  StandIn b{"b", kMegahertz, {{1, kD}, {2, kR}}};
  StandIn c{"c", kMegahertz};
  bus.add(a);
  bus.add(b);
  bus.add(c);
  bus.set_delay(0, 2, 5 * kMicrosecond);
  bus.set_delay(1, 2, 1 * kMicrosecond);
  bus.run_until(11 * kMicrosecond);
  EXPECT_EQ(c.seen(), "111011011011");
}

TEST(BusKernel, ObserverSeesLevelsWithTheirTimes) {
  Bus bus;
  Watcher watcher;
  StandIn a{"a", kMegahertz, {{2, kD}, {4, kR}}};
  StandIn b{"b", kMegahertz};
  bus.add(watcher);
  bus.add(a, {.cable = 300});
  bus.add(b, {.cable = 200});
  bus.run_until(8 * kMicrosecond);
  EXPECT_THAT(watcher.tx, ElementsAre(Pair(2'000'000, kD), Pair(4'000'000, kR)));
  EXPECT_THAT(watcher.levels, ElementsAre(Pair(2'000'300, kD), Pair(4'000'300, kR)));
  EXPECT_THAT(watcher.rx, ElementsAre(Pair(3'000'000, kD), Pair(5'000'000, kR)));
}

TEST(BusKernel, ObserverSeesTheSameInLockstep) {
  Bus bus;
  Watcher watcher;
  StandIn a{"a", kMegahertz, {{2, kD}, {4, kR}}};
  StandIn b{"b", kMegahertz};
  bus.add(watcher);
  bus.add(a);
  bus.add(b);
  ASSERT_TRUE(bus.lockstep());
  bus.run_until(8 * kMicrosecond);
  EXPECT_THAT(watcher.levels, ElementsAre(Pair(2'000'000, kD), Pair(4'000'000, kR)));
  EXPECT_THAT(watcher.rx, ElementsAre(Pair(3'000'000, kD), Pair(5'000'000, kR)));
  bus.remove(watcher);
  bus.run_for(kMicrosecond);
}

TEST(BusKernel, ActionsRunAtTheirTimeAndBeforeItsEdges) {
  Bus bus;
  StandIn a{"a", kMegahertz};
  bus.add(a);
  std::vector<std::pair<Time, std::size_t>> log;
  const auto note = [&] { log.emplace_back(bus.now(), a.seen().size()); };
  bus.at(2 * kMicrosecond, note);
  bus.at(500 * kNanosecond, [&] {
    note();
    bus.at(bus.now() + 1, note);
  });
  bus.at(2 * kMicrosecond, [&] { log.emplace_back(-1, 0); });
  bus.run_until(3 * kMicrosecond);
  EXPECT_THAT(log,
              ElementsAre(Pair(500'000, 1u), Pair(500'001, 1u), Pair(2'000'000, 2u), Pair(-1, 0u)));
  EXPECT_THROW(bus.at(kMicrosecond, note), std::invalid_argument);
}

TEST(BusKernel, RunsUntilACondition) {
  Bus bus;
  StandIn a{"a", kMegahertz};
  bus.add(a);
  EXPECT_TRUE(bus.run_until([&] { return a.seen().size() == 5; }, kMillisecond));
  EXPECT_EQ(bus.now(), 4 * kMicrosecond);
  EXPECT_FALSE(bus.run_until([] { return false; }, 10 * kMicrosecond));
  bus.at(20 * kMicrosecond, [&] { bus.stop(); });
  bus.run_until(kMillisecond);
  EXPECT_EQ(bus.now(), 20 * kMicrosecond);
}

// "No limit", as a caller may write it, at any time of the bus.
TEST(BusKernel, ASpanMayGoBeyondTheEndOfTime) {
  constexpr Time kLongest = std::numeric_limits<Time>::max();
  StandIn node("a", kMegahertz);
  Bus bus;
  bus.add(node);
  bus.run_for(3 * kMicrosecond);
  EXPECT_TRUE(bus.run_until([&] { return node.seen().size() == 9; }, kLongest));
  for (const bool span : {true, false}) {
    const Time end = bus.now() + 5 * kMicrosecond;
    bus.at(end, [&] { bus.stop(); });
    span ? bus.run_for(kLongest) : bus.run_until(kLongest);
    EXPECT_EQ(bus.now(), end);
  }
  Bus empty;
  empty.run_for(kMicrosecond);
  EXPECT_FALSE(empty.run_until([] { return false; }, kLongest));
  empty.run_until(kLongest);
}

TEST(BusKernel, NodeMayJoinARunningBus) {
  Bus bus;
  StandIn a{"a", kMegahertz, {{0, kD}}};
  bus.add(a);
  bus.run_until(3 * kMicrosecond);
  StandIn late{"late", {.frequency_hz = 1e6, .phase = 5 * kMicrosecond}};
  StandIn past{"past", kMegahertz};
  EXPECT_EQ(bus.add(late), 1u);
  EXPECT_THROW(bus.add(past), std::invalid_argument);
  bus.run_until(6 * kMicrosecond);
  EXPECT_EQ(late.seen(), "00");
}

TEST(BusKernel, RefusesImpossibleBuses) {
  Bus bus;
  StandIn a{"a", kMegahertz};
  StandIn b{"b", kMegahertz};
  bus.add(a);
  EXPECT_THROW(bus.add(a), std::invalid_argument);
  EXPECT_THROW(bus.add(b, {.cable = -1}), std::invalid_argument);
  EXPECT_THROW(bus.set_delay(0, 0, -1), std::invalid_argument);
  std::vector<std::unique_ptr<StandIn>> many;
  Bus full;
  for (unsigned i = 0; i < Bus::kMaxNodes; ++i) {
    many.push_back(std::make_unique<StandIn>("n", kMegahertz));
    full.add(*many.back());
  }
  EXPECT_THROW(full.add(b), std::invalid_argument);
}

TEST(BusKernel, NodeAndBusMayDieInAnyOrder) {
  auto bus = std::make_unique<Bus>();
  auto first = std::make_unique<StandIn>("first", kMegahertz);
  StandIn second{"second", kMegahertz};
  bus->add(*first);
  bus->add(second);
  first.reset();
  EXPECT_THROW(bus->step(), std::logic_error);
  bus.reset();
  EXPECT_EQ(second.bus(), nullptr);
}

}  // namespace
}  // namespace vericansim
