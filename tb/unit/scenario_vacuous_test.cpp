// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: what would ask for nothing, or be passed over, is refused with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/input_error_of.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// Three nodes in line 1, of which `p` is a remote one; what follows begins in line 2.
std::string refusal(const std::string &text) {
  return input_error_of([&] {
    return parse_scenario("s.yaml",
                          "nodes: [{name: a}, {name: b}, {name: p, type: remote, number: 2, "
                          "memory_bytes: 1024}]\n" +
                              text);
  });
}

struct Vacuous {
  const char *name;
  const char *text;
  const char *message;
};

class VacuousScenario : public ::testing::TestWithParam<Vacuous> {};

TEST_P(VacuousScenario, IsRefused) {
  EXPECT_THAT(refusal(GetParam().text), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, VacuousScenario,
    ::testing::Values(
        Vacuous{"Range", "expect:\n  frames: {}\n",
                "s.yaml:3: expect.frames: nothing is in it; allowed: max, min"},
        Vacuous{"RangeOfANode", "expect: {nodes: {all: {tec: {}}}}",
                "s.yaml:2: expect.nodes.all.tec: nothing is in it; allowed: max, min"},
        Vacuous{"AllCounts", "expect: {frames: {min: 0}}",
                "s.yaml:2: expect.frames: is always met; allowed: a min or max that can be missed"},
        Vacuous{"AllLoads", "expect: {load: {max: 100}}", "expect.load: is always met"},
        Vacuous{"AllCountersOfANode", "expect: {nodes: {a: {tec: {max: 256}}}}",
                "expect.nodes.a.tec: is always met"},
        Vacuous{"AllRefusals", "expect: {refused: {min: 0}}", "expect.refused: is always met"},
        Vacuous{"CountBelowNothing", "expect: {error_frames: {min: -1}}",
                "'-1' is not allowed; allowed: a number from 0 to 1e+15"},
        Vacuous{"HitsBelowNothing", "faults: [{kind: short, node: a, hits: {min: -5}}]",
                "'-5' is not allowed; allowed: a number from 0"},
        Vacuous{"LoadAboveAll", "expect: {load: {max: 1000}}", "a number from 0 to 100"},
        Vacuous{"TecAboveAll", "expect: {nodes: {a: {max_tec: {max: 300}}}}", "from 0 to 256"},
        Vacuous{"RecAboveAll", "expect: {nodes: {all: {rec: 256}}}", "from 0 to 255"},
        Vacuous{"NamelessDatabase", "dbc: ''",
                "s.yaml:2: dbc: '' is not allowed; allowed: the name of a file"},
        Vacuous{"LengthOfNoGlitches", "faults: [{kind: noise, per_bit: 0.1, glitch: 1 us}]",
                "faults[0].glitch: is the length of glitches, and there are none; allowed: with "
                "'glitches_per_ms'"},
        Vacuous{"OverrunsOfARemoteNode", "expect: {nodes: {p: {overruns: 0}}}",
                "unknown key 'overruns'"},
        Vacuous{"Hits", "faults: [{kind: short, node: a, hits: {}}]",
                "faults[0].hits: nothing is in it; allowed: max, min"},
        Vacuous{"Node", "expect: {nodes: {a: {}}}",
                "expect.nodes.a: nothing is in it; allowed: bus_off, "},
        Vacuous{"Nodes", "expect: {nodes: {}}",
                "expect.nodes: nothing is in it; allowed: a, all, b, p"},
        Vacuous{"ResponseTimes", "traffic: [{node: a, id: 1}]\nexpect: {response_times: {}}",
                "s.yaml:3: expect.response_times: nothing is in it; allowed: 001"},
        Vacuous{"Memory", "expect: {memory: {}}",
                "expect.memory: nothing is in it; allowed: names of remote nodes"},
        Vacuous{"MemoryOfANode", "expect: {memory: {p: {}}}",
                "expect.memory.p: nothing is in it; allowed: addresses with their bytes"},
        Vacuous{"States", "expect: {states: {}}",
                "expect.states: nothing is in it; allowed: names of remote nodes"},
        Vacuous{"Signals", "expect: {signals: {}}",
                "expect.signals: nothing is in it; allowed: signals, as message.signal"},
        Vacuous{"Incomplete", "expect: {complete: false}",
                "s.yaml:2: expect.complete: 'false' is not allowed; allowed: true; leave it out "
                "where it is not asked for"},
        Vacuous{"AboveTheBound", "expect: {within_bound: no}",
                "expect.within_bound: 'no' is not allowed; allowed: true; leave it out"},
        Vacuous{"MaskOfNothing", "accesses: [{node: a, do: [check MCR 0 0]}]",
                "MASK 0 looks at no bit; allowed: 0x1 to 0xFFFFFFFF"},
        Vacuous{"EndlessMask", "accesses: [{node: a, do: [until MCR 0x0 0]}]", "MASK 0 looks at"},
        Vacuous{"BranchOnNothing", "accesses: [{node: a, do: [if MCR 0 0]}]", "MASK 0 looks at"},
        Vacuous{"MemoryThatIsNotThere", "expect: {memory: {p: {0x900: 00}}}",
                "memory.p.0x900: '0x900' is no address of node 'p'; allowed: 0x0 to 0x1FF, 0xF00 "
                "to 0xFFF"},
        Vacuous{"MemoryBehindItsEnd", "expect: {memory: {p: {0x1FF: 00 00}}}",
                "memory.p.0x1FF: '00 00' is not allowed; allowed: 1 to 1 bytes"},
        Vacuous{"CountOfOne", "traffic: [{node: a, id: 1, count: 7}]",
                "s.yaml:2: traffic[0].count: '7' is not allowed; allowed: 1, or more with a "
                "'period'"},
        Vacuous{"CommandsOfOne", "commands: [{node: a, count: 7, do: operate}]",
                "commands[0].count: '7' is not allowed; allowed: 1, or more with a 'period'"},
        Vacuous{
            "UserOfOne", "user: [{node: p, count: 7, ramp: 0x50}]",
            "user[0].count: '7' is not allowed; allowed: 1, or more with a 'period' or 'after'"}),
    [](const auto &item) { return std::string(item.param.name); });

// `all` is a word of faults and expectations.
TEST(ScenarioNames, NoNodeIsCalledAll) {
  EXPECT_EQ(input_error_of([] {
              return parse_scenario("s.yaml", "nodes:\n  - {name: a}\n  - {name: all}\n");
            }),
            "s.yaml:3: nodes[1].name: 'all' is not allowed; allowed: other names; 'all' stands for "
            "every node");
}

// Overruns are known of nodes that the simulation's own software works.
TEST(VacuousScenario, OverrunsOfAllAreRefusedWhereNobodyCountsThem) {
  const auto overruns_of_all = [](const std::string &node) {
    return input_error_of([&] {
      return parse_scenario("s.yaml", "nodes: [{name: p, type: remote, number: 2}" + node +
                                          "]\nexpect: {nodes: {all: {overruns: 0}}}\n");
    });
  };
  EXPECT_THAT(overruns_of_all(""),
              HasSubstr("s.yaml:2: expect.nodes.all: unknown key 'overruns'; allowed: bus_off, "));
  EXPECT_EQ(overruns_of_all(", {name: a}"), "no error");
}

// An empty list would be taken for none, which takes any frame.
TEST(VacuousScenario, EmptyFiltersAreRefused) {
  const auto with = [](const std::string &keys) {
    return input_error_of(
        [&] { return parse_scenario("s.yaml", "nodes:\n  - {name: a, " + keys + "}\n"); });
  };
  EXPECT_EQ(with("filters: []"),
            "s.yaml:2: nodes[0].filters: nothing is in it; allowed: one at least, or no 'filters' "
            "for any frame");
  EXPECT_EQ(with("replay: a.log, filter: []"),
            "s.yaml:2: nodes[0].filter: nothing is in it; allowed: one at least, or no 'filter' "
            "for any frame");
}

TEST(VacuousScenario, WhatAsksForSomethingIsTaken) {
  for (const char *const text :
       {"expect: {}", "expect: {frames: {max: 0}, load: {min: 0, max: 99}}",
        "expect: {nodes: {all: {overruns: 0}, a: {tec: 256, max_rec: {max: 254}}}}",
        "accesses: [{node: a, do: [read MB63.CS, read RXIMR63]}]",
        "faults: [{kind: short, node: a, hits: {min: 0}}]", "traffic: [{node: a, id: 1, count: 1}]",
        "traffic: [{node: a, id: 1, period: saturated, count: 7}]",
        "commands: [{node: a, count: 7, period: 1 ms, do: operate}]",
        "user: [{node: p, count: 7, after: apply, ramp: 0x50}]",
        "accesses: [{node: a, do: [check MCR 0x1 0]}]",
        "expect: {memory: {p: {0x1FF: 00, 0xFFF: 00}}}"})
    EXPECT_EQ(refusal(text), "no error") << text;
}

// Nobody counts the overruns of a core without software, and there is no buffer behind the last.
TEST(VacuousScenario, WhatANodeDoesNotHaveIsRefused) {
  const auto bare = [](const std::string &more) {
    return input_error_of([&] {
      return parse_scenario("s.yaml",
                            "nodes: [{name: n, mailboxes: 16, software: none}]\n" + more + "\n");
    });
  };
  EXPECT_THAT(bare("expect: {nodes: {n: {overruns: 0}}}"), HasSubstr("unknown key 'overruns'"));
  for (const std::string name : {"MB16.CS", "MB40.DATA1", "RXIMR16"})
    EXPECT_THAT(bare("accesses: [{node: n, do: [read " + name + "]}]"),
                HasSubstr("'" + name +
                          "' is no register; allowed: the names of docs/registers.md, MB0.CS to "
                          "MB15.DATA1, RXIMR0 to RXIMR15, "));
  EXPECT_EQ(bare("accesses: [{node: n, do: [read MB15.DATA1, read RXIMR15, read 0x300]}]"),
            "no error");
}

// The buffers of a node whose frames are those of programs are its software's alone.
TEST(VacuousScenario, WritesOfBuffersBesideProgramsAreRefused) {
  const auto with = [](const std::string &role, const std::string &step) {
    return input_error_of([&] {
      return parse_scenario("s.yaml", "nodes:\n  - {name: n" + role +
                                          "}\naccesses:\n  - {node: n, do: " + step + "}\n");
    });
  };
  const std::string refusal =
      "s.yaml:4: accesses[0].do: writes buffers of 'n', which programs of the host work; allowed: "
      "to read, and to write other registers than buffers, IFLAG and IMASK";
  for (const std::string step :
       {"write MB5.CS 0x0C010000", "set MB63.DATA1 1", "clear MB0.ID 1", "write IFLAG1 1",
        "write IFLAG2 1", "set IMASK1 1", "clear IMASK2 1", "[read MCR, write 0x80 0]"}) {
    for (const std::string role : {", interface: vcan0", ", socketcand: 29536"})
      EXPECT_EQ(with(role, step), refusal);
    EXPECT_EQ(with("", step), "no error");
  }
  for (const std::string step : {"read MB5.CS", "check IFLAG1 1 0", "set MCR 0x10000000",
                                 "write RXIMR0 0", "write 0x7C 0", "write 0x480 0"})
    EXPECT_EQ(with(", interface: vcan0", step), "no error") << step;
}

// Keys of a node that another key makes void.
TEST(VacuousScenario, KeysOfANodeThatNobodyObeysAreRefused) {
  const auto node = [](const std::string &keys) {
    return input_error_of([&] {
      return parse_scenario("s.yaml",
                            "nodes:\n  - {name: f, firmware: f.elf}\n  - {name: n" + keys + "}\n");
    });
  };
  for (const std::string key : {"tx_buffers: 2", "filters: [{id: 1}]", "listen_only: true",
                                "loop_back: true", "bus_off_recovery: never", "monitor: true"})
    EXPECT_THAT(node(", software: none, " + key),
                HasSubstr("s.yaml:3: nodes[1]: unknown key '" + key.substr(0, key.find(':'))));
  EXPECT_EQ(node(", software: none, sjw: 1, mailboxes: 16"), "no error");
  EXPECT_EQ(node(", monitor: true, listen_only: false"),
            "s.yaml:3: nodes[1].monitor: 'listen_only' is given too; allowed: one of them");
  EXPECT_EQ(node(", monitor: true"), "no error");
  for (const std::string key : {"clock: 16 MHz", "ppm: 5", "phase: 1 ns"})
    EXPECT_EQ(node(", second_core_of: f, " + key),
              "s.yaml:3: nodes[1]." + key.substr(0, key.find(':')) +
                  ": is that of the board; allowed: there alone");
  EXPECT_EQ(node(", second_core_of: f, cable: 1 m"), "no error");
  EXPECT_THAT(node(", replay: a.log, channel: ''"),
              HasSubstr("s.yaml:3: nodes[1].channel: '' is not allowed; allowed: the name of an "
                        "interface"));
}

// What firmware prints: a list that is empty asks for nothing.
TEST(VacuousFirmware, IsRefused) {
  const auto of_firmware = [](const std::string &expectation) {
    return input_error_of([&] {
      return parse_scenario("s.yaml",
                            "nodes: [{name: a}, {name: f, firmware: f.elf}]\n"
                            "expect: {nodes: {f: {" +
                                expectation + "}}}\n");
    });
  };
  EXPECT_THAT(of_firmware("output: []"),
              HasSubstr("s.yaml:2: expect.nodes.f.output: nothing is in it; allowed: a text"));
  EXPECT_THAT(of_firmware("matches: []"),
              HasSubstr("expect.nodes.f.matches: nothing is in it; allowed: a regular"));
  EXPECT_EQ(of_firmware("output: [hello], matches: 'h.*'"), "no error");
}

}  // namespace
}  // namespace vericansim
