// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RESTART with another configuration, RTL and model in lockstep: RN-24, RN-60, RN-70.
#include <gtest/gtest.h>

#include "remote/port_lockstep.hpp"

namespace vericansim {
namespace {

constexpr unsigned kNumber = 0xF00;          // FLAGS are in the next byte
constexpr unsigned kAll = 0xF, kSome = 0x5;  // of ERRS, ACKW, BOOT, AUTO_OP: ERRS and BOOT

Frame restart() {
  Frame frame;
  frame.dlc = 1;
  frame.data[0] = 0x81;
  return frame;
}

Frame of_node(unsigned number, bool read) {
  Frame frame;
  frame.id = number << 5 | 3;
  frame.remote = read;
  frame.dlc = 1;
  return frame;
}

// Numbers of five bits, and 1, which is none; with AUTO_OP and an acknowledge of writes, or
// without.
TEST(PortRestart, TakesNumberAndFlagsAnew) {
  PortLockstep pair{"standard", 5, 9};
  unsigned flags = kAll;
  for (const unsigned number : {31U, 16U, 22U, 1U, 30U, 2U, 9U}) {
    SCOPED_TRACE(number);
    pair.user_write(kNumber / 4, number | flags << 8, 3);
    pair.receive(restart());
    EXPECT_EQ(pair.turn(), number != 1) << "BOOT";
    EXPECT_EQ(pair.port().state() == RemoteState::kOperate, flags == kAll);
    for (const bool read : {true, false}) {
      pair.receive(of_node(number, read));
      EXPECT_EQ(pair.turn(), number != 1 && (read || flags == kAll));
      pair.receive(of_node(number ^ 24, read));  // of nobody
      EXPECT_FALSE(pair.turn());
    }
    ASSERT_EQ(pair.compare(), "") << pair.history();
    flags ^= kAll ^ kSome;
  }
}

}  // namespace
}  // namespace vericansim
