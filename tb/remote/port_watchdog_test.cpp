// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The watchdog of the RTL at the engine's port: RN-70, RN-71.
#include "remote/port_fixture.hpp"

namespace vericansim {
namespace {

class PortWatchdog : public PortFixture {};

// RN-70: SAFE at the tick that the configuration names, none earlier and none later.
TEST_F(PortWatchdog, EndsToTheTick) {
  for (const unsigned ms : {1U, 2U, 255U, 256U, 257U, 512U}) {
    write(0xF02, {ms & 0xFF, ms >> 8});
    operate(true);
    (void)wait(ms - 1);
    EXPECT_FALSE(port->safe()) << ms;
    (void)wait(1);
    EXPECT_TRUE(port->safe()) << ms;
  }
  write(0xF02, {0, 0});
  operate(true);
  (void)wait(600);
  EXPECT_FALSE(port->safe());
}

// RN-70, RN-71: without any request, too, where AUTO_OP leads to OPERATE.
TEST_F(PortWatchdog, RunsFromAutoOperateOn) {
  port->reset();
  port->user_write(0xF00 / 4, 0x0003'0D03);  // AUTO_OP, 3 ms
  port->start();
  EXPECT_FALSE(port->safe());
  (void)wait(2);
  EXPECT_FALSE(port->safe());
  (void)wait(1);
  EXPECT_TRUE(port->safe());
}

// RN-71: in SAFE it does not run, so it says nothing there.
TEST_F(PortWatchdog, RestsInSafe) {
  operate(false);
  write(0xF02, {2, 0});
  (void)send("001#");
  (void)wait(600);
  EXPECT_EQ(send("1FE#R1"), Texts{"5FE#02"});
}

}  // namespace
}  // namespace vericansim
