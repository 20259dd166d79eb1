// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VCD files: written ones are what the standard says and what sigrok and GTKWave read; foreign ones
// are read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "harness/input_error_of.hpp"
#include "harness/shell.hpp"
#include "trace/bitrate.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/vcd_file.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

constexpr const char *kHeader =
    "$date today $end $version some simulator $end $timescale 10 ns $end\n"
    "$scope module top $end $scope module node $end\n$var wire 1 ! rx $end $var reg 8 \" data "
    "[7:0] $end\n$upscope $end\n"
    "$var wire 1 # rx $end $var string 1 $ text $end $upscope $end $enddefinitions $end\n";

std::vector<std::pair<Time, Level>> changes_of(const VcdFile &file, const std::string &name) {
  std::vector<std::pair<Time, Level>> changes;
  file.read(file.find(name), [&](Time time, Level level) { changes.emplace_back(time, level); });
  return changes;
}

TEST(VcdFile, ReadsTimescaleHierarchyAndUnknowns) {
  const VcdFile file{
      "a.vcd",
      std::string(kHeader) +
          "#0 $dumpvars x! b00000000 \" 1# $end\n#5 0!\n#7 0! 1#\nb1010 \" z!\n#9 sHELLO $\n#20\n"};
  EXPECT_THAT(changes_of(file, "top.node.rx"),
              ElementsAre(Pair(0, Level::kRecessive), Pair(50 * kNanosecond, Level::kDominant),
                          Pair(70 * kNanosecond, Level::kRecessive)));
  EXPECT_EQ(file.read(file.find("node.rx"), [](Time, Level) {}), 200 * kNanosecond);
}

// To IEEE 1364 it is x until then. What was before the first time of the file nobody knows.
TEST(VcdFile, ASignalWithoutAFirstValueIsRecessive) {
  const auto changes = [](const std::string &body) {
    return changes_of(VcdFile{"a.vcd", kHeader + body}, "top.rx");
  };
  const Time unit = 10 * kNanosecond;
  for (const char *body : {"#3 1! #5 0#", "#3 #5 0#"})
    EXPECT_THAT(changes(body),
                ElementsAre(Pair(3 * unit, Level::kRecessive), Pair(5 * unit, Level::kDominant)))
        << body;
  EXPECT_THAT(changes("#5 0#"), ElementsAre(Pair(5 * unit, Level::kDominant)));
  EXPECT_THAT(changes("0# #5 1#"),
              ElementsAre(Pair(0, Level::kDominant), Pair(5 * unit, Level::kRecessive)));
}

TEST(VcdFile, ScaleBelowAPicosecond) {
  const VcdFile file{
      "a.vcd", "$timescale 1fs $end $var wire 1 ! rx $end $enddefinitions $end #0 1! #2500 0! "};
  EXPECT_THAT(changes_of(file, "rx"),
              ElementsAre(Pair(0, Level::kRecessive), Pair(2, Level::kDominant)));
}

TEST(VcdFile, NamesTheChoiceWhenASignalIsUnclear) {
  const VcdFile file{"a.vcd", kHeader};
  EXPECT_THAT(
      input_error_of([&] { static_cast<void>(file.find("rx")); }),
      HasSubstr("a.vcd: signal 'rx' is not unique; one-bit signals are top.node.rx, top.rx"));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(file.find("nosuch")); }),
              HasSubstr("no signal is called 'nosuch'"));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(file.find("data")); }),
              HasSubstr("has 8 bits; allowed: 1"));
}

TEST(VcdFile, AWeakZeroIsDominantAndARealIsNoBit) {
  const VcdFile file{"a.vcd",
                     "$timescale 1ps $end $var wire 1 ! rx $end $var real 1 # r $end "
                     "$enddefinitions $end #0 1! r1.0 # #5 bL ! #9 bH ! "};
  EXPECT_THAT(changes_of(file, "rx"),
              ElementsAre(Pair(0, Level::kRecessive), Pair(5, Level::kDominant),
                          Pair(9, Level::kRecessive)));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(file.find("r")); }),
              HasSubstr("signal 'r' is a real; allowed: one bit"));
}

