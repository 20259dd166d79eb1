// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The engine gets each byte within eight bits of eight clocks, whatever else is to be done: RN-80.
#include "remote/port_fixture.hpp"
#include "remote/remote_entries.hpp"

namespace vericansim {
namespace {

using mode::kChange;
using mode::kCyclic;
using mode::kOn;

constexpr unsigned kFrame = 8 * (18 + 8 * 8);  // clocks from identifier to the last data bit

/// Eight producers, all of which are looked at each millisecond.
class PortBytes : public PortFixture {
 protected:
  PortBytes() {
    for (unsigned i = 0; i < 8; ++i) write(0x20 + i, 0x11 * (i + 1));
    for (unsigned k = 0; k < 8; ++k)
      write(producer_at(k), producer_bytes(0x40, kOn | kChange | kCyclic | 8, 1));
  }
  /// Until no statement is due any more.
  void say_all() {
    constexpr unsigned kAll = 640;  // clocks in which all producers are looked at
    do port->clocks(kAll);
    while (!drain().empty());
  }
};

// Timers, ages of a full queue and visits to producers begin in any clock of the frame.
TEST_F(PortBytes, ComeInTimeBesideTimers) {
  for (unsigned clock = 1; clock < kFrame; clock += 5) {
    SCOPED_TRACE(clock);
    (void)wait(9);  // the next millisecond is the tenth
    (void)drain();
    for (unsigned i = 0; i < 4; ++i) hear("1A0#R8");
    ASSERT_TRUE(port->asks());
    port->pulse_ms_in(clock);
    EXPECT_EQ(candump_frame(port->send()), "5A0#1122334455667788");
    for (unsigned i = 0; i < 3; ++i)
      EXPECT_EQ(candump_frame(port->send()), "5A0#1122334455667788") << i;
    (void)drain();
  }
}

// STATUS leaves room in the queue: a statement may begin beside it, and user logic hold that.
TEST_F(PortBytes, ComeInTimeWhileUserLogicHolds) {
  for (unsigned clock = 1; clock < kFrame; clock += 3) {
    SCOPED_TRACE(clock);
    say_all();
    hear("1A0#");
    ASSERT_TRUE(port->asks());
    const unsigned refused = port->peek(0xFF6);
    port->hold(true);
    port->pulse_ms_in(clock);
    const Frame status = port->send();
    port->hold(false);
    EXPECT_EQ(status.id, 0x5FEU);
    EXPECT_EQ(status.dlc, 8);
    EXPECT_EQ(status.data[3], 3) << "code";
    EXPECT_EQ(status.data[4], 0x20) << "A";
    EXPECT_EQ(status.data[6], refused) << "refused";
    EXPECT_EQ(status.data[7], port->peek(0xFF7)) << "TRIGGER count";
  }
}

}  // namespace
}  // namespace vericansim
