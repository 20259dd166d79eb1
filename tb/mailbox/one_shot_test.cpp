// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// One-shot transmission (MO-09) for all buffers, and for those whose C/S word asks for it.
#include <gtest/gtest.h>

#include "bus/faults.hpp"
#include "mailbox/tx_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 10;
constexpr std::uint32_t kOneShot = 1u << 1, kOsmb = 1u << 2;  // XCTRL
constexpr std::uint32_t kAsk = 1u << 28;                      // C/S

const Frame kFrame{.id = 0x2A5, .dlc = 2, .data = {0x5A, 0xC3}};

MbWords asking(const Frame &frame, unsigned code = 0xC) {
  MbWords words = mb_words(frame, code);
  words.cs |= kAsk;
  return words;
}

void expect_given_up(TxRig &rig) {
  ASSERT_TRUE(rig.watch_flag(kMb, 3000));
  EXPECT_EQ(rig.code(kMb), 9u);
  rig.watch(1500);
  EXPECT_EQ(rig.starts(), 1u);
  EXPECT_EQ(rig.failed(), 1u);
}

TEST(OneShot, WithoutAcknowledge) {  // MO-09, extension page
  for (std::uint32_t mode : {kOneShot, kOsmb}) {
    TxRig rig{1, RigConfig{}};
    rig.write(0, reg::kExtControl, mode);
    rig.join();
    rig.put(0, kMb, asking(kFrame));
    expect_given_up(rig);
    EXPECT_EQ(rig.read(0, reg::kEcr) & 0xFF, 8u);
  }
}

TEST(OneShot, LostArbitration) {  // MO-09, PF-19: at each bit of the identifier
  for (std::uint32_t mode : {kOneShot, kOsmb}) {
    for (unsigned bit = 0; bit < 11; ++bit) {
      SCOPED_TRACE(bit);
      TxRig rig{2, RigConfig{}};
      rig.write(0, reg::kExtControl, mode);
      rig.join();
      rig.occupy(true);
      rig.watch(1000);
      rig.put(0, kMb, asking({.id = 1u << bit}));  // both start together when the frame ends
      expect_given_up(rig);
    }
  }
}

TEST(OneShot, BitErrorAnywhereInTheFrame) {  // MO-09
  for (unsigned bit = 1; bit < 60; bit += 4) {
    SCOPED_TRACE(bit);
    TxRig rig{2, RigConfig{}};
    rig.write(0, reg::kExtControl, kOsmb);
    rig.join();
    rig.put(0, kMb, asking(kFrame));
    ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kSof; }, 200));
    rig.reset_counts();
    const Time from = rig.bus().now() + bit * kMicrosecond;
    LevelFault fault{kAllNodes, Effect::kFlip, {from, from + kMicrosecond}};
    rig.bus().add(fault);
    ASSERT_TRUE(rig.watch_flag(kMb, 3000));
    EXPECT_EQ(rig.code(kMb), rig.sent() != 0 ? 8u : 9u);
    EXPECT_LE(rig.starts(), 1u);
    rig.watch(1500);
    EXPECT_LE(rig.starts(), 1u);
  }
}

TEST(OneShot, SuccessIsAsUsual) {
  TxRig rig{2, RigConfig{}};
  rig.write(0, reg::kExtControl, kOsmb);
  rig.join();
  rig.put(0, kMb, asking(kFrame));
  ASSERT_TRUE(rig.wait_flag(0, kMb));
  EXPECT_EQ(rig.code(kMb), 8u);
  EXPECT_EQ(mb_frame(rig.received()), kFrame);
}

TEST(OneShot, OnlyTheBufferThatAsks) {
  TxRig rig{1, RigConfig{}};
  rig.write(0, reg::kExtControl, kOsmb);
  rig.join();
  rig.put_tx(0, kMb, kFrame);  // does not ask
  rig.watch(3000);
  EXPECT_GT(rig.starts(), 2u);
  EXPECT_EQ(rig.flags(0), 0u);
  rig.put(0, kMb + 1, asking({.id = 1}));
  ASSERT_TRUE(rig.watch_flag(kMb + 1, 3000));
  EXPECT_EQ(rig.code(kMb + 1), 9u);
  EXPECT_EQ(rig.code(kMb), 0xCu);
}

TEST(OneShot, TheBitMeansNothingUnlessSwitchedOn) {
  TxRig rig{1, RigConfig{}};
  rig.join();
  rig.put(0, kMb, asking(kFrame));
  rig.watch(3000);
  EXPECT_GT(rig.starts(), 2u);
  EXPECT_EQ(rig.flags(0), 0u);
}

TEST(OneShot, TheBitReadsAsZeroAndGoesWithTheNextWrite) {  // flexcan.md section 0, item 5
  TxRig rig{1, RigConfig{}};
  rig.write(0, reg::kExtControl, kOsmb);
  rig.put(0, kMb, asking(kFrame));
  EXPECT_EQ(rig.read(0, reg::mb(kMb)), mb_words(kFrame, 0xC).cs);
  const auto both = rig.burst(
      0, {{.address = reg::mb(kMb), .write = true, .data = 0xFCFFFFFF}, {.address = reg::mb(kMb)}});
  EXPECT_EQ(both[1].data, 0x0C7FFFFFu);
  rig.put_tx(0, kMb, kFrame);
  rig.join();
  rig.watch(3000);
  EXPECT_GT(rig.starts(), 2u) << "the last write did not ask";
}

TEST(OneShot, ReceivedFramesClearIt) {  // a remote frame sent leaves a buffer that receives
  TxRig rig{2, RigConfig{}};
  rig.write(0, reg::kExtControl, kOsmb);
  rig.join();
  rig.put(0, kMb, asking({.id = 0x123, .remote = true, .dlc = 1}));
  ASSERT_TRUE(rig.wait_flag(0, kMb));
  rig.clear_flag(0, kMb);
  rig.put_tx(1, 9, {.id = 0x123, .dlc = 1, .data = {0x42}});
  ASSERT_TRUE(rig.wait_flag(0, kMb));
  EXPECT_EQ(rig.read(0, reg::mb(kMb)) >> 16, 0x0241u);
}

}  // namespace
}  // namespace vericansim
