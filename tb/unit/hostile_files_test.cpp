// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Small files that ask for much: what fuzzing has found (docs/fuzzing.md), each with what it must
// be answered.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/elf_image.hpp"
#include "harness/input_error_of.hpp"
#include "scenario/scenario.hpp"
#include "trace/gvret.hpp"
#include "trace/pcap_file.hpp"
#include "trace/vcd_file.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

void append32(std::string &file, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) file += static_cast<char>(value >> 8 * i);
}

constexpr const char *kOneWire =
    "$timescale 1 ps $end\n$var wire 1 ! can $end\n$enddefinitions $end\n#0\n1!\n";

// 100 kB of text, each of whose signals would have had a name of 60 kB.
TEST(HostileVcd, LongNamesAreRefused) {
  std::string text = "$timescale 1 ps $end\n$scope module " + std::string(60'000, 's') + " $end\n";
  for (int i = 0; i < 2000; ++i) text += "$var wire 1 ! c $end\n";
  const auto read = [&] { static_cast<void>(VcdFile{"a.vcd", text + "$enddefinitions $end\n"}); };
  EXPECT_THAT(input_error_of(read), HasSubstr("a.vcd:3: the name 's"));
  EXPECT_THAT(input_error_of(read), HasSubstr("allowed: 1024 characters"));
}

// To yaml-cpp a comma outside of all lists and maps is a document without end: all of the memory
// was filled with empty ones.
TEST(HostileScenario, ACommaBeginsNoDocument) {
  for (const char *text : {",", "\n, a", "# none\n,", "[a]\n, b", "nodes: []\n...\n,"})
    EXPECT_THAT(input_error_of([&] { static_cast<void>(parse_scenario("a.yaml", text)); }),
                MatchesRegex("a.yaml:[123]: no valid YAML: no document begins like this"))
        << text;
}

// Ten bits of rest, then dominant for 40 days: not a loop over 1.7e12 bits.
TEST(HostileVcd, ABusStuckForDaysIsDecodedAtOnce) {
  constexpr Time kBit = 2 * kMicrosecond, kStuck = 40LL * 24 * 3600 * kSecond;
  const Time begin = 12 * kBit;
  const std::string text = fmt::format("{}#{}\n0!\n#{}\n1!\n#{}\n", kOneWire, begin, begin + kStuck,
                                       begin + kStuck + 40 * kBit);
  const auto result = decode_wave(parse_wave(text, "a.vcd", {.signal = "", .bitrate = 500e3}), 800);
  ASSERT_EQ(result.events.size(), 1U);
  EXPECT_EQ(result.events[0].kind, BusEventKind::kErrorFrame);
  // SOF and the five bits to the stuff error are part of the run.
  EXPECT_EQ(result.events[0].flag_bits, kStuck / kBit > 0xFFFFFFFFLL ? 0xFFFFFFFFU : kStuck / kBit);
}

// The same below the limit of the counter: bit for bit what stepping gives.
TEST(HostileVcd, SkippedBitsAreCounted) {
  constexpr Time kBit = 2 * kMicrosecond;
  for (const Time bits : {6, 7, 8, 20, 1000, 100'000}) {
    const std::string text = fmt::format("{}#{}\n0!\n#{}\n1!\n#{}\n", kOneWire, 12 * kBit,
                                         (12 + bits) * kBit, (52 + bits) * kBit);
    const auto result =
        decode_wave(parse_wave(text, "a.vcd", {.signal = "", .bitrate = 500e3}), 800);
    ASSERT_EQ(result.events.size(), 1U) << bits;
    EXPECT_EQ(result.events[0].flag_bits, bits);
    EXPECT_EQ(result.events[0].end, (12 + bits + 8) * kBit);
  }
}

TEST(HostileVcd, TimesBeyondTheClockAreRefused) {
  const auto read = [](const std::string &time) {
    static_cast<void>(
        parse_wave(std::string{kOneWire} + time, "a.vcd", {.signal = "", .bitrate = 500e3}));
  };
  EXPECT_EQ(input_error_of([&] { read("#4000000000000000000\n0!\n"); }), "no error");
  EXPECT_THAT(input_error_of([&] { read("#9000000000000000000\n0!\n"); }),
              HasSubstr("up to 53 days"));
}

// Edges of a clock, not of a bus.
TEST(HostileVcd, RatesOfNoBusAreRefused) {
  std::string text = kOneWire;
  for (int i = 1; i < 40; ++i) text += fmt::format("#{}\n{}!\n", i * 10, i % 2);
  EXPECT_THAT(input_error_of([&] { static_cast<void>(parse_wave(text, "a.vcd", {})); }),
              HasSubstr("has edges as at 100000000000 bit/s; allowed: 1000 to 1000000; give"));
}

// The column Bus behind the last one that a line has.
TEST(HostileGvret, EveryColumnOfTheHeaderIsNeeded) {
  const auto read = [] {
    static_cast<void>(parse_gvret("Time Stamp,ID,Extended,LEN,Bus\n1,1,true,0\n", "a.csv"));
  };
  EXPECT_EQ(input_error_of(read), "a.csv:2: too few columns; see the header line");
}

// pcapng with stamps of 64 bits in units of a second.
TEST(HostilePcap, TimesBeyondTheClockAreRefused) {
  std::string file = "\x0a\x0d\x0d\x0a";
  for (const std::uint32_t word : {28U, 0x1A2B3C4DU, 1U, ~0U, ~0U, 28U}) append32(file, word);
  for (const std::uint32_t word : {1U, 32U, 227U, 0U}) append32(file, word);
  append32(file, 9U | 1U << 16U);  // if_tsresol, one byte
  append32(file, 0);               // 10^0 s
  append32(file, 0);               // end of options
  append32(file, 32);
  for (const std::uint32_t word : {6U, 40U, 0U, 0x7FFFFFFFU, ~0U, 8U, 8U}) append32(file, word);
  append32(file, 0x01000000);
  append32(file, 0);
  append32(file, 40);
  EXPECT_THAT(input_error_of([&] { static_cast<void>(parse_pcap(file, "a.pcap")); }),
              HasSubstr("packet 1: time 9223372"));
}

std::string elf_header(unsigned segments, std::uint32_t sections, unsigned section_count) {
  std::string file{
      "\x7F"
      "ELF\x01\x01\x01"};
  file.resize(16);
  append32(file, 2U | 40U << 16U);
  for (const std::uint32_t word : {1U, 9U, 52U, sections, 0U}) append32(file, word);
  append32(file, 52U | 32U << 16U);
  append32(file, segments | 40U << 16U);
  append32(file, section_count);
  return file;
}

void append_segment(std::string &file, std::uint32_t offset, std::uint32_t size) {
  for (const std::uint32_t word : {1U, offset, 0U, 0U, size, size, 5U, 4U}) append32(file, word);
}

std::vector<std::uint8_t> bytes_of(const std::string &text) { return {text.begin(), text.end()}; }

// 2000 headers that all load the same 300 kB: 600 MB, if they were copied first.
TEST(HostileElf, OverlappingSegmentsAreNotCopied) {
  std::string file = elf_header(2000, 0, 0);
  for (int i = 0; i < 2000; ++i) append_segment(file, 52 + 2000 * 32, 300'000);
  append32(file, 0x20010000);
  append32(file, 9);
  file.resize(file.size() + 300'000);
  const auto read = [&] { static_cast<void>(firmware::parse_elf("a.elf", bytes_of(file))); };
  EXPECT_THAT(input_error_of(read), HasSubstr("segments overlap at load address 0x00000000"));
}

// 500 symbol tables that are the same 1000 functions, each with a name of 20 kB: 10 GB.
TEST(HostileElf, SymbolsAreReadOnceAndNamesAreCut) {
  constexpr unsigned kSymbols = 1000, kTables = 500;
  const std::uint32_t code = 52 + 32, symbols = code + 12, names = symbols + 16 * kSymbols;
  std::string file = elf_header(1, names + 20'001, kTables + 1);
  append_segment(file, code, 12);
  for (const std::uint32_t word : {0x20010000U, 9U, 0xE7FEU}) append32(file, word);
  for (unsigned i = 0; i < kSymbols; ++i)
    for (const std::uint32_t word : {1U, 9U, 2U, 0x12U}) append32(file, word);
  file += '\0' + std::string(20'000, 'a');
  const auto section = [&](std::uint32_t type, std::uint32_t at, std::uint32_t size) {
    for (const std::uint32_t word : {0U, type, 0U, 0U, at, size, 0U, 0U, 0U, 0U})
      append32(file, word);
  };
  section(3, names, 20'001);
  for (unsigned i = 0; i < kTables; ++i) section(2, symbols, 16 * kSymbols);
  const auto image = firmware::parse_elf("a.elf", bytes_of(file));
  ASSERT_EQ(image.functions.size(), kSymbols);
  EXPECT_EQ(image.functions[0].name, std::string(1024, 'a'));
  std::size_t sum = 0;
  for (const auto &function : image.functions) sum += function.name.size();
  EXPECT_LE(sum, file.size()) << "the one name, again and again";
}

}  // namespace
}  // namespace vericansim
