// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Taking frames back, at every moment of a frame: what the driver tells is what was on the bus
// (flexcan.md 3.4).
#include <gtest/gtest.h>

#include <string>

#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;  // at 1 Mbit/s
constexpr Time kClock = 125 * kNanosecond;

class DriverAbort : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    bus_[0].config.abort = GetParam();
    for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(bus_[n].up(), VERICAN_OK);
    bus_.run(20 * kBit);
  }
  [[nodiscard]] bool certain() const { return GetParam(); }
  // How many frames have arrived with this identifier.
  unsigned arrived(std::uint32_t id) {
    unsigned count = 0;
    for (const verican_frame_t &frame : bus_[1].received()) count += frame.id == id ? 1 : 0;
    return count;
  }
  // Fills the transmit mailboxes of node 0 with frames from this identifier on.
  void send_eight(std::uint32_t first) {
    bus_[0].events.clear();
    for (std::uint32_t id = first; id < first + 8; ++id) {
      const verican_frame_t frame = driver_frame(id, 1);
      ASSERT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK) << id;
    }
  }

  DriverBus bus_{2};
};

// FX-3.4.a, FX-3.4.c, FX-3.4.f
TEST_P(DriverAbort, AtEveryMomentOfAFrameTheReportIsTrue) {
  unsigned sent = 0, taken_back = 0;
  for (unsigned clock = 0; clock < 8 * 80; clock += clock < 64 || clock > 8 * 65 ? 1 : 5) {
    const verican_frame_t frame = driver_frame(0x2AA, 1);
    std::uint8_t mailbox = 0;
    bus_[0].events.clear();
    ASSERT_EQ(verican_send(&bus_[0].dev, &frame, &mailbox), VERICAN_OK);
    bus_.run(clock * kClock);
    const verican_result_t result = verican_abort(&bus_[0].dev, mailbox);
    if (result == VERICAN_ERR_EMPTY) {
      ASSERT_EQ(bus_[0].events.size(), 1u);
    } else {
      ASSERT_EQ(result, VERICAN_OK);
    }
    bus_.run(150 * kBit);
    SCOPED_TRACE("abort " + std::to_string(clock) + " clocks after the call");
    ASSERT_EQ(bus_[0].events.size(), 1u) << "exactly one report";
    const unsigned count = arrived(0x2AA);
    ASSERT_LE(count, 1u);
    switch (bus_[0].events[0].outcome) {
      case VERICAN_TX_SENT:
        ASSERT_EQ(count, 1u);
        ++sent;
        break;
      case VERICAN_TX_ABORTED:
        ASSERT_TRUE(certain());
        ASSERT_EQ(count, 0u);
        ++taken_back;
        break;
      case VERICAN_TX_WITHDRAWN:
        ASSERT_FALSE(certain());
        ++taken_back;
        break;
      default: FAIL() << "outcome " << bus_[0].events[0].outcome;
    }
    // The mailbox is as good as new.
    bus_[0].events.clear();
    const verican_frame_t next = driver_frame(0x155, 2);
    ASSERT_EQ(verican_send_in(&bus_[0].dev, &next, mailbox), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return !bus_[0].events.empty(); }, 300 * kBit));
    bus_.run(30 * kBit);
    ASSERT_EQ(bus_[0].events[0].outcome, VERICAN_TX_SENT);
    ASSERT_EQ(arrived(0x155), 1u);
  }
  EXPECT_GT(sent, 10u);
  EXPECT_GT(taken_back, certain() ? 4u : 10u);  // on an idle bus a frame is soon out of reach
  EXPECT_EQ(bus_[1].status().rec, 0) << "nothing on the wire was broken";
}

