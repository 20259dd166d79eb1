// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults that can never hit: what is refused, and that nothing is refused that happens.
#include "simulation/fault_check.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "harness/input_error_of.hpp"
#include "simulation/simulation.hpp"
#include "timing/bittime.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// What is said against a scenario; "no error" if nothing.
std::string refusal(const std::string &text, double bitrate = 500e3) {
  return input_error_of([&] { check_faults(parse_scenario("s.yaml", text), bitrate); });
}

struct Impossible {
  const char *name;
  const char *text;
  const char *message;
};

const char *const kTwo = "nodes: [{name: a}, {name: b}]\n";
const char *const kBase = "traffic: [{node: a, id: 1, data: 01 02, period: 10 ms}]\n";

class ImpossibleFault : public ::testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleFault, IsRefusedWithItsLine) {
  const std::string text = std::string(kTwo) + GetParam().text;
  EXPECT_THAT(refusal(text), HasSubstr(GetParam().message));
  // The tool asks before it runs.
  EXPECT_THROW(Simulation(parse_scenario("s.yaml", text), 500e3), InputError);
}

INSTANTIATE_TEST_SUITE_P(
    All, ImpossibleFault,
    ::testing::Values(
        Impossible{"BehindTheEnd",
                   "duration: 5 ms\ndrain: 1 ms\nfaults:\n  - {kind: cut, node: a, from: 6 ms}\n",
                   "s.yaml:5: faults[0]: 'cut 1' can never hit: it begins at 6 ms, and the run is "
                   "over after 6 ms; allowed: 'from' below duration and drain, 6 ms"},
        Impossible{"ClockBehindTheEnd",
                   "duration: 5 ms\nfaults: [{kind: clock, node: a, ppm: 1, from: 1 s}]\n",
                   "it begins at 1000 ms"},
        Impossible{"SofOfAReceiver",
                   "traffic: [{node: a, id: 1, period: 1 ms}]\n"
                   "faults: [{kind: flip, name: x, at: {node: b, field: SOF}}]\n",
                   "'x' can never hit: SOF is a place of senders, and 'b' has no traffic"},
        Impossible{"SuspendOfAReceiver",
                   "traffic: [{node: a, id: 1, period: 1 ms}]\n"
                   "faults: [{kind: flip, at: {node: b, field: SUSPEND}}]\n",
                   "SUSPEND is a place of senders, and 'b' has no traffic"},
        Impossible{"Quanta",
                   "traffic: [{node: a, id: 1, period: 1 ms}]\n"
                   "faults: [{kind: flip, at: {node: b, field: CRC, first_tq: 20}}]\n",
                   "a bit of 'b' has 16 quanta at 500000 bit/s; allowed: first_tq 0 to 15"},
        Impossible{"ExtendedField",
                   "traffic: [{node: a, id: 1, period: 1 ms}]\n"
                   "faults: [{kind: flip, at: {node: b, field: EXID, bit: 2}}]\n",
                   "EXID is in extended frames, and none is sent"},
        Impossible{"ExtendedFields",
                   "traffic: [{node: a, id: 1, period: 1 ms}]\n"
                   "faults: [{kind: flip, at: {node: b, field: R1}}, {kind: flip, at: {node: b, "
                   "field: EXRTR}}]\n",
                   "faults[0]: 'flip 1' can never hit: R1 is in extended frames"},
        Impossible{"NoData",
                   "traffic: [{node: a, id: 1, remote: true, dlc: 8}, {node: b, id: 2}]\n"
                   "faults: [{kind: flip, at: {node: b, field: DATA}}]\n",
                   "no frame has data; allowed: traffic with data"},
        Impossible{"TooManyData",
                   "traffic: [{node: a, id: 1, data: 01 02}]\n"
                   "faults: [{kind: flip, at: {node: b, field: DATA, bit: 16}}]\n",
                   "no frame has such a bit of data; the longest data have 16 bits"},
        Impossible{"OtherData",
                   "traffic: [{node: a, id: 1, data: 01 02}]\n"
                   "faults: [{kind: flip, at: {node: b, field: DATA, bit: 0, bits_left: 7}}]\n",
                   "no frame has such a bit of data"},
        Impossible{"Frame",
                   "duration: 10 ms\n"
                   "traffic: [{node: a, id: 1, period: 2 ms, offset: 1 ms}, {node: b, id: 2}]\n"
                   "faults: [{kind: flip, at: {node: b, frame: 7}}]\n",
                   "frame 7 does not come; allowed: 1 to 6, all that is sent"},
        Impossible{"FrameAtTheEnd",
                   "duration: 10 ms\ntraffic: [{node: a, id: 1, period: 2 ms}]\n"
                   "faults: [{kind: flip, at: {node: b, frame: 6}}]\n",
                   "frame 6 does not come; allowed: 1 to 5"},
        Impossible{"TrafficAtTheEnd",
                   "duration: 10 ms\ntraffic: [{node: a, id: 1, offset: 10 ms}]\n"
                   "faults: [{kind: flip, at: {node: b, field: ID}}]\n",
                   "no frame is sent"},
        Impossible{"Silence", "faults: [{kind: flip, at: {node: b, field: ID}}]\n",
                   "no frame is sent; allowed: a scenario with traffic"}),
    [](const auto &item) { return std::string(item.param.name); });

TEST(ImpossibleFault, ACutNeedsAnotherNode) {
  EXPECT_THAT(refusal("nodes: [{name: a}]\nfaults: [{kind: cut, node: a}]\n"),
              HasSubstr("'a' is alone on the bus"));
}

TEST(ImpossibleFault, ANodeThatNobodyWorks) {
  const std::string bus =
      "nodes: [{name: a}, {name: b}, {name: c, software: none}]\n"
      "traffic: [{node: a, id: 1}]\nfaults: [{kind: flip, at: {node: c, field: ID}}]\n";
  EXPECT_THAT(refusal(bus), HasSubstr("nobody works 'c'"));
  EXPECT_EQ(refusal(bus + "accesses: [{node: c, do: read MCR}]\n"), "no error");
}

// Also where synchronisation may make a bit longer: within a frame by SJW, between frames by nearly
// a whole bit. Nobody can say which bit that will be.
TEST(ImpossibleFault, QuantaBehindTheBit) {
  const auto at = [](const char *field, unsigned first, unsigned last, const char *more = "") {
    return refusal(fmt::format(
        "nodes: [{{name: a, timing: {{brp: 2, prop: 2, ps1: 3, ps2: 2, sjw: 1}}}}, {{name: b}}]\n"
        "traffic: [{{node: b, id: 1}}]\n"
        "faults:\n  - {{kind: flip, at: {{node: a, field: {}, first_tq: {}, last_tq: {}}}}}\n{}",
        field, first, last, more));
  };
  for (const char *field : {"CRC", "IDLE"}) {
    EXPECT_EQ(at(field, 7, 8), "no error");
    EXPECT_EQ(at(field, 8, 8),
              "s.yaml:4: faults[0]: 'flip 1' begins behind the bit: a bit of 'a' has 8 quanta at "
              "500000 bit/s; allowed: first_tq 0 to 7");
  }
  // What registers say is not known before the run.
  EXPECT_EQ(at("CRC", 8, 8, "accesses: [{node: a, do: read MCR}]\n"), "no error");
}

