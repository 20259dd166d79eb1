// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver's self-test: passes on the core, leaves no trace, and finds what is broken.
#include <gtest/gtest.h>

#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

TEST(DriverSelfTest, PassesWithIdlePinsAndLeavesTheConfigurationAlone) {
  DriverBus bus{2};
  for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(verican_init(&bus[n].dev, &bus[n].config), VERICAN_OK);
  ASSERT_EQ(verican_start(&bus[1].dev), VERICAN_OK);
  verican_test_report_t report{};
  EXPECT_EQ(verican_self_test(&bus[0].dev, &report), VERICAN_OK);
  EXPECT_EQ(report.step, VERICAN_TEST_PASSED);
  EXPECT_EQ(verican_self_test(&bus[0].dev, nullptr), VERICAN_OK);
  bus.run(100 * kMicrosecond);
  EXPECT_TRUE(bus[1].received().empty());
  EXPECT_EQ(bus[1].status().rec, 0);

  // Afterwards the device works as before.
  ASSERT_EQ(verican_start(&bus[0].dev), VERICAN_OK);
  const verican_frame_t frame = driver_frame(0x123);
  for (unsigned n = 0; n < 2; ++n) {
    ASSERT_EQ(verican_send(&bus[n].dev, &frame, nullptr), VERICAN_OK);
    ASSERT_TRUE(bus.run_until([&] { return !bus[n].events.empty(); }));
    bus.run(50 * kMicrosecond);
    EXPECT_EQ(bus[1 - n].received().size(), 1u);
    EXPECT_TRUE(bus[n].received().empty());
  }
}

}  // namespace
}  // namespace vericansim
