// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rules of sections 1 to 6 that need message buffers: content under way, filters, full buffers; on
// the full core and on the smallest (PK-49).
#include <gtest/gtest.h>

#include <string>

#include "harness/core_build.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks

Frame base(std::uint32_t id, std::array<std::uint8_t, 8> data = {1, 2, 3, 4, 5, 6, 7, 8}) {
  return {.id = id, .dlc = 8, .data = data};
}

Frame extended(std::uint32_t id) {
  Frame frame = base(id);
  frame.extended = true;
  return frame;
}

// Nodes on a bus; those that listen take any base frame in buffer 0 and any extended one in 1.
class WholeCore : public ::testing::TestWithParam<CoreBuild> {
 protected:
  static constexpr unsigned kNodes = 3;

  void start(unsigned listeners) {
    for (unsigned n = 0; n < kNodes; ++n) {
      rig_.configure(n);
      if (!GetParam().features.clear_ram)
        for (unsigned mb = 0; mb < rig_.num_mb(); ++mb) rig_.put(n, mb, {});
      if (!GetParam().features.own_masks) rig_.write(n, reg::kRxgmask, 0);
      if ((listeners >> n & 1) != 0) {
        rig_.put_rx(n, 0, base(0), 0);
        rig_.put_rx(n, 1, extended(0), 0);
      }
    }
    for (unsigned n = 0; n < kNodes; ++n) rig_.go(n);
  }
  // Waits for a frame in a receive buffer and frees the buffer.
  std::optional<Frame> receive(unsigned n, unsigned mb = 0) {
    if (!rig_.wait_flag(n, mb)) return std::nullopt;
    const MbWords words = rig_.get(n, mb);
    rig_.clear_flag(n, mb);
    rig_.read(n, reg::kTimer);  // unlocks
    return mb_frame(words);
  }
  void run_to(unsigned n, Field field) {
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(n) == field; }, 4000));
  }
  std::uint32_t counters(unsigned n) { return rig_.read(n, reg::kEcr) & 0xFFFF; }

  MailboxRig rig_{kNodes, GetParam()};
  unsigned tx_ = rig_.num_mb() - 4;  // a buffer for transmission; receive buffers are 0 and 1
};

INSTANTIATE_TEST_SUITE_P(Builds, WholeCore,
                         ::testing::Values(core_build("full"), core_build("small")),
                         [](const auto &test) { return std::string{test.param.name}; });

// FF-12: the CPU writes another frame into the buffer that is on the wire, at any bit of it: the
// frame arrives as it was, CRC and all, and no error is seen.
TEST_P(WholeCore, RewrittenBufferDoesNotAlterTheFrameUnderWay) {
  start(0b010);
  for (unsigned bit = 0; bit < 100; ++bit) {
    const Frame first =
        base(0x2C5, {0xFF, static_cast<std::uint8_t>(bit), 0, 0, 0xA5, 0x5A, 0x0F, 1});
    rig_.put_tx(0, tx_, first);
    run_to(0, Field::kSof);
    rig_.run(bit * kBit);
    const MbWords other = mb_words(base(0x13A, {9, 9, 9, 9, 9, 9, 9, 9}), 0x8);
    rig_.write(0, reg::mb(tx_, 2), other.low);
    rig_.write(0, reg::mb(tx_, 3), other.high);
    rig_.write(0, reg::mb(tx_, 1), other.id);
    ASSERT_EQ(receive(1), first) << "rewritten after " << bit << " bits";
    ASSERT_TRUE(rig_.wait_flag(0, tx_));
    rig_.clear_flag(0, tx_);
  }
  EXPECT_EQ(counters(0), 0u);
  EXPECT_EQ(counters(1), 0u);
}

// FF-12, AR-13: the CPU activates the buffer with another frame while the first is on the wire, at
// any bit of it: both arrive, one after the other, each whole.
TEST_P(WholeCore, BufferActivatedAgainSendsBothFramesWhole) {
  start(0b010);
  for (unsigned bit = 0; bit < 100; bit += 3) {
    const Frame first =
        base(0x2C5, {0xFF, static_cast<std::uint8_t>(bit), 0, 0, 0xA5, 0x5A, 0x0F, 1});
    const Frame second = base(0x13A, {9, 8, 7, 6, 5, 4, 3, static_cast<std::uint8_t>(bit)});
    rig_.put_tx(0, tx_, first);
    run_to(0, Field::kSof);
    rig_.run(bit * kBit);
    rig_.put_tx(0, tx_, second);
    ASSERT_EQ(receive(1), first) << "activated after " << bit << " bits";
    ASSERT_EQ(receive(1), second) << "activated after " << bit << " bits";
    ASSERT_TRUE(rig_.wait_flag(0, tx_));
    rig_.clear_flag(0, tx_);
    run_to(0, Field::kIdle);
  }
  EXPECT_EQ(counters(0), 0u);
  EXPECT_EQ(counters(1), 0u);
}

