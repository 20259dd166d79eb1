// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Cooked captures (tcpdump -i any): packets put together after the published layouts; tshark must
// see the same frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/capture_files.hpp"
#include "harness/input_error_of.hpp"
#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// A frame as the recording computer has it in its memory: identifier in its byte order.
std::string can_frame(std::uint32_t id, const std::string &data, bool big) {
  return number(id, 4, big) + static_cast<char>(data.size()) + std::string(3, '\0') + data;
}

/// Cooked headers; all their fields are big-endian. ARPHRD_CAN is 280.
std::string cooked(unsigned type, unsigned protocol, const std::string &frame) {
  return number(type, 2, true) + number(280, 2, true) + std::string(10, '\0') +
         number(protocol, 2, true) + frame;
}
std::string cooked2(unsigned type, unsigned protocol, unsigned index, const std::string &frame) {
  return number(protocol, 2, true) + number(0, 2, true) + number(index, 4, true) +
         number(280, 2, true) + number(type, 1, true) + std::string(9, '\0') + frame;
}

/// Byte order of the recording computer, version of the header.
class Cooked : public ::testing::TestWithParam<std::tuple<bool, bool>> {
 protected:
  [[nodiscard]] static bool big() { return std::get<0>(GetParam()); }
  [[nodiscard]] static std::string file(
      const std::vector<std::tuple<unsigned, unsigned, std::string>> &packets) {
    std::vector<std::string> bytes;
    for (const auto &[type, protocol, frame] : packets)
      bytes.push_back(std::get<1>(GetParam()) ? cooked2(type, protocol, 3, frame)
                                              : cooked(type, protocol, frame));
    return capture(std::get<1>(GetParam()) ? 276 : 113, big(), bytes);
  }
};

TEST_P(Cooked, ReadsFramesDirectionsAndInterfaces) {
  const std::string bytes = file({{1, 0x0C, can_frame(0x123, "\x11\x22", big())},
                                  {4, 0x0C, can_frame(0x80123456, "", big())},
                                  {1, 0x0D, can_frame(0x321, std::string(12, 'U'), big())},
                                  {1, 0x0D, can_frame(0x322, "U", big())},
                                  {1, 0x0C, can_frame(0x20000004, std::string(8, '\1'), big())},
                                  {1, 0x0800, "E no CAN but IP"}});
  const CanLog log = parse_log(bytes, "any.pcap");
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.entries[0].frame, (Frame{0x123, false, false, 2, {0x11, 0x22}}));
  EXPECT_EQ(log.entries[0].direction, Direction::kReceived);
  EXPECT_EQ(log.entries[1].frame, (Frame{0x123456, true, false, 0, {}}));
  EXPECT_EQ(log.entries[1].direction, Direction::kSent);
  EXPECT_EQ(log.entries[0].channel, std::get<1>(GetParam()) ? "if3" : "");
  EXPECT_EQ(log.start_ns, 1'000'000'007'000);
  ASSERT_EQ(log.others.size(), 3U);
  EXPECT_EQ(log.others[0].text, "321##0555555555555555555555555");
  EXPECT_EQ(log.others[1].text, "322##055");
  EXPECT_EQ(log.others[2].text, "20000004#0101010101010101");
  EXPECT_EQ(skipped_text(log), "2 CAN FD frames, 1 error message, 1 other line or packet");
}

TEST_P(Cooked, TsharkSeesTheSame) {
  if (!has_program("tshark")) GTEST_SKIP() << "tshark is not installed";
  const ScratchFolder folder;
  const std::string path =
      folder.file("any.pcap", file({{0, 0x0C, can_frame(0x123, "\x11\x22", big())},
                                    {0, 0x0C, can_frame(0x80123456, "", big())}}));
  EXPECT_EQ(shell("tshark -r " + path +
                  " -T fields -E separator=, -e can.id -e can.flags.xtd "
                  "-e can.len 2> /dev/null")
                .text,
            "291,0,2\n1193046,1,0\n");
  const CanLog log = read_log(path);
  ASSERT_EQ(log.entries.size(), 2U);
  EXPECT_EQ(log.entries[0].frame.id, 291U);
  EXPECT_EQ(log.entries[1].frame.id, 1193046U);
}
INSTANTIATE_TEST_SUITE_P(All, Cooked, ::testing::Combine(::testing::Bool(), ::testing::Bool()));

TEST(CookedErrors, ShortPacketsAreNamed) {
  const auto error_of = [](unsigned link_type, const std::string &packet) {
    return input_error_of(
        [&] { return parse_log(capture(link_type, false, {packet}), "any.pcap"); });
  };
  EXPECT_EQ(error_of(113, std::string(15, '\0')),
            "any.pcap: packet 1: 15 bytes; at least 16 are needed");
  EXPECT_EQ(error_of(276, std::string(19, '\0')),
            "any.pcap: packet 1: 19 bytes; at least 20 are needed");
  EXPECT_EQ(error_of(113, cooked(0, 0x0C, "1234567")),
            "any.pcap: packet 1: 7 bytes; at least 8 are needed");
  EXPECT_THAT(error_of(113, cooked(0, 0x0C, can_frame(1, "ab", false).substr(0, 9))),
              HasSubstr("packet 1: 1 data bytes where the length says 2"));
  EXPECT_THAT(error_of(1, "ethernet"), HasSubstr("allowed: 227 (SocketCAN), 113 (Linux cooked)"));
}

}  // namespace
}  // namespace vericansim
