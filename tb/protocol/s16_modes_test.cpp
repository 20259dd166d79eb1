// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 16: listen-only, loop-back, one-shot, leaving the bus.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

CoreConfig listen_only() {
  CoreConfig config = CoreBench::default_config();
  config.listen_only = true;
  return config;
}

CoreConfig loop_back() {
  CoreConfig config = CoreBench::default_config();
  config.loop_back = true;
  return config;
}

class ListenOnly : public ::testing::TestWithParam<Counters> {
 protected:
  ListenOnly() : rig{GetParam(), listen_only()} {}
  ErrorRig rig;
};

class AnyState : public ::testing::TestWithParam<Counters> {};

INSTANTIATE_TEST_SUITE_P(States, ListenOnly, ::testing::Values(kActive, kPassive, kPassiveByRec));
INSTANTIATE_TEST_SUITE_P(States, AnyState, ::testing::Values(kActive, kPassive, kPassiveByRec));

// MO-01, PF-40, EF-13: frames are delivered, whoever acknowledges them; the pin stays recessive.
TEST_P(ListenOnly, DeliversFramesAndSendsNothing) {
  EXPECT_EQ(rig.receive(kGv1), rep(53, "1"));
  EXPECT_EQ(rig.delivered(), 1u);
  rig.play("111");
  EXPECT_EQ(rig.play(kGv1Bits + "1 1 1 1111111"), rep(53, "1"));  // no acknowledge at all
  EXPECT_EQ(rig.delivered(), 2u);
  EXPECT_EQ(rig.dut().events().errors, 0);
}

// MO-01, FC-22, MX-24: errors, overload conditions, long dominant levels: nothing sent or counted.
TEST_P(ListenOnly, SendsNoFlagAndCountsNothing) {
  EXPECT_EQ(rig.play("000000 000000" + rep(20, "0") + rep(11, "1")), rep(43, "1"));
  EXPECT_NE(rig.dut().events().errors, 0);  // the errors are seen all the same
  EXPECT_EQ(rig.receive(kGv1), rep(53, "1"));
  EXPECT_EQ(rig.play("0 111111 1111111 0" + rep(20, "1")), rep(35, "1"));  // INT1, then DEL8
  EXPECT_EQ(rig.tec(), GetParam().tec);
  EXPECT_EQ(rig.rec(), GetParam().rec);
}

// MO-01: a request waits, in idle and at a foreign start.
TEST_P(ListenOnly, StartsNoFrame) {
  rig.request({.id = 0x001});
  EXPECT_EQ(rig.play(rep(30, ".")), rep(30, "1"));
  EXPECT_EQ(rig.receive(kGv1), rep(53, "1"));
  EXPECT_EQ(rig.play("11" + whole(kGv1)), rep(55, "1"));
  EXPECT_EQ(rig.delivered(), 2u);
  EXPECT_TRUE(rig.dut().pending());
}

// MO-03: an active transmitter without acknowledge flags at the ACK delimiter: not delivered. A
// passive one leaves a frame that looks complete, each time.
TEST_P(ListenOnly, FramesThatNobodyAcknowledges) {
  CoreBench bench(2);
  CoreConfig listening = listen_only();
  bench.dut(1).configure(listening);
  bench.dut(0).preset_counters(GetParam().tec, GetParam().rec);
  bench.start();
  bench.dut(0).request(kGv1);
  bench.run_bits(300);
  EXPECT_EQ(bench.tx_history(1).find('0'), std::string::npos);
  const std::size_t copies = bench.dut(1).received().size();
  if (GetParam().passive()) {
    EXPECT_EQ(copies, 4u);  // 2 + 43 + 25 bits from start to start
  } else {
    EXPECT_EQ(copies, 0u);
  }
}

