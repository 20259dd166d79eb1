// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The tool as a user meets it: exit codes, one-line errors, JSON.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "firmware/tool_run.hpp"
#include "harness/scratch_test.hpp"

namespace {

using namespace tb;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The tool, with files of the test.
using Tool = vericansim::ScratchTest;

/// Bad input: exit code 2, nothing on stdout, one line on stderr that says `what`.
void expect_refused(const std::string &arguments, const std::string &what) {
  const ToolResult result = run_tool(arguments);
  EXPECT_EQ(result.code, 2) << arguments;
  EXPECT_EQ(result.out, "") << arguments;
  EXPECT_THAT(result.error, StartsWith("verican: "));
  EXPECT_THAT(result.error, HasSubstr(what));
  EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
}

TEST_F(Tool, HelpAndVersion) {
  EXPECT_EQ(run_tool("--help").code, 0);
  for (const char *command : {"run", "replay", "decode", "bittime", "paper", "firmware"}) {
    const ToolResult help = run_tool(std::string(command) + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr("--json"));
    EXPECT_THAT(help.out, Not(ContainsRegex("[0-9]e[+]|[0-9][.]0")));  // ends of ranges
  }
  EXPECT_THAT(run_tool("--version").out, HasSubstr("verican"));
}

TEST_F(Tool, BadOptionsAreRefused) {
  expect_refused("", "subcommand");
  expect_refused("runn", "verican: 'runn' is no command; allowed: run, replay, paper, ");
  expect_refused("memory --socketcand 1 peek 6",
                 "verican: memory: 'peek' is no command; allowed: scan, assign, read, ");
  expect_refused("memory --socketcand 1", "subcommand");
  expect_refused("run", "scenario is required");
  expect_refused("run x.yaml --bitrate 5M", "--bitrate");
  expect_refused("bittime", "--bitrate is required");
  expect_refused("bittime -b fast", "--bitrate");
  expect_refused("bittime -b 5M",
                 "bit rate 5000000 bit/s is out of range; allowed: 1000 to 1000000");
  expect_refused("bittime -b 500k -c 10000M",
                 "clock 10000000000 Hz is out of range; allowed: 1000 to 1000000000");
  for (const std::string error : {"-1", "2000000"})
    expect_refused(
        "bittime -b 500k --max-error " + error,
        "largest bit-rate error " + error + " ppm is out of range; allowed: 0 to 1000000");
  expect_refused("bittime -b 500k -s 0.3", "sample point 0.3 is out of range; allowed: 0.5 to 0.9");
  expect_refused("bittime -b 999k --max-error 1",
                 "no setting of 8 to 25 quanta gives 999000 bit/s");
  expect_refused("bittime -b 500k -s 200",
                 "sample point 200 % is out of range; allowed: 50 to 90 %, or 0.5 to 0.9");
  expect_refused("replay x.log --frames 0", "--frames: '0' is not allowed; allowed: 1 or more");
  expect_refused("run x.yaml --bitrate 5M", "Value 5000000 not in range 1000 to 1000000;");
  expect_refused("replay x.log --nodes 1", "--nodes");
  expect_refused("replay x.log --frames 10.0.0",
                 "--frames: '10.0.0' is not allowed; allowed: 1 or more");
  expect_refused("decode x.vcd --bitrate 1", "--bitrate");
  for (const char *option : {"--sjw 2", "--cable 50", "--rows 2", "-s 80", "--clock-error 50"})
    expect_refused(std::string("bittime --table -c 8M ") + option, "--table excludes");
  expect_refused("run examples/two-nodes.yaml --vcd ''", "--vcd: an empty value follows");
  expect_refused("run examples/two-nodes.yaml --duration=", "--duration=: has an empty value");
  expect_refused("timesync ''", "timesync: an empty value follows");
}

// Numbers that would be read as others, or stand for something else.
TEST_F(Tool, NumbersAreWhatTheySay) {
  expect_refused("replay x.log --nodes 010",
                 "--nodes: '010' is not allowed; allowed: decimal without zeros in front");
  expect_refused("replay x.log --frames -1", "--frames: '-1' is not allowed; allowed: ");
  expect_refused("replay x.log --frames 0x0", "--frames: '0x0' is not allowed; allowed: 1 or more");
  expect_refused("bittime -b 500k --rows -1", "--rows: '-1' is not allowed; allowed: 0 and more");
  expect_refused("replay x.log --ppm nan", "--ppm: 'nan' is not allowed; allowed: a number");
  expect_refused("replay x.log --cable inf", "--cable: ");
  expect_refused("decode x.vcd --sample-point nan", "--sample-point: 'nan' is not allowed");
  expect_refused("bittime -b 500k -s 0", "sample point 0 is out of range; allowed: 0.5 to 0.9");
  EXPECT_EQ(run_tool("bittime -b 500k --rows 0x2").code, 0);
}

// A name in another encoding becomes text that JSON can hold.
TEST_F(Tool, JsonHoldsAnyText) {
  const std::string log = file_with("a\xE9.log", "(1.0) can0 123#11\n");
  const ToolResult result = run_tool("replay " + log + " --fast --json");
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_THAT(result.out, HasSubstr("a\xEF\xBF\xBD.log"));
}

// What an option says must be of the input that is there.
TEST_F(Tool, ReportTakesTheOptionsOfItsInput) {
  for (const char *option : {"--from '1 s'", "--to '1 s'", "--filter 1:1", "--interface can7",
                             "--nodes 5", "--senders 2", "--fast"}) {
    const std::string name = std::string(option).substr(0, std::string(option).find(' '));
    expect_refused(std::string("report examples/two-nodes.yaml ") + option,
                   name + ": is an option of logs of frames, and examples/two-nodes.yaml is none");
    expect_refused(std::string("report no.vcd ") + option, name + ": is an option of logs");
  }
  expect_refused("report examples/two-nodes.yaml --signal x",
                 "--signal: is an option of waveforms");
  expect_refused("report examples/boat.log --signal x", "--signal: is an option of waveforms");
}

TEST_F(Tool, BadFilesAreRefused) {
  expect_refused("run /no/such.yaml", "/no/such.yaml: no such file");
  // A device that never ends, as --json is an option of timesync without a file behind it.
  for (const char *command : {"run", "timesync --json"})
    expect_refused(command + std::string{" /dev/zero"}, "/dev/zero: has more than 67108864 bytes");
  expect_refused("run /tmp", "is a directory");
  expect_refused("run " + file_with("bad.yaml", "nodes:\n  - {name: a, clock: 8 Mhz}\n"),
                 "bad.yaml:2: nodes[0].clock: '8 Mhz' is not allowed; allowed: ");
  expect_refused("replay " + file_with("bad.log", "(1.0) can0 123#11\n(1.0) can0 999#11\n"),
                 "bad.log:2: identifier is above 7FF");
  expect_refused("replay " + file_with("empty.log", ""), "empty.log: the file is empty");
  expect_refused("replay " + file_with("what.log", "hello world\n"), "unknown kind of log");
  expect_refused(
      "decode " +
          file_with("bad.vcd",
                    "$timescale 1 ns $end\n$var wire 1 ! x $end\n$enddefinitions $end\n#0 1!\n"),
      "the bit rate of signal 'x' cannot be told");
  expect_refused("run examples/two-nodes.yaml --vcd /no/such/folder/a.vcd",
                 "cannot be opened for writing");
  expect_refused("run examples/two-nodes.yaml --duration 5",
                 "--duration: '5' is not allowed; allowed: 1 us to 100000 s, as in '50 ms'");
  for (const char *time : {"1ps", "0", "999 ns", "100001 s"})
    expect_refused("run examples/two-nodes.yaml --duration '" + std::string{time} + "'",
                   "--duration: '" + std::string{time} + "' is not allowed; allowed: 1 us to ");
}

// As many as a list has, and before the first of them runs.
TEST_F(Tool, BitRatesOfAListAreCheckedFirst) {
  const std::string file = file_with(
      "rates.yaml", "bitrate: [500k, 970k]\nduration: 1 ms\noutputs: {candump: " + in("rates.log") +
                        "}\nnodes:\n  - {name: a, clock: 8 MHz}\n  - {name: b, clock: 8 MHz}\n");
  const std::string impossible =
      "rates.yaml:5: node 'a': no setting of 8 to 25 quanta gives 970000 bit/s within 2000 ppm";
  expect_refused("run " + file, impossible);
  expect_refused("run " + file + " --json", impossible);
  expect_refused("report " + file + " -o " + in("rates.html"), impossible);
  for (const char *name : {"rates-500k.log", "rates-500k.html"})
    EXPECT_FALSE(std::filesystem::exists(in(name))) << name;
}

// The bus is read at its bit rate: one that no node has would show errors alone.
TEST_F(Tool, SomeNodeHasTheBitRateOfTheBus) {
  const std::string file = file_with("own.yaml",
                                     "bitrate: [500k, 125k]\nnodes:\n  - {name: a, bitrate: 500k}\n"
                                     "  - {name: b, bitrate: 500k}\ntraffic: [{node: a, id: 1}]\n");
  const std::string none =
      "own.yaml:3: each node has a 'bitrate' of its own, none that of the "
      "bus, 125000 bit/s; allowed: ";
  expect_refused("run " + file, none);
  expect_refused("report " + file + " -o " + in("own.html"), none);
  expect_refused("run " + file + " --bitrate 125k", none);
  EXPECT_EQ(run_tool("run " + file + " --bitrate 500k -q").code, 0);
}

// Rates as people write them, wherever there is an option for one; nothing that is none.
TEST_F(Tool, RatesHaveUnits) {
  for (const char *rate :
       {"500000", "500k", "500K", "500 k", "0.5M", "0.5m", "5e5", "+500k", "500kbit/s",
        "500 kbit/s", "500000bit/s", "0.5 Mbit/s", "500KBIT/S", "500kHz", "0x7a120"}) {
    const ToolResult result = run_tool("bittime --json -c 8M -b '" + std::string{rate} + "'");
    EXPECT_EQ(result.code, 0) << rate << result.error;
    EXPECT_EQ(nlohmann::json::parse(result.out, nullptr, false)["bitrate"], 500'000) << rate;
  }
  for (const char *clock : {"8000000", "8M", "8MHz", "8 MHz", "8000kHz", "0.008 GHz"}) {
    const ToolResult result = run_tool("bittime --json -b 500k -c '" + std::string{clock} + "'");
    EXPECT_EQ(nlohmann::json::parse(result.out, nullptr, false)["clock_hz"], 8'000'000) << clock;
  }
  // Crystals have more digits than six: this is one of NTSC.
  for (const char *clock : {"14318180", "14.31818M", "14318.18 kHz", "0.01431818 GHz"}) {
    const ToolResult result = run_tool("bittime --json -b 125k -c '" + std::string{clock} + "'");
    EXPECT_EQ(nlohmann::json::parse(result.out, nullptr, false)["clock_hz"], 14'318'180) << clock;
  }
  const ToolResult table = run_tool("bittime --table --json -c 8.123456M");  // no whole double
  EXPECT_EQ(nlohmann::json::parse(table.out, nullptr, false)["clock_hz"], 8'123'456);
  for (const std::string command : {"run x.yaml", "report x.yaml", "decode x.vcd", "replay x.log",
                                    "bittime", "firmware x.elf --bus x.yaml", "bridge --if x"}) {
    for (const char *rate : {"fast", "k", "nan", "inf", "500kbits", "500 k k", "bit/s",
                             "500kbit/s/s", "500kHzbit/s", "5,00k", "500GHz bit/s"})
      expect_refused(command + " --bitrate '" + rate + "'",
                     "--bitrate: '" + std::string{rate} +
                         "' is not allowed; allowed: bit/s, as in 500000, 500k or '500 kbit/s'");
    for (const char *rate : {"0", "-500k", "-1 kbit/s", "2 Mbit/s", "1e9k"})
      expect_refused(command + " --bitrate='" + rate + "'", "1000 to 1000000");
  }
  expect_refused("bittime -b 500k -c '8 Mbit/s'",
                 "--clock: '8 Mbit/s' is not allowed; allowed: Hz, as in 8000000, 8M or '8 MHz'");
}

TEST_F(Tool, RunReportsAndExitsByTheExpectations) {
  const ToolResult good = run_tool("run examples/two-nodes.yaml --json");
  EXPECT_EQ(good.code, 0) << good.error;
  EXPECT_EQ(good.error, "");  // no progress bar where there is no terminal
  const auto json = nlohmann::json::parse(good.out);
  EXPECT_TRUE(json["ok"].get<bool>());
  EXPECT_EQ(json["runs"][0]["frames"], 13);
  const ToolResult bad = run_tool("run examples/two-nodes.yaml --duration '10 ms'");
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.out, HasSubstr("FAIL  frames: 3 (expected 13)"));
}

TEST_F(Tool, ReplayThenDecodeGivesTheLogBack) {
  const std::string log =
      file_with("round.log",
                "(0000000001.000000) can0 123#112233\n(0000000001.001000) can0 12345678#\n"
                "(0000000001.002000) can0 7FF#0102030405060708_C\n");
  const std::string vcd = in("round.vcd"), back = in("round.back");
  const ToolResult replayed = run_tool("replay " + log + " --vcd " + vcd + " --json");
  EXPECT_EQ(replayed.code, 0) << replayed.out;
  const ToolResult decoded = run_tool("decode " + vcd + " --candump " + back + " --json");
  EXPECT_EQ(decoded.code, 0);
  EXPECT_EQ(nlohmann::json::parse(decoded.out)["frames"], 3);
  const std::string frames = slurp(back);
  for (const char *frame : {"123#112233", "12345678#", "7FF#0102030405060708_C"})
    EXPECT_THAT(frames, HasSubstr(frame));
}

// The wave of a replay, up to the CRC delimiter of its second frame: from there on it is recessive,
// but nobody has seen the ACK slot.
TEST_F(Tool, DecodeTellsOfAFrameThatTheFileCuts) {
  const std::string log = file_with("cut.log", "(1.0) can0 123#112233\n(1.001) can0 124#445566\n");
  const std::string vcd = in("whole.vcd");
  ASSERT_EQ(run_tool("replay " + log + " --vcd " + vcd).code, 0);
  const auto whole = nlohmann::json::parse(run_tool("decode " + vcd + " --json").out);
  ASSERT_EQ(whole["frames"], 2);
  EXPECT_TRUE(whole["cut_ps"].is_null());
  const auto start = whole["events"][1]["start_ps"].get<std::int64_t>();
  const auto end = whole["events"][1]["end_ps"].get<std::int64_t>();
  constexpr std::int64_t kTail = 19'000'000;  // ps; ACK slot, its delimiter and EOF have 18 us
  std::string text;
  std::istringstream lines{slurp(vcd)};
  for (std::string line; std::getline(lines, line); text += line + "\n")
    if (line[0] == '#' && std::stoll(line.substr(1)) * 1000 > end - kTail) break;
  const std::string half = file_with("half.vcd", text);
  const ToolResult said = run_tool("decode " + half + " -b 500k");
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.out, HasSubstr(" us frame cut by the end of the waveform\nsignal "));
  const auto json = nlohmann::json::parse(run_tool("decode " + half + " -b 500k --json").out);
  EXPECT_EQ(json["cut_ps"], start);
  EXPECT_EQ(json["frames"], 1);
  EXPECT_EQ(json["errors"], 0);
  const ToolResult page = run_tool("report " + half + " -b 500k --out " + in("half.html"));
  EXPECT_EQ(page.code, 0);
  EXPECT_THAT(page.out, HasSubstr(fmt::format("{:.3f} us frame cut by the end of the waveform\n",
                                              static_cast<double>(start) / 1e6)));
  EXPECT_THAT(page.out, HasSubstr(": 1 frames, 0 without ACK, 0 error frames, "));
}

