// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// StampTraffic: random frames and software that looks, locks and lets go at any clock, for tests
// that know what the stamps must be.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "time/time_rig.hpp"

namespace vericansim {

/// Node 0 sends one frame after the other, node 1 receives. A frame's data is its number. The
/// parameter is a seed.
class StampTraffic : public testing::TestWithParam<unsigned> {
 protected:
  explicit StampTraffic(const std::vector<ClockConfig> &clocks, std::uint32_t ctrl = kTiming8)
      : random_{GetParam()},
        tctrl_{static_cast<std::uint32_t>(random_() % 8) | 0x30},
        time_{clocks},
        steps_{clocks[0] == clocks[1] ? 1U : 2U} {
    rig_.run(400);
    const bool fifo = GetParam() % 3 == 0;
    for (unsigned n = 0; n < 2; ++n) {
      rig_.configure(n,
                     {.mcr = reg::kMcrBcc | reg::kMcrSrxDis | (fifo && n == 1 ? reg::kMcrFen : 0),
                      .ctrl = ctrl});
      rig_.write(n, time_reg::kTctrl, tctrl_);
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
    prepare();
    const unsigned mb = sending_ = kFirstTx + static_cast<unsigned>(random_() % kTxBuffers);
    rig_.put_tx(0, mb, frame);
    const std::uint64_t flag = 1ULL << mb;
    while ((rig_.flags(0) & flag) == 0) software();
    rig_.clear_flag(0, mb);
    rig_.run(16 * steps_);  // node 1 has it, too
    note(frame, mb);
    newest_[frame.extended ? 1 : 0] = number_;
    EXPECT_EQ(time_.stamp(0, mb), sent_[mb]) << number_;
  }
  /// Called between two frames.
  virtual void prepare() {}
  /// Puts what the stamps of a frame that has been sent must be into sent_ and received_.
  virtual void note(const Frame &frame, unsigned mb) = 0;

  /// Sends `frames` of them and compares what software has seen.
  void run(unsigned frames) {
    for (unsigned i = 0; i < frames && !HasFailure(); ++i) send(next_frame());
    for (const Seen &seen : seen_) {
      ASSERT_TRUE(received_.contains(seen.number)) << seen.number;
      EXPECT_TRUE(received_[seen.number].contains(seen.stamp)) << seen.number;
    }
    EXPECT_GT(seen_.size(), frames / 3);
    EXPECT_GE(waited_, fifo_ ? 0u : frames / 12);
    for (const unsigned n : {0u, 1u}) rig_.hammer(n, nullptr);
  }

  // ---- Software
  static constexpr unsigned kFirstTx = 8, kTxBuffers = 4;
  static constexpr std::array<unsigned, 2> kRxBuffer{40, 41};  // of base and of extended frames
  struct Seen {
    std::uint32_t number;
    std::uint64_t stamp;
  };

  void software() {
    const auto kind = static_cast<unsigned>(random_() % 2);
    switch (random_() % 8) {
      case 0: hammer(static_cast<unsigned>(random_() % 2)); break;
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
  /// All of a node's AHB, or none from now on.
  void hammer(unsigned n) {
    rig_.hammer(n, nullptr);
    writes_ = static_cast<unsigned>(random_() % 9);
    if (random_() % 2 == 0) rig_.hammer(n, [this] { return transfer(); });
  }
  /// A read of a word of a stamp, or a write of a buffer that is not used.
  AhbTransfer transfer() {
    const auto random = static_cast<unsigned>(random_());
    if (random % 8 < writes_) return {.address = reg::mb(50, 2), .write = true, .data = random};
    return {.address = time_reg::stamp(kRxBuffer[random % 2]) + 4 * (random / 2 % 2)};
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
    rig_.run(100 * steps_);
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
  TimeRig time_;
  unsigned steps_;  // of the bus in a clock
  MailboxRig &rig_ = time_.rig;
  bool fifo_ = false;
  std::uint32_t number_ = 0;
  std::array<std::uint32_t, 2> newest_{};
  std::map<unsigned, std::uint64_t> sent_;                     // buffer of node 0 -> its stamp
  std::map<std::uint32_t, std::set<std::uint64_t>> received_;  // number -> stamps at node 1
  std::vector<Seen> seen_;
  unsigned sending_ = 0, waited_ = 0;
  unsigned writes_ = 0;  // of eight of those transfers
};

}  // namespace vericansim
