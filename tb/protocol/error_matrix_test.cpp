// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 19: the error injection matrix. One bit that the DUT sees inverted, anywhere, in every
// role and state, with every reaction of LT; the engine against the rule model bit by bit, until
// one further good frame has passed. The default is a sample; VERICAN_MATRIX=full runs all of it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>
#include <vector>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::to_delimiter;
using model_bench::whole;

// 19.1: start counters; half of them passive, by TEC, by REC or by both.
const std::vector<Counters> kCounters = {{0, 0},     {1, 1},     {95, 96},  {96, 95}, {119, 120},
                                         {120, 119}, {126, 0},   {127, 0},  {0, 127}, {128, 0},
                                         {0, 128},   {128, 128}, {247, 0},  {248, 0}, {255, 255},
                                         {0, 255},   {127, 126}, {247, 127}};

const std::vector<Frame> kFrames = {
    {.id = 0x123, .dlc = 1, .data = {0x55}},
    {.id = 0x078, .dlc = 8, .data = {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}},
    {.id = 0x009},
    {.id = 0x7E0, .remote = true, .dlc = 15},
    {.id = 0x00000000, .extended = true, .remote = true},
    {.id = 0x1F07C1F0, .extended = true, .dlc = 15, .data = {0xFF, 0, 0xFF, 0, 0x0F, 0x83, 0xE0}},
    {.id = 0x1FFFFFFF, .extended = true, .dlc = 1, .data = {0xF8}},
    {.id = 0x17, .remote = true, .dlc = 8}};

const Frame kNext{.id = 0x2A5, .dlc = 3, .data = {0xC3, 0x00, 0x7E}};

// What LT does after the disturbed bit: quiet; active flag in step with the DUT's; one bit later;
// longer by 1, 4, 8 and 16 bits; goes on with its frame ('>' stands for that).
const std::vector<std::string> kReactions = {
    "", "000000", "1000000", "0000000", "0000000000", "00000000000000", rep(22, "0"), ">"};

// Bits after EOF7 that belong to the positions: intermission, suspend time, two of idle.
constexpr unsigned kGap = 3 + 8 + 2;

struct Run {
  Frame frame;
  bool transmitter = false;
  Counters counters;
  unsigned position = 0;  // of the disturbed bit, SOF = 0
  std::string reaction;
  bool listen_only = false;
};

std::string describe(const Run &run) {
  return std::string{run.transmitter ? "T" : "R"} + " id " + std::to_string(run.frame.id) +
         (run.frame.extended ? "x" : "") + " dlc " + std::to_string(run.frame.dlc) + " TEC " +
         std::to_string(run.counters.tec) + " REC " + std::to_string(run.counters.rec) + " bit " +
         std::to_string(run.position) + " reaction '" + run.reaction + "'";
}

CoreConfig config_of(const Run &run) {
  CoreConfig config = CoreBench::default_config();
  config.listen_only = run.listen_only;
  return config;
}

// Until the bus is quiet and the DUT has nothing left to send; then one frame that must arrive.
void finish(ErrorRig &rig) {
  rig.bench.lt_acknowledges(true);
  rig.play(rep(40, "."));
  if (rig.last().bus_off) return;  // its recovery has tests of its own
  const auto quiet = [&] {
    const bool waits = rig.dut().pending() && !rig.dut().config().listen_only;
    return !waits && rig.field() == Field::kIdle;
  };
  ASSERT_TRUE(rig.bench.run_until(quiet, 400)) << "the DUT does not come to rest";
  const std::size_t before = rig.delivered();
  rig.receive(kNext);
  ASSERT_EQ(rig.delivered(), before + 1);
  EXPECT_EQ(rig.dut().received().back(), kNext);
}

// 19.5 item 4. Nothing but the frame itself is ever delivered (MX-06, MX-08).
void play(const Run &run) {
  SCOPED_TRACE(describe(run));
  ErrorRig rig(run.counters, config_of(run));
  rig.bench.lt_acknowledges(true);
  const std::string wire = whole(run.frame) + rep(kGap, "1");
  if (run.transmitter) {
    rig.send(run.frame);
    rig.play(rep(static_cast<int>(run.position), ".") + "!");
    rig.play(run.reaction == ">" ? "" : run.reaction);
  } else {
    rig.play(wire.substr(0, run.position) + (wire[run.position] == '0' ? "R" : "!"));
    rig.play(run.reaction == ">" ? wire.substr(run.position + 1) : run.reaction);
  }
  finish(rig);
  for (const Frame &frame : rig.dut().received()) {
    EXPECT_TRUE(frame == kNext || (!run.transmitter && frame == run.frame));
  }
}

// Every `stride`-th run of the whole, with a stride that has no factor in common with the sizes of
// the lists, so that all combinations of neighbouring columns turn up.
unsigned stride() {
  const char *mode = std::getenv("VERICAN_MATRIX");  // NOLINT(concurrency-mt-unsafe)
  return mode != nullptr && std::string_view{mode} == "full" ? 1 : 23;
}

struct Column {
  unsigned frame;
  bool transmitter;
};

void PrintTo(const Column &c, std::ostream *out) {
  *out << (c.transmitter ? "T_frame" : "R_frame") << c.frame;
}

std::vector<Column> columns() {
  std::vector<Column> all;
  for (unsigned frame = 0; frame < kFrames.size(); ++frame) {
    all.push_back({frame, true});
    all.push_back({frame, false});
  }
  return all;
}

class ErrorMatrix : public ::testing::TestWithParam<Column> {};

INSTANTIATE_TEST_SUITE_P(FramesAndRoles, ErrorMatrix, ::testing::ValuesIn(columns()));

// MX-01, MX-02, MX-03, MX-04, MX-05, MX-06, MX-07, MX-08, MX-09, MX-10, MX-11, MX-12, MX-13, MX-14,
// MX-15, MX-16, MX-19, MX-26, MX-27, MX-28, TH-02, TH-03, TH-05: any bit of a frame and of the gap.
TEST_P(ErrorMatrix, AnyBitOfAFrameInverted) {
  const Frame &frame = kFrames[GetParam().frame];
  const std::size_t positions = whole(frame).size() + kGap;
  const std::size_t runs = positions * kCounters.size() * kReactions.size();
  for (std::size_t i = GetParam().frame; i < runs; i += stride()) {
    play({.frame = frame,
          .transmitter = GetParam().transmitter,
          .counters = kCounters[i / kReactions.size() % kCounters.size()],
          .position = static_cast<unsigned>(i / kReactions.size() / kCounters.size()),
          .reaction = kReactions[i % kReactions.size()]});
    if (HasFailure()) return;
  }
}

// MX-24, MO-01, MO-02: the same as a listener: nothing sent, nothing counted, in step again.
TEST_P(ErrorMatrix, ListenerStaysSilentWhateverIsInverted) {
  if (GetParam().transmitter) return;
  const Frame &frame = kFrames[GetParam().frame];
  const std::size_t positions = whole(frame).size() + kGap;
  for (std::size_t i = 0; i < positions * kReactions.size(); i += (stride() + 6) / 7) {
    play({.frame = frame,
          .counters = kCounters[i % kCounters.size()],
          .position = static_cast<unsigned>(i / kReactions.size()),
          .reaction = kReactions[i % kReactions.size()],
          .listen_only = true});
    if (HasFailure()) return;
  }
}

// The bits of error handling: what leads there, as transmitter or as receiver, then `bits` quiet
// bits of which one is disturbed.
struct Handling {
  const char *name;
  bool transmitter;
  const char *before;  // script for a frame of GV-1, from its SOF
};

void PrintTo(const Handling &h, std::ostream *out) { *out << h.name; }

const std::vector<Handling> kHandlings = {
    {"AfterABitError", true, "......................!"},
    {"AfterAMissingAcknowledge", true, "............................................."},
    {"AfterAStuffErrorInArbitration", true, "00000000"},
    {"AfterAStuffError", false, "000000"},
    {"AfterAFormError", false, "0001001000110000010101010101010001101100011 1 0 0"},
    {"AfterACrcError", false, "0001001000110000010101010101010001101100010 1 0 1"},
    {"OverloadAfterAForeignFrame", false,
     "0001001000110000010101010101010001101100011 1 0 1 1111111 0"},
    {"OverloadAfterEof7", false, "0001001000110000010101010101010001101100011 1 0 1 1111110"},
    {"OverloadAfterAnOwnFrame", true,
     "........................................... . 0 . ....... 0"}};

class ErrorHandling : public ::testing::TestWithParam<Handling> {};

INSTANTIATE_TEST_SUITE_P(Stories, ErrorHandling, ::testing::ValuesIn(kHandlings));

void disturb_handling(const Handling &story, const Counters &counters, int position,
                      const std::string &reaction) {
  SCOPED_TRACE("TEC " + std::to_string(counters.tec) + " REC " + std::to_string(counters.rec) +
               " bit " + std::to_string(position) + " reaction '" + reaction + "'");
  ErrorRig rig(counters);
  if (story.transmitter) rig.send(kFrames[0]);
  rig.play(story.before);
  rig.play(rep(position, ".") + "!" + (reaction == ">" ? "" : reaction));
  finish(rig);
}

// MX-13, MX-17, MX-18, MX-19, MX-20, MX-21, MX-23, MX-29, MX-30, TH-05: flag, delimiter,
// intermission and suspend time of error and overload frames.
TEST_P(ErrorHandling, AnyBitOfTheErrorOrOverloadFrameInverted) {
  constexpr std::size_t kPositions = 6 + 8 + kGap;
  const std::size_t runs = kPositions * kCounters.size() * kReactions.size();
  for (std::size_t i = 0; i < runs; i += (stride() + 3) / 4) {
    disturb_handling(GetParam(), kCounters[i / kReactions.size() % kCounters.size()],
                     static_cast<int>(i / kReactions.size() / kCounters.size()),
                     kReactions[i % kReactions.size()]);
    if (HasFailure()) return;
  }
}

// MX-22: integration and bus-off: whatever comes, nothing on TX; 11 bits, or 128 times 11, end it.
TEST(OffTheBus, AnyBitInverted) {
  for (int n = 0; n <= 10; ++n) {
    CoreBench bench;
    Lockstep judge{bench};
    Assertions assertions{bench};
    bench.lt(rep(n, "1") + "0" + rep(40, "1"));
    judge.request(0, kFrames[0]);
    bench.dut().start();
    bench.run_bits(80);
    EXPECT_TRUE(judge.agrees()) << judge.report();
    EXPECT_TRUE(assertions.hold()) << assertions.report();
  }
  for (const int n : {0, 10, 11, 700, 1396, 1397, 1407, 1408, 1409}) {
    ErrorRig rig({.tec = 248});
    rig.send(kFrames[0]);
    rig.play("!" + rep(n, ".") + "0" + rep(1500, "."));
    EXPECT_FALSE(rig.last().bus_off) << n;
  }
}

class Pairs : public ::testing::TestWithParam<Counters> {};

INSTANTIATE_TEST_SUITE_P(States, Pairs, ::testing::ValuesIn(kCounters));

// MX-31, AK-03, FC-05a: no acknowledge, then dominant at the ACK delimiter (flag bit 1).
TEST_P(Pairs, NoAcknowledgeThenDominantDelimiter) {
  ErrorRig rig(GetParam());
  rig.send(kFrames[0]);
  rig.play(rep(45, ".") + "0");
  if (GetParam().tec < 248) {
    EXPECT_EQ(rig.tec(), GetParam().tec + 8u);  // active: at the slot; passive: in the flag
  }
  finish(rig);
}

// MX-31, FC-05b, PF-09: stuff error in the identifier, then the flag corrupted.
TEST_P(Pairs, StuffErrorInTheIdentifierThenCorruptedFlag) {
  for (int n = 0; n < 6; ++n) {
    ErrorRig rig(GetParam());
    rig.send({.id = 0x00F});
    rig.play(".....0" + rep(n, ".") + "!");
    if (GetParam().tec < 248) {
      EXPECT_EQ(rig.tec(), GetParam().tec + (GetParam().passive() ? 0u : 8u));
    }
    finish(rig);
  }
}

// MX-31, ED-11, ED-12, OV-04: dominant EOF7, then DEL8 of the overload frame, once and three times.
TEST_P(Pairs, DominantEof7ThenDel8) {
  for (const int times : {1, 3}) {
    ErrorRig rig(GetParam());
    rig.play(bits("0001001000110000010101010101010001101100011 1 0 1 1111110"));
    const unsigned rec = rig.rec();
    for (int n = 0; n < times; ++n) {
      EXPECT_EQ(rig.play("...... 1111111 0"), kOverloadFlag + kDelimiter);
    }
    EXPECT_EQ(rig.play("......"), kOverloadFlag);
    EXPECT_EQ(rig.rec(), rec);
    EXPECT_EQ(rig.delivered(), 1u);
    rig.play(rep(11, "."));
    finish(rig);
  }
}

// MX-31, IF-05, ED-11: a frame that starts at INT3 and whose EOF7 is dominant.
TEST_P(Pairs, StartAtInt3ThenDominantEof7) {
  ErrorRig rig(GetParam());
  rig.receive(kFrames[0]);
  rig.play("11" + whole(kNext).substr(0, whole(kNext).size() - 1) + "0");
  EXPECT_EQ(rig.delivered(), 2u);
  EXPECT_EQ(rig.play("......"), kOverloadFlag);
  rig.play(rep(11, "."));
  finish(rig);
}

// MX-31, AR-06, AR-07: an extended frame lost at SRR, to a base or (its SRR disturbed) to an
// extended winner.
TEST_P(Pairs, LossAtSrrThenEitherIde) {
  const Frame own{.id = 0x123 << 18 | 0x3FFFF, .extended = true};
  for (const bool extended : {false, true}) {
    ErrorRig rig(GetParam());
    rig.send(own);
    const Frame winner{.id = extended ? 0x123U << 18 : 0x123U, .extended = extended, .dlc = 1};
    EncodeOptions options;
    if (extended) options.srr = Level::kDominant;  // FF-05: receivers take either
    rig.play(whole(winner, options));
    EXPECT_EQ(rig.tec(), GetParam().tec);
    ASSERT_EQ(rig.delivered(), 1u);
    EXPECT_EQ(rig.dut().received()[0], winner);
    finish(rig);
    EXPECT_EQ(rig.sent(), 1u);
  }
}

}  // namespace
}  // namespace vericansim
