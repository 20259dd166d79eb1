// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge between programs and the bus: what comes where, in which order, and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bridge/frame_form.hpp"
#include "socketcan/bridge_rig.hpp"
#include "trace/input_error.hpp"

namespace vericansim::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Frame kFrame{.id = 0x123, .dlc = 2, .data = {0xCA, 0xFE}};

/// A scenario's message of node 0, each `period`.
// ---- Frames

// The programs at two interfaces send to each other as fast as the bus allows: all frames arrive,
// in order, as they were, raw DLC and remote frames included; a monitor sees all of them.
TEST(BridgeEngine, TenThousandFramesEachWay) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .monitor = true}};
  constexpr unsigned kFrames = 10'000;
  std::vector<Frame> sent[2];
  for (unsigned i = 0; i < 2 * kFrames; ++i) {
    sent[i % 2].push_back(numbered_frame(i));
    rig.port(i % 2).send(sent[i % 2].back());
  }
  EXPECT_TRUE(rig.run_until(
      [&] {
        return rig.port(0).frames().size() >= kFrames && rig.port(1).frames().size() >= kFrames;
      },
      100 * kSecond));
  EXPECT_TRUE(rig.port(0).frames() == sent[1]);
  EXPECT_TRUE(rig.port(1).frames() == sent[0]);
  // They met in arbitration, which is no error.
  EXPECT_GT(rig.port(0).errors(CAN_ERR_LOSTARB).size(), 10U);
  EXPECT_THAT(rig.port(0).errors(CAN_ERR_PROT), IsEmpty());
  const BridgeReport report = rig.bridge().finish();
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.ports[0].counts.sent, kFrames);
  EXPECT_EQ(report.ports[1].counts.received, kFrames);
  EXPECT_EQ(report.ports[0].pending, 0U);

  // The monitor has the two sequences in one: what is not the next of one is the next of the other.
  std::size_t next[2] = {0, 0};
  for (const Frame &frame : rig.monitor().frames()) {
    const unsigned sender = frame.id & 1;
    ASSERT_LT(next[sender], kFrames);
    EXPECT_EQ(frame, sent[sender][next[sender]++]);
  }
  EXPECT_EQ(next[0] + next[1], 2 * kFrames);
}

// Messages for the programs have simulated times that never go back, errors and frames alike; the
// monitor's times are the ends of the frames.
TEST(BridgeEngine, TimesAreThoseOfTheBus) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .monitor = true}};
  for (unsigned i = 0; i < 200; ++i) rig.port(i % 2).send(numbered_frame(i));
  ASSERT_TRUE(rig.run_until([&] { return rig.monitor().got.size() >= 200; }));
  for (FakePort *port : {&rig.port(0), &rig.port(1)})
    for (std::size_t i = 1; i < port->got.size(); ++i)
      EXPECT_GE(port->got[i].time, port->got[i - 1].time);
  std::vector<Time> ends;
  for (const PortMessage &message : rig.monitor().got) ends.push_back(message.time);
  constexpr Time kBit = 2 * kMicrosecond;
  for (const PortMessage &message : rig.port(0).got) {
    if ((message.frame.can_id & CAN_ERR_FLAG) != 0) continue;
    const auto nearest = std::lower_bound(ends.begin(), ends.end(), message.time - kBit / 2);
    ASSERT_NE(nearest, ends.end());
    EXPECT_NEAR(static_cast<double>(*nearest), static_cast<double>(message.time), kBit / 2);
  }
}

// The bus may come to rest in any bit of what a fast bridge simulates at once. Before the bridge
// waits for programs without a limit, the monitor has every frame: nothing else would wake it.
TEST(BridgeEngine, NothingIsKeptFromTheMonitorWhileItWaits) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .monitor = true}};
  std::size_t sent = 0;
  for (unsigned burst = 0; burst < 200; ++burst) {
    for (unsigned i = 0; i <= burst % 13; ++i, ++sent) rig.port(0).send(numbered_frame(2 * sent));
    const unsigned before = rig.wall.endless_waits;
    rig.bridge().round();  // at rest; it takes them
    std::size_t seen = 0;
    while (rig.wall.endless_waits <= before + 1) {
      seen = rig.monitor().got.size();
      rig.bridge().round();
    }
    ASSERT_EQ(seen, sent) << "burst " << burst;
  }
}

