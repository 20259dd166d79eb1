// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of scenarios: how often they took effect, against the levels in the waveform; what is said
// of those that did not; expectations that nothing could have missed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>

#include "model/frame_codec.hpp"
#include "report/report_run.hpp"
#include "session/runner.hpp"
#include "trace/vcd_file.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

RunReport run_text(const std::string &text) {
  return run_scenario(parse_scenario("test.yaml", text), 500e3);
}

/// The verdict on one check; "none" if there is no such check.
std::string verdict(const RunReport &report, const std::string &what) {
  for (const CheckResult &check : report.checks)
    if (check.what == what) return (check.ok ? "ok " : "FAIL ") + check.seen;
  return "none";
}

// ---- Against the waveform

constexpr Time kClock = 125 * kNanosecond;  // of all nodes, without delays: they tick together
constexpr Time kBit = 2 * kMicrosecond;

/// A signal of a waveform at every clock edge.
std::vector<Level> samples(const VcdFile &vcd, const std::string &signal, std::size_t edges) {
  std::vector<Level> levels(edges, Level::kRecessive);
  vcd.read(vcd.find(signal), [&](Time time, Level level) {
    for (auto i = static_cast<std::size_t>(time / kClock); i < edges; ++i) levels[i] = level;
  });
  return levels;
}

/// Bit times in which `victim` received something else than the AND of what all nodes drove just
/// before. The waveform has neither faults nor their names in what nodes drive.
double disturbed_bits(const std::string &file, const std::vector<std::string> &nodes,
                      const std::string &victim) {
  const VcdFile vcd{file};
  const auto edges =
      static_cast<std::size_t>(vcd.read(vcd.find("bus.can"), [](Time, Level) {}) / kClock);
  std::vector<Level> wire(edges, Level::kRecessive);
  for (const std::string &node : nodes) {
    const std::vector<Level> tx = samples(vcd, node + ".tx", edges);
    for (std::size_t i = 0; i + 1 < edges; ++i) wire[i + 1] = wire[i + 1] & tx[i];
  }
  const std::vector<Level> rx = samples(vcd, victim + ".rx", edges);
  double clocks = 0;
  for (std::size_t i = 0; i < edges; ++i) clocks += rx[i] != wire[i] ? 1 : 0;
  return clocks * static_cast<double>(kClock) / static_cast<double>(kBit);
}

struct Counted {
  const char *name;
  const char *fault;
  const char *victim;
  double least;  // so that the case is none in which nothing happens
  double part = 0.03;
};

class CountedFault : public ::testing::TestWithParam<Counted> {};

// Whole bits are counted, so that the area of the difference is their number; a window that cuts
// bits makes the count one more or less at each of its ends. Flipped bits of an idle bus are
// longer: each synchronises the node that reads it.
TEST_P(CountedFault, HasTheBitsThatTheWaveformShows) {
  Scenario scenario = parse_scenario(
      "test.yaml", std::string("duration: 12 ms\nnodes: [{name: a}, {name: b}, {name: c}]\n"
                               "traffic:\n"
                               "  - {node: a, id: 0x123, data: 00 FF 55 0F, period: 1 ms}\n"
                               "  - {node: b, id: 0x12345678, extended: true, data: random, "
                               "period: 3 ms, offset: 0.3 ms}\n"
                               "faults: [") +
                       GetParam().fault + "]\n");
  scenario.outputs.vcd = ::testing::TempDir() + "counted_" + GetParam().name + ".vcd";
  const RunReport report = run_scenario(scenario, 500e3);
  const double bits = disturbed_bits(scenario.outputs.vcd, {"a", "b", "c"}, GetParam().victim);
  std::remove(scenario.outputs.vcd.c_str());
  EXPECT_GE(bits, GetParam().least);
  EXPECT_NEAR(static_cast<double>(report.faults.at(0).hits), bits, 0.5 + GetParam().part * bits);
}

INSTANTIATE_TEST_SUITE_P(
    All, CountedFault,
    ::testing::Values(
        Counted{"OneBit", "{kind: flip, at: {node: c, frame: 3, field: DATA, bit: 9}}", "c", 1},
        Counted{"AField", "{kind: flip, node: b, at: {node: b, frame: 2, field: CRC}}", "b", 1},
        Counted{"Dominant", "{kind: dominant, node: c, at: {node: a, frame: 4, field: EOF}}", "c",
                1},
        Counted{"Window", "{kind: flip, node: b, from: 3.02 ms, for: 200 us}", "b", 99},
        Counted{"DominantWindow", "{kind: dominant, node: c, from: 2.02 ms, for: 150 us}", "c", 30},
        Counted{"RecessiveForEver", "{kind: recessive, node: c, from: 1 ms}", "c", 200},
        Counted{"Cut", "{kind: cut, node: c, from: 4 ms, for: 3 ms}", "c", 60},
        Counted{"Short", "{kind: short, node: b, from: 5.05 ms, for: 0.5 ms}", "c", 100},
        Counted{"FlippedBits", "{kind: noise, node: c, per_bit: 0.01}", "c", 20, 0.08}),
    [](const auto &item) { return std::string(item.param.name); });

