// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 12: integration, bus-off and recovery.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

// An engine that has just been started, with LT busy from the first bit on.
class Integration : public ::testing::TestWithParam<Counters> {
 protected:
  void SetUp() override {
    bench.dut().preset_counters(GetParam().tec, GetParam().rec);
    bench.lt(Level::kDominant);
    bench.dut().start();
    bench.run_bits(3);
    bench.lt(Level::kRecessive);
    bench.clear_history();
  }
  std::string play(const std::string &script) {
    const std::size_t before = bench.tx_history().size();
    bench.lt(bits(script));
    bench.run_bits(static_cast<unsigned>(bits(script).size()));
    return bench.tx_history().substr(before);
  }
  [[nodiscard]] bool integrated() { return bench.dut().integrated(); }

  CoreBench bench;
  Assertions assertions{bench};
};

INSTANTIATE_TEST_SUITE_P(States, Integration, ::testing::Values(kActive, kPassive, kPassiveByRec));

// IN-01, IN-03, IF-16, IF-17, PF-27, MX-22: any dominant bit starts the count again.
TEST_P(Integration, NeedsElevenRecessiveBitsInARow) {
  for (int n = 1; n <= 10; ++n) {
    const std::string driven = play(rep(n, "1") + "0");
    EXPECT_EQ(driven, rep(n + 1, "1"));
    EXPECT_FALSE(integrated()) << n;
  }
  play(rep(10, "1"));
  EXPECT_FALSE(integrated());
  play("1");
  EXPECT_TRUE(integrated());
}

// IN-01: ACK delimiter, EOF and intermission are eleven; the frame that follows is acknowledged.
TEST_P(Integration, EndsWithInt3OfAFrameUnderWay) {
  EXPECT_EQ(play(whole(kGv1) + "111"), rep(56, "1"));
  EXPECT_TRUE(integrated());
  EXPECT_EQ(bench.dut().received().size(), 0u);
  EXPECT_EQ(play(whole(kGv1)), rep(44, "1") + "0" + rep(8, "1"));
  EXPECT_EQ(bench.dut().received().size(), 1u);
}

// IN-03: no start of frame, no overload frame, no error frame; counting starts at once.
TEST_P(Integration, DominantBitsStartNothing) {
  EXPECT_EQ(play("1 0 11 0 000000000 1111111111 0 11 0 1 00"), rep(31, "1"));
  EXPECT_EQ(bench.dut().events().errors, 0);
  EXPECT_EQ(bench.dut().events().started, 0u);
  CoreBench quiet;  // no dominant bit at all is needed
  quiet.dut().start();
  quiet.run_bits(11);
  EXPECT_TRUE(quiet.dut().integrated());
}

// IN-04, TH-07: a frame that waits begins in the twelfth bit.
TEST_P(Integration, PendingFrameStartsRightAfterTheEleventhBit) {
  bench.dut().request(kGv1);
  EXPECT_EQ(play(rep(10, "1") + "0"), rep(11, "1"));
  EXPECT_EQ(play(rep(11 + 43, "1")), rep(11, "1") + kGv1Bits);
}

// IN-05, FF-06, PF-39: after a protocol exception the counters are as before; so at a first start.
TEST_P(Integration, CountersStayAsTheyAre) {
  play(rep(12, "1"));
  EXPECT_EQ(bench.last().tec, GetParam().tec);
  EXPECT_EQ(bench.last().rec, GetParam().rec);
  CoreConfig config = CoreBench::default_config();
  config.fd_tolerant = true;
  ErrorRig rig(GetParam(), config);
  rig.play("0 00100100011 0 0 1");  // FDF recessive
  EXPECT_EQ(rig.field(), Field::kInteg);
  EXPECT_EQ(rig.play("0000000000 1111111111 0 1111111111"), rep(31, "1"));
  EXPECT_EQ(rig.field(), Field::kInteg);
  rig.play("1");
  EXPECT_EQ(rig.field(), Field::kIdle);
  EXPECT_EQ(rig.tec(), GetParam().tec);
  EXPECT_EQ(rig.rec(), GetParam().rec);
  EXPECT_EQ(rig.dut().events().errors, 0);
}

// IN-02: an edge between sample points, too short to be sampled, restarts the count only in an
// FD-tolerant node.
TEST(ShortPulse, RestartsIntegrationOfFdTolerantNodesOnly) {
  for (const bool tolerant : {false, true}) {
    CoreConfig config = CoreBench::default_config();
    config.fd_tolerant = tolerant;
    CoreBench bench(1, config);
    bench.lt(Level::kDominant);
    bench.dut().start();
    bench.run_bits(2);
    bench.lt(Level::kRecessive);
    bench.run_bits(8);
    EXPECT_EQ(bench.last().field, Field::kInteg);
    bench.clock(Level::kDominant);  // one quantum at the start of a bit
    bench.clock(Level::kRecessive);
    bench.run_bits(5);
    EXPECT_EQ(bench.dut().integrated(), !tolerant);
    bench.run_bits(7);
    EXPECT_TRUE(bench.dut().integrated());
  }
}

