// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures of the bus where it is not plain: who has sent a frame, how busy the bus was, what was
// repeated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "session/runner.hpp"
#include "session/session.hpp"

namespace vericansim {
namespace {

RunReport run_text(const std::string &text) {
  return run_scenario(parse_scenario("test.yaml", text), 500e3);
}

std::string failures(const RunReport &report) {
  std::string text;
  for (const CheckResult &check : report.checks)
    if (!check.ok) text += check.what + ": " + check.seen + " (expected " + check.wanted + ")\n";
  return text;
}

const std::string kThree = "nodes: [{name: a}, {name: b}, {name: c}]\n";

// ---- Load

// A frame whose CRC nobody holds against it has its own length, and no more.
TEST(Load, CountsAFrameWithAWrongCrcOnce) {
  const RunReport report = run_text(
      "duration: 20 ms\nnodes: [{name: a}, {name: b, listen_only: true}]\n"
      "traffic: [{node: a, name: m, id: 0x100, data: 01}]\n"
      "faults: [{kind: flip, node: all, at: {node: a, field: CRC, bit: 14}}]\n");
  EXPECT_GT(report.error_frames, 100U);
  EXPECT_GT(report.load, 0.3);
  EXPECT_LE(report.load, 1.0);
}

TEST(Load, IsAtMostAllOfTheTimeUnderNoise) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const RunReport report = run_text(
        "duration: 15 ms\nseed: " + std::to_string(seed) +
        "\nnodes: [{name: a}, {name: b, clock: 24 MHz}, {name: c, clock: 16 MHz}]\ntraffic:\n"
        "  - {node: a, name: m, id: 0x100, data: counter, period: 500 us}\n"
        "  - {node: b, name: n, id: 0x200, data: counter, period: 500 us}\n"
        "faults: [{kind: noise, per_bit: 0.03}]\n");
    EXPECT_GT(report.load, 0.1) << seed;
    EXPECT_LE(report.load, 1.0) << seed;
  }
}

// The flag of an overload frame lies where the intermission would have been.
TEST(Load, IsAtMostAllOfTheTimeWithOverloadFrames) {
  const RunReport report =
      run_text("duration: 20 ms\ndrain: 0\n" + kThree +
               "traffic: [{node: a, name: m, id: 0x100, dlc: 0, period: saturated}]\n"
               "faults: [{kind: flip, node: b, at: {node: b, field: INT, bit: 0}}]\n");
  EXPECT_GT(report.overload_frames, 100U);
  EXPECT_GT(report.load, 0.9);
  EXPECT_LE(report.load, 1.0);
}

// IF-01: intermission comes behind error frames as behind frames, so that a bus that is never free
// is full, but for the first frame's way to the bus and the bits behind the last one.
TEST(Load, IsAllOfTheTimeOnAFullBusWithErrors) {
  std::string faults;
  for (int frame = 9; frame < 1000; frame += 9)
    faults += "  - {kind: flip, at: {node: a, frame: " + std::to_string(frame) +
              ", field: DATA, bit: 1}, hits: {min: 0}}\n";
  const RunReport report = run_text(
      "duration: 60 ms\ndrain: 0\n" + kThree +
      "traffic: [{node: a, name: m, id: 0x100, data: 00, period: saturated}]\nfaults:\n" + faults);
  EXPECT_GT(report.error_frames, 50U);
  EXPECT_GT(report.load, 0.998);
  EXPECT_LE(report.load, 1.0);
}

// A lone node at half the bit rate, whose frames nobody understands once all are error passive: the
// bus is held from SOF to eleven recessive bits behind the last dominant one. Of an attempt that
// are 98 bits and the stuff bits (none to 24) of the node, 11 of the bus; then it is quiet for the
// rest of ACK error, passive flag, delimiter, intermission and suspend, 27 bits of the node.
TEST(Load, GoesOnWhileNobodyUnderstandsTheBus) {
  const RunReport report = run_text(
      "duration: 100 ms\ndrain: 0\nnodes: [{name: a, bitrate: 250k}, {name: b}]\n"
      "traffic: [{node: a, name: m, id: 0x100, data: counter, period: saturated}]\n");
  EXPECT_EQ(report.frames, 0U);
  EXPECT_GT(report.load, (2 * 98 + 11) / (2 * (98 + 27.0)) - 0.02);
  EXPECT_LT(report.load, (2 * 122 + 11) / (2 * (122 + 27.0)) + 0.02);
}

// ---- Frames