/// How often a level that is forced while `node` is at a bit of the frame 155#00A7 took effect.
std::uint64_t hits_of(const char *kind, const char *node, const WireBit &bit) {
  const std::string text = fmt::format(
      "duration: 1 ms\nnodes: [{{name: a}}, {{name: b}}]\n"
      "traffic: [{{node: a, id: 0x155, data: 00 A7}}]\n"
      "faults: [{{kind: {}, at: {{node: {}, frame: 1, field: {}, bit: {}, stuff: {}}}}}]\n",
      kind, node, field_name(bit.field), bit.index, bit.is_stuff);
  return run_scenario(parse_scenario("test.yaml", text), 1e6).faults.at(0).hits;
}

// Each bit of a frame is forced to the level that the frame codec says it has, which changes
// nothing, and to the other one. At 8 clocks a bit the synchroniser has a quarter of it.
TEST(Fault, ALevelThatIsThereAlreadyIsNoEffect) {
  for (const WireBit &bit : encode_frame({.id = 0x155, .dlc = 2, .data = {0x00, 0xA7}}).bits)
    for (const char *node : {"a", "b"}) {
      if (bit.field == Field::kSof) continue;  // b is not there
      const bool dominant = bit.level == Level::kDominant;
      const std::string place = fmt::format("{} at {} bit {}", node, field_name(bit.field),
                                            static_cast<unsigned>(bit.index));
      EXPECT_EQ(hits_of("dominant", node, bit), dominant ? 0U : 1U) << place;
      EXPECT_EQ(hits_of("recessive", node, bit), dominant ? 1U : 0U) << place;
    }
}

// EF-06: a recessive bit in an active flag makes a new flag begin in the next bit, so that each bit
// is the first of one. FC-02 and FC-07 make REC 129 with sixteen of them, and the seventeenth is
// the last in an active flag (EF-05).
TEST(Fault, EachErrorFlagHasItsFirstBit) {
  const RunReport report = run_text(
      "duration: 1 ms\nnodes: [{name: a}, {name: b}, {name: c}]\n"
      "traffic: [{node: a, id: 0x123, data: 00 FF 55 0F}]\n"
      "faults:\n"
      "  - {kind: flip, at: {node: b, frame: 1, field: DATA, bit: 10, stuff: false}}\n"
      "  - {kind: recessive, at: {node: b, frame: 1, field: ERROR_FLAG, bit: 0}}\n");
  EXPECT_EQ(report.nodes.at(1).counts.max_rec, 129U);
  ASSERT_FALSE(report.faults.at(1).times.empty());
  const Window flags = report.faults.at(1).times.front();
  EXPECT_NEAR(static_cast<double>(flags.to - flags.from) / static_cast<double>(kBit), 17, 0.5);
}

// ---- What is said

const std::string kBus =
    "duration: 6 ms\nnodes: [{name: a}, {name: b}]\n"
    "traffic: [{node: a, id: 0x100, data: 01 02, period: 1 ms}]\n";
// The first hits once; nobody sends when the second comes.
const std::string kFaults =
    "faults:\n"
    "  - {kind: flip, node: b, at: {node: b, frame: 2, field: CRC, bit: 3}, name: bad CRC}\n"
    "  - {kind: recessive, node: all, from: 4.7 ms, for: 10 us}\n";

TEST(FaultExpectation, AFaultWithoutEffectFailsWhereAnythingIsExpected) {
  const RunReport report = run_text(kBus + kFaults + "expect: {pending: 0}\n");
  EXPECT_EQ(verdict(report, "bad CRC took effect"), "ok 1");
  EXPECT_EQ(verdict(report, "recessive 2 took effect"), "FAIL 0");
  EXPECT_FALSE(report.ok());
  EXPECT_THAT(to_text(report), Not(HasSubstr("warning")));
}

TEST(FaultExpectation, WithoutExpectationsItIsAWarning) {
  const RunReport report = run_text(kBus + kFaults);
  EXPECT_TRUE(report.ok());
  EXPECT_TRUE(report.checks.empty());
  EXPECT_THAT(to_text(report), HasSubstr("warning: recessive 2 (line 6) never took effect"));
  EXPECT_THAT(to_text(report), Not(HasSubstr("warning: bad CRC")));
}