// What makes it possible, one thing each.
TEST(PossibleFault, IsNotRefused) {
  const std::string place = "faults: [{kind: flip, at: {node: b, field: EXID}}";
  const std::string base = std::string(kTwo) + kBase;
  EXPECT_NE(refusal(base + place + "]\n"), "no error");
  EXPECT_EQ(refusal(base + place + ", {kind: flip, at: {node: b, field: IDE}}]\n"), "no error");
  EXPECT_EQ(refusal(base + place + ", {kind: cut, node: a}]\n"), "no error");
  EXPECT_EQ(refusal(base + place + ", {kind: noise, per_bit: 0.1}]\n"), "no error");
  EXPECT_EQ(refusal(base + place + "]\naccesses: [{node: b, do: read MCR}]\n"), "no error");
  EXPECT_EQ(refusal(std::string(kTwo) + "faults: [{kind: flip, at: {node: b, field: SOF}}]\n"
                                        "accesses: [{node: b, do: read MCR}]\n"),
            "no error");
  // A board may go on behind the end of the traffic.
  EXPECT_EQ(refusal("duration: 5 ms\nnodes: [{name: a}, {name: b, firmware: b.elf}]\n"
                    "faults: [{kind: cut, node: a, from: 6 s}]\n"),
            "no error");
  // Clocks and rates with which bits are misread.
  EXPECT_EQ(
      refusal("nodes: [{name: a}, {name: b, ppm: 9000}]\n" + std::string(kBase) + place + "]\n"),
      "no error");
  EXPECT_EQ(refusal("nodes: [{name: a}, {name: b, bitrate: 250k}]\n" + std::string(kBase) + place +
                    "]\n"),
            "no error");
  EXPECT_EQ(
      refusal("nodes: [{name: a, cable: 400 m}, {name: b}]\n" + std::string(kBase) + place + "]\n"),
      "no error");
}

TEST(PossibleFault, BehindTheTrafficOfABusWithoutEnd) {
  Scenario scenario = parse_scenario("s.yaml", "duration: 5 ms\n" + std::string(kTwo) +
                                                   "faults: [{kind: cut, node: a, from: 6 s}]\n");
  EXPECT_THROW(check_faults(scenario, 500e3), InputError);
  scenario.endless = true;
  EXPECT_NO_THROW(check_faults(scenario, 500e3));
}

// Below half of the timing's tolerance no bit is misread, whatever the other clock's error.
TEST(PossibleFault, ClocksOffByHalfTheTolerance) {
  BitTimingRequest request = bit_timing_request(8e6, 500e3);
  request.node_delay_ns = 0;
  const double tolerance = rate_bit_timing({1, 6, 6, 3, 3}, request).oscillator_tolerance;
  const int half = static_cast<int>(tolerance * 1e6 / 2);
  const auto with = [](int ppm) {
    return refusal(fmt::format(
        "nodes: [{{name: a}}, {{name: b, ppm: {}, timing: {{brp: 1, prop: 6, ps1: 6, ps2: 3, "
        "sjw: 3}}}}]\n{}faults: [{{kind: flip, at: {{node: b, field: EXID}}}}]\n",
        ppm, kBase));
  };
  EXPECT_THAT(with(half - 10), HasSubstr("EXID is in extended frames"));
  EXPECT_THAT(with(10 - half), HasSubstr("EXID is in extended frames"));
  EXPECT_EQ(with(half + 10), "no error");
  EXPECT_EQ(with(-half - 10), "no error");
}

// A user may look at the beginning of a scenario alone.
TEST(PossibleFault, AShorterRunIsNoMistake) {
  for (const std::string fault : {"{kind: flip, node: b, from: 60 ms, for: 2 us}",
                                  "{kind: flip, at: {node: a, frame: 9, field: CRC}}"}) {
    Scenario scenario = parse_scenario(
        "s.yaml", std::string{kTwo} + kBase + "duration: 100 ms\nfaults: [" + fault + "]\n");
    scenario.duration = 20 * kMillisecond;
    const auto said = [&] { return input_error_of([&] { check_faults(scenario, 500e3); }); };
    EXPECT_THAT(said(), HasSubstr("can never hit"));
    scenario.cut_short = true;
    EXPECT_EQ(said(), "no error");
  }
}