// SY-08: a glitch in its PS2 moves the sender on by SJW, here both quanta of PS2. Its edges are
// then where the others sample, just before; they read them, and so must the decoder.
TEST(Frames, AreThoseThatTheNodesReadThoughBitsAreShorter) {
  const RunReport report = run_scenario(
      parse_scenario(
          "test.yaml",
          "duration: 5 ms\nnodes: [{name: a}, {name: b}]\n"
          "traffic: [{node: a, name: m, id: 0x100, data: 33 33 33 33, period: 1 ms}]\n"
          "faults: [{kind: dominant, at: {node: a, field: DATA, bit: 10, first_tq: 13, last_tq: "
          "13}, hits: 5}]\n"
          "expect: {frames: 5, error_frames: 0, complete: true, response_times: {m: 1 ms},\n"
          "         nodes: {a: {sent: 5}, b: {received: 5}, all: {errors: 0}}}\n"),
      250e3);
  EXPECT_EQ(failures(report), "");
}

// A frame that its sender took for acknowledged, and nobody has heard, is none of the bus. Later
// frames that hold the same keep their own times: 47 bits and 32 of data, 24 stuff bits at most.
TEST(Frames, ThatNobodyHasHeardDoNotMoveTheTimesOfOthers) {
  const RunReport report = run_text(
      "duration: 20 ms\n" + kThree +
      "traffic: [{node: a, name: m, id: 0x100, data: 01 02 03 04, period: 1 ms}]\nfaults:\n"
      "  - {kind: dominant, at: {node: a, frame: 4, field: ACK}}\n"
      "  - {kind: cut, node: a, from: 2950 us, for: 300 us}\n"
      "expect: {frames: 19, pending: 0, response_times: {m: 210 us}, nodes: {a: {sent: 20}}}\n");
  EXPECT_EQ(failures(report), "");
  EXPECT_EQ(report.messages.at(0).sent, 19U);
}

// ---- Senders

TEST(Sender, IsNotTheNodeInLoopBackThatSendsToItself) {
  for (const std::string nodes : {"nodes: [{name: a}, {name: b}, {name: l, loop_back: true}]\n",
                                  "nodes: [{name: l, loop_back: true}, {name: a}, {name: b}]\n"}) {
    const Scenario scenario = parse_scenario(
        "test.yaml", "duration: 10 ms\n" + nodes +
                         "traffic: [{node: a, name: real, id: 0x100, data: 01 02, period: 1 ms}]\n"
                         "expect: {frames: 10, response_times: {real: 1 ms}}\n");
    Session session{{{scenario, 500e3}}};
    session.start();
    Simulation &simulation = session.simulation();
    const auto loop = static_cast<NodeId>(nodes.find("{name: l") < nodes.find("{name: a") ? 0 : 2);
    std::uint64_t transmitters = 0;
    simulation.on_bus_frame = [&](const BusFrame &frame) { transmitters |= frame.transmitters; };
    for (Time at = 0; at < 5; ++at)
      simulation.bus().at(simulation.started() + at * kMillisecond, [&simulation, loop] {
        simulation.host(loop).send({.id = 0x100, .dlc = 2, .data = {1, 2}});
      });
    while (session.round()) {
    }
    const std::vector<RunReport> reports = session.finish();
    EXPECT_EQ(failures(reports.at(0)), "");
    EXPECT_EQ(reports.at(0).nodes.at(loop).counts.sent, 5U);
    EXPECT_EQ(transmitters, 1U << (loop == 0 ? 1 : 0));
  }
}

// AR-10: a remote frame of two nodes at once is one frame, and both have sent it.
TEST(Sender, AreBothWhoSendOneRemoteFrameTogether) {
  const RunReport report =
      run_text("duration: 10 ms\n" + kThree +
               "traffic:\n"
               "  - {node: a, name: ra, id: 0x100, remote: true, period: 1 ms}\n"
               "  - {node: b, name: rb, id: 0x100, remote: true, period: 1 ms}\n"
               "expect: {frames: 10, error_frames: 0, complete: true}\n");
  EXPECT_EQ(failures(report), "");
  for (const MessageReport &message : report.messages) EXPECT_EQ(message.sent, 10U) << message.name;
}

// An edge of a disturbance comes before the sender has sampled the end of the frame.
TEST(Sender, IsKnownThoughAnEdgeComesRightBehindTheFrame) {
  const RunReport report = run_text(
      "duration: 4 ms\nnodes: [{name: a}, {name: b, ppm: 800}, {name: c}]\n"
      "traffic: [{node: a, name: m, id: 0x100, data: 55, period: 1 ms}]\n"
      "faults: [{kind: dominant, node: all, from: 111600 ns, for: 1 us}]\n"
      "expect: {frames: 4, pending: 0, complete: true, response_times: {m: 500 us}}\n");
  EXPECT_EQ(failures(report), "");
  EXPECT_EQ(report.messages.at(0).sent, 4U);
}

// VA-03: valid for receivers, and repeated. Its transmitter does not receive it; b, which has seen
// an error in it, has one of the two.
TEST(Sender, OfAFrameThatItRepeatsNeedNotReceiveIt) {
  for (const std::string data : {"01", "counter"}) {
    const RunReport report = run_text(
        "duration: 10 ms\n" + kThree + "traffic: [{node: a, name: e, id: 0x100, data: " + data +
        ", period: 1 ms}]\nfaults:\n"
        "  - {kind: flip, node: b, at: {node: b, field: EOF, bit: 5, frame: 3}}\n"
        "  - {kind: flip, node: a, at: {node: a, field: EOF, bit: 6, frame: 5}}\n"
        "expect: {complete: true, frames: 12, nodes: {b: {received: 11}, c: {received: 12}}}\n");
    EXPECT_EQ(failures(report), "");
    EXPECT_EQ(report.messages.at(0).sent, 10U);
  }
}

// ---- Retries

TEST(Retries, LeaveOutTheFrameThatIsOnTheBusAtTheEnd) {
  const RunReport report = run_text(
      "duration: 10 ms\ndrain: 0\nnodes: [{name: a}, {name: b}]\n"
      "traffic: [{node: a, name: s, id: 0x123, data: 01 02 03 04 05 06 07 08, period: saturated}]\n"
      "expect: {error_frames: 0, nodes: {a: {retries: 0}}}\n");
  EXPECT_EQ(failures(report), "");
  EXPECT_GT(report.nodes.at(0).counts.attempts, report.nodes.at(0).counts.sent);
}

// ---- A run that is shorter than its scenario

TEST(ShorterRun, MissesNoFaultThatIsBehindIt) {
  Scenario scenario = parse_scenario(
      "test.yaml",
      "duration: 100 ms\nnodes: [{name: a}, {name: b}]\n"
      "traffic: [{node: a, name: m, id: 0x100, data: 55, period: 1 ms}]\n"
      "faults: [{kind: flip, node: b, from: 60 ms, for: 2 us}]\nexpect: {error_frames: 0}\n");
  scenario.duration = 10 * kMillisecond;
  scenario.cut_short = true;
  EXPECT_EQ(failures(run_scenario(scenario, 500e3)), "");
}

// ---- Filters

// By default frames of the other format are none of a filter's, and none replaces its identifier.
TEST(Filters, TellBaseFromExtendedFrames) {
  const RunReport report = run_text(
      "duration: 10 ms\nnodes:\n"
      "  - {name: a}\n"
      "  - {name: base, filters: [{id: 0x100}]}\n"
      "  - {name: ext, filters: [{id: 0x04000055, extended: true}]}\n"
      "  - {name: any, filters: [{id: 0x100, match_format: false}]}\n"
      "  - {name: request, filters: [{id: 0x100, remote: true}]}\n"
      "traffic:\n"
      "  - {node: a, name: e, id: 0x04000055, extended: true, data: 01, period: 2 ms}\n"
      "  - {node: a, name: s, id: 0x100, data: 02, offset: 3 ms}\n"
      "  - {node: a, name: r, id: 0x100, remote: true, offset: 5 ms}\n"
      "expect: {frames: 7, error_frames: 0, nodes: {base: {received: 2}, ext: {received: 5}, "
      "any: {received: 7}, request: {received: 1}}}\n");
  EXPECT_EQ(failures(report), "");
}

// ---- The judge of the wire

// Who is in loop-back is not on the bus, and who has sent a frame with another node has it.
TEST(Lockstep, AccusesNoHealthyNode) {
  const std::string loop =
      "judge: lockstep\nduration: 10 ms\n"
      "nodes: [{name: a}, {name: b}, {name: l, loop_back: true}]\n"
      "traffic: [{node: a, name: real, id: 0x100, data: 01 02, period: 1 ms}]\n"
      "accesses: [{node: l, at: 300 us, do: [write MB63.ID 0x08880000, "
      "write MB63.CS 0x0C010000]}]\n";
  const std::string together = "judge: lockstep\nduration: 10 ms\n" + kThree +
                               "traffic:\n"
                               "  - {node: a, name: ra, id: 0x100, remote: true, period: 1 ms}\n"
                               "  - {node: b, name: rb, id: 0x100, remote: true, period: 1 ms}\n";
  for (const std::string &text : {loop, together}) {
    const RunReport report = run_text(text);
    EXPECT_EQ(failures(report), "");
    ASSERT_TRUE(report.judged.has_value());
    EXPECT_EQ(report.judged->wire.exchanges, 10U);
    EXPECT_EQ(report.judged->wire.decoded, 10U);
  }
  EXPECT_EQ(run_text(loop).nodes.at(2).counts.sent, 1U);
}

}  // namespace
}  // namespace vericansim