TEST(FaultExpectation, HitsOfAFaultCanBeSaid) {
  const std::string some = kBus + "faults: [{kind: dominant, node: b, hits: ";
  const std::string place = ", name: x, at: {node: b, frame: 2, field: EOF, bits_left: 2}}]\n";
  EXPECT_EQ(verdict(run_text(some + "1" + place), "x.hits"), "ok 1");
  EXPECT_EQ(verdict(run_text(some + "2" + place), "x.hits"), "FAIL 1");
  EXPECT_EQ(verdict(run_text(some + "{min: 2}" + place), "x.hits"), "FAIL 1");
  const std::string never = kBus + "faults: [{kind: recessive, from: 4.7 ms, for: 10 us, hits: ";
  EXPECT_EQ(verdict(run_text(never + "0}]\nexpect: {pending: 0}\n"), "recessive 1.hits"), "ok 0");
  EXPECT_THAT(to_text(run_text(never + "{min: 0}}]\n")), Not(HasSubstr("warning")));
}

// Two equal noises flip bits of their own; with one stream of random numbers each would undo what
// the other does, and both would count it.
TEST(FaultReports, NoisesAreIndependent) {
  const RunReport report = run_text(
      "duration: 100 ms\nnodes: [{name: a}, {name: b}]\n"
      "traffic: [{node: a, id: 1, data: counter, period: 1 ms}]\n"
      "faults: [{kind: noise, node: b, per_bit: 0.001}, {kind: noise, node: b, per_bit: 0.001}]\n");
  for (const FaultReport &fault : report.faults) EXPECT_GT(fault.hits, 20U);
  EXPECT_GT(report.nodes.at(1).counts.errors, 20U);
}

TEST(FaultReports, AreInTextAndJson) {
  const RunReport report = run_text(kBus + kFaults);
  EXPECT_THAT(to_text(report), HasSubstr("flipped at b while b is in CRC, bit 3, frame 2"));
  const auto json = to_json(report);
  const auto &faults = json.at("faults");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].at("name"), "bad CRC");
  EXPECT_EQ(faults[0].at("kind"), "flip");
  EXPECT_EQ(faults[0].at("node"), "b");
  EXPECT_EQ(faults[0].at("line"), 5);
  EXPECT_EQ(faults[0].at("hits"), 1);
  ASSERT_EQ(faults[0].at("times_ps").size(), 1U);
  const Time from = faults[0].at("times_ps")[0][0], to = faults[0].at("times_ps")[0][1];
  EXPECT_GT(from, kMillisecond);  // of the second frame
  EXPECT_LT(to, kMillisecond + 200 * kMicrosecond);
  EXPECT_NEAR(static_cast<double>(to - from), static_cast<double>(kBit), 2.0 * kClock);
  EXPECT_EQ(faults[1].at("node"), "all");
  EXPECT_EQ(faults[1].at("took_effect"), false);
  EXPECT_EQ(faults[1].at("times_ps").size(), 0U);
}

// A clock stays wrong until its next fault, or to the end.
TEST(FaultReports, AClockFaultLastsToTheNextOne) {
  const RunReport report = run_text(kBus +
                                    "faults: [{kind: clock, node: b, from: 1 ms, ppm: 500}, "
                                    "{kind: clock, node: b, from: 3 ms, ppm: 0}]\n");
  EXPECT_EQ(report.faults.at(0).times.at(0).from, kMillisecond);
  EXPECT_EQ(report.faults.at(0).times.at(0).to, 3 * kMillisecond);
  EXPECT_EQ(report.faults.at(1).times.at(0).to, report.duration);
}

TEST(FaultReports, AreOnThePage) {
  const ReportedRun run = run_with_report(parse_scenario("test.yaml", kBus + kFaults));
  const auto &faults = run.page.meta.at("faults");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].at("name"), "bad CRC");
  EXPECT_EQ(faults[0].at("node"), 1);
  EXPECT_EQ(faults[0].at("hits"), 1);
  EXPECT_EQ(faults[0].at("line"), 5);
  EXPECT_EQ(faults[0].at("more"), false);
  // The error that b found there.
  const double found = run.page.at("e.start", 0);
  EXPECT_LE(faults[0].at("times_ns")[0][0], found);
  EXPECT_GT(found, kMillisecond / kNanosecond);
  EXPECT_TRUE(faults[1].at("node").is_null());
  EXPECT_EQ(faults[1].at("hits"), 0);
}

// ---- Expectations that nothing could have missed

