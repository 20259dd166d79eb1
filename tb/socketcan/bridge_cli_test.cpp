// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The command line of `verican bridge`: what it refuses, in one line, with exit code 2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace vericansim {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Outcome {
  int code = -1;
  std::string output;
};

Outcome bridge(const std::string &arguments) {
  FILE *pipe =
      ::popen((std::string{VERICAN_BINARY} + " bridge " + arguments + " 2>&1").c_str(), "r");
  Outcome outcome;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) outcome.output += part.data();
  const int status = ::pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// Arguments, and what the line must say.
struct Refusal {
  const char *arguments;
  const char *words;
};

class BridgeRefuses : public ::testing::TestWithParam<Refusal> {};

TEST_P(BridgeRefuses, InOneLine) {
  const Outcome outcome = bridge(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.output, StartsWith("verican: "));
  EXPECT_THAT(outcome.output, HasSubstr(GetParam().words));
  EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, BridgeRefuses,
    ::testing::Values(
        Refusal{"", "nothing to bridge"}, Refusal{"--if a0 --if a0", "'a0' is named twice"},
        Refusal{"--if a0 --monitor a0", "'a0' is named twice"},
        Refusal{"--if a0 --filter 12G:7FF", "--filter: '12G:7FF'"},
        Refusal{"--if a0 --errors some", "--errors"}, Refusal{"--if a0 --time 5", "--time: '5'"},
        Refusal{"--if a0 --bitrate 2M", "--bitrate"}, Refusal{"--if a0 --nodes 61", "--nodes"},
        Refusal{"--if a0 --nodes 1 --bus x.yaml", "--bus"},
        Refusal{"--if a0 --bus nosuch.yaml", "nosuch.yaml"},
        Refusal{"--socketcand 0 --echo", "--if"}, Refusal{"--socketcand 0 --queue 9", "--if"},
        Refusal{"--socketcand 0 --end-when-down", "--end-when-down: needs an interface"},
        Refusal{"--socketcand 0065535", "'0065535' is not allowed"},
        Refusal{"--socketcand 0 --bitrate 500k --clock 3M", "500000 bit/s"}));

// With CAN in the kernel or without: the interface is named, and what helps.
TEST(BridgeCommand, MissingInterfaceOrNoCan) {
  const Outcome outcome = bridge("--if nosuchcan0");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.output, StartsWith("verican: --if nosuchcan0: "));
  EXPECT_THAT(outcome.output, AnyOf(HasSubstr("--socketcand"), HasSubstr("ip link add")));
}

TEST(BridgeCommand, SeveralBitRatesNeedAChoice) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("bridge-rates-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream{path} << "bitrate: [125k, 250k]\nnodes:\n  - name: a\n";
  const Outcome refused = bridge("--socketcand 0 --time 5ms --bus " + path.string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.output, HasSubstr("several bit rates; --bitrate says which"));
  const Outcome chosen = bridge("--socketcand 0 --bitrate 250k --time 5ms --bus " + path.string());
  EXPECT_EQ(chosen.code, 0) << chosen.output;
  std::filesystem::remove(path);
}

