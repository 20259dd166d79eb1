// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// 1 Mbit/s at 8 clocks a bit, every buffer in use, a saturated bus and a CPU that never pauses:
// nothing is lost, nothing is late (issue bar; flexcan.md 3.3, 3.5, 3.6). So it is with the masks
// in a memory of their own and, in the smallest profile, among the buffers' words (PK-44).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <random>
#include <string>
#include <tuple>

#include "harness/core_build.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

enum class Hammer { kNone, kRead, kMixed, kLock, kCommand, kToggleLast, kToggleFirst };

struct Case {
  const char *name;
  Hammer hammer;
  std::uint32_t timing;
};

// Buffers: the first is a plaything of the CPU and so is the last; of those between them one half
// receives and the other sends.
constexpr unsigned kMostCount = 31;  // of a half

class Saturation : public ::testing::TestWithParam<std::tuple<CoreBuild, Case>> {
 protected:
  static const CoreBuild &build() { return build_of_test(std::get<0>(GetParam())); }
  static const Case &hammer_case() { return std::get<1>(GetParam()); }
  static Hammer hammer() { return hammer_case().hammer; }

  /// The bits of ID words that the mask of a receive buffer leaves open: a frame that has them and
  /// is held against another mask is lost. 0 where every buffer has a mask of its own, of ones.
  [[nodiscard]] std::uint32_t open_bits(unsigned k) const {
    if (build().features.own_masks) return 0;
    const unsigned mb = first_rx_ + k;
    return mb == 14 ? kOpenIn14 : mb == 15 ? kOpenIn15 : kOpenInOthers;
  }

  Frame make(unsigned n, unsigned k) {
    Frame frame;
    frame.extended = (k % 3) == 2;
    frame.id = 0x100 + 0x40 * n + k + (frame.extended ? 0x1234000 : 0);
    const std::uint32_t open = open_bits(k);
    if (open != 0 && rng_() % 2 == 0) frame.id |= frame.extended ? open : open >> 18;
    frame.dlc = k % 5 == 0 ? 0 : static_cast<std::uint8_t>(rng_() % 12);
    for (unsigned i = 0; i < frame.payload_size(); ++i)
      frame.data[i] = static_cast<std::uint8_t>(rng_());
    return frame;
  }

  void set_up() {
    for (unsigned n = 0; n < 2; ++n) {
      rig_.configure(n, {.ctrl = hammer_case().timing});
      if (!build().features.clear_ram) clear_ram(n);
      if (!build().features.own_masks) set_masks(n);
      for (unsigned k = 0; k < count_; ++k) rig_.put_rx(n, first_rx_ + k, make(1 - n, k));
    }
    const std::uint32_t toy = hammer() == Hammer::kToggleFirst ? 0u : 0x7FFu;
    for (unsigned n = 0; n < 2; ++n) {
      for (unsigned mb : {0u, last_}) rig_.write(n, reg::mb(mb, 1), (toy + 2 * n) << 18);
      rig_.go(n);
    }
  }
  void clear_ram(unsigned n) {
    for (unsigned mb = 0; mb <= last_; ++mb) rig_.put(n, mb, {});
  }
  void set_masks(unsigned n) {
    rig_.write(n, reg::kRxgmask, ~kOpenInOthers);
    rig_.write(n, reg::kRx14mask, ~kOpenIn14);
    rig_.write(n, reg::kRx15mask, ~kOpenIn15);
  }

  AhbTransfer hammer_transfer() {
    const unsigned mb = rng_() % (last_ + 1), word = rng_() % 4;
    switch (hammer()) {
      case Hammer::kRead:  // no C/S word, no TIMER: no effect but contention
        return {.address = reg::mb(mb, 1 + word % 3)};
      case Hammer::kLock: return {.address = rng_() % 8 == 0 ? reg::kTimer : reg::mb(mb, 0)};
      case Hammer::kCommand:  // ERR005829 workaround without end, as fast as it goes
        return {.address = reg::mb(rng_() % 2 == 0 ? 0 : last_, rng_() % 4 == 0 ? 2 : 0),
                .write = true,
                .data = 0x08000000};
      case Hammer::kToggleLast:  // buffers activated and taken back without end
      case Hammer::kToggleFirst:
        return {.address = reg::mb(rng_() % 2 == 0 ? 0 : last_),
                .write = true,
                .data = rng_() % 2 == 0 ? 0x08000000u : 0x0C000000u};
      default:
        if (rng_() % 2 == 0)
          return {.address = reg::mb(rng_() % 2 == 0 ? 0 : last_, word),
                  .write = true,
                  .data = 0x08000000};
        return {.address = rng_() % 16 == 0 ? reg::kTimer : reg::mb(mb, word)};
    }
  }

  void send(unsigned n, unsigned k) {
    const Frame frame = make(n, k);
    expected_[n][k].push_back(frame);
    rig_.put_tx(n, first_tx_ + k, frame);
  }

