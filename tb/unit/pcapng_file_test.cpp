// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// pcapng: blocks put together after the published layout; what tshark writes is read, what we write
// tshark reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/capture_files.hpp"
#include "harness/input_error_of.hpp"
#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "trace/candump.hpp"
#include "trace/pcapng_file.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

const std::string kFrame{"\0\0\x01\x23\x01\0\0\0\x77", 9};  // 123#77

std::string error_of(const std::string &bytes) {
  return input_error_of([&] { return parse_log(bytes, "a.pcapng"); });
}

class Pcapng : public ::testing::TestWithParam<bool> {};

TEST_P(Pcapng, ReadsInterfacesResolutionsAndDirections) {
  Blocks file{GetParam()};
  file.section()
      .interface(227, file.option(2, "can0") + file.option(9, "\x09") + file.option(0, ""))
      .interface(227, file.option(2, "my can\x7F") + file.option(14, file.number(1000, 8)))
      .interface(1)
      .block(0x0BAD, "not known")
      .packet(0, 1'000'000'001'500, kFrame, file.option(2, file.number(2, 4)) + file.option(0, ""))
      .packet(1, 7, kFrame)
      .packet(2, 1'000'000'000, "Ethernet")
      .block(3, file.number(kFrame.size(), 4) + kFrame)
      .block(2, file.number(1, 2) + file.number(0, 2) + file.number(0, 4) + file.number(8, 4) +
                    file.number(kFrame.size(), 4) + file.number(kFrame.size(), 4) + kFrame);
  const CanLog log = parse_log(file.bytes, "a.pcapng");
  ASSERT_EQ(log.entries.size(), 4U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 1, {0x77}}));
  EXPECT_EQ(log.entries[0].channel, "can0");
  EXPECT_EQ(log.entries[0].direction, Direction::kSent);
  EXPECT_EQ(log.start_ns, 1'000'000'001'500);
  EXPECT_EQ(log.entries[1].channel, "my_can_");
  EXPECT_EQ(log.entries[1].time, 5'500 * kNanosecond);  // 1000 s + 7 us
  EXPECT_EQ(log.entries[1].direction, Direction::kUnknown);
  // The simple block: the first interface, and the time of the packet before it.
  EXPECT_EQ(log.entries[2].channel, "can0");
  EXPECT_EQ(log.entries[2].time, -1'500 * kNanosecond);
  // The block that was in use before.
  EXPECT_EQ(log.entries[3].channel, "my_can_");
  EXPECT_EQ(log.entries[3].time, 6'500 * kNanosecond);
  EXPECT_EQ(skipped_text(log), "1 other line or packet");
}
INSTANTIATE_TEST_SUITE_P(ByteOrders, Pcapng, ::testing::Bool());

// 2^-10 s, and a second section that begins anew.
TEST(Pcapng, BinaryResolutionAndSeveralSections) {
  Blocks file{false};
  file.section().interface(227, file.option(9, "\x8A")).packet(0, 1024 + 512, kFrame);
  Blocks second{true};
  second.section().interface(227).packet(0, 2'500'000, kFrame);
  const CanLog log = parse_log(file.bytes + second.bytes, "a.pcapng");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.start_ns, 1'500'000'000);
  EXPECT_EQ(log.entries[1].time, kSecond);
}

TEST(Pcapng, DamagedFilesGiveOneLine) {
  Blocks whole{false};
  whole.section().interface(227).packet(0, 0, kFrame);
  for (std::size_t cut = 5; cut < whole.bytes.size(); ++cut) {
    if (cut == 28 || cut == 48) continue;  // between blocks
    EXPECT_THAT(error_of(whole.bytes.substr(0, cut)), HasSubstr(": cut short")) << cut;
  }
  Blocks none{false};
  EXPECT_EQ(error_of(none.section().packet(0, 0, kFrame).bytes),
            "a.pcapng: block 2: there is no interface 0");
  Blocks fine{false};
  EXPECT_THAT(error_of(fine.section().interface(227, fine.option(9, "\x13")).bytes),
              HasSubstr("block 2: time resolution 19 is not allowed"));
  std::string lengths = whole.bytes;
  lengths[24] ^= 4;
  EXPECT_EQ(error_of(lengths), "a.pcapng: block 1: its two lengths differ");
  for (const unsigned length : {0U, 8U, 10U, 13U}) {
    std::string other = whole.bytes;
    other[4] = static_cast<char>(length);
    EXPECT_EQ(error_of(other), "a.pcapng: block 1: length " + std::to_string(length) +
                                   " is not allowed; allowed: 12 and more, by four");
  }
  std::string mark = whole.bytes;
  mark[8] ^= 4;
  EXPECT_EQ(error_of(mark), "a.pcapng: block 1: the section has no byte-order mark");
}

// Stamps of 64 bits in whole seconds, and an offset of as many, lead beyond what 64 bits of
// nanoseconds hold.
TEST(Pcapng, TimesOutOfRangeAreRefused) {
  const auto refusal = [](std::uint64_t ticks, std::uint64_t offset) {
    Blocks file{false};
    file.section()
        .interface(227,
                   file.option(9, std::string(1, '\0')) + file.option(14, file.number(offset, 8)))
        .packet(0, ticks, kFrame);
    return error_of(file.bytes);
  };
  const std::string words = "a.pcapng: block 3: time is out of range; allowed: up to the year 2262";
  constexpr std::uint64_t kLast = 9'223'372'036;  // 2^63 ns in seconds
  EXPECT_EQ(refusal(kLast, 0), "no error");
  EXPECT_EQ(refusal(kLast + 1, 0), words);
  EXPECT_EQ(refusal(~0ULL, 0), words);
  EXPECT_EQ(refusal(0, kLast), "no error");
  EXPECT_EQ(refusal(0, kLast + 1), words);
  EXPECT_EQ(refusal(1, kLast), words);
}

const std::string kAll =
    "(1700000000.000000001) can0 123#1122 R\n(1700000000.000000002) vcan1 12345678#R8_F T\n"
    "(1700000000.000001000) can0 1ABCDEF0##3AABB\n(1700000001.0) can0 123#0102030405060708_9\n"
    "(1700000001.5) can0 20000080#0000000000000000\n";

TEST(Pcapng, HoldsAllThatALogHolds) {
  const CanLog log = parse_candump(kAll, "log");
  const CanLog again = parse_log(pcapng_bytes(log), "a.pcapng");
  ASSERT_EQ(again.entries.size(), 3U);
  EXPECT_EQ(again.start_ns, log.start_ns);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.entries[i].frame, log.entries[i].frame);
    EXPECT_EQ(again.entries[i].time, log.entries[i].time);
    EXPECT_EQ(again.entries[i].channel, log.entries[i].channel);
    EXPECT_EQ(again.entries[i].direction, log.entries[i].direction);
  }
  ASSERT_EQ(again.others.size(), 2U);
  EXPECT_EQ(again.others[0].text, "1ABCDEF0##3AABB");
  EXPECT_EQ(again.others[1].text, "20000080#0000000000000000");
}