TEST_P(DriverAbort, AFrameThatWaitsBehindAnotherNeverGetsOut) {
  const verican_frame_t first = driver_frame(0x100), second = driver_frame(0x200);
  std::uint8_t mailbox = 0;
  ASSERT_EQ(verican_send(&bus_[0].dev, &first, nullptr), VERICAN_OK);
  ASSERT_EQ(verican_send(&bus_[0].dev, &second, &mailbox), VERICAN_OK);
  bus_.run(50 * kBit);
  ASSERT_EQ(verican_abort(&bus_[0].dev, mailbox), VERICAN_OK);
  ASSERT_EQ(verican_abort(&bus_[0].dev, mailbox),
            bus_[0].events.empty() ? VERICAN_OK : VERICAN_ERR_EMPTY);
  bus_.run(500 * kBit);
  ASSERT_EQ(bus_[0].events.size(), 2u);
  EXPECT_EQ(bus_[0].events[0].mailbox, mailbox);
  EXPECT_EQ(bus_[0].events[0].outcome, certain() ? VERICAN_TX_ABORTED : VERICAN_TX_WITHDRAWN);
  EXPECT_EQ(bus_[0].events[1].outcome, VERICAN_TX_SENT);
  EXPECT_EQ(arrived(0x200), 0u);
  const verican_stats_t stats = bus_[0].status().stats;
  EXPECT_EQ(stats.aborted, 1u);
  EXPECT_EQ(stats.sent, 1u);
}

// The frame loses arbitration against another: it may be taken back before and after.
TEST_P(DriverAbort, AroundALostArbitrationTheReportIsTrue) {  // FX-3.4.b, MO-10
  unsigned sent = 0, taken_back = 0;
  for (unsigned clock = 0; clock < 8 * 160; clock += 7) {
    SCOPED_TRACE("abort " + std::to_string(clock) + " clocks after the call");
    const verican_frame_t filler = driver_frame(0x001, 0), winner = driver_frame(0x100, 0);
    const verican_frame_t loser = driver_frame(0x2AA, 1);
    std::uint8_t mailbox = 0;
    bus_[0].events.clear();
    ASSERT_EQ(verican_send(&bus_[1].dev, &filler, nullptr), VERICAN_OK);
    bus_.run(10 * kBit);
    ASSERT_EQ(verican_send(&bus_[1].dev, &winner, nullptr), VERICAN_OK);
    ASSERT_EQ(verican_send(&bus_[0].dev, &loser, &mailbox), VERICAN_OK);
    bus_.run(clock * kClock);
    const verican_result_t result = verican_abort(&bus_[0].dev, mailbox);
    ASSERT_TRUE(result == VERICAN_OK || result == VERICAN_ERR_EMPTY);
    bus_.run(200 * kBit);
    ASSERT_EQ(bus_[0].events.size(), 1u) << "exactly one report";
    const bool out = bus_[0].events[0].outcome == VERICAN_TX_SENT;
    const unsigned count = arrived(0x2AA);
    if (out || certain()) {
      ASSERT_EQ(count, out ? 1u : 0u);
    }
    ++(out ? sent : taken_back);
    ASSERT_EQ(bus_[0].received().size(), 2u);
  }
  EXPECT_GT(sent, 3u);
  EXPECT_GT(taken_back, 80u);
}

// A one-shot frame loses arbitration, and is over with that: maybe in the very moment in which it
// is taken back. `clock`: from the call that sends to the one that takes back, on a bus of its own,
// so that nothing else differs.
verican_tx_outcome_t outcome_of_a_late_abort(bool abort, unsigned clock) {
  DriverBus bus{2};
  bus[0].config.abort = abort;
  for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(bus[n].up(), VERICAN_OK);
  bus.run(20 * kBit);
  for (unsigned n = 0; n < 2; ++n) bus[n].interrupts = false;  // handlers would take their time
  const verican_frame_t filler = driver_frame(0x001, 0), winner = driver_frame(0x100, 0);
  const verican_frame_t loser = driver_frame(0x2AA, 1, VERICAN_FRAME_ONE_SHOT);
  std::uint8_t mailbox = 0;
  EXPECT_EQ(verican_send(&bus[1].dev, &filler, nullptr), VERICAN_OK);
  bus.run(10 * kBit);
  EXPECT_EQ(verican_send(&bus[1].dev, &winner, nullptr), VERICAN_OK);
  EXPECT_EQ(verican_send(&bus[0].dev, &loser, &mailbox), VERICAN_OK);
  bus.run(clock * kClock);
  (void)verican_abort(&bus[0].dev, mailbox);
  for (unsigned n = 0; n < 2; ++n) bus[n].interrupts = true;
  bus.run(150 * kBit);
  EXPECT_EQ(bus[0].events.size(), 1u) << "exactly one report";
  for (const verican_frame_t &frame : bus[1].received()) EXPECT_NE(frame.id, 0x2AAu);
  return bus[0].events.empty() ? VERICAN_TX_SENT : bus[0].events[0].outcome;
}

