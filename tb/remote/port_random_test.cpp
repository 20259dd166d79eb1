// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random commands at the engine's port, RTL and model in lockstep: RN-101.
#include <gtest/gtest.h>

#include "remote/random_port.hpp"

namespace vericansim {
namespace {

class PortRandom : public ::testing::TestWithParam<const char *> {};

TEST_P(PortRandom, CommandsHaveTheEffectsOfTheModel) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    PortLockstep pair{GetParam(), 3, 3};
    RandomHost host{seed};
    for (unsigned i = 0; i < 500; ++i) {
      random_port_step(pair, host);
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
}

// RN-15, RN-54: the same where frames are dropped all the time, by age and by errors.
TEST_P(PortRandom, ShortLivesAndFewAttempts) {
  unsigned aged = 0, failed = 0;  // dropped, as full counts it
  for (unsigned seed = 1; seed <= 40; ++seed) {
    PortLockstep pair{GetParam(), 3, 3};
    RandomHost host{seed};
    const std::uint32_t life = 1 + seed % 3, retry = 1 + seed / 3 % 3;
    pair.user_write(remote_map::kLife / 4, life << 8 | retry << 24, 0b1010);
    for (unsigned i = 0; i < 500; ++i) {
      const auto dropped = [&pair] { return pair.model().memory()[remote_map::kCounters + 3]; };
      const unsigned before = dropped();
      if (i % 4 == 0) pair.ms();
      aged += dropped() - before;
      const unsigned then = dropped();
      if (i % 9 == 0) pair.turn(FramePort::End::kError);
      failed += dropped() - then;
      random_port_step(pair, host);
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
  if (GetParam() == std::string{"full"}) {
    EXPECT_GT(aged, 20U);
    EXPECT_GT(failed, 20U);
  }
}

// RN-46: standard16 is standard with a stage of 16 bytes.
INSTANTIATE_TEST_SUITE_P(Profiles, PortRandom,
                         ::testing::Values("small", "standard", "standard16", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim
