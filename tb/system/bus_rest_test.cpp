// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A bus whose nodes may rest (Bus::let_rest()) is the bus that clocks them every time: the same
// levels, bits, frames, stamps, register contents and clocks, at the same times.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "harness/bus_trail.hpp"
#include "model/registers.hpp"
#include "node/core_node.hpp"
#include "node/host.hpp"
#include "node/model_edge.hpp"

namespace vericansim {
namespace {

struct World {
  const char *name;
  double megahertz;
  BitTiming timing;
  bool own_clocks = false;
  Wander wander = Wander::kNone;
  double metres = 0;
  bool triple_sampling = false;
};

void PrintTo(const World &world, std::ostream *out) { *out << world.name; }

constexpr World kWorlds[] = {
    {"OneClock8", 8, {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2}},
    {"OneClock50", 50, {.prescaler = 5, .prop = 3, .ps1 = 3, .ps2 = 3, .sjw = 3}},
    {"OwnClocks8", 8, {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2}, true},
    {"OwnClocks16",
     16,
     {.prescaler = 2, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2},
     true,
     Wander::kNone,
     20},
    {"OwnClocks80",
     80,
     {.prescaler = 16, .prop = 4, .ps1 = 3, .ps2 = 2, .sjw = 1},
     true,
     Wander::kNone,
     40,
     true},
    {"Wandering40",
     40,
     {.prescaler = 4, .prop = 3, .ps1 = 4, .ps2 = 2, .sjw = 2},
     true,
     Wander::kWalk,
     10},
    {"Slow",
     48,
     {.prescaler = 256, .prop = 3, .ps1 = 4, .ps2 = 4, .sjw = 3},
     true,
     Wander::kSine,
     100},
};

ClockConfig clock_of(const World &world, unsigned node) {
  ClockConfig clock{.frequency_hz = world.megahertz * 1e6};
  if (!world.own_clocks) return clock;
  clock.error_ppm = (node % 2 == 0 ? 1 : -1) * (400.0 + 130.0 * node);
  clock.phase = 1013 * node;
  clock.wander = world.wander;
  clock.wander_ppm = world.wander == Wander::kNone ? 0 : 300;
  clock.wander_period = 300 * kMicrosecond;
  clock.seed = node + 1;
  return clock;
}

Frame random_frame(std::mt19937 &random) {
  Frame frame;
  frame.extended = random() % 2 == 0;
  frame.id = random() & (frame.extended ? 0x1FFFFFFF : 0x7FF);
  frame.remote = random() % 5 == 0;
  frame.dlc = static_cast<std::uint8_t>(random() % 9);
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(random());
  return frame;
}

// Drives dominant for one or two bit times now and then: errors for the others.
class Spoiler : public Node {
 public:
  explicit Spoiler(double bits_per_second) : Node{"spoiler", {.frequency_hz = bits_per_second}} {}
  void clock(Level) override {
    if (left_ > 0 && --left_ == 0) drive(Level::kRecessive);
    if (left_ == 0 && random_() % 400 == 0) {
      left_ = 1 + random_() % 2;
      drive(Level::kDominant);
    }
  }

 private:
  std::mt19937 random_{5};
  unsigned left_ = 0;
};

constexpr std::uint32_t kRegisters[] = {reg::kMcr, reg::kCtrl, reg::kTimer,
                                        reg::kEcr, reg::kEsr,  reg::kIflag1};

// Whole cores with software and two engines alone; their world is always the same.
class Stage {
 public:
  Stage(const World &world, bool watched, bool rest) : world_{world}, random_{1}, spoiler_{rate()} {
    bus_.let_rest(rest);
    const Link link{.cable = cable_delay(world.metres / 2), .transmitter = 0, .receiver = 0};
    for (unsigned i = 0; i < 3; ++i) add_core(i, link);
    for (unsigned i = 3; i < 5; ++i) add_engine(i, link);
    if (world.own_clocks) bus_.add(spoiler_, link);
    if (watched) bus_.add(recorder_);
  }

  Trail run(unsigned bits) {
    const auto bit = static_cast<Time>(1e12 / rate());
    const Time end = bits * bit;
    while (bus_.now() < end) {
      bus_.run_for(1 + static_cast<Time>(random_() % 40) * bit + random_() % bit);
      disturb(bit);
      look();
    }
    for (const auto &host : hosts_) host->check();
    return std::move(trail_);
  }
  [[nodiscard]] std::uint64_t edges_passed() const { return bus_.edges_passed(); }

 private:
  [[nodiscard]] double rate() const {
    return world_.megahertz * 1e6 / world_.timing.clocks_per_bit();
  }

  void add_core(unsigned i, const Link &link) {
    cores_.push_back(RtlNode::create(fmt::format("core{}", i), clock_of(world_, i), 16));
    bus_.add(*cores_.back(), link);
    HostConfig config{.timing = world_.timing, .triple_sampling = world_.triple_sampling};
    config.tx_buffers = 2;
    hosts_.push_back(std::make_unique<Host>(*cores_.back(), config));
    hosts_.back()->on_received = [this, i](const HostFrame &f) { note("received", i, f); };
    hosts_.back()->on_sent = [this, i](const HostFrame &f) { note("sent", i, f); };
    hosts_.back()->start();
  }
  void add_engine(unsigned i, const Link &link) {
    const CoreConfig config{.timing = world_.timing, .triple_sampling = world_.triple_sampling};
    engines_.push_back(
        std::make_unique<CoreNode>(fmt::format("engine{}", i), config, clock_of(world_, i)));
    bus_.add(*engines_.back(), link);
    engines_.back()->start();
  }

