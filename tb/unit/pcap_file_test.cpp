// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packet captures: files put together byte by byte after the published layout, and what the writer
// makes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "harness/input_error_of.hpp"
#include "harness/shell.hpp"
#include "trace/input_error.hpp"
#include "trace/pcap_file.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// Builds a capture file as the pcap format is published: any byte order and resolution.
class CaptureBuilder {
 public:
  CaptureBuilder(bool big_endian, bool nanoseconds, std::uint32_t link_type = 227)
      : big_{big_endian} {
    word(nanoseconds ? 0xA1B23C4D : 0xA1B2C3D4);
    half(2);
    half(4);
    word(0);
    word(0);
    word(65535);
    word(link_type);
  }
  void packet(std::uint32_t seconds, std::uint32_t fraction, const std::string &bytes) {
    word(seconds);
    word(fraction);
    word(static_cast<std::uint32_t>(bytes.size()));
    word(static_cast<std::uint32_t>(bytes.size()));
    bytes_ += bytes;
  }
  std::string write(const std::string &name, std::size_t cut = std::string::npos) const {
    const std::string path = ::testing::TempDir() + name;
    std::ofstream(path, std::ios::binary) << bytes_.substr(0, cut);
    return path;
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

 private:
  void word(std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes_ += static_cast<char>(value >> 8 * (big_ ? 3 - i : i));
  }
  void half(std::uint16_t value) {
    for (int i = 0; i < 2; ++i) bytes_ += static_cast<char>(value >> 8 * (big_ ? 1 - i : i));
  }
  bool big_;
  std::string bytes_;
};

std::string packet(std::initializer_list<int> bytes) { return {bytes.begin(), bytes.end()}; }

std::string error_of(const std::string &path) {
  return input_error_of([&] { return read_pcap(path); });
}

class PcapReader : public ::testing::TestWithParam<std::tuple<bool, bool>> {};

// The identifier is big-endian in every file; only the headers follow the byte order of the writer.
TEST_P(PcapReader, ReadsEveryByteOrderAndResolution) {
  const auto [big_endian, nanoseconds] = GetParam();
  CaptureBuilder file{big_endian, nanoseconds};
  file.packet(1000, 5, packet({0, 0, 0x01, 0x23, 2, 0, 0, 0, 0xAA, 0x55}));
  file.packet(1001, 6, packet({0x80 | 0x12, 0x34, 0x56, 0x78, 0, 0, 0, 0}));
  file.packet(1001, 6, packet({0x40, 0, 0x07, 0xFF, 8, 0, 0, 0}));
  const CanLog log = read_pcap(file.write("order.pcap"));
  ASSERT_EQ(log.entries.size(), 3U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 2, {0xAA, 0x55}}));
  EXPECT_EQ(log.entries[1].frame, (Frame{0x12345678, true, false, 0, {}}));
  EXPECT_EQ(log.entries[2].frame, (Frame{0x7FF, false, true, 8, {}}));
  EXPECT_EQ(log.entries[1].time, kSecond + (nanoseconds ? kNanosecond : kMicrosecond));
  EXPECT_EQ(log.start_ns, 1'000'000'000'000 + (nanoseconds ? 5 : 5'000));
}
INSTANTIATE_TEST_SUITE_P(All, PcapReader, ::testing::Combine(::testing::Bool(), ::testing::Bool()));

TEST(Pcap, SkipsErrorMessagesAndFdFrames) {
  CaptureBuilder file{false, false};
  file.packet(1, 0, packet({0x20, 0, 0, 4, 8, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0}));
  file.packet(1, 0, packet({0, 0, 1, 0x23, 1, 4, 0, 0, 1}));
  file.packet(1, 0, packet({0, 0, 1, 0x23, 8, 0, 0, 12, 1, 2, 3, 4, 5, 6, 7, 8}));
  const CanLog log = read_pcap(file.write("skip.pcap"));
  EXPECT_EQ(log.skipped, 2U);
  ASSERT_EQ(log.entries.size(), 1U);
  EXPECT_EQ(log.entries[0].frame.dlc, 12);  // the raw DLC of Linux 5.11 and later
}

// tcpdump.org, LINKTYPE_CAN_SOCKETCAN: where CANFD_FDF is not set, a packet of 16 bytes is a CAN
// frame, one of 72 bytes a CAN FD frame, which may be as short.
TEST(Pcap, WithoutTheFlagPacketsOf72BytesAreCanFd) {
  CaptureBuilder file{false, false};
  std::string plain = packet({0, 0, 0x01, 0x23, 2, 0, 0, 0, 0xAA, 0x55});
  plain.resize(16, '\0');
  std::string fd = packet({0, 0, 0x01, 0x23, 2, 0x01, 0, 0, 0xAA, 0x55});
  fd.resize(72, '\0');
  file.packet(1000, 0, plain);
  file.packet(1000, 1, fd);
  const CanLog log = read_pcap(file.write("size.pcap"));
  ASSERT_EQ(log.entries.size(), 1U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 2, {0xAA, 0x55}}));
  ASSERT_EQ(log.others.size(), 1U);
  EXPECT_EQ(log.others[0].kind, ForeignEntry::Kind::kFd);
  EXPECT_EQ(log.others[0].text, "123##1AA55");
}

