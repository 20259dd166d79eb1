// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Producers of the RTL at the engine's port: RN-06, RN-63, RN-64.
#include <algorithm>

#include "remote/port_fixture.hpp"
#include "remote/remote_entries.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using mode::kChange;
using mode::kCyclic;
using mode::kOn;
using mode::kTriggers;

/// Entries are written by user logic.
class PortProducers : public PortFixture {
 protected:
  explicit PortProducers(unsigned name_bits = 3, unsigned number = 3)
      : PortFixture{name_bits, number} {}

  template <typename... Fields>
  void produce(unsigned k, Fields... fields) {
    write(producer_at(k), producer_bytes(fields...));
  }
  void event(unsigned events) {
    port->event(events);
    port->clocks(64);
  }
};

class PortProducersFive : public PortProducers {
 protected:
  PortProducersFive() : PortProducers{5, 9} {}
};

// RN-63: every period, to the tick; also the first one, and periods of more than a byte.
TEST_F(PortProducers, CyclicByTime) {
  port->user_write(0x30 / 4, 0x030201);
  produce(0, 0x30, kOn | kCyclic | 3, 5);
  EXPECT_THAT(wait(4), IsEmpty());
  for (int i = 0; i < 5; ++i) {
    EXPECT_THAT(wait(1), ElementsAre("5B0#010203"));
    EXPECT_THAT(wait(4), IsEmpty());
  }
  for (const unsigned period : {1U, 2U, 255U, 256U, 257U, 300U, 512U}) {
    produce(0, 0x30, kCyclic | 1, period);
    EXPECT_THAT(wait(3), IsEmpty());
    produce(0, 0x30, kOn | kCyclic | 1, period);
    EXPECT_THAT(wait(period - 1), IsEmpty()) << period;
    EXPECT_THAT(wait(1), SizeIs(1)) << period;
    EXPECT_THAT(wait(period - 1), IsEmpty()) << period;
    EXPECT_THAT(wait(2 * period + 1), SizeIs(3)) << period;
  }
  produce(0, 0x30, kCyclic | 1, 0);
  EXPECT_THAT(wait(2), IsEmpty());
  produce(0, 0x30, kOn | kCyclic | 1, 0);
  EXPECT_THAT(wait(1000), IsEmpty());
  EXPECT_THAT(send("1A0#R1"), SizeIs(1));  // and others do not wait for it
}

// RN-63: the period counts TRIGGERs, those of SAFE too.
TEST_F(PortProducers, CyclicByTriggers) {
  produce(7, 0x30, kOn | kTriggers | kCyclic | 1, 3);
  produce(1, 0x31, kOn | kTriggers | 1, 1);
  EXPECT_THAT(wait(10), IsEmpty());
  for (int i = 0; i < 9; ++i) {
    hear(i % 2 == 0 ? "001#" : "001#05");
    EXPECT_THAT(drain(), SizeIs(i % 3 == 2 ? 1 : 0)) << i;
  }
  operate(false);
  hear("001#");
  hear("001#");
  operate(true);
  hear("001#");
  EXPECT_THAT(drain(), ElementsAre("5B0#00"));
}

// RN-63: on change of the bytes last sent, looked at once a ms.
TEST_F(PortProducers, OnChange) {
  produce(3, 0x31, kOn | kChange | 7, 0);
  EXPECT_THAT(wait(10), IsEmpty());
  for (unsigned byte = 0x31; byte < 0x38; ++byte) {
    write(byte, byte);
    EXPECT_THAT(drain(), IsEmpty());
    EXPECT_THAT(wait(3), SizeIs(1)) << byte;
  }
  write(0x38, 7);  // beyond its length
  write(0x30, 7);
  EXPECT_THAT(wait(10), IsEmpty());
  hear("1B1#99");
  write(0x31, 0x31);  // back before anybody looked
  EXPECT_THAT(wait(10), IsEmpty());
}

