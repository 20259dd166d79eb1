// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Launch time of one buffer: TM-40 to TM-44 on the whole core.
#include <gtest/gtest.h>

#include <cstdint>

#include "bus/faults.hpp"
#include "time/time_rig.hpp"

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

// TM-43: with another frame waiting behind a busy bus, the identifier decides after T0 again, also
// shortly before the frame on the bus ends.
TEST_F(LaunchTime, OrdinaryAfterwards) {
  for (unsigned i = 0; i < 12; ++i) {
    rig_.put_tx(0, 1, frame_of(0x010));  // on the bus at T0
    hold(3, frame_of(0x020), 250 + 15 * i);
    rig_.put_tx(0, 2, frame_of(0x400));  // waits, and is worse than the one released
    ASSERT_TRUE(rig_.wait_flag(0, 1));
    EXPECT_EQ(rig_.read(0, kTstat) & kTxrel, kTxrel) << i;
    ASSERT_TRUE(rig_.wait_flag(0, 3));
    EXPECT_EQ(rig_.flags(0) & 4u, 0u) << i;
    ASSERT_TRUE(rig_.wait_flag(0, 2));
    for (const unsigned mb : {1u, 2u, 3u}) rig_.clear_flag(0, mb);
    rig_.write(0, kTstat, kTxrel);
  }
}

// TM-43: a remote frame is on the bus at T0. While the buffer that answers it becomes one that is
// to be sent, the one that is released comes to the others, too, and goes first.
TEST_F(LaunchTime, ReleasedWhileAnAnswerComes) {
  Frame request = frame_of(0x7F0);
  request.remote = true;
  request.dlc = 0;
  for (int clocks = -16; clocks <= 4; ++clocks) {
    // Once to see when the remote frame becomes valid, once with T0 there.
    std::uint64_t valid = 0;
    for (const bool rehearsal : {true, false}) {
      rig_.put(0, 7, mb_words(frame_of(0x7F0), 0xA));
      rig_.run(300);
      const std::size_t frames = time_.node(0).valids().size();
      const std::uint64_t begin = time_.node(0).edges();
      const std::uint64_t t0 = rehearsal ? begin + 5000 : begin + valid + clocks;
      rig_.put_tx(1, 8, request);
      rig_.write(0, kTtx, static_cast<std::uint32_t>(t0 * kTimeStep));
      rig_.write(0, kTtxmb, kHold | 3);
      rig_.run(60);
      rig_.put_tx(0, 3, frame_of(0x020));
      rig_.put_tx(0, 2, frame_of(0x400));
      if (rehearsal) {
        ASSERT_TRUE(rig_.wait_flag(1, 8));
        valid = time_.node(0).valids().at(frames) - begin;
        rig_.write(0, kTtxmb, 3);
      } else {
        ASSERT_TRUE(rig_.wait_flag(0, 3)) << clocks;
        EXPECT_EQ(rig_.flags(0) & 4u, 0u) << clocks << " clocks from EOF6";
      }
      for (const unsigned mb : {2u, 3u, 7u}) ASSERT_TRUE(rig_.wait_flag(0, mb)) << mb;
      for (const unsigned mb : {2u, 3u, 7u}) rig_.clear_flag(0, mb);
      rig_.clear_flag(1, 8);
      rig_.write(0, kTstat, kTxrel);
    }
  }
}

// TM-41: a buffer that is held only when it waits already gives way from then on.
TEST_F(LaunchTime, HeldLater) {
  rig_.put_tx(1, 8, frame_of(0x005));  // on the bus meanwhile
  rig_.run(60);
  rig_.put_tx(0, 3, frame_of(0x020));
  rig_.put_tx(0, 2, frame_of(0x400));
  rig_.run(200);  // all that the writes have set off is over
  rig_.write(0, kTtx, static_cast<std::uint32_t>((time_.node(0).edges() + 3000) * kTimeStep));
  rig_.write(0, kTtxmb, kHold | 3);
  ASSERT_TRUE(rig_.wait_flag(0, 2));
  EXPECT_EQ(rig_.flags(0) & 8u, 0u);
  ASSERT_TRUE(rig_.wait_flag(0, 3));
}

