// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: what is read, and that every mistake is named with its line, value and what is
// allowed.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "scenario/scenario.hpp"
#include "scenario/scenario_warnings.hpp"
#include "simulation/expectations.hpp"
#include "simulation/node_timing.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Quantity, NumbersWithUnits) {
  EXPECT_EQ(parse_frequency("8 MHz"), 8e6);
  EXPECT_EQ(parse_frequency("8000000"), 8e6);
  EXPECT_EQ(parse_bitrate("500k"), 500e3);
  EXPECT_EQ(parse_bitrate("1 Mbit/s"), 1e6);
  EXPECT_EQ(parse_time("10 ms"), 10 * kMillisecond);
  EXPECT_EQ(parse_time("0.5us"), 500 * kNanosecond);
  EXPECT_EQ(parse_time("0"), 0);
  EXPECT_EQ(parse_length("40 m"), 40.0);
  EXPECT_EQ(parse_part("87.5 %"), 0.875);
  EXPECT_EQ(parse_part("95 %"), 0.95);
  EXPECT_EQ(parse_length("29 cm"), 0.29);
  EXPECT_EQ(parse_integer("0x7FF"), 0x7FFU);
  EXPECT_EQ(parse_integer("0b101"), 5U);
}

TEST(Quantity, EverythingElseIsRefused) {
  for (const char *text : {"", " ", "MHz", "8 mhz", "8 MHz x", "nan", "inf", "1e999", "--1"})
    EXPECT_FALSE(parse_frequency(text)) << text;
  EXPECT_FALSE(parse_time("10"));  // no unit
  EXPECT_FALSE(parse_time("1e30 s"));
  EXPECT_FALSE(parse_integer("0x"));
  EXPECT_FALSE(parse_integer("-1"));
  EXPECT_FALSE(parse_integer("010"));  // eight, ten or sixteen?
  EXPECT_FALSE(parse_integer("00"));
  EXPECT_EQ(parse_integer("0"), 0U);
  EXPECT_EQ(parse_integer("0x010"), 16U);
  EXPECT_FALSE(parse_integer("99999999999999999999"));
}

