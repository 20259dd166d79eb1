// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Error state: callbacks on the way from active to bus-off, counters, error kinds, and the three
// ways back (flexcan.md 1.4, 2.8, 7).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bus/faults.hpp"
#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

constexpr Time kBit = kMicrosecond;  // at 1 Mbit/s
constexpr Time kRecovery = 128 * 11 * kBit;

// While on, one node hears a recessive bus whatever it is: its dominant bits are in error.
class Deaf : public Fault {
 public:
  explicit Deaf(NodeId node) : node_{node} {}
  [[nodiscard]] Level level(NodeId receiver, Time, Level level) override {
    return on && receiver == node_ ? Level::kRecessive : level;
  }
  bool on = false;

 private:
  NodeId node_;
};

class DriverState : public ::testing::Test {
 protected:
  DriverState() { bus_.bus.add(deaf_); }

  void up(verican_bus_off_policy_t policy = VERICAN_BUS_OFF_AUTOMATIC, std::uint32_t delay_ms = 0) {
    node_.config.bus_off = policy;
    node_.config.bus_off_delay_ms = delay_ms;
    for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(bus_[n].up(), VERICAN_OK);
    bus_.run(20 * kBit);
  }
  void send() {
    const verican_frame_t frame = driver_frame(0x123, 8, 0, 0x5555555500000000);
    ASSERT_EQ(verican_send(&node_.dev, &frame, nullptr), VERICAN_OK);
  }
  void go_bus_off() {
    deaf_.on = true;
    send();
    ASSERT_TRUE(bus_.run_until([&] { return node_.status().state == VERICAN_STATE_BUS_OFF; }));
    deaf_.on = false;
  }
  [[nodiscard]] bool sent() const { return !node_.events.empty(); }

  DriverBus bus_{3};  // the third takes part where it is started
  DriverNode &node_ = bus_[0];
  Deaf deaf_{0};
};

TEST_F(DriverState, AloneOnTheBusItTellsWarningThenPassiveAndStopsThere) {  // FC-05, FX-7.a
  node_.config.clock_hz = 8'000'000;
  ASSERT_EQ(node_.up(), VERICAN_OK);  // nobody acknowledges
  send();
  bus_.run(20 * kMillisecond);
  EXPECT_THAT(node_.states, ElementsAre(VERICAN_STATE_WARNING, VERICAN_STATE_PASSIVE));
  const verican_status_t status = node_.status();
  EXPECT_EQ(status.state, VERICAN_STATE_PASSIVE);
  EXPECT_EQ(status.tec, 128);
  EXPECT_EQ(status.rec, 0);
  EXPECT_EQ(status.last_errors, VERICAN_ERROR_ACK);
  EXPECT_EQ(status.stats.bus_offs, 0u);
  EXPECT_TRUE(status.synchronised);
  EXPECT_FALSE(sent());
}

// Passive: nobody listens to single errors, so the error interrupt rests (Zephyr issue 110654).
TEST_F(DriverState, NoFloodOfInterruptsWhenPassiveUnlessErrorsAreAskedFor) {
  ASSERT_EQ(node_.up(), VERICAN_OK);
  send();
  bus_.run(20 * kMillisecond);
  unsigned interrupts = 0;
  node_.interrupts = false;
  const Time end = bus_.bus.now() + 5 * kMillisecond;
  while (bus_.bus.now() < end) {
    bus_.run(kBit);
    if (node_.rtl().irq()) ++interrupts;
  }
  EXPECT_EQ(interrupts, 0u);
}

TEST_F(DriverState, EachErrorIsToldToWhoAsks) {
  static std::vector<unsigned> errors;
  errors.clear();
  node_.config.callbacks.on_error = [](void *, verican_t *, std::uint8_t kinds) {
    errors.push_back(kinds);
  };
  ASSERT_EQ(node_.up(), VERICAN_OK);
  bus_.run(20 * kBit);
  send();
  bus_.run(5 * kMillisecond);
  // Each attempt fails: 24 and more in 5 ms, long after the node is passive.
  EXPECT_GT(errors.size(), 24u);
  EXPECT_TRUE(std::all_of(errors.begin(), errors.end(),
                          [](unsigned kinds) { return kinds == VERICAN_ERROR_ACK; }));
  EXPECT_GE(node_.status().stats.error_events, errors.size());
}

struct Kind {
  const char *name;
  NodeId victim;
  PlaceSpec place;
  Effect effect;
  unsigned error;
};

class DriverErrorKinds : public DriverState, public ::testing::WithParamInterface<Kind> {};