// AK-03: with nobody else on the bus no frame is acknowledged; it stays with the node and is
// neither sent nor lost.
TEST(BridgeEngine, AloneNobodyAcknowledges) {
  BridgeRig rig{{.ports = 1, .nodes = 0, .monitor = true}};
  rig.port(0).echo = true;
  for (unsigned i = 0; i < 40; ++i) rig.port(0).send(kFrame);
  rig.run_for(20 * kMillisecond);
  EXPECT_THAT(rig.port(0).echoes(), IsEmpty());
  EXPECT_THAT(rig.monitor().frames(), IsEmpty());
  EXPECT_GT(rig.port(0).errors(CAN_ERR_ACK).size(), 16U);
  const BridgeReport report = rig.bridge().finish();
  EXPECT_EQ(report.ports[0].counts.sent, 0U);
  EXPECT_EQ(report.ports[0].pending, 40U);
  EXPECT_EQ(report.ports[0].counts.from_host, 40U);
}

// What a program sends that is no frame of CAN 2.0 is refused and counted; what follows is sent.
TEST(BridgeEngine, RefusesWhatIsNoFrame) {
  BridgeRig rig{{.ports = 2, .nodes = 0}};
  PortMessage bad;
  bad.frame.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  bad.frame.len = 8;
  rig.port(0).outgoing.push_back(bad);
  bad.frame.can_id = 0x123;
  bad.frame.len = 9;
  rig.port(0).outgoing.push_back(bad);
  rig.port(0).send(kFrame);
  EXPECT_TRUE(rig.run_until([&] { return !rig.port(1).got.empty(); }));
  EXPECT_THAT(rig.port(1).frames(), ElementsAre(kFrame));
  EXPECT_EQ(rig.bridge().finish().ports[0].counts.rejected, 2U);
}

// A monitor still sees all of them.
TEST(BridgeEngine, FiltersKeepFramesFromThePrograms) {
  PortOptions options;
  options.filters = {{.id = 0x100, .mask = 0x7F0}, {.id = 0x12345678 | CAN_EFF_FLAG, .mask = ~0U}};
  BridgeRig rig{{.ports = 2, .nodes = 0, .monitor = true, .options = options}};
  const Frame in_range{.id = 0x10F, .dlc = 1};
  const Frame extended{.id = 0x12345678, .extended = true};
  const Frame other{.id = 0x678};
  for (const Frame &frame : {kFrame, in_range, other, extended}) rig.port(0).send(frame);
  EXPECT_TRUE(rig.run_until([&] { return rig.port(0).outgoing.empty(); }));
  rig.run_for(2 * kMillisecond);
  EXPECT_THAT(rig.port(1).frames(), ElementsAre(in_range, extended));
  EXPECT_THAT(rig.monitor().frames(), ElementsAre(kFrame, in_range, other, extended));
  EXPECT_EQ(rig.bridge().finish().ports[1].counts.filtered, 2U);
}

// ---- Echo