  void serve(unsigned n) {
    const std::uint64_t flags = rig_.flags(n);
    for (unsigned k = 0; k < count_; ++k) {
      if (((flags >> (first_rx_ + k)) & 1) != 0) receive(n, k);
    }
    for (unsigned k = 0; k < count_; ++k) {
      if (((flags >> (first_tx_ + k)) & 1) == 0) continue;
      EXPECT_EQ(rig_.read(n, reg::mb(first_tx_ + k)) >> 24, 0x8u);
      rig_.clear_flag(n, first_tx_ + k);
      ++sent_[n][k];
    }
  }

  void receive(unsigned n, unsigned k) {
    const MbWords words = rig_.get(n, first_rx_ + k);
    rig_.clear_flag(n, first_rx_ + k);
    rig_.read(n, reg::kTimer);
    ++received_;
    auto &queue = expected_[1 - n][k];
    ASSERT_FALSE(queue.empty()) << "node " << n << " buffer " << k << " cs " << std::hex
                                << words.cs;
    EXPECT_EQ(words.code(), 2u) << "overrun in buffer " << k;
    EXPECT_EQ(mb_frame(words), queue.front()) << "node " << n << " buffer " << k;
    queue.pop_front();
  }

  /// What is under way arrives, all of it.
  void drain() {
    const auto left = [this] {
      std::size_t count = 0;
      for (const auto &queues : expected_)
        for (const auto &queue : queues) count += queue.size();
      return count;
    };
    const Time end = rig_.bus().now() + 20 * kMillisecond;
    while (left() != 0 && rig_.bus().now() < end && !HasFailure())
      for (unsigned n = 0; n < 2; ++n) serve(n);
    EXPECT_EQ(left(), 0u) << "frames that were lost";
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

  // No frame has one of these by itself.
  static constexpr std::uint32_t kOpenInOthers = 1u << 27, kOpenIn14 = 1u << 28,
                                 kOpenIn15 = kOpenInOthers | kOpenIn14;

  MailboxRig rig_{2, build()};
  unsigned last_ = build().num_mb - 1, count_ = last_ / 2;
  // Of 16 buffers the upper half receives: buffer 14, which may have another mask, too.
  bool rx_first_ = last_ != 15;
  unsigned first_rx_ = rx_first_ ? 1 : 1 + count_, first_tx_ = rx_first_ ? 1 + count_ : 1;
  std::mt19937 rng_{1};
  std::array<std::array<std::deque<Frame>, kMostCount>, 2> expected_;
  std::array<std::array<unsigned, kMostCount>, 2> sent_{};
  std::uint64_t received_ = 0;
};

TEST_P(Saturation, NothingIsLostAndFramesAreThreeBitsApart) {  // IF-01, MO-06
  set_up();
  if (hammer() != Hammer::kNone)
    for (unsigned n = 0; n < 2; ++n) rig_.hammer(n, [this] { return hammer_transfer(); });
  Gaps gaps;
  std::array<std::array<unsigned, kMostCount>, 2> queued{};
  for (unsigned k = 0; k < count_; ++k)
    for (unsigned n = 0; n < 2; ++n) send(n, k), queued[n][k] = 1;
  rig_.bus().add(gaps);
  // Frames of one buffer follow each other only when the receiver has taken the last one.
  const Time end = rig_.bus().now() + 60 * kMillisecond;
  while (rig_.bus().now() < end && !HasFailure()) {
    for (unsigned n = 0; n < 2; ++n) {
      serve(n);
      for (unsigned k = 0; k < count_; ++k)
        if (sent_[n][k] == queued[n][k] && expected_[n][k].empty()) send(n, k), ++queued[n][k];
    }
  }
  rig_.bus().remove(gaps);
  EXPECT_GT(received_, 400u);
  for (unsigned n = 0; n < 2; ++n) rig_.hammer(n, nullptr);
  drain();
  EXPECT_GT(gaps.gaps[3], 300u);
  // Whoever withdraws the frame that is next, at the last moment, makes the one behind it late by
  // the time of a search; nobody else does.
  const unsigned late = hammer() == Hammer::kToggleFirst ? 12 : 3;
  std::fill(gaps.gaps.begin() + 3, gaps.gaps.begin() + late + 1, 0u);
  EXPECT_THAT(gaps.gaps, ::testing::Each(0u)) << "frames this number of bits apart";
  EXPECT_FALSE(rig_.violated());
  EXPECT_LE(rig_.max_waits(), 1u);
  const auto transfers = rig_.node(0).ahb().checker().transfers();
  EXPECT_GT(transfers, hammer() == Hammer::kNone ? 0u : 60u * 8000 / 3) << "it did hammer";
  for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(rig_.read(n, reg::kEcr), 0u);
}

class Share : public ::testing::TestWithParam<CoreBuild> {};

// Each write of an active code has its buffer read and compared with the winner, so every slot that
// the CPU leaves is asked for. The search for a received frame has its share all the same: it ends
// before the next frame. Any other access would leave it a slot, so there is none meanwhile.
TEST_P(Share, OfASearchBesideABufferActivatedWithoutEnd) {
  const CoreBuild &build = build_of_test(GetParam());
  MailboxRig rig{2, build};
  const unsigned last = build.num_mb - 1;
  const Frame received{.id = 0x040, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};
  for (unsigned n = 0; n < 2; ++n) {
    rig.configure(n);
    for (unsigned mb = 0; mb <= last && !build.features.clear_ram; ++mb) rig.put(n, mb, {});
  }
  rig.put_rx(0, last - 1, received);
  rig.write(0, reg::mb(last, 1), 0x7FFu << 18);
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  rig.put_tx(1, 1, received);
  ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kId; }, 400));
  // The winner is not written; it has been copied when the last of them is there, and compared with
  // that: nothing is left to do but the search.
  for (unsigned k = 1; k < 5; ++k) rig.put_tx(0, k, {.id = 0x040 + 0x10 * k, .dlc = 0});
  ASSERT_EQ(rig.field(0), Field::kId) << "before the search begins";
  rig.hammer(0, [last]() -> AhbTransfer {
    return {.address = reg::mb(last), .write = true, .data = 0x0C00'0000};
  });
  rig.run(8 * (135 + 55));  // two frames, with stuff bits and intermission
  rig.hammer(0, nullptr);
  EXPECT_EQ(rig.flags(0), 1ull << 1 | 1ull << (last - 1)) << "one sent, one received";
  EXPECT_EQ(mb_frame(rig.get(0, last - 1)), received);
  EXPECT_FALSE(rig.violated());
}