  void note(const char *what, unsigned i, const HostFrame &f) {
    trail_.push_back(
        fmt::format("{} {} {} {:X} {} {}", what, i, f.time, f.frame.id, f.stamp, f.mb));
  }

  // Software acts at once, or at a time of its own.
  void disturb(Time bit) {
    Host &host = *hosts_[random_() % hosts_.size()];
    CoreNode &engine = *engines_[random_() % engines_.size()];
    const Frame frame = random_frame(random_);
    switch (random_() % 8) {
      case 0: host.send(frame); break;
      case 1: engine.request(frame); break;
      case 2:
        bus_.at(bus_.now() + random_() % (20 * bit), [&host, frame] { host.send(frame); });
        break;
      case 3:
        bus_.at(bus_.now() + random_() % (20 * bit), [&engine, frame] { engine.request(frame); });
        break;
      case 4: host.node().ahb().submit({.address = reg::kTimer, .write = true, .data = 7}); break;
      case 5: engine.running() ? engine.stop() : engine.start(); break;
      case 6: bus_.step(); break;
      default: break;
    }
  }

  void look() {
    for (const auto &core : cores_) {
      trail_.push_back(fmt::format("core {} {} {:X} {:X}", core->cycles(),
                                   std::as_const(*core).oscillator().next(), core->trace(),
                                   core->irq_lines()));
      for (const std::uint32_t address : kRegisters)
        trail_.push_back(fmt::format("{:X}", core->peek({.address = address}).data));
    }
    for (const auto &engine : engines_)
      trail_.push_back(fmt::format("engine {:X} {} {}", engine->trace(), engine->received().size(),
                                   std::as_const(*engine).oscillator().cycles()));
  }

  const World &world_;
  std::mt19937 random_;
  Trail trail_;
  TrailRecorder recorder_{trail_};
  Spoiler spoiler_;
  std::vector<std::unique_ptr<RtlNode>> cores_;
  std::vector<std::unique_ptr<Host>> hosts_;
  std::vector<std::unique_ptr<CoreNode>> engines_;
  Bus bus_;
};

// Seven dominant bits now and then: an error for everybody.
class Jammer : public Node {
 public:
  Jammer() : Node{"jammer", {.frequency_hz = 500e3}} {}
  void clock(Level) override {
    drive(++bits_ % 97 < 7 && bits_ > 97 ? Level::kDominant : Level::kRecessive);
  }

 private:
  unsigned bits_ = 0;
};

// An engine that is driven to bus-off, looked at in every clock: its field follows a clock behind
// the count. Without an observer of bits, for whom a node is clocked until its bit is complete.
Trail engine_in_bus_off(bool rest) {
  constexpr Time kClock = 20 * kNanosecond;
  Trail trail;
  Jammer jammer;
  CoreNode sender{"sender",
                  {.timing = {.prescaler = 10, .prop = 3, .ps1 = 3, .ps2 = 3}},
                  {.frequency_hz = 50e6}};
  CoreNode other{"other",
                 {.timing = {.prescaler = 10, .prop = 3, .ps1 = 3, .ps2 = 3}},
                 {.frequency_hz = 50e6}};
  Bus bus;
  bus.let_rest(rest);
  for (Node *node :
       {static_cast<Node *>(&sender), static_cast<Node *>(&other), static_cast<Node *>(&jammer)})
    bus.add(*node);
  sender.preset_counters(255, 0);
  sender.start();
  other.start();
  sender.request({.id = 0x555, .dlc = 8});
  for (unsigned i = 0; i < 200'000; ++i) {
    bus.run_for(kClock);
    trail.push_back(fmt::format("{:X} {:X} {}", sender.trace(), other.trace(), sender.bus_off()));
    if (sender.idle()) sender.request({.id = 0x555, .dlc = 8});
  }
  return trail;
}

TEST(RestOfAnEngine, ChangesNothingInBusOff) {
  const Trail got = engine_in_bus_off(true), due = engine_in_bus_off(false);
  EXPECT_TRUE(std::any_of(due.begin(), due.end(),
                          [](const std::string &line) { return line.ends_with("true"); }));
  EXPECT_EQ(first_difference(got, due), "");
}

class RestTest : public ::testing::TestWithParam<World> {};

void expect_same(const World &world, bool watched) {
  constexpr unsigned kBits = 4'000;
  Stage resting{world, watched, true}, clocked{world, watched, false};
  const Trail got = resting.run(kBits), due = clocked.run(kBits);
  EXPECT_TRUE(kPlainEdges || resting.edges_passed() > kBits);
  EXPECT_EQ(clocked.edges_passed(), 0u);
  ASSERT_GT(due.size(), kBits);
  EXPECT_EQ(first_difference(got, due), "");
}

TEST_P(RestTest, ChangesNothing) { expect_same(GetParam(), true); }
// Nodes rest earlier than with an observer of bits.
TEST_P(RestTest, ChangesNothingUnwatched) { expect_same(GetParam(), false); }

INSTANTIATE_TEST_SUITE_P(Worlds, RestTest, ::testing::ValuesIn(kWorlds),
                         [](const auto &world) { return std::string{world.param.name}; });

}  // namespace
}  // namespace vericansim