TEST(EmptyExpectation, CompleteFailsIfThereWasNothingToReceive) {
  const std::string two = "duration: 1 ms\nnodes: [{name: a}, {name: b}]\n";
  EXPECT_EQ(verdict(run_text(two + "expect: {complete: true}\n"), "complete"),
            "FAIL nothing to compare");
  // Nobody acknowledges, so nothing is complete.
  EXPECT_FALSE(run_text("duration: 1 ms\ndrain: 0\nnodes: [{name: a}]\n"
                        "traffic: [{node: a, id: 1}]\nexpect: {complete: true}\n")
                   .ok());
  // All that could receive has filters.
  EXPECT_FALSE(run_text("duration: 1 ms\nnodes: [{name: a}, {name: b, filters: [{id: 1}]}]\n"
                        "traffic: [{node: a, id: 1}]\nexpect: {complete: true}\n")
                   .ok());
  EXPECT_TRUE(run_text(two + "traffic: [{node: a, id: 1}]\nexpect: {complete: true}\n").ok());
}

TEST(EmptyExpectation, WithinBoundFailsWithoutAMessage) {
  const std::string two = "duration: 1 ms\nnodes: [{name: a}, {name: b}]\n";
  const std::string wanted = "expect: {within_bound: true}\n";
  EXPECT_EQ(verdict(run_text(two + wanted), "within_bound"), "FAIL none");
  EXPECT_EQ(
      verdict(run_text(two + "traffic: [{node: a, id: 1, period: 1 s, offset: random}]\n" + wanted),
              "within_bound"),
      "FAIL none");
  EXPECT_TRUE(run_text(two + "traffic: [{node: a, id: 1}]\n" + wanted).ok());
}

// Who asks for bounds is told why there are none, and so is who expects one that a command line,
// not the file, has taken away.
TEST(EmptyExpectation, NoBoundIsGivenWhereTheAnalysisDoesNotHold) {
  const std::string two =
      "duration: 2 ms\nnodes: [{name: a, lowest_buffer_first: true}, {name: b}]\nanalysis: true\n"
      "traffic: [{node: a, id: 1, period: 1 ms}, {node: a, id: 2, period: 1 ms}]\n";
  Scenario scenario = parse_scenario("test.yaml", two);
  scenario.expect.within_bound = true;
  const RunReport report = run_scenario(scenario, 500e3);
  const std::string why = "node 'a' has 'lowest_buffer_first'";
  for (const MessageReport &message : report.messages) EXPECT_FALSE(message.bound);
  EXPECT_EQ(report.analytic_load, 0);
  EXPECT_EQ(verdict(report, "within_bound"), "FAIL none: " + why);
  EXPECT_THAT(to_text(report), HasSubstr("  no bound: " + why + "\n"));
  EXPECT_EQ(to_json(report)["no_bound"], why);
}

// A frame that has waited for longer than it may is late, although it has no response time.
TEST(EmptyExpectation, FramesThatNeverLeaveAreLate) {
  const std::string cut =
      "duration: 20 ms\nnodes: [{name: a}, {name: b}, {name: c}]\n"
      "traffic: [{node: a, name: m, id: 1, period: 1 ms}]\n"
      "faults: [{kind: cut, node: a, from: 3 ms}]\n";
  const RunReport report =
      run_text(cut + "expect: {response_times: {m: 1 ms}, within_bound: true}\n");
  EXPECT_EQ(report.messages.at(0).sent, 3U);
  EXPECT_THAT(to_text(report),
              HasSubstr("FAIL  response of m: a frame waits for 37.032 ms (expected at most the "));
  EXPECT_THAT(to_text(report), HasSubstr("37.032 ms (expected at most 1.000 ms)"));
  EXPECT_THAT(verdict(run_text(cut + "expect: {response_times: {m: 38 ms}}\n"), "response of m"),
              StartsWith("ok 0."));
}

// A bus that is stuck is one error frame without end, and fully loaded.
TEST(EmptyExpectation, AStuckBusIsNoQuietOne) {
  const RunReport report = run_text(
      "duration: 10 ms\nnodes: [{name: a}, {name: b}, {name: c}]\n"
      "traffic: [{node: a, id: 0x100, data: '01', period: 1 ms}]\n"
      "faults: [{kind: short, node: c, from: 500 us}]\n"
      "expect: {error_frames: 0, load: {max: 90}}\n");
  EXPECT_EQ(verdict(report, "error_frames"), "FAIL 1");
  EXPECT_THAT(verdict(report, "load in per cent"), HasSubstr("FAIL 98."));
}

TEST(EmptyExpectation, AMessageThatNeverLeavesIsNotWithinItsBound) {
  const RunReport report = run_text(
      "duration: 1 ms\ndrain: 0\nnodes: [{name: a}]\ntraffic: [{node: a, name: m, id: 1}]\n"
      "expect: {within_bound: true}\n");
  EXPECT_EQ(verdict(report, "response of m"), "FAIL not sent");
}

}  // namespace
}  // namespace vericansim