// MO-04: the pin stays recessive, the bus is not heard, no acknowledge is needed.
TEST_P(AnyState, LoopBackSendsToItselfAlone) {
  ErrorRig rig(GetParam(), loop_back());
  const Frame frame{.id = 0x1ABCDEF, .extended = true, .dlc = 8, .data = {1, 2, 3, 0, 0, 0, 255}};
  rig.request(frame);
  std::string noise;
  for (unsigned n = 0; n < 200; ++n) noise += (n * 7 % 5) < 2 ? "0" : "1";
  EXPECT_EQ(rig.play(noise), rep(200, "1"));
  EXPECT_EQ(rig.dut().events().errors, 0);
  ASSERT_EQ(rig.sent(), 1u);
  ASSERT_EQ(rig.delivered(), 1u);
  EXPECT_EQ(rig.dut().received()[0], frame);
  EXPECT_EQ(rig.tec(), GetParam().tec == 0 ? 0u : GetParam().tec - 1u);
}

// MO-04: frame after frame, three bits apart (or suspended), as on a real bus.
TEST(LoopBack, KeepsTheInterframeSpace) {
  ErrorRig rig(kActive, loop_back());
  rig.request(kGv1);
  rig.request(kGv1);
  rig.play(rep(1 + 53 + 3, "."));
  EXPECT_EQ(rig.field(), Field::kSof);
  rig.play(rep(53, "."));
  EXPECT_EQ(rig.sent(), 2u);
}

// MO-06: the engine tells of its own frames at EOF6 too (the buffers decide what that means); of
// one that lost arbitration it tells nothing but the winner.
TEST_P(AnyState, OwnFrameIsReportedAtEof6) {
  ErrorRig rig(GetParam());
  rig.send(kGv1);
  rig.play(rep(44, ".") + "0 . .....");
  EXPECT_FALSE(rig.last().delivered);
  rig.play(".");
  EXPECT_TRUE(rig.last().delivered);
  EXPECT_TRUE(rig.last().transmitter);
  rig.play(".");
  EXPECT_FALSE(rig.last().delivered);
  ErrorRig loser(GetParam());
  loser.send({.id = 0x7FF});
  loser.play(whole(kGv1).substr(0, 52));
  EXPECT_TRUE(loser.last().delivered);
  EXPECT_FALSE(loser.last().transmitter);
  ASSERT_EQ(loser.delivered(), 1u);
  EXPECT_EQ(loser.dut().received()[0], kGv1);
}

// A one-shot request of `frame`, its SOF next; the model knows retries only.
void send_once(ErrorRig &rig, const Frame &frame) {
  rig.without_judge();
  rig.dut().request(frame, true);
  rig.play(".");
}

// MO-09, MX-25, PF-19: lost at any identifier bit: reported once, never started again.
TEST_P(AnyState, OneShotEndsWithALostArbitration) {
  for (int n = 1; n <= 12; ++n) {
    ErrorRig rig(GetParam());
    send_once(rig, {.id = 0x555, .remote = true});
    const std::string own = to_string(levels_of(encode_frame({.id = 0x555, .remote = true}).bits));
    if (own[static_cast<std::size_t>(n)] == '0') continue;
    rig.play(rep(n, ".") + "0");
    EXPECT_EQ(rig.dut().events().failed, 1u) << n;
    EXPECT_FALSE(rig.dut().pending()) << n;
    rig.play(rep(80, "."));
    EXPECT_EQ(rig.dut().events().started, 1u) << n;
    EXPECT_EQ(rig.tec(), GetParam().tec) << n;
  }
}

// MO-09, MX-25: an error in any bit, the missing acknowledge too; counters as always.
TEST_P(AnyState, OneShotEndsWithAnError) {
  for (const int n : {0, 14, 22, 30, 44, 47, 52}) {
    ErrorRig rig(GetParam());
    send_once(rig, {.id = 0x123, .dlc = 1, .data = {0x55}});
    rig.play(n <= 44 ? rep(n, ".") + (n == 44 ? "." : "!")
                     : rep(44, ".") + "0" + rep(n - 45, ".") + "0");
    EXPECT_EQ(rig.dut().events().failed, 1u) << n;
    const bool withheld = n == 44 && GetParam().passive();
    EXPECT_EQ(rig.tec(), GetParam().tec + (withheld ? 0u : 8u)) << n;
    rig.play(rep(80, "."));
    EXPECT_EQ(rig.dut().events().started, 1u) << n;
    EXPECT_FALSE(rig.dut().pending()) << n;
  }
}

