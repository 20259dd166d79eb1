// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A node with a clock, at the engine's port: what the bus and user logic read of it (TM-108), and
// what the time unit is asked (TM-109).
#include <gtest/gtest.h>

#include "remote/frame_texts.hpp"
#include "remote/random_port.hpp"

namespace vericansim {
namespace {

constexpr unsigned kTimeExt = 1U << 7, kTimeRead = 1U << 8;  // can_pkg::TimeExt, TimeRead

std::array<std::uint8_t, 16> row_of(RandomHost &host) {
  std::array<std::uint8_t, 16> row{};
  for (auto &byte : row) byte = static_cast<std::uint8_t>(host.upto(256));
  return row;
}

/// A READ of `n` bytes from `address`, for node 3, and the bytes that come back.
std::vector<std::uint8_t> read(PortLockstep &pair, unsigned address, std::uint8_t n) {
  pair.receive(frame_of(
      0x1F8, {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(address >> 8), n}));
  for (unsigned bits = 0; bits < 8 && !pair.port().asks(); ++bits) pair.port().bit();
  if (!pair.port().asks()) return {};
  const Frame sent = pair.port().send();
  pair.model().attempt();
  pair.model().sent();
  if (sent.id != 0x5F8) return {};  // STATUS: it is refused
  return {sent.data.begin() + 2, sent.data.begin() + sent.dlc};
}

// Every byte of the row has its place, for the bus and for user logic; beside it nothing is.
TEST(PortTime, TheRowIsReadInPlaceOfTheRam) {
  PortLockstep pair{"time", 3, 3};
  pair.drain();
  std::array<std::uint8_t, 16> row{};
  for (unsigned i = 0; i < 16; ++i) row[i] = static_cast<std::uint8_t>(0xA0 + i);
  pair.user_write(remote_map::kClock / 4, 0xDEADBEEF, 0xF);
  pair.set_clock(row);
  for (unsigned i = 0; i < 16; ++i)
    EXPECT_EQ(read(pair, remote_map::kClock + i, 1), std::vector<std::uint8_t>{row[i]}) << i;
  EXPECT_EQ(read(pair, 0xFC4, 6), (std::vector<std::uint8_t>{0xA4, 0xA5, 0xA6, 0xA7, 0xA8, 0xA9}));
  EXPECT_EQ(read(pair, 0xFBF, 1), std::vector<std::uint8_t>{0});
  EXPECT_TRUE(read(pair, 0xFBF, 2).empty());
  EXPECT_TRUE(read(pair, 0xFCF, 2).empty());
  EXPECT_TRUE(read(pair, 0xFD0, 1).empty());
  for (unsigned word = 0; word < 4; ++word)
    EXPECT_EQ(pair.port().user_read(remote_map::kClock / 4 + word), 0xA3A2A1A0 + 0x04040404 * word);
  pair.port().clocks(3);  // the data stay, as those of the RAM do
  EXPECT_EQ(pair.port().read_data(), 0xAFAEADACU);
  EXPECT_EQ(pair.port().user_read(remote_map::kClock / 4 - 1), 0U);
  EXPECT_EQ(pair.port().user_read(remote_map::kClock / 4 + 4), 0U);
}

// RN-30: code 10, protected.
TEST(PortTime, TheBusDoesNotWriteTheRow) {
  PortLockstep pair{"time", 3, 3};
  pair.drain();
  pair.receive(frame_of(0x1F9, {0xC0, 0x0F, 0x55}));
  pair.drain();
  EXPECT_EQ(pair.compare(), "") << pair.history();
  EXPECT_EQ(pair.model().status().code, RemoteCode::kProtected);
}

// Commands of all kinds, the row changing all the time: the effects and answers of the model.
TEST(PortTime, CommandsHaveTheEffectsOfTheModel) {
  unsigned reads = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    PortLockstep pair{"time", 3, 3};
    RandomHost host{seed};
    for (unsigned i = 0; i < 500; ++i) {
      pair.set_clock(row_of(host));
      random_port_step(pair, host);
      if (host.once_in(4)) {
        const unsigned address = 0xFB8 + host.upto(32);
        reads += address >= remote_map::kClock && address < remote_map::kClock + 16;
        pair.drain();
        pair.receive(frame_of(0x1F8, {static_cast<std::uint8_t>(address), 0x0F,
                                      static_cast<std::uint8_t>(1 + host.upto(6))}));
      }
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
  EXPECT_GT(reads, 500U);
}

// A TRIGGER in OPERATE is stamped, one in SAFE is not; user logic asks by itself.
TEST(PortTime, TriggersAndUserLogicTakeTheTime) {
  PortLockstep pair{"time", 3, 3};
  pair.drain();
  (void)pair.port().take_time_commands();
  pair.receive(frame_of(0x001, {1}));
  EXPECT_EQ(pair.port().take_time_commands(), 0U);
  pair.receive(frame_of(0x000, {1}));
  pair.receive(frame_of(0x001, {2}));
  EXPECT_EQ(pair.port().take_time_commands(), kTimeExt);
  pair.port().take_time();
  pair.port().clock();
  EXPECT_EQ(pair.port().take_time_commands(), kTimeRead);
}

}  // namespace
}  // namespace vericansim