// Pins of a port, channels of an analyser: what tells them apart stands in a word of its own.
TEST(VcdFile, NamesMayHaveSeveralWords) {
  const VcdFile file{"a.vcd",
                     "$timescale 1ps $end $scope module top $end $var wire 1 ! pins [0] $end "
                     "$var wire 1 # pins [1] $end $var wire 1 % Channel 0 $end "
                     "$var wire 1 & Channel 1 $end $var wire 1 ' rx [0:0] $end $upscope $end "
                     "$enddefinitions $end "};
  EXPECT_EQ(file.find("top.pins[1]").code, "#");
  EXPECT_EQ(file.find("pins[0]").code, "!");
  EXPECT_EQ(file.find("Channel 1").code, "&");
  EXPECT_EQ(file.find("rx").code, "'");
  EXPECT_EQ(file.guess_bus().name, "top.rx[0:0]");
  EXPECT_THAT(input_error_of([&] { static_cast<void>(file.find("pins")); }),
              HasSubstr("signal 'pins' is not unique; one-bit signals are top.pins[0], "
                        "top.pins[1], top.Channel 0, top.Channel 1, top.rx[0:0]"));
}

// The nine values of std_logic as scalars, 0 and L dominant.
TEST(VcdFile, ScalarsOfVhdl) {
  const VcdFile file{"a.vcd",
                     "$timescale 1ps $end $var wire 1 ! rx $end $enddefinitions $end #0 U! #1 0! "
                     "#2 W! #3 L! #4 H! #5 L! #6 -! #7 0! #8 Z! #9 0! #10 1! #11 0! #12 X! "};
  std::vector<std::pair<Time, Level>> expected;
  for (Time at = 0; at <= 12; ++at)
    expected.emplace_back(at, at % 2 == 0 ? Level::kRecessive : Level::kDominant);
  EXPECT_EQ(changes_of(file, "rx"), expected);
}

TEST(VcdFile, GuessesTheBus) {
  const std::string end = " $enddefinitions $end";
  const std::string scale = "$timescale 1ns $end ";
  const auto guess = [&](const std::string &vars) {
    return VcdFile{"a", scale + vars + end}.guess_bus().name;
  };
  EXPECT_EQ(guess("$var wire 1 ! q $end"), "q");
  EXPECT_EQ(guess("$var wire 1 ! q $end $var wire 1 % CAN_RX $end"), "CAN_RX");
  EXPECT_EQ(
      guess("$var wire 1 ! rx $end $scope module bus $end $var wire 1 % can $end $upscope $end"),
      "bus.can");
  EXPECT_THROW(guess("$var wire 1 ! q $end $var wire 1 % p $end"), InputError);
}

TEST(VcdFile, DamagedInputNeverCrashes) {
  const std::string good =
      std::string(kHeader) + "#0 1! b101 \"\n#5 0!\nsA $\n$comment x $end\n#9 1!\n";
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char byte : {'\0', '$', '#', ' ', 'b', '9', '\xFF'}) {
      std::string bad = good;
      bad[at] = byte;
      for (const std::string &text : {bad, good.substr(0, at)}) {
        const std::string error = input_error_of([&] {
          const VcdFile file{"a.vcd", text};
          for (const VcdSignal &signal : file.signals()) file.read(signal, [](Time, Level) {});
        });
        EXPECT_EQ(error.find('\n'), std::string::npos);
      }
    }
}