// Captures of old kernels hold whatever was in memory behind the length.
TEST(Pcap, RubbishBehindTheLengthIsIgnored) {
  CaptureBuilder file{false, false};
  file.packet(1, 0, packet({0, 0, 1, 0x23, 1, 46, 146, 4, 0x77}));
  file.packet(1, 0, packet({0, 0, 1, 0x23, 8, 45, 146, 12, 1, 2, 3, 4, 5, 6, 7, 8}));
  const CanLog log = read_pcap(file.write("rubbish.pcap"));
  EXPECT_EQ(log.skipped, 0U);
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 1, {0x77}}));
  EXPECT_EQ(log.entries[1].frame.dlc, 8);
}

// DLCs of 9 to 15 stand in the last byte of the header, where the data are eight bytes.
TEST(Pcap, RawDlcs) {
  CaptureBuilder file{false, false};
  for (const int raw : {8, 9, 15, 16})
    file.packet(1, 0, packet({0, 0, 1, 0x23, 8, 0, 0, raw, 1, 2, 3, 4, 5, 6, 7, 8}));
  file.packet(1, 0, packet({0, 0, 1, 0x23, 1, 0, 0, 9, 1}));
  const CanLog log = read_pcap(file.write("raw.pcap"));
  std::vector<unsigned> seen;
  for (const LogEntry &entry : log.entries) seen.push_back(entry.frame.dlc);
  EXPECT_EQ(seen, (std::vector<unsigned>{8, 9, 15, 8, 1}));
}

// Without the flag of CAN FD more than 8 bytes tell; more than 64, or a length that no DLC has, are
// of nobody. An error message has 8 bytes, whatever else is there.
TEST(Pcap, LengthsBeyondThoseOfClassicalFrames) {
  const auto with = [](std::initializer_list<int> head, int length) {
    return packet(head) + static_cast<char>(length) + std::string(3, '\0') +
           std::string(static_cast<std::size_t>(length), 'U');
  };
  CaptureBuilder file{false, false};
  file.packet(1, 0, with({0, 0, 1, 0x23}, 12));
  file.packet(1, 0, with({0, 0, 1, 0x24}, 65));
  file.packet(1, 0, with({0, 0, 1, 0x25}, 9));
  file.packet(1, 0, with({0x20, 0, 0, 4}, 9));
  const CanLog log = read_pcap(file.write("long.pcap"));
  EXPECT_TRUE(log.entries.empty());
  EXPECT_EQ(log.skipped, 4U);
  ASSERT_EQ(log.others.size(), 2U);
  EXPECT_EQ(log.others[0].text, "123##0555555555555555555555555");
  EXPECT_EQ(log.others[1].text, "20000004#5555555555555555");
}