// TM-42: at every number of clocks a bit from 8 to 96.
TEST_F(LaunchTime, EveryPrescaler) {
  for (const unsigned clocks : {2u, 3u, 5u, 8u, 12u}) {
    for (unsigned n = 0; n < 2; ++n) {
      ASSERT_TRUE(rig_.freeze(n, 40000));
      rig_.write(n, reg::kCtrl, kTiming8 | (clocks - 1) << 24);
    }
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
    for (unsigned phase = 0; phase < 8; ++phase) {
      rig_.run(400 * clocks + phase);
      const std::size_t falls = time_.node(0).falls().size();
      const std::uint64_t t0 = hold(3, frame_of(0x100), 300 + phase * clocks);
      ASSERT_TRUE(rig_.wait_flag(0, 3, 2000 * clocks));
      rig_.clear_flag(0, 3);
      EXPECT_GE(fall(falls), t0 + 2 * clocks) << clocks << ' ' << phase;
      EXPECT_LE(fall(falls), t0 + 10 * clocks + 2) << clocks << ' ' << phase;
    }
  }
}

// TM-43: a frame is on the bus at T0: SOF follows its intermission, and stamps tell how late.
TEST_F(LaunchTime, BusyBus) {
  for (unsigned n = 0; n < 2; ++n) rig_.write(n, kTctrl, 0x30);
  rig_.put_tx(1, 8, frame_of(0x555));
  rig_.run(100);
  const std::uint64_t t0 = hold(3, frame_of(0x100), 100);
  ASSERT_TRUE(rig_.wait_flag(0, 3));
  const std::uint64_t start = time_.stamp(0, 3) / kTimeStep;
  EXPECT_GT(start, t0);
  // EOF6 of the frame before, EOF7, three bits of intermission; SJW 1 either way.
  const std::uint64_t before = time_.node(0).valids().at(time_.node(0).valids().size() - 2);
  EXPECT_NEAR(static_cast<double>(start), static_cast<double>(before + 2 + 4 * 8), 2.0);
}

// TM-43: and it arbitrates as any other: a better frame of another node goes first.
TEST_F(LaunchTime, LosesArbitration) {
  rig_.put_tx(1, 9, frame_of(0x7F0));
  rig_.run(100);
  rig_.put_tx(1, 8, frame_of(0x050));
  hold(3, frame_of(0x100), 100);
  ASSERT_TRUE(rig_.wait_flag(1, 8));
  EXPECT_EQ(rig_.flags(0) & 8u, 0u);
  EXPECT_TRUE(rig_.wait_flag(0, 3));
}

// TM-44: abort of a held buffer: code 1001 and its flag, as of one that waits.
TEST_F(LaunchTime, AbortWhileHeld) {
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) | 1u << 12);  // AEN
  rig_.go(0);
  hold(3, frame_of(0x001), 3000);
  rig_.run(200);
  rig_.write(0, reg::mb(3, 0), 0x09000000);
  ASSERT_TRUE(rig_.wait_flag(0, 3, 400));
  EXPECT_EQ(rig_.read(0, reg::mb(3, 0)) >> 24, 9u);
  rig_.clear_flag(0, 3);
  rig_.run(4000);
  EXPECT_EQ(rig_.flags(0) & 8u, 0u);
}

// TM-44: freeze mode keeps HOLD; time releases it there too.
TEST_F(LaunchTime, Freeze) {
  const std::uint64_t t0 = hold(3, frame_of(0x001), 1500);
  ASSERT_TRUE(rig_.freeze(0));
  EXPECT_EQ(rig_.read(0, kTstat) & kHeld, kHeld);
  ASSERT_LT(time_.node(0).edges(), t0);
  rig_.run(1600);
  EXPECT_EQ(rig_.read(0, kTstat) & (kHeld | kTxrel), kTxrel);
  EXPECT_EQ(rig_.flags(0) & 8u, 0u);
  rig_.go(0);
  EXPECT_TRUE(rig_.wait_flag(0, 3));
}

// TM-44: so does bus-off, where time and the CPU release; what they release waits for recovery.
TEST_F(LaunchTime, BusOff) {
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kEcr, 250);
  rig_.go(0);
  rig_.run(200);
  const Time now = rig_.bus().now();
  LevelFault fault{0, Effect::kRecessive, {now, now + 50 * kMicrosecond}};
  rig_.bus().add(fault);
  const std::uint64_t t0 = hold(3, frame_of(0x001), 3000);
  rig_.put_tx(0, 8, frame_of(0x155));
  rig_.run(400);
  const auto waits_in_bus_off = [&](std::uint32_t status) {
    EXPECT_EQ(rig_.field(0), Field::kBusOff);
    EXPECT_EQ(rig_.read(0, kTstat) & (kHeld | kTxrel), status);
    EXPECT_EQ(rig_.flags(0), 0u);
  };
  waits_in_bus_off(kHeld);
  ASSERT_LT(time_.node(0).edges(), t0);
  rig_.run(3000);
  waits_in_bus_off(kTxrel);
  rig_.write(0, kTstat, kTxrel);
  hold(4, frame_of(0x002), 100000);
  rig_.run(1000);
  waits_in_bus_off(kHeld);
  rig_.write(0, kTtxmb, 4);
  rig_.run(1000);
  waits_in_bus_off(0);
  for (const unsigned mb : {3u, 4u, 8u}) EXPECT_TRUE(rig_.wait_flag(0, mb, 12000)) << mb;
}

// TM-44: one attempt, at T0, of a held buffer that asks for one, on a bus without acknowledge.
TEST_F(LaunchTime, OneShot) {
  ASSERT_TRUE(rig_.freeze(1));
  ASSERT_TRUE(rig_.freeze(0));
  rig_.write(0, reg::kExtControl, 1u << 2);  // OSMB
  rig_.go(0);
  rig_.run(200);
  MbWords words = mb_words(frame_of(0x001), 0xC);
  words.cs |= 1u << 28;
  const std::uint64_t t0 = time_.node(0).edges() + 1500;
  rig_.write(0, kTtx, static_cast<std::uint32_t>(t0 * kTimeStep));
  rig_.write(0, kTtxmb, kHold | 3);
  rig_.put(0, 3, words);
  EXPECT_FALSE(rig_.wait_flag(0, 3, 1200));
  ASSERT_TRUE(rig_.wait_flag(0, 3));
  EXPECT_GT(time_.node(0).edges(), t0);
  EXPECT_EQ(rig_.read(0, reg::mb(3, 0)) >> 24 & 0xF, 9u);
  EXPECT_EQ(rig_.read(0, reg::kEcr) & 0xFF, 8u);
  rig_.run(2000);
  EXPECT_EQ(rig_.read(0, reg::kEcr) & 0xFF, 8u);
}

// TM-44: rewriting takes a held frame back, before it is loaded and after: nothing is sent of it.
TEST_F(LaunchTime, Rewritten) {
  const std::size_t falls = time_.node(0).falls().size();
  for (const unsigned wait : {0u, 3u, 10u, 30u, 300u}) {
    hold(3, frame_of(0x001), 600);
    rig_.run(wait);
    rig_.write(0, reg::mb(3, 0), 0x08000000);
    rig_.run(1500);
    EXPECT_EQ(rig_.flags(0) & 8u, 0u);
    EXPECT_EQ(rig_.read(0, kTstat) & (kHeld | kTxrel), kTxrel);
    EXPECT_EQ(time_.node(0).falls().size(), falls) << wait;
    rig_.write(0, kTstat, kTxrel);
  }
}

// TM-44: of a held buffer that is written anew, the new frame alone is sent, at T0.
TEST_F(LaunchTime, RewrittenWithAnother) {
  for (const unsigned wait : {0u, 3u, 10u, 30u, 300u}) {
    rig_.put_rx(1, 40, frame_of(0x123));
    const std::uint64_t t0 = hold(3, frame_of(0x001), 600);
    rig_.run(wait);
    rig_.put_tx(0, 3, frame_of(0x123));
    const std::size_t frames = time_.node(0).valids().size();
    ASSERT_TRUE(rig_.wait_flag(0, 3)) << wait;
    EXPECT_GE(time_.stamp(0, 3) / kTimeStep, t0);
    rig_.run(1500);
    EXPECT_EQ(time_.node(0).valids().size(), frames + 1) << wait;
    EXPECT_NE(rig_.flags(1) & (std::uint64_t{1} << 40), 0u) << wait;
    for (const unsigned n : {0u, 1u}) rig_.clear_flag(n, n == 0 ? 3 : 40);
    rig_.write(0, kTstat, kTxrel);
  }
}

}  // namespace
}  // namespace vericansim
