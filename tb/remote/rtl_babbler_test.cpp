// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that never pauses: RN-36, RN-37.
#include <gmock/gmock.h>

#include "remote/random_host.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

/// Clocks of the node, those in which user logic waits, and the longest wait.
class Waits : public BusObserver {
 public:
  explicit Waits(RemoteNode &node) : node_{node} {}
  [[nodiscard]] unsigned interests() const override { return kClocks; }
  void on_clock(NodeId node, Time, std::uint64_t) override {
    if (node != 2) return;
    ++clocks;
    wait_ = node_.ready() ? 0 : wait_ + 1;
    waited += wait_ != 0;
    longest = std::max(longest, wait_);
  }
  std::uint64_t clocks = 0, waited = 0;
  unsigned longest = 0;

 private:
  RemoteNode &node_;
  unsigned wait_ = 0;
};

// RN-36: commands without pause, right and wrong, at 8 clocks a bit: user logic loses 15 % of the
// RAM's clocks at most; 1 ms after the last frame a correct command works. RN-37, RN-50: it waits
// for 24 clocks at most.
TEST(RtlBabbler, LeavesUserLogicItsClocks) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  Waits waits{bus.node()};
  bus.bus.add(waits);
  RandomHost dice{1};
  for (unsigned i = 0; i < 2000; ++i) {
    while (bus.host.pending()) bus.run_bits(4);
    Frame frame = dice.frame();
    if (!frame.extended) frame.id &= 0x3FF;
    const bool leaves = frame.id == 3 || (frame.id == 0 && frame.data[0] == 0x81);
    if (!leaves) bus.host.request(frame);  // ASSIGN and RESTART would end it
  }
  bus.bus.remove(waits);
  EXPECT_LE(100 * waits.waited, 15 * waits.clocks);
  EXPECT_LE(waits.longest, 24U);
  bus.run_bits(1000);
  bus.host.received().clear();
  EXPECT_THAT(bus.send("1A0#R1"), ::testing::SizeIs(1));
}

// RN-36: the frames that cost most, writes of eight bytes, one after the other.
TEST(RtlBabbler, WritesOfEightBytesAreNoWorse) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  Waits waits{bus.node()};
  bus.bus.add(waits);
  for (unsigned i = 0; i < 500; ++i) {
    while (bus.host.pending()) bus.run_bits(1);
    bus.host.request(frame_of("1A0#0123456789ABCDEF"));
  }
  bus.bus.remove(waits);
  EXPECT_LE(100 * waits.waited, 15 * waits.clocks);
  EXPECT_GT(100 * waits.waited, waits.clocks);
  EXPECT_LE(waits.longest, 24U);
}

}  // namespace
}  // namespace vericansim
