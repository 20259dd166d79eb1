// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes without a processor whose edges are put off (Bus::let_rest()), or passed over on an idle
// bus (Bus::skip()), are as if clocked every time: the same levels, bits, pulses, memories and
// times.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/bus_trail.hpp"
#include "node/host.hpp"
#include "node/model_edge.hpp"
#include "remote/random_host.hpp"
#include "remote/remote_entries.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = UnitBus::kBit;
constexpr unsigned kWords = 1024;

ClockConfig clock_of(unsigned node, bool own) {
  ClockConfig clock = UnitBus::clock();
  if (!own) return clock;
  clock.error_ppm = 300.0 * node - 600;
  clock.phase = 13'017 * node;
  return clock;
}

/// What user logic is told of each node.
void tell(Trail &trail, Bus &bus, RemoteNode &node) {
  const auto note = [&trail, &bus, name = node.name()](const std::string &what) {
    trail.push_back(fmt::format("{} {} {}", name, bus.now(), what));
  };
  node.on_pulse = [note](const RemotePulse &pulse) {
    note(fmt::format("{} {:X} {}", pulse.apply, pulse.address, pulse.length));
  };
  node.on_ms = [note] { note("ms"); };
  node.on_access = [note](const UserAccess &access) { note(fmt::format("word {}", access.word)); };
}

/// Where a node is, and some of its memory.
std::string state_of(const RemoteNode &node, unsigned first, unsigned words) {
  std::string text = fmt::format("{} {} {} {:X} {} {} {} {}", node.name(), node.cycles(),
                                 node.oscillator().next(), node.trace(), node.ready(), node.idle(),
                                 static_cast<int>(node.state()), node.peek(remote_map::kStatus));
  for (const std::uint32_t word : node.peek_words(first, words)) text += fmt::format(" {:X}", word);
  return text;
}

/// Drives dominant for one or two bits now and then: errors for the others.
class Spoiler : public Node {
 public:
  Spoiler() : Node{"spoiler", {.frequency_hz = 1e6}} {}
  void clock(Level) override {
    if (left_ > 0 && --left_ == 0) drive(Level::kRecessive);
    if (left_ == 0 && dice_.once_in(600)) {
      left_ = 1 + dice_.upto(2);
      drive(Level::kDominant);
    }
  }

 private:
  RandomHost dice_{5};
  unsigned left_ = 0;
};

struct World {
  const char *profile;
  bool own_clocks;
  bool watched;
  unsigned name_bits = 3;
};
void PrintTo(const World &world, std::ostream *out) { *out << world.profile; }

/// Two nodes, random commands for them, user logic and noise; always the same.
class Stage {
 public:
  Stage(const World &world, bool rest) : dice_{1, {0, 0, 1, 3, 3, 3, 4, 7}, world.name_bits} {
    bus_.let_rest(rest);
    bus_.add(host_);
    for (unsigned number = 3; number < 5; ++number) {
      RemoteConfig config = RemoteConfig::profile(world.profile);
      config.name_bits = world.name_bits;
      nodes_.push_back(rtl_unit(number, config, clock_of(number, world.own_clocks)));
      tell(trail_, bus_, *nodes_.back());
      bus_.add(*nodes_.back());
    }
    if (world.own_clocks) bus_.add(spoiler_);
    if (world.watched) bus_.add(recorder_);
    host_.start();
    for (const auto &node : nodes_) node->start();
  }

  Trail run(unsigned rounds) {
    for (unsigned i = 0; i < rounds; ++i) {
      bus_.run_for(1 + dice_.upto(200) * kBit + dice_.upto(kBit));
      disturb();
      for (const auto &node : nodes_)
        trail_.push_back(state_of(*node, dice_.upto(kWords - 4), dice_.upto(4)));
    }
    for (const auto &node : nodes_) trail_.push_back(state_of(*node, 0, kWords));
    return std::move(trail_);
  }
  [[nodiscard]] std::uint64_t edges_passed() const { return bus_.edges_passed(); }

 private:
  // User logic acts at once, or at a time of its own.
  void disturb() {
    RemoteNode &node = *nodes_[dice_.upto(2)];
    const UserAccess access{dice_.once_in(2), dice_.upto(16), dice_.upto(kWords), dice_.upto(~0U)};
    const unsigned event = dice_.upto(4);
    const Time later = bus_.now() + dice_.upto(20 * kBit);
    switch (dice_.upto(9)) {
      case 0: node.access(access); break;
      case 1: bus_.at(later, [&node, access] { node.access(access); }); break;
      case 2: node.hold(dice_.once_in(2)); break;
      case 3: node.event(event); break;
      case 4: bus_.at(later, [&node, event] { node.event(event); }); break;
      case 5: bus_.step(); break;
      case 6: break;
      default: host_.request(dice_.frame()); break;
    }
  }

