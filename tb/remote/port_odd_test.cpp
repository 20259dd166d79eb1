// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Parameters of the RTL that no profile has, at the engine's port: a RAM of 1,024 bytes, no stage,
// map entries with NameBits 5.
#include "remote/port_fixture.hpp"
#include "remote/remote_entries.hpp"

namespace vericansim {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// 1,024 bytes, no stage.
class PortOdd : public PortFixture {
 protected:
  PortOdd() : PortFixture{3, 3, "odd"} {}
};

// RN-45, RN-46: nothing is staged, so a TRIGGER is told and counted, and changes no memory; one of
// a map entry neither.
TEST_F(PortOdd, ATriggerCopiesNothing) {
  (void)send("190#0102030405060708");
  (void)send("198#1112131415161718");
  const std::vector<unsigned> before = bytes(0x010, 16);
  EXPECT_THAT(before,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18));
  (void)port->take_pulses();
  write(map_at(0), map_bytes(0x6A0, 0x7FF, 0x100, 0x20));
  constexpr unsigned kCount = 0xFF7;  // RN-24
  unsigned count = 5;
  for (const char *trigger : {"001#05", "001#", "6A0#77", "6A0#"}) {
    hear(trigger);
    EXPECT_THAT(port->take_pulses(), ::testing::Contains(RemotePulse{true, 0, 0})) << trigger;
    EXPECT_EQ(bytes(0x010, 16), before) << trigger;
    EXPECT_EQ(port->peek(kCount), count++) << trigger;
  }
  EXPECT_THAT(bytes(0x100, 2), ElementsAre(0x77, 0));
}

// RN-53: words where no memory is cannot be written, and are read as 0; none of them is another.
TEST_F(PortOdd, WordsWithoutMemoryAreNoOthers) {
  std::vector<unsigned> before;
  for (unsigned address = 0xE00; address < 0x1000; ++address) before.push_back(port->peek(address));
  for (unsigned word = 0x200 / 4; word < 0xE00 / 4; ++word) {
    port->user_write(word, 0xDEADBEEF);
    EXPECT_EQ(port->user_read(word), 0U) << word;
  }
  EXPECT_THAT(bytes(0, 0x200), Each(0));
  EXPECT_EQ(bytes(0xE00, 0x200), before);
  port->user_write(0x1FC / 4, 0x01020304);
  EXPECT_EQ(port->user_read(0x1FC / 4), 0x01020304U);
}

/// NameBits 5, a stage of 16 bytes, 2,048 bytes; node 9.
class PortOddNames : public PortFixture {
 protected:
  PortOddNames() : PortFixture{5, 9, "odd"} {}
};

// RN-65: identifier bits 6:0 that are not compared are part of the address, also where two of them
// are of the name: one entry copies the windows of nodes 8 to 11, 20 bytes apart.
TEST_F(PortOddNames, AMapEntryAddsBitsOfTheName) {
  write(map_at(0), map_bytes(0x500, 0x780, 0x200, 0));
  EXPECT_THAT(send("501#01"), IsEmpty());
  EXPECT_THAT(send("541#020304"), IsEmpty());
  EXPECT_THAT(send("577#05"), IsEmpty());
  EXPECT_THAT(bytes(0x201, 2), ElementsAre(1, 0));
  EXPECT_THAT(bytes(0x241, 4), ElementsAre(2, 3, 4, 0));
  EXPECT_THAT(bytes(0x277, 2), ElementsAre(5, 0));
}

}  // namespace
}  // namespace vericansim
