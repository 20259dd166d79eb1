// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 5 of the rule book: intermission, suspend transmission, idle and the start of a frame.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

const Frame kFirst = base_frame(0x2C5, {0x69});
const Frame kPending = base_frame(0x07F, {0x3C, 0xC3});
const Frame kForeign = extended_frame(0x1B1C5A93, {0x96});

// What came before the intermission: frames, errors and overloads, own and foreign (IF-07).
enum class Before {
  kOwnFrame,
  kOwnError,
  kOwnOverload,
  kForeignFrame,
  kForeignRejected,
  kForeignError,
  kForeignOverload,
  kLostArbitration,
};
constexpr const char *kBeforeNames[] = {"OwnFrame",        "OwnError",        "OwnOverload",
                                        "ForeignFrame",    "ForeignRejected", "ForeignError",
                                        "ForeignOverload", "LostArbitration"};

bool was_transmitter(Before before) { return before <= Before::kOwnOverload; }

void play_own_frame(Scene &scene) {
  scene.send(kFirst);
  scene.play(flipped(r_bits(wire(kFirst).size()), ack_offset(kFirst)));
}

// Leaves the scene where the next bit is INT1.
void play_before(Scene &scene, Before before) {
  const std::string overload = "0" + r_bits(6 + 8);
  switch (before) {
    case Before::kOwnFrame: play_own_frame(scene); break;
    case Before::kOwnError:
      scene.send(kFirst);
      scene.cancel();
      scene.play(r_bits(14));
      scene.bench.force_next(0, Effect::kFlip);
      scene.play("1" + r_bits(6 + 8));
      break;
    case Before::kOwnOverload:
      play_own_frame(scene);
      scene.play(overload);
      break;
    case Before::kForeignFrame: scene.play(wire(kFirst)); break;
    case Before::kForeignRejected: scene.play(wire_with_bad_crc(kFirst, 1) + r_bits(7)); break;
    case Before::kForeignError: scene.play(d_bits(6) + r_bits(6 + 8)); break;
    case Before::kForeignOverload: scene.play(wire(kFirst) + overload); break;
    case Before::kLostArbitration:
      scene.send(base_frame(0x7FF));
      scene.cancel();
      scene.play(wire(kFirst));
      break;
  }
}

class Interframe : public ::testing::TestWithParam<std::tuple<int, int>> {
 protected:
  Interframe() : scene_{counters()} { play_before(scene_, before()); }
  [[nodiscard]] static Before before() { return static_cast<Before>(std::get<0>(GetParam())); }
  [[nodiscard]] static const Counters &counters() { return kStates[std::get<1>(GetParam())]; }
  // IF-08, IF-09: due for a passive node that was transmitter.
  [[nodiscard]] static bool suspended() {
    return was_transmitter(before()) && counters().passive();
  }
  // The engine sends `frame`, of which `first` bits have passed already; LT acknowledges.
  void expect_rest(const Frame &frame, std::size_t first) {
    const std::string bits = wire(frame);
    const std::string lt = flipped(r_bits(bits.size()), ack_offset(frame));
    EXPECT_EQ(scene_.play(lt.substr(first)), bits.substr(first));
    ASSERT_FALSE(scene_.dut().sent().empty());
    EXPECT_EQ(scene_.last_sent(), frame);
  }
  void expect_foreign_frame(std::size_t first) {
    const std::string bits = wire(kForeign);
    EXPECT_EQ(scene_.play(bits.substr(first)), receiver_tx(bits).substr(first));
    ASSERT_FALSE(scene_.dut().received().empty());
    EXPECT_EQ(scene_.last_received(), kForeign);
  }

  Scene scene_;
};

std::string name_of(const ::testing::TestParamInfo<std::tuple<int, int>> &after) {
  constexpr const char *kStateNames[] = {"Active", "PassiveTec", "PassiveRec"};
  const auto [before, state] = after.param;
  return std::string{kBeforeNames[before]} + kStateNames[state];
}

INSTANTIATE_TEST_SUITE_P(After, Interframe,
                         ::testing::Combine(::testing::Range(0, 8), ::testing::Range(0, 3)),
                         name_of);