// A wrong bit rate makes errors of frames, or nothing at all: both look like a bus that is so.
TEST_F(Tool, DecodeTellsWhyItFindsNoFrame) {
  const std::string log = file_with("a.log", "(1.0) can0 123#112233\n(1.001) can0 124#445566\n");
  const std::string vcd = in("a.vcd"), page = in("a.html");
  ASSERT_EQ(run_tool("replay " + log + " --vcd " + vcd).code, 0);
  const std::string doubt =
      "verican: warning: " + vcd +
      ": signal 'bus.can' has edges as at 500000 bit/s, and was read at 250000\n";
  for (const std::string command :
       {"decode " + vcd, "decode --json " + vcd, "report " + vcd + " -o " + page})
    EXPECT_EQ(run_tool(command + " -b 250k").error, doubt) << command;
  EXPECT_EQ(run_tool("decode " + vcd + " -b 500k").error, "");
  EXPECT_EQ(run_tool("decode " + vcd + " -b 505k").error, "");
  const std::string idle =
      file_with("idle.vcd",
                "$timescale 1 us $end\n$var wire 1 ! can $end\n$enddefinitions $end\n"
                "#0\n1!\n#1000\n");
  const std::string old = file_with("old.log", "precious");
  for (const std::string command : {"decode " + idle + " --candump " + old + " --pcap " + old + "2",
                                    "report " + idle + " -o " + page}) {
    const ToolResult nothing = run_tool(command + " -b 500k");
    EXPECT_EQ(nothing.code, 1) << command;
    EXPECT_EQ(nothing.error, "verican: " + idle + ": no frame is in it\n");
  }
  EXPECT_EQ(slurp(old), "precious");
  EXPECT_FALSE(std::filesystem::exists(old + "2"));
}

// IN-01: a frame can only be heard behind eleven recessive bits.
TEST_F(Tool, DecodeTellsThatAWaveformBeginsTooLate) {
  const std::string wave =
      file_with("late.vcd",
                "$timescale 1 us $end\n$var wire 1 ! can $end\n$enddefinitions $end\n"
                "#0\n1!\n#20\n0!\n#22\n1!\n#40\n");
  for (const std::string command : {"decode " + wave, "report " + wave + " -o " + in("a.html")})
    EXPECT_EQ(
        run_tool(command + " -b 500k").error,
        "verican: warning: " + wave +
            ": nowhere in it are eleven recessive bits, behind which alone a frame can begin\n"
            "verican: " +
            wave + ": no frame is in it\n")
        << command;
}

TEST_F(Tool, BittimeJson) {
  const auto json = nlohmann::json::parse(run_tool("bittime -c 8M -b 500k --sjw 1 --json").out);
  EXPECT_EQ(json["settings"][0]["ctrl"], "0x00310005");  // what can-utils prints
}

// 8 MHz in nine clocks is 888.9 kbit/s, in eight 1 Mbit/s: 970 kbit/s is 3 % off at best.
TEST_F(Tool, BittimeWarnsOfARateThatNoClockMayHave) {
  const ToolResult warned = run_tool("bittime -c 8M -b 970k --json");
  EXPECT_EQ(warned.code, 0);
  EXPECT_THAT(warned.error, HasSubstr("warning: the nearest rate is off by +30928 ppm"));
  EXPECT_FALSE(nlohmann::json::parse(warned.out)["settings"][0]["rate_fits"].get<bool>());
  const ToolResult fits = run_tool("bittime -c 8M -b 500k --json");
  EXPECT_EQ(fits.error, "");
  EXPECT_TRUE(nlohmann::json::parse(fits.out)["settings"][0]["rate_fits"].get<bool>());
}

TEST_F(Tool, BittimeShowsOnlyWhatTheDelaysAllow) {
  const auto json = nlohmann::json::parse(run_tool("bittime -c 8M -b 1M --json").out);
  EXPECT_EQ(json["controller_delay_ns"], 250.0);
  for (const auto &setting : json["settings"]) EXPECT_GE(setting["cable_m"], 0.0);
  expect_refused("bittime -c 8M -b 1M --cable 40",
                 "40 m of cable and the delays of the nodes (100 ns a transceiver, 250 ns a "
                 "controller) are too long for 1000000 bit/s from 8000000 Hz");
  EXPECT_EQ(run_tool("bittime -c 8M -b 1M --cable 5 --node-delay 40").code, 0);
  expect_refused("bittime -c 8M -b 1M --controller-delay 400", "400 ns a controller");
}

TEST_F(Tool, PaperAgrees) {
  const ToolResult result = run_tool("paper --json --out " + in("waves"));
  EXPECT_EQ(result.code, 0);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_TRUE(json["ok"].get<bool>());
  EXPECT_EQ(json["clock_synchronisation"]["checks"].size(), 4U);
  EXPECT_THAT(slurp(in("waves/fig13-arbitration.vcd")), HasSubstr("sID "));
}

}  // namespace
