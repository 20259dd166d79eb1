// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random commands at the engine's port, RTL and model in lockstep: RN-101.
#include <gtest/gtest.h>

#include "remote/port_lockstep.hpp"
#include "remote/random_host.hpp"

namespace vericansim {
namespace {

void step(PortLockstep &pair, RandomHost &host) {
  switch (host.upto(16)) {
    case 0: pair.ms(); break;
    case 1: pair.user_write(host.upto(1024), host.upto(~0U), host.upto(16)); break;
    case 2: pair.turn(FramePort::End::kError); break;
    case 3:
      if (pair.turn(FramePort::End::kLost)) pair.receive(host.frame());
      break;
    case 4: pair.receive_broken(host.frame(), host.upto(9)); break;
    case 5: pair.set_counters(host.upto(200), host.upto(200)); break;
    case 6:
    case 7:
    case 8: pair.turn(); break;
    default: pair.receive(host.frame()); break;
  }
}

class PortRandom : public ::testing::TestWithParam<const char *> {};

TEST_P(PortRandom, CommandsHaveTheEffectsOfTheModel) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    PortLockstep pair{GetParam(), 3, 3};
    RandomHost host{seed};
    for (unsigned i = 0; i < 500; ++i) {
      step(pair, host);
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, PortRandom, ::testing::Values("small"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim
