// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenarios on whole cores: the report must say what the passive decoder, the frame codec and
// arithmetic say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "harness/shell.hpp"
#include "model/frame_codec.hpp"
#include "session/runner.hpp"
#include "trace/log.hpp"
#include "trace/vcd_file.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

RunReport run_text(const std::string &text, double bitrate = 500e3) {
  return run_scenario(parse_scenario("test.yaml", text), bitrate);
}

std::string failures(const RunReport &report) {
  std::string text;
  for (const CheckResult &check : report.checks)
    if (!check.ok) text += check.what + ": " + check.seen + " (expected " + check.wanted + ")\n";
  return text;
}

class Example : public ::testing::TestWithParam<const char *> {};

// Every shipped example meets its own expectations (the SAE set: see below).
TEST_P(Example, MeetsItsExpectations) {
  const Scenario scenario = read_scenario(std::string("examples/") + GetParam());
  for (const double bitrate : scenario.bitrates) {
    const RunReport report = run_scenario(scenario, bitrate);
    EXPECT_FALSE(report.checks.empty()) << bitrate;
    EXPECT_EQ(failures(report), "") << bitrate;
  }
}
INSTANTIATE_TEST_SUITE_P(All, Example,
                         ::testing::Values("two-nodes.yaml", "arbitration.yaml",
                                           "sixteen-nodes.yaml", "faults.yaml", "retry.yaml",
                                           "bridge.yaml"));

// Messages of a node with one identifier: each has the times of its own frames, also where both
// hold the same and the second is queued when the first has just left.
TEST(OneIdentifier, EachMessageHasItsFrames) {
  for (const std::string data : {"02", "01"})
    for (const Time offset : {5'000, 93, 94, 95, 96, 97, 98, 99, 100, 101, 102, 103, 104}) {
      const RunReport report = run_text(
          "duration: 10 ms\nnodes: [{name: a}, {name: b}]\ntraffic:\n"
          "  - {node: a, id: 1, name: late, data: '01', offset: " +
          std::to_string(offset) + " us}\n  - {node: a, id: 1, name: soon, data: '" + data +
          "'}\n");
      ASSERT_EQ(report.messages.size(), 2U);
      for (const MessageReport &message : report.messages) {
        EXPECT_EQ(message.sent, 1U) << message.name << " " << offset;
        EXPECT_GT(message.shortest, 100 * kMicrosecond) << message.name << " " << offset;
        EXPECT_LT(message.longest, 400 * kMicrosecond) << message.name << " " << offset;
      }
    }
}

// All 17 messages queued at the same moment: no response beyond the bound of Davis et al. at any of
// the four rates.
TEST(Sae, NoResponseIsLongerThanItsBound) {
  Scenario scenario = read_scenario("examples/sae-class-c.yaml");
  scenario.duration = 40 * kMillisecond;
  ASSERT_EQ(scenario.bitrates.size(), 4U);
  for (const double bitrate : scenario.bitrates) {
    const RunReport report = run_scenario(scenario, bitrate);
    EXPECT_EQ(failures(report), "") << bitrate;
    for (const MessageReport &message : report.messages) {
      ASSERT_TRUE(message.bound.has_value());
      EXPECT_GE(message.sent, 1U) << message.name;
    }
  }
}

// One frame of known length: the response time is its length (and the way from the registers to the
// wire).
TEST(Run, ResponseTimeIsTheLengthOfTheFrame) {
  const RunReport report = run_text(
      "duration: 2 ms\nnodes: [{name: a}, {name: b}]\n"
      "traffic: [{node: a, name: m, id: 0x555, data: 55 55 55 55 55 55 55 55}]\n"
      "expect: {frames: 1, complete: true}\n");
  EXPECT_EQ(failures(report), "");
  const Frame frame{0x555, false, false, 8, {0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55}};
  const auto bits = static_cast<Time>(encode_frame(frame).bits.size());
  const Time shortest = bits * 2 * kMicrosecond;
  EXPECT_GE(report.messages.at(0).longest, shortest);
  EXPECT_LE(report.messages.at(0).longest,
            shortest + 8 * kMicrosecond);  // IF-13: at most two bits and the accesses
  EXPECT_NEAR(report.load * static_cast<double>(report.duration),
              static_cast<double>((bits + 3) * 2 * kMicrosecond), 2e6);
}

TEST(Run, FailedExpectationsAreReported) {
  const RunReport report = run_text(
      "duration: 1 ms\nnodes: [{name: a}, {name: b}]\ntraffic: [{node: a, name: m, id: 1}]\n"
      "expect: {frames: 2, nodes: {a: {tec: 8, state: passive}}, response_times: {m: 1 us}}\n");
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.checks.size(), 4U);
  for (const CheckResult &check : report.checks) EXPECT_FALSE(check.ok) << check.what;
}