/// A bus in a file that goes with the test.
class BusFile {
 public:
  explicit BusFile(const std::string &text)
      : path_{std::filesystem::temp_directory_path() /
              ("bridge-bus-" + std::to_string(::getpid()) + ".yaml")} {
    std::ofstream{path_} << text;
  }
  ~BusFile() { std::filesystem::remove(path_); }
  BusFile(const BusFile &) = delete;
  BusFile &operator=(const BusFile &) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// The port's node acknowledges and takes every frame, whatever the file would have its own software
// do; what is the core's and the bus's holds.
TEST(BridgeCommand, KeysThatTheInterfaceDoesNotObeyAreRefused) {
  for (const std::string keys :
       {"listen_only: true", "loop_back: true", "self_reception: true", "triple_sampling: true",
        "fd_tolerant: true", "lowest_buffer_first: true", "bus_off_recovery: never",
        "tx_buffers: 2", "filters: [{id: 0x100, mask: 0x7FF}]", "software: none"}) {
    const BusFile bus("nodes:\n  - {name: a}\n  - {name: can0, " + keys + "}\n");
    const Outcome outcome = bridge("--socketcand 0 --time 1ms --bus " + bus.path());
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_EQ(outcome.output, "verican: " + bus.path() +
                                  ":3: node 'can0', which programs of the host work, has '" + keys +
                                  "'; allowed: no keys of the simulation's own software\n");
  }
  const BusFile bus(
      "nodes:\n  - {name: a}\n  - {name: can0, ppm: 9, cable: 1 m, mailboxes: 16, sjw: 1}\n");
  EXPECT_EQ(bridge("--socketcand 0 --time 1ms --bus " + bus.path()).code, 0);
}

// A node of the port's name would be the port's, and nobody would acknowledge.
TEST(BridgeCommand, PlainNodesAreOthersThanThePorts) {
  const Outcome outcome = bridge("--socketcand 0 --bus-name node0 --time 1ms --json");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("\"node0\""));
  EXPECT_THAT(outcome.output, HasSubstr("\"node1\""));
}

TEST(BridgeCommand, QuietItSaysWhereTheBusIsAndNothingElse) {
  const Outcome outcome = bridge("--socketcand 0 --time 1ms -q");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("socketcand can0 at 127.0.0.1:"));
  EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 2) << outcome.output;
}

// A scenario of its own traffic: it runs for the time asked, its expectations decide the exit code.
TEST(BridgeCommand, ExpectationsOfTheScenarioCount) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("bridge-expect-" + std::to_string(::getpid()) + ".yaml");
  for (const int wanted : {11, 12}) {  // at 0, 5, ... 50 ms
    std::ofstream{path} << "bitrate: 500k\nduration: 1 ms\nnodes:\n  - {name: a, clock: 4 MHz}\n"
                           "traffic:\n  - {node: a, id: 0x12, data: \"01\", period: 5 ms}\n"
                           "expect:\n  frames: "
                        << wanted << "\n";
    const Outcome outcome = bridge("--socketcand 0 --fast --time 52ms --bus " + path.string());
    EXPECT_EQ(outcome.code, wanted == 11 ? 0 : 1) << outcome.output;
  }
  std::filesystem::remove(path);
}

// A frame that no program has sent would leave the core of the programs.
TEST(BridgeCommand, AccessesToBuffersOfTheInterfaceAreRefused) {
  const std::string nodes = "nodes:\n  - {name: a}\n  - {name: can0}\n";
  for (const bool buffer : {false, true}) {
    const BusFile bus(nodes + "accesses:\n  - {node: " + (buffer ? "can0" : "a") +
                      ", at: 1 ms, do: [write MB5.ID 0x123, write MB5.CS 0x0C010000]}\n" +
                      "  - {node: can0, at: 2 ms, do: [check MCR 0x100000 0, read MB5.CS]}\n");
    const Outcome outcome = bridge("--socketcand 0 --time 9ms --bus " + bus.path());
    EXPECT_EQ(outcome.code, buffer ? 2 : 0) << outcome.output;
    EXPECT_THAT(outcome.output,
                HasSubstr(buffer ? ":3: 'accesses' write buffers of node 'can0'" : "frames 1 "));
  }
}

// As in a scenario that has the programs as nodes itself.
TEST(BridgeCommand, ARecordingThatHasBeenSentIsNoEndUnlessTheFileSaysSo) {
  const BusFile log("(0.000000) can0 123#01\n(0.001000) can0 124#02\n");
  for (const bool done : {false, true}) {
    const std::string path = log.path() + ".bus";
    std::ofstream{path} << (done ? "end: done\n" : "")
                        << "nodes:\n  - {name: a}\n  - {name: sender, replay: '" << log.path()
                        << "'}\n";
    const Outcome outcome = bridge("--socketcand 0 --time 150ms --bus " + path);
    std::filesystem::remove(path);
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("frames 2 "));
    EXPECT_THAT(outcome.output, HasSubstr(done ? "bridge: 0.00" : "bridge: 0.15")) << done;
  }
}

}  // namespace
}  // namespace vericansim
