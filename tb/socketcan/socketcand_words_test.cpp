// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of commands, and messages as text. Expected texts: socketcand's doc/protocol.md, and
// what python-can's client writes and reads.
#include "bridge/socketcand_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <linux/can/error.h>

namespace vericansim {
namespace {

using ::testing::HasSubstr;

can_frame sent(const std::string &text) {
  CommandWords words(text);
  return send_frame(words);
}

std::string failure_of(const std::string &text) {
  try {
    sent(text);
  } catch (const CommandError &error) {
    return error.what();
  }
  return "no error";
}

struct IdCase {
  const char *text;
  canid_t id;
};

class SocketcandId : public testing::TestWithParam<IdCase> {};

TEST_P(SocketcandId, DigitsDecideTheFormat) {
  EXPECT_EQ(sent(std::string("send ") + GetParam().text + " 0").can_id, GetParam().id);
}

INSTANTIATE_TEST_SUITE_P(All, SocketcandId,
                         testing::Values(IdCase{"123", 0x123}, IdCase{"7FF", 0x7FF},
                                         IdCase{"7ff", 0x7FF}, IdCase{"0", 0}, IdCase{"1", 1},
                                         IdCase{"1F", 0x1F}, IdCase{"00000000", CAN_EFF_FLAG},
                                         IdCase{"00000123", CAN_EFF_FLAG | 0x123},
                                         IdCase{"1AAAAAAA", CAN_EFF_FLAG | 0x1AAAAAAA},
                                         IdCase{"1FFFFFFF", CAN_EFF_FLAG | 0x1FFFFFFF},
                                         // python-can 4.1 leaves leading zeros out
                                         IdCase{"1000", CAN_EFF_FLAG | 0x1000},
                                         IdCase{"FEDCBA9", CAN_EFF_FLAG | 0xFEDCBA9},
                                         IdCase{"07FF", 0x7FF}));

class SocketcandBadId : public testing::TestWithParam<const char *> {};

TEST_P(SocketcandBadId, IsNamed) {
  EXPECT_EQ(failure_of(std::string("send ") + GetParam() + " 0"),
            "send: identifier '" + std::string(GetParam()) +
                "' is not allowed; allowed: 000 to 7FF, or 8 digits, 00000000 to 1FFFFFFF");
}

INSTANTIATE_TEST_SUITE_P(All, SocketcandBadId,
                         testing::Values("800", "FFF", "20000000", "FFFFFFFF", "123456789",
                                         "000000001", "-1", "+1", "0x1", "12G", "1.5"));

TEST(SocketcandSend, BytesInHexWithOneOrTwoDigits) {
  const can_frame frame = sent("send 1AAAAAAA 2 1 F1");
  EXPECT_EQ(frame.len, 2);
  EXPECT_EQ(frame.data[0], 0x01);
  EXPECT_EQ(frame.data[1], 0xF1);
}

TEST(SocketcandSend, EightBytesPass) {
  const can_frame frame = sent("send 123 8 11 22 33 44 55 66 77 88");
  EXPECT_EQ(frame.len, 8);
  EXPECT_EQ(frame.data[7], 0x88);
}

TEST(SocketcandSend, NoDataIsNoRemoteFrame) {
  EXPECT_EQ(sent("send 123 0").can_id & CAN_RTR_FLAG, 0U);
}

TEST(SocketcandSend, DlcWithoutBytesIsPythonCansRemoteFrame) {
  const can_frame frame = sent("send 123 4 ");
  EXPECT_EQ(frame.can_id, 0x123 | CAN_RTR_FLAG);
  EXPECT_EQ(frame.len, 4);
}

TEST(SocketcandSend, WrongNumbersOfBytesAreNamed) {
  EXPECT_EQ(failure_of("send 123 2 1"), "send: data byte 2 is missing");
  EXPECT_EQ(failure_of("send 123 1 1 2"), "send: nothing may follow, got '2'");
  EXPECT_EQ(failure_of("send 123 0 1"), "send: nothing may follow, got '1'");
}

TEST(SocketcandSend, WrongValuesAreNamed) {
  EXPECT_EQ(failure_of("send"), "send: identifier is missing");
  EXPECT_EQ(failure_of("send 123"), "send: DLC is missing");
  EXPECT_THAT(failure_of("send 123 9 1 2 3 4 5 6 7 8 9"), HasSubstr("DLC '9' is not allowed"));
  EXPECT_THAT(failure_of("send 123 F"), HasSubstr("DLC 'F' is not allowed"));
  EXPECT_THAT(failure_of("send 123 1 100"), HasSubstr("data byte 1 '100' is not allowed"));
  EXPECT_THAT(failure_of("send 123 1 x"), HasSubstr("data byte 1 'x' is not allowed"));
}

TEST(SocketcandSend, RemoteFrameOfTheProtocol) {
  CommandWords words("sendrtr 1AAAAAAA 2");
  const can_frame frame = remote_frame(words);
  EXPECT_EQ(frame.can_id, 0x1AAAAAAA | CAN_EFF_FLAG | CAN_RTR_FLAG);
  EXPECT_EQ(frame.len, 2);
}

TEST(SocketcandInterval, SecondsAndMicroseconds) {
  CommandWords words("add 1 500000");
  EXPECT_EQ(words.interval(), 1'500 * kMillisecond);
  CommandWords large("add 0 20000000");
  EXPECT_EQ(large.interval(), 20 * kSecond);
}

TEST(SocketcandInterval, ValuesBeyondTimeAreNamed) {
  for (const char *text : {"add -1 0", "add 1000001 0", "add 0 1000000001", "add 1.5 0", "add a 0",
                           "add 99999999999999999999999 0"}) {
    CommandWords words(text);
    EXPECT_THROW(words.interval(), CommandError) << text;
  }
}

PortMessage message(canid_t id, std::vector<unsigned char> data, Time time) {
  PortMessage result{.time = time};
  result.frame.can_id = id;
  result.frame.len = static_cast<__u8>(data.size());
  std::copy(data.begin(), data.end(), result.frame.data);
  return result;
}

constexpr Time kWhen = 23 * kSecond + 424'242 * kMicrosecond;

/// As in rawmode.
std::string raw_text(const PortMessage &message) { return message_text(message, ""); }

// The example of the protocol's document has blanks in bcmmode; rawmode has none.
TEST(SocketcandText, BytesOfBcmModeHaveBlanksBetween) {
  EXPECT_EQ(message_text(message(0x123, {0x11, 0x22, 0x33, 0x44}, kWhen), " "),
            "\n< frame 123 23.424242 11 22 33 44 >");
}

TEST(SocketcandText, Frame) {
  EXPECT_EQ(raw_text(message(0x123, {0x11, 0x22, 0x33, 0x44}, kWhen)),
            "\n< frame 123 23.424242 11223344 >");
  EXPECT_EQ(raw_text(message(0x1, {0x0A}, 1 * kMicrosecond)), "\n< frame 001 0.000001 0A >");
}

TEST(SocketcandText, TwentyNineBitsHaveEightDigits) {
  EXPECT_EQ(raw_text(message(CAN_EFF_FLAG | 0x123, {1}, kWhen)),
            "\n< frame 00000123 23.424242 01 >");
}

// python-can takes the third word, so the blank in front of no data has to be there.
TEST(SocketcandText, FrameWithoutDataHasTwoBlanks) {
  EXPECT_EQ(raw_text(message(0x123, {}, kWhen)), "\n< frame 123 23.424242  >");
}

TEST(SocketcandText, RemoteFrameHasItsDlc) {
  EXPECT_EQ(raw_text(message(0x123 | CAN_RTR_FLAG, {0, 0, 0, 0}, kWhen)),
            "\n< rtr 123 23.424242 4 >");
}

TEST(SocketcandText, ErrorMessageHasClassTimeAndData) {
  EXPECT_EQ(raw_text(message(CAN_ERR_FLAG | CAN_ERR_ACK | CAN_ERR_PROT,
                             {0, 0, 0, CAN_ERR_PROT_LOC_ACK, 0, 0, 8, 0}, kWhen)),
            "\n< error 20000028 23.424242 0000001900000800 >");
}

TEST(SocketcandText, BracketsInErrorsDoNotEndThem) {
  EXPECT_EQ(error_text("a '<b>'"), "< error a '(b)' >");
}

}  // namespace
}  // namespace vericansim
