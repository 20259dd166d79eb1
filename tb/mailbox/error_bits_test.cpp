// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The error bits of ESR1, each by its own error: no other bit is set with it, and the read that
// returns it clears it (flexcan.md 1.4).
#include <gtest/gtest.h>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

/// One wrong bit at the node under test, in its first frame.
struct WrongBit {
  const char *name;
  std::uint32_t expected;  ///< the one bit of ESR1
  bool sends;              ///< the node sends the frame, or receives it
  PlaceSpec place;
  Effect effect;
};

class ErrorBits : public ::testing::TestWithParam<WrongBit> {};

// Three nodes, so that a frame that the first one does not acknowledge has its ACK all the same.
TEST_P(ErrorBits, EachErrorSetsItsBitAloneAndAReadClearsIt) {
  MailboxRig rig{3};
  for (unsigned n = 0; n < 3; ++n) rig.configure(n);
  for (unsigned n = 0; n < 3; ++n) rig.go(n);
  PlaceFault fault{0, GetParam().place, GetParam().effect};
  rig.bus().add(fault);
  // Five dominant bits in the identifier, none besides in a row: one stuff bit there.
  const unsigned sender = GetParam().sends ? 0 : 1;
  rig.put_tx(sender, 8, {.id = 0x055, .dlc = 1, .data = {0x55}});
  ASSERT_TRUE(rig.wait_flag(sender, 8)) << "it is sent again";
  ASSERT_EQ(fault.hits(), 1u);
  const std::uint32_t esr = rig.read(0, reg::kEsr);
  EXPECT_EQ(esr & 0xFC00, GetParam().expected);
  EXPECT_NE(esr & reg::kEsrErrInt, 0u);
  EXPECT_EQ(rig.read(0, reg::kEsr) & 0xFC00, 0u);
  EXPECT_NE(rig.read(0, reg::kEsr) & reg::kEsrErrInt, 0u);
}

// FX-ESR1.BIT1_ERR FX-ESR1.BIT0_ERR FX-ESR1.CRC_ERR FX-ESR1.FRM_ERR FX-ESR1.STF_ERR
INSTANTIATE_TEST_SUITE_P(
    Each, ErrorBits,
    ::testing::Values(
        WrongBit{"Bit1",
                 1u << 15,
                 true,
                 {.frame = 1, .field = Field::kData, .index = 1},
                 Effect::kDominant},
        WrongBit{"Bit0",
                 1u << 14,
                 true,
                 {.frame = 1, .field = Field::kData, .index = 0},
                 Effect::kRecessive},
        WrongBit{
            "Crc", 1u << 12, false, {.frame = 1, .field = Field::kData, .index = 2}, Effect::kFlip},
        WrongBit{"Form", 1u << 11, false, {.frame = 1, .field = Field::kCrcDel}, Effect::kDominant},
        WrongBit{"Stuff",
                 1u << 10,
                 false,
                 {.frame = 1, .field = Field::kId, .stuff = true},
                 Effect::kDominant}),
    [](const auto &test) { return std::string(test.param.name); });

}  // namespace
}  // namespace vericansim
