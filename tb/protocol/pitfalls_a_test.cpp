// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Pitfalls PF-01..PF-13: what other controllers got wrong around starts, suspend and bus-off.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

const Frame kHigh = base_frame(0x123, {0x55});
const Frame kLow = base_frame(0x7AA, {0x12, 0x34});

// LT's part while the engine sends `frame`: recessive but for the acknowledge.
std::string acknowledge(const Frame &frame) {
  return flipped(r_bits(wire(frame).size()), ack_offset(frame));
}

// PF-01: lost at ID18, then SOF in INT3: the engine's ID28 is in the next bit.
TEST(Pitfall, SofInInt3AfterLostArbitrationIsJoined) {
  for (const Counters &counters : kStates) {
    for (const Frame &own : {base_frame(0x123), extended_frame(0x123u << 18)}) {
      Scene scene{counters};
      scene.send(own);
      const Frame winner = base_frame(0x122, {0x55});
      scene.play(wire(winner));
      EXPECT_EQ(scene.dut().received(), std::vector<Frame>{winner});
      EXPECT_EQ(scene.play("110"), "111");
      EXPECT_EQ(scene.play(acknowledge(own).substr(1)), wire(own).substr(1));
      EXPECT_EQ(scene.dut().sent(), std::vector<Frame>{own});
    }
  }
}

// PF-02: a request at every clock from INT1 to ID27 while a foreign frame starts in INT3: what is
// sent, then or later, is the frame asked for, with nothing of the frames before.
TEST(Pitfall, RequestAroundAForeignSofSendsNoStaleFrame) {
  const unsigned per_bit = CoreBench::kTiming.clocks_per_bit();
  const Frame own = extended_frame(0x0A5C3E71, {0xA1, 0xB2, 0xC3, 0xD4, 0xE5});
  const Frame next = base_frame(0x7FE, {0x0F});
  for (unsigned at = 0; at < 5 * per_bit; ++at) {
    CoreBench bench{1};
    bench.start();
    bench.lt(wire(kHigh));
    bench.run_bits(static_cast<unsigned>(wire(kHigh).size()));
    const std::string lt = "11" + wire(next).substr(0, 3);
    for (unsigned clock = 0; clock < lt.size() * per_bit; ++clock) {
      if (clock == at) bench.dut().request(own);
      bench.clock(lt[clock / per_bit] == '0' ? Level::kDominant : Level::kRecessive);
    }
    bench.lt_acknowledges(true);
    bench.run_bits(300);
    EXPECT_EQ(bench.dut().sent(), std::vector<Frame>{own}) << at;
    EXPECT_NE(bench.tx_history().find(wire(own).substr(1)), std::string::npos) << at;
  }
}

// PF-03: an identifier that starts with recessive bits, pending at a SOF in INT3: none of its first
// bits is forced dominant.
TEST(Pitfall, FirstIdentifierBitsOfAJoinedStartAreRight) {
  for (const std::uint32_t id : {0x7FFu, 0x7C0u, 0x400u, 0x555u, 0x3FFu, 0x000u}) {
    for (const bool extended : {false, true}) {
      Scene scene;
      const Frame own = extended ? extended_frame(id << 18 | id) : base_frame(id, {0x81});
      scene.play(wire(kHigh));
      scene.request(own);
      EXPECT_EQ(scene.play("110"), "111");
      EXPECT_EQ(scene.play(acknowledge(own).substr(1)), wire(own).substr(1));
    }
  }
}

// PF-04: the same with identifiers 000 and 7FF, LT silent after its SOF: no spurious stuff error.
TEST(Pitfall, JoinedStartHasNoSpuriousStuffError) {
  for (const std::uint32_t id : {0x000u, 0x7FFu}) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      scene.play(wire(kHigh) + "1");
      scene.request(base_frame(id));
      EXPECT_EQ(scene.play("10"), "11");
      EXPECT_EQ(scene.play(acknowledge(base_frame(id)).substr(1)), wire(base_frame(id)).substr(1));
      EXPECT_EQ(scene.events().errors, 0);
    }
  }
}

// PF-05: identifiers 07x and 0Fx: the run of a joined start counts the SOF that others sent.
TEST(Pitfall, FirstStuffBitOfAJoinedStartIsNotLate) {
  for (const auto &[id, head] :
       {std::pair{0x075u, "000011110101"}, std::pair{0x0F5u, "00011110101"}}) {
    Scene scene;
    scene.play(wire(kHigh));
    scene.request(base_frame(id));
    EXPECT_EQ(scene.play("110"), "111");
    const std::string expected{head};
    EXPECT_EQ(scene.play(r_bits(expected.size())), expected);
  }
}

// PF-06: passive, lost at ID20: no suspend: SOF three bits after EOF7.
TEST(Pitfall, PassiveLoserOfArbitrationDoesNotSuspend) {
  for (const Counters &counters : {Counters{128, 0}, Counters{250, 0}, Counters{128, 130}}) {
    Scene scene{counters};
    scene.send(base_frame(0x127));
    scene.play(wire(kHigh));
    EXPECT_EQ(scene.dut().received(), std::vector<Frame>{kHigh});
    EXPECT_EQ(scene.play(r_bits(3)), r_bits(3));
    EXPECT_EQ(scene.play(acknowledge(base_frame(0x127))), wire(base_frame(0x127)));
  }
}