// What was to be done, and has not been when the run ends, has not been found to be right.
TEST(Run, WhatIsNotReachedFails) {
  const std::string nodes =
      "duration: 2 ms\ndrain: 1 ms\nnodes: [{name: a}, {name: p, type: remote, number: 3}]\n";
  const auto only_check = [&](const std::string &text) {
    const RunReport report = run_text(nodes + text);
    EXPECT_EQ(report.checks.size(), 1U) << text;
    return report.checks.empty() ? CheckResult{} : report.checks[0];
  };
  const std::pair<const char *, const char *> cases[] = {
      {"accesses: [{node: a, at: 9 ms, do: [check MCR 1 1]}]", "a: check MCR 0x1 0x1"},
      {"accesses: [{node: a, at: 2500 us, do: [check MCR 1 1]}]", "a: check MCR 0x1 0x1"},
      {"accesses: [{node: a, at: 9 ms, do: [write ECR 1, check MCR 1 1]}]", "a: write ECR 0x1"},
      {"accesses: [{node: a, at: 1 ms, do: [until MCR 0x100000 0x100000, check MCR 1 1]}]",
       "a: until MCR 0x100000 0x100000"},
      {"accesses: [{node: a, at: 1 ms, do: [until MCR 0x100000 0x100000]},\n"
       "           {node: a, at: 1100 us, do: [read MCR]}]",
       "a: until MCR 0x100000 0x100000"},
      {"commands: [{node: a, at: 9 ms, do: [read 3 0x20 1]}]", "a: read 3 0x20 1"},
      {"commands: [{node: a, at: 9 ms, period: 1 ms, do: [trigger]}]", "a: trigger"},
      {"user: [{node: p, at: 9 ms, write: {0x20: 05}}]", "p: user at 9.000 ms"},
      {"user: [{node: p, after: apply, write: {0x20: 05}}]", "p: user after apply"}};
  for (const auto &[text, what] : cases) {
    const CheckResult check = only_check(text);
    EXPECT_FALSE(check.ok) << text;
    EXPECT_EQ(check.what, what);
    EXPECT_EQ(check.seen, "not until the end");
  }
  // One that is left by an `if` is done.
  EXPECT_EQ(run_text(nodes + "accesses: [{node: a, do: [if MCR 0x100000 0x100000, check MCR 1 0]}]")
                .checks.size(),
            0U);
}

// The seed moves the frames of a message with jitter, but not their number: also a frame whose
// event lies just before the end is queued before it.
TEST(Run, EveryEventHasItsFrame) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const RunReport report =
        run_text("seed: " + std::to_string(seed) +
                 "\nduration: 2.1 ms\nnodes: [{name: a}, {name: b}]\ntraffic:\n"
                 "  - {node: a, name: m, id: 2, period: 1 ms, jitter: 990 us}\n"
                 "  - {node: a, name: once, id: 1, jitter: 1000 s}\n"
                 "expect: {frames: 4, pending: 0}\n");
    EXPECT_EQ(failures(report), "") << seed;
  }
}

// Runs of several seeds are samples of their own: no message has the random numbers that another
// one has with the next seed.
TEST(Run, SeedsHaveNothingInCommon) {
  std::set<std::array<std::uint8_t, 8>> seen;
  constexpr unsigned kSeeds = 4, kMessages = 3;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const RunReport report = run_text("seed: " + std::to_string(seed) +
                                      "\nduration: 2 ms\nnodes: [{name: a}, {name: b}]\ntraffic:\n"
                                      "  - {node: a, id: 1, data: random}\n"
                                      "  - {node: a, id: 2, data: random}\n"
                                      "  - {node: b, id: 3, data: random}\n");
    for (const auto &[key, row] : report.identifiers.rows()) seen.insert(row.last_frame.data);
  }
  EXPECT_EQ(seen.size(), kSeeds * kMessages);
}

// A message that was never queued has shown nothing; a shorter run may leave it out.
TEST(Run, AMessageThatIsNeverQueuedIsTold) {
  const std::string text =
      "duration: 5 ms\nnodes: [{name: a}, {name: b}]\n"
      "traffic: [{node: a, name: m, id: 1, period: 1000 s, offset: random}]\n";
  const RunReport unexpected = run_text(text);
  EXPECT_TRUE(unexpected.ok());
  EXPECT_THAT(to_text(unexpected), HasSubstr("  warning: m was never queued\n"));
  const RunReport expected = run_text(text + "expect: {}\n");
  EXPECT_EQ(failures(expected), "m was queued: never (expected at least once)\n");
  EXPECT_THAT(to_text(expected), ::testing::Not(HasSubstr("warning")));
  Scenario shorter = parse_scenario("test.yaml", text + "expect: {}\n");
  shorter.cut_short = true;
  const RunReport left_out = run_scenario(shorter, 500e3);
  EXPECT_TRUE(left_out.ok());
  EXPECT_THAT(to_text(left_out), ::testing::Not(HasSubstr("warning")));
}

/// Times at which a text signal of a VCD file becomes `value`, ns.
std::vector<Time> times_of_text(const std::string &file, const std::string &value) {
  std::ifstream in{file};
  std::vector<Time> times;
  Time now = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) now = std::stoll(line.substr(1));
    if (line.starts_with("s" + value + " ")) times.push_back(now);
  }
  return times;
}

// A core that its CPU starts late, and stops for a while, has bits from then on, and none in
// between.
TEST(Run, WaveformsBeginABitOfANodeWhenItRuns) {
  const std::string file = ::testing::TempDir() + "late.vcd";
  const RunReport report = run_text(
      "duration: 30 ms\nnodes: [{name: a}, {name: late, software: none}]\naccesses:\n"
      "  - {node: late, at: 10 ms, do: [clear MCR 0x80000000, until MCR 0x100000 0,\n"
      "                                 write CTRL1 0x00710005, clear MCR 0x50000000]}\n"
      "  - {node: late, at: 15 ms, do: [set MCR 0x50000000]}\n"
      "  - {node: late, at: 20 ms, do: [clear MCR 0x50000000]}\n"
      "outputs: {vcd: " +
      file + "}\n");
  EXPECT_EQ(failures(report), "");
  const std::vector<Time> times = times_of_text(file, "INTEGRATING");
  ASSERT_EQ(times.size(), 3U);  // node a, and late twice
  constexpr Time kMs = 1'000'000, kJoin = kMs / 2;
  for (const auto &[time, at] : {std::pair{times[1], 10 * kMs}, std::pair{times[2], 20 * kMs}}) {
    EXPECT_GE(time, at);
    EXPECT_LT(time, at + kJoin);
  }
}

// FC-18: a lone transmitter ends at TEC 128 and never goes bus-off.
TEST(Run, FC_18_LoneTransmitter) {
  const RunReport report = run_text(
      "duration: 20 ms\ndrain: 0\nnodes: [{name: alone}]\ntraffic: [{node: alone, id: 1}]\n"
      "expect: {frames: 0, pending: 1, nodes: {alone: {tec: 128, state: passive, bus_off: 0, sent: "
      "0}}}\n");
  EXPECT_EQ(failures(report), "");
  EXPECT_EQ(report.nodes.at(0).counts.by_kind[3],
            report.nodes.at(0).counts.errors);  // ACK errors only
}

TEST(Run, SaturatedMessagesFillTheBus) {
  const RunReport report = run_text(
      "duration: 10 ms\nnodes: [{name: a, clock: 16 MHz}, {name: b, clock: 16 MHz}]\n"
      "traffic: [{node: a, id: 0x10, data: counter, period: saturated}, {node: b, id: 0x20, data: "
      "random, period: saturated}]\n"
      "expect: {load: {min: 97}, error_frames: 0, complete: true}\n");
  EXPECT_EQ(failures(report), "");
}

TEST(Run, FiltersChooseWhatTheSoftwareSees) {
  const RunReport report = run_text(
      "duration: 4 ms\nnodes: [{name: a}, {name: b, filters: [{id: 0x100, mask: 0x7F0}]}]\n"
      "traffic: [{node: a, id: 0x105, data: 01}, {node: a, id: 0x115, data: 02, offset: 1 ms}]\n"
      "expect: {frames: 2, nodes: {b: {received: 1}}}\n");
  EXPECT_EQ(failures(report), "");
}

TEST(Run, ListenOnlyNodesHearAndSaySilence) {
  const RunReport report = run_text(
      "duration: 4 ms\nnodes: [{name: a}, {name: b}, {name: ear, listen_only: true}]\n"
      "traffic: [{node: a, id: 0x105, data: 01, period: 1 ms}]\n"
      "expect: {frames: 4, complete: true, nodes: {ear: {received: 4, sent: 0}}}\n");
  EXPECT_EQ(failures(report), "");
}