TEST(Pcap, BrokenFilesGiveOneLine) {
  CaptureBuilder ethernet{false, false, 1};
  EXPECT_THAT(error_of(ethernet.write("eth.pcap")),
              HasSubstr("link type 1 is not CAN; allowed: 227"));
  CaptureBuilder short_packet{false, false};
  short_packet.packet(1, 0, packet({0, 0, 1}));
  EXPECT_THAT(error_of(short_packet.write("short.pcap")), HasSubstr("packet 1: 3 bytes"));
  CaptureBuilder lying{false, false};
  lying.packet(1, 0, packet({0, 0, 1, 0x23, 4, 0, 0, 0, 1}));
  EXPECT_THAT(error_of(lying.write("lying.pcap")),
              HasSubstr("1 data bytes where the length says 4"));
  CaptureBuilder identifier{false, false};
  identifier.packet(1, 0, packet({0, 0, 8, 0, 0, 0, 0, 0}));
  EXPECT_THAT(error_of(identifier.write("identifier.pcap")),
              HasSubstr("packet 1: identifier 800 is above 7FF and has no extended flag"));
  for (const bool nanoseconds : {false, true}) {
    CaptureBuilder time{false, nanoseconds};
    time.packet(1, nanoseconds ? 1'000'000'000 : 1'000'000, packet({0, 0, 1, 0x23, 0, 0, 0, 0}));
    EXPECT_THAT(error_of(time.write("time.pcap")),
                HasSubstr("packet 1: 1000000000 ns of a second are not allowed"));
  }
  CaptureBuilder whole{false, false};
  whole.packet(1, 0, packet({0, 0, 1, 0x23, 0, 0, 0, 0}));
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    if (cut == 24) continue;  // a header and no packets: a capture of nothing
    EXPECT_NE(error_of(whole.write("cut.pcap", cut)), "no error") << cut;
  }
}

TEST(Pcap, WritesWhatItReads) {
  const std::string path = ::testing::TempDir() + "written.pcap";
  const std::vector<LogEntry> entries = {
      {0, "", {0x123, false, false, 3, {1, 2, 3}}},
      {1'500 * kNanosecond, "", {0x1ABCDEF0, true, false, 8, {8, 7, 6, 5, 4, 3, 2, 1}}},
      {2 * kSecond, "", {0x7FF, false, true, 15, {}}}};
  {
    PcapWriter writer{path, 1'700'000'000'000'000'000};
    for (const LogEntry &entry : entries) writer.write(entry);
    writer.commit();
  }
  const CanLog log = read_pcap(path);
  ASSERT_EQ(log.entries.size(), entries.size());
  EXPECT_EQ(log.start_ns, 1'700'000'000'000'000'000);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    EXPECT_EQ(log.entries[i].frame, entries[i].frame);
    EXPECT_EQ(log.entries[i].time, entries[i].time);
  }
  EXPECT_THROW(PcapWriter("/no/such/folder/x.pcap"), InputError);
}

// The format's seconds are 32 bits without a sign: they end in 2106, not in 2038.
TEST(Pcap, TimesGoTo2106) {
  for (const std::uint32_t seconds : {0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU}) {
    const std::int64_t start = std::int64_t{seconds} * 1'000'000'000 + 999'999'999;
    CanLog written;
    written.entries.push_back({0, "", {0x123, false, false, 1, {1}}});
    written.start_ns = start;
    EXPECT_EQ(parse_pcap(pcap_bytes(written), "log").start_ns, start);
    const std::string path = ::testing::TempDir() + "late.pcap";
    PcapWriter writer{path, start};
    writer.write(written.entries[0]);
    writer.commit();
    EXPECT_EQ(read_pcap(path).start_ns, start);
  }
}

// An outside judge, where there is one: Wireshark's dissector must see the same frames.
TEST(Pcap, TsharkReadsIt) {
  if (!has_program("tshark")) GTEST_SKIP() << "tshark is not installed";
  const std::string path = ::testing::TempDir() + "tshark.pcap";
  {
    PcapWriter writer{path};
    writer.write({0, "", {0x123, false, false, 2, {0xAB, 0xCD}}});
    writer.write({kMillisecond, "", {0x12345678, true, true, 4, {}}});
    writer.commit();
  }
  EXPECT_EQ(shell("tshark -r " + path +
                  " -T fields -E separator=, -e can.id -e can.flags.xtd -e can.flags.rtr -e can.len"
                  " -e frame.time_relative 2> /dev/null")
                .text,
            "291,0,0,2,0.000000000\n305419896,1,1,4,0.001000000\n");
}

}  // namespace
}  // namespace vericansim
