// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Which frames of a node's software were none on the bus.
#include "simulation/sent_frames.hpp"

#include <gtest/gtest.h>

namespace vericansim {
namespace {

constexpr Time kBit = 2 * kMicrosecond;
constexpr Frame kA{.id = 1}, kB{.id = 2};

TEST(SentFrames, SoftwareTellsBeforeOrBehindTheBus) {
  SentFrames frames{kBit};
  frames.told(kA, 100 * kBit);
  frames.seen(kA, 103 * kBit);
  frames.seen(kB, 200 * kBit);
  frames.told(kB, 205 * kBit);
  EXPECT_TRUE(frames.lost(1000 * kBit).empty());
}

// Interrupts are served late, and buffers in the order of their numbers.
TEST(SentFrames, SoftwareMayTellLateAndInAnotherOrder) {
  SentFrames frames{kBit};
  frames.seen(kA, 100 * kBit);
  frames.seen(kB, 150 * kBit);
  frames.seen(kA, 200 * kBit);
  frames.told(kB, 400 * kBit);
  frames.told(kA, 401 * kBit);
  frames.told(kA, 402 * kBit);
  EXPECT_TRUE(frames.lost(1000 * kBit).empty());
}

TEST(SentFrames, WhatTheBusHasNotHadIsLostOnce) {
  SentFrames frames{kBit};
  frames.told(kA, 100 * kBit);
  EXPECT_TRUE(frames.lost(119 * kBit).empty()) << "the bus may tell of it still";
  frames.seen(kA, 200 * kBit);  // the next one that is alike
  frames.told(kA, 201 * kBit);
  EXPECT_EQ(frames.lost(202 * kBit), std::vector<Frame>{kA});
  EXPECT_TRUE(frames.lost(1000 * kBit).empty());
}

}  // namespace
}  // namespace vericansim