// MO-02: on a bus without a pause one bit that only the listener sees wrong costs it one frame.
TEST(Run, AListenerLosesOneFrameForOneError) {
  constexpr const char *kFields[] = {"ID", "DATA", "CRC"};
  std::string faults;
  for (int n = 0; n < 20; ++n) {
    if (n != 0) faults += ", ";
    faults += "{kind: flip, node: ear, at: {node: a, frame: " + std::to_string(25 + 50 * n) +
              ", field: " + kFields[n % 3] + ", bit: " + std::to_string((7 * n) % 11) +
              ", stuff: false}}";
  }
  const RunReport report = run_text(
      "duration: 260 ms\nseed: 5\n"
      "nodes: [{name: a}, {name: b}, {name: ear, mailboxes: 16, listen_only: true}]\n"
      "traffic: [{node: a, id: 0x2A5, dlc: 8, data: random, period: saturated, count: 1000}]\n"
      "faults: [" +
      faults +
      "]\n"
      "expect: {frames: 1000, error_frames: 0, nodes: {b: {received: 1000, errors: 0},\n"
      "         ear: {received: 980, errors: 20}}}\n");
  EXPECT_EQ(failures(report), "");
}

TEST(Run, RunsAreRepeatable) {
  Scenario scenario = read_scenario("examples/faults.yaml");
  scenario.duration = 46 * kMillisecond;  // behind the beginnings of all faults
  const auto first = to_json(run_scenario(scenario, 500e3));
  const auto second = to_json(run_scenario(scenario, 500e3));
  EXPECT_EQ(first["nodes"], second["nodes"]);
  EXPECT_EQ(first["messages"], second["messages"]);
}

/// A run with all outputs; the frames in the order of the bus.
class WrittenFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    Scenario scenario = parse_scenario(
        "test.yaml",
        "duration: 8 ms\nnodes: [{name: left, ppm: 200}, {name: right, clock: 16 MHz, ppm: -200, "
        "phase: 11 ns}]\n"
        "traffic:\n  - {node: left, id: 0x123, data: counter, dlc: 3, period: 2 ms}\n"
        "  - {node: right, id: 0x1ABCDEF0, extended: true, data: random, period: 3 ms, offset: 1 "
        "ms}\n"
        "  - {node: right, id: 0x7F0, remote: true, offset: 0.5 ms}\n"
        "faults: [{kind: flip, node: left, at: {node: left, frame: 2, field: CRC, bit: 1}}]\n");
    const std::string stem = ::testing::TempDir() + "all";
    scenario.outputs.vcd = stem + ".vcd";
    scenario.outputs.fst = stem + ".fst";
    scenario.outputs.candump = stem + ".log";
    scenario.outputs.pcap = stem + ".pcap";
    report_ = run_scenario(scenario, 500e3);
    outputs_ = scenario.outputs;
    log_ = read_log(outputs_.candump);
  }
  RunReport report_;
  Outputs outputs_;
  CanLog log_;
};

TEST_F(WrittenFiles, LogAndCaptureHoldTheSameFrames) {
  const CanLog pcap = read_log(outputs_.pcap);
  ASSERT_EQ(log_.entries.size(), report_.frames);
  ASSERT_EQ(pcap.entries.size(), report_.frames);
  for (std::size_t i = 0; i < log_.entries.size(); ++i)
    EXPECT_EQ(log_.entries[i].frame, pcap.entries[i].frame);
}

TEST_F(WrittenFiles, WaveformDecodesToTheSameFrames) {
  for (const char *signal : {"bus.can", "left.rx", "right.rx"}) {
    const WaveDecodeResult decoded = decode_wave(outputs_.vcd, {signal, std::nullopt, 800});
    EXPECT_DOUBLE_EQ(decoded.bitrate, 500e3);
    std::vector<Frame> frames;
    std::size_t errors = 0;
    for (const BusEvent &event : decoded.events) {
      if (event.kind == BusEventKind::kFrame) frames.push_back(event.frame);
      if (event.kind == BusEventKind::kErrorFrame) ++errors;
    }
    ASSERT_EQ(frames.size(), log_.entries.size()) << signal;
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i], log_.entries[i].frame);
    EXPECT_EQ(errors, 1U) << signal;
  }
}

TEST_F(WrittenFiles, WaveformNamesFieldsRolesAndErrors) {
  const std::string text = read_text_file(outputs_.vcd);
  for (const char *name : {"sSOF ", "sID ", "sCRC ", "sERROR_FLAG ", "sTRANSMITTING ",
                           "sRECEIVING ", "sERROR_ACTIVE "})
    EXPECT_THAT(text, HasSubstr(name));
}