// IF-01, IF-02, IF-03: a pending frame starts in the bit after INT3, not earlier, not later.
// IF-08: after eight more bits if the node was transmitter and is passive. IF-09: not for others.
TEST_P(Interframe, PendingFrameStartsAtTheFirstBitAllowed) {
  scene_.request(kPending);
  const unsigned wait = suspended() ? 3 + 8 : 3;
  EXPECT_EQ(scene_.play(r_bits(wait)), r_bits(wait));
  expect_rest(kPending, 0);
}

// IF-03: requested as late as in INT3 (suspend bit 8) it starts in the next bit all the same.
TEST_P(Interframe, FrameRequestedInTheLastBitStartsInTheNext) {
  const unsigned wait = suspended() ? 3 + 8 : 3;
  EXPECT_EQ(scene_.play(r_bits(wait - 1)), r_bits(wait - 1));
  scene_.request(kPending);
  EXPECT_EQ(scene_.play("1"), "1");
  expect_rest(kPending, 0);
}

// IF-12: without a request the bus is idle for any number of bits; then a frame is received.
TEST_P(Interframe, NothingPendingLeavesTheBusIdle) {
  EXPECT_EQ(scene_.play(r_bits(3)), r_bits(3));
  EXPECT_EQ(scene_.field(), suspended() ? Field::kSuspend : Field::kIdle);
  EXPECT_EQ(scene_.play(r_bits(30)), r_bits(30));
  EXPECT_EQ(scene_.field(), Field::kIdle);
  expect_foreign_frame(0);
}

// IF-04: dominant at INT1 or INT2: overload flag in the next bit, of every role and state (OV-01,
// PF-49); then a delimiter and a full intermission (OV-07); no counter moves (FC-17).
TEST_P(Interframe, DominantInTheFirstTwoBitsIsAnsweredByAnOverloadFrame) {
  const unsigned tec = scene_.tec();
  const unsigned rec = scene_.rec();
  for (const unsigned first : {0u, 1u, 0u}) {
    EXPECT_EQ(scene_.play(r_bits(first) + "0"), r_bits(first + 1));
    EXPECT_EQ(scene_.play(r_bits(6 + 8)), d_bits(6) + r_bits(8));
  }
  scene_.expect_counters(tec, rec);
  scene_.request(kPending);
  const unsigned wait = suspended() ? 3 + 8 : 3;
  EXPECT_EQ(scene_.play(r_bits(wait)), r_bits(wait));
  expect_rest(kPending, 0);
}

// IF-05: dominant at INT3 is SOF; the frame is received and acknowledged. OV-08: no overload flag.
TEST_P(Interframe, DominantInTheThirdBitIsSof) {
  EXPECT_EQ(scene_.play("11"), "11");
  expect_foreign_frame(0);
}

// IF-06, IF-07: with a frame pending and no suspend due the node joins: recessive in the foreign
// SOF, its own ID28 in the next bit; it is transmitter. IF-10: with suspend due it receives.
TEST_P(Interframe, PendingFrameJoinsAForeignSofInTheThirdBit) {
  scene_.request(kPending);
  EXPECT_EQ(scene_.play("110"), "111");
  if (suspended()) {
    expect_foreign_frame(1);
  } else {
    expect_rest(kPending, 1);
  }
}

// IF-06, AR-11: joined with an identifier that loses in its first recessive bit.
TEST_P(Interframe, JoinedFrameLosesToAHigherPriority) {
  scene_.request(extended_frame(0x1FFFFFFF));
  EXPECT_EQ(scene_.play("110"), "111");
  const std::string bits = wire(kPending);
  EXPECT_EQ(scene_.play(bits.substr(1)), receiver_tx(bits).substr(1));
  EXPECT_EQ(scene_.last_received(), kPending);
}

// IF-08: the first bit after suspend is idle: a foreign SOF there may be joined or received, the
// winner's frame is taken either way (IF-14).
TEST_P(Interframe, ForeignSofAfterAllIsReceived) {
  EXPECT_EQ(scene_.play(r_bits(suspended() ? 11 : 3)), r_bits(suspended() ? 11 : 3));
  expect_foreign_frame(0);
}