TEST(VcdFile, ErrorsNameTheLine) {
  EXPECT_THAT(input_error_of([] { VcdFile("a.vcd", "$timescale 3 ns $end"); }),
              HasSubstr("a.vcd:1: timescale '3ns'"));
  EXPECT_THAT(input_error_of([] { VcdFile("a.vcd", "hello"); }),
              HasSubstr("a.vcd:1: expected a VCD keyword"));
  EXPECT_THAT(input_error_of([] { VcdFile("a.vcd", ""); }), HasSubstr("is no VCD file"));
  const VcdFile file{"a.vcd", std::string(kHeader) + "#9 1!\n#3 0!\n"};
  EXPECT_THAT(input_error_of([&] { file.read(file.find("top.rx"), [](Time, Level) {}); }),
              HasSubstr("a.vcd:7: time '#3' goes back"));
}

// What a file has that was cut or damaged behind its header, with the line.
TEST(VcdFile, WhatIsNoValueChangeIsRefused) {
  const auto refusal = [](const std::string &body) {
    const VcdFile file{"a.vcd", std::string(kHeader) + "#0 1! $dumpvars 1# $end\n" + body};
    return input_error_of([&] { file.read(file.find("top.rx"), [](Time, Level) {}); });
  };
  EXPECT_EQ(refusal(""), "no error");
  EXPECT_EQ(refusal("$dumpoff x! bx \" $end $dumpon 1! b1Zx0 \" sA $\n$end\n$comment a $end"),
            "no error");
  const std::string behind = "; allowed: a value and the code of a signal";
  EXPECT_EQ(refusal("#1000 0"), "a.vcd:7: value '0' has no code" + behind);
  EXPECT_EQ(refusal("#1000 b0\n"), "a.vcd:7: value 'b0' has no code" + behind);
  EXPECT_EQ(refusal("\n0~~~"), "a.vcd:8: value '0~~~' is of a code that no $var declares" + behind);
  EXPECT_EQ(refusal("b0 ~"), "a.vcd:7: value 'b0' is of a code that no $var declares" + behind);
  EXPECT_THAT(refusal("#5 b1012 \""), HasSubstr("a.vcd:7: value 'b1012' is not allowed; allowed"));
  EXPECT_THAT(refusal("b \""), HasSubstr("a.vcd:7: value 'b' is not allowed; allowed behind b"));
  EXPECT_THAT(refusal("$garbage"), HasSubstr("a.vcd:7: keyword '$garbage' is not allowed among"));
  EXPECT_EQ(refusal("$comment foo\n1#\n"), "a.vcd:7: $comment has no $end");
}

/// One pulse and one text, written as VCD.
std::string write_sample(const std::string &name) {
  const std::string path = ::testing::TempDir() + name;
  const auto sink = open_vcd(path);
  const auto can = sink->add_wire("bus", "can", 1);
  const auto field = sink->add_text("node", "field");
  const auto tec = sink->add_wire("node", "tec", 9);
  sink->start();
  sink->set(0, can, 1);
  sink->set(0, field, std::string_view{"IDLE"});
  sink->set(2 * kMicrosecond, can, 0);
  sink->set(2 * kMicrosecond, field, std::string_view{"ERROR FLAG"});
  sink->set(3 * kMicrosecond, tec, 256);
  sink->set(4 * kMicrosecond, can, 1);
  sink->finish(10 * kMicrosecond);
  return path;
}

TEST(VcdWriter, WritesWiresAndTexts) {
  EXPECT_EQ(
      read_text_file(write_sample("w.vcd")),
      "$comment written by VeriCAN $end\n$timescale 1 ns $end\n$scope module bus $end\n"
      "$var wire 1 ! can $end\n$upscope $end\n$scope module node $end\n$var string 1 % field $end\n"
      "$var wire 9 & tec [8:0] $end\n$upscope $end\n$enddefinitions $end\n"
      "#0\n1!\nsIDLE %\n#2000\n0!\nsERROR_FLAG %\n#3000\nb100000000 &\n#4000\n1!\n#10000\n");
}

