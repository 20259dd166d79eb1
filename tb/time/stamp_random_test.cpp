// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random frames and software that looks, locks and lets go at any clock: every frame is read with
// its own stamp, and none waits for the next one's: TM-20, TM-24 to TM-29.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/frame_codec.hpp"
#include "time/stamp_rule.hpp"
#include "time/stamp_traffic.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

constexpr unsigned kClocksPerBit = 8, kSamplePoint = 6, kSync = 2;
constexpr unsigned kPointEof = 2, kTxpin = 4;

class StampRandom : public StampTraffic {
 protected:
  StampRandom() : StampTraffic{std::vector<ClockConfig>(2)} {}

  /// The attempt that succeeded began at the fall of the transmit flip-flop that lies before the
  /// sample point of EOF6 by what the frame's bits take.
  void note(const Frame &frame, unsigned mb) override {
    const std::vector<WireBit> bits = encode_frame(frame).bits;
    const std::uint64_t valid = time_.node(0).valids().back();
    const std::uint64_t length = kClocksPerBit * (bits.size() - 2) + kSamplePoint;
    const auto &falls = time_.node(0).falls();
    const auto sof = std::find_if(falls.begin(), falls.end(), [&](std::uint64_t fall) {
      return fall + length == valid || fall + length + 1 == valid;
    });
    ASSERT_NE(sof, falls.end()) << number_;
    const unsigned point = tctrl_ & 3;
    const std::size_t bit = point == 0 ? 0 : reference_bit(bits);
    const std::uint64_t edge = (*sof + kClocksPerBit * bit) * kTimeStep;
    sent_[mb] = edge + ((tctrl_ & kTxpin) != 0 ? kSync * kTimeStep : 0);
    received_[number_] = {edge + kSync * kTimeStep};
    if (point != kPointEof) return;
    sent_[mb] = valid * kTimeStep;
    received_[number_] = {time_.node(1).valids().back() * kTimeStep};
  }
};

TEST_P(StampRandom, EveryFrameWithItsOwn) {
  run(60);
  // TM-29: nothing of it outlives a hard reset.
  for (unsigned n = 0; n < 2; ++n) rig_.node(n).reset();
  rig_.run(400);
  for (unsigned mb = 0; mb < 64; ++mb)
    for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(time_.stamp(n, mb), 0u) << n << ' ' << mb;
}

INSTANTIATE_TEST_SUITE_P(Seeds, StampRandom, testing::Range(1u, 17u));

}  // namespace
}  // namespace vericansim