unsigned recessive_bits_after_success(std::uint8_t tec) {
  Scene scene{{tec, 0}};
  play_own_frame(scene);
  scene.request(kPending);
  unsigned bits = 0;
  while (scene.field() != Field::kSof && bits < 30) {
    scene.play("1");
    ++bits;
  }
  return bits;
}

// IF-11, PF-46: the state at INT3 decides: TEC 129 to 128 by success: suspend; 128 to 127: none.
TEST(Suspend, FollowsTheErrorStateAfterTheFrame) {
  EXPECT_EQ(recessive_bits_after_success(130), 3u + 8);
  EXPECT_EQ(recessive_bits_after_success(129), 3u + 8);
  EXPECT_EQ(recessive_bits_after_success(128), 3u);
  EXPECT_EQ(recessive_bits_after_success(127), 3u);
}

// IF-11, EF-05: an error that lifts TEC to 128: its flag is active, but suspend is due.
TEST(Suspend, IsDueAfterTheErrorThatMadeTheNodePassive) {
  for (const std::uint8_t tec : {119, 120}) {
    Scene scene{{tec, 0}};
    scene.send(kFirst);
    scene.play(r_bits(14));
    scene.bench.force_next(0, Effect::kFlip);
    EXPECT_EQ(scene.play("1" + r_bits(6)), wire(kFirst).substr(14, 1) + d_bits(6));
    scene.play(r_bits(8));
    const unsigned wait = tec == 120 ? 3 + 8 : 3;
    EXPECT_EQ(scene.play(r_bits(wait + 1)), r_bits(wait) + "0");
  }
}

// IF-10, PF-07, PF-41: a foreign SOF in any suspend bit makes the node receiver, with a frame
// pending too. ED-05: no error. Afterwards the pending frame needs no second suspend (IF-09).
TEST(Suspend, ForeignSofInAnyBitOfItIsReceived) {
  for (const Counters &counters : {kPassiveTec, kPassiveRec}) {
    for (const Before before : {Before::kOwnFrame, Before::kOwnError, Before::kOwnOverload}) {
      for (unsigned bit = 1; bit <= 8; ++bit) {
        Scene scene{counters};
        play_before(scene, before);
        scene.request(kPending);
        EXPECT_EQ(scene.play(r_bits(3 + bit - 1)), r_bits(3 + bit - 1));
        const std::string bits = wire(kForeign);
        EXPECT_EQ(scene.play(bits), receiver_tx(bits)) << "suspend bit " << bit;
        EXPECT_EQ(scene.dut().received(), std::vector<Frame>{kForeign});
        EXPECT_EQ(scene.play(r_bits(3)), r_bits(3));
        EXPECT_EQ(scene.play(r_bits(5)), wire(kPending).substr(0, 5));
      }
    }
  }
}

// IF-03: back to back: between EOF7 and the next SOF stand exactly three bits, frame after frame.
TEST(BackToBack, FramesAreThreeBitsApart) {
  Scene scene;
  for (unsigned i = 0; i < 5; ++i) scene.request(kFirst);
  scene.run_to(Field::kSof);
  const std::string bits = wire(kFirst);
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_EQ(scene.play(flipped(r_bits(bits.size()), ack_offset(kFirst)) + "111"), bits + "111");
  }
}

// IF-12: idle of any length, also none, is followed by a frame that is received.
TEST(Idle, LastsAnyNumberOfBits) {
  Scene scene;
  for (unsigned idle = 0; idle < 40; ++idle) {
    scene.expect_reception(kFirst);
    EXPECT_EQ(scene.play(r_bits(idle)), r_bits(idle));
  }
}

// IF-13: a request in idle, at any clock of the bit, is on the wire within two bit times and the
// few clocks of the registers.
TEST(Idle, RequestIsSentWithinTwoBitTimes) {
  const unsigned per_bit = CoreBench::kTiming.clocks_per_bit();
  for (unsigned phase = 0; phase < per_bit; ++phase) {
    CoreBench bench{1};
    bench.start();
    bench.run_bits(5);
    for (unsigned i = 0; i < phase; ++i) bench.clock(Level::kRecessive);
    bench.dut().request(kFirst);
    unsigned clocks = 0;
    while (bench.dut().tx() == Level::kRecessive && clocks < 100) {
      bench.clock(Level::kRecessive);
      ++clocks;
    }
    EXPECT_LE(clocks, 2 * per_bit + 4) << phase;
  }
}

// IF-14: with a frame pending when a foreign SOF is sampled in idle the node joins or receives;
// either way the winner's frame is whole, and the own one comes right after it.
TEST(Idle, ForeignSofWithAFramePendingIsNotDisturbed) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    scene.request(base_frame(0x7FF));
    const std::string bits = wire(kFirst);
    const std::string tx = scene.play(bits);
    EXPECT_EQ(tx.front(), '1') << "no SOF of its own";
    EXPECT_EQ(tx.substr(2), receiver_tx(bits).substr(2));
    EXPECT_EQ(scene.last_received(), kFirst);
    EXPECT_EQ(scene.play("1111"), "1110");
    scene.expect_counters(counters.tec, counters.rec >= 128 ? scene.rec() : 0);
  }
}

// IF-15: a dominant pulse that ends before the sample point is no frame and no error.
TEST(Idle, ShortPulseIsIgnored) {
  for (unsigned clocks = 1; clocks <= 5; ++clocks) {
    Scene scene;
    for (unsigned i = 0; i < clocks; ++i) scene.bench.clock(Level::kDominant);
    EXPECT_EQ(scene.play(r_bits(20)), r_bits(20)) << clocks;
    EXPECT_EQ(scene.field(), Field::kIdle);
    EXPECT_EQ(scene.events().started, 0u);
    EXPECT_EQ(scene.events().errors, 0);
  }
}

// IF-15: dominant at exactly one sample point is SOF; then the sixth recessive bit, the seventh of
// all, is a stuff error: REC + 1 and a flag.
TEST(Idle, OneDominantBitIsSofAndEndsInAStuffError) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    EXPECT_EQ(scene.play("0" + r_bits(6)), r_bits(7));
    EXPECT_EQ(scene.play(r_bits(6)), flag_of(counters));
    scene.expect_counters(counters.tec, counters.rec + 1u);
    EXPECT_EQ(scene.events().errors, kErrStuff);
  }
}

// IF-16, IN-01: after reset the pin is recessive and the node takes no part in the traffic until
// eleven recessive bits; the pending frame starts then.
TEST(Integration, NothingIsSentBeforeElevenRecessiveBits) {
  CoreBench bench{1};
  bench.start();
  bench.dut().reset();
  bench.dut().request(kPending);
  bench.dut().start();
  bench.run_bits(1);
  bench.clear_history();
  // A frame without its last intermission bit, an acknowledge wanted; then a lone dominant bit.
  const std::string traffic =
      "0" + acked_wire(kFirst) + "11" + "00" + r_bits(10) + "0" + r_bits(11);
  bench.lt(traffic);
  bench.run_bits(static_cast<unsigned>(traffic.size()));
  EXPECT_EQ(bench.tx_history(), r_bits(traffic.size()));
  bench.run_bits(8);
  EXPECT_EQ(bench.tx_history().substr(traffic.size()), wire(kPending).substr(0, 8));
}

// IF-17: the pin is recessive in reset, while stopped, in integration, idle and bus-off, whatever
// the bus does.
TEST(Integration, PinIsRecessiveWheneverTheNodeTakesNoPart) {
  CoreBench bench{1};
  EXPECT_EQ(bench.dut().tx(), Level::kRecessive);
  bench.dut().request(kPending);
  for (unsigned i = 0; i < 300; ++i) {
    bench.clock(static_cast<Level>(i / 10 % 12 != 0));
    ASSERT_EQ(bench.dut().tx(), Level::kRecessive) << "stopped, with a request";
  }
  Scene off{{248, 0}};
  off.request(kPending);
  off.run_to(Field::kSof);
  off.bench.force_next(0, Effect::kFlip);  // TEC 256 at SOF
  off.play("1");
  for (unsigned i = 0; i < 20; ++i) {
    EXPECT_EQ(off.play(wire(kFirst) + "111"), r_bits(wire(kFirst).size() + 3));
  }
  EXPECT_TRUE(off.dut().bus_off());
}

}  // namespace
}  // namespace vericansim