// Nor is the search held up at a buffer whose C/S word is written without end, whatever is written.
TEST_P(Share, OfASearchAtABufferThatIsWrittenWithoutEnd) {
  const CoreBuild &build = build_of_test(GetParam());
  const Frame received{.id = 0x040, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};
  const unsigned last = build.num_mb - 1;
  for (const std::uint32_t cs : {0x0000'0000u, 0x0400'0000u, 0x0800'0000u, 0x0C00'0000u}) {
    MailboxRig rig{2, build};
    for (unsigned n = 0; n < 2; ++n) {
      rig.configure(n);
      for (unsigned mb = 0; mb <= last && !build.features.clear_ram; ++mb) rig.put(n, mb, {});
    }
    rig.put_rx(0, last, received);
    rig.write(0, reg::mb(5, 1), 0x7FFu << 18);
    for (unsigned n = 0; n < 2; ++n) rig.go(n);
    rig.put_tx(1, 1, received);
    ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kId; }, 400));
    rig.hammer(
        0, [cs]() -> AhbTransfer { return {.address = reg::mb(5), .write = true, .data = cs}; });
    ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kInt; }, 8 * 135));
    rig.hammer(0, nullptr);
    rig.run(40);
    EXPECT_EQ(rig.flags(0), 1ull << last) << std::hex << cs;
    EXPECT_EQ(mb_frame(rig.get(0, last)), received);
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, Share, ::testing::Values(core_build("full"), core_build("small")),
                         [](const auto &test) { return std::string{test.param.name}; });

// PROP, PS1, PS2 of eight quanta from one end to the other, SJW from 1 to its largest.
constexpr std::uint32_t timing(unsigned prop, unsigned ps1, unsigned ps2, unsigned sjw) {
  return ((sjw - 1) << 22) | ((ps1 - 1) << 19) | ((ps2 - 1) << 16) | (prop - 1);
}

const auto kEveryHammer = ::testing::Values(
    Case{"Quiet", Hammer::kNone, kTiming8}, Case{"Reads", Hammer::kRead, kTiming8},
    Case{"Mixed", Hammer::kMixed, kTiming8}, Case{"Locks", Hammer::kLock, kTiming8},
    Case{"Commands", Hammer::kCommand, kTiming8},
    Case{"TogglesLast", Hammer::kToggleLast, kTiming8},
    Case{"TogglesFirst", Hammer::kToggleFirst, kTiming8},
    Case{"MixedShortPhases", Hammer::kMixed, timing(4, 1, 2, 1)},
    Case{"MixedWideJump", Hammer::kMixed, timing(1, 3, 3, 3)},
    Case{"LocksLatePoint", Hammer::kLock, timing(3, 2, 2, 2)});

INSTANTIATE_TEST_SUITE_P(
    EveryHammer, Saturation,
    ::testing::Combine(::testing::Values(core_build("full"), core_build("small")), kEveryHammer),
    [](const auto &test) {
      return std::string{std::get<1>(test.param).name} + "_" + std::get<0>(test.param).name;
    });

}  // namespace
}  // namespace vericansim