TEST_P(DriverAbort, AOneShotThatFailsMeanwhileIsNotToldAsSent) {
  unsigned failed = 0;
  constexpr unsigned kFirst = 8 * 35, kEnd = 8 * 45;
  for (unsigned clock = kFirst; clock < kEnd; ++clock) {
    const verican_tx_outcome_t outcome = outcome_of_a_late_abort(certain(), clock);
    EXPECT_NE(outcome, VERICAN_TX_SENT) << clock << " clocks after the call";
    failed += outcome == VERICAN_TX_FAILED ? 1 : 0;
  }
  EXPECT_GT(failed, 0u);
  EXPECT_LT(failed, kEnd - kFirst) << "the moments before, too";
}

// Nobody acknowledges: the frame is repeated for ever, and the abort ends it at the next error.
TEST_P(DriverAbort, EndsAFrameThatNobodyAcknowledges) {
  ASSERT_EQ(verican_stop(&bus_[1].dev), VERICAN_OK);
  const verican_frame_t frame = driver_frame(0x100);
  std::uint8_t mailbox = 0;
  ASSERT_EQ(verican_send(&bus_[0].dev, &frame, &mailbox), VERICAN_OK);
  bus_.run(1000 * kBit);
  ASSERT_EQ(verican_abort(&bus_[0].dev, mailbox), VERICAN_OK);
  bus_.run(300 * kBit);
  ASSERT_EQ(bus_[0].events.size(), 1u);
  EXPECT_EQ(bus_[0].events[0].outcome, certain() ? VERICAN_TX_ABORTED : VERICAN_TX_WITHDRAWN);
  const std::uint8_t tec = bus_[0].status().tec;
  bus_.run(1000 * kBit);
  EXPECT_EQ(bus_[0].status().tec, tec) << "the bus is quiet";
}

// A new frame right behind an abort is not taken for the old one.
TEST_P(DriverAbort, TheMailboxCanBeUsedAgainAtOnce) {
  bus_[0].when_sent = [this](const verican_tx_event_t &event) {
    if (event.outcome == VERICAN_TX_SENT) return;
    const verican_frame_t next = driver_frame(0x155, 2);
    EXPECT_EQ(verican_send_in(&bus_[0].dev, &next, event.mailbox), VERICAN_OK);
  };
  for (unsigned clock = 0; clock < 64; ++clock) {
    SCOPED_TRACE("abort " + std::to_string(clock) + " clocks after the call");
    const verican_frame_t filler = driver_frame(0x001, 0), frame = driver_frame(0x2AA, 1);
    std::uint8_t mailbox = 0;
    bus_[0].events.clear();
    ASSERT_EQ(verican_send(&bus_[1].dev, &filler, nullptr), VERICAN_OK);
    bus_.run(10 * kBit);
    ASSERT_EQ(verican_send(&bus_[0].dev, &frame, &mailbox), VERICAN_OK);
    bus_.run(clock * kClock);
    ASSERT_EQ(verican_abort(&bus_[0].dev, mailbox), VERICAN_OK);
    bus_.run(250 * kBit);
    ASSERT_EQ(bus_[0].events.size(), 2u);
    ASSERT_EQ(bus_[0].events[1].outcome, VERICAN_TX_SENT);
    const auto frames = bus_[1].received();
    ASSERT_EQ(frames.size(), 1u);
    ASSERT_EQ(frames[0].id, 0x155u);
  }
}

