// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Modes and TIMER with the Rx FIFO in use (flexcan.md 2.1 to 2.3, 2.9, 2.10, section 4).
#include <gtest/gtest.h>

#include "mailbox/mode_rig.hpp"
#include "mailbox/rx_fifo_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks
constexpr std::uint32_t kTsyn = 1u << 5;

// FX-2.10.a, FX-CTRL1.TSYN: with the FIFO the first mailbox is the one behind the filter table.
TEST(TsynWithFifo, FirstMailboxBehindTheTable) {
  for (const unsigned rffn : {0u, 2u}) {
    RxFifoRig rig{{.format = 0, .rffn = rffn, .ctrl = kTiming8 | kTsyn, .num_mb = 32}};
    for (unsigned k = 0; k < 8 * (rffn + 1); ++k) rig.set_filter(k, {0x111u << 19, ~0u});
    const unsigned first = rig.first_mailbox();
    rig.put_rx(RxFifoRig::kReceiver, first, {.id = 0x200}, ~0u);
    rig.put_rx(RxFifoRig::kReceiver, first + 1, {.id = 0x201}, ~0u);
    rig.write(RxFifoRig::kReceiver, reg::kRxfgmask, ~0u);
    rig.join();
    const auto after = [&](std::uint32_t id) {
      rig.write(RxFifoRig::kReceiver, reg::kTimer, 0x4000);
      rig.send({.id = id});
      return rig.read(RxFifoRig::kReceiver, reg::kTimer);
    };
    EXPECT_GE(after(0x111), 0x4000u) << "into the FIFO";
    EXPECT_TRUE(rig.available());
    EXPECT_GE(after(0x201), 0x4000u) << "into the second mailbox";
    EXPECT_LT(after(0x200), 30u) << "into the first";
    EXPECT_EQ(rig.flags(RxFifoRig::kReceiver) >> 8, (3u << first) >> 8);
  }
}

class ModeFifo : public ::testing::TestWithParam<Leave> {
 protected:
  static constexpr unsigned kNode = RxFifoRig::kReceiver;
  ModeFifo() : rig_{{.num_mb = 16}} {
    rig_.join();
    mcr_ = rig_.read(kNode, reg::kMcr);
  }
  void ask() {
    const auto mcr = [this](std::uint32_t value) {
      rig_.node(kNode).ahb().submit({.address = reg::kMcr, .write = true, .data = value});
    };
    switch (GetParam()) {
      case Leave::kFreeze: mcr(mcr_ | reg::kMcrFrz | reg::kMcrHalt); break;
      case Leave::kDisable: mcr(mcr_ | reg::kMcrMdis); break;
      case Leave::kSoftReset: mcr(reg::kMcrSoftRst); break;
      case Leave::kStop: rig_.node(kNode).request_stop(true); break;
    }
  }
  bool left() {
    const std::uint32_t acks = reg::kMcrFrzAck | reg::kMcrLpmAck;
    return rig_.run_until([&] { return (rig_.read(kNode, reg::kMcr) & acks) != 0; }, 80 * kBit);
  }
  void come_back() {
    rig_.node(kNode).request_stop(false);
    rig_.write(kNode, reg::kMcr, mcr_);
  }
  RxFifoRig rig_;
  std::uint32_t mcr_ = 0;
};

// FX-2.3.b: frames in the FIFO stay there, except in a soft reset.
TEST_P(ModeFifo, FramesAreKeptExceptInASoftReset) {
  for (unsigned i = 0; i < 3; ++i) rig_.send({.id = 0x100 + i});
  ask();
  ASSERT_TRUE(left());
  come_back();
  rig_.run(20 * kBit);
  const bool kept = GetParam() != Leave::kSoftReset;
  EXPECT_EQ(rig_.drain().size(), kept ? 3u : 0u);
  rig_.send({.id = 0x133});
  EXPECT_EQ(rig_.drain(), std::vector<Frame>{{.id = 0x133}});
}

// FX-9.ERR008341, FX-2.1.a, FX-2.2.a: in every clock of a frame for the FIFO; it arrives whole, and
// once, or (where the receiver may drop it) not at all.
TEST_P(ModeFifo, InEveryClockOfAFrame) {
  for (unsigned k = 0; k < 64 * kBit; ++k) {
    SCOPED_TRACE(k);
    const Frame frame{.id = 0x155, .dlc = 1, .data = {static_cast<std::uint8_t>(k)}};
    rig_.put_tx(RxFifoRig::kSender, 8, frame);
    rig_.run(k);
    ask();
    ASSERT_TRUE(left());
    const std::size_t before = GetParam() == Leave::kSoftReset ? 0 : rig_.drain().size();
    come_back();
    ASSERT_TRUE(rig_.wait_flag(RxFifoRig::kSender, 8));
    rig_.clear_flag(RxFifoRig::kSender, 8);
    rig_.run(14 * kBit);
    const std::vector<Frame> after = rig_.drain();
    for (const Frame &each : after) ASSERT_EQ(each, frame);
    ASSERT_LE(before + after.size(), 1u);
    if (GetParam() == Leave::kFreeze) {
      ASSERT_EQ(before + after.size(), 1u);
    }
  }
  rig_.send({.id = 0x2AA});
  EXPECT_EQ(rig_.drain(), std::vector<Frame>{{.id = 0x2AA}});
}

INSTANTIATE_TEST_SUITE_P(All, ModeFifo, ::testing::ValuesIn(kAllWays),
                         [](const auto &each) { return to_string(each.param); });

}  // namespace
}  // namespace vericansim