TEST(Quantity, NumbersInMessagesHaveTheirDigits) {
  EXPECT_EQ(plain_number(0), "0");
  EXPECT_EQ(plain_number(-0.0), "0");
  EXPECT_EQ(plain_number(-std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(plain_number(1e6), "1000000");
  EXPECT_EQ(plain_number(-12'345'678'901'234), "-12345678901234");
  EXPECT_EQ(plain_number(87.5), "87.5");
  EXPECT_EQ(plain_number(100.0 / 3), "33.33333333");
  const double none = std::numeric_limits<double>::infinity();
  const auto expected = [](Range range) { return check_number("frames", 1, range).wanted; };
  EXPECT_EQ(expected({1'234'567, 1'234'567}), "1234567");
  EXPECT_EQ(expected({1'234'567, none}), "at least 1234567");
  EXPECT_EQ(expected({-none, 1'234'567}), "at most 1234567");
  EXPECT_EQ(expected({1'234'567, 2'000'000}), "1234567 to 2000000");
  EXPECT_EQ(check_number("frames", 20'000'000'000, {0, 1}).seen, "20000000000");
}

constexpr const char *kGood = R"(name: all keys
bitrate: [125k, 500k]
sample_point: 80 %
duration: 5 ms
drain: 1 ms
seed: 3
analysis: true
nodes:
  - name: a
    clock: 16 MHz
    ppm: -50
    phase: 3 ns
    wander: {kind: sine, ppm: 10, period: 2 ms}
    cable: 10 m
    tx_delay: 50 ns
    rx_delay: 60 ns
    bitrate: 500k
    timing: {brp: 2, prop: 5, ps1: 4, ps2: 6, sjw: 3}
    mailboxes: 32
    tx_buffers: 4
    listen_only: false
    filters:
      - {id: 0x100, mask: 0x700}
      - {id: 0x10000000, extended: true}
  - {name: b, sample_point: 0.75, sjw: 1, bitrate: 250k, bus_off_recovery: never}
traffic:
  - {node: a, name: m, id: 0x123, data: 01 A5, period: 1 ms, offset: 0.1 ms, jitter: 10 us,
     count: 7}
  - {node: b, id: 0x1FFFFFFF, extended: true, data: [1, 2, 3, 4, 5, 6, 7, 0xFF], dlc: 15}
  - {node: b, id: 5, remote: true, dlc: 8, period: saturated}
faults:
  - {kind: flip, node: b, at: {node: a, frame: 2, field: ack del, bit: 0, first_tq: 3, last_tq: 9}}
  - {kind: dominant, node: all, from: 1 ms, for: 4 us}
  - {kind: noise, per_bit: 0.001, node: a}
expect:
  frames: {min: 1, max: 99}
  complete: true
  nodes: {a: {tec: 0, state: active}, all: {bus_off: 0}}
  response_times: {m: 2 ms}
outputs: {vcd: a.vcd}
)";

// What is received replaces the identifier in its buffer (flexcan.md 3.5).
TEST(ScenarioFile, FiltersThatDoNotStayAreWarnedOf) {
  const auto warnings = [](const std::string &keys) {
    return warnings_of(parse_scenario(
        "s.yaml", "nodes: [{name: a, filters: [{id: 1}, {id: 2, extended: true" + keys + "}]}]\n"));
  };
  EXPECT_THAT(warnings(", match_format: false"),
              ElementsAre("filters[1] of 'a' may take other frames behind its first base frame, "
                          "which has none of the last 18 bits of 'mask'"));
  EXPECT_THAT(warnings(""), IsEmpty());
  EXPECT_THAT(warnings(", match_format: false, mask: 0x1FFC0000"), IsEmpty());
}

TEST(ScenarioFile, EveryKeyIsUnderstood) {
  const Scenario s = parse_scenario("s.yaml", kGood);
  EXPECT_EQ(s.bitrates, (std::vector<double>{125e3, 500e3}));
  ASSERT_EQ(s.nodes.size(), 2U);
  EXPECT_EQ(s.nodes[0].clock.frequency_hz, 16e6);
  EXPECT_EQ(s.nodes[0].clock.wander, Wander::kSine);
  EXPECT_EQ(s.nodes[0].link.cable, 50 * kNanosecond);  // 5 ns/m
  EXPECT_EQ(s.nodes[0].timing, (BitTiming{2, 5, 4, 6, 3}));
  EXPECT_EQ(s.nodes[0].host.filters.at(1).mask, 0x1FFFFFFFU);
  EXPECT_EQ(s.nodes[1].sample_point, 0.75);
  EXPECT_TRUE(s.nodes[1].host.boff_rec);
  ASSERT_EQ(s.traffic.size(), 3U);
  EXPECT_EQ(s.traffic[0].frame, (Frame{0x123, false, false, 2, {0x01, 0xA5}}));
  EXPECT_EQ(s.traffic[1].frame, (Frame{0x1FFFFFFF, true, false, 15, {1, 2, 3, 4, 5, 6, 7, 0xFF}}));
  EXPECT_EQ(s.traffic[1].name, "1FFFFFFF");
  EXPECT_TRUE(s.traffic[2].saturated);
  ASSERT_EQ(s.faults.size(), 3U);
  EXPECT_EQ(s.faults[0].place.field, Field::kAckDel);
  EXPECT_EQ(s.faults[0].watched, 0U);
  EXPECT_EQ(s.faults[0].node, 1U);
  EXPECT_EQ(s.faults[1].window.to, kMillisecond + 4 * kMicrosecond);
  EXPECT_EQ(s.expect.nodes.size(), 3U);
  EXPECT_EQ(s.expect.response_times.at("m"), 2 * kMillisecond);
  EXPECT_EQ(s.outputs.vcd, "a.vcd");
}

TEST(ScenarioFile, BitTimingOfANode) {
  const Scenario s = parse_scenario("s.yaml", kGood);
  EXPECT_EQ(timing_of(s, s.nodes[0], 500e3), (BitTiming{2, 5, 4, 6, 3}));
  const BitTiming calculated = timing_of(s, s.nodes[1], 500e3);  // its own 250 kbit/s and 75 %
  EXPECT_EQ(calculated.clocks_per_bit(), 32U);
  EXPECT_EQ(calculated.ps2 * 4, calculated.quanta());
}

// A bit rate that comes from elsewhere is held against the timing of a node too.
TEST(ScenarioFile, TimingOfANodeFitsTheRateOfTheRun) {
  const Scenario s = parse_scenario(
      "s.yaml", "nodes:\n  - {name: a, timing: {brp: 1, prop: 6, ps1: 6, ps2: 3, sjw: 3}}\n");
  EXPECT_EQ(timing_of(s, s.nodes[0], 500e3).clocks_per_bit(), 16U);
  EXPECT_EQ(timing_of(s, s.nodes[0], 503e3).clocks_per_bit(), 16U);  // 0.6 % off, 0.73 % may be
  try {
    static_cast<void>(timing_of(s, s.nodes[0], 505e3));
    FAIL() << "no error";
  } catch (const InputError &error) {
    EXPECT_THAT(error.what(), HasSubstr("s.yaml:2: node 'a': timing gives 500000 bit/s"));
  }
}

struct Mistake {
  const char *name;
  const char *text;
  const char *message;
};

const char *const kTwo = "nodes: [{name: a}, {name: b}]\n";

class ScenarioMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(ScenarioMistake, IsNamedInOneLine) {
  const Mistake &mistake = GetParam();
  std::string text = mistake.text;
  if (text.rfind("nodes:", 0) != 0 && text.find("\nnodes:") == std::string::npos)
    text = kTwo + text;
  try {
    const Scenario s = parse_scenario("s.yaml", text);
    static_cast<void>(timing_of(s, s.nodes.at(0), s.bitrates.at(0)));
    FAIL() << "no error";
  } catch (const InputError &error) {
    EXPECT_THAT(error.what(), HasSubstr(mistake.message));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ScenarioMistake,
    ::testing::Values(
        Mistake{"NoYaml", "nodes: [", "s.yaml:1: no valid YAML"},
        Mistake{"NoMap", "nodes: 5", "s.yaml:1: nodes: '5' is not allowed; allowed: a map"},
        Mistake{"EmptyNodes", "nodes: []", "no node is given"},
        Mistake{"UnknownKey", "bitrat: 500k\n",
                "s.yaml:2: unknown key 'bitrat'; allowed: accesses, analysis, bitrate, "},
        Mistake{"TwiceAKey", "seed: 1\nseed: 2\n", "s.yaml:3: key 'seed' is given twice"},
        Mistake{"BitrateTwice", "bitrate: [500k, 250k, 500000]\n",
                "s.yaml:2: bitrate[2]: is there twice; allowed: each bit rate once"},
        Mistake{"Bitrate", "bitrate: 2M\n",
                "s.yaml:2: bitrate: '2M' is not allowed; allowed: 1 kbit/s to 1 Mbit/s"},
        Mistake{"ZeroInFront", "traffic: [{node: a, id: 010}]\n",
                "s.yaml:2: traffic[0].id: '010' is not allowed; allowed: 0 to 2047"},
        Mistake{
            "FiltersInAllBuffers",
            "nodes:\n  - {name: a, mailboxes: 16, filters: [{id: 1}, {id: 2}, {id: 3}, {id: 4}, "
            "{id: 5}, {id: 6}, {id: 7}, {id: 8}, {id: 9}, {id: 10}, {id: 11}, {id: 12}, "
            "{id: 13}, {id: 14}, {id: 15}, {id: 16}]}\n",
            "s.yaml:2: nodes[0]: 1 transmit and 16 receive buffers are more than the 16 of the "
            "node"},
        Mistake{"Duration", "duration: 10\n", "duration: '10' is not allowed; allowed: 1 us to"},
        Mistake{"NodeName", "nodes:\n  - {name: a}\n  - {name: a}\n",
                "s.yaml:3: nodes[1]: node name 'a' is used twice"},
        Mistake{"SaturatedTwice",
                "traffic:\n  - {node: a, id: 1, name: m, period: saturated}\n"
                "  - {node: b, id: 1, name: n}\n  - {node: a, id: 0x1, name: o}\n",
                "s.yaml:5: traffic[2]: one of message 'm' in line 3 and this one is saturated, and "
                "both have one identifier"},
        Mistake{"Segment",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 9, ps1: 1, ps2: 2, sjw: 1}}\n",
                "timing.prop: '9' is not allowed; allowed: 1 to 8"},
        Mistake{"Quanta",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 8, ps1: 8, ps2: 8, sjw: 1}, "
                "bitrate: 320k, clok: 1}\n",
                "unknown key 'clok'"},
        Mistake{"NoPrescaler",
                "nodes:\n  - {name: a, timing: {brp: 0, prop: 8, ps1: 4, ps2: 3, sjw: 1}}\n",
                "timing.brp: '0' is not allowed; allowed: 1 to 256"},
        Mistake{"LargePrescaler",
                "nodes:\n  - {name: a, timing: {brp: 257, prop: 8, ps1: 4, ps2: 3, sjw: 1}}\n",
                "timing.brp: '257' is not allowed; allowed: 1 to 256"},
        Mistake{"LongPs1",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 8, ps1: 9, ps2: 3, sjw: 1}}\n",
                "timing.ps1: '9' is not allowed; allowed: 1 to 8"},
        Mistake{"ShortPs2",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 8, ps1: 4, ps2: 1, sjw: 1}}\n",
                "timing.ps2: '1' is not allowed; allowed: 2 to 8"},
        Mistake{"NoSjw",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 8, ps1: 4, ps2: 3, sjw: 0}}\n",
                "timing.sjw: '0' is not allowed; allowed: 1 to 4"},
        Mistake{"LongSjw", "nodes: [{name: a, sjw: 5}]\n",
                "sjw: '5' is not allowed; allowed: 1 to 4"},
        Mistake{"EarlySample", "nodes: [{name: a, sample_point: 49 %}]\n",
                "sample_point: '49 %' is not allowed; allowed: 50 % to 90 %"},
        Mistake{"LateSample", "sample_point: 0.91\n",
                "sample_point: '0.91' is not allowed; allowed: 50 % to 90 %"},
        Mistake{"FewQuanta",
                "nodes:\n  - {name: a, timing: {brp: 2, prop: 2, ps1: 2, ps2: 2, sjw: 1}}\n",
                "s.yaml:2: nodes[0].timing: 7 time quanta a bit are not allowed; allowed: 8 to 25"},
        Mistake{"SjwAbovePs2",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 6, ps1: 6, ps2: 3, sjw: 4}}\n",
                "s.yaml:2: nodes[0].timing.sjw: 4 is above ps1 or ps2; allowed: 1 to 3"},
        Mistake{"SjwAbovePs1",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 8, ps1: 2, ps2: 5, sjw: 3}}\n",
                "s.yaml:2: nodes[0].timing.sjw: 3 is above ps1 or ps2; allowed: 1 to 2"},
        Mistake{"OtherRate",
                "nodes:\n  - {name: a, timing: {brp: 2, prop: 6, ps1: 6, ps2: 3, sjw: 3}}\n",
                "s.yaml:2: nodes[0].timing: gives 250000 bit/s from 8000000 Hz; allowed: 500000 "
                "bit/s within 0.73 %"},
        Mistake{"OneOfTheRates",
                "bitrate: [500k, 250k]\n"
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 6, ps1: 6, ps2: 3, sjw: 3}}\n",
                "s.yaml:3: nodes[0].timing: gives 500000 bit/s from 8000000 Hz; allowed: 250000"},
        Mistake{"NotItsOwnRate",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 6, ps1: 6, ps2: 3, sjw: 3}, "
                "bitrate: 250k}\n",
                "gives 500000 bit/s from 8000000 Hz; allowed: 250000"},
        Mistake{"TimingAndSamplePoint",
                "nodes:\n  - {name: a, timing: {brp: 1, prop: 6, ps1: 6, ps2: 3, sjw: 3},\n"
                "     sample_point: 80 %}\n",
                "s.yaml:3: nodes[0].sample_point: 'timing' is given too; allowed: one of them"},
        Mistake{
            "TimingAndSjw",
            "nodes:\n  - {name: a, timing: {brp: 1, prop: 6, ps1: 6, ps2: 3, sjw: 3}, sjw: 1}\n",
            "nodes[0].sjw: 'timing' is given too; allowed: one of them"},
        Mistake{"CableAndDelay", "nodes:\n  - {name: a, cable: 5 m,\n     delay: 20 ns}\n",
                "s.yaml:3: nodes[0].delay: 'cable' is given too; allowed: one of them"},
        Mistake{"Mailboxes", "nodes: [{name: a, mailboxes: 20}]", "allowed: 16, 32, 64"},
        Mistake{"ImpossibleRate", "bitrate: 1M\nnodes:\n  - {name: slow, clock: 4 MHz}\n",
                "s.yaml:3: node 'slow': no setting of 8 to 25 quanta gives 1000000 bit/s"},
        Mistake{"WhichNode", "traffic: [{node: c, id: 1}]",
                "traffic[0].node: 'c' is not allowed; allowed: the name of a node: a, b"},
        Mistake{"IdTooLarge", "traffic: [{node: a, id: 0x800}]",
                "traffic[0].id: '0x800' is not allowed; allowed: 0x0 to 0x7FF"},
        Mistake{"CountInDecimal", "traffic: [{node: a, id: 1, count: 0}]",
                "'0' is not allowed; allowed: 1 to 1000000000"},
        Mistake{"TimeInPlainDigits", "duration: 0 ms", "allowed: 1 us to 100000 s, as in"},
        Mistake{"NoNodeName", "nodes: [{name: \"\"}]",
                "nodes[0].name: '' is not allowed; allowed: a name of at least one letter"},
        Mistake{"NameOfTwoLines", "nodes: [{name: \"a\\nb\"}]",
                "allowed: a name without control characters"},
        Mistake{"TitleThatRings", "name: \"\\a\"",
                "name: a control character is in it; allowed: a name without"},
        Mistake{"MessageWithATab", "traffic: [{node: a, id: 1, name: \"x\\ty\"}]",
                "traffic[0].name: a control character"},
        Mistake{"NoId", "traffic: [{node: a}]", "key 'id' is missing; given: 'node'"},
        Mistake{"ResponsesOfNothing", "expect: {response_times: {x: 1 ms}}",
                "expect.response_times: unknown key 'x'; allowed: none"},
        Mistake{"FrameInParts", "expect: {frames: 3.5}",
                "expect.frames: '3.5' is not allowed; allowed: a whole number"},
        Mistake{"HitsInParts", "faults: [{kind: cut, node: a, hits: 0.5}]", "a whole number"},
        Mistake{"CounterInParts", "expect: {nodes: {a: {tec: 0.5}}}", "a whole number"},
        Mistake{"NineBytes", "traffic: [{node: a, id: 1, data: 01 02 03 04 05 06 07 08 09}]",
                "up to 8 bytes"},
        Mistake{"RemoteData", "traffic: [{node: a, id: 1, remote: true, data: 01}]",
                "a remote frame has no data"},
        Mistake{"DlcAgainstData", "traffic: [{node: a, id: 1, data: 01, dlc: 3}]",
                "3 does not fit the 1 bytes of data"},
        Mistake{"JitterAbovePeriod", "traffic: [{node: a, id: 1, period: 1 ms, jitter: 1 ms}]",
                "below the period"},
        Mistake{"NameTwice", "traffic: [{node: a, id: 1}, {node: b, id: 1}]",
                "message name '001' is used twice"},
        Mistake{"FaultKind", "faults: [{kind: explode}]",
                "allowed: flip, dominant, recessive, cut, short, clock, noise"},
        Mistake{"FaultField", "faults: [{kind: flip, at: {node: a, field: HEAD}}]",
                "'HEAD' is not allowed; allowed: INTEGRATING"},
        Mistake{"FaultNode", "faults: [{kind: cut}]", "key 'node' is missing"},
        Mistake{"FaultTimes", "faults: [{kind: dominant, from: 2 ms, to: 1 ms}]",
                "faults[0].to: '1 ms' is not allowed"},
        Mistake{"FaultTwoEnds", "faults: [{kind: dominant, from: 1 ms, to: 2 ms, for: 1 ms}]",
                "faults[0].for: either 'to' or 'for', not both"},
        Mistake{"FaultBit",
                "faults:\n  - kind: flip\n    at:\n      node: a\n      field: DLC\n      bit: 4\n",
                "s.yaml:7: faults[0].at.bit: '4' is not allowed; allowed: 0 to 3: DLC has 4 bits"},
        Mistake{"FaultBitOfOne", "faults: [{kind: flip, at: {node: a, field: IDE, bit: 1}}]",
                "'1' is not allowed; allowed: 0: IDE has 1 bit"},
        Mistake{"FaultDataBit", "faults: [{kind: flip, at: {node: a, field: DATA, bit: 64}}]",
                "allowed: 0 to 63: DATA has 64 bits at most"},
        Mistake{"FaultBitsLeft", "faults: [{kind: flip, at: {node: a, field: EOF, bits_left: 7}}]",
                "at.bits_left: '7' is not allowed; allowed: 0 to 6: EOF has 7 bits"},
        Mistake{"FaultIdleLeft", "faults: [{kind: flip, at: {node: a, field: IDLE, bits_left: 1}}]",
                "at.bits_left: '1' is not allowed; allowed: 0"},
        Mistake{"FaultBothEnds",
                "faults: [{kind: flip, at: {node: a, field: CRC, bit: 3, bits_left: 12}}]",
                "at.bits_left: '12' is not allowed; allowed: 11, behind bit 3 of the 15 of CRC"},
        Mistake{"FaultEndsTooNear",
                "faults: [{kind: flip, at: {node: a, field: CRC, bit: 3, bits_left: 10}}]",
                "at.bits_left: '10' is not allowed; allowed: 11, behind bit 3 of the 15 of CRC"},
        Mistake{
            "FaultDataEnds",
            "faults: [{kind: flip, at: {node: a, field: DATA, bit: 3, bits_left: 3}}]",
            "at.bits_left: bit 3 with 3 bits left makes 7 bits of data; allowed: 8, 16, ... 64"},
        Mistake{"FaultStuff", "faults: [{kind: flip, at: {node: a, field: ACK, stuff: true}}]",
                "at.stuff: ACK has no stuff bits; allowed: ID to CRC"},
        Mistake{"FaultEarlyStuff",
                "faults: [{kind: flip, at: {node: a, field: ID, bit: 3, stuff: true}}]",
                "no stuff bit comes before bit 3 of ID; allowed: bit 4 or later"},
        Mistake{"FaultLateStuff",
                "faults: [{kind: flip, at: {node: a, field: ID, bits_left: 7, stuff: true}}]",
                "no stuff bit comes before bit 3 of ID; allowed: bit 4 or later"},
        Mistake{"FaultQuanta", "faults: [{kind: flip, at: {node: a, first_tq: 5, last_tq: 4}}]",
                "at.last_tq: '4' is not allowed; allowed: 5 to 24"},
        Mistake{"FaultSilentNoise", "faults: [{kind: noise, per_bit: 0}]",
                "noise without 'per_bit' and 'glitches_per_ms' changes nothing"},
        Mistake{"FaultSameClock", "faults: [{kind: clock, node: b, ppm: 0}]",
                "faults[0].ppm: the clock of 'b' has 0 ppm already"},
        Mistake{"FaultSameClockLater",
                "faults: [{kind: clock, node: b, from: 1 ms, ppm: 5}, {kind: clock, node: b, from: "
                "2 ms, ppm: 5}]",
                "faults[1].ppm: the clock of 'b' has 5 ppm already"},
        Mistake{"FaultClockTwice",
                "faults: [{kind: clock, node: b, from: 1 ms, ppm: 5}, {kind: clock, node: b, from: "
                "1 ms, ppm: 7}]",
                "faults[1]: the clock of 'b' has a fault at that time already, of 5 ppm"},
        Mistake{"FaultClockEnd", "faults: [{kind: clock, node: b, ppm: 5, to: 1 ms}]",
                "unknown key 'to'; allowed: from, hits, kind, name, node, ppm"},
        Mistake{"FaultName",
                "faults:\n  - {kind: short, node: a, name: cut 2}\n  - {kind: cut, node: a}\n",
                "s.yaml:4: faults[1]: fault name 'cut 2' is used twice"},
        Mistake{"FaultNoName", "faults: [{kind: short, node: a, name: ''}]", "faults[0].name: ''"},
        Mistake{"FaultHits", "faults: [{kind: short, node: a, hits: some}]",
                "faults[0].hits: 'some'"},
        Mistake{"Expectation", "expect: {nodes: {c: {tec: 0}}}",
                "unknown key 'c'; allowed: a, all, b"},
        Mistake{"RangeUpsideDown", "expect: {frames: {min: 2, max: 1}}", "min is above max"},
        Mistake{"AListForANumber", "seed: [1, 2]\n", "a list is not allowed"},
        Mistake{"SecondDocument", "seed: 1\n---\nexpect: {frames: 99}\n",
                "s.yaml:4: a second document begins here; allowed: one in a file"},
        Mistake{"BehindTheEnd", "seed: 1\n...\nexpect: {frames: 99}\n",
                "s.yaml:4: a second document begins here"},
        Mistake{"VacuousCheck", "accesses: [{node: a, do: [check MCR 0xF 0x1F]}]",
                "VALUE 0x1F has bits outside MASK, which nobody would look at; allowed: bits of "
                "0xF"},
        Mistake{"ByteOfMemoryTwice",
                "nodes: [{name: a}, {name: p, type: remote, memory: {0x40: 01, 64: 02}}]",
                "memory.64: byte 0x40 is given already; allowed: each byte once"},
        Mistake{"ByteOfMemoryInAnother",
                "nodes: [{name: a}, {name: p, type: remote, memory: {0x41: FF, 0x40: 01 02}}]",
                "memory.0x40: byte 0x41 is given already"},
        Mistake{"ByteWrittenTwice",
                "nodes: [{name: a}, {name: p, type: remote}]\n"
                "user: [{node: p, write: {0x40: 01, 0x040: 02}}]",
                "write.0x040: byte 0x40 is given already"},
        Mistake{"OutputWithoutName", "outputs: {vcd: ''}",
                "outputs.vcd: '' is not allowed; allowed: the name of a file"}),
    [](const auto &item) { return std::string(item.param.name); });

