// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// candump's screen output with its options. The lines are as the format strings of can-utils'
// candump.c and lib.c make them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "harness/time_zone.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

std::string error_of(const std::string &text) {
  return input_error_of([&] { return parse_candump(text, "log"); });
}

std::vector<Time> times_of(const CanLog &log) {
  std::vector<Time> times;
  for (const LogEntry &entry : log.entries) times.push_back(entry.time);
  return times;
}

TEST(CandumpScreen, FdLinesAreCountedAndKept) {
  const CanLog log = parse_log(
      "  can0  123  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B\n"
      "  can0  123  [08]  00 01 02 03 04 05 06 07\n"
      "  can0  124   [1]  FF\n",
      "log");
  ASSERT_EQ(log.entries.size(), 1U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x124, false, false, 1, {0xFF}}));
  EXPECT_EQ(log.skipped, 2U);
  EXPECT_EQ(log.count(ForeignEntry::Kind::kFd), 2U);
  EXPECT_EQ(log.others.at(0).text, "123##0000102030405060708090A0B");
  EXPECT_EQ(log.others.at(1).text, "123##00001020304050607");
  EXPECT_EQ(skipped_text(log), "2 CAN FD frames");
}

// -x: "TX"/"RX", then B (bit rate switch) and E (error state indicator) of CAN FD frames.
TEST(CandumpScreen, ExtraColumnsSayDirectionAndFdFlags) {
  const CanLog log = parse_log(
      " (0.5)  can0  RX - -  123   [2]  11 22\n"
      " (0.6)  can0  TX - -  00000001   [0]  remote request\n"
      " (0.7)  can0  TX B E  123  [01]  77\n",
      "log");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.entries[0].direction, Direction::kReceived);
  EXPECT_EQ(log.entries[1].direction, Direction::kSent);
  EXPECT_EQ(log.entries[1].frame, (Frame{1, true, true, 0, {}}));
  EXPECT_EQ(log.others.at(0).text, "123##377");
  EXPECT_EQ(log.others.at(0).direction, Direction::kSent);
  EXPECT_EQ(log.others.at(0).before, 2U);
}

// The kind of a file is seen by its first line, here one without a time.
TEST(CandumpScreen, ExtraColumnsWithoutTimesAreRecognised) {
  const CanLog log = parse_log("  can0  TX - -  123   [2]  11 22\n", "log");
  ASSERT_EQ(log.entries.size(), 1U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 2, {0x11, 0x22}}));
  EXPECT_EQ(log.entries[0].direction, Direction::kSent);
}

// candump -l -x of newer can-utils, and python-can.
TEST(CandumpScreen, LogLinesHaveTheDirectionBehindTheFrame) {
  const CanLog log =
      parse_candump("(1.0) can0 123#11 T\n(1.1) can0 123#12 R\n(1.2) can0 01F#\n", "log");
  ASSERT_EQ(log.entries.size(), 3U);
  EXPECT_EQ(log.entries[0].direction, Direction::kSent);
  EXPECT_EQ(log.entries[1].direction, Direction::kReceived);
  EXPECT_EQ(log.entries[2].direction, Direction::kUnknown);
}

/// The log as a computer of that time zone reads it.
CanLog read_in_zone(const char *wanted, const std::string &text) {
  const TimeZone zone{wanted};
  return parse_log(text, "log");
}

