// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// pcapng: blocks put together after the published layout; what tshark writes is read, what we write
// tshark reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "trace/candump.hpp"
#include "trace/pcapng_file.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// Puts a file together.
class Blocks {
 public:
  explicit Blocks(bool big) : big_{big} {}
  [[nodiscard]] std::string number(std::uint64_t value, unsigned count) const {
    std::string field;
    for (unsigned i = 0; i < count; ++i)
      field += static_cast<char>(value >> 8 * (big_ ? count - 1 - i : i));
    return field;
  }
  [[nodiscard]] std::string option(unsigned code, std::string value) const {
    const std::string head = number(code, 2) + number(value.size(), 2);
    value.resize((value.size() + 3) / 4 * 4, '\0');
    return head + value;
  }
  Blocks &block(std::uint32_t type, std::string body) {
    body.resize((body.size() + 3) / 4 * 4, '\0');
    bytes += number(type, 4) + number(body.size() + 12, 4) + body + number(body.size() + 12, 4);
    return *this;
  }
  Blocks &section() {
    return block(0x0A0D0D0A,
                 number(0x1A2B3C4D, 4) + number(1, 2) + number(0, 2) + number(~0ULL, 8));
  }
  Blocks &interface(unsigned link_type, const std::string &options = {}) {
    return block(1, number(link_type, 2) + number(0, 2) + number(0, 4) + options);
  }
  Blocks &packet(unsigned interface, std::uint64_t ticks, std::string data,
                 const std::string &options = {}) {
    const std::string head = number(interface, 4) + number(ticks >> 32, 4) + number(ticks, 4) +
                             number(data.size(), 4) + number(data.size(), 4);
    if (!options.empty()) data.resize((data.size() + 3) / 4 * 4, '\0');
    return block(6, head + data + options);
  }
  std::string bytes;

 private:
  bool big_;
};

const std::string kFrame{"\0\0\x01\x23\x01\0\0\0\x77", 9};  // 123#77

std::string error_of(const std::string &bytes) {
  return input_error_of([&] { return parse_log(bytes, "a.pcapng"); });
}

class Pcapng : public ::testing::TestWithParam<bool> {};

TEST_P(Pcapng, ReadsInterfacesResolutionsAndDirections) {
  Blocks file{GetParam()};
  file.section()
      .interface(227, file.option(2, "can0") + file.option(9, "\x09") + file.option(0, ""))
      .interface(227, file.option(2, "my can") + file.option(14, file.number(1000, 8)))
      .interface(1)
      .block(0x0BAD, "not known")
      .packet(0, 1'000'000'001'500, kFrame, file.option(2, file.number(2, 4)) + file.option(0, ""))
      .packet(1, 7, kFrame)
      .packet(2, 0, "Ethernet")
      .block(3, file.number(kFrame.size(), 4) + kFrame);
  const CanLog log = parse_log(file.bytes, "a.pcapng");
  ASSERT_EQ(log.entries.size(), 3U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 1, {0x77}}));
  EXPECT_EQ(log.entries[0].channel, "can0");
  EXPECT_EQ(log.entries[0].direction, Direction::kSent);
  EXPECT_EQ(log.start_ns, 1'000'000'001'500);
  EXPECT_EQ(log.entries[1].channel, "my_can");
  EXPECT_EQ(log.entries[1].time, 5'500 * kNanosecond);  // 1000 s + 7 us
  EXPECT_EQ(log.entries[1].direction, Direction::kUnknown);
  EXPECT_EQ(log.entries[2].channel, "can0");
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
  std::string mark = whole.bytes;
  mark[8] ^= 4;
  EXPECT_EQ(error_of(mark), "a.pcapng: block 1: the section has no byte-order mark");
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