// Every bit that the rule book gives a field may be named (FF-01 to FF-12, IF-01, IF-08, EF-08).
TEST(ScenarioFile, EveryBitOfAFieldMayBeNamed) {
  const std::pair<const char *, unsigned> kLengths[] = {
      {"SOF", 1},       {"ID", 11},           {"RTR", 1},     {"IDE", 1},
      {"EXID", 18},     {"EXRTR", 1},         {"R1", 1},      {"R0", 1},
      {"DLC", 4},       {"CRC", 15},          {"CRC_DEL", 1}, {"ACK", 1},
      {"ACK_DEL", 1},   {"EOF", 7},           {"INT", 3},     {"SUSPEND", 8},
      {"DELIMITER", 7}, {"OVERLOAD_FLAG", 6}, {"DATA", 64}};
  const auto read = [](const char *field, unsigned bit, unsigned left) {
    static_cast<void>(parse_scenario(
        "s.yaml", fmt::format("{}faults: [{{kind: flip, at: {{node: a, field: {}, bit: {}, "
                              "bits_left: {}}}}}]\n",
                              kTwo, field, bit, left)));
  };
  for (const auto &[field, length] : kLengths)
    for (unsigned bit = 0; bit < length; ++bit) {
      EXPECT_NO_THROW(read(field, bit, length - 1 - bit)) << field << bit;
      EXPECT_THROW(read(field, bit, length - bit), InputError) << field << bit;
    }
}

