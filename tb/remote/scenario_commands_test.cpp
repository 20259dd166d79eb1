// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenarios with remote nodes: commands of the host, user logic, and what is expected of both
// (RN-94, RN-96), the watch over TRIGGERs and its bound (RN-46, RN-47).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "simulation/simulation.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Seen {
  RunReport report;
  std::vector<std::string> frames;

  /// "what: seen (expected wanted)" of the checks that failed.
  [[nodiscard]] std::vector<std::string> failed() const {
    std::vector<std::string> all;
    for (const CheckResult &check : report.checks)
      if (!check.ok) all.push_back(check.what + ": " + check.seen + " (" + check.wanted + ")");
    return all;
  }
};

Seen run(const Scenario &scenario) {
  Simulation simulation{scenario, scenario.bitrates.front()};
  Seen seen;
  simulation.on_bus_frame = [&](const BusFrame &frame) {
    seen.frames.push_back(candump_frame(frame.frame));
  };
  simulation.join();
  simulation.start(simulation.bus().now());
  simulation.bus().run_for(scenario.duration);
  simulation.drain();
  seen.report = simulation.finish();
  return seen;
}

/// A host and nodes 3 and 5, which say nothing by themselves at the start.
Scenario scenario_of(const std::string &more, const std::string &config = "") {
  const std::string quiet = ", stage_bytes: 16, config: {tell_start: false" + config + "}}\n";
  return parse_scenario("remote.yaml",
                        "duration: 10 ms\nnodes:\n  - {name: host}\n"
                        "  - {name: pfc, type: remote, number: 3, serial: 0xCAFE1234" +
                            quiet + "  - {name: dab, type: remote, number: 5" + quiet + more);
}

std::vector<std::string> sent_by(const std::string &command) {
  return run(scenario_of("commands: [{node: host, do: [" + command + "]}]")).frames;
}

// The golden vectors' frames, section 3 of the specification (RN-96).
TEST(ScenarioCommands, WordsAreFrames) {
  EXPECT_THAT(sent_by("operate"), ElementsAre("000#01"));
  EXPECT_THAT(sent_by("safe 5"), ElementsAre("000#0205"));
  EXPECT_THAT(sent_by("trigger 7"), ElementsAre("001#07"));
  EXPECT_THAT(sent_by("trigger, trigger"), ElementsAre("001#01", "001#02"));
  EXPECT_THAT(sent_by("trigger 7, trigger"), ElementsAre("001#07", "001#08"));
  EXPECT_THAT(sent_by("trigger 255, trigger"), ElementsAre("001#FF", "001#00"));
  EXPECT_THAT(sent_by("frame 001#, trigger, frame 001#09, trigger"),
              ElementsAre("001#", "001#02", "001#09", "001#0A"));
  EXPECT_THAT(sent_by("write 3 0x20 5A"), ElementsAre("1A0#5A"));
  EXPECT_THAT(sent_by("write pfc 33 1 2 3 4"), ElementsAre("1A1#01020304"));
  EXPECT_THAT(sent_by("write all 0x10 1"), ElementsAre("090#01"));
  EXPECT_THAT(sent_by("write 3 0x200 AA BB CC"), ElementsAre("1F9#0002AABBCC"));
  EXPECT_THAT(sent_by("read 3 0x20 5"), ElementsAre("1A0#R5", "5A0#0000000000"));
  EXPECT_THAT(sent_by("read 3 0x200 2"), ElementsAre("1F8#000202", "5F8#00020000"));
  EXPECT_THAT(sent_by("read all 0x40 1"), ElementsAre("0C0#R1", "5C0#00", "6C0#00"));
  EXPECT_THAT(sent_by("status 3"), ElementsAre("1FE#R8", "5FE#0200000000000000"));
  EXPECT_THAT(sent_by("identity pfc"), ElementsAre("1FF#R8", "5FF#01FF3C103412FECA"));
  EXPECT_THAT(sent_by("unlock 3, lock 3"), ElementsAre("1FC#013412FECA", "1FC#02"));
  EXPECT_THAT(sent_by("clear pfc"), ElementsAre("1FC#04"));
  EXPECT_THAT(sent_by("frame 12345678#AA"), ElementsAre("12345678#AA"));
  EXPECT_THAT(sent_by("restart 3"), ElementsAre("000#8103"));
}

// RN-94, RN-49: a TRIGGER does not overtake the writes before it.
TEST(ScenarioCommands, FramesLeaveInTheOrderOfTheCommands) {
  const Seen seen = run(scenario_of(
      "commands:\n"
      "  - {node: host, at: 1 ms, do: [operate, write 3 0x10 1, 'read 3 0x10 1 = 0', trigger 9,\n"
      "     'read 3 0x10 1 = 1']}\n"
      "expect: {memory: {pfc: {0x10: 1}, dab: {0x10: 0}}, refused: 0, triggers: 1,\n"
      "  states: {pfc: OPERATE}, error_frames: 0}\n"));
  EXPECT_THAT(seen.failed(), IsEmpty());
  EXPECT_THAT(seen.frames,
              ElementsAre("000#01", "190#01", "190#R1", "590#00", "001#09", "190#R1", "590#01"));
  EXPECT_EQ(seen.report.remote.commands, 5U);
}

// Rounds have a number, and each message its response times.
TEST(ScenarioCommands, Rounds) {
  const Seen seen = run(scenario_of(
      "commands: [{node: host, at: 1 ms, period: 2 ms, count: 3,\n"
      "  do: [write all 0x20 FF round, trigger]}]\nexpect: {memory: {dab: {0x20: FF 02 00}}}\n"));
  EXPECT_THAT(seen.failed(), IsEmpty());
  EXPECT_THAT(seen.frames,
              ElementsAre("0A0#FF0000", "001#01", "0A0#FF0100", "001#02", "0A0#FF0200", "001#03"));
  ASSERT_EQ(seen.report.messages.size(), 2U);
  const MessageReport &write = seen.report.messages[0];
  EXPECT_EQ(write.name, "write all 0x20 FF round");
  EXPECT_EQ(write.queued, 3U);
  EXPECT_EQ(write.sent, 3U);
  // 3 bytes at 500 kbit/s: 71 to 85 bits, and what the host's software needs before it.
  EXPECT_GE(write.shortest, 140 * kMicrosecond);
  EXPECT_LE(write.longest, 200 * kMicrosecond);
  EXPECT_GT(seen.report.messages[1].shortest, write.longest);
}

TEST(ScenarioCommands, WrongAndMissingAnswersFail) {
  EXPECT_THAT(run(scenario_of("commands: [{node: host, do: ['read 3 0x20 2 = 0 1']}]")).failed(),
              ElementsAre(::testing::StartsWith("host: read 3 0x20 2 = 0 1: 00 00 at ")));
  Scenario scenario = scenario_of("commands: [{node: host, do: [read 7 0x20 2, trigger 3]}]");
  EXPECT_THAT(run(scenario).failed(), ElementsAre("host: read 7 0x20 2: not until the end (done)"));
  scenario.duration = 460 * kMillisecond;
  const Seen seen = run(scenario);
  EXPECT_THAT(seen.failed(),
              ElementsAre(::testing::StartsWith("host: read 7 0x20 2: none in three tries at ")));
  EXPECT_THAT(seen.frames, ElementsAre("3A0#R2", "3A0#R2", "3A0#R2", "001#03"));
}

TEST(ScenarioCommands, UserLogicWrites) {
  const Seen seen = run(scenario_of(
      "user:\n"
      "  - {node: pfc, at: 1 ms, write: {0x40: 01 02, 0x203: 05 06 07}}\n"
      "  - {node: pfc, period: 1 ms, count: 4, ramp: 0x50, from: 0xFFFE, step: 3}\n"
      "  - {node: dab, after: apply, delay: 10 us, count: 2, write: {0x60: AA}, event: 1}\n"
      "commands: [{node: host, do: [operate]},\n"
      "  {node: host, at: 2 ms, period: 2 ms, count: 3, do: [trigger]}]\n"
      "expect: {memory: {pfc: {0x40: 01 02, 0x203: 05 06 07, 0x50: 07 00}, dab: {0x60: AA}}}\n",
      ", producers: [{send: 0, length: 1}, {send: 0x60, length: 1}]"));
  EXPECT_THAT(seen.failed(), IsEmpty());
  EXPECT_THAT(seen.frames, ElementsAre("000#01", "001#01", "6E0#AA", "001#02", "6E0#AA", "001#03"));
}

constexpr const char *kCycles =
    "commands: [{node: host, do: [operate]},\n"
    "  {node: host, at: 1 ms, period: 1 ms, count: 8,\n"
    "   do: [write all 0x10 round round, trigger]}]\n";
constexpr const char *kPlants =
    "user:\n"
    "  - {node: pfc, after: apply, plant: {set_point: 0x10, measured: 0x40}, event: 0}\n"
    "  - {node: dab, after: apply, plant: {set_point: 0x12, measured: 0x44}, event: 0}\n";

// A first-order plant by hand: 800 = 0x320: 200, 350, 462 ...; 40000 - current / 8.
TEST(ScenarioCommands, Plants) {
  const Seen seen = run(scenario_of(
      std::string("commands: [{node: host, do: [operate, write all 0x10 20 3 40 6]},\n"
                  "  {node: host, at: 1 ms, period: 1 ms, count: 3, do: [trigger]}]\n") +
          kPlants +
          "expect: {memory: {pfc: {0x40: CE 01 07 9C}}, late_statements: 0, lost_set_points: 0}\n",
      ", producers: [{send: 0x40, length: 4}]"));
  EXPECT_THAT(seen.report.remote.nodes[0].statements, 3U);
  // Node dab tells another place than its plant's.
  EXPECT_THAT(seen.failed(), ElementsAre("late_statements: 2 (0)"));
  EXPECT_THAT(seen.frames, ::testing::Contains("5C0#C800279C"));
}

// RN-46 to RN-48: what is lost is counted, whoever is at fault.
TEST(ScenarioCommands, EachCycleIsHeldAgainstTheBus) {
  const std::string all = std::string(kCycles) + kPlants;
  const std::string good = all +
                           "expect: {triggers: 8, lost_set_points: 0, late_statements: 0,\n"
                           "  trigger_skew: bound, refused: 0}\n";
  const std::string producers = ", producers: [{send: 0x40, length: 8}]";
  Seen seen = run(
      scenario_of(good + "faults: [{kind: cut, node: dab, from: 2.5 ms, for: 3 ms}]\n", producers));
  EXPECT_EQ(seen.report.remote.nodes[0].applied, 8U);
  EXPECT_EQ(seen.report.remote.nodes[0].lost_set_points, 0U);
  EXPECT_EQ(seen.report.remote.nodes[1].applied, 5U);
  EXPECT_EQ(seen.report.remote.nodes[1].lost_set_points, 3U);
  EXPECT_EQ(seen.report.remote.compared, 5U);
  seen = run(scenario_of(all + "expect: {lost_set_points: 0}\n"
                               "faults: [{kind: cut, node: dab, from: 0, for: 300 us}]\n",
                         producers));
  EXPECT_THAT(seen.failed(), ElementsAre("dab: user after apply: not until the end (done)",
                                         "lost_set_points: 8 (0)"));
}

// RN-46: a node that misses one write, but not the TRIGGER behind it, shows an old set point.
TEST(ScenarioCommands, AnOldSetPointIsALostOne) {
  const std::string commands =
      "commands: [{node: host, at: 100 us, do: [operate]},\n"
      "  {node: host, at: 1 ms, period: 1 s, do: [write all 0x10 11, trigger]},\n"
      "  {node: host, at: 4 ms, period: 1 s, do: [write all 0x10 12, trigger]}]\n";
  const Time write = run(scenario_of(commands)).report.messages.at(2).longest;
  const Time in_eof = 4 * kMillisecond + write - 6 * kMicrosecond;
  const Seen seen =
      run(scenario_of(commands + "faults: [{kind: cut, node: dab, from: 3.95 ms, to: " +
                      std::to_string(in_eof) + " ps}]\nexpect: {triggers: 2, error_frames: 0}\n"));
  EXPECT_THAT(seen.failed(), IsEmpty());
  EXPECT_EQ(seen.report.remote.nodes[0].lost_set_points, 0U);
  EXPECT_EQ(seen.report.remote.nodes[1].applied, 2U);
  EXPECT_EQ(seen.report.remote.nodes[1].lost_set_points, 1U);
}

// A fault sets the error of a clock, beside which the clock goes on to wander.
TEST(ScenarioCommands, SkewBoundCountsWanderBesideAFault) {
  const auto bound = [](const std::string &dab, const std::string &faults) {
    return run(parse_scenario(
                   "remote.yaml",
                   "bitrate: 1M\nsample_point: 75 %\nduration: 10 ms\nnodes:\n"
                   "  - {name: host, clock: 12 MHz}\n"
                   "  - {name: pfc, type: remote, number: 3, stage_bytes: 16, clock: 12 MHz}\n"
                   "  - {name: dab, type: remote, number: 5, stage_bytes: 16, clock: 12 MHz, " +
                       dab + "}\n" + kCycles + "expect: {trigger_skew: bound}\n" + faults))
        .report.remote.skew_bound;
  };
  EXPECT_EQ(
      bound("wander: {kind: sine, ppm: 200}", "faults: [{kind: clock, node: dab, ppm: 200}]\n"),
      bound("ppm: 400", ""));
}

TEST(ScenarioCommands, Skew) {
  const auto with = [](const std::string &dab, const std::string &expect) {
    return run(parse_scenario(
        "remote.yaml",
        "bitrate: 1M\nsample_point: 75 %\nduration: 10 ms\nnodes:\n"
        "  - {name: host, clock: 12 MHz}\n"
        "  - {name: pfc, type: remote, number: 3, stage_bytes: 16, clock: 12 MHz, ppm: 100}\n"
        "  - {name: dab, type: remote, number: 5, stage_bytes: 16, clock: 12 MHz" +
            dab + "}\n" + kCycles + "expect: {trigger_skew: " + expect + "}\n"));
  };
  // RN-47's example: 20 m, 100 ppm.
  const Seen far = with(", ppm: -100, cable: 20 m", "bound");
  EXPECT_THAT(far.failed(), IsEmpty());
  EXPECT_NEAR(static_cast<double>(far.report.remote.skew_bound) / kNanosecond, 437, 1);
  EXPECT_EQ(far.report.remote.compared, 8U);
  // At least what the cable alone does, less a clock.
  EXPECT_GT(far.report.remote.skew_longest, 0);
  EXPECT_GE(far.report.remote.skew_longest, far.report.remote.skew_mean);
  EXPECT_THAT(with(", ppm: -100, cable: 20 m", "1 ps").failed(),
              ElementsAre(::testing::StartsWith("trigger_skew: ")));
  EXPECT_NEAR(static_cast<double>(far.report.remote.period_longest) / kMicrosecond, 1000, 40);
}

// The same on the RTL, by its user port: TRIGGER 9 shows what was staged, at the same time in both.
TEST(ScenarioCommands, OnTheRtl) {
  const std::string rtl = ", type: remote, profile: small, made_of: rtl, config: {watchdog: 5 ms}";
  const Seen seen = run(parse_scenario(
      "remote.yaml",
      "duration: 20 ms\nnodes:\n  - {name: host}\n"
      "  - {name: pfc, number: 3" +
          rtl + "}\n  - {name: dab, number: 5, ppm: 100" + rtl +
          "}\n"
          "user:\n  - {node: dab, after: apply, plant: {set_point: 0x12, measured: 0x44}}\n"
          "  - {node: pfc, at: 1 ms, write: {0x60: AA BB}}\n"
          "commands: [{node: host, do: [operate]},\n"
          "  {node: host, at: 1 ms, period: 1 ms, count: 8,\n"
          "   do: [write all 0x10 round 20 3, trigger, read dab 0x44 4]},\n"
          "  {node: host, at: 10 ms, do: ['read pfc 0x60 2 = AA BB', write pfc 0xE00 1]}]\n"
          "expect: {triggers: 8, lost_set_points: 0, trigger_skew: bound, refused: 1,\n"
          "  memory: {pfc: {0x10: 7 0 20 3}}, states: {pfc: SAFE, dab: SAFE}}\n"));
  EXPECT_THAT(seen.failed(), IsEmpty());
  EXPECT_TRUE(seen.report.remote.nodes[0].rtl);
  EXPECT_EQ(seen.report.remote.compared, 8U);
  EXPECT_EQ(seen.report.remote.nodes[1].went_safe, 1U);
  EXPECT_THAT(seen.frames, ::testing::Contains("5C4#C800279C").Times(0));
  EXPECT_THAT(seen.frames, ::testing::Contains("6C4#C800279C"));
}

TEST(ScenarioCommands, WhatIsNotMetIsTold) {
  const std::string commands = "commands: [{node: host, do: [write 3 0xE00 1, trigger 1]}]\n";
  EXPECT_THAT(run(scenario_of(commands + "expect: {refused: 0}\n")).failed(),
              ElementsAre("refused: 1 (0)"));
  EXPECT_THAT(run(scenario_of(commands + "expect: {triggers: 2}\n")).failed(),
              ElementsAre("triggers: 1 (2)"));
  EXPECT_THAT(run(scenario_of(commands + "expect: {memory: {pfc: {0x20: 1 2}}}\n")).failed(),
              ElementsAre("pfc 0x020: 00 00 (01 02)"));
  EXPECT_THAT(run(scenario_of(commands + "expect: {states: {pfc: OPERATE}}\n")).failed(),
              ElementsAre("pfc.state: SAFE (OPERATE)"));
  EXPECT_THAT(run(scenario_of(commands + "expect: {trigger_skew: bound}\n")).failed(),
              ElementsAre(HasSubstr("no two nodes that act")));
}

// Where no node had to act, and none to tell anything, none has been found to do so.
TEST(ScenarioCommands, WhatNothingHasShownFails) {
  const std::string silent = "expect: {lost_set_points: 0, late_statements: 0}\n";
  const std::string trigger = "commands: [{node: host, do: [trigger]}]\n";
  for (const std::string &commands : {std::string{}, trigger})
    EXPECT_THAT(run(scenario_of(commands + silent)).failed(),
                ElementsAre("late_statements: no measurement that was due (0)",
                            "lost_set_points: no TRIGGER to a node in OPERATE (0)"));
  for (const std::string expectation : {"triggers: 0", "refused: 0", "lost_set_points: 0",
                                        "late_statements: 0", "trigger_skew: bound"})
    EXPECT_THAT(input_error_of([&] {
                  return parse_scenario("r.yaml",
                                        "nodes: [{name: a}]\nexpect: {" + expectation + "}\n");
                }),
                HasSubstr("there is no remote node; allowed: with a node of 'type: remote'"));
}

// The watchdog of a node whose host is gone: SAFE, and when.
TEST(ScenarioCommands, LeavingOperateIsTold) {
  const Seen seen =
      run(scenario_of("commands: [{node: host, do: [operate]}]\n", ", watchdog: 5 ms"));
  EXPECT_EQ(seen.report.remote.nodes[0].state, "SAFE");
  EXPECT_EQ(seen.report.remote.nodes[0].went_safe, 1U);
  EXPECT_THAT(to_text(seen.report), HasSubstr("left OPERATE 1x"));
}