// Without an acknowledgement a frame is sent again and again.
TEST(PossibleFault, RetransmissionsAreFrames) {
  const std::string rest =
      "traffic: [{node: a, id: 1}]\nfaults: [{kind: flip, at: {node: a, frame: 9, field: CRC}}]\n";
  EXPECT_NE(refusal(kTwo + rest), "no error");
  EXPECT_EQ(refusal("nodes: [{name: a}]\n" + rest), "no error");
  EXPECT_EQ(refusal("nodes: [{name: a}, {name: b, listen_only: true}]\n" + rest), "no error");
  EXPECT_EQ(refusal("nodes: [{name: a}, {name: b, loop_back: true}]\n" + rest), "no error");
}

// ---- Nothing that happens is refused

/// Field, bit of it, bits left of it, whether it is a stuff bit, frame.
using Place = std::tuple<Field, unsigned, unsigned, bool, unsigned>;

/// Every place at which each node has been.
class Visits : public BusObserver {
 public:
  explicit Visits(unsigned nodes) : trackers_(nodes), seen_(nodes) {}
  [[nodiscard]] unsigned interests() const override { return kClocks; }
  void on_clock(NodeId node, Time, std::uint64_t word) override {
    PlaceTracker &at = trackers_[node];
    at.clocked(word);
    seen_[node].emplace(at.field(), at.index(), at.left(), at.stuff(), at.frame());
  }
  [[nodiscard]] const std::set<Place> &of(NodeId node) const { return seen_[node]; }

 private:
  std::vector<PlaceTracker> trackers_;
  std::vector<std::set<Place>> seen_;
};

class EveryPlace : public ::testing::TestWithParam<const char *> {};

// All places that nodes come to in an undisturbed run may be named. Receivers have many of them in
// common, so each is asked for once a node.
TEST_P(EveryPlace, ThatIsVisitedMayBeNamed) {
  const std::string bus = GetParam();
  const Scenario scenario = parse_scenario("s.yaml", bus);
  Simulation simulation{scenario, 500e3};
  Visits visits{static_cast<unsigned>(scenario.nodes.size())};
  simulation.join();
  simulation.start(simulation.bus().now());
  simulation.bus().add(visits);
  simulation.bus().run_for(scenario.duration);
  simulation.drain();
  std::size_t asked = 0;
  for (NodeId node = 0; node < scenario.nodes.size(); ++node)
    for (const auto &[field, index, left, stuff, frame] : visits.of(node)) {
      if (index > 127) continue;
      const std::string at =
          fmt::format("field: {}, bit: {}, bits_left: {}, stuff: {}{}", field_name(field), index,
                      left, stuff, frame == 0 ? "" : fmt::format(", frame: {}", frame));
      EXPECT_EQ(refusal(fmt::format("{}faults: [{{kind: flip, at: {{node: {}, {}}}}}]\n", bus,
                                    scenario.nodes[node].name, at)),
                "no error");
      ++asked;
    }
  EXPECT_GT(asked, 200U);
}

INSTANTIATE_TEST_SUITE_P(
    Buses, EveryPlace,
    ::testing::Values(
        "duration: 4 ms\nnodes: [{name: a}, {name: b, ppm: 300, clock: 16 MHz}]\n"
        "traffic: [{node: a, id: 0x100, data: FF FF 00, period: 2 ms}, {node: b, id: 0x10F, "
        "remote: true, dlc: 4}]\n",
        "duration: 3 ms\nnodes: [{name: a, cable: 5 m}, {name: b, cable: 5 m}]\n"
        "traffic: [{node: a, id: 0x1FFFFFFF, extended: true, data: random, dlc: 8}, {node: a, id: "
        "0, extended: true, data: 00 00}]\n",
        "duration: 2 ms\ndrain: 0\nnodes: [{name: a}]\ntraffic: [{node: a, id: 0x7FF}]\n",
        "duration: 2 ms\ndrain: 0\nnodes: [{name: a}, {name: b, listen_only: true}]\n"
        "traffic: [{node: a, id: 0x0F0, data: 0F}]\n"),
    [](const auto &item) { return "Bus" + std::to_string(item.index); });

}  // namespace
}  // namespace vericansim
