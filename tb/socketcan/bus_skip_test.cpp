// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Idle time at no cost: Bus::skip() and Clock::skip().
#include <gtest/gtest.h>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "model/registers.hpp"
#include "node/host.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = 1 * kMicrosecond;  // 8 clocks of 8 MHz
constexpr Frame kFrame{.id = 0x123, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};

// Skipping is the same as ticking.
TEST(ClockSkip, PassesTheSameEdges) {
  for (const double ppm : {0.0, 37.5, -120.0}) {
    Clock ticked{{.frequency_hz = 7.3e6, .error_ppm = ppm, .phase = 55}};
    Clock skipped = ticked;
    for (const Time until : {Time{54}, Time{55}, Time{56}, Time{1'000'000}, 3 * kMillisecond}) {
      while (ticked.next() <= until) ticked.tick();
      skipped.skip(until);
      EXPECT_EQ(skipped.next(), ticked.next());
      EXPECT_EQ(skipped.cycles(), ticked.cycles());
      EXPECT_TRUE(skipped.in_step_with(ticked));
    }
  }
}

/// Two nodes, one a little faster, that have come on the bus.
struct TwoNodes {
  TwoNodes() {
    bus.add(*a);
    bus.add(*b);
    sender.start_and_wait();
    receiver.start_and_wait();
    bus.run_for(20 * kBit);
  }
  /// Up to `until` or a little less. A pass over the buffers after a frame is no idle time.
  void skip(Time until) {
    constexpr Time kLook = 2 * kBit;
    while (bus.now() < until - kLook)
      if (!bus.skip(until - kLook)) bus.run_for(kLook);
  }
  std::unique_ptr<RtlNode> a = RtlNode::create("a");
  std::unique_ptr<RtlNode> b = RtlNode::create("b", {.error_ppm = 200});
  Bus bus;
  Host sender{*a, {}};
  Host receiver{*b, {}};
};

class BusSkip : public ::testing::Test, protected TwoNodes {};

TEST_F(BusSkip, FramesPassAsBefore) {
  for (unsigned i = 0; i < 20; ++i) {
    const Time until = bus.now() + kSecond + 77 * i * kNanosecond;
    const std::uint64_t clocked = a->clocked();
    skip(until);
    EXPECT_LE(bus.now(), until);
    EXPECT_LT(a->clocked() - clocked, 8U * 100);  // 100 bits of a second
    EXPECT_GT(a->oscillator().next(), bus.now());
    ASSERT_TRUE(sender.send_and_wait(kFrame, 2 * kMillisecond));
    bus.run_for(20 * kBit);
  }
  ASSERT_EQ(receiver.received().size(), 20U);
  for (const HostFrame &frame : receiver.received()) EXPECT_EQ(frame.frame, kFrame);
  EXPECT_EQ(sender.stats().error_interrupts, 0U);
}

// A core is where it would have been, its TIMER and its place in the bit included.
TEST_F(BusSkip, IsAsIfClocked) {
  TwoNodes other;
  const auto compare = [](RtlNode &skipped, RtlNode &clocked) {
    EXPECT_EQ(skipped.cycles(), clocked.cycles());
    EXPECT_EQ(skipped.oscillator().next(), clocked.oscillator().next());
    EXPECT_EQ(skipped.trace(), clocked.trace());
    EXPECT_EQ(skipped.read32(reg::kTimer), clocked.read32(reg::kTimer));
  };
  for (unsigned i = 0; i < 12; ++i) {
    const Time until = bus.now() + 20 * kMillisecond + i * 1'234'567;
    skip(until);
    for (TwoNodes *one : {static_cast<TwoNodes *>(this), &other}) {
      one->bus.run_until(until);
      ASSERT_TRUE(one->sender.send_and_wait(kFrame, 2 * kMillisecond));
      one->bus.run_for(20 * kBit);
    }
    ASSERT_EQ(bus.now(), other.bus.now());
    compare(*a, *other.a);
    compare(*b, *other.b);
  }
  EXPECT_LT(a->clocked(), other.a->clocked() / 4);
}

// Not while a frame is under way, nor in the intermission.
TEST_F(BusSkip, RefusesOnABusyBus) {
  sender.send(kFrame);
  unsigned refused = 0;
  bus.run_for(10 * kBit);
  while (!bus.skip(bus.now() + kSecond)) {
    ++refused;
    bus.run_for(kBit);
  }
  // FF-11: 108 bits and stuff bits, 3 of intermission; 10 have passed.
  EXPECT_GT(refused, 98U);
  EXPECT_LT(refused, 150U);
}

TEST_F(BusSkip, StopsBeforeAnAction) {
  const Time due = bus.now() + kMillisecond;
  Time ran = 0;
  bus.at(due, [&] { ran = bus.now(); });
  EXPECT_TRUE(bus.has_actions());
  EXPECT_TRUE(bus.skip(due + kSecond));
  EXPECT_LT(bus.now(), due);
  bus.run_until(due);
  EXPECT_EQ(ran, due);
  EXPECT_FALSE(bus.has_actions());
}

// A fault may come with the time.
TEST_F(BusSkip, RefusesWithFaults) {
  LevelFault fault{0, Effect::kDominant, {.from = bus.now() + kSecond}};
  bus.add(fault);
  EXPECT_FALSE(bus.skip(bus.now() + kMillisecond));
}

TEST_F(BusSkip, NeverGoesBack) { EXPECT_FALSE(bus.skip(bus.now())); }

}  // namespace
}  // namespace vericansim
