// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Modes and options of the driver, each seen on the bus: listen-only, loop-back, self-reception,
// one-shot, FD tolerance, triple sampling, starting and stopping under traffic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bus/faults.hpp"
#include "bus/trace.hpp"
#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;  // at 1 Mbit/s

// Counts the dominant clocks that a node drives and the frames it starts.
class Activity : public BusObserver {
 public:
  explicit Activity(NodeId node) : node_{node} {}
  unsigned interests() const override { return kClocks; }
  void on_clock(NodeId id, Time, std::uint64_t word) override {
    if (id != node_) return;
    const Trace trace = decode_trace(word);
    if (trace.tx == Level::kDominant) ++dominant;
    if (trace.tx_ok) ++sent;
    if (trace.tx_fail) ++failed;
  }
  unsigned dominant = 0, sent = 0, failed = 0;

 private:
  NodeId node_;
};

class DriverModes : public ::testing::Test {
 protected:
  void up(std::initializer_list<unsigned> nodes) {
    for (const unsigned n : nodes) ASSERT_EQ(bus_[n].up(), VERICAN_OK) << n;
    bus_.run(20 * kBit);
  }
  verican_result_t send(unsigned n, std::uint32_t id = 0x123, unsigned flags = 0) {
    const verican_frame_t frame = driver_frame(id, 8, flags);
    return verican_send(&bus_[n].dev, &frame, nullptr);
  }
  bool exchange(unsigned from) {
    bus_[from].events.clear();
    if (send(from) != VERICAN_OK) return false;
    return bus_.run_until([&] { return !bus_[from].events.empty(); }, 5 * kMillisecond);
  }

  DriverBus bus_{3};
};

TEST_F(DriverModes, ListenOnlyHearsAndNeverDrivesTheBus) {  // MO-01, FX-2.4.a
  bus_[2].config.mode = VERICAN_MODE_LISTEN_ONLY;
  up({0, 1, 2});
  Activity activity{2};
  bus_.bus.add(activity);
  EXPECT_EQ(send(2), VERICAN_ERR_STATE);
  ASSERT_TRUE(exchange(0));
  bus_.run(30 * kBit);
  EXPECT_EQ(bus_[2].received().size(), 1u);
  EXPECT_EQ(activity.dominant, 0u);
  bus_.bus.remove(activity);

  // Back to normal, it takes part again.
  ASSERT_EQ(verican_stop(&bus_[2].dev), VERICAN_OK);
  ASSERT_EQ(verican_set_mode(&bus_[2].dev, VERICAN_MODE_NORMAL), VERICAN_OK);
  ASSERT_EQ(verican_start(&bus_[2].dev), VERICAN_OK);
  bus_.run(20 * kBit);
  EXPECT_TRUE(exchange(2));
}

TEST_F(DriverModes, LoopBackHearsItselfAndNobodyElse) {  // MO-04, FX-2.5.a
  bus_[2].config.mode = VERICAN_MODE_LOOP_BACK;
  up({0, 1, 2});
  Activity activity{2};
  bus_.bus.add(activity);
  const Time before = bus_.bus.now();
  ASSERT_TRUE(exchange(2));
  bus_.run(30 * kBit);
  const auto own = bus_[2].received();
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].id, 0x123u);
  EXPECT_EQ(bus_.bus.level(), Level::kRecessive);
  EXPECT_LT(bus_.bus.now() - before, 400 * kBit);
  EXPECT_TRUE(bus_[0].received().empty());
  ASSERT_TRUE(exchange(0));
  bus_.run(30 * kBit);
  EXPECT_TRUE(bus_[2].received().empty());
  bus_.bus.remove(activity);
}

TEST_F(DriverModes, SelfReceptionIsAnOption) {  // MO-06, FX-2.6.a
  bus_[1].config.self_reception = true;
  up({0, 1});
  for (unsigned n = 0; n < 2; ++n) {
    ASSERT_TRUE(exchange(n));
    bus_.run(30 * kBit);
    EXPECT_EQ(bus_[0].received().size(), n == 0 ? 0u : 1u);
    EXPECT_EQ(bus_[1].received().size(), 1u);
  }
}

