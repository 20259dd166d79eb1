// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Time stamps of 64 bits: right across wraps of the 16-bit TIMER, for frames that wait, for both
// ends of a frame (flexcan.md 6).
#include <gtest/gtest.h>

#include "driver/driver_node.hpp"
#include "driver/fake_core.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;  // at 1 Mbit/s

class DriverTime : public ::testing::Test {
 protected:
  void SetUp() override {
    for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(bus_[n].up(), VERICAN_OK);
    bus_.run(20 * kBit);
  }
  // Time of a node, and the bus time at which it was taken.
  std::uint64_t now(unsigned n) {
    std::uint64_t bits = 0;
    EXPECT_EQ(verican_time(&bus_[n].dev, &bits), VERICAN_OK);
    return bits;
  }
  // Runs idle time in steps that are short enough for the driver.
  void idle(std::uint64_t bits) {
    for (; bits > 30'000; bits -= 30'000) {
      bus_.run(30'000 * kBit);
      for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(verican_poll(&bus_[n].dev, 0), VERICAN_OK);
    }
    bus_.run(static_cast<Time>(bits) * kBit);
  }

  DriverBus bus_{2};
};

TEST_F(DriverTime, CountsBitTimesAcrossWraps) {  // FX-6.a
  const std::uint64_t start = now(0);
  const Time begin = bus_.bus.now();
  idle(200'000);  // three wraps and a bit
  const std::uint64_t elapsed = now(0) - start;
  EXPECT_NEAR(static_cast<double>(elapsed), static_cast<double>((bus_.bus.now() - begin) / kBit),
              2);
  EXPECT_GT(elapsed, 3u * 65'536);
}

TEST_F(DriverTime, FramesAreStampedAcrossWraps) {  // FX-6.c
  std::uint64_t last_rx = 0, last_tx = 0;
  for (unsigned k = 0; k < 12; ++k) {
    idle(20'000);
    const Time sof = bus_.bus.now();
    const std::uint64_t before = now(1);
    const verican_frame_t frame = driver_frame(0x55, k % 9);
    bus_[0].events.clear();
    ASSERT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK);
    ASSERT_TRUE(bus_.run_until([&] { return !bus_[0].events.empty(); }));
    bus_.run(30 * kBit);
    const auto frames = bus_[1].received();
    ASSERT_EQ(frames.size(), 1u);
    // The identifier begins a few bits after the call: accesses, the end of the running bit, SOF.
    EXPECT_GE(frames[0].timestamp, before);
    EXPECT_LE(frames[0].timestamp, before + 8);
    if (k != 0) {
      EXPECT_GT(frames[0].timestamp, last_rx + 19'000);
      // Both nodes count the same bits from different beginnings.
      EXPECT_NEAR(static_cast<double>(frames[0].timestamp - last_rx),
                  static_cast<double>(bus_[0].events[0].timestamp - last_tx), 1);
    }
    last_rx = frames[0].timestamp;
    last_tx = bus_[0].events[0].timestamp;
    (void)sof;
  }
  EXPECT_GT(last_rx, 3u * 65'536);
}

// Served late, a frame's stamp lies before what the driver already knows.
TEST_F(DriverTime, AStampMayLieInThePast) {
  const std::uint64_t before = now(1);
  bus_[1].interrupts = false;
  const verican_frame_t frame = driver_frame(0x55);
  ASSERT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK);
  bus_.run(25'000 * kBit);
  const std::uint64_t later = now(1);
  EXPECT_GT(later, before + 24'000);
  bus_[1].interrupts = true;
  bus_.run(10 * kBit);
  const auto frames = bus_[1].received();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_GE(frames[0].timestamp, before);
  EXPECT_LE(frames[0].timestamp, before + 8);
  EXPECT_GE(now(1), later);
}

TEST_F(DriverTime, GoesOnAfterAStop) {
  idle(70'000);
  const std::uint64_t before = now(0);
  ASSERT_EQ(verican_stop(&bus_[0].dev), VERICAN_OK);
  bus_.run(100'000 * kBit);  // TIMER rests
  ASSERT_EQ(verican_start(&bus_[0].dev), VERICAN_OK);
  EXPECT_GE(now(0), before);
  EXPECT_LT(now(0), before + 200);
}

// Every distance that 16 bits can tell, around wraps, without the bus.
TEST(DriverTimeExtension, IsRightForEveryDistanceBelowHalfARange) {
  FakeCore core;
  verican_config_t config = core.config();
  verican_t dev;
  ASSERT_EQ(verican_init(&dev, &config), VERICAN_OK);
  ASSERT_EQ(verican_start(&dev), VERICAN_OK);
  std::uint64_t truth = 0;
  for (unsigned k = 0; k < 2000; ++k) {
    truth += k % 3 == 0 ? 32'767 : (k * 7919) % 32'768;
    core.word(VERICAN_TIMER_OFFSET) = truth & 0xFFFF;
    std::uint64_t bits = 0;
    ASSERT_EQ(verican_time(&dev, &bits), VERICAN_OK);
    ASSERT_EQ(bits, truth);
  }
  EXPECT_GT(truth, 500u * 65'536);
}

}  // namespace
}  // namespace vericansim
