// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Life of a node at the engine's port, RTL and model in lockstep: states, watchdog, bus-off,
// RESTART, and a reset in the midst of any work: RN-60, RN-70 to RN-72, RN-101.
#include <gtest/gtest.h>

#include "remote/random_port.hpp"

namespace vericansim {
namespace {

constexpr unsigned kFlags = remote_map::kFlags;  // WDT is in the same word

// A TRIGGER: a request that is never refused.
Frame trigger() {
  Frame frame;
  frame.id = 1;
  return frame;
}

// FLAGS with AUTO_OP or without, and a watchdog of a few milliseconds or none.
void configure(PortLockstep &pair, RandomHost &host) {
  const unsigned flags = host.once_in(2) ? 5 : host.upto(16);
  const unsigned watchdog = host.once_in(2) ? 0 : host.upto(6);
  pair.user_write(kFlags / 4, flags << 8 | watchdog << 16, 0xE);
}

// Work is begun on both sides of the reset in the RTL alone: nothing of it may be left.
void reset(PortLockstep &pair, RandomHost &host) {
  FramePort &port = pair.port();
  switch (host.upto(6)) {
    case 0: port.receive_broken(host.frame(), host.upto(9)); break;
    case 1: port.pulse_ms(); break;
    case 2:
      if (port.asks()) (void)port.send(FramePort::End::kError);
      break;
    case 3: port.set_counters(0, 0, false, true); break;
    case 4: port.event(1U << host.upto(8)); break;
    default: port.receive_until_valid(host.frame()); break;
  }
  port.clocks(host.upto(40));
  pair.reset();
  if (host.once_in(2)) configure(pair, host);
  pair.start();
}

void step(PortLockstep &pair, RandomHost &host, bool &off) {
  switch (host.upto(24)) {
    case 0:
      reset(pair, host);
      off = false;
      break;
    case 1:
      configure(pair, host);
      if (!off) pair.receive(trigger());  // the watchdog is read when it is fed
      break;
    case 2:
    case 3: pair.bus_off(off = !off); break;
    case 4:
    case 5:
    case 6:
    case 7:
    case 8:
    case 9:
    case 10: pair.ms(); break;
    case 11: pair.drain(); break;
    default:
      if (!off) (void)random_port_step(pair, host);
      break;
  }
}

class PortReset : public ::testing::TestWithParam<const char *> {};

TEST_P(PortReset, LivesAreThoseOfTheModel) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    PortLockstep pair{GetParam(), 3, 3};
    RandomHost host{seed};
    bool off = false;
    for (unsigned i = 0; i < 400; ++i) {
      step(pair, host, off);
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, PortReset, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim
