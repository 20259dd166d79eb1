// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// examples/mixed.yaml: two boards, a recording, python-can and a plain node on one bus with a
// fault.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "firmware/tool_run.hpp"
#include "harness/shell.hpp"
#include "system/running_tool.hpp"
#include "trace/log.hpp"

namespace {

using ::testing::HasSubstr;
using namespace vericansim;

void replace(std::string &text, const std::string &what, const std::string &with) {
  const std::size_t place = text.find(what);
  ASSERT_NE(place, std::string::npos) << what;
  text.replace(place, what.size(), with);
}

/// The example with any free port, in the temporary folder.
std::string example(const std::string &log) {
  std::string text = tb::slurp("examples/mixed.yaml");
  const std::string here = std::filesystem::current_path().string();
  replace(text, "socketcand: 29536", "socketcand: '127.0.0.1:0'");
  replace(text, "../build/release/firmware/ping.elf", tb::example_elf("ping"));
  replace(text, "../build/release/firmware/pong.elf", tb::example_elf("pong"));
  replace(text, "boat.log", here + "/examples/boat.log");
  const std::string path = tb::temporary(".yaml");
  std::ofstream(path) << text << "outputs: {candump: " << log << "}\n";
  return path;
}

/// Frames of `log` with an identifier that `wanted` likes.
template <typename Wanted>
std::vector<Frame> chosen(const std::vector<LogEntry> &log, Wanted wanted) {
  std::vector<Frame> frames;
  for (const LogEntry &entry : log)
    if (wanted(entry.frame)) frames.push_back(entry.frame);
  return frames;
}

// What was on the bus, by an independent reading of its log: the recording whole and in order, the
// eleven questions and answers, the program's three frames; and the expectations of the example.
TEST(MixedExample, EveryKindOfNodeOnOneBus) {
  if (!has_python_can()) GTEST_SKIP() << "python-can is not installed";
  const std::string log = tb::temporary(".log");
  tb::RunningTool tool{{"run", example(log), "--json"}};
  std::smatch port;
  std::string said;
  ASSERT_TRUE(tool.wait_until([&] {
    said = tb::slurp(tb::temporary(".err"));
    return std::regex_search(said, port, std::regex{"127\\.0\\.0\\.1:([0-9]+)\n"});
  })) << said;
  EXPECT_EQ(std::system(("examples/python_can.py " + port[1].str() + " > /dev/null 2>&1").c_str()),
            0);
  const tb::ToolResult result = tool.wait();
  EXPECT_EQ(result.code, 0) << result.out << result.error;

  const auto seen = read_log(log).entries;
  const auto extended = chosen(seen, [](const Frame &f) { return f.extended; });
  const auto recorded =
      chosen(read_log("examples/boat.log").entries, [](const Frame &) { return true; });
  EXPECT_EQ(recorded.size(), 65U);
  EXPECT_TRUE(extended == recorded);
  EXPECT_EQ(chosen(seen, [](const Frame &f) { return !f.extended && f.id == 0x100; }).size(), 11U);
  EXPECT_EQ(chosen(seen, [](const Frame &f) { return !f.extended && f.id == 0x101; }).size(), 11U);
  EXPECT_EQ(chosen(seen, [](const Frame &f) { return !f.extended && f.id >> 8 == 4; }).size(), 3U);
  EXPECT_EQ(seen.size(), 65U + 22 + 3);

  const auto run = nlohmann::json::parse(result.out)["runs"][0];
  EXPECT_EQ(run["error_frames"], 1);
  EXPECT_EQ(run["boards"].size(), 2U);
  EXPECT_EQ(run["replays"][0]["receivers"][0]["received"], 65);
  EXPECT_EQ(run["ports"][0]["sent"], 3);
  EXPECT_EQ(run["socketcand"][0]["clients"], 1);
  EXPECT_EQ(run["pace"]["fast"], true);
}

// An interface that is not there is named with its place in the file.
TEST(MixedExample, MissingInterfaceIsTold) {
  const std::string path = tb::temporary(".yaml");
  std::ofstream(path) << "nodes:\n  - {name: a}\n  - {name: pc, interface: nocan7}\n";
  const auto result = tb::run_tool("run " + path);
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.error, HasSubstr(path + ":3: interface nocan7: "));
}

}  // namespace
