// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole cores on a bus: software behind AHB-Lite on every node, drifting clocks, cable, saturated
// bus.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "model/registers.hpp"
#include "node/host.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {
namespace {

Frame frame(std::uint32_t id, std::uint8_t dlc = 8) {
  Frame f{.id = id, .extended = id > 0x7FF, .dlc = dlc};
  for (unsigned i = 0; i < f.payload_size(); ++i)
    f.data[i] = static_cast<std::uint8_t>(17 * i + id);
  return f;
}

// A bus with software on every node. Default bit: 10 clocks, so 8 MHz gives 800 kbit/s.
struct Net {
  Bus bus;
  std::vector<std::unique_ptr<RtlNode>> nodes;
  std::vector<std::unique_ptr<Host>> hosts;

  void add(const ClockConfig &clock, HostConfig host = {}, const Link &link = {},
           unsigned num_mb = 64) {
    if (host.timing == BitTiming{})
      host.timing = {.prescaler = 1, .prop = 4, .ps1 = 3, .ps2 = 2, .sjw = 2};
    nodes.push_back(RtlNode::create("n" + std::to_string(nodes.size()), clock, num_mb));
    bus.add(*nodes.back(), link);
    hosts.push_back(std::make_unique<Host>(*nodes.back(), host));
  }
  void start() {
    for (auto &host : hosts) host->start();
    ASSERT_TRUE(bus.run_until([this] { return all([](Host &h) { return h.ready(); }); },
                              100 * kMillisecond));
    for (auto &host : hosts) host->check();
    bus.run_for(50 *
                kMicrosecond);  // all have integrated: a slow clock needs longer for its 11 bits
  }
  template <typename F>
  bool all(F f) {
    for (auto &host : hosts) {
      if (!f(*host)) return false;
    }
    return true;
  }
  void expect_clean_ahb() {
    for (auto &node : nodes) {
      EXPECT_TRUE(node->ahb().checker().violations().empty())
          << node->ahb().checker().violations().front();
      EXPECT_LE(node->ahb().checker().max_waits(), 1u);
    }
  }
};

TEST(RtlNode, OneFrameByAhbFromNodeToNode) {
  Net net;
  net.add({});
  net.add({});
  net.start();
  ASSERT_TRUE(net.hosts[0]->send_and_wait(frame(0x123), 5 * kMillisecond));
  net.bus.run_for(100 * kMicrosecond);
  ASSERT_EQ(net.hosts[1]->received().size(), 1u);
  EXPECT_EQ(net.hosts[1]->received()[0].frame, frame(0x123));
  EXPECT_EQ(net.hosts[0]->sent().size(), 1u);
  net.expect_clean_ahb();
}

TEST(RtlNode, BlockingAccessWorksWithoutABus) {
  const auto node = RtlNode::create("alone", {}, 32);
  EXPECT_EQ(node->read32(reg::kMcr), 0xD890000Fu);  // flexcan.md 1: reset value
  node->write32(reg::kMcr, 0x5890000Fu);
  for (int i = 0; i < 1000 && (node->read32(reg::kMcr) & reg::kMcrLpmAck) != 0; ++i) {
  }
  EXPECT_EQ(node->read32(reg::kMcr), 0x5980000Fu);
  EXPECT_TRUE(node->ahb().checker().violations().empty());
}

TEST(RtlNode, ErrorResponseIsReportedAndTakesTwoCycles) {
  const auto node = RtlNode::create("alone");
  EXPECT_TRUE(node->access({.address = 0x2000}).error);
  EXPECT_TRUE(node->access({.address = 0x2, .size = AhbSize::kWord}).error);
  EXPECT_FALSE(node->access({.address = 0x0}).error);
  EXPECT_THROW(node->read32(0x2000), std::runtime_error);
  EXPECT_EQ(node->ahb().checker().errors(), 3u);
  EXPECT_TRUE(node->ahb().checker().violations().empty());
}

TEST(RtlNode, OtherSizesOfBuffersExistAndBadOnesAreRefused) {
  for (const unsigned size : {16u, 32u, 64u}) {
    EXPECT_EQ(RtlNode::create("n", {}, size)->read32(0x1008) & 0xFF, size);
  }
  EXPECT_THROW(RtlNode::create("n", {}, 20), std::invalid_argument);
}

struct Traffic {
  const char *name;
  std::vector<double> ppm;
  Time cable;
};

class DriftingBus : public ::testing::TestWithParam<Traffic> {};

// Every node has frames waiting all the time; every frame must reach every other node, in order of
// each sender. 10 tq, SJW 2, PS2 2: BT-08 allows +-0.78 %.
TEST_P(DriftingBus, SaturatedTrafficArrivesEverywhere) {
  const Traffic &traffic = GetParam();
  Net net;
  for (std::size_t i = 0; i < traffic.ppm.size(); ++i) {
    net.add({.error_ppm = traffic.ppm[i], .phase = static_cast<Time>(7919 * i)}, {},
            {.cable = traffic.cable});
  }
  net.start();
  constexpr unsigned kEach = 40;
  const unsigned n = static_cast<unsigned>(net.hosts.size());
  for (unsigned k = 0; k < kEach; ++k) {
    for (unsigned i = 0; i < n; ++i) net.hosts[i]->send(frame((i + 1) * 0x100 + k, k % 9));
  }
  const auto complete = [&] {
    return net.all(
        [&](Host &h) { return h.received().size() == kEach * (n - 1) && h.pending() == 0; });
  };
  EXPECT_TRUE(net.bus.run_until(complete, kSecond / 4));
  for (unsigned i = 0; i < n; ++i) {
    net.hosts[i]->check();
    EXPECT_EQ(net.hosts[i]->stats().overruns, 0u);
    EXPECT_EQ(net.hosts[i]->stats().error_interrupts, 0u);
    std::vector<unsigned> next(n, 0);
    for (const HostFrame &got : net.hosts[i]->received()) {
      const unsigned sender = got.frame.id / 0x100 - 1;
      ASSERT_LT(sender, n);
      const unsigned k = next[sender]++;
      ASSERT_EQ(got.frame, frame((sender + 1) * 0x100 + k, k % 9));
    }
  }
  net.expect_clean_ahb();
}

INSTANTIATE_TEST_SUITE_P(
    Clocks, DriftingBus,
    ::testing::Values(Traffic{"OneClock", {0, 0, 0}, 0}, Traffic{"Drift", {3000, -3000, 0}, 0},
                      Traffic{"DriftAndCable", {1500, -1500, 700, 0}, 50 * kNanosecond},
                      Traffic{"Cable", {0, 0}, 60 * kNanosecond}),
    [](const auto &each) { return each.param.name; });

// CTRL1.RJW reaches the engine: clocks 1.4 % apart, 16 tq, edges eight bits apart. BT-08 allows
// +-1.2 % with SJW 4, and +-0.3 % with SJW 1.
TEST(RtlNode, JumpWidthOfTheRegisterFollowsTheDrift) {  // BT-08, SY-06, SY-07, FX-CTRL1.RJW
  for (const unsigned sjw : {4U, 1U}) {
    Net net;
    HostConfig host;
    host.timing = {.prescaler = 1, .prop = 5, .ps1 = 5, .ps2 = 5, .sjw = sjw};
    net.add({.frequency_hz = 16e6, .error_ppm = 7000}, host);
    net.add({.frequency_hz = 16e6, .error_ppm = -7000}, host);
    net.start();
    Frame slow{.id = 0x0F0, .dlc = 8};
    slow.data.fill(0x0F);
    const bool sent = net.hosts[0]->send_and_wait(slow, 2 * kMillisecond);
    for (auto &each : net.hosts) each->check();
    EXPECT_EQ(sent && net.hosts[0]->stats().error_interrupts == 0, sjw == 4);
  }
}

TEST(RtlNode, DisturbedFrameIsRepeated) {
  Net net;
  net.add({});
  net.add({});
  PlaceFault fault{1, {.frame = 1, .field = Field::kData, .index = 5}, Effect::kFlip};
  net.bus.add(fault);
  net.start();
  ASSERT_TRUE(net.hosts[0]->send_and_wait(frame(0x2AA), 5 * kMillisecond));
  net.bus.run_for(100 * kMicrosecond);
  EXPECT_EQ(fault.hits(), 1u);
  ASSERT_EQ(net.hosts[1]->received().size(), 1u);
  EXPECT_EQ(net.hosts[1]->received()[0].frame, frame(0x2AA));
  EXPECT_GE(net.hosts[0]->stats().error_interrupts, 1u);
}

TEST(RtlNode, FiltersChooseTheBuffer) {
  Net net;
  net.add({});
  HostConfig config;
  config.filters = {{.id = 0x100, .mask = 0x7FF}, {.id = 0x200, .mask = 0x700}};
  net.add({}, config, {}, 16);
  net.start();
  for (const std::uint32_t id : {0x100u, 0x2FFu, 0x101u, 0x201u}) net.hosts[0]->send(frame(id));
  ASSERT_TRUE(net.bus.run_until([&] { return net.hosts[0]->pending() == 0; }, 10 * kMillisecond));
  net.bus.run_for(100 * kMicrosecond);
  const auto &got = net.hosts[1]->received();
  ASSERT_EQ(got.size(), 3u);
  EXPECT_EQ(got[0].mb, 0u);
  EXPECT_EQ(got[1].mb, 1u);
  EXPECT_EQ(got[2].frame.id, 0x201u);
}

}  // namespace
}  // namespace vericansim