// RN-63: an event sends at once; the gap holds for all of an entry's frames.
TEST_F(PortProducers, EventsAndGap) {
  produce(0, 0x30, kOn | 1, 0, 10);
  produce(1, 0x31, 1, 0);
  event(1);
  EXPECT_THAT(drain(), ElementsAre("5B0#00"));
  event(1);
  event(3);
  write(0x30, 9);
  EXPECT_THAT(drain(), IsEmpty());
  EXPECT_THAT(wait(9), IsEmpty());
  EXPECT_THAT(wait(1), ElementsAre("5B0#09"));  // once, with the newest byte
  EXPECT_THAT(wait(100), IsEmpty());
}

// RN-64: due entries in the order of k, after answers; one in the queue at a time.
TEST_F(PortProducers, OrderOfStatements) {
  for (unsigned k = 0; k < 8; ++k) produce(k, 0x37 - k, kOn | 1, 0);
  hear("1A0#R1");
  event(1 << 5 | 1 << 1 | 1 << 7);
  event(1 << 1);
  hear("1A1#R1");
  EXPECT_THAT(drain(), ElementsAre("5A0#00", "5A1#00", "5B6#00", "5B2#00", "5B0#00"));
  event(1 << 3);
  write(0x34, 5);  // the statement has its bytes already
  for (int i = 0; i < 4; ++i) hear("1A0#R1");
  EXPECT_THAT(drain(), ElementsAre("5B4#00", ::testing::StartsWith("5FE#03000006"), "5A0#00",
                                   "5A0#00", "5A0#00"));
}

// RN-63: data in OPERATE only; STATUS and IDENT always.
TEST_F(PortProducers, DataInOperateOnly) {
  produce(0, 0x30, kOn | kCyclic | kChange | 1, 4);
  produce(1, 0x7E, kOn | kCyclic | 1, 4);
  produce(2, 0x7F, kOn | kCyclic | 1, 8);
  operate(false);
  write(0x30, 1);
  event(1);
  EXPECT_THAT(wait(8), ElementsAre("5FE#02", "5FE#02", "5FF#01"));
  hear("000#01");
  EXPECT_THAT(drain(), IsEmpty());
  EXPECT_THAT(wait(1), ElementsAre("5B0#01"));  // the change
}

// RN-63: a heartbeat tells the present state, errors too.
TEST_F(PortProducers, HeartbeatIsFresh) {
  produce(1, 0x7E, kOn | kCyclic | kChange | 3, 100);
  EXPECT_THAT(wait(2), ElementsAre("5FE#030000"));
  port->set_counters(0, 5, false, false);
  EXPECT_THAT(wait(1), ElementsAre("5FE#030005"));
  EXPECT_THAT(wait(10), IsEmpty());
}

// RN-06, RN-63: an entry that is no place in the window, or of no length, is off.
TEST_F(PortProducers, EntriesThatAreNone) {
  for (const auto &[a, length] :
       {std::pair(0x77U, 2U), std::pair(0x78U, 1U), std::pair(0x79U, 1U), std::pair(0x7CU, 1U),
        std::pair(0x7DU, 1U), std::pair(0x80U, 1U), std::pair(0xB0U, 1U), std::pair(0x30U, 0U),
        std::pair(0x30U, 9U), std::pair(0xFFU, 1U), std::pair(0x7EU, 9U)}) {
    produce(0, a, kOn | kCyclic | kChange | length, 1);
    event(1);
    EXPECT_THAT(wait(10), IsEmpty()) << a << ' ' << length;
  }
  produce(0, 0x70, kOn | kCyclic | 8, 1);
  EXPECT_THAT(wait(1), ElementsAre("5F0#0000000000000000"));
  produce(0, 0x77, kOn | kCyclic | 1, 1);
  EXPECT_THAT(wait(1), ElementsAre("5F7#00"));
}

// RN-63, RN-64: eight at a millisecond, none is lost; the watchdog is not fed by them.
TEST_F(PortProducers, EightEachMillisecond) {
  hear("000#02");
  hear("1FC#013412FECA");
  hear("1F9#020F1400");  // 20 ms
  (void)drain();
  operate(true);
  for (unsigned k = 0; k < 8; ++k) produce(k, 8 * k, kOn | kCyclic | 8, 1);
  EXPECT_THAT(wait(15), SizeIs(8 * 15));
  (void)wait(10);
  EXPECT_EQ(port->state(), RemoteState::kSafe);
}