  RandomHost dice_;
  Trail trail_;
  TrailRecorder recorder_{trail_};
  Spoiler spoiler_;
  CoreNode host_{"host", {.timing = UnitBus::timing()}, UnitBus::clock()};
  std::vector<std::unique_ptr<RemoteNode>> nodes_;
  Bus bus_;
};

class RtlRest : public ::testing::TestWithParam<World> {};

TEST_P(RtlRest, ChangesNothing) {
  constexpr unsigned kRounds = 500;
  Stage resting{GetParam(), true}, clocked{GetParam(), false};
  const Trail got = resting.run(kRounds), due = clocked.run(kRounds);
  EXPECT_TRUE(kPlainEdges || resting.edges_passed() > 30'000U);
  EXPECT_EQ(clocked.edges_passed(), 0U);
  ASSERT_GT(due.size(), 2 * kRounds);
  EXPECT_EQ(first_difference(got, due), "");
}

INSTANTIATE_TEST_SUITE_P(Profiles, RtlRest,
                         ::testing::Values(World{"small", false, true}, World{"small", true, false},
                                           World{"standard", true, true},
                                           World{"standard", false, false, 5},
                                           World{"full", true, true}, World{"full", false, false}));

// ---- Idle time

/// A core and two nodes that send by themselves each 30 and each 7 ms.
struct IdleBus {
  IdleBus() {
    bus.add(*core);
    for (unsigned number = 3; number < 5; ++number) {
      nodes.push_back(rtl_unit(number, RemoteConfig::profile("standard"), clock_of(number, true)));
      RemoteNode &node = *nodes.back();
      tell(trail, bus, node);
      bus.add(node);
      // A heartbeat: STATUS goes in SAFE, too (RN-63).
      produce(node, producer_bytes(0x7E, mode::kOn | mode::kCyclic | 8, number == 3 ? 30 : 7));
      node.start();
    }
    host.start_and_wait();
    bus.run_for(3 * kMillisecond);
  }

  void produce(RemoteNode &node, const std::vector<unsigned> &bytes) const {
    for (unsigned i = 0; i < bytes.size(); ++i)
      node.user_write((producer_at(0) + i) / 4, bytes[i] << 8 * (i % 4), 1U << i % 4);
  }

  /// Up to `until` or a little less.
  void skip(Time until) {
    constexpr Time kLook = 16 * kBit;
    while (bus.now() < until - kLook) {
      const Time before = bus.now();
      const bool idle = nodes[0]->idle() && nodes[1]->idle();
      if (idle && bus.skip(until - kLook))
        skipped += bus.now() - before;
      else
        bus.run_for(kLook);
    }
  }

  std::unique_ptr<RtlNode> core = RtlNode::create("core", UnitBus::clock(), 16);
  Host host{*core, {.timing = UnitBus::timing()}};
  std::vector<std::unique_ptr<RemoteNode>> nodes;
  Trail trail;
  Time skipped = 0;
  Bus bus;
};

// RN-63, RN-103: milliseconds, heartbeats and all that can be looked at come as if clocked.
TEST(RtlSkip, IsAsIfClocked) {
  IdleBus skips, clocked;
  for (unsigned i = 0; i < 20; ++i) {
    const Time until = skips.bus.now() + 20 * kMillisecond + i * 1'234'567;
    skips.skip(until);
    for (IdleBus *one : {&skips, &clocked}) {
      one->bus.run_until(until);
      ASSERT_TRUE(one->host.send_and_wait({.id = 0x1A0, .remote = true, .dlc = 4}, kMillisecond));
      one->bus.run_for(100 * kBit);
      for (const auto &node : one->nodes) one->trail.push_back(state_of(*node, 0x3F0, 16));
    }
    ASSERT_EQ(skips.bus.now(), clocked.bus.now());
  }
  EXPECT_EQ(first_difference(skips.trail, clocked.trail), "");
  ASSERT_EQ(skips.host.received().size(), clocked.host.received().size());
  EXPECT_GT(clocked.host.received().size(), 80U);
  for (std::size_t i = 0; i < clocked.host.received().size(); ++i)
    EXPECT_EQ(skips.host.received()[i].frame, clocked.host.received()[i].frame);
  EXPECT_TRUE(kPlainEdges || skips.skipped > skips.bus.now() / 2);
  const RemoteNode &node = *skips.nodes[0];
  EXPECT_TRUE(kPlainEdges || node.clocked() < node.cycles() / 2);
}

}  // namespace
}  // namespace vericansim
