// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A sample of the random campaign (docs/lockstep.md); the seed is the name of the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random/judged_run.hpp"
#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

class RandomBus : public ::testing::TestWithParam<unsigned> {};

INSTANTIATE_TEST_SUITE_P(Seed, RandomBus, ::testing::Range(1U, 41U),
                         [](const auto &test) { return std::to_string(test.param); });

// TH-06, TH-07, TH-08, VA-03, BT-07, BT-08, IF-03, IF-06, AR-13, PF-56: whole cores with random
// clocks, delays, buffers, software and noise follow the rules bit by bit; what one sends the
// others receive, once and in order.
TEST_P(RandomBus, JudgesAgree) {
  const Scenario scenario = random_scenario(GetParam(), 250);
  const JudgedRun run = run_judged(scenario);
  for (const std::string &finding : run.findings) ADD_FAILURE() << finding;
  EXPECT_FALSE(run.cut_short);  // then there would be no findings
  EXPECT_GT(run.frames, 0u);
  EXPECT_GT(run.counts.node_bits, 0u);
  EXPECT_EQ(run.counts.wire.exchanges == 0, run.counts.wire.deliveries == 0);
}

// A bus that the model cannot follow to its end, because too much is open, is no difference, though
// software had more to do there.
TEST(RandomBus, CutShortIsNoDifference) {
  const JudgedRun run = run_judged(random_scenario(148, 3000));
  EXPECT_TRUE(run.cut_short);
  EXPECT_THAT(run.findings, ::testing::IsEmpty());
}

// The same seed makes the same bus, another one makes another.
TEST(RandomScenario, IsAFunctionOfTheSeed) {
  EXPECT_EQ(to_yaml(random_scenario(7, 200)), to_yaml(random_scenario(7, 200)));
  EXPECT_NE(to_yaml(random_scenario(7, 200)), to_yaml(random_scenario(8, 200)));
}

// A scenario file says all that there is to it.
TEST(RandomScenario, IsTheSameAsAFile) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Scenario scenario = random_scenario(seed, 100);
    const std::string text = to_yaml(scenario);
    const Scenario read = parse_scenario("file", text);
    EXPECT_EQ(to_yaml(read), text) << "seed " << seed;
    EXPECT_EQ(read.nodes.size(), scenario.nodes.size());
    EXPECT_EQ(read.accesses.size(), scenario.accesses.size());
    EXPECT_EQ(read.faults.size(), scenario.faults.size());
  }
}

TEST(RandomScenario, AFileRunsLikeTheBusItself) {
  const Scenario scenario = random_scenario(3, 100);
  const JudgedRun direct = run_judged(scenario);
  const JudgedRun file = run_judged(parse_scenario("file", to_yaml(scenario)));
  EXPECT_EQ(direct.frames, file.frames);
  EXPECT_EQ(direct.counts.node_bits, file.counts.node_bits);
  EXPECT_EQ(direct.counts.accesses, file.counts.accesses);
  EXPECT_EQ(direct.node_cycles, file.node_cycles);
}

}  // namespace
}  // namespace vericansim
