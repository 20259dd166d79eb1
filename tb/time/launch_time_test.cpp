// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Launch time of one buffer: TM-40 to TM-44 on the whole core.
#include <gtest/gtest.h>

#include <cstdint>

#include "time/time_node.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

constexpr std::uint32_t kHold = 1u << 31, kTxrel = 1u << 4, kHeld = 1u << 17;

Frame frame_of(std::uint32_t id) {
  Frame frame;
  frame.id = id;
  frame.dlc = 1;
  return frame;
}

class LaunchTime : public testing::Test {
 protected:
  LaunchTime() {
    rig_.run(400);
    for (unsigned n = 0; n < 2; ++n) rig_.configure(n);
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
    rig_.run(200);
  }
  /// Holds a buffer with a frame in it until `clocks` from now; returns T0 as an edge.
  std::uint64_t hold(unsigned mb, const Frame &frame, unsigned clocks) {
    const std::uint64_t edge = time_.node(0).edges() + clocks;
    rig_.write(0, kTtx, static_cast<std::uint32_t>(edge * kTimeStep));
    rig_.write(0, kTtxmb, kHold | mb);
    rig_.put_tx(0, mb, frame);
    return edge;
  }
  [[nodiscard]] std::uint64_t fall(std::size_t n) { return time_.node(0).falls().at(n); }

  TimeRig time_{2};
  MailboxRig &rig_ = time_.rig;
};

// TM-40, TM-42: SOF follows the first sample point at or behind T0 + 2 clocks, at every phase.
TEST_F(LaunchTime, FirstPossibleSof) {
  for (unsigned phase = 0; phase < 16; ++phase) {
    const std::size_t falls = time_.node(0).falls().size();
    const std::uint64_t t0 = hold(3, frame_of(0x100), 400 + phase);
    EXPECT_EQ(rig_.read(0, kTstat) & (kHeld | kTxrel), kHeld);
    EXPECT_EQ(rig_.read(0, kTtxmb), kHold | 3u);
    ASSERT_TRUE(rig_.wait_flag(0, 3));
    rig_.clear_flag(0, 3);
    EXPECT_EQ(rig_.read(0, kTstat) & (kHeld | kTxrel), kTxrel);
    EXPECT_EQ(rig_.read(0, kTtxmb), 3u);
    rig_.write(0, kTstat, kTxrel);
    // PHASE_SEG2 is 2 clocks, a bit 8.
    EXPECT_GE(fall(falls), t0 + 2) << phase;
    EXPECT_LE(fall(falls), t0 + 2 + 8 + 2) << phase;
    rig_.run(100 + phase * 3);
  }
}

// TM-41: every other buffer goes first, whatever the identifiers, in both orders of arbitration.
TEST_F(LaunchTime, OthersGoFirst) {
  const std::uint64_t t0 = hold(3, frame_of(0x001), 3000);
  for (const unsigned mb : {1u, 9u, 63u}) {
    rig_.put_tx(0, mb, frame_of(0x700));
    ASSERT_TRUE(rig_.wait_flag(0, mb)) << mb;
  }
  EXPECT_LT(time_.node(0).edges(), t0);
  EXPECT_EQ(rig_.flags(0) & 8u, 0u);
  ASSERT_TRUE(rig_.wait_flag(0, 3));
  EXPECT_GT(time_.node(0).edges(), t0);
}

// TM-40: T0 in the past releases at once; so does the CPU.
TEST_F(LaunchTime, Past) {
  hold(3, frame_of(0x001), 0);
  EXPECT_TRUE(rig_.wait_flag(0, 3, 1500));
  rig_.clear_flag(0, 3);
  hold(3, frame_of(0x001), 100000);
  EXPECT_FALSE(rig_.wait_flag(0, 3, 2000));
  rig_.write(0, kTtxmb, 3);
  EXPECT_TRUE(rig_.wait_flag(0, 3, 1500));
  EXPECT_EQ(rig_.read(0, kTstat) & kHeld, 0u);
}

// TM-43: with another frame waiting behind a busy bus, the identifier decides after T0 again.
TEST_F(LaunchTime, OrdinaryAfterwards) {
  rig_.put_rx(1, 5, frame_of(0x001), {});
  rig_.put_tx(0, 1, frame_of(0x010));  // on the bus at T0
  hold(3, frame_of(0x020), 200);
  rig_.put_tx(0, 2, frame_of(0x400));  // waits, and is worse than the one released
  ASSERT_TRUE(rig_.wait_flag(0, 1));
  ASSERT_TRUE(rig_.wait_flag(0, 3));
  EXPECT_EQ(rig_.flags(0) & 4u, 0u);
  EXPECT_TRUE(rig_.wait_flag(0, 2));
}

// TM-44: rewriting takes a held frame back.
TEST_F(LaunchTime, Rewritten) {
  hold(3, frame_of(0x001), 600);
  rig_.write(0, 0x80 + 16 * 3, 0x08000000);
  rig_.run(1500);
  EXPECT_EQ(rig_.flags(0) & 8u, 0u);
  EXPECT_EQ(rig_.read(0, kTstat) & (kHeld | kTxrel), kTxrel);
}

}  // namespace
}  // namespace vericansim
