// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican firmware as a user meets it: exit codes and what it says when something is wrong
// (docs/tool.md, docs/firmware.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

#include "firmware/tool_run.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string file_with(const std::string &suffix, const std::string &text) {
  const std::string path = tb::temporary(suffix);
  std::ofstream(path) << text;
  return path;
}

const std::string kNodes = "duration: 2 ms\ndrain: 0 ms\nnodes:\n  - {name: other, clock: 8 MHz}\n";

tb::ToolResult run(const std::string &program, const std::string &options = "",
                   const std::string &scenario = kNodes) {
  return tb::run_tool("firmware " + tb::test_elf(program) + " --bus " +
                      file_with(".yaml", scenario) + " " + options);
}

TEST(FirmwareTool, FaultReport) {
  const auto result = run("faulty");
  EXPECT_EQ(result.code, 4);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.error, HasSubstr("verican: stopped by a fault after "));
  EXPECT_THAT(result.error, HasSubstr("BusFault escalated to HardFault: read of 2 bytes at "
                                      "0x40060002: nothing is there; there is flash 0x00000000"));
  EXPECT_THAT(result.error, HasSubstr("(reader+0x2)"));
  EXPECT_THAT(result.error, HasSubstr("r0   0x40060000"));
  EXPECT_THAT(result.error, HasSubstr("r3   0x12345678"));
  EXPECT_THAT(result.error, HasSubstr("thread mode"));
  EXPECT_THAT(result.error, HasSubstr("bfar 0x40060002"));
}

TEST(FirmwareTool, LockUp) {
  const auto result = run("faulty", "--run-hard-fault-handler");
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.error, HasSubstr("lock-up: read of 4 bytes at 0x40060000"));
  EXPECT_THAT(result.error, HasSubstr("handler of HardFault"));
  EXPECT_THAT(result.error, HasSubstr("(hard_fault)"));
}

TEST(FirmwareTool, ExitCodeOfTheFirmware) {
  const auto result = run("semihosting");
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out, "hello\n");
  EXPECT_THAT(result.error, HasSubstr("ended with exit code 3 after "));
}

TEST(FirmwareTool, NoEndWithinTheLimit) {
  const auto result = run("cpu", "--time '0.5 ms'");
  EXPECT_EQ(result.code, 5);
  EXPECT_THAT(result.error, HasSubstr("verican: no end within the limit of 500.000 us"));
  EXPECT_THAT(result.error, HasSubstr(": running\n"));
  EXPECT_THAT(result.error, HasSubstr("(idle)"));
  EXPECT_EQ(run("cpu", "--time '0.5 ms' --endless").code, 0);
  // Without --time the scenario's duration is the limit.
  EXPECT_THAT(run("cpu").error, HasSubstr("no end within the limit of 2.000 ms"));
}

TEST(FirmwareTool, OneOfSeveralBitRates) {
  const auto result =
      run("semihosting", "--bitrate 125k --json", "bitrate: [500k, 125k]\n" + kNodes);
  EXPECT_EQ(nlohmann::json::parse(result.out)["buses"][0]["bitrate"], 125e3);
}

TEST(FirmwareTool, SecondCore) {
  EXPECT_EQ(run("second_core", "--second-core").code, 0);
  const auto one = run("second_core");
  EXPECT_EQ(one.code, 4);
  EXPECT_THAT(one.error, HasSubstr("write of 4 bytes to 0x40052080: nothing is there"));
}

TEST(FirmwareTool, ExpectationsCount) {
  const auto result = run("second_core", "--second-core", kNodes + "expect: {frames: 1}\n");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("frames: 0 (expected 1)"));
}

TEST(FirmwareTool, Json) {
  const auto result = run("semihosting", "--json");
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_FALSE(json["ok"].get<bool>());
  EXPECT_EQ(json["boards"][0]["output"], "hello\n");
  EXPECT_EQ(json["boards"][0]["end"], "exit");
  EXPECT_EQ(json["boards"][0]["exit_code"], 3);
  EXPECT_EQ(json["boards"][0]["instructions"], 6);
}

TEST(FirmwareTool, BadInputIsRefused) {
  const std::string nodes = file_with(".yaml", kNodes);
  const auto refused = [](const std::string &arguments, const std::string &what) {
    const auto result = tb::run_tool("firmware " + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.error, HasSubstr(what));
    EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
  };
  const std::string good = tb::test_elf("cpu");
  refused("", "elf is required");
  refused(good, "--bus is required");
  refused("/no/such.elf --bus " + nodes, "/no/such.elf: no such file");
  refused(nodes + " --bus " + nodes, "is not an ELF file");
  refused(good + " --bus /no/such.yaml", "no such file");
  refused(good + " --bus " + nodes + " --time 5", "'5' is not allowed; allowed: a time above 0");
  refused(good + " " + good + " --bus " + nodes + " --second-core",
          "a second core needs exactly one firmware file");
  refused(good + " --bus " + nodes + " --second-core --second-bus " + nodes, "excludes");
  refused(good + " --bus " + nodes + " --clocks-per-instruction 0", "--clocks-per-instruction");
  const std::string rates = file_with("rates.yaml", "bitrate: [125k, 500k]\n" + kNodes);
  refused(good + " --bus " + rates, "has several bit rates; --bitrate says which");
  refused(good + " --bus " + nodes + " --second-bus " + rates,
          "has several bit rates; allowed for --second-bus: one");
  refused(good + " --bus " +
              file_with("2.yaml",
                        "nodes:\n  - {name: firmware}\ntraffic:\n  - {node: firmware, id: 1}\n"),
          "is that of node 'firmware', which runs firmware");
  for (const std::string key : {"listen_only: true", "software: none"})
    refused(good + " --bus " + file_with("3.yaml", "nodes:\n  - {name: firmware, " + key + "}\n"),
            ":2: node 'firmware', which runs firmware, has '" + key + "'; allowed: no keys");
}

}  // namespace