TEST_F(DriverModes, OneShotForAllFramesStartsEachOnce) {  // MO-09
  bus_[0].config.one_shot = true;
  up({0});  // nobody acknowledges
  Activity activity{0};
  bus_.bus.add(activity);
  ASSERT_TRUE(exchange(0));
  bus_.run(500 * kBit);
  EXPECT_EQ(activity.failed, 1u);
  EXPECT_EQ(activity.sent, 0u);
  EXPECT_EQ(bus_[0].events[0].outcome, VERICAN_TX_FAILED);
  EXPECT_EQ(bus_[0].status().stats.aborted, 1u);
  // Off again, the frame is repeated until somebody is there.
  ASSERT_EQ(verican_set_one_shot(&bus_[0].dev, false), VERICAN_OK);
  bus_[0].events.clear();
  ASSERT_EQ(send(0), VERICAN_OK);
  bus_.run(500 * kBit);
  EXPECT_TRUE(bus_[0].events.empty());
  EXPECT_GT(activity.failed, 2u);
  up({1});
  ASSERT_TRUE(bus_.run_until([&] { return !bus_[0].events.empty(); }));
  EXPECT_EQ(bus_[0].events[0].outcome, VERICAN_TX_SENT);
  // On again, and with somebody there it succeeds.
  ASSERT_EQ(verican_set_one_shot(&bus_[0].dev, true), VERICAN_OK);
  ASSERT_TRUE(exchange(0));
  EXPECT_EQ(bus_[0].events[0].outcome, VERICAN_TX_SENT);
  bus_.bus.remove(activity);
}

TEST_F(DriverModes, OneShotForASingleFrameLeavesTheOthersAlone) {  // MO-09
  up({0});
  Activity activity{0};
  bus_.bus.add(activity);
  bus_[0].events.clear();
  ASSERT_EQ(send(0, 0x100, VERICAN_FRAME_ONE_SHOT), VERICAN_OK);
  ASSERT_EQ(send(0, 0x200), VERICAN_OK);
  bus_.run(1000 * kBit);
  ASSERT_EQ(bus_[0].events.size(), 1u);
  EXPECT_EQ(bus_[0].events[0].outcome, VERICAN_TX_FAILED);
  EXPECT_GT(activity.failed, 3u) << "the other is repeated";
  up({1});
  ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == 2; }));
  EXPECT_EQ(bus_[0].events[1].outcome, VERICAN_TX_SENT);
  bus_.run(30 * kBit);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].id, 0x200u);
  bus_.bus.remove(activity);
}

// A classic node answers a recessive reserved bit of a standard frame with nothing, too, but takes
// the frame for one of its own; the first bits of a CAN FD frame are such a frame.
TEST_F(DriverModes, FdToleranceReachesTheCore) {
  bus_[0].config.fd_tolerant = true;
  up({0, 1});
  EXPECT_EQ(bus_[0].rtl().read32(0x100C) & 1, 1u);
  EXPECT_EQ(bus_[1].rtl().read32(0x100C) & 1, 0u);
  EXPECT_TRUE(exchange(0));
}

TEST_F(DriverModes, TripleSamplingReachesTheCore) {
  bus_[0].config.triple_sampling = true;
  up({0, 1});
  EXPECT_EQ(bus_[0].rtl().read32(4) & 0x80, 0x80u);
  EXPECT_EQ(bus_[1].rtl().read32(4) & 0x80, 0u);
  EXPECT_TRUE(exchange(0));
  EXPECT_TRUE(exchange(1));
}

TEST_F(DriverModes, BitRatesOnBothEndsOfTheRange) {
  for (const std::uint32_t bitrate : {10'000u, 500'000u}) {
    for (unsigned n = 0; n < 2; ++n) {
      bus_[n].config.bitrate = bitrate;
      ASSERT_EQ(bus_[n].up(), VERICAN_OK);
      EXPECT_EQ(bus_[n].status().timing.bitrate, bitrate);
    }
    bus_.run(20 * (kSecond / bitrate));
    bus_[0].events.clear();
    const Time start = bus_.bus.now();
    ASSERT_EQ(send(0), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return !bus_[0].events.empty(); }));
    // An 8-byte standard frame has 108 bits up to its end and up to 19 stuff bits.
    EXPECT_GT(bus_.bus.now() - start, 107 * (kSecond / bitrate));
    EXPECT_LT(bus_.bus.now() - start, 140 * (kSecond / bitrate));
    for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(verican_deinit(&bus_[n].dev), VERICAN_OK);
  }
}

