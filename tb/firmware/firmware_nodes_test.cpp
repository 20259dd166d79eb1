// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes with firmware in a scenario, as `verican run` has them (docs/scenario.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

#include "firmware/tool_run.hpp"

namespace {

using ::testing::HasSubstr;

std::string scenario_file(const std::string &text) {
  const std::string path = tb::temporary(".yaml");
  std::ofstream(path) << text;
  return path;
}

tb::ToolResult run(const std::string &text, const std::string &options = "") {
  return tb::run_tool("run " + scenario_file(text) + " " + options);
}

std::string node(const std::string &name, const std::string &elf, const std::string &more = "") {
  return "  - {name: " + name + ", firmware: " + elf + more + "}\n";
}

const std::string kPingPong =
    "duration: 100 ms\nnodes:\n" + node("asks", tb::example_elf("ping"), ", clock: 32 MHz") +
    node("answers", tb::example_elf("pong"), ", clock: 32 MHz") + "  - {name: hears, ppm: 100}\n";

// `ping` sends ten frames and one that ends `pong`, which answers each: 22 frames. The boards are
// told apart by their names, and a node without firmware has heard all of them.
TEST(FirmwareNodes, TwoBoardsOnOneBus) {
  const auto result =
      run(kPingPong +
          "expect:\n  frames: 22\n  nodes:\n"
          "    asks: {sent: 11, exit_code: 0, output: [ping 0, '10 pings, 0 failed']}\n"
          "    answers: {sent: 11, exit_code: 0, matches: '^11 answers'}\n"
          "    hears: {received: 22, overruns: 0}\n");
  EXPECT_EQ(result.code, 0) << result.out << result.error;
  EXPECT_THAT(result.out, HasSubstr("\nasks: 10 pings, 0 failed\n"));
  EXPECT_THAT(result.out, HasSubstr("exit code 0"));
  EXPECT_EQ(result.error, "");
}

TEST(FirmwareNodes, ExpectationsAreHeldAgainstWhatTheFirmwareDid) {
  const auto result = run(kPingPong +
                          "expect: {nodes: {asks: {exit_code: 3, output: no such words, "
                          "matches: 'x{5}'}}}\n");
  EXPECT_EQ(result.code, 1) << result.out;
  EXPECT_THAT(result.out, HasSubstr("FAIL  asks.exit_code: 0 (expected 3)"));
  EXPECT_THAT(result.out, HasSubstr("(expected 'no such words')"));
  EXPECT_THAT(result.out, HasSubstr("(expected matches 'x{5}')"));
  const auto early = run("duration: 2 ms\nnodes:\n" + node("ecu", tb::test_elf("cpu")) +
                         "expect: {nodes: {ecu: {exit_code: 0}}}\n");
  EXPECT_EQ(early.code, 1);
  EXPECT_THAT(early.out, HasSubstr("FAIL  ecu.exit_code: no end in time (expected 0)"));
}

// A failure of the firmware itself is no success, whether somebody expected something or not.
TEST(FirmwareNodes, FailuresOfTheFirmwareCount) {
  const auto code = run("duration: 2 ms\nnodes:\n" + node("ecu", tb::test_elf("semihosting")));
  EXPECT_EQ(code.code, 1);
  EXPECT_THAT(code.error, HasSubstr("ended with exit code 3"));
  EXPECT_EQ(run("duration: 2 ms\nnodes:\n" + node("ecu", tb::test_elf("semihosting")) +
                "expect: {nodes: {ecu: {exit_code: 3, output: hello}}}\n")
                .code,
            0);
  const auto fault = run("duration: 2 ms\nnodes:\n" + node("ecu", tb::test_elf("faulty")));
  EXPECT_EQ(fault.code, 4);
  EXPECT_THAT(fault.error, HasSubstr("verican: stopped by a fault after "));
  EXPECT_THAT(fault.error, HasSubstr("ecu ("));
}

TEST(FirmwareNodes, SecondCore) {
  const std::string board = node("ecu", tb::test_elf("second_core"));
  EXPECT_EQ(run("duration: 2 ms\nnodes:\n" + board +
                "  - {name: other, second_core_of: ecu}\n  - {name: third}\n"
                "expect: {nodes: {ecu: {exit_code: 0}}}\n")
                .code,
            0);
  EXPECT_EQ(run("duration: 2 ms\nnodes:\n" + board + "  - {name: third}\n").code, 4);
}

TEST(FirmwareNodes, Json) {
  const auto result = run(kPingPong, "--json");
  const auto boards = nlohmann::json::parse(result.out)["runs"][0]["boards"];
  ASSERT_EQ(boards.size(), 2U);
  EXPECT_EQ(boards[0]["node"], "asks");
  EXPECT_EQ(boards[0]["end"], "exit");
  EXPECT_EQ(boards[1]["output"], "11 answers\n");
}

// The path of the ELF file counts from the folder of the scenario.
TEST(FirmwareNodes, PathIsRelativeToTheScenario) {
  const auto result = run("nodes: [{name: ecu, firmware: no_such.elf}]\n");
  EXPECT_EQ(result.code, 2);
  const std::string folder = tb::temporary("").substr(0, tb::temporary("").rfind('/'));
  EXPECT_THAT(result.error, HasSubstr(folder + "/no_such.elf: no such file"));
}

TEST(FirmwareNodes, BadSettingsAreRefused) {
  const auto refused = [](const std::string &text, const std::string &what) {
    const auto result = run("nodes:\n" + text);
    EXPECT_EQ(result.code, 2) << text;
    EXPECT_THAT(result.error, HasSubstr(what));
    EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
  };
  const std::string elf = tb::test_elf("cpu");
  refused(node("a", elf, ", filters: [{id: 1}]"), "unknown key 'filters'");
  refused(node("a", elf, ", software: none"), "unknown key 'software'");
  refused(node("a", elf, ", clocks_per_instruction: 0"), "clocks_per_instruction: '0'");
  refused("  - {name: a, second_core_of: b}\n", "'b' is not allowed; allowed: the name of a node");
  refused(node("a", elf) + "  - {name: b, second_core_of: a}\n  - {name: c, second_core_of: a}\n",
          "has its second core already");
  refused(node("a", elf, ", second_core_of: a"), "a node is of one kind");
  refused(node("a", elf) + "traffic: [{node: a, id: 1}]\n", "sends of its own");
  refused(node("a", elf) + "expect: {nodes: {a: {overruns: 0}}}\n", "unknown key 'overruns'");
  refused("  - {name: a}\nexpect: {nodes: {a: {exit_code: 0}}}\n", "unknown key 'exit_code'");
  refused(node("a", elf) + "expect: {nodes: {a: {matches: '('}}}\n", "a regular expression");
}

}  // namespace
