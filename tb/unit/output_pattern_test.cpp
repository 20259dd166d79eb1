// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputPattern: what is found, and that no text and no pattern takes a stack or time without end.
#include "scenario/output_pattern.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/board.hpp"
#include "simulation/expectations.hpp"

namespace vericansim {
namespace {

bool found(const std::string &pattern, const std::string &text) {
  return OutputPattern{pattern}.found_in(text);
}

TEST(OutputPattern, IsFoundAnywhere) {
  const std::string text = "boot\n11 answers, 0x2A\ndone\n";
  for (const char *pattern : {"^boot", "1{2} an", "0x[0-9A-F]+", "answers.*A\ndone", "(d|b)one",
                              "\\bdone\\b", "x|boot", "do(?:n|m)e\n$", "", "[(?=]|done"})
    EXPECT_TRUE(found(pattern, text)) << pattern;
  for (const char *pattern : {"^done", "x{5}", "boot$", "answers.*done", "one\\b.", "^x|^done"})
    EXPECT_FALSE(found(pattern, text)) << pattern;
}

TEST(OutputPattern, WhatCannotBeDoneInOnePassIsRefused) {
  for (const std::string pattern :
       {"(", "a)|(?:b", "[a", "(a)\\1", "a(?=b)", "a(?!b)", "(a{9999}){9999}", "[]](?=a)"})
    EXPECT_THROW(OutputPattern{pattern}, std::regex_error) << pattern;
  EXPECT_NO_THROW(OutputPattern{"\\(?=a[(?!]"});
  EXPECT_NO_THROW(OutputPattern{std::string(500, '(') + std::string(500, ')')});
  EXPECT_THROW(OutputPattern{std::string(1001, 'a')}, std::regex_error);
}

// The first of these needed a stack as long as the text, the second 2 to the power of its length.
TEST(OutputPattern, LongTextsAreSearched) {
  for (const std::size_t size : {18U << 10, 1U << 20}) {
    const std::string text(size, 'a');
    EXPECT_TRUE(found("(.|\n)*end", text + "end"));
    EXPECT_FALSE(found("([a-z]+)*Z", text));
    EXPECT_FALSE(found("a.*Z", text));  // from each letter on to the end
  }
}

// A pattern that nobody has looked at before is a check that fails, not the end of the run.
TEST(OutputPattern, ErrorsAreFailedChecks) {
  Scenario scenario;
  scenario.nodes.resize(1);
  scenario.expect.nodes.resize(1);
  scenario.expect.nodes[0].matches = {"(a)\\1", "a"};
  RunReport report;
  report.nodes.resize(1);
  report.nodes[0].name = "f";
  report.boards.resize(1);
  report.boards[0].node = "f";
  report.boards[0].output = "aa";
  const auto checks = check_expectations(scenario, report, {}, {});
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_FALSE(checks[0].ok);
  EXPECT_EQ(checks[0].seen.rfind("cannot be looked for: ", 0), 0U) << checks[0].seen;
  EXPECT_TRUE(checks[1].ok);
}

}  // namespace
}  // namespace vericansim
