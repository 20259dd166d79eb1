// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames and filters in SocketCAN's form, as linux/can.h and candump's manual describe them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "bridge/frame_form.hpp"
#include "trace/id_filter.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

TEST(FrameForm, FlagsAreInTheIdentifier) {
  EXPECT_EQ(to_can_frame({.id = 0x7FF}).can_id, 0x7FFU);
  EXPECT_EQ(to_can_frame({.id = 0x7FF, .extended = true}).can_id, 0x800007FFU);
  EXPECT_EQ(to_can_frame({.id = 0x1FFFFFFF, .extended = true, .remote = true}).can_id, 0xDFFFFFFFU);
}

// FF-07: codes 9 to 15 mean eight bytes; linux/can.h has them in len8_dlc, valid with len 8.
TEST(FrameForm, RawLengthCodes) {
  for (std::uint8_t dlc = 0; dlc < 16; ++dlc) {
    for (const bool remote : {false, true}) {
      Frame frame{.id = 1, .remote = remote, .dlc = dlc};
      for (unsigned i = 0; i < frame.payload_size(); ++i) frame.data[i] = 0xA0 + i;
      const can_frame message = to_can_frame(frame);
      EXPECT_EQ(message.len, dlc > 8 ? 8 : dlc);
      EXPECT_EQ(message.len8_dlc, dlc > 8 ? dlc : 0);
      EXPECT_EQ(from_can_frame(message), frame) << int{dlc};
    }
  }
}

TEST(FrameForm, RawCodeCountsOnlyWithEightBytes) {
  can_frame message{};
  message.len = 7;
  message.len8_dlc = 12;
  EXPECT_EQ(from_can_frame(message)->dlc, 7);
  message.len = 8;
  message.len8_dlc = 16;
  EXPECT_EQ(from_can_frame(message)->dlc, 8);
}

// Bytes that do not travel mean nothing and must not look like data.
TEST(FrameForm, BytesBeyondThePayloadAreDropped) {
  can_frame message{};
  message.can_id = 0x123;
  message.len = 1;
  message.data[0] = 0x11;
  message.data[1] = 0x22;
  EXPECT_EQ(from_can_frame(message), (Frame{.id = 0x123, .dlc = 1, .data = {0x11}}));
  message.can_id |= CAN_RTR_FLAG;
  EXPECT_EQ(from_can_frame(message), (Frame{.id = 0x123, .remote = true, .dlc = 1}));
}

TEST(FrameForm, RefusesWhatIsNoFrame) {
  can_frame message{};
  message.len = 9;
  EXPECT_FALSE(from_can_frame(message));
  message.len = 8;
  message.can_id = CAN_ERR_FLAG | CAN_ERR_ACK;
  EXPECT_FALSE(from_can_frame(message));
  message.can_id = 0x800;
  EXPECT_FALSE(from_can_frame(message));
  message.can_id = 0x800 | CAN_EFF_FLAG;
  EXPECT_TRUE(from_can_frame(message));
}

TEST(IdFilter, AsCandumpHasThem) {
  EXPECT_EQ(parse_filter("123:7FF"), (IdFilter{.id = 0x123, .mask = 0x7FF}));
  EXPECT_EQ(parse_filter("92345678:DFFFFFFF"),
            (IdFilter{.id = 0x92345678, .mask = 0xDFFFFFFF}));  // eight digits: 29 bits
  EXPECT_EQ(parse_filter("00000123:1FFFFFFF"), (IdFilter{.id = 0x80000123, .mask = 0x1FFFFFFF}));
  EXPECT_EQ(parse_filter("0~0"), (IdFilter{.inverted = true}));
}

TEST(IdFilter, MatchesByMask) {
  const IdFilter range{.id = 0x120, .mask = 0x7F0};
  EXPECT_TRUE(range.matches(0x12F));
  EXPECT_FALSE(range.matches(0x130));
  EXPECT_TRUE(range.matches(0x12F | CAN_EFF_FLAG));  // the mask leaves the flag out
  const IdFilter base{.id = 0x120, .mask = CAN_EFF_FLAG | CAN_RTR_FLAG | 0x7F0};
  EXPECT_FALSE(base.matches(0x12F | CAN_EFF_FLAG));
  EXPECT_FALSE(base.matches(0x12F | CAN_RTR_FLAG));
  const IdFilter others{.id = 0x120, .mask = 0x7F0, .inverted = true};
  EXPECT_FALSE(others.matches(0x12F));
  EXPECT_TRUE(others.matches(0x130));
}

TEST(IdFilter, OneOfSeveralIsEnough) {
  const std::vector<IdFilter> filters{{.id = 1, .mask = 0x7FF}, {.id = 2, .mask = 0x7FF}};
  EXPECT_TRUE(passes(filters, 2));
  EXPECT_FALSE(passes(filters, 3));
  EXPECT_TRUE(passes({}, 3));
}

class BadFilter : public ::testing::TestWithParam<const char *> {};

TEST_P(BadFilter, IsNamed) {
  try {
    (void)parse_filter(GetParam());
    FAIL() << "no complaint";
  } catch (const InputError &error) {
    EXPECT_THAT(error.what(), HasSubstr(std::string{"--filter: '"} + GetParam() + "'"));
    EXPECT_THAT(error.what(), HasSubstr("ID:MASK"));
  }
}

INSTANTIATE_TEST_SUITE_P(Texts, BadFilter,
                         ::testing::Values("", "123", "123:", ":7FF", "12G:7FF", "123:7FF:1",
                                           "123456789:7FF", "-1:7FF", "0x123:7FF", "123: 7FF"));

}  // namespace
}  // namespace vericansim