TEST_P(DriverErrorKinds, IsReported) {  // ED-01, ED-08, ED-09
  const Kind &kind = GetParam();
  up();
  ASSERT_EQ(bus_[2].up(), VERICAN_OK);  // acknowledges what the victim does not
  bus_.run(20 * kBit);
  PlaceFault fault{kind.victim, kind.place, kind.effect};
  bus_.bus.add(fault);
  send();
  ASSERT_TRUE(bus_.run_until([&] { return sent(); }));
  bus_.run(50 * kBit);
  EXPECT_EQ(bus_[kind.victim].status().last_errors, kind.error);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, DriverErrorKinds,
    ::testing::Values(
        Kind{"Bit0",
             0,
             {.frame = 1, .field = Field::kId, .index = 0},
             Effect::kRecessive,
             VERICAN_ERROR_BIT0},
        Kind{"Bit1",
             0,
             {.frame = 1, .field = Field::kData, .index = 1},
             Effect::kDominant,
             VERICAN_ERROR_BIT1},
        Kind{"Ack", 0, {.frame = 1, .field = Field::kAck}, Effect::kRecessive, VERICAN_ERROR_ACK},
        Kind{"Stuff",
             1,
             {.frame = 1, .field = Field::kData, .stuff = true},
             Effect::kFlip,
             VERICAN_ERROR_STUFF},
        Kind{"Crc",
             1,
             {.frame = 1, .field = Field::kData, .index = 20},
             Effect::kFlip,
             VERICAN_ERROR_CRC},
        Kind{"Form",
             1,
             {.frame = 1, .field = Field::kCrcDel},
             Effect::kDominant,
             VERICAN_ERROR_FORM}),
    [](const auto &kind) { return kind.param.name; });

TEST_F(DriverState, ItSeesTheStateImproveWhenPolled) {
  ASSERT_EQ(node_.up(), VERICAN_OK);
  send();
  bus_.run(20 * kMillisecond);
  ASSERT_EQ(bus_[1].up(), VERICAN_OK);  // now somebody acknowledges
  ASSERT_TRUE(bus_.run_until([&] { return sent(); }));
  // TEC is 127: a warning still, and after 32 more frames none.
  for (unsigned k = 0; k < 40; ++k) {
    node_.events.clear();
    send();
    ASSERT_TRUE(bus_.run_until([&] { return sent(); }));
  }
  EXPECT_EQ(verican_poll(&node_.dev, 0), VERICAN_OK);
  EXPECT_EQ(node_.states.back(), VERICAN_STATE_ACTIVE);
  EXPECT_LT(node_.status().tec, 96);
  // And it sees the next time as well.
  verican_stop(&bus_[1].dev);
  node_.states.clear();
  send();
  bus_.run(20 * kMillisecond);
  EXPECT_THAT(node_.states, ElementsAre(VERICAN_STATE_WARNING, VERICAN_STATE_PASSIVE));
}

TEST_F(DriverState, EveryStepToBusOffIsTold) {  // FC-13, FX-7.d
  up();
  go_bus_off();
  EXPECT_THAT(node_.states,
              ElementsAre(VERICAN_STATE_WARNING, VERICAN_STATE_PASSIVE, VERICAN_STATE_BUS_OFF));
  EXPECT_EQ(node_.status().stats.bus_offs, 1u);
  EXPECT_NE(node_.status().last_errors & VERICAN_ERROR_BIT0, 0);
}

TEST_F(DriverState, AutomaticRecoveryNeedsNobody) {  // FX-2.8.b, FX-2.8.e
  up(VERICAN_BUS_OFF_AUTOMATIC);
  go_bus_off();
  EXPECT_FALSE(sent());
  bus_.run(kRecovery - 200 * kBit);
  EXPECT_FALSE(sent());
  // Afterwards the frame that waits goes out.
  ASSERT_TRUE(bus_.run_until([&] { return sent(); }, 400 * kBit));
  EXPECT_EQ(node_.events[0].outcome, VERICAN_TX_SENT);
  EXPECT_EQ(node_.states.back(), VERICAN_STATE_ACTIVE);
  EXPECT_EQ(node_.status().tec, 0);
  bus_.run(50 * kBit);
  EXPECT_EQ(bus_[1].received().size(), 1u);
}

TEST_F(DriverState, ManualRecoveryWaitsForTheCommandAndHoldsForOneBusOff) {  // BO-03, FX-2.8.c
  up(VERICAN_BUS_OFF_MANUAL);
  EXPECT_EQ(verican_recover(&node_.dev), VERICAN_ERR_STATE) << "not in bus-off";
  for (unsigned round = 1; round <= 2; ++round) {
    go_bus_off();
    for (std::uint32_t ms = 0; ms < 5; ++ms) {
      bus_.run(kMillisecond);
      EXPECT_EQ(verican_poll(&node_.dev, ms), VERICAN_OK);
      EXPECT_EQ(node_.status().state, VERICAN_STATE_BUS_OFF);
    }
    EXPECT_EQ(verican_recover(&node_.dev), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return sent(); }, kRecovery + 400 * kBit));
    EXPECT_EQ(node_.states.back(), VERICAN_STATE_ACTIVE);
    EXPECT_EQ(node_.status().stats.bus_offs, round);
    node_.events.clear();
  }
}