TEST_F(DriverModes, ExplicitTimingAndANewOneWhenStopped) {
  const verican_timing_t half{2, 3, 2, 2, 1, 0, 0, 0};
  const verican_timing_t full{1, 3, 2, 2, 1, 0, 0, 0};
  bus_[0].config.timing = &half;
  bus_[1].config.timing = &full;
  ASSERT_EQ(verican_init(&bus_[0].dev, &bus_[0].config), VERICAN_OK);
  EXPECT_EQ(bus_[0].status().timing.bitrate, 500'000u);
  ASSERT_EQ(verican_set_timing(&bus_[0].dev, 8'000'000, &full), VERICAN_OK);
  EXPECT_EQ(bus_[0].status().timing.bitrate, 1'000'000u);
  ASSERT_EQ(verican_start(&bus_[0].dev), VERICAN_OK);
  up({1});
  EXPECT_TRUE(exchange(0));
}

TEST_F(DriverModes, StopGivesUpWhatWaitsAndStartGoesOn) {
  up({0, 1});
  for (std::uint32_t id = 0x100; id < 0x108; ++id) ASSERT_EQ(send(0, id), VERICAN_OK);
  std::uint8_t waiting = 0;
  EXPECT_EQ(verican_tx_waiting(&bus_[0].dev, &waiting), VERICAN_OK);
  EXPECT_EQ(waiting, 8);
  EXPECT_EQ(send(0), VERICAN_ERR_BUSY);
  bus_.run(150 * kBit);  // one is out, the second on the wire
  ASSERT_EQ(verican_stop(&bus_[0].dev), VERICAN_OK);
  bus_.run(200 * kBit);
  EXPECT_EQ(verican_tx_waiting(&bus_[0].dev, &waiting), VERICAN_OK);
  EXPECT_EQ(waiting, 0);
  ASSERT_EQ(bus_[0].events.size(), 8u);
  const auto count = std::count_if(bus_[0].events.begin(), bus_[0].events.end(),
                                   [](auto &event) { return event.outcome == VERICAN_TX_SENT; });
  // What was told as sent, and only that, has arrived whole; nobody saw an error.
  EXPECT_EQ(bus_[1].received().size(), static_cast<std::size_t>(count));
  EXPECT_EQ(count, 2);
  EXPECT_EQ(bus_[1].status().rec, 0);
  EXPECT_FALSE(bus_[0].rtl().irq());

  ASSERT_EQ(verican_start(&bus_[0].dev), VERICAN_OK);
  bus_.run(20 * kBit);
  EXPECT_TRUE(exchange(0));
  EXPECT_TRUE(exchange(1));
  bus_.run(30 * kBit);
  EXPECT_EQ(bus_[1].received().size(), 1u) << "and not the old ones";
  EXPECT_EQ(bus_[0].received().size(), 1u);
}

TEST_F(DriverModes, AFullRingDropsTheNewestAndCountsIt) {
  bus_[1].config.rx_ring_size = 4;
  up({0, 1});
  for (std::uint32_t id = 0x100; id < 0x105; ++id) {
    ASSERT_EQ(send(0, id), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == id - 0xFF; }));
  }
  bus_.run(30 * kBit);
  std::uint16_t waiting = 0;
  EXPECT_EQ(verican_rx_waiting(&bus_[1].dev, &waiting), VERICAN_OK);
  EXPECT_EQ(waiting, 3);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 3u);
  for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(frames[k].id, 0x100 + k);
  EXPECT_EQ(bus_[1].status().stats.rx_dropped, 2u);
  EXPECT_EQ(bus_[1].status().stats.received, 3u);
}

TEST_F(DriverModes, MailboxesThatOverflowMarkTheFrameAndCountIt) {  // FX-3.5.m
  bus_[1].config.tx_mailboxes = 62;                                 // two receive
  up({0, 1});
  bus_[1].interrupts = false;
  for (std::uint32_t id = 0x100; id < 0x104; ++id) {
    ASSERT_EQ(send(0, id), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == id - 0xFF; }));
  }
  bus_[1].interrupts = true;
  bus_.run(30 * kBit);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].id, 0x100u);
  EXPECT_EQ(frames[0].flags, 0);
  EXPECT_EQ(frames[1].id, 0x103u);
  EXPECT_EQ(frames[1].flags, VERICAN_FRAME_OVERRUN);
  EXPECT_EQ(bus_[1].status().stats.rx_overruns, 1u);
}

TEST_F(DriverModes, AFifoThatOverflowsCountsIt) {  // FX-4.m
  bus_[1].config.rx_mode = VERICAN_RX_FIFO;
  up({0, 1});
  bus_[1].interrupts = false;
  for (std::uint32_t id = 0x100; id < 0x108; ++id) {
    ASSERT_EQ(send(0, id), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == id - 0xFF; }));
  }
  bus_.run(30 * kBit);
  bus_[1].interrupts = true;
  bus_.run(30 * kBit);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 6u);
  for (unsigned k = 0; k < 6; ++k) EXPECT_EQ(frames[k].id, 0x100 + k);
  EXPECT_EQ(bus_[1].status().stats.rx_overruns, 1u);
}