// RN-13: there is one host.
TEST(ScenarioCommands, TwoHostsAreWarnedOf) {
  const auto text = [](const std::string &second) {
    return to_text(run(parse_scenario("remote.yaml", R"(duration: 4 ms
nodes: [{name: a}, {name: b}, {name: pfc, type: remote, number: 6}]
commands: [{node: a, do: [operate]}, {node: a, at: 1 ms, do: [trigger]}, {node: )" +
                                                         second + R"(, at: 2 ms, do: [trigger]}]
)"))
                       .report);
  };
  EXPECT_THAT(text("b"), HasSubstr("warning: a, b have 'commands'"));
  EXPECT_THAT(text("a"), Not(HasSubstr("warning")));
}

// Traffic and delay of a cycle: that of frames whose bits are known, on an idle bus.
TEST(ScenarioCommands, WhatACycleCosts) {
  const Seen seen = run(scenario_of(std::string(kCycles)));
  const RemoteReport &remote = seen.report.remote;
  // write all 0x10 of 4 bytes, TRIGGER of one: 95 and 65 bits of 2 us at most, 79 and 55 at least.
  EXPECT_GE(remote.traffic_shortest, 134 * 2 * kMicrosecond);
  EXPECT_LE(remote.traffic_longest, 160 * 2 * kMicrosecond);
  EXPECT_NEAR(remote.cycle_load, static_cast<double>(remote.traffic_mean) / kMillisecond, 0.01);
  // TRIGGER is queued behind the write; it acts two bits behind its end.
  EXPECT_GE(remote.latency_shortest, 55 * 2 * kMicrosecond);
  EXPECT_LE(remote.latency_longest, 75 * 2 * kMicrosecond);
}

TEST(ScenarioCommands, MistakesAreToldWithTheirPlace) {
  const auto message = [](const std::string &more) {
    return input_error_of([&] { return scenario_of(more); });
  };
  const auto command = [&](const std::string &words) {
    return message("commands: [{node: host, do: ['" + words + "']}]");
  };
  EXPECT_THAT(command("jump"), HasSubstr("remote.yaml:6: commands[0].do[0]: 'jump'"));
  EXPECT_THAT(command(""), HasSubstr("operate|safe|restart"));
  EXPECT_THAT(command("write 8 0 1"), HasSubstr("'8' is not allowed; allowed: the name of a"));
  EXPECT_THAT(command("write host 0 1"), HasSubstr("'host' is not allowed"));
  EXPECT_THAT(command("write 3 0x1000 1"), HasSubstr("an address, 0x0 to 0xFFF"));
  EXPECT_THAT(command("write 3 0x20 123"), HasSubstr("hexadecimal bytes"));
  EXPECT_THAT(command("write 3 0x20"), HasSubstr("allowed: bytes"));
  EXPECT_THAT(command("write 3 0x20 1 2 3 4 5 6 7 8 9"), HasSubstr("8 bytes at most"));
  EXPECT_THAT(command("write 3 0x200 1 2 3 4 5 round"), HasSubstr("6 bytes at most"));
  EXPECT_THAT(command("write 3 0x77 1 2"), HasSubstr("bytes up to 0x77"));
  EXPECT_THAT(command("read 3 0x74 5"), HasSubstr("bytes of one frame, 0x1 to 0x4"));
  EXPECT_THAT(command("read 3 0x20 2 = 1"),
              HasSubstr("'1' is not allowed; allowed: 2 bytes behind ="));
  EXPECT_THAT(command("read 3 0x20 2 = 1 2 3"),
              HasSubstr("'3' is not allowed; allowed: 2 bytes behind ="));
  EXPECT_THAT(command("read 3 0x20 2 = round"),
              EndsWith("'round' is not allowed; allowed: hexadecimal bytes"));
  EXPECT_THAT(command("read 3 0x20 1 1"), HasSubstr("allowed: ="));
  EXPECT_THAT(command("read all 0x20 1 = 1"), HasSubstr("the end of the command"));
  EXPECT_THAT(command("trigger 256"), HasSubstr("a count, 0x0 to 0xFF"));
  EXPECT_THAT(command("operate 3 4"), HasSubstr("the end of the command"));
  for (const char *frame : {"1A0", "800#5A", "1A0#5", "1A0##5"})
    EXPECT_THAT(command("frame " + std::string{frame}),
                AllOf(HasSubstr("remote.yaml:6: commands[0].do[0]: 'frame "),
                      HasSubstr("' is not allowed; allowed: a classical frame as cansend has it")));
  EXPECT_THAT(command("unlock 4"), HasSubstr("'4' is not allowed; allowed: a node of this"));
  EXPECT_THAT(message("commands: [{node: pfc, do: [trigger]}]"), HasSubstr("'pfc'"));
  EXPECT_THAT(message("commands: [{node: host, do: []}]"), HasSubstr("operate|safe"));
  EXPECT_THAT(input_error_of([] {
                return parse_scenario("r.yaml",
                                      "nodes: [{name: a}]\ncommands: [{node: a, do: [operate]}]");
              }),
              HasSubstr("no remote node is there"));
  EXPECT_THAT(message("user: [{node: host, at: 1 ms, write: {0: 1}}]"), HasSubstr("no remote"));
  EXPECT_THAT(message("user: [{node: pfc, at: 1 ms}]"), HasSubstr("nothing to do"));
  EXPECT_THAT(message("user: [{node: pfc, after: read, event: 0}]"), HasSubstr("apply"));
  EXPECT_THAT(message("user: [{node: pfc, event: 8}]"), HasSubstr("user[0].event"));
  EXPECT_THAT(message("user: [{node: pfc, event: 1}]"), HasSubstr("producer 1 is off"));
  EXPECT_THAT(message("user: [{node: pfc, write: {0xE00: 1}}]"), HasSubstr("0 to 0xDFF"));
  EXPECT_THAT(message("user: [{node: pfc, plant: {set_point: 0, measured: 2}}]"),
              HasSubstr("a multiple of 4"));
  EXPECT_THAT(message("expect: {memory: {host: {0: 1}}}"), HasSubstr("'host' is no remote node"));
  EXPECT_THAT(message("expect: {states: {pfc: ON}}"), HasSubstr("INIT, LISTEN, SAFE, OPERATE"));
  EXPECT_THAT(message("expect: {trigger_skew: much}"), HasSubstr("trigger_skew"));
}

}  // namespace
}  // namespace vericansim
