// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Map entries and protection of the RTL at the engine's port: RN-32, RN-65, RN-66, RN-70.

#include "remote/port_fixture.hpp"
#include "remote/remote_entries.hpp"
#include "remote/window_copy.hpp"

namespace vericansim {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class PortMaps : public PortFixture {
 protected:
  template <typename... Fields>
  void map(unsigned k, Fields... fields) {
    write(map_at(k), map_bytes(fields...));
  }
};

// RN-65, the example: a copy of the window of node 5 at 200..277.
TEST_F(PortMaps, ACopyOfAWindow) {
  map(7, 0x680, 0x780, 0x200, 0);
  expect_a_copy_of_a_window([this](const Frame &frame) { port->receive(frame); },
                            [this](unsigned at, unsigned n) { return bytes(at, n); });
}

// RN-65: the fields of an entry at their borders.
TEST_F(PortMaps, WhatAnEntryTakes) {
  map(0, 0x6A0, 0x7FF, 0x300, 3);
  EXPECT_THAT(send("6A0#0102"), IsEmpty());
  EXPECT_THAT(bytes(0x300, 3), Each(0));
  hear("6A0#010203");
  EXPECT_THAT(bytes(0x300, 4), ElementsAre(1, 2, 3, 0));
  EXPECT_THAT(port->take_pulses(), ElementsAre(RemotePulse{false, 0x300, 3}));
  hear("6A0#0405060708090A0B");
  EXPECT_THAT(bytes(0x300, 4), ElementsAre(4, 5, 6, 0));
  for (const char *other :
       {"6A0#1112131415161718_9", "6A1#111213", "2A0#111213", "6A0#R3", "1A800000#111213"})
    EXPECT_THAT(send(other), IsEmpty());
  EXPECT_THAT(bytes(0x300, 4), ElementsAre(4, 5, 6, 0));
  map(0, 0x2A0, 0x7FF, 0x300, 0);  // a request to node 5
  hear("2A0#212223242526");
  EXPECT_THAT(bytes(0x300, 7), ElementsAre(0x21, 0x22, 0x23, 0x24, 0x25, 0x26, 0));
  hear("2A0#");
  map(0, 0x0A0, 0x7FF, 0x320, 0);  // a request to all, this node too
  hear("0A0#31");
  EXPECT_THAT(bytes(0x320, 1), Each(0));
  map(0, 0x2A0, 0x7FF, 0x300, 9);
  hear("2A0#4142434445464748");
  EXPECT_THAT(bytes(0x300, 1), Each(0x21));
  EXPECT_THAT(send("1FE#R8"), ElementsAre("5FE#0300000020020000"));  // STATE, 0A0
}

// RN-65: the lowest entry wins, though a frame be too short for it; an entry that is off does not.
TEST_F(PortMaps, TheLowestEntryWins) {
  map(1, 0x6A0, 0x7F0, 0x310, 4);
  map(7, 0x6A0, 0x7FF, 0x320, 1);
  hear("6A0#01020304");
  EXPECT_THAT(bytes(0x310, 2), ElementsAre(1, 2));
  EXPECT_THAT(bytes(0x320, 1), Each(0));
  hear("6A0#05");
  EXPECT_THAT(bytes(0x320, 1), Each(0));
  hear("6A3#11121314");
  EXPECT_THAT(bytes(0x313, 2), ElementsAre(0x11, 0x12));
  write(0xF89, 0x06);  // entry 1 off
  hear("6A0#05");
  EXPECT_THAT(bytes(0x320, 1), Each(5));
}

// RN-65: a port is taken only by an entry that compares all of A.
TEST_F(PortMaps, PortsNeedTheWholeA) {
  map(0, 0x6FE, 0x7FE, 0x300, 0);
  hear("6FE#01");
  EXPECT_THAT(bytes(0x300, 1), Each(0));
  map(0, 0x6FE, 0x07F, 0x300, 0);  // STATUS of everybody
  hear("6FE#02");
  EXPECT_THAT(bytes(0x300, 1), Each(2));
  hear("77E#03");
  EXPECT_THAT(bytes(0x300, 1), Each(3));
}

// RN-11, RN-65: a statement under the own number is told, and taken.
TEST_F(PortMaps, OwnStatements) {
  map(2, 0x5A0, 0x7FF, 0x300, 0);
  hear("5A0#77");
  EXPECT_THAT(bytes(0x300, 1), Each(0x77));
  EXPECT_THAT(send("1FE#R1"), ElementsAre("5FE#13"));
}

// RN-65: checks and WP hold; nothing is counted.
TEST_F(PortMaps, ChecksOfMapEntries) {
  write(0xF08, 0x40);  // page 6: 300..37F
  for (const unsigned address : {0x300U, 0x2FFU, 0xDFFU, 0xE00U, 0xF10U, 0xFF0U, 0xFFFU, 0x1000U}) {
    map(0, 0x6A0, 0x7FF, address, 0);
    EXPECT_THAT(send("6A0#0102"), IsEmpty());
  }
  EXPECT_THAT(bytes(0x2FF, 3), Each(0));
  EXPECT_THAT(bytes(0xDFF, 1), Each(0));
  EXPECT_THAT(bytes(0xF10, 2), Each(0));
  operate(false);
  hear("1FC#013412FECA");
  map(0, 0x6A0, 0x7FF, 0xF18, 0);
  hear("6A0#0102");
  EXPECT_THAT(bytes(0xF18, 2), ElementsAre(1, 2));
  EXPECT_THAT(send("1FE#R8"), ElementsAre("5FE#060000007C030000"));
}

// RN-45, RN-65, bit 5: the frame acts as a TRIGGER, for what it has written itself, too; user logic
// is told of both in one clock.
TEST_F(PortMaps, AFrameThatTriggers) {
  map(0, 0x6A0, 0x7FF, 0x010, 0x20);
  hear("190#AABBCC");
  (void)port->take_pulses();
  hear("6A0#0102");
  EXPECT_THAT(bytes(0x10, 3), ElementsAre(1, 2, 0xCC));
  EXPECT_THAT(port->take_pulses(),
              ElementsAre(RemotePulse{false, 0x10, 2}, RemotePulse{true, 0, 0}));
  EXPECT_EQ(port->peek(0xFF7), 1);
  hear("6A0#");
  EXPECT_THAT(port->take_pulses(), ElementsAre(RemotePulse{true, 0, 0}));
  operate(false);
  hear("6A0#03");
  EXPECT_THAT(port->take_pulses(), ElementsAre(RemotePulse{false, 0x10, 1}));
  EXPECT_THAT(bytes(0x10, 1), Each(1));
  EXPECT_EQ(port->peek(0xFF7), 3);
}

// RN-66: STALE from the time-out of an entry, within 10 ms, until its next frame.
TEST_F(PortMaps, Stale) {
  for (const unsigned k : {0U, 7U}) {
    map(k, 0x6A0, 0x7FF, 0x300, 2, 3);
    hear("6A0#0102");
    (void)wait(29);
    EXPECT_FALSE(stale());
    (void)wait(12);
    EXPECT_TRUE(stale());
    EXPECT_FALSE(port->safe());
    hear("6A0#01");  // too short
    EXPECT_TRUE(stale());
    hear("6A0#0102");
    EXPECT_FALSE(stale());
    (void)wait(29);
    EXPECT_FALSE(stale());
    (void)wait(12);
    EXPECT_TRUE(stale());
    write(0xF81 + 8 * k, 0);  // off
    (void)wait(11);
    EXPECT_FALSE(stale());
  }
}

// RN-66: a frame that another entry takes brings no time-out forward.
TEST_F(PortMaps, ATimeOutIsNotEarlyByAnotherEntry) {
  map(0, 0x6A0, 0x7FF, 0x300, 2, 3);
  map(1, 0x6B0, 0x7FF, 0x310, 2);
  for (unsigned phase = 0; phase < 10; ++phase) {
    hear("6A0#0102");
    (void)wait(29);
    hear("6B0#0304");
    port->clocks(300);
    EXPECT_FALSE(stale()) << phase;
    (void)wait(12);
    EXPECT_TRUE(stale()) << phase;
  }
}

// RN-66: nor that of the longest time-out, which is as long as the time that is counted; STALE
// stays while frames of the other entry are taken.
TEST_F(PortMaps, TheLongestTimeOutIsNotEarlyByAnotherEntry) {
  map(0, 0x6A0, 0x7FF, 0x300, 2, 255);
  map(1, 0x6B0, 0x7FF, 0x310, 2);
  hear("6A0#0102");
  for (unsigned ms = 2529; ms < 2549; ++ms) {
    (void)wait(ms == 2529 ? 2529 : 1);
    hear("6B0#0304");
    port->clocks(300);
    ASSERT_FALSE(stale()) << ms;
  }
  (void)wait(12);
  EXPECT_TRUE(stale());
  hear("6B0#0304");
  port->clocks(300);
  EXPECT_TRUE(stale());
}

// RN-66: the longest time-out; bit 6 leads to SAFE, and STATE 01 does not help for long.
TEST_F(PortMaps, StaleLeadsToSafe) {
  map(1, 0x6B0, 0x7FF, 0x310, 0x42, 255);
  hear("6B0#0102");
  (void)wait(2549);
  EXPECT_FALSE(port->safe());
  (void)wait(12);
  EXPECT_TRUE(port->safe());
  operate(true);
  (void)wait(11);
  EXPECT_TRUE(port->safe());
  hear("6B0#0102");
  (void)wait(12);
  EXPECT_TRUE(port->safe());  // it does not come back by itself
  operate(true);
  (void)wait(12);
  EXPECT_FALSE(port->safe());
}

// RN-66, RN-70: with AUTO_OP it does; RESTART begins the time-outs anew.
TEST_F(PortMaps, StaleWithAutoOperate) {
  map(0, 0x6A0, 0x7FF, 0x300, 0x41, 2);
  write(0xF01, 9);
  hear("000#81");
  port->clocks(300);
  (void)drain();
  EXPECT_FALSE(port->safe());
  (void)wait(19);
  EXPECT_FALSE(port->safe());
  (void)wait(12);
  EXPECT_TRUE(port->safe());
  EXPECT_TRUE(stale());
  hear("6A0#01");
  (void)wait(1);
  EXPECT_FALSE(port->safe());
  (void)wait(31);
  EXPECT_TRUE(port->safe());
  hear("000#81");
  port->clocks(300);
  (void)drain();
  EXPECT_FALSE(stale());
  EXPECT_FALSE(port->safe());
}

// RN-70, RN-72: but not while the node is bus-off.
TEST_F(PortMaps, NoAutoOperateInBusOff) {
  write(0xF01, 9);
  hear("000#81");
  port->clocks(300);
  port->set_counters(0, 0, false, true);
  (void)wait(25);
  EXPECT_TRUE(port->safe());
  port->set_counters(0, 0, false, false);
  port->clocks(64);
  EXPECT_FALSE(port->safe());
}

// RN-32: each bit of WP and RP protects its bytes, of the first and of the last byte of an access.
TEST_F(PortMaps, EveryBitProtects) {
  for (unsigned bit = 0; bit < 40; ++bit) {
    const bool fine = bit >= 32;
    const unsigned from = fine ? 16 * (bit - 32) : 128 * bit;
    const unsigned to = from + (fine ? 16 : 128);
    const bool there = fine || (bit >= 1 && bit <= 27);
    for (const unsigned table : {0xF08U, 0xF10U}) {
      write(0xF08, std::vector<unsigned>(16));
      write(table + bit / 8, 1U << bit % 8);
      for (const unsigned first : {from - 2, from - 1, from, to - 2, to - 1, to}) {
        if (first >= 0xDFF) continue;
        Frame ask = frame_of(table == 0xF08 ? "1F9#00000102" : "1F8#000002");
        ask.data[0] = static_cast<std::uint8_t>(first);
        ask.data[1] = static_cast<std::uint8_t>(first >> 8);
        port->receive(ask);
        (void)drain();
        const bool hit = there && first + 1 >= from && first < to;
        EXPECT_EQ(port->peek(0xFF3) == 0x10, hit) << std::hex << first << ' ' << bit;
        hear("1FC#04");  // code 0 again
      }
    }
  }
}

// RN-32: direct commands, too; 11 comes before 10, 10 before 6; a producer is not asked.
TEST_F(PortMaps, ProtectionOfTheWindow) {
  write(0xF0C, 0x04);  // 020..02F
  write(0xF14, 0x08);  // 030..03F
  EXPECT_THAT(send("1A0#05"), ElementsAre("5FE#0300001020010100"));
  EXPECT_THAT(send("19F#0506"), ElementsAre("5FE#030000101F010200"));
  EXPECT_THAT(send("1A0#R1"), ElementsAre("5A0#00"));
  EXPECT_THAT(send("1B0#05"), IsEmpty());
  EXPECT_THAT(send("1AF#R2"), ElementsAre("5FE#030000102F020300"));
  EXPECT_THAT(send("1FE#R4"), ElementsAre("5FE#03000010"));
  for (int i = 0; i < 4; ++i) hear("1A0#R1");
  hear("1B0#R1");
  EXPECT_EQ(port->peek(0xFF3), 0x10);
  (void)drain();
  write(0xF40, {0x30, 0x81, 0, 0, 0});
  port->event(1);
  port->clocks(200);
  EXPECT_THAT(drain(), ElementsAre("5B0#05"));
}

}  // namespace
}  // namespace vericansim
