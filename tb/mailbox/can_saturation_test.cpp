// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// 1 Mbit/s at 8 clocks a bit, every buffer in use, a saturated bus and a CPU that never pauses:
// nothing is lost, nothing is late (issue bar; flexcan.md 3.3, 3.5, 3.6).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <random>
#include <string>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

enum class Hammer { kNone, kRead, kMixed, kLock, kCommand, kToggleLast, kToggleFirst };

struct Case {
  const char *name;
  Hammer hammer;
  std::uint32_t timing;
};

// Buffers: 0 is a plaything of the CPU, 1..31 receive, 32..62 send, 63 is another plaything.
constexpr unsigned kFirstRx = 1, kFirstTx = 32, kCount = 31;

class Saturation : public ::testing::TestWithParam<Case> {
 protected:
  Saturation() : rig_{2} {}

  Frame make(unsigned n, unsigned k) {
    Frame frame;
    frame.extended = (k % 3) == 2;
    frame.id = 0x100 + 0x40 * n + k + (frame.extended ? 0x1234000 : 0);
    frame.dlc = k % 5 == 0 ? 0 : static_cast<std::uint8_t>(rng_() % 12);
    for (unsigned i = 0; i < frame.payload_size(); ++i)
      frame.data[i] = static_cast<std::uint8_t>(rng_());
    return frame;
  }

  void set_up() {
    for (unsigned n = 0; n < 2; ++n) {
      rig_.configure(n, {.ctrl = GetParam().timing});
      for (unsigned k = 0; k < kCount; ++k) rig_.put_rx(n, kFirstRx + k, make(1 - n, k));
    }
    const std::uint32_t toy = GetParam().hammer == Hammer::kToggleFirst ? 0u : 0x7FFu;
    for (unsigned n = 0; n < 2; ++n) {
      for (unsigned mb : {0u, 63u}) rig_.write(n, reg::mb(mb, 1), (toy + 2 * n) << 18);
      rig_.go(n);
    }
  }

  AhbTransfer hammer_transfer() {
    const unsigned mb = rng_() % 64, word = rng_() % 4;
    switch (GetParam().hammer) {
      case Hammer::kRead:  // no C/S word, no TIMER: no effect but contention
        return {.address = reg::mb(mb, 1 + word % 3)};
      case Hammer::kLock: return {.address = rng_() % 8 == 0 ? reg::kTimer : reg::mb(mb, 0)};
      case Hammer::kCommand:  // ERR005829 workaround without end, as fast as it goes
        return {.address = reg::mb(rng_() % 2 == 0 ? 0 : 63, rng_() % 4 == 0 ? 2 : 0),
                .write = true,
                .data = 0x08000000};
      case Hammer::kToggleLast:  // buffers activated and taken back without end
      case Hammer::kToggleFirst:
        return {.address = reg::mb(rng_() % 2 == 0 ? 0 : 63),
                .write = true,
                .data = rng_() % 2 == 0 ? 0x08000000u : 0x0C000000u};
      default:
        if (rng_() % 2 == 0)
          return {.address = reg::mb(rng_() % 2 == 0 ? 0 : 63, word),
                  .write = true,
                  .data = 0x08000000};
        return {.address = rng_() % 16 == 0 ? reg::kTimer : reg::mb(mb, word)};
    }
  }

  void send(unsigned n, unsigned k) {
    const Frame frame = make(n, k);
    expected_[n][k].push_back(frame);
    rig_.put_tx(n, kFirstTx + k, frame);
  }

  void serve(unsigned n) {
    const std::uint64_t flags = rig_.flags(n);
    for (unsigned k = 0; k < kCount; ++k) {
      if (((flags >> (kFirstRx + k)) & 1) != 0) receive(n, k);
    }
    for (unsigned k = 0; k < kCount; ++k) {
      if (((flags >> (kFirstTx + k)) & 1) == 0) continue;
      EXPECT_EQ(rig_.read(n, reg::mb(kFirstTx + k)) >> 24, 0x8u);
      rig_.clear_flag(n, kFirstTx + k);
      ++sent_[n][k];
    }
  }

  void receive(unsigned n, unsigned k) {
    const MbWords words = rig_.get(n, kFirstRx + k);
    rig_.clear_flag(n, kFirstRx + k);
    rig_.read(n, reg::kTimer);
    ++received_;
    auto &queue = expected_[1 - n][k];
    ASSERT_FALSE(queue.empty()) << "node " << n << " buffer " << k << " cs " << std::hex
                                << words.cs;
    EXPECT_EQ(words.code(), 2u) << "overrun in buffer " << k;
    EXPECT_EQ(mb_frame(words), queue.front()) << "node " << n << " buffer " << k;
    queue.pop_front();
  }

