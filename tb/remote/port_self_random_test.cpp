// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A node that also sends and listens by itself, at the engine's port, RTL and model in lockstep:
// RN-63 to RN-65, RN-101.
#include <gtest/gtest.h>

#include "remote/random_port.hpp"

namespace vericansim {
namespace {

// An entry as user logic writes it: mostly one that sends.
void produce(PortLockstep &pair, RandomHost &host) {
  const unsigned at = 0xF40 / 4 + 2 * host.upto(8);
  const unsigned a = host.once_in(4) ? 0x70 + host.upto(0x20) : host.upto(0x70);
  const unsigned mode = (host.once_in(4) ? 0U : 0x80U) | host.upto(8) << 4 | (1 + host.upto(8));
  pair.user_write(at, a | mode << 8 | host.upto(6) << 16, 0xF);
  pair.user_write(at + 1, host.once_in(2) ? 0 : host.upto(4), 1);
}

// Without a time-out: those have steps of 10 ms in the RTL.
void map(PortLockstep &pair, RandomHost &host) {
  static constexpr unsigned kMasks[] = {0x7FF, 0x780, 0x07F, 0x7F8, 0x400, 0x7FE, 0x000, 0x6F7};
  const unsigned at = 0xF80 / 4 + 2 * host.upto(8);
  const unsigned id = (host.once_in(3) ? 0U : 0x8000U) | host.upto(0x800);
  pair.user_write(at, id | kMasks[host.upto(8)] << 16, 0xF);
  const unsigned address = host.once_in(3) ? host.upto(0x1100) : host.upto(0x400);
  const unsigned flags = (host.once_in(2) ? host.upto(4) << 5 : 0U) | host.upto(10);
  pair.user_write(at + 1, address | flags << 16, 0xF);
}

// WP and RP: a page here and there.
void protect(PortLockstep &pair, RandomHost &host) {
  constexpr unsigned kPlaces[] = {0xF08, 0xF0C, 0xF10, 0xF14};
  pair.user_write(kPlaces[host.upto(4)] / 4, host.once_in(3) ? 0 : 1U << host.upto(32), 0xF);
}

// A frame that one may take.
Frame statement(RandomHost &host) {
  Frame frame;
  frame.id = host.upto(0x800);
  frame.dlc = static_cast<std::uint8_t>(host.once_in(8) ? host.upto(16) : host.upto(9));
  frame.remote = host.once_in(20);
  for (unsigned i = 0; !frame.remote && i < frame.dlc && i < 8; ++i)
    frame.data[i] = static_cast<std::uint8_t>(host.upto(256));
  return frame;
}

void step(PortLockstep &pair, RandomHost &host) {
  switch (host.upto(20)) {
    case 0:
    case 1: produce(pair, host); break;
    case 2:
    case 3: pair.event(host.upto(8)); break;
    case 4:
    case 5:
    case 6: pair.ms(); break;
    case 7: pair.drain(); break;
    case 8: host.once_in(4) ? protect(pair, host) : map(pair, host); break;
    case 9:
    case 10:
    case 11: pair.receive(statement(host)); break;
    default: random_port_step(pair, host); break;
  }
}

class PortSelfRandom : public ::testing::TestWithParam<std::pair<const char *, unsigned>> {};

TEST_P(PortSelfRandom, StatementsAreThoseOfTheModel) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto [profile, name_bits] = GetParam();
    PortLockstep pair{profile, name_bits, 3};
    RandomHost host{seed, {0, 0, 1, 1, 3, 3, 3, 3, 3, 3, 4, 2, 7}, name_bits};
    for (unsigned i = 0; i < 500; ++i) {
      step(pair, host);
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
}

// odd: RAMs of 1,024 and 2,048 bytes, no stage, NameBits 5, features that no profile has together.
INSTANTIATE_TEST_SUITE_P(Profiles, PortSelfRandom,
                         ::testing::Values(std::pair{"standard", 3}, std::pair{"full", 3},
                                           std::pair{"odd", 3}, std::pair{"odd", 5}),
                         [](const auto &test) {
                           return std::string{test.param.first} +
                                  (test.param.second == 5 ? "5" : "");
                         });

}  // namespace
}  // namespace vericansim
