// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The recipes of docs/registers.md, access by access as they are printed, on cores without any
// other software; and what the page says around them.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "session/runner.hpp"

namespace vericansim {
namespace {

using Steps = std::vector<std::string>;

std::string page() {
  std::ifstream file("docs/registers.md");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// "write MB0.CS..MB15.CS 0" as sixteen steps; any other step as it is.
Steps expanded(const std::string &step) {
  static const std::regex kRange{R"(write MB(\d+)\.CS\.\.MB(\d+)\.CS (\w+))"};
  std::smatch match;
  if (!std::regex_match(step, match, kRange)) return {step};
  Steps steps;
  for (int n = std::stoi(match[1]); n <= std::stoi(match[2]); ++n)
    steps.push_back("write MB" + std::to_string(n) + ".CS " + match[3].str());
  return steps;
}

/// The steps under that heading, without their comments; a failure if there are none.
Steps recipe(const std::string &title) {
  const std::string text = page();
  const std::size_t heading = text.find("\n### " + title + "\n");
  const std::size_t begin = text.find("```text\n", heading);
  const std::size_t end = text.find("```\n", begin + 1);
  EXPECT_TRUE(heading != std::string::npos && end != std::string::npos) << title;
  if (end == std::string::npos) return {};
  std::istringstream lines(text.substr(begin + 8, end - begin - 8));
  Steps steps;
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    line.erase(line.find_last_not_of(' ') + 1);
    for (std::string &step : expanded(line)) steps.push_back(std::move(step));
  }
  EXPECT_FALSE(steps.empty()) << title;
  return steps;
}

Steps join(const std::vector<Steps> &parts) {
  Steps all;
  for (const Steps &part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// "write MCR 0x1" becomes "write MCR 0x0" and the like.
Steps with(Steps steps, const std::string &from, const std::string &to) {
  unsigned found = 0;
  for (std::string &step : steps) {
    if (step != from) continue;
    step = to;
    ++found;
  }
  EXPECT_EQ(found, 1U) << from;
  return steps;
}

/// What the CPU of core a or b does from a time on.
struct Program {
  std::string node;
  unsigned at_us;
  Steps steps;
};

/// Runs two cores that only software like this touches: from reset on the steps of `a` and `b`,
/// then the programs. Empty if all was as they say.
std::string failures(const Steps &a, const Steps &b, std::vector<Program> programs) {
  programs.insert(programs.begin(), {{"a", 0, a}, {"b", 0, b}});
  std::string text =
      "duration: 6 ms\njudge: lockstep\n"
      "nodes: [{name: a, software: none}, {name: b, software: none}]\naccesses:\n";
  for (const Program &program : programs) {
    text += "  - {node: " + program.node + ", at: " + std::to_string(program.at_us) + " us, do: [";
    for (const std::string &step : program.steps) text += step + ", ";
    text.replace(text.size() - 2, 2, "]}\n");
  }
  const RunReport report = run_scenario(parse_scenario("recipe.yaml", text), 500e3);
  std::string failed;
  for (const CheckResult &check : report.checks)
    if (!check.ok) failed += check.what + ": " + check.seen + " (expected " + check.wanted + ")\n";
  return failed;
}

const Steps kStart = recipe("Onto the bus");
const Steps kSend = recipe("Sending");
const Steps kReceive = recipe("Receiving");
const Steps kAsk = recipe("Asking with a remote frame");
const Steps kAnswer = recipe("Answering remote frames");
// Code 0100 as the recipe writes it, and what follows.
const Steps kListen(kReceive.begin(), kReceive.begin() + 3);
const Steps kTake(kReceive.begin() + 3, kReceive.end());
// A second frame of that identifier.
const Steps kAgain = {"write MB8.CS 0x0C080000", "until IFLAG1 0x100 0x100", "write IFLAG1 0x100"};

// FX-3.2.a, FX-3.2.b, FX-3.6.a: sending and receiving, a second frame with the last steps alone.
TEST(RegisterRecipes, SendAndReceive) {
  EXPECT_EQ(failures(kStart, kStart,
                     {{"b", 100, join({kReceive, kTake})},
                      {"a", 1000, join({kSend, kAgain})},
                      {"b", 5000, {"check MB4.CS 0x00400000 0x00400000"}}}),  // SRR
            "");
}

// FX-3.2.g, FX-3.7.a: a remote frame, its answer by the other core, the code afterwards.
TEST(RegisterRecipes, AskAndAnswer) {
  const Steps only_ask(kAsk.begin(), kAsk.begin() + 5);
  EXPECT_EQ(failures(kStart, kStart, {{"b", 100, kAnswer}, {"a", 1000, kAsk}}), "");
  EXPECT_EQ(failures(kStart, kStart,
                     {{"a", 1000, only_ask}, {"a", 5000, {"check MB9.CS 0x0F000000 0x04000000"}}}),
            "");
}

// FX-3.2.b, FX-3.2.c, FX-3.6.g: what "serviced" is: read and unlocked. IFLAG alone does not count.
TEST(RegisterRecipes, Serviced) {
  const auto second = [](const Steps &between, const std::string &code) {
    return failures(kStart, kStart,
                    {{"b", 100, kListen},
                     {"a", 1000, join({kSend, {"until TIMER 0x800 0x800"}, kAgain})},
                     {"b", 1500, between},
                     {"b", 5500, {"check MB4.CS 0x0F000000 0x0" + code + "000000"}}});
  };
  EXPECT_EQ(second({"until IFLAG1 0x10 0x10", "write IFLAG1 0x10"}, "6"), "");
  EXPECT_EQ(second({"read MB4.CS", "read TIMER"}, "2"), "");
  EXPECT_EQ(second({"read MB4.CS", "read MB5.CS"}, "2"), "");
  EXPECT_EQ(second({"read MB4.ID", "read TIMER"}, "6"), "");
}

// FX-MCR.MAXMB: buffers above 15 take no part after a reset.
TEST(RegisterRecipes, SixteenBuffersAfterReset) {
  const Program send{"a", 1000, {"write MB16.ID 0x048C0000", "write MB16.CS 0x0C000000"}};
  const Steps more = with(kStart, "set MCR 0x00020000", "set MCR 0x00020010");
  EXPECT_EQ(failures(kStart, kStart, {send, {"a", 5000, {"check IFLAG1 0x10000 0"}}}), "");
  EXPECT_EQ(failures(more, kStart, {send, {"a", 5000, {"check IFLAG1 0x10000 0x10000"}}}), "");
}

// FX-MCR.SRX_DIS: 0 after reset: a node hears its own frames.
TEST(RegisterRecipes, OwnFrames) {
  const Program listen{"a", 100, kListen};
  const Program send{"a", 1000, kSend};
  const Steps hears = with(kStart, "set MCR 0x00020000", "read MCR");
  EXPECT_EQ(failures(kStart, kStart, {listen, send, {"a", 5000, {"check IFLAG1 0x10 0"}}}), "");
  EXPECT_EQ(failures(hears, kStart, {listen, send, {"a", 5000, {"check IFLAG1 0x10 0x10"}}}), "");
}

// FX-CTRL2.RRS, FX-CTRL2.EACEN, FX-3.5.a: after a reset a buffer takes one identifier, of base or
// extended frames by its IDE bit, whatever the mask says of it, and no remote frame.
TEST(RegisterRecipes, OneIdentifierOneFormatNoRemoteFrame) {
  const auto hears = [](const Steps &start, const std::string &id, const std::string &cs) {
    const Steps send = {"write MB8.ID " + id, "write MB8.CS " + cs, "until IFLAG1 0x100 0x100"};
    return failures(
        kStart, start,
        {{"b", 100, kListen}, {"a", 1000, send}, {"b", 5000, {"check IFLAG1 0x10 0x10"}}});
  };
  const Steps open = with(kStart, "set MCR 0x00020000", "write RXGMASK 0x0");
  const std::string missed = hears(kStart, "0x048C0000", "0x0C100000");
  EXPECT_EQ(hears(kStart, "0x048C0000", "0x0C000000"), "");
  EXPECT_NE(missed, "") << "remote";
  EXPECT_EQ(hears(kStart, "0x04880000", "0x0C000000"), missed) << "another identifier";
  EXPECT_EQ(hears(kStart, "0x048C0000", "0x0C600000"), missed) << "extended";
  EXPECT_EQ(hears(open, "0x04880000", "0x0C000000"), "") << "no mask bit";
  EXPECT_EQ(hears(open, "0x048C0000", "0x0C600000"), missed) << "no mask bit, extended";
  EXPECT_EQ(hears(open, "0x048C0000", "0x0C100000"), missed) << "no mask bit, remote";
}

// FX-MCR.AEN, FX-3.3.j: no word of a buffer that has sent can be written until IFLAG is cleared.
TEST(RegisterRecipes, AbortEnabledClosesABufferUntilItsFlagIsCleared) {
  const Steps start = with(kStart, "set MCR 0x00020000", "set MCR 0x00021000");
  const Steps send(kSend.begin(), kSend.end() - 1);
  const Steps rewrite = {"write MB8.ID 0x04900000", "write MB8.CS 0x0C000000"};
  EXPECT_EQ(
      failures(start, kStart,
               {{"a", 1000, send},
                {"a", 2000, rewrite},
                {"a",
                 2100,
                 {"check MB8.ID 0xFFFFFFFF 0x048C0000", "check MB8.CS 0x0F000000 0x08000000"}},
                {"a", 2200, join({{"write IFLAG1 0x100"}, rewrite})},
                {"a", 2300, {"check MB8.ID 0xFFFFFFFF 0x04900000", "until IFLAG1 0x100 0x100"}}}),
      "");
}

}  // namespace
}  // namespace vericansim
