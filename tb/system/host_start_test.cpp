// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A Host that is started late, twice, or anew behind a reset of its node.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "bus/bus.hpp"
#include "node/host.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {
namespace {

constexpr Frame kFrame{.id = 0x123, .dlc = 2, .data = {0xCA, 0xFE}};
constexpr Time kLongest = std::numeric_limits<Time>::max();

// 16 clocks a bit of 2 us.
HostConfig config() {
  HostConfig config;
  config.timing = {.prescaler = 1, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 2};
  return config;
}

/// The host in question, and one that hears it.
struct Pair {
  std::unique_ptr<RtlNode> node = RtlNode::create("node"), other = RtlNode::create("other");
  Bus bus;
  Host host{*node, config()}, listener{*other, config()};

  Pair() {
    bus.add(*node);
    bus.add(*other);
    listener.start_and_wait();
  }
  /// Once all are on the bus one frame is exchanged each way.
  void expect_exchange() {
    bus.run_for(40 * kMicrosecond);
    listener.received().clear();
    EXPECT_TRUE(host.send_and_wait(kFrame, 10 * kMillisecond));
    EXPECT_TRUE(listener.send_and_wait(kFrame, 10 * kMillisecond));
    bus.run_for(10 * kMicrosecond);
    ASSERT_EQ(listener.received().size(), 1U);
    EXPECT_EQ(listener.received().front().frame, kFrame);
    ASSERT_FALSE(host.received().empty());
    EXPECT_EQ(host.received().back().frame, kFrame);
    host.check();
  }
};

TEST(HostStart, BeforeItThereIsNothingToCheckAndNothingIsSent) {
  Pair pair;
  EXPECT_NO_THROW(pair.host.check());
  EXPECT_THROW(static_cast<void>(pair.host.send_and_wait(kFrame)), std::logic_error);
  EXPECT_EQ(pair.host.pending(), 0U);
}

// Whatever the software was waiting for: an access, the interrupt, nothing yet.
TEST(HostStart, ASecondOneBeginsAnew) {
  for (const unsigned steps : {0U, 1U, 7U, 300U, 2000U}) {
    SCOPED_TRACE(steps);
    Pair pair;
    pair.host.start();
    for (unsigned i = 0; i < steps; ++i) pair.bus.step();
    pair.host.start_and_wait();
    pair.expect_exchange();
  }
}

// What was queued, and what lay in a buffer or was on the bus, leaves behind the reset.
TEST(HostStart, BehindAResetFramesThatHaveNotLeftAreSent) {
  for (const unsigned steps : {0U, 3U, 100U, 700U}) {
    SCOPED_TRACE(steps);
    Pair pair;
    pair.host.start_and_wait();
    pair.bus.run_for(40 * kMicrosecond);
    pair.host.send(kFrame);
    for (unsigned i = 0; i < steps; ++i) pair.bus.step();
    pair.node->reset();
    pair.host.send({.id = 0x124});
    pair.host.start_and_wait();
    EXPECT_EQ(pair.host.pending(), 2U);
    pair.bus.run_for(10 * kMillisecond);
    EXPECT_EQ(pair.host.pending(), 0U);
    const auto &heard = pair.listener.received();
    ASSERT_EQ(heard.size(), 2U);
    EXPECT_EQ(heard[0].frame, kFrame);
    EXPECT_EQ(heard[1].frame.id, 0x124U);
    pair.expect_exchange();
  }
}

TEST(HostStart, ALimitMayBeAsLongAsTimeIs) {
  Pair pair;
  pair.host.start_and_wait();
  pair.bus.run_for(40 * kMicrosecond);
  EXPECT_TRUE(pair.host.send_and_wait(kFrame, kLongest));
}

}  // namespace
}  // namespace vericansim
