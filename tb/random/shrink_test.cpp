// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Shrinking finds what matters; what scenario files say of accesses, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/input_error_of.hpp"
#include "random/random_scenario.hpp"
#include "random/shrink.hpp"
#include "scenario/register_name.hpp"
#include "session/runner.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

// A random bus with one access that must fail: nothing else is left of it.
TEST(Shrink, LeavesWhatMatters) {
  Scenario scenario = random_scenario(16, 60);
  scenario.accesses.push_back(
      {0,
       scenario.duration / 2,
       {{AccessStep::Kind::kRead, 0x20}, {AccessStep::Kind::kCheck, 0x000, 0x2000000, 0x2000000}}});
  const JudgedRun run = run_judged(scenario);
  ASSERT_FALSE(run.ok());
  const Shrunk shrunk = shrink(scenario, run);
  EXPECT_FALSE(shrunk.run.ok());
  EXPECT_EQ(shrunk.scenario.nodes.size(), 1u);
  EXPECT_TRUE(shrunk.scenario.traffic.empty());
  EXPECT_TRUE(shrunk.scenario.faults.empty());
  ASSERT_EQ(shrunk.scenario.accesses.size(), 1u);
  EXPECT_EQ(shrunk.scenario.accesses[0].steps.size(), 1u);
  const std::string text = to_yaml(shrunk.scenario);
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 12);
  EXPECT_FALSE(run_scenario(parse_scenario("shrunk", text), 1e6).ok());
}

constexpr const char *kHead = "nodes: [{name: a}, {name: b, software: none}]\n";

Scenario read(const std::string &text) { return parse_scenario("s.yaml", kHead + text); }

std::string refusal(const std::string &text) {
  return input_error_of([&] { return read(text); });
}

TEST(ScenarioAccesses, AreRead) {
  const Scenario scenario = read(
      "judge: lockstep\n"
      "accesses:\n"
      "  - {node: b, at: 2 us, do: [write MB5.CS 0x8000000, until MCR 0x100000 0, read 0x20]}\n"
      "  - {node: a, do: set CTRL1 64}\n");
  EXPECT_TRUE(scenario.lockstep);
  EXPECT_FALSE(scenario.nodes[1].software);
  ASSERT_EQ(scenario.accesses.size(), 2u);
  const AccessSpec &first = scenario.accesses[0];
  EXPECT_EQ(first.node, 1u);
  EXPECT_EQ(first.at, 2 * kMicrosecond);
  const std::vector<AccessStep> expected = {{AccessStep::Kind::kWrite, 0x0D0, 0x8000000},
                                            {AccessStep::Kind::kUntil, 0x000, 0, 0x100000},
                                            {AccessStep::Kind::kRead, 0x020}};
  EXPECT_EQ(first.steps, expected);
  EXPECT_EQ(scenario.accesses[1].steps[0].kind, AccessStep::Kind::kSet);
}

TEST(ScenarioAccesses, AreRefusedWithWhatIsAllowed) {
  EXPECT_THAT(refusal("accesses: [{node: a, do: [poke MCR 1]}]"), HasSubstr("read REG"));
  EXPECT_THAT(refusal("accesses: [{node: a, do: [write MCR]}]"), HasSubstr("write REG VALUE"));
  EXPECT_THAT(refusal("accesses: [{node: a, do: [read MB64.CS]}]"), HasSubstr("no register"));
  EXPECT_THAT(refusal("accesses: [{node: a, do: [read 0x2]}]"), HasSubstr("multiple of 4"));
  EXPECT_THAT(refusal("accesses: [{node: a, do: [write MCR 0x100000000]}]"),
              HasSubstr("0 to 0xFFFFFFFF"));
  EXPECT_THAT(refusal("accesses: [{node: c, do: [read MCR]}]"), HasSubstr("name of a node"));
  EXPECT_THAT(refusal("accesses: [{node: a}]"), HasSubstr("'do' is missing"));
  EXPECT_THAT(refusal("judge: all"), HasSubstr("lockstep, none"));
  EXPECT_THAT(refusal("traffic: [{node: b, id: 1}]"), HasSubstr("software: none"));
}

TEST(ScenarioAccesses, EveryAddressHasANameThatLeadsBack) {
  for (std::uint32_t address = 0; address < 0x2000; address += 4)
    EXPECT_EQ(register_address(register_name(address)), address);
  EXPECT_EQ(register_address("FILTER1"), 0x0E4u);
  EXPECT_EQ(register_name(0x88C), "RXIMR3");
  // Behind the last buffer there are addresses alone.
  EXPECT_EQ(register_name(0x300, 16), "0x300");
  EXPECT_EQ(register_address("0x300", 16), 0x300u);
}

// A script drives a node without software; `check` and `until` decide.
TEST(ScenarioAccesses, DecideOverTheRun) {
  const std::string text =
      "accesses:\n"
      "  - {node: b, do: [write MCR 0x5000000F, until MCR 0x1000000 0x1000000, check MCR 0x100000 ";
  EXPECT_TRUE(run_scenario(read(text + "0]}\n"), 500e3).ok());
  EXPECT_FALSE(run_scenario(read(text + "0x100000]}\n"), 500e3).ok());
  EXPECT_FALSE(
      run_scenario(read("accesses: [{node: b, do: [until MCR 0x80000000 0]}]"), 500e3).ok());
}

}  // namespace
}  // namespace vericansim
