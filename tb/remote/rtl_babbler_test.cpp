// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that never pauses: RN-36, RN-37. The campaign has ten seconds of it.
#include <gmock/gmock.h>

#include "remote/babbler.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

class RtlBabbler : public ::testing::TestWithParam<const char *> {};

// RN-36: all commands without pause, right, wrong and broken, at 8 clocks a bit: user logic loses
// 15 % of the RAM's clocks at most; 1 ms after the last frame a correct command works. RN-37,
// RN-50: it waits for 24 clocks at most.
TEST_P(RtlBabbler, LeavesUserLogicItsClocks) {
  const BabbleResult result = babble(GetParam(), 1, 250'000);
  EXPECT_LE(result.lost(), 15);
  EXPECT_GT(result.lost(), 1);
  EXPECT_LE(result.longest_wait, 24U);
  EXPECT_TRUE(result.answers);
  // It was a host that never pauses: but for the intermission, and behind errors.
  EXPECT_GE(result.frames, result.bits / 160);
  EXPECT_GT(result.broken, 50U);
  EXPECT_LE(100 * result.idle_bits, 2 * result.bits);
}
INSTANTIATE_TEST_SUITE_P(Profiles, RtlBabbler, ::testing::Values("small", "standard", "full"),
                         [](const auto &one) { return std::string{one.param}; });

// RN-36: the frames that cost most, writes of eight bytes, one after the other.
TEST(RtlBabblerOfWrites, OfEightBytesIsNoWorse) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  BabbleResult result;
  UserWaits waits{bus.node(), 2, result};
  bus.bus.add(waits);
  for (unsigned i = 0; i < 500; ++i) {
    while (bus.host.waiting() < 2) bus.host.request(frame_of("1A0#0123456789ABCDEF"));
    bus.run_bits(100);
  }
  bus.bus.remove(waits);
  EXPECT_LE(result.lost(), 15);
  EXPECT_GT(result.lost(), 1);
  EXPECT_LE(result.longest_wait, 24U);
  EXPECT_LE(result.idle_bits, 1U);  // before the first
}

}  // namespace
}  // namespace vericansim
