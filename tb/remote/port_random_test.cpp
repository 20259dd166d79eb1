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

INSTANTIATE_TEST_SUITE_P(Profiles, PortRandom, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim
