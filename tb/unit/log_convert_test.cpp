// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Conversions: what each format keeps and what is told as lost; recordings of others there and
// back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "harness/input_error_of.hpp"
#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "harness/time_zone.hpp"
#include "trace/candump.hpp"
#include "trace/input_error.hpp"
#include "trace/log_convert.hpp"
#include "trace/trc.hpp"

namespace vericansim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

CanLog sample() {
  return parse_candump(
      "(1700000000.000000500) vcan3 123#1122 T\n(1700000000.5) vcan3 12345678#R3 R\n"
      "(1700000001.0) vcan3 123#0102030405060708_C R\n(1700000002.0) vcan3 123##1AABB R\n"
      "(1700000003.0) vcan3 20000080#0001020304050607\n",
      "log");
}

std::vector<std::string> lost(LogFormat format) {
  const Conversion result = convert(sample(), format, "out");
  EXPECT_TRUE(result.faithful) << name_of(format);
  return result.lost;
}

TEST(Convert, CandumpAndPcapngLoseNothing) {
  EXPECT_THAT(lost(LogFormat::kCandump), IsEmpty());
  EXPECT_THAT(lost(LogFormat::kPcapng), IsEmpty());
  EXPECT_THAT(lost(LogFormat::kPcap), ElementsAre("5 interfaces vcan3 (none now)", "4 directions"));
}

// Nine decimals if any time needs them: that of day, of a frame, of another entry.
TEST(Convert, CandumpHasTheDecimalsThatTimesNeed) {
  for (const char *text :
       {"(1.000000001) can0 123#11\n", "(1.0) can0 123#11\n(1.000000001) can0 123#11\n",
        "(1.0) can0 123#11\n(1.000000001) can0 123##1AA\n"}) {
    const Conversion result = convert(parse_candump(text, "log"), LogFormat::kCandump, "out");
    EXPECT_THAT(result.lost, IsEmpty()) << text;
    EXPECT_THAT(result.bytes, HasSubstr("1.000000001)"));
  }
  EXPECT_THAT(
      convert(parse_candump("(1.5) can0 123#11\n", "log"), LogFormat::kCandump, "out").bytes,
      HasSubstr("(0000000001.500000) "));
}

// What was not known is not lost: an interface without a name, a direction that nobody told.
TEST(Convert, OnlyWhatIsThereCanBeLost) {
  CanLog log = parse_candump("(1.0) can0 123#11\n", "log");
  log.entries[0].channel = "";
  const Conversion result = convert(log, LogFormat::kTrc, "out");
  EXPECT_THAT(result.lost, IsEmpty());
  EXPECT_EQ(parse_log(result.bytes, "out").entries.at(0).direction, Direction::kReceived);
}

TEST(Convert, CountsWhatIsNoFrameAndTellsTheLargestError) {
  const CanLog log = parse_candump(
      "(1.0) can0 123#\n(2.0000007) can0 123#\n(3.0000002) can0 123#\n"
      "DROPCOUNT: dropped 3 CAN frames on 'can0' socket\n",
      "log");
  EXPECT_THAT(convert(log, LogFormat::kGvret, "out").lost,
              ElementsAre("1 other line or packet",
                          "2 times since the first frame, by up to 700 ns",  // whole microseconds
                          "1 time of day"));
}

// The check of the new file: entries that no reader gives come back as others, or not at all.
TEST(Convert, AFileThatHoldsOtherFramesIsNoticed) {
  CanLog log = parse_candump("(1.0) can0 123#11\n(1.1) can0 123##1AABB\n", "log");
  EXPECT_TRUE(convert(log, LogFormat::kPcapng, "out").faithful);
  log.others[0].text = "123##1aabb";
  const Conversion other = convert(log, LogFormat::kPcapng, "out");
  EXPECT_FALSE(other.faithful);
  EXPECT_EQ(other.difference, "frame 2 is 123##1AABB, not 123##1aabb");
  log.others[0].text = "123##1" + std::string(2 * 65, '0');  // too long for CAN FD
  const Conversion missing = convert(log, LogFormat::kPcapng, "out");
  EXPECT_FALSE(missing.faithful);
  EXPECT_EQ(missing.difference, "there are 1, not 2");
  EXPECT_EQ(missing.frames, 2U);
}

// Without a time of day the first classical frame is at 0: what lies before it would be below.
TEST(Convert, WithoutATimeOfDayTheFileBeginsWithTheEarliestEntry) {
  const CanLog log = parse_trc(
      ";$FILEVERSION=2.1\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n"
      " 1  100.500 FD 1 0124 Rx - 1 22\n 2  200.000 DT 1 0123 Rx - 1 11\n"
      " 3  150.250 DT 1 0125 Rx - 1 33\n",
      "a.trc");
  ASSERT_EQ(log.start_ns, 0);
  ASSERT_EQ(log.earliest(), -99'500 * kMicrosecond);
  for (const LogFormat format :
       {LogFormat::kCandump, LogFormat::kPcap, LogFormat::kPcapng, LogFormat::kTrc, LogFormat::kAsc,
        LogFormat::kBlf, LogFormat::kCsv, LogFormat::kSqlite}) {
    if (traits_of(format).python && !has_python_can()) continue;
    const Conversion result = convert(log, format, "out");
    EXPECT_TRUE(result.faithful) << name_of(format);
    EXPECT_THAT(result.lost, Not(Contains(HasSubstr("time")))) << name_of(format);
    const CanLog again = parse_log(result.bytes, "out");
    EXPECT_EQ(again.entries.at(1).time, -49'750 * kMicrosecond) << name_of(format);
  }
  EXPECT_THAT(convert(log, LogFormat::kCandump, "out").bytes,
              testing::StartsWith("(0000000000.000000) can0 124##022 R\n"
                                  "(0000000000.099500) can0 123#11 R\n"));
  EXPECT_THAT(convert(log, LogFormat::kGvret, "out").bytes, HasSubstr("\n0,00000125,"));
}

// Since Linux 6.2 candump writes CANFD_FDF (4), which "##" says too (linux/can.h).
TEST(Convert, CanFdFramesOfNewerKernelsAreTheSameFrames) {
  const CanLog log =
      parse_candump("(1.0) can0 123##4AABB\n(1.1) can0 123##5AABB\n(1.2) can0 123##7AABB\n", "log");
  for (const LogFormat format : {LogFormat::kCandump, LogFormat::kPcap, LogFormat::kPcapng,
                                 LogFormat::kTrc, LogFormat::kAsc, LogFormat::kBlf}) {
    if (traits_of(format).python && !has_python_can()) continue;
    const Conversion result = convert(log, format, "out");
    EXPECT_TRUE(result.faithful) << name_of(format) << ": " << result.difference;
  }
  EXPECT_THAT(convert(log, LogFormat::kCandump, "out").bytes, HasSubstr(" 123##5AABB\n"));
  const std::string bytes = convert(log, LogFormat::kPcapng, "out").bytes;
  EXPECT_EQ(parse_log(bytes, "out").others.at(2).text, "123##3AABB");
}

// No format has them: if_tsoffset of a capture, or the date of an ASC file, is before 1970.
TEST(Convert, ATimeOfDayBefore1970IsToldAsLost) {
  CanLog log = parse_candump("(5.0) can0 123#11\n(5.000001) can0 124#22\n", "log");
  log.start_ns = -999'499'999'999;
  for (const LogFormat format :
       {LogFormat::kCandump, LogFormat::kPcap, LogFormat::kPcapng, LogFormat::kTrc,
        LogFormat::kGvret, LogFormat::kAsc, LogFormat::kBlf}) {
    if (traits_of(format).python && !has_python_can()) continue;
    const Conversion result = convert(log, format, "out");
    EXPECT_TRUE(result.faithful) << name_of(format);
    EXPECT_THAT(result.lost, Contains("1 time of day")) << name_of(format);
    EXPECT_THAT(result.lost, Not(Contains(HasSubstr("since")))) << name_of(format);
  }
}

// What is left out may have been the first frame; the others are as far apart as before.
TEST(Convert, TimesCountFromTheFirstFrameThatIsInTheFile) {
  const CanLog log = parse_candump(
      "(1700000000.0) can0 321#R\n(1700000001.0) can0 123#11\n(1700000002.5) can0 123#22\n", "log");
  const Conversion result = convert(log, LogFormat::kGvret, "out");
  EXPECT_THAT(result.lost, ElementsAre("1 remote frame", "1 time of day"));
  EXPECT_THAT(result.bytes, HasSubstr("\n1700000001000000,00000123,"));
}

// The message names no line of a file that nobody sees.
TEST(Convert, AFileThatCannotBeReadIsNamed) {
  CanLog log = parse_candump("(1.0) can0 123#11\n(1.1) can0 123##1AABB\n", "log");
  log.others[0].text = "123##1" + std::string(2 * 65, '0');  // too long for CAN FD
  EXPECT_EQ(input_error_of([&] { (void)convert(log, LogFormat::kCandump, "out.log"); }),
            "out.log: the recording cannot be written to it as candump: read again:2: 131 data "
            "digits are not allowed; allowed: up to 129");
}

TEST(Convert, TrcAndGvretTellWhatTheyCannotHold) {
  EXPECT_THAT(lost(LogFormat::kTrc), ElementsAre("1 error message", "4 interfaces vcan3 (can3 now)",
                                                 "3 times since the first frame, by up to 500 ns",
                                                 "1 time of day, by 500 ns"));
  EXPECT_THAT(lost(LogFormat::kGvret),
              ElementsAre("1 remote frame", "1 DLC of 9 to 15 (8 now)", "1 CAN FD frame",
                          "1 error message", "2 interfaces vcan3 (can3 now)",
                          "1 time since the first frame, by up to 500 ns", "1 time of day"));
}

TEST(Convert, PythonCansFormatsTellWhatTheyCannotHold) {
  if (!has_python_can()) GTEST_SKIP() << "python3-can is not installed";
  EXPECT_THAT(lost(LogFormat::kBlf), ElementsAre("5 interfaces vcan3 (can3 now)"));
  EXPECT_THAT(lost(LogFormat::kAsc), Contains("1 content of an error message"));
  EXPECT_THAT(lost(LogFormat::kCsv), Contains("1 CAN FD frame"));
  EXPECT_THAT(lost(LogFormat::kSqlite), Contains("4 interfaces vcan3 (none now)"));
}

// Versions as PEAK's description shows them.
TEST(Convert, ReadsEveryVersionOfTrc) {
  const auto only = [](const std::string &text) {
    const CanLog log = parse_trc(text, "a.trc");
    return log.entries.size() == 1
               ? candump_frame(log.entries[0].frame) + " " + log.entries[0].channel
               : std::to_string(log.entries.size());
  };
  const std::string v = ";$FILEVERSION=";
  EXPECT_EQ(only(";\n 1)  17535  00000100  2  01 02\n 2) 17540 FFFFFFFF 4 00 00 00 08\n"),
            "00000100#0102 ");
  EXPECT_EQ(only(v + "1.2\n 1) 17535.4 2 Rx 0100 2 01 02\n"), "100#0102 can1");
  EXPECT_EQ(only(v + "1.3\n 1) 17535.4 1 Tx 00000100 - 0\n 2) 1 1 Warng FFFFFFFF - 4 00 00\n"),
            "00000100# can0");
  EXPECT_EQ(only(v + "2.0\n;$COLUMNS=N,O,T,I,d,l,D\n 1 17535.400 DT 0100 Tx 2 01 02\n"
                     " 2 17540.300 ST          Rx    00 00 00 08\n"),
            "100#0102 ");
  EXPECT_EQ(only(v + "2.1\n 1 17535.400 RR 3 00000100 Rx - 4\n"), "00000100#R4 can2");
  EXPECT_EQ(only(v + "2.1\n 1 1.0 DT 1 0100 Rx - 15 01 02 03 04 05 06 07 08\n"),
            "100#0102030405060708_F can0");
  const CanLog fd =
      parse_trc(v + "2.1\n 1 1.0 BI 1 0100 Rx - 9 00 01 02 03 04 05 06 07 08 09 0A 0B\n", "a.trc");
  EXPECT_EQ(fd.others.at(0).text, "100##3000102030405060708090A0B");
}

TEST(Convert, BadTrcIsRefused) {
  const auto refusal = [](const std::string &lines) {
    return input_error_of([&] { return parse_trc(";$FILEVERSION=2.1\n" + lines, "a.trc"); });
  };
  for (const char *columns : {"N,O,T,I,X", "N,O,T,D", "N,T,I,D"})
    EXPECT_EQ(refusal(";$COLUMNS=" + std::string(columns) + "\n"),
              "a.trc:2: columns '" + std::string(columns) +
                  "' are not known; allowed: N,O,T,B,I,d,R,l,L,D, with O and I");
  EXPECT_THAT(refusal(" 1 1.0 DT 1 100 Rx - 1 11\n"),
              HasSubstr("a.trc:2: identifier '100' is not allowed; allowed: 4 or 8"));
  EXPECT_THAT(refusal(" 1 1.0 DT 1 0100 Rx - 16 01 02 03 04 05 06 07 08\n"),
              HasSubstr("length '16' is not allowed; allowed: 0 to 15"));
  EXPECT_THAT(refusal(";$COLUMNS=N,O,T,I,l,D\n 1 1.0 DT 0100 9 01 02 03 04 05 06 07 08 09\n"),
              HasSubstr("a.trc:3: length '9' is not allowed; allowed: 0 to 8, CAN FD to 64"));
}

// $STARTTIME is local time: a recording that begins at 1 s, as simulated ones do, begins on the
// last day of 1969 west of Greenwich. Serial day 25569 is 1970-01-01; five hours are 0.2083333...
// of one.
TEST(Convert, TrcKeepsTheTimeOfDayInEveryTimeZone) {
  const CanLog log = parse_candump("(1.000012) can0 123#11\n(1.5) can0 123#22\n", "log");
  for (const char *zone : {"UTC0", "EST5", "SST11", "IST-5:30"}) {
    const TimeZone there{zone};
    const Conversion result = convert(log, LogFormat::kTrc, "out");
    EXPECT_THAT(result.lost, IsEmpty()) << zone;
    EXPECT_EQ(parse_log(result.bytes, "out").start_ns, 1'000'012'000) << zone;
  }
  const TimeZone there{"EST5"};
  EXPECT_THAT(convert(log, LogFormat::kTrc, "out").bytes, HasSubstr(";$STARTTIME=25568.79167"));
}

// Nanoseconds since 1970 are 64 bits: up to the year 2262, serial day 132320.
TEST(Convert, ATrcOfAnotherAgeIsRefused) {
  const auto refusal = [](const std::string &days) {
    return input_error_of([&] {
      return parse_trc(";$FILEVERSION=2.1\n;$STARTTIME=" + days + "\n 1 1.0 DT 1 0100 Rx - 0\n",
                       "a.trc");
    });
  };
  EXPECT_EQ(refusal("132320.5"), "no error");
  EXPECT_EQ(refusal("132322.5"),
            "a.trc:2: start time '132322.5' is not allowed; allowed: days since the end of 1899, "
            "up to the year 2262");
}

// Our reader and python-can's must see the same frames in a file of ours.
TEST(Convert, PythonCanReadsOurTrc) {
  if (!has_python_can()) GTEST_SKIP() << "python3-can is not installed";
  const ScratchFolder folder;
  const std::string path = folder.file(
      "a.trc", trc_text(parse_candump("(1700000000.25) can0 123#1122\n(1700000000.50025) can1 "
                                      "12345678# T\n",
                                      "log")));
  EXPECT_EQ(shell("/usr/bin/python3 -c 'import can, sys\nfor m in can.LogReader(sys.argv[1]): "
                  "print(round(m.timestamp, 6), hex(m.arbitration_id), m.is_extended_id, "
                  "m.data.hex(), m.channel, m.is_rx)' " +
                  path)
                .text,
            "0.0 0x123 False 1122 1 True\n0.25025 0x12345678 True  2 False\n");
}

/// Files of the folder that VERICAN_RECORDINGS names, else of ../shared/data/traffic.
std::vector<std::string> recordings() {
  const char *given = std::getenv("VERICAN_RECORDINGS");
  std::vector<std::string> files;
  std::error_code error;
  for (const auto &entry : std::filesystem::directory_iterator{
           given != nullptr ? given : "../shared/data/traffic", error})
    if (entry.is_regular_file() && entry.path().extension() != ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Held-out recordings: through every format of ours and back, all frames are the same.
TEST(Convert, RecordingsOfOthersThereAndBack) {
  const auto files = recordings();
  if (files.empty()) GTEST_SKIP() << "no recordings; VERICAN_RECORDINGS=FOLDER names some";
  for (const std::string &file : files) {
    CanLog log;
    try {
      log = read_log(file);
    } catch (const InputError &error) {
      std::printf("  %s\n", error.what());
      continue;
    }
    for (const LogFormat format : {LogFormat::kCandump, LogFormat::kPcap, LogFormat::kPcapng,
                                   LogFormat::kTrc, LogFormat::kGvret})
      EXPECT_TRUE(convert(log, format, file).faithful) << file << " " << name_of(format);
  }
}

}  // namespace
}  // namespace vericansim