// tshark as judge, both ways.
TEST(Pcapng, TsharkReadsAndWritesTheSame) {
  if (!has_program("tshark")) GTEST_SKIP() << "tshark is not installed";
  const ScratchFolder folder;
  const std::string ours = folder.file("ours.pcapng", pcapng_bytes(parse_candump(kAll, "log")));
  EXPECT_EQ(shell("tshark -r " + ours +
                  " -T fields -E separator=, -e frame.time_epoch -e frame.interface_name -e can.id "
                  "-e can.flags.xtd -e can.flags.rtr -e can.flags.err -e can.len 2> /dev/null")
                .text,
            "1700000000.000000001,can0,291,0,0,0,2\n"
            "1700000000.000000002,vcan1,305419896,1,1,0,8\n"
            "1700000000.000001000,can0,448585456,1,,,2\n"
            "1700000001.000000000,can0,291,0,0,0,8\n"
            "1700000001.500000000,can0,,,,1,8\n");
  const std::string theirs = folder / "theirs.pcapng";
  ASSERT_EQ(shell("tshark -r " + ours + " -w " + theirs + " -F pcapng 2> /dev/null").code, 0);
  const CanLog log = read_log(theirs);
  ASSERT_EQ(log.entries.size(), 3U);
  EXPECT_EQ(log.entries[1].channel, "vcan1");
  EXPECT_EQ(log.entries[1].frame, (Frame{0x12345678, true, true, 15, {}}));
  EXPECT_EQ(log.others.size(), 2U);
}

}  // namespace
}  // namespace vericansim