// MO-09: a joined start counts as the one start.
TEST(OneShot, JoinedStartIsTheOnlyOne) {
  ErrorRig rig;
  rig.without_judge();
  rig.receive(kGv1);
  rig.dut().request({.id = 0x7FF}, true);
  rig.play("110 0");  // joined at INT3, lost at ID28
  EXPECT_EQ(rig.dut().events().failed, 1u);
  rig.play(rep(80, "."));
  EXPECT_EQ(rig.dut().events().started, 2u);  // the two foreign starts
  EXPECT_FALSE(rig.dut().pending());
}

// FF-12, RO-03: a request that is taken back: before the start it is never sent; on the wire it
// runs on, counts as sent if it succeeds, and is not tried again if it fails.
TEST_P(AnyState, RequestTakenBack) {
  const auto take_back = [](ErrorRig &rig) { rig.judge.cancel(0); };
  ErrorRig before(GetParam());
  before.play(whole(kGv1) + "11");
  before.request({.id = 0x001});
  take_back(before);
  EXPECT_EQ(before.play(rep(40, ".")), rep(40, "1"));
  for (const bool fails : {false, true}) {
    ErrorRig rig(GetParam());
    rig.send(kGv1);
    rig.play(rep(22, "."));
    take_back(rig);
    rig.play(fails ? "!" : rep(22, ".") + "0");
    rig.play(rep(80, "."));
    EXPECT_EQ(rig.sent(), fails ? 0u : 1u);
    EXPECT_EQ(rig.dut().events().started, 1u);
    EXPECT_FALSE(rig.dut().pending());
  }
}

// The last of the next twenty clocks in which the pin is dominant; 0: none.
unsigned clocks_of_dominant(CoreBench &bench) {
  unsigned last = 0;
  for (unsigned n = 1; n <= 20; ++n) {
    bench.clock(Level::kRecessive);
    if (bench.dut().tx() == Level::kDominant) last = n;
  }
  return last;
}

// MO-13, IF-17: stopped in any bit of an own frame, of a flag or of an acknowledge: recessive at
// the end of that bit at the latest, no dominant bit cut short; then integration, then the frame.
TEST_P(AnyState, LeavingTheBusNeverCutsADominantBit) {
  for (unsigned n = 0; n < 70; ++n) {
    CoreBench bench;
    bench.dut().preset_counters(GetParam().tec, GetParam().rec);
    bench.start();
    bench.dut().request(kGv1);
    bench.run_bits(1 + n);
    const bool dominant = bench.dut().tx() == Level::kDominant;
    for (int k = 0; k < 3; ++k) bench.clock(Level::kRecessive);
    bench.dut().stop();
    const unsigned last = clocks_of_dominant(bench);
    // One clock of ten had passed at the end of run_bits(), and three came after it.
    EXPECT_EQ(last, dominant ? 6u : 0u) << n;
    EXPECT_FALSE(bench.dut().running()) << n;
    bench.dut().start();
    bench.lt_acknowledges(true);
    bench.clear_history();
    bench.run_bits(11);
    EXPECT_EQ(bench.tx_history().find('0'), std::string::npos) << n;
    bench.run_bits(70);
    EXPECT_EQ(bench.dut().sent().size(), 1u) << n;
  }
}

// MO-13: the same for the acknowledge of a receiver.
TEST(LeavingTheBus, AcknowledgeIsSentInFull) {
  CoreBench bench;
  bench.start();
  bench.lt(kGv1Bits + "1");
  bench.run_bits(44);
  bench.clock(Level::kRecessive);
  ASSERT_EQ(bench.dut().tx(), Level::kDominant);
  bench.dut().stop();
  EXPECT_EQ(clocks_of_dominant(bench), 8u);
  EXPECT_FALSE(bench.dut().running());
}

}  // namespace
}  // namespace vericansim