TEST_P(DriverAbort, StoppingFreesAllMailboxes) {
  for (unsigned round = 0; round < 3; ++round) {
    send_eight(0x100);
    bus_.run((20 + 31 * round) * kBit);
    ASSERT_EQ(verican_stop(&bus_[0].dev), VERICAN_OK);
    ASSERT_EQ(bus_[0].events.size(), 8u);
    unsigned sent = 0;
    for (const auto &event : bus_[0].events) sent += event.outcome == VERICAN_TX_SENT ? 1 : 0;
    bus_.run(100 * kBit);
    ASSERT_EQ(bus_[1].received().size(), sent);
    ASSERT_EQ(verican_start(&bus_[0].dev), VERICAN_OK);
    bus_.run(20 * kBit);
  }
}

// No flag is left for the frames of after the next start, which nobody may take for those given up.
TEST_P(DriverAbort, StoppingLeavesNoFlagWhereWritesGoOutBackToBack) {
  bus_[0].post_writes();
  send_eight(0x100);
  bus_.run(20 * kBit);
  ASSERT_EQ(verican_stop(&bus_[0].dev), VERICAN_OK);
  EXPECT_EQ(bus_[0].rtl().read32(0x2C), 0u) << "IFLAG2";
  for (unsigned mb = 56; mb < 64; ++mb)
    EXPECT_EQ(bus_[0].rtl().read32(0x80 + 16 * mb) >> 24, 0x8u) << "inactive " << mb;
  bus_.run(100 * kBit);
  (void)bus_[1].received();
  ASSERT_EQ(verican_start(&bus_[0].dev), VERICAN_OK);
  bus_[0].interrupts = false;  // the handler comes late
  send_eight(0x200);
  bus_[0].interrupts = true;
  bus_.run(1000 * kBit);
  ASSERT_EQ(bus_[0].events.size(), 8u);
  for (const auto &event : bus_[0].events) EXPECT_EQ(event.outcome, VERICAN_TX_SENT);
  EXPECT_EQ(bus_[1].received().size(), 8u);
}

TEST_P(DriverAbort, RemoteFramesLeaveNoTrap) {  // FX-3.2.g, FX-3.7.a
  const verican_frame_t request = driver_frame(0x300, 2, VERICAN_FRAME_REMOTE);
  std::uint8_t mailbox = 0;
  ASSERT_EQ(verican_send(&bus_[0].dev, &request, &mailbox), VERICAN_OK);
  ASSERT_TRUE(bus_.run_until([&] { return !bus_[0].events.empty(); }));
  bus_.run(30 * kBit);
  ASSERT_EQ(arrived(0x300), 1u);
  EXPECT_EQ(bus_[0].rtl().read32(0x80 + 16 * mailbox) >> 24, 0x8u) << "inactive";
  // The answer is received as any frame, by a mailbox that receives.
  const verican_frame_t answer = driver_frame(0x300, 2);
  ASSERT_EQ(verican_send(&bus_[1].dev, &answer, nullptr), VERICAN_OK);
  bus_.run(150 * kBit);
  const auto frames = bus_[0].received();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_LT(frames[0].source, 56);
  EXPECT_EQ(frames[0].flags, 0);
  EXPECT_EQ(frames[0].data[1], 0x23);
  ASSERT_EQ(verican_send_in(&bus_[0].dev, &request, mailbox), VERICAN_OK);
}

INSTANTIATE_TEST_SUITE_P(Both, DriverAbort, ::testing::Bool(),
                         [](const auto &aen) { return aen.param ? "WithAen" : "WithoutAen"; });

}  // namespace
}  // namespace vericansim