// A program hears of its own frame when it has left, in the order of the bus, and who it was from.
TEST(BridgeEngine, EchoComesWhenTheFrameHasLeft) {
  BridgeRig rig{{.ports = 2, .nodes = 0, .monitor = true}};
  rig.port(0).echo = true;
  constexpr std::uint64_t kClient = 77;
  for (unsigned i = 0; i < 20; ++i) {
    rig.port(0).send(numbered_frame(2 * i), kClient + i);
    rig.port(1).send(numbered_frame(2 * i + 1));
  }
  EXPECT_TRUE(rig.run_until([&] { return rig.monitor().got.size() == 40; }));
  rig.run_for(kMillisecond);
  // On port 0: its own ones as echoes among the others, all in the monitor's order and time.
  std::vector<Frame> seen;
  std::uint64_t client = kClient;
  std::size_t index = 0;
  for (const PortMessage &message : rig.port(0).got) {
    const auto frame = from_can_frame(message.frame);
    if (!frame) continue;
    EXPECT_EQ(message.echo, (frame->id & 1) == 0);
    if (message.echo) {
      EXPECT_EQ(message.client, client++);
    }
    EXPECT_NEAR(static_cast<double>(message.time),
                static_cast<double>(rig.monitor().got[index++].time), 1e6);
    seen.push_back(*frame);
  }
  EXPECT_TRUE(seen == rig.monitor().frames());
  EXPECT_THAT(rig.port(1).echoes(), IsEmpty());
}

// ---- Back-pressure

// A node holds a few frames; the rest stays in the port until there is room.
TEST(BridgeEngine, TakesOnlyWhatItHasRoomFor) {
  BridgeRig rig{{.ports = 2, .nodes = 0}};
  constexpr std::size_t kFrames = 300;
  for (unsigned i = 0; i < kFrames; ++i) rig.port(0).send(numbered_frame(2 * i));
  std::size_t most = 0;
  EXPECT_TRUE(rig.run_until([&] {
    const std::size_t taken = kFrames - rig.port(0).outgoing.size();
    most = std::max(most, taken - rig.port(1).frames().size());
    return rig.port(1).frames().size() == kFrames;
  }));
  EXPECT_LE(most, PortNode::kRoom);
}

