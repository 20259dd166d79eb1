// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Where messages have an analytic bound, and that one that is expected elsewhere is refused.
#include "scenario/bound_scope.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/input_error_of.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// `node`: keys of node `a` and its name; `more`: messages of it and other keys.
struct Scope {
  const char *name;
  std::string node;
  std::string more;
  std::string why;  // empty: there is a bound
};

std::string text_of(const Scope &scope) {
  return "duration: 1 ms\nnodes: [{name: b}, {name: h}, {name: a" + scope.node +
         "}]\ntraffic:\n  - {node: b, id: 9, period: 1 ms}\n" + scope.more;
}

const std::string kTwoMessages =
    "  - {node: a, id: 1, period: 1 ms}\n  - {node: a, id: 2, period: 1 ms}\n";

class BoundScope : public ::testing::TestWithParam<Scope> {};

TEST_P(BoundScope, IsWhatTheAnalysisKnows) {
  const std::string text = text_of(GetParam());
  EXPECT_EQ(why_no_bound(parse_scenario("s.yaml", text)), GetParam().why);
  const std::string refusal = input_error_of(
      [&] { return parse_scenario("s.yaml", text + "expect: {within_bound: true}\n"); });
  if (GetParam().why.empty())
    EXPECT_EQ(refusal, "no error");
  else
    EXPECT_THAT(refusal, HasSubstr("expect.within_bound: no message has a bound: " +
                                   GetParam().why + "; allowed: nodes that send"));
}

INSTANTIATE_TEST_SUITE_P(
    All, BoundScope,
    ::testing::Values(
        Scope{"Traffic", "", kTwoMessages, ""}, Scope{"ListensOnly", ", listen_only: true", "", ""},
        Scope{"OneMessage", ", lowest_buffer_first: true", "  - {node: a, id: 1}\n", ""},
        Scope{"EnoughBuffers", ", tx_buffers: 2", kTwoMessages, ""},
        Scope{"Saturated", "", "  - {node: a, id: 1, name: m, period: saturated}\n",
              "message 'm' is saturated"},
        Scope{"OneIdentifier", "", "  - {node: a, id: 1, name: m}\n  - {node: a, id: 1, name: n}\n",
              "messages 'm' and 'n' have one identifier"},
        Scope{"LowestBufferFirst", ", lowest_buffer_first: true", kTwoMessages,
              "node 'a' has 'lowest_buffer_first'"},
        Scope{"FewBuffers", ", tx_buffers: 1", kTwoMessages,
              "node 'a' has 1 transmit buffer for 2 messages"},
        Scope{"Recording", ", replay: a.log", "", "node 'a' with 'replay' sends of its own"},
        Scope{"Interface", ", interface: vcan0", "", "node 'a' with 'interface' sends of its own"},
        Scope{"Clients", ", socketcand: '29536'", "",
              "node 'a' with 'socketcand' sends of its own"},
        Scope{"Firmware", ", firmware: a.elf", "", "node 'a' with 'firmware' sends of its own"},
        Scope{"RemoteNode", ", type: remote, number: 2", "",
              "node 'a' with 'type: remote' sends of its own"},
        Scope{"Commands", ", type: remote, number: 2", "commands: [{node: h, do: operate}]\n",
              "node 'h' sends 'commands'"},
        Scope{"Accesses", "", "accesses: [{node: h, do: [read MCR]}]\n",
              "node 'h' has 'accesses', which may send"}),
    [](const auto &item) { return std::string(item.param.name); });

TEST(BoundScopeLine, IsThatOfTheExpectation) {
  const std::string text =
      "nodes: [{name: a}]\ntraffic: [{node: a, id: 1, period: saturated}]\nexpect:\n  frames: 1\n"
      "  within_bound: true\n";
  EXPECT_THAT(input_error_of([&] { return parse_scenario("s.yaml", text); }),
              HasSubstr("s.yaml:5: expect.within_bound: "));
}

// As many messages as there is room for: 16 buffers, of which 8 receive.
TEST(BoundScopeBuffers, FitBesideTheReceiveBuffers) {
  std::string text = "nodes: [{name: a, mailboxes: 16}]\ntraffic:\n";
  const auto add = [&text](int id) {
    text += "  - {node: a, id: " + std::to_string(id) + ", period: 10 ms}\n";
  };
  for (int id = 1; id <= 8; ++id) add(id);
  EXPECT_EQ(why_no_bound(parse_scenario("s.yaml", text)), "");
  add(9);
  const Scenario crowded = parse_scenario("s.yaml", text);
  EXPECT_EQ(transmit_buffers(crowded, 0), 8U);
  EXPECT_EQ(why_no_bound(crowded), "node 'a' has 8 transmit buffers for 9 messages");
}

}  // namespace
}  // namespace vericansim
