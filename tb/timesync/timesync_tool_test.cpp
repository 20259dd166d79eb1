// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// `verican timesync` as a user meets it (TM-121, TM-123, TM-124).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>

#include "firmware/tool_run.hpp"
#include "harness/scratch_test.hpp"

namespace {

using namespace tb;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using TimeSync = vericansim::ScratchTest;

json run_json(const std::string &arguments, int code = 0) {
  const ToolResult result = run_tool("timesync --json " + arguments);
  EXPECT_EQ(result.code, code) << arguments << result.error;
  return json::parse(result.out, nullptr, false);
}

void expect_refused(const std::string &arguments, const std::string &what) {
  const ToolResult result = run_tool("timesync " + arguments);
  EXPECT_EQ(result.code, 2) << arguments;
  EXPECT_EQ(result.out, "") << arguments;
  EXPECT_THAT(result.error, StartsWith("verican: "));
  EXPECT_THAT(result.error, HasSubstr(what));
  EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
}

// TM-124: the base case is within its goal, and says so.
TEST_F(TimeSync, Base) {
  const ToolResult result = run_tool("timesync");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out,
              HasSubstr("16 MHz +-100 ppm, R = 1 s, N = 8, 8 followers, 4 x 260 intervals"));
  EXPECT_THAT(result.out, HasSubstr("yes"));
  EXPECT_THAT(result.out, HasSubstr("transceivers and cables come on top"));
  const json all = run_json("");
  EXPECT_EQ(all["ok"], true);
  EXPECT_EQ(all["goal"]["sd_ps"], 16'000);
  EXPECT_EQ(all["goal"]["max_ps"], 60'000);
  EXPECT_EQ(all["runs"].size(), 4u);
  EXPECT_EQ(all["runs"][3]["followers"].size(), 8u);
  long long most = 0;
  for (const json &run : all["runs"])
    for (const json &follower : run["followers"])
      for (std::size_t n = 0; n < run["at_ps"].size(); ++n)
        if (follower["state"][n] == 2)
          most = std::max(most, std::abs(follower["error_ps"][n].get<long long>()));
  EXPECT_EQ(all["result"]["max_ps"], most);
}

// TM-124: an option for each axis; each reaches the case.
TEST_F(TimeSync, Options) {
  const json one = run_json(
      "--frequency 50M --spread 20 --wander 1e-9 --sine 0.5 --sine-period '60 s' --followers 3 "
      "--bitrate 250k --load 0.5 --load-above '20 %' --bit-errors 1e-4 --interval '500 ms' "
      "--displaced 0.01 --own-pin --opposed --hardware --restless --master-cut "
      "--intervals 30 --seeds 2 --first-seed 7 --how model");
  const json expected = {{"frequency_hz", 50e6}, {"spread_ppm", 20.0}, {"opposed", true},
                         {"wander", 1e-9},       {"sine_ppm", 0.5},    {"sine_period_s", 60.0},
                         {"followers", 3},       {"bitrate", 250e3},   {"load", 0.5},
                         {"load_above", 0.2},    {"bit_errors", 1e-4}, {"interval_s", 0.5},
                         {"filter", 8},          {"displaced", 0.01},  {"own_pin", true},
                         {"hardware", true},     {"restless", true},   {"master_cut", true},
                         {"intervals", 30},      {"seeds", 2},         {"first_seed", 7}};
  EXPECT_EQ(one["case"], expected);
  EXPECT_EQ(one["goal"], nullptr);
  EXPECT_EQ(one["runs"].size(), 2u);
  EXPECT_EQ(one["runs"][0]["followers"].size(), 3u);
  const json automatic = run_json("--filter automatic --intervals 8 --seeds 1", 1);
  EXPECT_EQ(automatic["case"]["filter"], 0);
}

// TM-124: the largest load that is allowed, as the message for others writes it.
TEST_F(TimeSync, LargestLoadInPercent) {
  const json one = run_json("--load-above '95 %' --intervals 20 --seeds 1");
  EXPECT_EQ(one["case"]["load_above"], 0.95);
}

// TM-124: a case file, and options that take the place of what it says.
TEST_F(TimeSync, CaseFile) {
  const std::string file = file_with("case.yaml",
                                     "name: a crane\nfrequency: 40 MHz\nfilter: automatic\n"
                                     "load: 30 %\nown_pin: true\nseeds: 2\nintervals: 40\n");
  const json one = run_json(file + " --seeds 1");
  EXPECT_EQ(one["name"], "a crane");
  EXPECT_EQ(one["case"]["frequency_hz"], 40e6);
  EXPECT_EQ(one["case"]["filter"], 0);
  EXPECT_EQ(one["case"]["load"], 0.3);
  EXPECT_EQ(one["case"]["own_pin"], true);
  EXPECT_EQ(one["case"]["seeds"], 1);
  EXPECT_EQ(run_tool("timesync examples/timesync.yaml").code, 0);
}

// Bad input: one line that names the value and what is allowed.
TEST_F(TimeSync, BadInput) {
  expect_refused("--frequency 1M", "--frequency: '1M' is not allowed; allowed: 4 MHz to 400 MHz");
  expect_refused("--spread 401", "--spread: '401' is not allowed; allowed: 0 to 400");
  expect_refused("--spread nan", "--spread: 'nan'");
  expect_refused("--filter 3", "allowed: 1, 2, 4, 8, 16 or automatic");
  expect_refused("--followers 0", "--followers: '0' is not allowed; allowed: 1 to 32");
  expect_refused("--followers 33", "--followers: '33'");
  expect_refused("--interval 1", "--interval: '1' is not allowed; allowed: a time of 50 ms to 5 s");
  expect_refused("--load 101%", "--load: '101%'");
  expect_refused("--load 60% --load-above 50%",
                 "--load: load and load-above take 110 % of the bus; allowed: 100 % together");
  expect_refused("--load-above 1", "allowed: 0 to 95 %, or 0 to 0.95");
  expect_refused("--seeds -1", "--seeds");
  expect_refused("--first-seed 0", "--first-seed: '0' is not allowed; allowed: 1 to 2^32 - 1");
  expect_refused("--hardware --filter 16",
                 "--filter: is that of the servo in software; allowed: without hardware");
  expect_refused(file_with("e.yaml", "hardware: true\nfilter: automatic\n"),
                 "e.yaml: filter: is that of the servo in software");
  // 2^32 / (R f) is 2.1, so KI is 1, and KD at most KI (docs/time.md).
  expect_refused("--hardware --frequency 400M --interval 5s",
                 "--interval: at this clock KI is 1, and KD of followers in hardware is 2");
  expect_refused("--how skip --hardware", "--how skip knows no followers in hardware");
  // 4 MHz has four clocks a bit; of 13.37 MHz no bit rate near 500 kbit/s is a whole part.
  expect_refused("--how skip --frequency 4M --bitrate 1M", "knows no bit timing for this bit rate");
  expect_refused("--how rtl --p4 --frequency 13.37M", "knows no bit timing for this bit rate");
  expect_refused("--how rtl --master-cut", "--how rtl knows no cut master");
  expect_refused("--master-cut --followers 1",
                 "--master-cut: leaves nobody to follow; allowed: with 2 followers or more");
  expect_refused("--sweep --followers 1", "--followers: leaves nobody to follow where the sweep");
  expect_refused("--restless", "--restless: is a setting of followers in hardware");
  expect_refused("--sine-period 20s",
                 "--sine-period: is that of a swing; allowed: with sine above 0");
  expect_refused(file_with("c.yaml", "restless: true\n"),
                 "c.yaml: restless: is a setting of followers");
  expect_refused(file_with("n.yaml", "name: \"a\\e[31m\"\n"),
                 "n.yaml:1: name: a control character is in it");
  expect_refused(file_with("d.yaml", "seeds: 1\n---\nload: 5\n"), "d.yaml:3: a second document");
  expect_refused("--sweep --report x.html", "excludes");
  expect_refused("--p4 --report x.html", "excludes");
  expect_refused("--report /no/such/x.html", "/no/such/x.html: cannot be opened for writing");
  expect_refused("--p4 --sweep", "excludes");
  expect_refused("/no/such.yaml", "/no/such.yaml: no such file");
  expect_refused(file_with("a.yaml", "filter: 3\n"), "a.yaml:1: filter: '3' is not allowed");
  expect_refused(file_with("b.yaml", "seeds: 1\nwonder: 1\n"), "wonder");
}

// TM-124: 1 if a goal is missed; a follower that never locks misses it too, and fails without one.
TEST_F(TimeSync, ExitCode) {
  EXPECT_EQ(run_tool("timesync").code, 0);
  const ToolResult missed = run_tool("timesync --intervals 3");
  EXPECT_EQ(missed.code, 1);
  EXPECT_THAT(missed.out, HasSubstr("no, not locked"));
  EXPECT_EQ(run_tool("timesync --filter 16 --wander 1e-7").code, 0);  // nothing is promised
  const ToolResult unlocked = run_tool("timesync --filter 16 --wander 1e-7 --intervals 2 --json");
  EXPECT_EQ(unlocked.code, 1);
  const json without_goal = json::parse(unlocked.out, nullptr, false);
  EXPECT_EQ(without_goal["goal"], nullptr);
  EXPECT_EQ(without_goal["ok"], false);
  EXPECT_EQ(run_tool("timesync --p4 --spread 100").code, 1);
  EXPECT_EQ(run_tool("timesync --sweep --intervals 3 --seeds 1").code, 1);
}

// TM-121: --how chooses, and every output says how it was run.
TEST_F(TimeSync, SaysHow) {
  const std::string few = " --intervals 8 --seeds 1 --how model";
  for (const char *what : {"", "--sweep", "--p4"}) {
    EXPECT_THAT(run_tool("timesync " + (what + few)).out, HasSubstr("how: model")) << what;
    const json one = json::parse(run_tool("timesync --json " + (what + few)).out, nullptr, false);
    EXPECT_EQ(one["how"], "model") << what;
  }
  expect_refused("--how guess", "--how: 'guess' is not allowed; allowed: model");
}

// TM-123: what was published comes out, and the same clocks with stamps in hardware and the servo.
TEST_F(TimeSync, P4) {
  const json result = run_json("--p4");
  EXPECT_EQ(result["ok"], true);
  EXPECT_EQ(result["case"]["spread_ppm"], 152.0);
  EXPECT_EQ(result["case"]["interval_s"], 1.0);
  const double us = 1e-6 * result["offset_alone"]["max_ps"].get<double>();
  EXPECT_GE(us, 152);
  EXPECT_LE(us, 160);
  const double between = 1e-6 * result["offset_alone"]["between_ps"].get<double>();
  EXPECT_GE(between, 304);
  EXPECT_LE(between, 320);
  EXPECT_LE(result["servo"]["max_ps"], 60'000);
  EXPECT_LE(result["servo"]["between_ps"], 120'000);
}

const char *const kBitErrorsOfP4 = "--bit-errors 1e-3";
const char *const kBusOfP4[] = {"--wander 1e-8", "--sine 100",      "--bitrate 250k",
                                "--load 0.5",    "--load-above 5%", kBitErrorsOfP4};

// TM-123: what the published experiment, or its model, does not have is no setting of it.
TEST_F(TimeSync, P4RefusesWhatItDoesNotHave) {
  for (const std::string option : {"--displaced 1%", "--hardware", "--master-cut"})
    for (const char *how : {"model", "skip"})
      expect_refused("--p4 " + option + " --how " + how,
                     option.substr(0, option.find(' ')) + ": is not of the published experiment");
  for (const std::string option : kBusOfP4)
    expect_refused("--p4 " + option, option.substr(0, option.find(' ')) +
                                         ": is not in the model of the published experiment; "
                                         "allowed: with how skip or rtl");
  expect_refused("--p4 " + file_with("p4.yaml", "load: 5 %\n"),
                 "p4.yaml: load: is not in the model of the published experiment");
  EXPECT_EQ(run_json("--p4 --load 0 --bitrate 500k --filter 8")["ok"], true);
}

// TM-123: seeds, and what a way has of the bus, count in the published half, too.
TEST_F(TimeSync, P4TakesSeedsAndBus) {
  const auto published = [](const std::string &options, unsigned intervals = 5) {
    const std::string few = "--p4 --seeds 1 --interval '100 ms' --intervals ";
    return run_json(few + std::to_string(intervals) + " " + options, 1)["offset_alone"];
  };
  EXPECT_NE(published(""), published("--first-seed 2"));
  const json plain = published("--how skip");
  for (const std::string option : kBusOfP4)
    if (option != kBitErrorsOfP4) {
      EXPECT_NE(plain, published("--how skip " + option)) << option;
    }
  // So few errors meet a SYNC later.
  EXPECT_NE(published("--how skip", 12),
            published(std::string{"--how skip "} + kBitErrorsOfP4, 12));
}

// TM-123: with clocks that wander there is no bound to be within, and none is made up.
TEST_F(TimeSync, P4WithoutBound) {
  const json result = run_json("--p4 --how skip --wander 1e-8 --seeds 1 --intervals 40");
  EXPECT_EQ(result["checks"][2]["expected"], "no bound: locked");
  EXPECT_EQ(result["checks"][3]["expected"], "no bound: locked");
  EXPECT_EQ(result["checks"][2]["ok"], true);
}

// TM-124: the rows of a sweep are what the specification says, whatever the base.
TEST_F(TimeSync, SweepTakesLengthAndFollowersAlone) {
  for (const std::string option : {"--frequency 50M", "--filter 4", "--hardware", "--load 0.5"})
    expect_refused("--sweep " + option, option.substr(0, option.find(' ')) +
                                            ": is set by the rows of the sweep; allowed: without");
  const json all = run_json("--sweep --followers 2 --intervals 3 --seeds 1 --first-seed 3", 1);
  const json &one = all["tables"][0]["rows"][0]["case"];
  EXPECT_EQ(one["followers"], 2);
  EXPECT_EQ(one["first_seed"], 3);
}

// TM-125: figures stand below their headings, whatever a row is called, and clocks are in MHz.
TEST_F(TimeSync, TablesOfTheSweepAreStraight) {
  std::istringstream lines(run_tool("timesync --sweep --followers 2 --intervals 3 --seeds 1").out);
  std::size_t end = 0, rows = 0;  // of the heading `mean`; below it
  bool clocks = false;
  for (std::string line; std::getline(lines, line);) {
    clocks |= line.rfind("16 MHz  ", 0) == 0;
    if (line.rfind("ns ", 0) == 0) end = line.find("mean") + 4;
    if (line.empty()) end = 0;
    if (end == 0 || line.rfind("ns ", 0) == 0) continue;
    ASSERT_GT(line.size(), end + 1) << line;
    EXPECT_EQ(line[end - 2], '.') << line;
    EXPECT_EQ(line[end], ' ') << line;
    ++rows;
  }
  EXPECT_GT(rows, 50u);
  EXPECT_TRUE(clocks);
}

}  // namespace