TEST_F(DriverModes, TheFifoTellsWhichFilterTookAFrame) {  // FX-MAP.RXFIR
  bus_[1].config.rx_mode = VERICAN_RX_FIFO;
  ASSERT_EQ(verican_init(&bus_[1].dev, &bus_[1].config), VERICAN_OK);
  verican_filter_t filters[5];
  for (unsigned k = 0; k < 5; ++k)
    filters[k] = {0x200 + k, 0x7FF, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_ONLY_0};
  ASSERT_EQ(verican_set_filters(&bus_[1].dev, filters, 5), VERICAN_OK);
  ASSERT_EQ(verican_start(&bus_[1].dev), VERICAN_OK);
  up({0});
  for (unsigned k = 0; k < 5; ++k) ASSERT_EQ(send(0, 0x200 + k), VERICAN_OK);
  ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == 5; }));
  bus_.run(30 * kBit);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 5u);
  for (unsigned k = 0; k < 5; ++k) {
    EXPECT_EQ(frames[k].id, 0x200 + k);
    EXPECT_EQ(frames[k].source, k);
  }
}

// A boot loader may have chosen the other clock, which a soft reset keeps and disable mode alone
// changes (flexcan.md 1.2).
TEST_F(DriverModes, TheClockSourceThatOtherSoftwareChoseStays) {
  constexpr std::uint32_t kClkSrc = 0x2000;
  bus_[0].rtl().write32(0x004, kClkSrc);
  ASSERT_EQ(bus_[0].up(), VERICAN_OK);
  EXPECT_EQ(bus_[0].rtl().read32(0x004) & kClkSrc, kClkSrc);
}

TEST_F(DriverModes, ADeviceCanBeInitialisedAgainWhileItRuns) {
  up({0, 1});
  ASSERT_EQ(send(0), VERICAN_OK);
  bus_.run(30 * kBit);
  up({0});
  bus_[0].events.clear();
  EXPECT_TRUE(exchange(1));
  EXPECT_TRUE(exchange(0));
}

// ---- Order of transmission

class DriverTxOrder : public DriverModes {
 protected:
  // Queues frames while another node keeps the bus busy; returns the identifiers as they came.
  std::vector<std::uint32_t> race(verican_tx_order_t order,
                                  const std::vector<verican_frame_t> &frames) {
    bus_[0].config.tx_order = order;
    up({0, 1, 2});
    EXPECT_EQ(send(1, 0x001), VERICAN_OK);
    bus_.run(30 * kBit);
    for (const verican_frame_t &frame : frames)
      EXPECT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK);
    EXPECT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == frames.size(); }));
    bus_.run(30 * kBit);
    std::vector<std::uint32_t> ids;
    for (const verican_frame_t &frame : bus_[2].received()) ids.push_back(frame.id);
    ids.erase(ids.begin());
    return ids;
  }
};

TEST_F(DriverTxOrder, ByIdTheOneThatWinsOnTheBusGoesFirst) {  // FX-3.3.c
  EXPECT_THAT(race(VERICAN_TX_BY_ID,
                   {driver_frame(0x300), driver_frame(0x100), driver_frame(0x400),
                    driver_frame(0x200), driver_frame(0x100 << 18, 8, VERICAN_FRAME_EXTENDED)}),
              ::testing::ElementsAre(0x100, 0x100 << 18, 0x200, 0x300, 0x400));
}

TEST_F(DriverTxOrder, InOrderTheFirstComesFirst) {  // FX-3.3.b
  EXPECT_THAT(race(VERICAN_TX_IN_ORDER, {driver_frame(0x300), driver_frame(0x100),
                                         driver_frame(0x400), driver_frame(0x200)}),
              ::testing::ElementsAre(0x300, 0x100, 0x400, 0x200));
}

TEST_F(DriverTxOrder, ByPriorityTheLeastNumberGoesFirst) {  // FX-3.3.d
  std::vector<verican_frame_t> frames{driver_frame(0x100), driver_frame(0x200), driver_frame(0x300),
                                      driver_frame(0x400)};
  for (unsigned k = 0; k < 4; ++k) frames[k].priority = static_cast<std::uint8_t>(6 - 2 * k);
  frames[1].priority = frames[2].priority;  // then the identifier decides
  EXPECT_THAT(race(VERICAN_TX_BY_PRIORITY, frames),
              ::testing::ElementsAre(0x400, 0x200, 0x300, 0x100));
}

// Mailboxes are used upwards only while frames wait, so that none overtakes another.
TEST_F(DriverTxOrder, InOrderHoldsUnderLoad) {
  bus_[0].config.tx_order = VERICAN_TX_IN_ORDER;
  bus_[0].config.tx_mailboxes = 3;
  up({0, 1});
  std::uint32_t queued = 0;
  while (queued < 100) {
    if (send(0, 0x7FF - queued) == VERICAN_OK) ++queued;  // later frames would win by identifier
    bus_.run((1 + queued * 7 % 60) * kBit);
  }
  ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == 100; }));
  bus_.run(30 * kBit);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 100u);
  for (std::uint32_t k = 0; k < 100; ++k) ASSERT_EQ(frames[k].id, 0x7FF - k);
}

}  // namespace
}  // namespace vericansim