TEST(ScenarioFile, ADocumentMayHaveItsMarks) {
  const std::string text = std::string(kTwo) + "seed: 7\n";
  for (const std::string &marked : {"---\n" + text, text + "...\n", text + "---\n# no more\n"})
    EXPECT_EQ(parse_scenario("s.yaml", marked).seed, 7U) << marked;
}

// Counters as registers show them; the page allows integers in three ways.
TEST(ScenarioFile, ExpectedCountsMayBeHexadecimal) {
  const Scenario s = parse_scenario(
      "s.yaml", std::string(kTwo) +
                    "traffic: [{node: a, id: 1}]\n"
                    "expect: {frames: 0b101, nodes: {a: {tec: 0x80, max_tec: {max: 0x88}}}}\n");
  EXPECT_TRUE(s.expect.numbers.at("frames").contains(5));
  ASSERT_EQ(s.expect.nodes.size(), 1U);
  EXPECT_EQ(s.expect.nodes[0].numbers.at("tec").least, 128);
  EXPECT_EQ(s.expect.nodes[0].numbers.at("tec").most, 128);
  EXPECT_EQ(s.expect.nodes[0].numbers.at("max_tec").most, 136);
}

// A listener has the name of an interface; a truth value is none.
TEST(ScenarioFile, MonitorIsATruthValueOrAnInterface) {
  const Scenario s = parse_scenario(
      "s.yaml", "nodes: [{name: a}, {name: b, monitor: yes}, {name: c, monitor: off}]");
  ASSERT_EQ(s.nodes.size(), 3U);
  EXPECT_TRUE(s.nodes[1].host.listen_only);
  EXPECT_FALSE(s.nodes[2].host.listen_only);
}

// Whatever is done to a good file, it is read or refused, and nothing else happens.
TEST(ScenarioFile, DamagedInputNeverCrashes) {
  const std::string good = kGood;
  for (std::size_t at = 0; at < good.size(); at += 7)
    for (const char byte : {'\0', ':', '[', '{', '}', '-', '&', '*', '"', '\n', '9', '\xFF'}) {
      std::string bad = good;
      bad[at] = byte;
      for (const std::string &text : {bad, good.substr(0, at)}) {
        try {
          static_cast<void>(parse_scenario("s.yaml", text));
        } catch (const InputError &error) {
          EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
      }
    }
}

}  // namespace
}  // namespace vericansim
