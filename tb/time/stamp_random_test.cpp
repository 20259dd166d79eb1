// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random frames and software that looks, locks and lets go at any clock: every frame is read with
// its own stamp, and none waits for the next one's: TM-20, TM-24 to TM-29.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "model/frame_codec.hpp"
#include "time/stamp_rule.hpp"
#include "time/time_rig.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

constexpr unsigned kClocksPerBit = 8, kSamplePoint = 6, kSync = 2;
constexpr unsigned kPointEof = 2, kTxpin = 4;
constexpr unsigned kFirstTx = 8, kTxBuffers = 4;
constexpr std::array<unsigned, 2> kRxBuffer{40, 41};  // of base and of extended frames

/// Node 0 sends one frame after the other, node 1 receives. A frame's data is its number.
class StampRandom : public testing::TestWithParam<unsigned> {
 protected:
  StampRandom() : random_{GetParam()}, tctrl_{static_cast<std::uint32_t>(random_() % 8) | 0x30} {
    rig_.run(400);
    const bool fifo = GetParam() % 3 == 0;
    for (unsigned n = 0; n < 2; ++n) {
      rig_.configure(n,
                     {.mcr = reg::kMcrBcc | reg::kMcrSrxDis | (fifo && n == 1 ? reg::kMcrFen : 0)});
      rig_.write(n, kTctrl, tctrl_);
    }
    for (const unsigned kind : {0u, 1u})
      rig_.put_rx(1, kRxBuffer[kind], {.id = 0, .extended = kind == 1}, 0x40000000);
    fifo_ = fifo;
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
  }

  Frame next_frame() {
    ++number_;
    Frame frame{.extended = random_() % 2 == 0,
                .dlc = static_cast<std::uint8_t>(4 + random_() % 5)};
    frame.id = static_cast<std::uint32_t>(random_()) & (frame.extended ? 0x1FFFFFFF : 0x7FF);
    for (unsigned i = 0; i < 4; ++i)
      frame.data[i] = static_cast<std::uint8_t>(number_ >> (24 - 8 * i));
    return frame;
  }

  /// Sends it, with software at work beside it; notes what its stamps must be.
  void send(const Frame &frame) {
    const unsigned mb = sending_ = kFirstTx + static_cast<unsigned>(random_() % kTxBuffers);
    rig_.put_tx(0, mb, frame);
    const std::uint64_t flag = 1ULL << mb;
    while ((rig_.flags(0) & flag) == 0) software();
    rig_.clear_flag(0, mb);
    rig_.run(16);  // node 1 has it, too
    note(frame, mb);
    newest_[frame.extended ? 1 : 0] = number_;
    EXPECT_EQ(time_.stamp(0, mb), sent_[mb]) << number_;
  }
  /// The attempt that succeeded began at the fall of the transmit flip-flop that lies before the
  /// sample point of EOF6 by what the frame's bits take.
  void note(const Frame &frame, unsigned mb) {
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
    received_[number_] = edge + kSync * kTimeStep;
    if (point != kPointEof) return;
    sent_[mb] = valid * kTimeStep;
    received_[number_] = time_.node(1).valids().back() * kTimeStep;
  }

  // ---- Software of node 1
  struct Seen {
    std::uint32_t number;
    std::uint64_t stamp;
  };

  void software() {
    const auto kind = static_cast<unsigned>(random_() % 2);
    switch (random_() % 8) {
      case 0:  // all of its AHB, or none
        rig_.hammer(1, nullptr);
        if (random_() % 2 == 0) rig_.hammer(1, [this] { return AhbTransfer{.address = word()}; });
        break;
      case 1:
      case 2: look(kind); break;
      case 3: let_go(kind); break;
      case 4: others_keep_theirs(); break;
      case 5:
        if (fifo_) take_from_fifo();
        break;
      default: rig_.run(static_cast<unsigned>(random_() % 200)); break;
    }
  }
  /// A word of a stamp.
  std::uint32_t word() {
    const auto random = static_cast<unsigned>(random_());
    return stamp(kRxBuffer[random % 2]) + 4 * (random / 2 % 2);
  }
  /// Reads a buffer with its stamp, and leaves it locked.
  std::uint32_t look(unsigned kind) {
    const MbWords words = rig_.get(1, kRxBuffer[kind]);
    if ((words.code() & 1) != 0 || (words.code() != 2 && words.code() != 6)) return 0;
    seen_.push_back({words.low, time_.stamp(1, kRxBuffer[kind])});
    return words.low;
  }
  /// What waits for the buffer comes at once, whatever is on the bus.
  void let_go(unsigned kind) {
    const unsigned newest = newest_[kind];
    rig_.read(1, reg::kTimer);
    if (fifo_) return;
    rig_.run(100);
    const std::uint32_t number = look(kind);
    EXPECT_GE(number, newest);
    rig_.read(1, reg::kTimer);
    ++waited_;
  }
  void others_keep_theirs() {
    for (const auto &[mb, expected] : sent_) {
      if (mb == sending_) continue;
      EXPECT_EQ(time_.stamp(0, mb), expected) << mb;
    }
  }
  void take_from_fifo() {
    if ((rig_.flags(1) & 1U << 5) == 0) return;
    const MbWords words = rig_.get(1, 0);
    seen_.push_back({words.low, time_.stamp(1, 0)});
    rig_.clear_flag(1, 5);
  }

  std::mt19937 random_;
  std::uint32_t tctrl_;
  TimeRig time_{2};
  MailboxRig &rig_ = time_.rig;
  bool fifo_ = false;
  std::uint32_t number_ = 0;
  std::array<std::uint32_t, 2> newest_{};
  std::map<unsigned, std::uint64_t> sent_;           // buffer of node 0 -> its stamp
  std::map<std::uint32_t, std::uint64_t> received_;  // number -> stamp at node 1
  std::vector<Seen> seen_;
  unsigned sending_ = 0, waited_ = 0;
};

TEST_P(StampRandom, EveryFrameWithItsOwn) {
  for (unsigned i = 0; i < 60 && !HasFailure(); ++i) send(next_frame());
  for (const Seen &seen : seen_) {
    ASSERT_TRUE(received_.contains(seen.number)) << seen.number;
    EXPECT_EQ(seen.stamp, received_[seen.number]) << seen.number;
  }
  EXPECT_GT(seen_.size(), 20u);
  EXPECT_GE(waited_, fifo_ ? 0u : 5u);
  // TM-29: nothing of it outlives a hard reset.
  rig_.hammer(1, nullptr);
  for (unsigned n = 0; n < 2; ++n) rig_.node(n).reset();
  rig_.run(400);
  for (unsigned mb = 0; mb < 64; ++mb)
    for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(time_.stamp(n, mb), 0u) << n << ' ' << mb;
}

INSTANTIATE_TEST_SUITE_P(Seeds, StampRandom, testing::Range(1u, 17u));

}  // namespace
}  // namespace vericansim