// RN-37: requests come while entries are looked at; none is lost, and neither is a statement.
TEST_F(PortProducers, RequestsBetween) {
  for (unsigned k = 0; k < 8; ++k) produce(k, 8 * k, kOn | kCyclic | kChange | 8, 1);
  for (unsigned offset = 0; offset < 400; ++offset) {
    port->pulse_ms();
    port->clocks(offset);
    hear("1A0#R1");
    Texts said = drain();
    port->clocks(640);
    for (const std::string &text : drain()) said.push_back(text);
    EXPECT_EQ(std::count(said.begin(), said.end(), "5A0#00"), 1) << offset;
    EXPECT_THAT(said, SizeIs(9)) << offset;
  }
}

// RN-37: from an event to its statement, however long that is, the others on or off.
TEST_F(PortProducers, AStepTakesAtMost40Clocks) {
  for (const unsigned others : {0U, kOn + 0U})
    for (unsigned n = 1; n <= 8; ++n)
      for (unsigned k = 0; k < 8; ++k) {
        SCOPED_TRACE(testing::Message() << others << ' ' << n << ' ' << k);
        for (unsigned j = 0; j < 8; ++j) produce(j, 0x30, (j == k ? kOn : others) | n, 0);
        port->event(1U << k);
        unsigned clocks = 0;
        for (; !port->asks() && clocks < 100; ++clocks) port->clocks(1);
        EXPECT_LE(clocks, 40U);
        EXPECT_THAT(drain(), SizeIs(1));
      }
}

// RN-52, RN-64: no statement is made while user logic holds, for 64 clocks.
TEST_F(PortProducers, HoldDelays) {
  produce(0, 0x30, kOn | 1, 0);
  port->hold(true);
  port->event(1);
  port->clocks(40);
  write(0x30, 7);
  port->hold(false);
  EXPECT_THAT(drain(), ElementsAre("5B0#07"));
  port->hold(true);
  port->event(1);
  port->clocks(60);
  EXPECT_FALSE(port->asks());
  EXPECT_THAT(drain(), ElementsAre("5B0#07"));
}

// RN-52, RN-64, RN-80: nor while STATUS is sent, whose next byte comes before what waits.
TEST_F(PortProducers, HoldDelaysBesideStatus) {
  constexpr unsigned kFrame = 8 * (18 + 8 * 8);  // clocks from identifier to the last data bit
  produce(0, 0x30, kOn | 1, 0);
  for (unsigned clock = 1; clock < kFrame; clock += 3) {
    SCOPED_TRACE(clock);
    write(0x30, 5);
    hear("1A0#");  // refused
    ASSERT_TRUE(port->asks());
    port->in(clock, [this] {
      port->hold(true);
      port->event(1);
    });
    port->in(clock + 45, [this] { port->poke(0x30, 7); });
    port->in(clock + 60, [this] { port->hold(false); });
    EXPECT_EQ(port->send().id, 0x5FEU);
    port->clocks(128);
    EXPECT_THAT(drain(), ElementsAre("5B0#07"));
  }
}

// RN-72: bus-off forgets what is due, and nothing is sent meanwhile.
TEST_F(PortProducers, BusOffForgetsWhatIsDue) {
  produce(0, 0x7E, kOn | 1, 0);
  hear("1A0#R1");
  event(1);
  port->set_counters(0, 0, true, true);
  port->clocks(64);
  EXPECT_FALSE(port->asks());
  write(0xF01, 1);
  port->set_counters(0, 0, false, false);
  EXPECT_THAT(drain(), ElementsAre(::testing::StartsWith("5FE#82")));
  EXPECT_THAT(wait(5), IsEmpty());
}

// NameBits 5: the window is shorter, STATUS is 1E.
TEST_F(PortProducersFive, Window) {
  produce(0, 0x17, kOn | 1, 0);
  produce(1, 0x1E, kOn | 1, 0);
  produce(2, 0x17, kOn | 2, 0);
  produce(3, 0x37, kOn | 1, 0);
  event(0x0F);
  EXPECT_THAT(drain(), ElementsAre("537#00", "53E#03"));
}

}  // namespace
}  // namespace vericansim