// An engine that has just gone off, with a frame pending.
class BusOff : public ::testing::Test {
 protected:
  void go_off(ErrorRig &rig) {
    rig.send(kGv1);
    rig.play(rep(22, ".") + "!");
    ASSERT_TRUE(rig.last().bus_off);
  }
};

// BO-01, FC-13: silent at once; no acknowledge, nothing delivered, no flags.
TEST_F(BusOff, TakesNoPart) {
  ErrorRig rig({.tec = 248, .rec = 20});
  go_off(rig);
  EXPECT_EQ(rig.play(whole(kGv1) + "0 111 00000000 111 0"), rep(69, "1"));
  EXPECT_EQ(rig.delivered(), 0u);
  EXPECT_TRUE(rig.dut().pending());  // the frame is kept
}

// BO-01: by a bit error in any field, by a missing bit after a flag, by a form error.
TEST_F(BusOff, BeginsWithWhateverReaches256) {
  for (const int n : {0, 5, 15, 22, 40}) {
    ErrorRig rig({.tec = 250});
    rig.send(kGv1);
    rig.play(rep(n, ".") + "!");
    EXPECT_TRUE(rig.last().bus_off) << n;
    EXPECT_EQ(rig.play(rep(60, ".")), rep(60, "1")) << n;
  }
  ErrorRig late({.tec = 240});
  late.send(kGv1);
  late.play("! 000000 0000000");
  EXPECT_FALSE(late.last().bus_off);
  late.play("0");  // FC-08
  EXPECT_TRUE(late.last().bus_off);
  ErrorRig receiver({.tec = 255, .rec = 127});
  receiver.play("000000 000000" + rep(40, "0"));
  EXPECT_FALSE(receiver.last().bus_off);
}

// BO-02, BO-04, PF-38, MX-22: 1408 recessive bits in a row; a dominant bit costs the run only.
TEST_F(BusOff, EndsAfter128TimesElevenRecessiveBits) {
  ErrorRig rig({.tec = 248});
  go_off(rig);
  rig.play(rep(1407, "1"));
  EXPECT_TRUE(rig.last().bus_off);
  rig.play("1");
  EXPECT_FALSE(rig.last().bus_off);
}

// BO-02: 21 in a row are one; 10 are none; they do not overlap.
TEST_F(BusOff, RunsOfRecessiveBitsDoNotOverlap) {
  ErrorRig rig({.tec = 248});
  go_off(rig);
  rig.play("0" + rep(300, "1111111111 0"));
  EXPECT_TRUE(rig.last().bus_off);
  rig.play(rep(127, rep(21, "1") + "0"));
  EXPECT_TRUE(rig.last().bus_off);
  rig.play(rep(10, "1"));
  EXPECT_TRUE(rig.last().bus_off);
  rig.play("1");
  EXPECT_FALSE(rig.last().bus_off);
}

// BO-03: with automatic recovery off it stays off until the bit is cleared; then, if 128 sequences
// have passed, eleven more bits at most; if not, the count goes on.
TEST_F(BusOff, HeldByTheHostUntilReleased) {
  CoreConfig hold = CoreBench::default_config();
  hold.boff_rec = true;
  CoreConfig release = CoreBench::default_config();
  for (const int waited : {100, 1500, 3001}) {
    ErrorRig rig({.tec = 248}, hold);
    go_off(rig);
    rig.play(rep(waited, "1"));
    EXPECT_TRUE(rig.last().bus_off) << waited;
    rig.dut().configure(release);
    rig.judge.model().config().boff_rec = false;
    if (waited < 1408) {
      rig.play(rep(1407 - waited, "1"));
      EXPECT_TRUE(rig.last().bus_off) << waited;
      rig.play("1");
    } else {
      rig.play(rep(11, "1"));
    }
    EXPECT_FALSE(rig.last().bus_off) << waited;
  }
}

// BO-03: set during a bus-off that began without it, the bit changes nothing.
TEST_F(BusOff, HoldIsLatchedAtEntry) {
  ErrorRig rig({.tec = 248});
  go_off(rig);
  rig.play(rep(500, "1"));
  CoreConfig hold = CoreBench::default_config();
  hold.boff_rec = true;
  rig.dut().configure(hold);
  rig.judge.model().config().boff_rec = true;
  rig.play(rep(908, "1"));
  EXPECT_FALSE(rig.last().bus_off);
}

// BO-05: both counters 0, active, idle; the frame that waited comes in the next bit.
TEST_F(BusOff, LeavesANewNodeBehind) {
  ErrorRig rig({.tec = 248, .rec = 100});
  go_off(rig);
  rig.play(rep(1408, "1"));
  EXPECT_EQ(rig.tec(), 0u);
  EXPECT_EQ(rig.rec(), 0u);
  EXPECT_FALSE(rig.last().passive);
  EXPECT_EQ(rig.field(), Field::kSof);
  EXPECT_EQ(rig.play(rep(44, ".") + "0 ........").substr(0, 43), kGv1Bits);
  EXPECT_EQ(rig.sent(), 1u);
}