// The command is in force once only even if nobody polls in between: the errors themselves wake
// the driver.
TEST_F(DriverState, ASecondBusOffAfterARecoveryHoldsToo) {  // FX-2.8.d
  up(VERICAN_BUS_OFF_MANUAL);
  go_bus_off();
  EXPECT_EQ(verican_recover(&node_.dev), VERICAN_OK);
  deaf_.on = true;  // still broken
  bus_.run(2 * kRecovery);
  deaf_.on = false;
  bus_.run(2 * kRecovery);
  EXPECT_FALSE(sent());
  EXPECT_EQ(node_.status().state, VERICAN_STATE_BUS_OFF);
  EXPECT_EQ(node_.status().stats.bus_offs, 2u);
}

TEST_F(DriverState, DelayedRecoveryFollowsTheClockOfTheCaller) {  // BO-03
  up(VERICAN_BUS_OFF_DELAYED, 10);
  go_bus_off();
  const std::uint32_t start = 0xFFFFFFFC;  // the caller's clock wraps
  for (std::uint32_t ms = 0; ms < 10; ++ms) {
    EXPECT_EQ(verican_poll(&node_.dev, start + ms), VERICAN_OK);
    bus_.run(kMillisecond);
    EXPECT_EQ(node_.status().state, VERICAN_STATE_BUS_OFF) << ms;
  }
  EXPECT_EQ(verican_poll(&node_.dev, start + 10), VERICAN_OK);
  ASSERT_TRUE(bus_.run_until([&] { return sent(); }, kRecovery + 400 * kBit));
  EXPECT_EQ(node_.states.back(), VERICAN_STATE_ACTIVE);
  // The next time the delay starts anew.
  node_.events.clear();
  go_bus_off();
  EXPECT_EQ(verican_poll(&node_.dev, start + 1000), VERICAN_OK);
  bus_.run(2 * kRecovery);
  EXPECT_FALSE(sent());
  EXPECT_EQ(verican_poll(&node_.dev, start + 1010), VERICAN_OK);
  EXPECT_TRUE(bus_.run_until([&] { return sent(); }, kRecovery + 400 * kBit));
}

TEST_F(DriverState, ARecoveryThatNobodySawIsToldAsBoth) {
  up(VERICAN_BUS_OFF_AUTOMATIC);
  node_.interrupts = false;
  deaf_.on = true;
  send();
  bus_.run(3 * kMillisecond / 2);
  deaf_.on = false;
  bus_.run(4 * kRecovery);
  node_.interrupts = true;
  bus_.run(10 * kBit);
  EXPECT_THAT(node_.states, ElementsAre(VERICAN_STATE_BUS_OFF, VERICAN_STATE_ACTIVE));
  EXPECT_TRUE(sent());
}

TEST_F(DriverState, TheSelfTestIsOneInBusOffToo) {
  up(VERICAN_BUS_OFF_MANUAL);
  go_bus_off();
  ASSERT_EQ(verican_stop(&node_.dev), VERICAN_OK);
  EXPECT_EQ(verican_self_test(&node_.dev, nullptr), VERICAN_OK);
}

TEST_F(DriverState, StoppingInBusOffIsPossible) {  // FX-9.ERR009595, BO-03
  up(VERICAN_BUS_OFF_MANUAL);
  go_bus_off();
  EXPECT_EQ(verican_stop(&node_.dev), VERICAN_OK);
  EXPECT_EQ(node_.states.back(), VERICAN_STATE_STOPPED);
  ASSERT_EQ(node_.events.size(), 1u);
  EXPECT_EQ(node_.events[0].outcome, VERICAN_TX_ABORTED);
  // Neither a stop nor a start is a recovery.
  bus_.run(3 * kRecovery);
  ASSERT_EQ(verican_start(&node_.dev), VERICAN_OK);
  bus_.run(3 * kRecovery);
  EXPECT_EQ(node_.status().state, VERICAN_STATE_BUS_OFF);
  ASSERT_EQ(verican_recover(&node_.dev), VERICAN_OK);
  bus_.run(2 * kRecovery);
  EXPECT_EQ(node_.status().state, VERICAN_STATE_ACTIVE);
  go_bus_off();
  // Initialised anew it is well again.
  ASSERT_EQ(node_.up(), VERICAN_OK);
  bus_.run(20 * kBit);
  send();
  EXPECT_TRUE(bus_.run_until([&] { return node_.events.size() == 2; }));
  EXPECT_EQ(node_.events[1].outcome, VERICAN_TX_SENT);
}

}  // namespace
}  // namespace vericansim