  // Gap between frames: bits of Int, Idle and Suspend between EOF7 and the next SOF or ID.
  class Gaps : public BusObserver {
   public:
    unsigned interests() const override { return kBits; }
    void on_bit(NodeId id, const BitRecord &bit) override {
      if (id != 0) return;
      const Field field = bit.at.field;
      if (field == Field::kInt || field == Field::kIdle || field == Field::kSuspend) {
        ++gap_;
      } else {
        if (gap_ != 0) ++gaps[std::min(gap_, 15u)];
        gap_ = 0;
      }
    }
    std::array<unsigned, 16> gaps{};

   private:
    unsigned gap_ = 0;
  };

  MailboxRig rig_;
  std::mt19937 rng_{1};
  std::array<std::array<std::deque<Frame>, kCount>, 2> expected_;
  std::array<std::array<unsigned, kCount>, 2> sent_{};
  std::uint64_t received_ = 0;
};

TEST_P(Saturation, NothingIsLostAndFramesAreThreeBitsApart) {  // IF-01, MO-06
  set_up();
  if (GetParam().hammer != Hammer::kNone)
    for (unsigned n = 0; n < 2; ++n) rig_.hammer(n, [this] { return hammer_transfer(); });
  Gaps gaps;
  std::array<std::array<unsigned, kCount>, 2> queued{};
  for (unsigned k = 0; k < kCount; ++k)
    for (unsigned n = 0; n < 2; ++n) send(n, k), queued[n][k] = 1;
  rig_.bus().add(gaps);
  // Frames of one buffer follow each other only when the receiver has taken the last one.
  const Time end = rig_.bus().now() + 60 * kMillisecond;
  while (rig_.bus().now() < end && !HasFailure()) {
    for (unsigned n = 0; n < 2; ++n) {
      serve(n);
      for (unsigned k = 0; k < kCount; ++k)
        if (sent_[n][k] == queued[n][k] && expected_[n][k].empty()) send(n, k), ++queued[n][k];
    }
  }
  rig_.bus().remove(gaps);
  EXPECT_GT(received_, 400u);
  EXPECT_GT(gaps.gaps[3], 300u);
  // Whoever withdraws the frame that is next, at the last moment, makes the one behind it late by
  // the time of a search; nobody else does.
  const unsigned late = GetParam().hammer == Hammer::kToggleFirst ? 12 : 3;
  std::fill(gaps.gaps.begin() + 3, gaps.gaps.begin() + late + 1, 0u);
  EXPECT_THAT(gaps.gaps, ::testing::Each(0u)) << "frames this number of bits apart";
  EXPECT_FALSE(rig_.violated());
  EXPECT_LE(rig_.max_waits(), 1u);
  const auto transfers = rig_.node(0).ahb().checker().transfers();
  EXPECT_GT(transfers, GetParam().hammer == Hammer::kNone ? 0u : 60u * 8000 / 3) << "it did hammer";
  for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(rig_.read(n, reg::kEcr), 0u);
}

// PROP, PS1, PS2 of eight quanta from one end to the other, SJW from 1 to its largest.
constexpr std::uint32_t timing(unsigned prop, unsigned ps1, unsigned ps2, unsigned sjw) {
  return ((sjw - 1) << 22) | ((ps1 - 1) << 19) | ((ps2 - 1) << 16) | (prop - 1);
}

INSTANTIATE_TEST_SUITE_P(
    EveryHammer, Saturation,
    ::testing::Values(Case{"Quiet", Hammer::kNone, kTiming8},
                      Case{"Reads", Hammer::kRead, kTiming8},
                      Case{"Mixed", Hammer::kMixed, kTiming8},
                      Case{"Locks", Hammer::kLock, kTiming8},
                      Case{"Commands", Hammer::kCommand, kTiming8},
                      Case{"TogglesLast", Hammer::kToggleLast, kTiming8},
                      Case{"TogglesFirst", Hammer::kToggleFirst, kTiming8},
                      Case{"MixedShortPhases", Hammer::kMixed, timing(4, 1, 2, 1)},
                      Case{"MixedWideJump", Hammer::kMixed, timing(1, 3, 3, 3)},
                      Case{"LocksLatePoint", Hammer::kLock, timing(3, 2, 2, 2)}),
    [](const auto &test) { return std::string{test.param.name}; });

}  // namespace
}  // namespace vericansim
