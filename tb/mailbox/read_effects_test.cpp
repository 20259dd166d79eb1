// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a read of each word of the register window does to the locks of the buffers: C/S words of
// mailboxes and TIMER have an effect, and nothing else has one (flexcan.md 3.6, 4).
#include <gtest/gtest.h>

#include <ios>
#include <ostream>
#include <string>
#include <vector>

#include "harness/core_build.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kWindow = 0x2000;   ///< bytes
constexpr unsigned kFirstBehindFifo = 8;    ///< RFFN = 0
constexpr unsigned kMb = 10, kSender = 14;  ///< of the core under test; of the other one
constexpr unsigned kFull = 2, kOverrun = 6;

struct Setting {
  std::string name;
  CoreBuild build;
  bool fifo = false;
  friend std::ostream &operator<<(std::ostream &out, const Setting &one) { return out << one.name; }
};

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const CoreBuild &listed :
       {CoreBuild{"full16", 16}, CoreBuild{"full64", 64},
        CoreBuild{"time", 64, {.time_unit = true}}, core_build("small"), core_build("standard")}) {
    const CoreBuild &build = build_of_test(listed);
    all.push_back({.name = listed.name, .build = build});
    if (build.features.fifo) {
      all.push_back({.name = std::string{listed.name} + "_fifo", .build = build, .fifo = true});
    }
  }
  return all;
}

// Node 0 is the core under test, node 1 sends to it. The FIFO, if there is one, takes no frame.
class ReadEffects : public ::testing::TestWithParam<Setting> {
 protected:
  ReadEffects() : rig_{2, GetParam().build} {
    const bool own_masks = GetParam().build.features.own_masks;
    rig_.configure(0, {.mcr = reg::kMcrSrxDis | (own_masks ? reg::kMcrBcc : 0) |
                              (GetParam().fifo ? reg::kMcrFen | VERICAN_MCR_IDAM_MASK : 0)});
    rig_.configure(1);
    if (!own_masks) {
      for (const std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask}) {
        rig_.write(0, mask, ~0u);
      }
    }
    for (unsigned mb = 0; mb < rig_.num_mb(); ++mb) rig_.write(0, reg::mb(mb), 0);
    rig_.go(1);
  }

  [[nodiscard]] unsigned first() const { return GetParam().fifo ? kFirstBehindFifo : 0; }
  [[nodiscard]] bool is_mailbox_cs(std::uint32_t address) const {
    return address >= reg::mb(first()) && address < reg::mb(rig_.num_mb()) && address % 16 == 0;
  }
  static Frame numbered(unsigned number, unsigned mb = kMb) {
    return {.id = 0x100 + mb, .dlc = 1, .data = {static_cast<std::uint8_t>(number)}};
  }
  /// Sends a frame and runs until it and its move into the buffer are over.
  void send(const Frame &frame) {
    rig_.put_tx(1, kSender, frame);
    ASSERT_TRUE(rig_.wait_flag(1, kSender));
    rig_.clear_flag(1, kSender);
    rig_.run(60);
  }
  [[nodiscard]] unsigned number(unsigned mb) { return rig_.read(0, reg::mb(mb, 2)) >> 24; }

  MailboxRig rig_;
};

// FX-3.6.d, FX-3.6.e: nothing but these two ends a lock. FX-4.c: words of the FIFO neither.
TEST_P(ReadEffects, OthersLeaveTheLock) {
  rig_.put_rx(0, kMb, numbered(0));
  rig_.go(0);
  send(numbered(1));
  rig_.read(0, reg::mb(kMb));
  send(numbered(2));  // waits
  unsigned looked_at = 0;
  for (std::uint32_t address = 0; address < kWindow; address += 4) {
    if (address == reg::kTimer) continue;
    if (is_mailbox_cs(address) && address != reg::mb(kMb)) continue;
    rig_.read(0, address);
    rig_.run(30);
    ASSERT_EQ(number(kMb), 1u) << "moved in after the read of 0x" << std::hex << address;
    ++looked_at;
  }
  EXPECT_EQ(looked_at, kWindow / 4 - 1 - (rig_.num_mb() - first() - 1));
  rig_.read(0, reg::kTimer);
  rig_.run(30);
  EXPECT_EQ(number(kMb), 2u) << "it did wait";
}

// FX-3.6.d, FX-3.6.e, FX-3.6.h: TIMER, and the C/S word of every other mailbox, whatever it is for.
TEST_P(ReadEffects, TimerAndOtherMailboxesEndTheLock) {
  rig_.put_rx(0, kMb, numbered(0));
  rig_.go(0);
  unsigned count = 0;
  const auto ends = [&](std::uint32_t address) {
    send(numbered(++count));
    rig_.read(0, reg::mb(kMb));
    send(numbered(++count));
    ASSERT_EQ(number(kMb), (count - 1) % 256) << "not locked";
    rig_.read(0, address);
    rig_.run(30);
    ASSERT_EQ(number(kMb), count % 256)
        << "still locked after the read of 0x" << std::hex << address;
  };
  ends(reg::kTimer);
  for (unsigned mb = first(); mb < rig_.num_mb() && !HasFailure(); ++mb) {
    if (mb != kMb) ends(reg::mb(mb));
  }
}

// FX-3.6.a, FX-3.6.g: nothing else locks a buffer, or makes it serviced. Every mailbox holds a
// frame; a lock that a read takes by mistake and the next one ends makes its buffer serviced, and
// the last one stays.
TEST_P(ReadEffects, OthersLockNothing) {
  for (unsigned mb = first(); mb < rig_.num_mb(); ++mb) rig_.put_rx(0, mb, numbered(0, mb));
  rig_.go(0);
  for (unsigned mb = first(); mb < rig_.num_mb(); ++mb) send(numbered(1, mb));
  for (std::uint32_t address = 0; address < kWindow; address += 4) {
    if (address != reg::kTimer && !is_mailbox_cs(address)) rig_.read(0, address);
  }
  for (unsigned mb = first(); mb < rig_.num_mb(); ++mb) {
    send(numbered(2, mb));
    EXPECT_EQ(number(mb), 2u) << "buffer " << mb << " is locked";
  }
  for (unsigned mb = first(); mb < rig_.num_mb(); ++mb) {
    EXPECT_EQ((rig_.read(0, reg::mb(mb)) >> 24) & 0xF, kOverrun) << "buffer " << mb;
  }
  rig_.read(0, reg::kTimer);
  send(numbered(3, kMb));
  EXPECT_EQ((rig_.read(0, reg::mb(kMb)) >> 24) & 0xF, kFull) << "serviced by its own C/S word";
}

INSTANTIATE_TEST_SUITE_P(Builds, ReadEffects, ::testing::ValuesIn(settings()),
                         [](const auto &test) { return test.param.name; });

}  // namespace
}  // namespace vericansim