// PF-07: passive, two frames pending: after the first, LT's SOF in suspend bit 1, 4, 8 is received,
// and without one the second frame starts after eight bits, whole.
TEST(Pitfall, SuspendIsNoIdle) {
  for (const unsigned bit : {0u, 1u, 4u, 8u}) {
    Scene scene{{130, 0}};
    scene.request(kLow);
    scene.request(extended_frame(0x0A5C3E71, {1, 2, 3}));
    scene.run_to(Field::kSof);
    scene.play(acknowledge(kLow));
    if (bit != 0) {
      EXPECT_EQ(scene.play(r_bits(3 + bit - 1)), r_bits(3 + bit - 1));
      EXPECT_EQ(scene.play(wire(kHigh) + "111"), receiver_tx(wire(kHigh)) + "111");
    } else {
      EXPECT_EQ(scene.play(r_bits(3 + 8)), r_bits(3 + 8));
    }
    const Frame second = extended_frame(0x0A5C3E71, {1, 2, 3});
    EXPECT_EQ(scene.play(acknowledge(second)), wire(second));
  }
}

// PF-08: the winner was of no interest: the retry still comes right after INT3, and wins against a
// frame of lower priority that LT starts there.
TEST(Pitfall, RetryAfterAFilteredWinnerIsNotLate) {
  Scene scene;
  const Frame own = base_frame(0x127, {0x99});
  scene.send(own);
  scene.play(wire(kHigh) + "111");
  const std::string lt = wire(kLow).substr(0, 2) + acknowledge(own).substr(2);
  EXPECT_EQ(scene.play(lt), wire(own));
  EXPECT_EQ(scene.dut().sent(), std::vector<Frame>{own});
}

// PF-09: an arbitration stuff error counts nothing; a bit error in its flag and the eight dominant
// bits after the next flag count as always.
TEST(Pitfall, ErrorsAfterAnArbitrationStuffErrorCount) {
  Scene scene;
  scene.send(base_frame(0x078));
  scene.play(r_bits(5));
  EXPECT_EQ(scene.play("0"), "1");  // the stuff bit
  EXPECT_EQ(scene.play("11"), "00");
  scene.expect_counters(0, 0);
  scene.bench.force_next(0, Effect::kRecessive);
  scene.play("1");
  EXPECT_EQ(scene.play(r_bits(6)), d_bits(6));
  scene.expect_counters(8, 0);
  scene.play(d_bits(7));
  scene.expect_counters(8, 0);
  scene.play("0");
  scene.play("1");
  scene.expect_counters(16, 0);
}

// PF-10: TEC 124, bit error, DEL8 dominant: after the overload frame the node is passive: the next
// error gives a passive flag.
TEST(Pitfall, PassiveStateIsEnteredAcrossAnOverloadFrame) {
  Scene scene{{124, 0}};
  scene.send(kHigh);
  scene.play(r_bits(13));
  scene.bench.force_next(0, Effect::kFlip);
  EXPECT_EQ(scene.play("1" + r_bits(6) + r_bits(7) + "0").substr(1), d_bits(6) + r_bits(8));
  scene.expect_counters(132, 0);
  EXPECT_EQ(scene.play(r_bits(6 + 8 + 3 + 8)), d_bits(6) + r_bits(8 + 3 + 8));
  scene.play(r_bits(13));
  scene.bench.force_next(0, Effect::kFlip);
  EXPECT_EQ(scene.play("1" + r_bits(6)).substr(1), r_bits(6));
  scene.expect_counters(140, 0);
}

// Drives the engine into bus-off in the middle of `frame`: a bit error at TEC 248 at `at`.
void enter_bus_off(Scene &scene, const Frame &frame, std::size_t at) {
  scene.send(frame);
  scene.play(r_bits(at));
  scene.bench.force_next(0, Effect::kFlip);
  scene.play("1");
  scene.play("1");
  EXPECT_TRUE(scene.dut().bus_off());
}

// PF-11, BO-06: REC 5, bus-off, traffic with errors during the recovery: recovery after 128
// sequences of eleven recessive bits (BO-04: no later than 129 and two bits), no change of REC.
// PF-12: no warning or passive state from the count of the recovery.
TEST(Pitfall, RecoveryIsBlindToTrafficAndShowsNoWarning) {
  Scene scene{{248, 5}};
  enter_bus_off(scene, kHigh, 13);
  scene.cancel();
  scene.play("0");
  for (unsigned i = 0; i < 127; ++i) {
    const std::string traffic = i % 4 == 0 ? d_bits(7) + "11" : wire(kLow).substr(0, 20);
    EXPECT_EQ(scene.play(traffic + "0"), r_bits(traffic.size() + 1));
    EXPECT_EQ(scene.play(r_bits(11) + "0"), r_bits(12));
    ASSERT_TRUE(scene.dut().bus_off());
    ASSERT_FALSE(scene.dut().passive());
  }
  scene.play(r_bits(10));
  EXPECT_TRUE(scene.dut().bus_off());
  scene.play(r_bits(11 + 2));
  EXPECT_FALSE(scene.dut().bus_off());
  scene.expect_counters(0, 0);
  scene.expect_reception(kLow);
}

// PF-13, BO-07: pending through bus-off that cut the frame in any bit, of DATA and CRC too: the
// first frame after the recovery is bit-exact.
TEST(Pitfall, FirstFrameAfterRecoveryIsBitExact) {
  const Frame frame = extended_frame(0x0A5C3E71, {0xFF, 0x00, 0xC3});
  for (std::size_t at = 0; at < ack_offset(frame); at += 7) {
    const bool recessive = wire(frame)[at] == '1';
    if (recessive && at < offset_of(frame, Field::kR1, 0)) continue;
    Scene scene{{248, 0}};
    enter_bus_off(scene, frame, at);
    scene.play("0");
    scene.bench.run_until([&] { return !scene.dut().bus_off(); }, 1500);
    scene.run_to(Field::kSof);
    EXPECT_EQ(scene.play(acknowledge(frame)), wire(frame)) << at;
    scene.play("1");
    scene.expect_counters(0, 0);
  }
}

}  // namespace
}  // namespace vericansim
