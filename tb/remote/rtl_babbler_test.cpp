// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that never pauses: RN-36, RN-37. The campaign has ten seconds of it.
#include <gmock/gmock.h>

#include <ostream>

#include "remote/babbler.hpp"
#include "remote/remote_entries.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

class RtlBabbler : public ::testing::TestWithParam<const char *> {};

// RN-36: all commands without pause, right, wrong and broken, at 8 clocks a bit: user logic loses
// 15 % of the RAM's clocks at most; 1 ms after the last frame a correct command works. RN-37,
// RN-50: it waits for 24 clocks at most.
TEST_P(RtlBabbler, LeavesUserLogicItsClocks) {
  const BabbleResult result = babble(GetParam(), 1, 250'000);
  EXPECT_LE(result.lost(), 15);
  EXPECT_GT(result.lost(), 1);
  EXPECT_LE(result.longest_wait, 24U);
  EXPECT_TRUE(result.answers);
  // It was a host that never pauses: but for the intermission, and behind errors.
  EXPECT_GE(result.frames, result.bits / 160);
  EXPECT_GT(result.broken, 50U);
  EXPECT_LE(100 * result.idle_bits, 2 * result.bits);
}
INSTANTIATE_TEST_SUITE_P(Profiles, RtlBabbler, ::testing::Values("small", "standard", "full"),
                         [](const auto &one) { return std::string{one.param}; });

// What frames of one kind cost node 3, each right behind the one before.
BabbleResult babble_of(RtlBus &bus, const std::string &frame) {
  BabbleResult result;
  UserWaits waits{bus.node(), 2, result};
  bus.bus.add(waits);
  for (unsigned i = 0; i < 500; ++i) {
    while (bus.host.waiting() < 4) bus.host.request(frame_of(frame));
    bus.run_bits(100);
  }
  bus.bus.remove(waits);
  return result;
}

// RN-36: of frames that find the tables empty, those that cost most: writes of eight bytes.
TEST(RtlBabblerOfWrites, OfEightBytesIsNoWorse) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  const BabbleResult result = babble_of(bus, "1A0#0123456789ABCDEF");
  EXPECT_LE(result.lost(), 15);
  EXPECT_GT(result.lost(), 1);
  EXPECT_LE(result.longest_wait, 24U);
  EXPECT_LE(result.idle_bits, 1U);  // before the first
}

void put_entry(RemoteNode &node, unsigned address, const std::vector<unsigned> &bytes) {
  for (unsigned n = 0; n < bytes.size(); ++n)
    node.user_write((address + n) / 4, bytes[n] << 8 * (n % 4), 1U << n % 4);
}

struct Tables {
  const char *name, *frame;
  bool producers, map;  // all eight entries

  friend void PrintTo(const Tables &tables, std::ostream *out) { *out << tables.name; }
};

class RtlBabblerOfTables : public ::testing::TestWithParam<Tables> {};

// RN-36: each frame is a TRIGGER, with which all producers are due, or one that the last map entry
// takes as a TRIGGER.
TEST_P(RtlBabblerOfTables, LeavesUserLogicItsClocks) {
  RtlBus bus{rtl_unit(3, RemoteConfig::profile("standard"))};
  (void)bus.start();
  constexpr unsigned kActs = 0x20;
  for (unsigned k = 0; k < 8; ++k) {
    if (GetParam().producers)
      put_entry(bus.node(), producer_at(k),
                producer_bytes(8 * k, mode::kOn | mode::kTriggers | mode::kCyclic | 8, 1));
    if (GetParam().map)
      put_entry(bus.node(), map_at(k), map_bytes(k == 7 ? 0x4A0 : 0x480 + k, 0x7FF, 0x300, kActs));
  }
  (void)bus.send("000#01");
  const BabbleResult result = babble_of(bus, GetParam().frame);
  EXPECT_LE(result.lost(), 40);
  EXPECT_GT(result.lost(), 15);  // or the entries were not due
  EXPECT_LE(result.longest_wait, 24U);
  EXPECT_LE(100 * result.idle_bits, 2 * result.bits);
  bus.host.cancel();
  (void)bus.settle();
  bus.run_bits(1000);
  for (const char *command : {"000#02", "002#0000000000000000", "003#03"}) (void)bus.send(command);
  EXPECT_EQ(bus.send("1A0#R1").size(), 1U);
}
INSTANTIATE_TEST_SUITE_P(Due, RtlBabblerOfTables,
                         ::testing::Values(Tables{"Producers", "001#", true, false},
                                           Tables{"Map", "4A0#01", false, true},
                                           Tables{"Both", "4A0#01", true, true}),
                         [](const auto &one) { return std::string{one.param.name}; });

}  // namespace
}  // namespace vericansim