// GTKWave's own tools must read both files and give the same wire.
TEST_F(WrittenFiles, GtkwaveReadsBothFiles) {
  if (!has_program("fst2vcd") || !has_program("vcd2fst"))
    GTEST_SKIP() << "GTKWave's tools are not installed";
  ASSERT_EQ(std::system(("fst2vcd " + outputs_.fst + " > " + outputs_.fst + ".vcd").c_str()), 0);
  ASSERT_EQ(std::system(("vcd2fst " + outputs_.vcd + " " + outputs_.vcd + ".fst").c_str()), 0);
  const VcdFile from_fst{outputs_.fst + ".vcd"}, vcd{outputs_.vcd};
  std::vector<std::pair<Time, Level>> a, b;
  from_fst.read(from_fst.find("bus.can"), [&](Time t, Level l) { a.emplace_back(t / 1000, l); });
  vcd.read(vcd.find("bus.can"), [&](Time t, Level l) { b.emplace_back(t / 1000, l); });
  EXPECT_GT(a.size(), 100U);
  EXPECT_EQ(a, b);
}

/// One line of sigrok's annotations for a frame: identifier, DLC, data.
std::string sigrok_words(const Frame &frame) {
  std::ostringstream text;
  if (frame.extended)
    text << "Full Identifier: " << frame.id << " (0x" << std::hex << frame.id << std::dec << ")\n";
  else
    text << "Identifier: " << frame.id << " (0x" << std::hex << frame.id << std::dec << ")\n";
  text << "Data length code: " << static_cast<int>(frame.dlc) << "\n";
  for (unsigned i = 0; i < frame.payload_size(); ++i) {
    char byte[40];
    std::snprintf(byte, sizeof byte, "Data byte %u: 0x%02x\n", i, frame.data[i]);
    text << byte;
  }
  return text.str();
}

/// What sigrok's CAN decoder says about a signal of the waveform.
std::string sigrok(const std::string &vcd, const std::string &signal, int bitrate) {
  return shell("sigrok-cli -i " + vcd + " -I vcd:downsample=50 -P can:can_rx=" + signal +
               ":nominal_bitrate=" + std::to_string(bitrate) + ":sample_point=80" +
               " -A can=id:full-id:dlc:data 2> /dev/null | sed 's/^can-1: //'")
      .text;
}

// An outside judge: sigrok's CAN decoder. It knows no error frames, so this run has none; and it
// takes the DLC of a remote frame for data, so remote frames have DLC 0.
TEST(Sigrok, SeesTheSameFrames) {
  if (!has_program("sigrok-cli")) GTEST_SKIP() << "sigrok-cli is not installed";
  Scenario scenario = parse_scenario(
      "test.yaml",
      "bitrate: 250k\nduration: 30 ms\nnodes: [{name: left, ppm: 200}, {name: right, ppm: -200, "
      "phase: 11 ns}]\n"
      "traffic:\n  - {node: left, id: 0x000, data: 00 00 00 00 00 00 00 00, period: 5 ms}\n"
      "  - {node: left, id: 0x7FF, data: FF FF FF FF FF FF FF FF, period: 5 ms, offset: 1 ms}\n"
      "  - {node: right, id: 0x1FFFFFFF, extended: true, data: random, dlc: 5, period: 4 ms, "
      "offset: 2 ms}\n"
      "  - {node: right, id: 0x078, data: 01 E1 E1 E1 E1 E1 E1 E1, period: 5 ms, offset: 3 ms}\n"
      "  - {node: right, id: 0x123, data: random, dlc: 0, period: 7 ms, offset: 0.1 ms}\n");
  scenario.outputs.vcd = ::testing::TempDir() + "sigrok.vcd";
  scenario.outputs.candump = ::testing::TempDir() + "sigrok.log";
  const RunReport report = run_scenario(scenario, 250e3);
  ASSERT_GT(report.frames, 25U);
  std::string wanted;
  for (const LogEntry &entry : read_log(scenario.outputs.candump).entries)
    wanted += sigrok_words(entry.frame);
  std::string seen = sigrok(scenario.outputs.vcd, "can", 250000);
  // For extended frames sigrok also prints the first eleven bits by themselves.
  std::istringstream lines{seen};
  std::string kept, line, previous;
  while (std::getline(lines, line)) {
    if (line.rfind("Full Identifier", 0) == 0 && !previous.empty())
      kept.erase(kept.size() - previous.size() - 1);
    kept += line + "\n";
    previous = line;
  }
  EXPECT_EQ(kept, wanted);
}

}  // namespace
}  // namespace vericansim