TEST(VcdWriter, ReaderReadsIt) {
  const VcdFile file{write_sample("r.vcd")};
  EXPECT_THAT(changes_of(file, "bus.can"),
              ElementsAre(Pair(0, Level::kRecessive), Pair(2 * kMicrosecond, Level::kDominant),
                          Pair(4 * kMicrosecond, Level::kRecessive)));
}

TEST(VcdWriter, CodesStayUniqueBeyond94Signals) {
  const std::string path = ::testing::TempDir() + "many.vcd";
  {
    const auto sink = open_vcd(path);
    for (int i = 0; i < 9000; ++i) sink->add_wire("m", "s" + std::to_string(i), 1);
    sink->start();
    sink->finish(0);
  }
  const VcdFile file{path};
  std::vector<std::string> codes;
  for (const VcdSignal &signal : file.signals()) codes.push_back(signal.code);
  std::sort(codes.begin(), codes.end());
  EXPECT_EQ(std::unique(codes.begin(), codes.end()), codes.end());
}

TEST(VcdWriter, GtkwaveReadsIt) {
  if (!has_program("vcd2fst")) GTEST_SKIP() << "vcd2fst (GTKWave) is not installed";
  const std::string vcd = write_sample("g.vcd");
  const std::string command =
      "vcd2fst " + vcd + " " + vcd + ".fst && fst2vcd " + vcd + ".fst > " + vcd + ".back";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string back = read_text_file(vcd + ".back");
  EXPECT_THAT(back, HasSubstr("sERROR_FLAG "));
  EXPECT_THAT(back, HasSubstr("b100000000 "));
}

TEST(FileNames, AWaveMustBeVcdOrFst) {
  EXPECT_THROW(static_cast<void>(open_vcd("/no/such/folder/a.vcd")), InputError);
}

/// Edges of a frame at `bit` ps; those from dominant to recessive are `late`.
std::vector<Time> edges_at(double bit, Time late) {
  std::vector<Time> edges;
  Time now = 12345;
  for (const int bits : {1, 1, 2, 5, 4, 1, 3, 5, 2, 1, 1, 4, 30, 1, 2, 2, 1}) {
    now += static_cast<Time>(bits * bit) + (bits % 2) * 3;
    edges.push_back(now + (edges.size() % 2 != 0 ? late : 0));
  }
  return edges;
}

TEST(Bitrate, FoundFromEdges) {
  for (const double rate : {10e3, 50e3, 83.333e3, 125e3, 500e3, 1e6}) {
    const auto found = detect_bitrate(edges_at(1e12 / rate, 0));
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(*found / rate, 1.0, 0.001);
  }
  EXPECT_FALSE(detect_bitrate({1, 2, 3}).has_value());
  EXPECT_FALSE(detect_bitrate(std::vector<Time>(20, 5)).has_value());
}

// Slow slopes of the wire: dominant bits of 1.2 us, recessive ones of 0.8 us.
TEST(Bitrate, EdgesOfOneDirectionMayBeLate) {
  for (const Time late : {100, 150, 200})
    EXPECT_EQ(detect_bitrate(edges_at(1e6, late * kNanosecond)), 1e6) << late;
}

// A few glitches among many edges, at the end of a long rest; the fifth part of a bit divides it.
TEST(Bitrate, GlitchesAreNoBits) {
  for (const Time glitch : {20, 50, 200, 333, 500}) {
    std::vector<Time> edges;
    for (Time begin = 0; begin < 20; ++begin)
      for (const Time edge : edges_at(1e6, 0)) edges.push_back(edge + begin * 100 * kMicrosecond);
    const Time last = edges.back();
    for (Time n = 1; n <= 10; ++n) {
      edges.push_back(last + n * 50 * kMicrosecond);
      edges.push_back(edges.back() + glitch * kNanosecond);
    }
    EXPECT_EQ(detect_bitrate(edges), 1e6) << glitch;
  }
}

}  // namespace
}  // namespace vericansim