// While programs do not take what the bus has for them, simulated time stands still; afterwards
// they get everything in order.
TEST(BridgeEngine, WaitsForProgramsThatHaveNoRoom) {
  BridgeRig rig{{.ports = 2, .nodes = 0}};
  constexpr std::size_t kFrames = 6'000;
  std::vector<Frame> sent;
  for (unsigned i = 0; i < kFrames; ++i) {
    sent.push_back({.id = i & 0x7FF, .dlc = 0});
    rig.port(0).send(sent.back());
  }
  rig.port(1).room = 100;
  for (unsigned rounds = 0; rounds < 5'000; ++rounds) rig.bridge().round();
  EXPECT_EQ(rig.port(1).got.size(), 100U);
  EXPECT_GT(rig.port(1).refusals, 0U);
  const Time still = rig.bridge().elapsed();
  for (unsigned rounds = 0; rounds < 100; ++rounds) rig.bridge().round();
  EXPECT_EQ(rig.bridge().elapsed(), still);
  EXPECT_GT(rig.port(0).outgoing.size(), 0U);  // and so the sender waits too
  rig.port(1).room = ~std::size_t{0};
  EXPECT_TRUE(rig.run_until([&] { return rig.port(1).got.size() == kFrames; }));
  EXPECT_TRUE(rig.port(1).frames() == sent);
}

// What the operating system has dropped makes the run a failure.
TEST(BridgeEngine, LossIsReported) {
  BridgeRig rig{{}};
  EXPECT_TRUE(rig.bridge().finish().ok());
  BridgeRig other{{}};
  other.port(0).lost_frames = 3;
  const BridgeReport report = other.bridge().finish();
  EXPECT_FALSE(report.ok());
  EXPECT_THAT(to_text(report),
              HasSubstr("LOST by the kernel before the bridge could read them: 3"));
  EXPECT_EQ(to_json(report)["ports"][0]["lost"], 3);
}

// ---- Interfaces that go and come

TEST(BridgeEngine, InterfaceGoesDownAndComesBack) {
  BridgeRig rig{{.ports = 2, .nodes = 1}};
  rig.port(1).is_up = false;
  rig.bridge().round();
  rig.bridge().round();
  EXPECT_THAT(rig.said, ElementsAre(HasSubstr("can1 is down or gone")));
  rig.port(0).send(kFrame);
  rig.run_for(2 * kMillisecond);
  EXPECT_THAT(rig.port(1).got, IsEmpty());
  rig.port(1).is_up = true;
  rig.bridge().round();
  EXPECT_THAT(rig.said, ElementsAre(HasSubstr("can1 is down or gone"), HasSubstr("can1 is back")));
  rig.port(0).send({.id = 0x124});
  EXPECT_TRUE(rig.run_until([&] { return !rig.port(1).got.empty(); }));
  EXPECT_THAT(rig.port(1).frames(), ElementsAre(Frame{.id = 0x124}));
  const BridgeReport report = rig.bridge().finish();
  EXPECT_EQ(report.ports[1].counts.away, 1U);
  EXPECT_EQ(report.ports[1].counts.received, 2U);
}

TEST(BridgeEngine, EndsWithTheInterfaceIfAskedTo) {
  BridgeRig rig{{.end_when_down = true}};
  EXPECT_TRUE(rig.bridge().round());
  rig.port(0).is_up = false;
  EXPECT_FALSE(rig.bridge().round());
}

// ---- The scenario's part

// A node of the scenario that has the interface's name is the interface's node; what it is to do by
// the scenario contradicts that.
TEST(BridgeEngine, NodeOfTheScenarioTakesTheInterface) {
  BridgeSetup setup;
  NodeSpec node;
  node.name = "can0";
  setup.scenario.file = "bus.yaml";
  setup.scenario.nodes = {node};
  setup.ports.push_back(std::make_unique<FakePort>("can0"));
  setup.scenario.traffic = {beat(kMillisecond)};
  FakeWall wall;
  try {
    Bridge bridge{std::move(setup), wall};
    FAIL() << "no complaint";
  } catch (const InputError &error) {
    EXPECT_THAT(error.what(), HasSubstr("bus.yaml: traffic 'beat' is that of node 'can0'"));
  }
}

TEST(BridgeEngine, RunsForTheTimeAsked) {
  BridgeRig rig{{.traffic = {beat(kMillisecond)}, .limit = 50 * kMillisecond}};
  while (rig.bridge().round()) {
  }
  EXPECT_EQ(rig.bridge().elapsed(), 50 * kMillisecond);
  // Messages at 0, 1, ... 49 ms.
  EXPECT_THAT(rig.port(0).frames(), SizeIs(50));
}

// Frames that still wait have the scenario's drain, once.
TEST(BridgeEngine, SaturatedBusGoesOnForTheDrain) {
  const Time limit = 10 * kMillisecond;
  const Time end_of_drain = limit + Scenario{}.drain;
  constexpr Time kLastFrame = 130 * 2 * kMicrosecond;  // that is under way, and its reception
  TrafficSpec flood = beat(kMillisecond);
  flood.saturated = true;
  BridgeRig rig{{.traffic = {flood}, .limit = limit}};
  while (rig.bridge().round()) {
  }
  const Time end = rig.bridge().finish().bus.duration;
  EXPECT_GE(end, end_of_drain);
  EXPECT_LE(end, end_of_drain + kLastFrame);
}

// Wherever in a frame the end falls: what the bus has seen the programs get. A frame is over some
// bits before the CPU has read it.
TEST(BridgeEngine, NothingIsLostAtTheEnd) {
  TrafficSpec flood = beat(kMillisecond);
  flood.saturated = true;
  for (Time bit = 0; bit < 60; ++bit) {  // one frame
    BridgeRig rig{{.traffic = {flood}, .limit = 3 * kMillisecond + bit * 2 * kMicrosecond}};
    while (rig.bridge().round()) {
    }
    const BridgeReport report = rig.bridge().finish();
    ASSERT_GT(report.bus.frames, 10u);
    EXPECT_EQ(rig.port(0).frames().size(), report.bus.frames) << bit;
  }
}

}  // namespace
}  // namespace vericansim::test
