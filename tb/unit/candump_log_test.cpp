// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// candump logs and the other text recordings: what can-utils, PCAN-View and SavvyCAN write is read
// exactly.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "harness/input_error_of.hpp"
#include "trace/candump.hpp"
#include "trace/gvret.hpp"
#include "trace/input_error.hpp"
#include "trace/trc.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Frame frame_of(const std::string &text) {
  Frame frame;
  EXPECT_TRUE(parse_candump_frame(text, frame, {"log", 1})) << text;
  return frame;
}

std::string error_of(const std::string &text) {
  return input_error_of([&] { return parse_candump(text, "log"); });
}

// Forms of a frame as `man candump` and lib.h of can-utils describe them.
TEST(CandumpFrame, BaseData) {
  const Frame frame = frame_of("123#11223344");
  EXPECT_EQ(frame, (Frame{0x123, false, false, 4, {0x11, 0x22, 0x33, 0x44}}));
}
TEST(CandumpFrame, EightDigitsAreExtended) {
  EXPECT_EQ(frame_of("00000123#"), (Frame{0x123, true, false, 0, {}}));
  EXPECT_EQ(frame_of("1FFFFFFF#FF"), (Frame{0x1FFFFFFF, true, false, 1, {0xFF}}));
}
TEST(CandumpFrame, DotsBetweenBytes) {
  EXPECT_EQ(frame_of("7FF#0A.0b"), (Frame{0x7FF, false, false, 2, {10, 11}}));
}
TEST(CandumpFrame, RemoteWithAndWithoutLength) {
  EXPECT_EQ(frame_of("123#R"), (Frame{0x123, false, true, 0, {}}));
  EXPECT_EQ(frame_of("123#R8"), (Frame{0x123, false, true, 8, {}}));
}
TEST(CandumpFrame, RawDlcBehindUnderscore) {
  EXPECT_EQ(frame_of("123#0102030405060708_F"),
            (Frame{0x123, false, false, 15, {1, 2, 3, 4, 5, 6, 7, 8}}));
  EXPECT_EQ(frame_of("123#R8_9"), (Frame{0x123, false, true, 9, {}}));
}
TEST(CandumpFrame, FdAndErrorFramesAreNotClassical) {
  Frame frame;
  EXPECT_FALSE(parse_candump_frame("123##100112233", frame, {"log", 1}));
  EXPECT_FALSE(parse_candump_frame("20000004#0004000000000000", frame, {"log", 1}));
}

TEST(CandumpFrame, WritesWhatItReads) {
  for (const char *text : {"000#", "7FF#0001020304050607", "00000000#R", "12345678#R3", "123#R8_F",
                           "1FFFFFFF#FFFFFFFFFFFFFFFF_9"})
    EXPECT_EQ(candump_frame(frame_of(text)), text);
}

TEST(CandumpLog, TimesAreRelativeToTheFirst) {
  const CanLog log = parse_candump(
      "# a comment\n\n(1436509052.249713) vcan0 044#2A\r\n(1436509052.449847) vcan1 12345678#\n",
      "log");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.start_ns, 1'436'509'052'249'713'000);
  EXPECT_EQ(log.entries[0].time, 0);
  EXPECT_EQ(log.entries[1].time, 200'134 * kMicrosecond);
  EXPECT_EQ(log.entries[1].channel, "vcan1");
}

TEST(CandumpLog, ReadsScreenOutput) {
  const CanLog log =
      parse_candump("  vcan0  123   [2]  11 22\n  can1  12345678   [0]  remote request\n", "log");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 2, {0x11, 0x22}}));
  EXPECT_EQ(log.entries[1].frame, (Frame{0x12345678, true, true, 0, {}}));
  const CanLog stamped =
      parse_candump(" (3.5)  can0  7FF   [1]  AA\n (4.5)  can0  7FF   [0]\n", "log");
  ASSERT_EQ(stamped.entries.size(), 2U);
  EXPECT_EQ(stamped.entries[1].time, kSecond);
}

