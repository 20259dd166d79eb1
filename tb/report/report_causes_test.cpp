// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Each cause of an error or overload frame: a fault on a simulated bus brings its sentence and
// rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "model/frame_codec.hpp"
#include "report/cause_cases.hpp"
#include "report/report_run.hpp"

namespace vericansim {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

/// A sender, a receiver that is disturbed, and a third node; no frame but `frame`.
Scenario bus_with(const Frame &frame) {
  Scenario scenario = parse_scenario("causes.yaml", R"(
bitrate: 500k
duration: 1 ms
drain: 20 ms
nodes: [{name: sender}, {name: receiver}, {name: witness}]
traffic: [{node: sender, name: message, id: 1}]
)");
  scenario.traffic.front().frame = frame;
  scenario.traffic.front().data = DataKind::kFixed;
  return scenario;
}

FaultSpec fault_of(const Disturbance &disturbance) {
  FaultSpec fault;
  fault.kind = FaultSpec::Kind::kPlace;
  fault.effect = disturbance.effect;
  fault.node = disturbance.victim;
  fault.watched = disturbance.watched;
  fault.place.field = disturbance.field;
  fault.place.index = disturbance.index;
  fault.place.stuff = disturbance.stuff;
  fault.place.frame = disturbance.frame;
  return fault;
}

ReportPage page_of(const CauseCase &c) {
  Scenario scenario = bus_with(c.frame);
  for (const Disturbance &d : c.disturbances) scenario.faults.push_back(fault_of(d));
  return run_with_report(scenario).page;
}

class Causes : public ::testing::TestWithParam<CauseCase> {};

TEST_P(Causes, AreToldWithTheirRule) {
  const CauseCase &c = GetParam();
  const ReportPage page = page_of(c);
  ASSERT_GT(page.size("e.kind"), c.event);
  const auto [text, rule] = page.cause(c.event);
  EXPECT_EQ(rule, c.rule);
  EXPECT_THAT(text, HasSubstr(c.words));
  EXPECT_EQ(page.at("e.kind", c.event), c.kind);
  EXPECT_EQ(page.at("e.node", c.event), c.node);
  if (c.event != 0) return;
  // A CRC error is found at the ACK delimiter (FC-03).
  const Disturbance first =
      c.rule == "ED-14" ? Disturbance{.field = Field::kAckDel} : c.disturbances.front();
  EXPECT_EQ(page.at("e.field", 0), static_cast<double>(first.field));
  EXPECT_EQ(page.at("e.index", 0), first.index);
  EXPECT_EQ(page.size("f.start"), c.kind == 1 && c.rule != "ED-10" ? 1U : page.size("f.start"));
}

INSTANTIATE_TEST_SUITE_P(All, Causes, ::testing::ValuesIn(cause_cases()),
                         [](const auto &test) { return test.param.name; });

/// Falsifies the wire for the passive decoder alone: no node reports anything.
ReportPage page_with_false_wire(const Frame &frame, double first_bit, double bits, Effect effect) {
  Scenario scenario = bus_with(frame);
  const ReportPage clean = run_with_report(scenario).page;
  constexpr double kBit = 2e6;  // ps at 500 kbit/s
  const double sof = clean.at("f.start", 0) * 1e3;
  FaultSpec fault;
  fault.effect = effect;
  fault.node = kBusPoint;
  fault.window.from = static_cast<Time>(sof + first_bit * kBit);
  fault.window.to = static_cast<Time>(sof + (first_bit + bits) * kBit);
  scenario.faults.push_back(fault);
  return run_with_report(scenario).page;
}

constexpr Frame kQuiet{.id = 0x2AA, .dlc = 1, .data = {0x55}};

/// Bits before a place of that frame; INT1 follows EOF7. Behind the ACK slot the decoder's grid is
/// later: the receivers' acknowledge is the last edge that it has followed.
double bits_before(Field field, unsigned index) {
  const auto bits = encode_frame(kQuiet).bits;
  constexpr double kLate = 0.25;
  if (field == Field::kInt) return static_cast<double>(bits.size() + index) + kLate;
  const auto found = std::find_if(bits.begin(), bits.end(), [&](const WireBit &bit) {
    return bit.field == field && bit.index == index && !bit.is_stuff;
  });
  return static_cast<double>(found - bits.begin()) + (field > Field::kAck ? kLate : 0);
}

// Every overload frame ends with a delimiter too, so this bit is disturbed by its time, once.
ReportPage last_delimiter_bit_page() {
  Scenario scenario = bus_with(kQuiet);
  scenario.faults.push_back(fault_of({.field = Field::kData, .index = 1}));
  const ReportPage before = run_with_report(scenario).page;
  const double bit = 2000.0;
  FaultSpec fault;
  fault.effect = Effect::kDominant;
  fault.node = kReceiverNode;
  fault.window.from = static_cast<Time>((before.at("e.end", 0) - 0.6 * bit) * 1e3);
  fault.window.to = fault.window.from + static_cast<Time>(bit * 1e3);
  scenario.faults.push_back(fault);
  return run_with_report(scenario).page;
}

TEST(LastDelimiterBit, AsksForAnOverloadFrame) {
  const ReportPage page = last_delimiter_bit_page();
  ASSERT_EQ(page.size("e.kind"), 2U);
  EXPECT_EQ(page.at("e.kind", 1), 1);
  EXPECT_EQ(page.cause(1).second, "ED-12");
  EXPECT_THAT(page.cause(1).first, HasSubstr("saw dominant in the last bit of a delimiter"));
  EXPECT_EQ(page.at("e.node", 1), kReceiverNode);
  EXPECT_EQ(page.at("e.field", 1), static_cast<double>(Field::kDel));
  EXPECT_EQ(page.at("e.index", 1), 6);
}

struct WireCase {
  std::string name;
  Field field;
  unsigned index;
  double bits;
  Effect effect;
  std::string rule, words;
  int kind = 0;
};

std::ostream &operator<<(std::ostream &out, const WireCase &c) { return out << c.name; }

const std::vector<WireCase> kWireCases = {
    {"Stuff", Field::kData, 0, 6.5, Effect::kDominant, "ST-06",
     "six equal bits on the wire in the data field"},
    {"Form", Field::kAckDel, 0, 1, Effect::kDominant, "ED-09",
     "a dominant level on the wire in the ACK delimiter"},
    {"Crc", Field::kData, 3, 1, Effect::kFlip, "CR-03", "the CRC on the wire is wrong"},
    {"Overload", Field::kInt, 0, 1, Effect::kDominant, "OV-03",
     "an overload condition on the wire in the intermission", 1},
};

ReportPage page_of(const WireCase &c) {
  return page_with_false_wire(kQuiet, bits_before(c.field, c.index), c.bits, c.effect);
}

class WireCauses : public ::testing::TestWithParam<WireCase> {};

TEST_P(WireCauses, SayThatNoNodeKnows) {
  const WireCase &c = GetParam();
  const ReportPage page = page_of(c);
  ASSERT_GE(page.size("e.kind"), 1U);
  EXPECT_EQ(page.cause(0).second, c.rule);
  EXPECT_THAT(page.cause(0).first, HasSubstr(c.words));
  EXPECT_THAT(page.cause(0).first, EndsWith("as no node reported"));
  EXPECT_EQ(page.at("e.node", 0), 255);
  EXPECT_EQ(page.at("e.kind", 0), c.kind);
  EXPECT_EQ(page.at("e.error", 0), 0);
}

INSTANTIATE_TEST_SUITE_P(All, WireCauses, ::testing::ValuesIn(kWireCases),
                         [](const auto &test) { return test.param.name; });

// The error that takes the TEC from 248 to 256 carries the rule of bus-off, whatever it was.
TEST(CausesOfBusOff, NameTheRule) {
  CauseCase c{"", kQuiet, {}, "", ""};
  c.disturbances = {{.index = 1, .frame = std::nullopt}};
  const ReportPage page = page_of(c);
  std::size_t off = 0;
  while (page.cause(off).second != kBusOffRule) ++off;
  EXPECT_THAT(page.cause(off).first, HasSubstr("TEC reaches 256: bus-off"));
  // FC-05: 32 errors of 8 each; from the 17th on the node is passive (FC-11).
  EXPECT_EQ(off, 31U);
  EXPECT_THAT(page.cause(15).first, Not(HasSubstr("passive")));
  EXPECT_THAT(page.cause(17).first, HasSubstr("error passive, its flag recessive"));
}

TEST(CauseTable, EverySentenceHasACase) {
  std::vector<std::string> seen;
  for (const CauseCase &c : cause_cases()) {
    const ReportPage page = page_of(c);
    for (const auto &cause : page.meta.at("causes")) seen.push_back(cause.at("text"));
  }
  for (const WireCase &c : kWireCases) {
    const ReportPage page = page_of(c);
    for (const auto &cause : page.meta.at("causes")) seen.push_back(cause.at("text"));
  }
  seen.push_back(last_delimiter_bit_page().cause(1).first);
  for (const CauseRule &rule : cause_rules()) {
    const std::string head{rule.text.substr(0, rule.text.find("{}"))};
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(), [&](const std::string &text) {
      return text.find(head) != std::string::npos;
    })) << head;
  }
}

TEST(CauseTable, RulesAreInThePlan) {
  std::set<std::string> plan;
  for (const auto &section : YAML::LoadFile("tb/plan.yaml"))
    for (const auto &rule : section["rules"]) plan.insert(rule.first.as<std::string>());
  ASSERT_GT(plan.size(), 200U);
  unsigned place = 0;
  for (const CauseRule &rule : cause_rules()) {
    EXPECT_TRUE(plan.contains(std::string{rule.rule})) << rule.rule;
    EXPECT_EQ(static_cast<unsigned>(rule.kind), place++);
  }
  EXPECT_TRUE(plan.contains(std::string{kBusOffRule}));
}

}  // namespace
}  // namespace vericansim
