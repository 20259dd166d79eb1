// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A node that also sends by itself, at the engine's port, RTL and model in lockstep: RN-63, RN-64,
// RN-101.
#include <gtest/gtest.h>

#include "remote/random_port.hpp"

namespace vericansim {
namespace {

// An entry as user logic writes it: mostly one that sends.
void produce(PortLockstep &pair, RandomHost &host) {
  const unsigned at = 0xF40 / 4 + 2 * host.upto(8);
  const unsigned a = host.once_in(4) ? 0x70 + host.upto(0x20) : host.upto(0x70);
  const unsigned mode = (host.once_in(4) ? 0U : 0x80U) | host.upto(8) << 4 | (1 + host.upto(8));
  pair.user_write(at, a | mode << 8 | (1 + host.upto(5)) << 16, 0xF);
  pair.user_write(at + 1, host.once_in(2) ? 0 : host.upto(4), 1);
}

void step(PortLockstep &pair, RandomHost &host) {
  switch (host.upto(16)) {
    case 0:
    case 1: produce(pair, host); break;
    case 2:
    case 3: pair.event(host.upto(8)); break;
    case 4:
    case 5:
    case 6: pair.ms(); break;
    case 7: pair.drain(); break;
    default: random_port_step(pair, host); break;
  }
}

class PortSelfRandom : public ::testing::TestWithParam<const char *> {};

TEST_P(PortSelfRandom, StatementsAreThoseOfTheModel) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    PortLockstep pair{GetParam(), 3, 3};
    RandomHost host{seed};
    for (unsigned i = 0; i < 500; ++i) {
      step(pair, host);
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, PortSelfRandom, ::testing::Values("standard"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim
