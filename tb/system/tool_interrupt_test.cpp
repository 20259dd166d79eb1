// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SIGINT, SIGTERM and SIGHUP end long work cleanly: whole outputs, the summary so far, 128 + the
// signal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>

#include "harness/scratch_test.hpp"
#include "system/running_tool.hpp"
#include "trace/log.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tb;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using vericansim::ScratchTest;
using Json = nlohmann::json;

class ToolInterrupt : public ScratchTest {
 protected:
  /// Two nodes and a frame every millisecond for a day.
  [[nodiscard]] std::string long_scenario() const {
    return file_with("long.yaml",
                     "bitrate: 500k\nduration: 90000 s\nnodes:\n  - name: a\n  - name: b\n"
                     "traffic:\n  - {node: a, id: 0x123, data: counter, dlc: 2, period: 1 ms}\n"
                     "expect: {frames: 7}\n");
  }
  /// As much, recorded.
  [[nodiscard]] std::string long_log() const {
    std::string text;
    for (int i = 0; i < 100'000; ++i)
      text += "(" + std::to_string(1'000'000'000 + i) + ".000000) can0 123#1122\n";
    return file_with("long.log", text);
  }
  /// The tool has opened its outputs, and begins to simulate.
  [[nodiscard]] bool writes(std::size_t inputs) const { return files() > inputs; }
  [[nodiscard]] std::uintmax_t bytes() const {
    std::uintmax_t sum = 0;
    for (const auto &file : fs::directory_iterator{folder.path()}) {
      std::error_code gone;  // renamed meanwhile
      const std::uintmax_t size = file.file_size(gone);
      if (!gone) sum += size;
    }
    return sum;
  }
  /// Runs the tool, ends it by `signal` once it writes beside its `inputs` files.
  [[nodiscard]] ToolResult interrupt(const std::vector<std::string> &arguments, int signal,
                                     std::size_t inputs = 1) const {
    RunningTool tool{arguments};
    if (!tool.wait_until([&] { return writes(inputs); })) ADD_FAILURE() << "ended by itself";
    tool.signal(signal);
    return tool.wait();
  }
};

TEST_F(ToolInterrupt, ARunEndsWithWholeOutputs) {
  const std::string database =
      file_with("a.dbc", "VERSION \"\"\nBO_ 291 M: 2 a\n SG_ S : 0|16@1+ (1,0) [0|65535] \"\" b\n");
  RunningTool tool{{"run", long_scenario(), "--json", "--candump", in("bus.log"), "--pcap",
                    in("bus.pcap"), "--vcd", in("bus.vcd"), "--report", in("bus.html"), "--dbc",
                    database}};
  ASSERT_TRUE(tool.wait_until([&] { return bytes() > 500'000; }));  // some frames in the waveform
  tool.signal(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.code, 130) << result.error;
  const Json json = Json::parse(result.out);
  EXPECT_FALSE(json["ok"].get<bool>());
  const Json &run = json["runs"][0];
  EXPECT_TRUE(run["interrupted"].get<bool>());
  EXPECT_TRUE(run["checks"].empty());  // what a run of its whole length must show
  const auto frames = run["frames"].get<std::size_t>();
  EXPECT_EQ(run["identifiers"][0]["count"], frames);
  EXPECT_EQ(run["signals"]["frames"]["known"], frames);
  EXPECT_EQ(vericansim::read_log(in("bus.log")).entries.size(), frames);
  EXPECT_EQ(vericansim::read_log(in("bus.pcap")).entries.size(), frames);
  EXPECT_THAT(slurp(in("bus.html")), EndsWith("</html>\n"));
  const ToolResult decoded = run_tool("decode " + in("bus.vcd") + " --bitrate 500k --json");
  EXPECT_EQ(Json::parse(decoded.out)["frames"], frames);
}

TEST_F(ToolInterrupt, ARunSaysSoInItsText) {
  const ToolResult result =
      interrupt({"run", long_scenario(), "--candump", in("bus.log")}, SIGTERM);
  EXPECT_EQ(result.code, 143) << result.error;
  EXPECT_THAT(result.out, HasSubstr("interrupted; expectations were not checked"));
  EXPECT_THAT(result.out, Not(HasSubstr("FAIL")));
}

// A terminal that is closed, unless nohup has it ignored.
TEST_F(ToolInterrupt, AHangUpLeavesNothingUnfinished) {
  std::signal(SIGHUP, SIG_DFL);  // whatever the tests were started by
  const ToolResult result = interrupt({"run", long_scenario(), "--vcd", in("bus.vcd")}, SIGHUP);
  EXPECT_EQ(result.code, 129) << result.error;
  EXPECT_EQ(files(), 2U);
  EXPECT_THAT(slurp(in("bus.vcd")), HasSubstr("$enddefinitions"));
}

TEST_F(ToolInterrupt, AHangUpThatIsIgnoredIsNoEnd) {
  std::signal(SIGHUP, SIG_IGN);  // inherited
  RunningTool tool{{"run", long_scenario(), "--candump", in("bus.log")}};
  std::signal(SIGHUP, SIG_DFL);
  ASSERT_TRUE(tool.wait_until([&] { return writes(1); }));
  tool.signal(SIGHUP);
  tool.signal(SIGTERM);
  EXPECT_EQ(tool.wait().code, 143);
  EXPECT_TRUE(fs::exists(in("bus.log")));  // the first signal that counted
}

// The runs that would have followed are left out.
TEST_F(ToolInterrupt, NoFurtherBitRateIsBegun) {
  std::string text = slurp(long_scenario());
  text.replace(text.find("500k"), 4, "[500k, 250k]");
  const ToolResult result = interrupt(
      {"run", file_with("long.yaml", text), "--json", "--candump", in("bus.log")}, SIGINT);
  EXPECT_EQ(result.code, 130) << result.error;
  EXPECT_EQ(Json::parse(result.out)["runs"].size(), 1U);
  EXPECT_TRUE(fs::exists(in("bus-500k.log")));
  EXPECT_FALSE(fs::exists(in("bus-250k.log")));
}

TEST_F(ToolInterrupt, AReplayDoesNotMissWhatHasNotComeYet) {
  for (const bool json : {true, false}) {
    std::vector<std::string> arguments{"replay", long_log(), "--candump", in("bus.log")};
    if (json) arguments.push_back("--json");
    const ToolResult result = interrupt(arguments, SIGTERM);
    EXPECT_EQ(result.code, 143) << result.error;
    fs::remove(in("bus.log"));
    if (!json) {
      EXPECT_THAT(result.out, HasSubstr("interrupted"));
      EXPECT_THAT(result.out, Not(HasSubstr("NO: ")));
      continue;
    }
    EXPECT_TRUE(Json::parse(result.out)["interrupted"].get<bool>());
    EXPECT_FALSE(Json::parse(result.out)["ok"].get<bool>());
  }
}

TEST_F(ToolInterrupt, PagesAreWhole) {
  std::string wave = "$timescale 1 us $end\n$var wire 1 ! can $end\n$enddefinitions $end\n";
  for (int i = 0; i < 400'000; ++i)
    wave += "#" + std::to_string(1000 * i) + "\n" + std::to_string(i % 2) + "!\n";
  const std::string recorded = file_with("wave.vcd", wave);
  const std::string inputs[] = {long_scenario(), long_log(), recorded};
  for (const std::string &input : inputs) {
    const ToolResult result =
        interrupt({"report", input, "-o", in("page.html"), "--bitrate", "500k"}, SIGINT, 3);
    EXPECT_EQ(result.code, 130) << result.error;
    EXPECT_THAT(result.out, HasSubstr("interrupted")) << input;
    EXPECT_THAT(slurp(in("page.html")), EndsWith("</html>\n"));
    fs::remove(in("page.html"));
  }
}

TEST_F(ToolInterrupt, FirmwareIsToldWhereItWas) {
  const std::string bus = file_with(
      "bus.yaml", "bitrate: 500k\nduration: 90000 s\nnodes:\n  - {name: firmware, clock: 8 MHz}\n");
  const ToolResult result = interrupt(
      {"firmware", example_elf("pong"), "--bus", bus, "--json", "--candump", in("bus.log")},
      SIGINT);
  EXPECT_EQ(result.code, 130) << result.error;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["boards"][0]["end"], "interrupted");
  EXPECT_TRUE(json["buses"][0]["interrupted"].get<bool>());
  EXPECT_THAT(result.error, HasSubstr("interrupted after"));
}

TEST_F(ToolInterrupt, ThePaperStopsBehindAnExperiment) {
  const ToolResult result = interrupt({"paper", "--json", "--out", in("waves")}, SIGINT, 0);
  EXPECT_EQ(result.code, 130) << result.error;
  const Json json = Json::parse(result.out);
  EXPECT_TRUE(json["interrupted"].get<bool>());
  EXPECT_FALSE(json["ok"].get<bool>());
  EXPECT_LT(json["experiments"].size(), 5U);
  for (const Json &experiment : json["experiments"])
    EXPECT_TRUE(fs::exists(experiment["wave"].get<std::string>()));
}

// What hangs can be ended: here the page's name is a pipe that nobody reads.
TEST_F(ToolInterrupt, TheSecondSignalEndsAtOnce) {
  const std::string scenario = long_scenario();
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  RunningTool tool{{"run", scenario, "--candump", in("bus.log"), "--fst", in("bus.fst"), "--report",
                    in("pipe")}};
  ASSERT_TRUE(tool.wait_until([&] { return files() >= 2 + 3; }));  // that of FST has two
  tool.signal(SIGINT);
  tool.signal(SIGTERM);
  const int code = tool.wait().code;
  EXPECT_TRUE(code == 143 || code == 130) << code;  // two that come together may swap
  EXPECT_EQ(files(), 2U);
}

// Commands that do not end cleanly leave none of their files either.
TEST_F(ToolInterrupt, NothingUnfinishedStays) {
  const std::string wave = file_with("a.vcd",
                                     "$timescale 1 us $end\n$var wire 1 ! can $end\n"
                                     "$enddefinitions $end\n#0\n1!\n#200\n0!\n#300\n1!\n#600\n");
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    RunningTool tool{
        {"decode", wave, "-b", "100k", "--candump", in("bus.log"), "--pcap", in("pipe")}};
    ASSERT_TRUE(tool.wait_until([&] { return writes(2); }));
    tool.signal(signal);
    EXPECT_EQ(tool.wait().code, -1);  // by the signal, as a shell wants to see it
    EXPECT_EQ(files(), 2U);
  }
}

// Nothing has begun that could end cleanly: who types `verican run -` has to get away again.
TEST_F(ToolInterrupt, AnInputThatDoesNotComeIsNotWaitedFor) {
  const std::string log = file_with("a.log", "(1.0) can0 123#11\n");
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  for (const std::vector<std::string> &arguments :
       {std::vector<std::string>{"run", in("pipe")},
        {"replay", in("pipe")},
        {"replay", log, "--bus", in("pipe")},
        {"report", in("pipe"), "-o", in("a.html")},
        {"firmware", VERICAN_FIRMWARE_DIR "/ping.elf", "--bus", in("pipe")}}) {
    RunningTool tool{arguments};
    const int writer = ::open(in("pipe").c_str(), O_WRONLY);  // once the tool reads
    tool.signal(SIGINT);
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds{10};
    EXPECT_FALSE(tool.wait_until([&] { return std::chrono::steady_clock::now() > limit; }))
        << arguments[0];
    ::close(writer);
    EXPECT_EQ(tool.wait().code, -1) << arguments[0];
  }
  EXPECT_EQ(files(), 2U);
}

}  // namespace