// FF-13: a base and an extended frame with equal identifier bits find the buffers of their format,
// whatever the masks say, data of both unharmed.
TEST_P(WholeCore, FormatIsDecidedByTheWireNotByFilters) {
  start(0b010);
  for (const std::uint32_t id : {0x000u, 0x2AAu, 0x7FFu}) {
    rig_.put_tx(0, tx_, base(id));
    EXPECT_EQ(receive(1, 0), base(id));
    EXPECT_FALSE(rig_.wait_flag(1, 1, 400));
    rig_.clear_flag(0, tx_);
    rig_.put_tx(0, tx_, extended(id << 18));
    EXPECT_EQ(receive(1, 1), extended(id << 18));
    EXPECT_FALSE(rig_.wait_flag(1, 0, 400));
    rig_.clear_flag(0, tx_);
  }
}

// AK-01, FC-10b, PF-52: a node that accepts nothing acknowledges all the same.
TEST_P(WholeCore, RejectedFrameIsAcknowledged) {
  start(0);
  for (unsigned i = 0; i < 5; ++i) {
    rig_.put_tx(0, tx_, base(0x100 + i));
    EXPECT_TRUE(rig_.wait_flag(0, tx_, 200 * kBit));
    rig_.clear_flag(0, tx_);
  }
  EXPECT_EQ(counters(0), 0u);
}

// AK-01, VA-05, PF-16: seventy frames that nobody reads: all acknowledged; the buffer holds the
// last one whole and says that others were lost.
TEST_P(WholeCore, FullBufferIsOverrunButFramesAreAcknowledged) {
  start(0b010);
  for (unsigned i = 0; i < 70; ++i) {
    rig_.put_tx(0, tx_, base(0x100 + i, {static_cast<std::uint8_t>(i)}));
    ASSERT_TRUE(rig_.wait_flag(0, tx_, 200 * kBit)) << i;
    rig_.clear_flag(0, tx_);
  }
  const MbWords words = rig_.get(1, 0);
  EXPECT_EQ(words.code(), 0x6u);
  EXPECT_EQ(mb_frame(words), base(0x100 + 69, {69}));
  EXPECT_EQ(counters(0), 0u);
}

// PF-08, IF-03: node 1 loses to a frame that none of its buffers accepts; its retry comes right
// after INT3 and wins against a frame of lower priority that another node starts there.
TEST_P(WholeCore, LoserWhoseFiltersRejectTheWinnerRetriesAtOnce) {
  start(0b100);
  const Frame frames[] = {base(0x100), base(0x200), base(0x700)};
  // All wait for the end of a first frame, so that they start together.
  rig_.put_tx(0, tx_ - 1, base(0x0FF));
  run_to(0, Field::kData);
  rig_.put_tx(0, tx_, frames[0]);
  rig_.put_tx(1, tx_, frames[1]);
  EXPECT_EQ(receive(2), base(0x0FF));
  run_to(1, Field::kData);  // of the winner
  rig_.put_tx(2, tx_, frames[2]);
  run_to(1, Field::kInt);
  const Time intermission = rig_.bus().now();
  run_to(1, Field::kSof);
  EXPECT_LE(rig_.bus().now() - intermission, 3 * kBit * 125 * kNanosecond);
  EXPECT_EQ(receive(2), frames[0]);
  EXPECT_EQ(receive(2), frames[1]);
  EXPECT_TRUE(rig_.wait_flag(2, tx_));
}

// AR-13, PF-02: a buffer is activated at any clock from INT1 to ID27 of a foreign frame: it goes
// out whole, now or after that frame, and the foreign frames arrive whole.
TEST_P(WholeCore, BufferActivatedAroundTheStartGoesOutWhole) {
  start(0b011);
  for (unsigned clock = 0; clock < 6 * kBit; ++clock) {
    const Frame own = extended(0x0A5C3E71 + clock);
    rig_.put_tx(0, tx_, base(0x2C5));
    rig_.put_tx(0, tx_ + 1, base(0x2C6));
    run_to(1, Field::kEof);
    run_to(1, Field::kInt);
    rig_.run(clock);
    rig_.put_tx(1, tx_, own);
    ASSERT_EQ(receive(0, 1), own) << clock;
    ASSERT_TRUE(rig_.wait_flag(1, tx_)) << clock;
    ASSERT_TRUE(rig_.wait_flag(0, tx_ + 1)) << clock;
    ASSERT_EQ(receive(1), base(0x2C6)) << clock;
    for (const unsigned mb : {0u, tx_, tx_ + 1}) rig_.clear_flag(0, mb);
    rig_.clear_flag(1, tx_);
  }
  EXPECT_EQ(counters(0), 0u);
  EXPECT_EQ(counters(1), 0u);
}

}  // namespace
}  // namespace vericansim