TEST(CandumpLog, SkipsAndCountsWhatIsNotClassical) {
  const CanLog log = parse_candump(
      "(1.0) can0 123##0AA\n(1.1) can0 20000080#0000000000000000\n(1.3) can0 001#\n", "log");
  EXPECT_EQ(log.skipped, 2U);
  ASSERT_EQ(log.entries.size(), 1U);
  EXPECT_EQ(log.entries[0].time, 0);
}

// A file that is cut in its last frame reads as one with a shorter frame.
TEST(CandumpLog, ALastLineWithoutLineEndIsWarnedOf) {
  const std::string text = "(1.0) can0 123#11\n(1.1) can0 124#2233";
  EXPECT_THAT(parse_candump(text, "log").warnings,
              ElementsAre("line 2 has no line end; its frame may be cut short"));
  for (const char *rest : {"\n", "\r\n", "\n# end", "\n  "})
    EXPECT_THAT(parse_candump(text + rest, "log").warnings, IsEmpty()) << rest;
  EXPECT_THAT(parse_candump("", "log").warnings, IsEmpty());
}

// Names reach tables and terminals.
TEST(CandumpLog, InterfacesAreNamesThatCanBePrinted) {
  for (const char *line :
       {"(1.0) can\x1B[0 123#11\n", "(1.0) can\x1B[0 123##111\n", "can\x1B[0  123   [1]  11\n"})
    EXPECT_EQ(error_of(line),
              "log:1: interface 'can?[0' is not allowed; allowed: a name without control "
              "characters");
}

// Bit 29 is the flag of error messages, which CAN FD does not have.
TEST(CandumpLog, CanFdIdentifiersHave29Bits) {
  EXPECT_THAT(error_of("(1.0) can0 20000123##1AA\n"),
              HasSubstr("log:1: identifier is above 1FFFFFFF (29 bits)"));
  EXPECT_EQ(parse_candump("(1.0) can0 1FFFFFFF##1AA\n", "log").others.at(0).text, "1FFFFFFF##1AA");
}

// A length that no DLC stands for cannot have been on a bus.
// A clock that is set on the way, of a computer that keeps no time while it is off.
TEST(CandumpLog, TimesThatAreTooFarApartAreRefused) {
  const std::string set = "(0.0) can0 001#\n(1.0) can0 001#\n(1700000000.0) can0 001#\n";
  EXPECT_EQ(error_of(set),
            "log:3: time is more than 53 days from the first one; allowed: recordings of up to "
            "53 days; split longer ones, also where their clock was set");
  EXPECT_EQ(error_of("(0.0) can0 001#\n(4579200.0) can0 001#\n"), "no error");
}

TEST(CandumpLog, FdFramesOfALengthThatThereIsNotAreRefused) {
  for (std::size_t bytes = 0; bytes <= 64; ++bytes) {
    const std::string text = "(1.0) can0 123##1" + std::string(2 * bytes, '5') + "\n";
    if (bytes <= 8 || (bytes <= 24 && bytes % 4 == 0) || bytes == 32 || bytes == 48 || bytes == 64)
      EXPECT_EQ(parse_candump(text, "log").others.size(), 1U) << bytes;
    else
      EXPECT_THAT(error_of(text),
                  HasSubstr(fmt::format("log:1: CAN FD frame of {} bytes is not allowed; allowed: "
                                        "0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64",
                                        bytes)));
  }
}

TEST(CandumpLog, ErrorsNameFileLineValueAndWhatIsAllowed) {
  EXPECT_THAT(error_of("(1.0) can0 123#11\n(1.1) can0 12#11\n"),
              HasSubstr("log:2: identifier '12'"));
  EXPECT_THAT(error_of("(1.0) can0 800#11\n"), HasSubstr("log:1: identifier is above 7FF"));
  EXPECT_THAT(error_of("(1.0) can0 123#1\n"), HasSubstr("odd number of data digits"));
  EXPECT_THAT(error_of("(1.0) can0 123#001122334455667788\n"), HasSubstr("up to 8 bytes"));
  EXPECT_THAT(error_of("(1.0) can0 123#R9\n"), HasSubstr("allowed: 0 to 8"));
  EXPECT_THAT(error_of("(1.0) can0 123#11_9\n"), HasSubstr("allowed: _9 to _F after 8 bytes"));
  EXPECT_THAT(error_of("(x) can0 123#11\n"), HasSubstr("(seconds.microseconds)"));
  EXPECT_THAT(error_of("(1.0) can0\n"), HasSubstr("expected (TIME) INTERFACE FRAME"));
  EXPECT_THAT(error_of("(99999999999999999999.0) can0 123#\n"), HasSubstr("log:1: time"));
  EXPECT_THAT(
      error_of("(1.0) can0 123#11 (1.1) can0 124#22\n"),
      HasSubstr("log:1: what follows the frame, '124#22', is not allowed; allowed: R or T"));
  EXPECT_THAT(error_of("(1.0) can0 123#11 X\n"), HasSubstr("'X'"));
  EXPECT_THAT(error_of("(1.0) can0 123#11 R T\n"), HasSubstr("'T'"));
}

TEST(CandumpWriter, WritesTheLogFormat) {
  std::ostringstream out;
  CandumpWriter writer{out, 1'436'509'052'000'000'000};
  writer.write({249'713 * kMicrosecond, "vcan0", frame_of("123#11223344")});
  writer.write({2 * kSecond, "", frame_of("12345678#R")});
  EXPECT_EQ(out.str(),
            "(1436509052.249713) vcan0 123#11223344\n(1436509054.000000) can0 12345678#R\n");
}

TEST(Trc, ReadsPcanViewVersion11) {
  const CanLog log = parse_trc(
      ";$FILEVERSION=1.1\r\n;\r\n     1)        48.6  Rx     09F11201  2  FF 50 \r\n"
      "     2)        49.2  Tx         0123  4  RTR\r\n     3)  50.0  Warng  FFFFFFFF  4  00 00 00 "
      "04\r\n",
      "a.trc");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.skipped, 1U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x09F11201, true, false, 2, {0xFF, 0x50}}));
  EXPECT_EQ(log.entries[1].frame, (Frame{0x123, false, true, 4, {}}));
  EXPECT_EQ(log.entries[1].time, 600 * kMicrosecond);
  EXPECT_THROW(static_cast<void>(parse_trc(";$FILEVERSION=3.0\n", "b.trc")), InputError);
}

TEST(Trc, ErrorsNameLineValueAndWhatIsAllowed) {
  const auto error = [](const std::string &text) {
    return input_error_of([&] { return parse_trc(text, "t.trc"); });
  };
  const std::string head = ";$FILEVERSION=2.1\n;$COLUMNS=N,O,T,B,I,d,L,D\n";
  EXPECT_EQ(error(head + "1 1.0 DT 1 0123 Rx 2 11 22\n"), "no error");
  EXPECT_THAT(error(head + "1 1.0 DT 1 0123 Rx 2 11 22 33\n"),
              HasSubstr("t.trc:3: 3 data bytes where the length says 2"));
  EXPECT_THAT(error(head + "1 1.0 DT x 0123 Rx 2 11 22\n"),
              HasSubstr("bus 'x' is not allowed; allowed: a number"));
  EXPECT_THAT(error(head + "1 1.0 DT 1 0123 Zz 2 11 22\n"),
              HasSubstr("direction 'Zz' is not allowed; allowed: Rx, Tx"));
  for (const char *start : {"abc", "nan", "1e30"})
    EXPECT_THAT(error(std::string(";$STARTTIME=") + start + "\n"),
                HasSubstr("t.trc:1: start time '" + std::string(start) + "' is not allowed"));
}

TEST(Gvret, ReadsBothVersionsOfTheColumns) {
  const CanLog old_style = parse_gvret(
      "Time "
      "Stamp,ID,Extended,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n166064000,0000021A,false,0,2,FE,36,00,00,"
      "00,00,00,00,\n",
      "a.csv");
  const CanLog new_style = parse_gvret(
      "Time "
      "Stamp,ID,Extended,Dir,Bus,LEN,D1,D2\n5,1FFFFFFF,true,Rx,1,1,0a\n1005,00000001,false,Rx,1,"
      "0\n",
      "a.csv");
  ASSERT_EQ(old_style.entries.size(), 1U);
  EXPECT_EQ(old_style.entries[0].frame, (Frame{0x21A, false, false, 2, {0xFE, 0x36}}));
  ASSERT_EQ(new_style.entries.size(), 2U);
  EXPECT_EQ(new_style.entries[0].frame, (Frame{0x1FFFFFFF, true, false, 1, {10}}));
  EXPECT_EQ(new_style.entries[0].channel, "can1");
  EXPECT_EQ(new_style.entries[1].time, kMillisecond);
}

TEST(Gvret, ErrorsNameLineValueAndWhatIsAllowed) {
  const auto error = [](const std::string &line) {
    const std::string head = "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4\n";
    return input_error_of([&] { return parse_gvret(head + line + "\n", "g.csv"); });
  };
  EXPECT_EQ(error("5,00000123,false,Rx,0,2,AB,CD"), "no error");
  EXPECT_THAT(error("5,00000123,false,Rx,0,2,AB,C"),
              HasSubstr("g.csv:2: data byte 'C' is not allowed"));
  EXPECT_THAT(error("5,00000123,false,Xx,0,1,AB"), HasSubstr("direction 'Xx' is not allowed"));
  EXPECT_THAT(error("5,00000123,false,Rx,,1,AB"), HasSubstr("Bus '' is not allowed"));
  EXPECT_THAT(error("5,00000123,false,Rx,foo bar,1,AB"), HasSubstr("Bus 'foo bar'"));
}

// Behind LEN SavvyCAN writes zeros or what the frame before had there; LEN says what was on the
// bus.
TEST(Gvret, ColumnsBehindTheLengthAreEmptyOrBytes) {
  const auto parse = [](const std::string &line) {
    return parse_gvret("Time Stamp,ID,Extended,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n" + line + "\n",
                       "g.csv");
  };
  const auto error = [&](const std::string &line) {
    return input_error_of([&] { return parse(line); });
  };
  for (const char *rest : {"", ",", ",,,,,,,", ",00,00,00,00,00,00,", ", 33,44,,,,,"}) {
    const CanLog log = parse(std::string{"5,123,false,0,2,AB,CD"} + rest);
    ASSERT_EQ(log.entries.size(), 1U) << rest;
    EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 2, {0xAB, 0xCD}})) << rest;
  }
  EXPECT_THAT(error("5,123,false,0,2,AB,CD,x"), HasSubstr("g.csv:2: data byte 'x' is not allowed"));
  EXPECT_THAT(error("5,123,false,0,2,AB,CD,3"), HasSubstr("g.csv:2: data byte '3' is not allowed"));
  EXPECT_THAT(error("5,123,false,0,8,1A,2,3,4,5,6,7,8"), HasSubstr("data byte '2'"));
  EXPECT_THAT(error("5,123,false,0,2,01,02,03,04,05,06,07,08,09"),
              HasSubstr("g.csv:2: data byte '09' is not allowed; allowed are up to 8 bytes"));
}

// No input may crash a parser: every prefix and every single-character change of good lines either
// parses or throws InputError.
TEST(TextLogs, DamagedInputNeverCrashes) {
  const std::string candump = "(1.5) can0 12345678#0102030405060708_A\n can0 123 [2] 11 22\n";
  const std::string trc = ";$FILEVERSION=1.1\n 1) 48.6 Rx 09F11201 2 FF 50\n";
  const std::string csv = "Time Stamp,ID,Extended,Bus,LEN,D1,D2\n16,21A,false,0,2,FE,36\n";
  const auto survive = [](auto parse, std::string text) {
    try {
      static_cast<void>(parse(text, "f"));
    } catch (const InputError &error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  for (std::size_t at = 0; at < 64; ++at) {
    for (const int byte : {0, 10, 32, 35, 40, 44, 48, 57, 70, 91, 95, 120, 255}) {
      const auto damage = [&](std::string text) {
        text[at % text.size()] = static_cast<char>(byte);
        return text;
      };
      survive(parse_candump, damage(candump));
      survive(parse_trc, damage(trc));
      survive(parse_gvret, damage(csv));
    }
    survive(parse_candump, candump.substr(0, at));
    survive(parse_trc, trc.substr(0, at));
    survive(parse_gvret, csv.substr(0, at));
  }
}

}  // namespace
}  // namespace vericansim