// -tA is local time; the zone is that of the computer that reads.
TEST(CandumpScreen, AbsoluteDates) {
  const CanLog log = read_in_zone("XYZ-2",  // two hours east
                                  " (2023-01-15 02:00:01.000250)  can0  123   [1]  11\n"
                                  " (2023-01-15 02:00:02.000251)  can0  123   [1]  12\n");
  EXPECT_EQ(times_of(log), (std::vector<Time>{0, kSecond + kMicrosecond}));
  EXPECT_EQ(log.start_ns, 1'673'740'801'000'250'000);  // date -u -d '2023-01-15 00:00:01' +%s
  // In summer the clocks of Berlin are two hours ahead: date -u -d '2023-07-15 00:00:01' +%s
  EXPECT_EQ(read_in_zone("CET-1CEST,M3.5.0,M10.5.0/3",
                         " (2023-07-15 02:00:01.000000)  can0  123   [1]  11\n")
                .start_ns,
            1'689'379'201'000'000'000);
  // 2^63 ns are over on 2262-04-11 at 23:47.
  EXPECT_EQ(read_in_zone("UTC", " (2262-04-11 23:47:16.850000)  can0  123   [1]  11\n").start_ns,
            9'223'372'036'850'000'000);
  const TimeZone zone{"UTC"};
  for (const char *stamp : {"2262-04-11 23:47:16.860000)", "2262-04-11 23:47:17.000000)",
                            "9999-01-01 00:00:00.000000)"})
    EXPECT_EQ(
        error_of(" (" + std::string(stamp) + "  can0  123   [1]  11\n"),
        "log:1: time '(" + std::string(stamp) + "' is out of range; allowed: up to the year 2262");
  for (const char *stamp : {"2023-13-15 02:00:01.000250)", "2023-01-15 02:00:01)",
                            "2023-01-15 02:00:01.000250", "2023-01-15 02:00:01,25)"})
    EXPECT_EQ(error_of(" (" + std::string(stamp) + "  can0  123   [1]  11\n"),
              "log:1: time '(" + std::string(stamp) +
                  "' is not allowed; allowed: (YYYY-MM-DD HH:MM:SS.ffffff)");
}

TEST(CandumpScreen, TimesSinceTheFirstLineAndSinceTheLineBefore) {
  const std::string zero = " (000.000000)  can0  001   [0]\n (000.000100)  can0  002   [0]\n";
  EXPECT_EQ(times_of(parse_log(zero + " (000.000300)  can0  003   [0]\n", "log")),
            (std::vector<Time>{0, 100 * kMicrosecond, 300 * kMicrosecond}));  // -tz
  EXPECT_EQ(times_of(parse_log(zero + " (000.000050)  can0  003   [0]\n", "log")),
            (std::vector<Time>{0, 100 * kMicrosecond, 150 * kMicrosecond}));  // -td
  EXPECT_EQ(
      error_of(zero + " (000.000050)  can0  003   [0]\n (9223372036.854775)  can0  004   [0]\n"),
      "log:4: times are too far apart");
  // Absolute times may go back a little: several interfaces.
  EXPECT_EQ(
      times_of(parse_log(" (10.000100)  can0  001   [0]\n (10.000090)  can1  002   [0]\n", "log")),
      (std::vector<Time>{0, -10 * kMicrosecond}));
}

// -a shows the bytes as text, -e explains error messages, -8 shows the raw DLC.
TEST(CandumpScreen, OtherOptions) {
  const CanLog log = parse_log(
      "  can0  123   [3]  41 20 42                 'A B'\n"
      "  can0  20000088   [8]  00 00 08 19 00 00 00 00   ERRORFRAME\n"
      "\tprotocol-violation{{bit-stuffing-error}{acknowledge-slot}}\n"
      "\tbus-error\n"
      "  can0  123   {C}  01 02 03 04 05 06 07 08\n"
      "DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3)\n",
      "log");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 3, {0x41, 0x20, 0x42}}));
  EXPECT_EQ(log.entries[1].frame, (Frame{0x123, false, false, 12, {1, 2, 3, 4, 5, 6, 7, 8}}));
  EXPECT_EQ(log.others.at(0).text, "20000088#0000081900000000");
  EXPECT_EQ(skipped_text(log), "1 error message, 1 other line or packet");
}

TEST(CandumpScreen, ErrorsNameLineValueAndWhatIsAllowed) {
  EXPECT_THAT(error_of("  can0  123   [9]  11\n"), HasSubstr("log:1: length '[9]'"));
  EXPECT_THAT(error_of("  can0  123  [65]  11\n"), HasSubstr("CAN FD [00] to [64]"));
  EXPECT_THAT(error_of("  can0  123   [2]  11\n"),
              HasSubstr("1 data bytes where the length says 2"));
  EXPECT_THAT(error_of("  can0  123   [2]  11 22 33 44\n"),
              HasSubstr("4 data bytes where the length says 2"));
  EXPECT_THAT(error_of("  can0  123   [2]  11 2\n"), HasSubstr("data byte '2'"));
  EXPECT_THAT(error_of("  can0  123   [1]  GG\n"), HasSubstr("data byte 'GG'"));
  EXPECT_THAT(error_of("\tbus-error\n"), HasSubstr("expected (TIME) INTERFACE FRAME"));
}

}  // namespace
}  // namespace vericansim