// BO-05: without a pending frame the node is idle, and receives what comes.
TEST_F(BusOff, ReceivesRightAfterRecovery) {
  ErrorRig rig({.tec = 248});
  go_off(rig);
  rig.dut().cancel();
  rig.judge.cancel(0);
  rig.play(rep(1408, "1"));
  EXPECT_EQ(rig.field(), Field::kIdle);
  EXPECT_EQ(rig.receive(kGv1), rep(44, "1") + "0" + rep(8, "1"));
  EXPECT_EQ(rig.delivered(), 1u);
}

// BO-05, FC-21: a reset, or a stop, in the middle of the recovery leaves no half state.
TEST_F(BusOff, ResetDuringRecoveryStartsAfresh) {
  CoreBench bench;
  bench.dut().preset_counters(248, 0);
  bench.start();
  bench.dut().request(kGv1);
  bench.invert(0, {.field = Field::kSof});
  bench.run_bits(500);
  EXPECT_TRUE(bench.last().bus_off);
  bench.dut().stop();
  for (int n = 0; n < 20; ++n) bench.clock(Level::kRecessive);
  EXPECT_TRUE(bench.dut().bus_off());  // stopping alone does not end it
  bench.dut().reset();
  EXPECT_FALSE(bench.dut().bus_off());
  bench.dut().start();
  bench.run_bits(12);
  EXPECT_TRUE(bench.dut().integrated());
  EXPECT_EQ(bench.last().tec, 0u);
}

// BO-06, PF-11, PF-12: REC stands still while the bus is full of errors; it does not delay the end.
TEST_F(BusOff, ReceiveCounterStandsStill) {
  ErrorRig rig({.tec = 248, .rec = 5});
  go_off(rig);
  const std::string traffic = "0 00000 000000 00000 111111111 0 1 0 11 0000000 1111";
  for (int n = 0; n < 20; ++n) {
    rig.play(traffic);
    EXPECT_EQ(rig.rec(), 5u);
    EXPECT_FALSE(rig.last().passive);
  }
  rig.play("0" + rep(1408, "1"));
  EXPECT_FALSE(rig.last().bus_off);
}

// BO-07, PF-13: cut off in any field, the first frame after recovery is exact.
TEST_F(BusOff, FirstFrameAfterRecoveryIsExact) {
  const Frame frame{.id = 0x0F0, .dlc = 2, .data = {0x00, 0xF8}};
  const std::string expected = model_bench::to_delimiter(frame);
  for (const int n : {0, 14, 20, 30, 40, 48}) {
    ErrorRig rig({.tec = 255});
    rig.send(frame);
    rig.play(rep(n, ".") + "!");
    ASSERT_TRUE(rig.last().bus_off) << n;
    EXPECT_EQ(rig.play(rep(1408 + static_cast<int>(expected.size()), ".")).substr(1408), expected)
        << n;
  }
}

// Clocks from a falling edge of LT at the pin to the first sample point that sees it.
unsigned clocks_to_sample(CoreBench &bench) {
  for (unsigned n = 1; n <= 20; ++n) {
    bench.clock(Level::kDominant);
    const Trace trace = decode_trace(bench.dut().trace());
    if (trace.sample && trace.rx == Level::kDominant) return n;
  }
  return 0;
}

// BO-08, SY-05, SY-06: an edge anywhere in a bit moves the grid at once, in integration and in
// bus-off: PROP + PS1 to PROP + PS1 + 1 quanta, and the two clocks of the synchroniser, later comes
// the sample point. With SJW 1 a resynchronisation could not do that.
TEST_F(BusOff, HardSynchronisationGoesOn) {
  const BitTiming timing = CoreBench::kTiming;
  const unsigned least = timing.prop + timing.ps1 + 2;
  for (const bool off : {false, true}) {
    for (unsigned shift = 0; shift < timing.quanta(); ++shift) {
      CoreBench bench;
      bench.dut().preset_counters(248, 0);
      bench.dut().start();
      bench.run_bits(5);
      if (off) {
        bench.run_bits(10);
        bench.dut().request(kGv1);
        bench.invert(0, {.field = Field::kSof});
        bench.run_bits(20);
      }
      EXPECT_EQ(bench.place().field(), off ? Field::kBusOff : Field::kInteg);
      for (unsigned n = 0; n < shift; ++n) bench.clock(Level::kRecessive);
      const unsigned clocks = clocks_to_sample(bench);
      EXPECT_GE(clocks, least) << shift;
      EXPECT_LE(clocks, least + 1) << shift;
    }
  }
}

}  // namespace
}  // namespace vericansim
