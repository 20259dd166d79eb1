// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// python-can's formats: ASC texts as Vector's tools write them, there and back through each format,
// and python-can itself, called apart, as judge of what was written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "harness/input_error_of.hpp"
#include "harness/scoped_env.hpp"
#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "trace/candump.hpp"
#include "trace/log_walk.hpp"
#include "trace/python_log.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

class PythonLog : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_python_can()) GTEST_SKIP() << "python3-can is not installed";
  }
};

std::string lines_of(const CanLog &log) {
  std::ostringstream text;
  CandumpWriter writer{text, log.start_ns, true};
  const auto write = [&writer](const auto &entry) { writer.write(entry); };
  walk(log, write, write);
  return text.str();
}

std::string error_of(const std::string &bytes) {
  return input_error_of([&] { return parse_log(bytes, "a.log"); });
}

TEST_F(PythonLog, WithoutPythonCanItsPackageIsNamed) {
  const ScratchFolder folder;
  std::ofstream{folder / "can.py"} << "raise ImportError('not there')\n";
  const ScopedEnv modules{"PYTHONPATH", folder.path()};
  EXPECT_EQ(error_of("date Fri Mar 8 09:41:17 am 2024\n"),
            "a.log: needs the Python package can (Debian: python3-can): not there");
}

// As python-can has it since February 2026.
TEST_F(PythonLog, AscDatesWithAPythonCanThatAsksForATimeZone) {
  const ScratchFolder folder;
  std::ofstream{folder / "sitecustomize.py"}
      << "import can\n"
         "read = can.io.ASCReader._datetime_to_timestamp\n"
         "can.io.ASCReader._datetime_to_timestamp = staticmethod(lambda text, tz: read(text))\n";
  const ScopedEnv modules{"PYTHONPATH", folder.path()};
  const CanLog log = parse_log(
      "date Fri Mar 8 09:41:17.123 am 2024\nbase hex timestamps absolute\n0.5 1 64 Rx d 1 64\n",
      "a.asc");
  EXPECT_EQ(log.start_ns % 1'000'000'000, 623'000'000);
  EXPECT_EQ(log.warnings, std::vector<std::string>{});
}

// Frame lines without "internal events logged", a raw DLC, remote frames, CAN FD, error frames, and
// lines that are no frames.
TEST_F(PythonLog, ReadsAsc) {
  const CanLog log = parse_log(
      "base hex  timestamps absolute\n"
      "   0.000100 1  64              Rx   d 4 64 00 00 00  Length = 0 BitCount = 0 ID = 100\n"
      "   0.000200 2  18EBFF00x       Tx   d D 55 AA 01 02 03 04 05 06  Length = 232016\n"
      "   0.000300 1  300 Rx r 8 Length = 1704000 BitCount = 145 ID = 88888888x\n"
      "   0.000400 CANFD   1 Rx        30a  Name  1 0 8  8 01 02 03 04 05 06 07 08   102203  133\n"
      "   0.000500 2 ErrorFrame\n"
      "   1.000500 2  Statistic: D 0 R 0 XD 0 XR 0 E 0 O 0 B 0.00%\n",
      "a.asc");
  EXPECT_EQ(lines_of(log),
            "(0000000000.000100000) can0 064#64000000 R\n"
            "(0000000000.000200000) can1 18EBFF00#55AA010203040506_D T\n"
            "(0000000000.000300000) can0 300#R8 R\n"
            "(0000000000.000400000) can0 30A##10102030405060708 R\n"
            "(0000000000.000500000) can1 20000000#\n");
  EXPECT_EQ(skipped_text(log), "1 CAN FD frame, 1 error message, 1 other line or packet");
}

// DLC of remote frames in either base: no length of CAN FD, and a letter in hexadecimal. Words
// behind "r" that are no number are none.
TEST_F(PythonLog, AscRemoteFramesOfEveryDlc) {
  std::string wanted, small, capital, decimal;
  for (unsigned dlc = 0; dlc < 16; ++dlc) {
    wanted += fmt::format("(0000000000.{:02}0000000) can0 300#R{}{} R\n", dlc,
                          dlc == 0 ? "" : std::to_string(std::min(dlc, 8U)),
                          dlc > 8 ? fmt::format("_{:X}", dlc) : "");
    small += fmt::format("   0.{:02} 1  300  Rx   r {:x} Length = 1704000\n", dlc, dlc);
    capital += fmt::format("   0.{:02} 1  300  Rx   r {:X}\n", dlc, dlc);
    decimal += fmt::format("   0.{:02} 1  768  Rx   r {}\n", dlc, dlc);
  }
  for (const std::string &text :
       {"hex  timestamps absolute\n" + small, "hex  timestamps absolute\n" + capital,
        "dec  timestamps absolute\n" + decimal})
    EXPECT_EQ(lines_of(parse_log("base " + text, "a.asc")), wanted);
  EXPECT_THAT(error_of("base hex  timestamps absolute\n0.1 1 64 Rx r 10\n"),
              HasSubstr("message 1: DLC 16 with 0 bytes"));
  EXPECT_THAT(
      lines_of(parse_log("base hex  timestamps absolute\n0.1 1 64 Rx r Length = 0\n", "a.asc")),
      HasSubstr("064#R R"));
}

// DLC 9 to 15 of remote and data frames there and back.
TEST_F(PythonLog, EveryFormatHoldsEveryDlc) {
  std::string text;
  for (unsigned dlc = 9; dlc < 16; ++dlc)
    text += fmt::format(
        "(1700000000.{0:06}000) can0 123#R8_{0:X} R\n"
        "(1700000001.{0:06}000) can0 123#0102030405060708_{0:X} R\n",
        dlc);
  for (const LogFormat format : {LogFormat::kAsc, LogFormat::kBlf})
    EXPECT_EQ(lines_of(parse_log(python_log_bytes(parse_candump(text, "log"), format, "a"), "a")),
              text);
}

// A request to send is told before the frame itself, by an event of its own.
TEST_F(PythonLog, AscRequestsToSendAreCountedAsNoFrames) {
  const CanLog log = parse_log(
      "base hex  timestamps absolute\n"
      "   0.010000 1  321             TxRq   d 2 11 22\n"
      "   0.010300 1  321             Tx   d 2 11 22 Length = 100000 BitCount = 50\n"
      "   0.020000 CANFD   1 TxRq     30a  Name  1 0 8  8 01 02 03 04 05 06 07 08   102203  133\n"
      "   0.020300 CANFD   1 Tx       30a  Name  1 0 8  8 01 02 03 04 05 06 07 08   102203  133\n"
      "   0.030000 1  321             TxRq   r 3\n",
      "a.asc");
  EXPECT_EQ(lines_of(log),
            "(0000000000.010300000) can0 321#1122 T\n"
            "(0000000000.020300000) can0 30A##10102030405060708 T\n");
  EXPECT_EQ(skipped_text(log), "1 CAN FD frame, 3 other lines or packets");
}

// Neither a direction nor a kind of frame that nobody knows is one of those that are known.
TEST_F(PythonLog, AscLinesWithoutADirectionOrAKindAreCountedAsNoFrames) {
  const std::string fd = "   123  Name  1 0 8  8 01 02 03 04 05 06 07 08   102203  133\n";
  const CanLog log = parse_log(
      "base hex  timestamps absolute\n"
      "   0.010000 1  321             Rx?   d 2 11 22\n"
      "   0.020000 1  321             Rx   x 2 11 22\n"
      "   0.030000 1  322             rx   D 1 33\n"
      "   0.040000 1  323             TX   R 3\n"
      "   0.050000 CANFD   1 R?x" +
          fd + "   0.060000 CANFD   1 rx" + fd,
      "a.asc");
  EXPECT_EQ(lines_of(log),
            "(0000000000.030000000) can0 322#33 R\n"
            "(0000000000.040000000) can0 323#R3 T\n"
            "(0000000000.060000000) can0 123##10102030405060708 R\n");
  EXPECT_EQ(skipped_text(log), "1 CAN FD frame, 3 other lines or packets");
}

std::string little_endian(std::uint64_t value, unsigned count) {
  std::string bytes;
  for (unsigned i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i);
  return bytes;
}

std::string blf_object(unsigned type, unsigned version, const std::string &body) {
  return "LOBJ" + little_endian(version == 1 ? 32 : 40, 2) + little_endian(version, 2) +
         little_endian(16 + body.size(), 4) + little_endian(type, 4) + body;
}

/// A frame 123#11 of CAN; header of version 1 or 2. Flags: the direction is the lower half.
std::string blf_frame(unsigned type, unsigned version, unsigned flags, std::uint64_t ns) {
  const std::string stamp = little_endian(2, 8) + little_endian(ns, version == 1 ? 8 : 16);
  return blf_object(type, version,
                    stamp + little_endian(1, 2) + little_endian(flags, 1) + little_endian(1, 1) +
                        little_endian(0x123, 4) + little_endian(0x11, 8));
}

/// A frame of identifier 124 in the two forms of CAN FD controllers: CAN FD unless `classical`;
/// bytes 22, 0, 0, ...
struct BlfFd {
  unsigned dlc = 1, bytes = 1;
  bool classical = false;
};
std::string blf_fd_frame(unsigned flags, std::uint64_t ns, const BlfFd &fd = {}) {
  return blf_object(100, 1,
                    little_endian(2, 8) + little_endian(ns, 8) + little_endian(1, 2) +
                        little_endian(flags, 1) + little_endian(fd.dlc, 1) +
                        little_endian(0x124, 8) + little_endian(0, 1) +
                        little_endian(fd.classical ? 0 : 1, 1) + little_endian(fd.bytes, 6) +
                        little_endian(0x22, 8) + std::string(56, '\0'));
}
std::string blf_fd64_frame(unsigned direction, std::uint64_t ns, const BlfFd &fd = {}) {
  return blf_object(101, 1,
                    little_endian(2, 8) + little_endian(ns, 8) + little_endian(1, 1) +
                        little_endian(fd.dlc, 1) + little_endian(fd.bytes, 2) +
                        little_endian(0x124, 8) + little_endian(fd.classical ? 0 : 0x1000, 8) +
                        std::string(14, '\0') + little_endian(direction, 6) +
                        little_endian(0x22, 8));
}

/// The file of these containers, none of them compressed.
std::string blf_file(const std::vector<std::string> &containers) {
  std::string body;
  for (const std::string &data : containers)
    body += blf_object(10, 1, little_endian(0, 8) + little_endian(data.size(), 8) + data) +
            std::string((32 + data.size()) % 4, '\0');
  return "LOGG" + little_endian(72, 12) + little_endian(72 + body.size(), 8) +
         std::string(48, '\0') + body;
}

// A request to send is an object of its own, of direction 2, before that of the frame; one of them
// goes on in the next container.
TEST_F(PythonLog, BlfRequestsToSendAreCountedAsNoFrames) {
  const std::string sent = "(0000000000.000001000) can0 123#11 T\n";
  const std::string data =
      blf_frame(1, 1, 2, 500) + blf_frame(86, 1, 0x11, 1000) + blf_frame(86, 2, 0x42, 1500) +
      blf_fd_frame(2, 2000) + blf_fd_frame(1, 2500) + blf_fd64_frame(2, 3000) +
      blf_fd64_frame(1, 3500) + blf_frame(1, 1, 2, 4000) + blf_frame(1, 1, 0, 4500);
  for (const std::size_t cut : {data.size() - 70, data.size() - 40, std::size_t{20}}) {
    const CanLog log = parse_log(blf_file({data.substr(0, cut), data.substr(cut)}), "a.blf");
    EXPECT_EQ(lines_of(log), sent +
                                 "(0000000000.000002500) can0 124##022 T\n"
                                 "(0000000000.000003500) can0 124##022 T\n"
                                 "(0000000000.000004500) can0 123#11 R\n");
    EXPECT_EQ(skipped_text(log), "2 CAN FD frames, 5 other lines or packets") << cut;
  }
}

// DLC 9 to 15 of a classical frame are eight bytes, whatever they would be in CAN FD.
TEST_F(PythonLog, BlfClassicalFramesOfCanFdControllersKeepTheirDlc) {
  std::string data = blf_frame(1, 1, 0, 500), wanted = "(0000000000.000000500) can0 123#11 R\n";
  for (unsigned dlc = 8; dlc < 16; ++dlc) {
    const BlfFd fd{.dlc = dlc, .bytes = 8, .classical = true};
    data += blf_fd_frame(0, dlc * 1000, fd) + blf_fd64_frame(0, dlc * 1000, fd);
    const std::string line = fmt::format("(0000000000.{:09}) can0 124#2200000000000000{} R\n",
                                         dlc * 1000, dlc == 8 ? "" : fmt::format("_{:X}", dlc));
    wanted += line + line;
  }
  for (const std::size_t cut : {data.size() - 70, data.size() / 2})
    EXPECT_EQ(lines_of(parse_log(blf_file({data.substr(0, cut), data.substr(cut)}), "a.blf")),
              wanted);
}

// An object of no size had no end.
TEST_F(PythonLog, BlfObjectsWithoutSizeAreRefused) {
  std::string data = blf_frame(1, 1, 1, 500);
  data[8] = 0;
  EXPECT_EQ(error_of(blf_file({data})), "a.log: object of 0 bytes; allowed: 16 or more");
}

// Dates as other programs write them: the frames are read, and their times are not those of day.
TEST_F(PythonLog, AscWithADateThatCannotBeReadIsWarnedOf) {
  const auto warnings = [](const std::string &date) {
    const CanLog log = parse_log(
        date + "base hex  timestamps absolute\n0.1 1 64 Rx d 1 11\n0.2 1 65 Rx d 1 11\n", "a.asc");
    EXPECT_EQ(log.entries.size(), 2U) << date;
    return log.warnings;
  };
  EXPECT_THAT(warnings("date 30.10.2024 15:00:00\n"),
              testing::ElementsAre("line 1: 'date 30.10.2024 15:00:00' has no date that can be "
                                   "read, so times count from 1970; allowed: date Fri Mar 8 "
                                   "09:41:17.123 am 2024"));
  EXPECT_THAT(warnings("date 30.\x1b[1m 15:00:00\n"),
              testing::ElementsAre(HasSubstr("'date 30.?[1m 15:00:00' has no date")));
  EXPECT_THAT(warnings("date Wed Oct 30 03:00:00.000 PM 2024\n"), testing::IsEmpty());
  EXPECT_THAT(warnings("date Wed Oct 30 15:00:00 2024\n"), testing::IsEmpty());
  EXPECT_THAT(warnings(""), testing::IsEmpty());
}

const std::string kFrames =
    "(1700000000.123456789) can0 123#1122 R\n"
    "(1700000000.123456790) can1 12345678#0102030405060708_B T\n"
    "(1700000000.123456000) can0 7FF#R3 R\n"  // earlier than the first
    "(1700000003.000000001) can0 00000000# T\n";
const std::string kFd = "(1700000003.500000001) can1 1ABCDEF0##3AABBCCDD R\n";

// BLF has nanoseconds and everything else.
TEST_F(PythonLog, BlfHoldsFramesToTheNanosecond) {
  const CanLog log = parse_candump(kFrames + kFd, "log");
  const std::string bytes = python_log_bytes(log, LogFormat::kBlf, "a.blf");
  EXPECT_EQ(detect_log_format(bytes, "a.blf"), LogFormat::kBlf);
  EXPECT_EQ(lines_of(parse_log(bytes, "a.blf")), kFrames + kFd);
}

// Times that a floating-point number of seconds does not meet.
TEST_F(PythonLog, BlfHoldsEveryNanosecond) {
  std::string text;
  for (int i = 0; i < 2000; ++i)
    text += fmt::format("(17000{:05d}.{:09d}) can0 123# R\n", i, i * 7'654'321LL % 1'000'000'000);
  const std::string bytes = python_log_bytes(parse_candump(text, "log"), LogFormat::kBlf, "a.blf");
  EXPECT_EQ(lines_of(parse_log(bytes, "a.blf")), text);
}

// ASC as python-can writes it has microseconds.
TEST_F(PythonLog, AscHoldsFramesToTheMicrosecond) {
  const std::string whole =
      "(1700000000.123457000) can0 123#1122 R\n(1700000000.123456000) can1 1ABCDEF0##3AABBCCDD T\n"
      "(1700000000.223456000) can3 7FF#R3 R\n(1700000000.323456000) can2 "
      "20000000#\n(1700086400.000001000) can0 "
      "00000001#0102030405060708_F "
      "R\n";
  const CanLog log = parse_candump(whole, "log");
  const std::string bytes = python_log_bytes(log, LogFormat::kAsc, "a.asc");
  EXPECT_EQ(lines_of(parse_log(bytes, "a.asc")), whole);
}

// CSV and SQLite have no interfaces, no directions and no CAN FD.
TEST_F(PythonLog, CsvAndSqliteHoldFramesToTheMicrosecond) {
  const std::string text =
      "(1700000000.123457000) can0 123#1122\n(1700000000.123456000) can0 12345678#R3\n"
      "(1700000000.223456000) can0 20000080#0001020304050607\n"
      "(1700086400.000001000) can0 00000001#0102030405060708_F\n";
  for (const LogFormat format : {LogFormat::kCsv, LogFormat::kSqlite}) {
    const std::string bytes = python_log_bytes(parse_candump(text, "log"), format, "a");
    EXPECT_EQ(detect_log_format(bytes, "a"), format);
    const CanLog again = parse_log(bytes, "a");
    EXPECT_EQ(lines_of(again), text);
    EXPECT_EQ(again.entries.at(0).channel, "");
  }
}

// More frames than python-can's writer takes into one batch (501).
TEST_F(PythonLog, SqliteHoldsAsManyFramesAsThereAre) {
  std::string text;
  for (unsigned i = 0; i < 1600; ++i)
    text += fmt::format("(1700000000.{:06}000) can0 {:03X}#{:04X}\n", 100 * i, i % 0x800, i);
  const std::string bytes =
      python_log_bytes(parse_candump(text, "log"), LogFormat::kSqlite, "a.db");
  EXPECT_EQ(lines_of(parse_log(bytes, "a.db")), text);
}

// python-can's own tool reads what was written: the same frames.
TEST_F(PythonLog, PythonCanReadsTheFiles) {
  const ScratchFolder folder;
  const CanLog log =
      parse_candump("(1700000000.25) can0 123#1122\n(1700000000.5) can2 12345678#R3 T\n", "log");
  const std::string show =
      "/usr/bin/python3 -c 'import can, sys\nfor m in can.LogReader(sys.argv[1]): "
      "print(hex(m.arbitration_id), m.is_extended_id, m.is_remote_frame, m.dlc, m.data.hex(), "
      "m.channel, m.is_rx)' ";
  for (const auto &[name, format] :
       {std::pair{"a.blf", LogFormat::kBlf}, std::pair{"a.asc", LogFormat::kAsc}})
    EXPECT_EQ(shell(show + folder.file(name, python_log_bytes(log, format, name))).text,
              "0x123 False False 2 1122 0 True\n0x12345678 True True 3  2 False\n");
  for (const auto &[name, format] :
       {std::pair{"a.csv", LogFormat::kCsv}, std::pair{"a.db", LogFormat::kSqlite}})
    EXPECT_EQ(shell(show + folder.file(name, python_log_bytes(log, format, name))).text,
              "0x123 False False 2 1122 None True\n0x12345678 True True 3  None True\n");
}

std::string asc(const std::string &timestamps, const std::vector<std::string> &events) {
  std::string text = "date Fri Mar 8 09:41:17.123 am 2024\nbase hex  timestamps " + timestamps +
                     "\ninternal events logged\n"
                     "Begin Triggerblock Fri Mar 8 09:41:17.123 am 2024\n"
                     "   0.000000 Start of measurement\n";
  for (const std::string &event : events) text += "   " + event + "\n";
  return text + "End TriggerBlock\n";
}

// Each time is the distance from the event before, whatever that was.
TEST_F(PythonLog, AscWithTimesSinceTheEventBefore) {
  const CanLog relative = parse_log(
      asc("relative", {"0.250000 1  123             Rx   d 2 11 22",
                       "0.001500 CAN 1 Status:chip status error active",
                       "0.100500 2  18EF1234x       Tx   d 1 FF", "0.000010 1  ErrorFrame",
                       "900000.000001 1  124             Rx   r"}),
      "a.asc");
  const CanLog absolute = parse_log(
      asc("absolute", {"0.250000 1  123             Rx   d 2 11 22",
                       "0.251500 CAN 1 Status:chip status error active",
                       "0.352000 2  18EF1234x       Tx   d 1 FF", "0.352010 1  ErrorFrame",
                       "900000.352011 1  124             Rx   r"}),
      "a.asc");
  EXPECT_EQ(relative.entries.size(), 3U);
  EXPECT_EQ(relative.skipped, 2U);
  EXPECT_EQ(lines_of(relative), lines_of(absolute));
}

// can-utils adds the times of frames up; to compare, from the first frame on.
TEST_F(PythonLog, Asc2logReadsTheSameRelativeTimes) {
  if (shell("command -v asc2log").code != 0) GTEST_SKIP() << "asc2log (can-utils) is not installed";
  const ScratchFolder folder;
  const std::string text = asc("relative", {"0.250000 1  123             Rx   d 2 11 22",
                                            "0.100500 2  18EF1234x       Tx   d 1 FF",
                                            "1.000009 1  124             Rx   r"});
  CanLog ours = parse_log(text, "a.asc");
  CanLog theirs =
      parse_log(shell("asc2log -I " + folder.file("a.asc", text) + " 2> /dev/null").text, "a.log");
  ours.start_ns = theirs.start_ns = 0;
  EXPECT_EQ(lines_of(ours), lines_of(theirs));
}

// Every byte of the data has two digits, and there are as many bytes as the length says.
TEST_F(PythonLog, AscDataThatIsNotWhatTheLengthSaysIsRefused) {
  const auto error = [](const std::string &base, const std::string &event) {
    return error_of("base " + base + "  timestamps absolute\n" + event + "\n");
  };
  EXPECT_THAT(error("hex", "0.02 1  123  Rx   d 4 DE AD BE E"),
              HasSubstr("a.log: line 2: data byte 'E'; allowed: two hexadecimal digits"));
  EXPECT_THAT(error("hex", "0.02 CANFD 1 Rx 123 1 0 4 4 DE AD BE E"),
              HasSubstr("a.log: line 2: data byte 'E'"));
  EXPECT_THAT(error("hex", "0.02 1 123 Rx d 2 DE AD BE EF  Length = 0"),
              HasSubstr("a.log: line 2: more data than length 2; allowed: as many bytes"));
  EXPECT_THAT(error("hex", "0.02 1 123 Rx d D 00 01 02 03 04 05 06 07 08"),
              HasSubstr("a.log: line 2: more data than length 8"));
  EXPECT_THAT(error("dec", "0.02 1 123 Rx d 2 1 22 255"), HasSubstr("more data than length 2"));
  EXPECT_THAT(error("dec", "0.02 1 123 Rx d 2 1 FF"), HasSubstr("'FF'; allowed: 0 to 255"));
  const CanLog log = parse_log(
      "base dec  timestamps absolute\n0.1 1 291 Rx d 2 1 222  Length = 1 BitCount = 2 ID = 3\n",
      "a.asc");
  EXPECT_EQ(lines_of(log), "(0000000000.100000000) can0 123#01DE R\n");
}

// What is no event of a known form is counted, wherever it stands; headlines are no events.
TEST_F(PythonLog, AscLinesOfNoKnownFormAreCounted) {
  const std::string frame = "0.100000 1  124  Rx   d 1 33";
  EXPECT_EQ(parse_log(asc("absolute", {frame}), "a.asc").skipped, 0U);
  EXPECT_EQ(parse_log("// version 9.0.0\nbase hex\nno internal events logged\n\n" + frame, "a.asc")
                .skipped,
            0U);
  for (const char *line : {"rubbish", "x0.2 1 123 Rx d 1 00", "nan 1 123 Rx d 1 00", "0.2 1  12"}) {
    const CanLog log = parse_log(asc("absolute", {line, frame}), "a.asc");
    EXPECT_EQ(log.entries.size(), 1U) << line;
    EXPECT_EQ(log.skipped, 1U) << line;
  }
}

// The base of the numbers, behind headlines that python-can does not know or takes for the last.
TEST_F(PythonLog, AscHeadlinesInAnyOrder) {
  const std::string date = "date Fri Mar 8 09:41:17 am 2024\n", event = "0.1 1 291 Rx d 1 10\n";
  for (const std::string line : {"previous log file: a.asc\n", "internal events logged\n"})
    EXPECT_THAT(
        lines_of(parse_log(date + line + "base dec  timestamps absolute\n" + event, "a.asc")),
        HasSubstr(" can0 123#0A R\n"))
        << line;
  EXPECT_THAT(error_of(date + "base oct  timestamps absolute\n" + event),
              HasSubstr("line 2: 'base oct timestamps absolute'; allowed: base hex, base dec"));
}

// python-can passes over a line of a time before the start; relative times go on from it.
TEST_F(PythonLog, AscLinesBeforeTheStartAreCounted) {
  const std::vector<std::string> events{"-0.100000 1  123  Rx   d 2 11 22",
                                        "0.300000 1  124  Rx   d 1 33"};
  const CanLog absolute = parse_log(asc("absolute", events), "a.asc");
  EXPECT_EQ(absolute.entries.size(), 1U);
  EXPECT_EQ(absolute.skipped, 1U);
  const CanLog relative = parse_log(asc("relative", events), "a.asc");
  EXPECT_EQ(relative.skipped, 1U);
  EXPECT_EQ(absolute.start_ns - relative.start_ns, 100'000'000);
}

TEST_F(PythonLog, CsvColumnsThatCannotBeAreRefused) {
  const auto error = [](const std::string &row) {
    return error_of("timestamp,arbitration_id,extended,remote,error,dlc,data\n1.0,0x1,0,0,0,0,\n" +
                    row + "\n");
  };
  EXPECT_THAT(error("1000.0,0x123,True,0,0,1,3g=="),
              HasSubstr("a.log: line 3: extended is 'True'; allowed: 0 or 1"));
  EXPECT_THAT(error("1000.0,0x123,7,0,0,1,3g=="), HasSubstr("line 3: extended is '7'"));
  EXPECT_THAT(error("1000.0,0x123,0,x,0,1,3g=="), HasSubstr("line 3: remote is 'x'"));
  EXPECT_THAT(error("1000.0,0x123,0,0,,1,3g=="), HasSubstr("line 3: error is ''"));
  EXPECT_THAT(error("1000.0,0x123,0,0,0,4,3q2!+7w=="),
              HasSubstr("a.log: line 3: data '3q2!+7w=='; allowed: base64"));
  EXPECT_THAT(error("1000.0,0x123,0,0,0,2,3q2+7w=="),
              HasSubstr("a.log: message 2: DLC 2 with 4 bytes; allowed: 0 to 15 and as many"));
  EXPECT_THAT(error("1000.0,0x123,0,0,0,2,AAECAwQFBgcICQoL"),
              HasSubstr("message 2: DLC 2 with 12 bytes"));
}

// The header says how long the file is; what is missing was read as other bytes.
TEST_F(PythonLog, TimesBeforeTheEpochAreRefused) {
  const std::string head =
      "timestamp,arbitration_id,extended,remote,error,dlc,data\n0,0x1,0,0,0,0,\n";
  EXPECT_EQ(error_of(head + "-1.5,0x123,0,0,0,1,Eg==\n"),
            "a.log: message 2: time -1.5 s is not allowed; allowed: 0 s or later");
  EXPECT_EQ(error_of(head + "-0.000001,0x123,0,0,0,1,Eg==\n"),
            "a.log: message 2: time -0.000001 s is not allowed; allowed: 0 s or later");
}

TEST_F(PythonLog, SqliteFilesCutShortAreRefused) {
  const std::string whole =
      python_log_bytes(parse_candump(kFrames, "log"), LogFormat::kSqlite, "a.db");
  for (const std::size_t cut : {whole.size() - 1, whole.size() / 2, std::size_t{40}})
    EXPECT_THAT(error_of(whole.substr(0, cut)),
                HasSubstr(fmt::format("a.log: cut short: {} bytes where its header says {}", cut,
                                      whole.size())));
}

TEST_F(PythonLog, DamagedFilesGiveOneLine) {
  const std::string blf =
      python_log_bytes(parse_candump(kFrames + kFd, "log"), LogFormat::kBlf, "a.blf");
  for (const std::size_t cut : {10UL, 100UL, 150UL, blf.size() - 10, blf.size() - 1})
    EXPECT_THAT(error_of(blf.substr(0, cut)), HasSubstr("a.log: ")) << cut;
  EXPECT_THAT(error_of(blf.substr(0, 200)),
              HasSubstr("cut short: 200 bytes where its header says"));
  std::string rubbish = blf;
  for (std::size_t i = 170; i < 180; ++i) rubbish[i] ^= 0x55;
  EXPECT_THAT(error_of(rubbish), HasSubstr("damaged behind message 0: error"));  // zlib's
  EXPECT_THAT(error_of("timestamp,arbitration_id,extended,remote,error,dlc,data\n1.0,0x1\n"),
              HasSubstr("damaged behind message 0: ValueError"));
  EXPECT_THAT(error_of("timestamp,arbitration_id,extended,remote,error,dlc,data\n"
                       "1.0,0x1,0,0,0,0,\n1.0,0x800,0,0,0,0,\n"),
              HasSubstr("message 2: identifier 800 is not allowed"));
  EXPECT_THAT(error_of("SQLite format 3 but no more"), HasSubstr("DatabaseError"));
  EXPECT_THAT(error_of("base hex  timestamps absolute\n0.1 1 64 Rx d 2 11\n"),
              HasSubstr("message 1: DLC 2 with 1 bytes"));
}

}  // namespace
}  // namespace vericansim
