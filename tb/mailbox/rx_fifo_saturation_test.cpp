// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rx FIFO at 8 clocks a bit on a full bus, while the CPU never pauses: the longest filter table and
// the shortest frames there are; nothing is lost and nothing comes twice (issue bar;
// flexcan.md 3.5, section 4).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "mailbox/rx_fifo_rig.hpp"
#include "model/frame_codec.hpp"

namespace vericansim {
namespace {

constexpr unsigned kReceiver = RxFifoRig::kReceiver, kSender = RxFifoRig::kSender;

enum class Hammer { kNone, kRead, kMixed, kLock, kCommand };
enum class Target { kFirstWord, kLastWord, kLastMailboxes };

using Case = std::tuple<Target, Hammer>;

/// Remote frames of 44 bits, without a stuff bit. A data frame has seven dominant bits in a row
/// from RTR to a DLC of 0 and is longer.
std::vector<Frame> shortest_frames(unsigned count) {
  std::vector<Frame> frames;
  for (Frame frame{.id = 0, .remote = true, .dlc = 5}; frames.size() < count; ++frame.id)
    if (encode_frame(frame).stuff_count == 0) frames.push_back(frame);
  return frames;
}

class FifoSaturation : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr unsigned kCount = 24;  // sender's buffers 0..23
  static constexpr unsigned kToy = 40;    // receiver's buffer for the CPU to play with

  FifoSaturation() : rig_{{.format = 0, .rffn = 15, .ctrl2 = reg::kCtrl2Rrs}} {
    const bool fifo = target_ != Target::kLastMailboxes;
    const unsigned hit = target_ == Target::kFirstWord ? 0 : 127;
    // Word 127 has RXFGMASK: REM only. Word 0 has RXIMR0.
    rig_.write(kReceiver, reg::kRxfgmask, 0x80000000);
    for (unsigned k = 0; k < 128; ++k)
      rig_.set_filter(k, {fifo && k == hit ? 0x80000000 : 0, 0x80000000});
    for (unsigned mb : {62u, 63u}) {
      rig_.write(kReceiver, reg::rximr(mb), 0);
      rig_.write(kReceiver, reg::mb(mb), fifo ? 0 : reg::kCodeRxEmpty);
    }
    rig_.join();
    for (unsigned k = 0; k < kCount; ++k) {
      rig_.write(kSender, reg::mb(k, 1), frames_[k].id << 18);
      start(k);
    }
  }

  void start(unsigned k) { rig_.write(kSender, reg::mb(k), mb_words(frames_[k], 0xC).cs); }

  AhbTransfer hammer() {
    const unsigned mb = rng_() % 64, word = rng_() % 4;
    switch (hammer_) {
      case Hammer::kLock:
        return {.address = rng_() % 8 == 0 ? reg::kTimer : reg::mb(rng_() % 62, 0)};
      case Hammer::kCommand:
        return {.address = reg::mb(kToy, rng_() % 4 == 0 ? 2 : 0),
                .write = true,
                .data = reg::kCodeTxInactive};
      case Hammer::kMixed:
        if (rng_() % 2 == 0)
          return {.address = reg::mb(kToy, word), .write = true, .data = reg::kCodeTxInactive};
        return {.address = rng_() % 8 == 0 ? reg::kRxfir : reg::mb(rng_() % 62, word)};
      default: return {.address = reg::mb(mb, 1 + word % 3)};
    }
  }

  void serve_sender() {
    const std::uint32_t flags = rig_.read(kSender, reg::kIflag1);
    for (unsigned k = 0; k < kCount; ++k) {
      if (((flags >> k) & 1) == 0) continue;
      rig_.clear_flag(kSender, k);
      ++sent_[frames_[k].id];
      if (sending_) start(k);
    }
  }

  void count(const MbWords &words) {
    const Frame frame = mb_frame(words);
    EXPECT_TRUE(frame.remote && frame.dlc == 5) << std::hex << words.cs;
    ++received_[frame.id];
  }

  void serve_receiver() {
    const std::uint64_t flags = rig_.flags(kReceiver);
    EXPECT_EQ(flags & reg::kIflagFifoOvf, 0u);
    if ((flags & reg::kIflagFifo) != 0) {
      MbWords words{.cs = rig_.read(kReceiver, reg::mb(0)),
                    .id = rig_.read(kReceiver, reg::mb(0, 1))};
      EXPECT_EQ(rig_.read(kReceiver, reg::kRxfir), target_ == Target::kLastWord ? 127u : 0u);
      count(words);
      rig_.pop();
    }
    for (unsigned mb : {62u, 63u}) {
      if (((flags >> mb) & 1) == 0) continue;
      const MbWords words = rig_.get(kReceiver, mb);
      rig_.clear_flag(kReceiver, mb);
      rig_.read(kReceiver, reg::kTimer);
      EXPECT_EQ(words.code(), 2u) << "overrun";
      count(words);
    }
  }

  const Target target_ = std::get<0>(GetParam());
  const Hammer hammer_ = std::get<1>(GetParam());
  RxFifoRig rig_;
  std::mt19937 rng_{1};
  std::vector<Frame> frames_ = shortest_frames(kCount);
  std::map<std::uint32_t, unsigned> sent_, received_;
  bool sending_ = true;
};

// FX-4.b, FX-4.h, FX-3.5.l, FX-CTRL2.RFFN
TEST_P(FifoSaturation, NothingIsLostAndNothingComesTwice) {
  if (hammer_ != Hammer::kNone) rig_.hammer(kReceiver, [this] { return hammer(); });
  const Time start = rig_.bus().now(), end = start + 20 * kMillisecond;
  while (rig_.bus().now() < end && !HasFailure()) {
    serve_receiver();
    serve_sender();
  }
  unsigned total = 0;
  for (const auto &[id, times] : sent_) total += times;
  EXPECT_GT(total, 20u * 1000 / 48) << "the bus is full";
  sending_ = false;
  for (unsigned i = 0; i < 4 * kCount; ++i) {
    rig_.run(100);
    serve_receiver();
    serve_sender();
  }
  EXPECT_EQ(received_, sent_);
  EXPECT_FALSE(rig_.violated());
  EXPECT_LE(rig_.max_waits(), 1u);
  const auto transfers = rig_.node(kReceiver).ahb().checker().transfers();
  EXPECT_GT(transfers, hammer_ == Hammer::kNone ? 0u : 20u * 8000 / 3) << "it did hammer";
}

std::string name_of(const ::testing::TestParamInfo<Case> &test) {
  static constexpr const char *kTargets[] = {"FirstWord", "LastWord", "LastMailboxes"};
  static constexpr const char *kHammers[] = {"Quiet", "Reads", "Mixed", "Locks", "Commands"};
  const auto [target, hammer] = test.param;
  return std::string{kTargets[static_cast<unsigned>(target)]} +
         kHammers[static_cast<unsigned>(hammer)];
}

INSTANTIATE_TEST_SUITE_P(TargetAndHammer, FifoSaturation,
                         ::testing::Combine(::testing::Values(Target::kFirstWord, Target::kLastWord,
                                                              Target::kLastMailboxes),
                                            ::testing::Values(Hammer::kNone, Hammer::kRead,
                                                              Hammer::kMixed, Hammer::kLock,
                                                              Hammer::kCommand)),
                         name_of);

}  // namespace
}  // namespace vericansim
