// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 11, the error states: where they begin and end, and long stories with known numbers.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

// FC-11, FC-12, PF-46: 127 is active, 128 is passive, for either counter and both roles.
TEST(ErrorState, PassiveFrom128On) {
  for (const std::uint8_t level : {std::uint8_t{127}, std::uint8_t{128}}) {
    const bool passive = level == 128;
    for (const Counters counters : {Counters{.tec = level}, Counters{.rec = level}}) {
      ErrorRig r(counters);
      EXPECT_EQ(r.play("000000 ......"), "111111" + std::string(passive ? "111111" : "000000"));
      ErrorRig t(counters);
      t.send(kGv1);
      EXPECT_EQ(t.play("! ......"), "0" + std::string(passive ? "111111" : "000000"));
    }
  }
}

// FC-11: one step up to 128 is enough: 127 + 1 as receiver, 120 + 8 as transmitter.
TEST(ErrorState, BecomesPassiveWithTheStepThatReaches128) {
  ErrorRig r({.rec = 127});
  r.play("00000");
  EXPECT_FALSE(r.last().passive);
  r.play("0");
  EXPECT_TRUE(r.last().passive);
  for (unsigned tec = 119; tec <= 127; ++tec) {
    ErrorRig t({.tec = static_cast<std::uint8_t>(tec)});
    t.send(kGv1);
    t.play("!");
    EXPECT_EQ(t.last().passive, tec >= 120) << tec;
  }
}

// FC-12, IF-11, MX-28: TEC 128 and a success: active at once, and no suspend time.
TEST(ErrorState, ActiveAgainWithTheStepTo127) {
  ErrorRig rig({.tec = 128});
  rig.request(kGv1);
  rig.request({.id = 0x0F0});
  rig.play("." + rep(44, ".") + "0" + rep(7, "."));
  EXPECT_TRUE(rig.last().passive);
  rig.play(".");
  EXPECT_EQ(rig.tec(), 127u);
  EXPECT_FALSE(rig.last().passive);
  EXPECT_EQ(rig.play("...."), "1110");
  ErrorRig longer({.tec = 129});
  longer.request(kGv1);
  longer.request({.id = 0x0F0});
  longer.play("." + rep(44, ".") + "0" + rep(8, "."));
  EXPECT_TRUE(longer.last().passive);
  EXPECT_EQ(longer.play(rep(12, ".")), rep(11, "1") + "0");
}

// FC-12: one good reception from REC >= 128, if TEC allows; both must be at most 127.
TEST(ErrorState, OneGoodReceptionIsEnough) {
  ErrorRig rig({.rec = 200});
  rig.play(kGv1Bits + "1");
  EXPECT_TRUE(rig.last().passive);
  rig.play("0");
  EXPECT_FALSE(rig.last().passive);
  EXPECT_GE(rig.rec(), 119u);
  EXPECT_LE(rig.rec(), 127u);
  ErrorRig both({.tec = 128, .rec = 200});
  both.receive(kGv1);
  EXPECT_LE(both.rec(), 127u);
  EXPECT_TRUE(both.last().passive);
}

// FC-13, PF-44: 248, success 247, one error more 255: passive still; the next one is off.
TEST(ErrorState, TwoHundredFiftyFiveIsNotOff) {
  ErrorRig rig({.tec = 248});
  rig.transmit(kGv1);
  EXPECT_EQ(rig.tec(), 247u);
  rig.play(rep(11, "."));
  rig.send(kGv1);
  rig.play("!");
  EXPECT_EQ(rig.tec(), 255u);
  EXPECT_FALSE(rig.last().bus_off);
  EXPECT_TRUE(rig.last().passive);
  rig.play(rep(6 + 8 + 3 + 8, "."));
  EXPECT_EQ(rig.field(), Field::kSof);
  rig.play("!");
  EXPECT_TRUE(rig.last().bus_off);
}

// FC-13, MX-26: every start from 247 to 255, by one bit error.
TEST(ErrorState, OffFrom256On) {
  for (unsigned tec = 246; tec <= 255; ++tec) {
    ErrorRig rig({.tec = static_cast<std::uint8_t>(tec)});
    rig.send(kGv1);
    rig.play(rep(22, ".") + "!");
    EXPECT_EQ(rig.last().bus_off, tec >= 248) << tec;
  }
}

// FC-14: hundreds of receive errors: never off, never back below 128.
TEST(ErrorState, ReceiveErrorsNeverLeadToBusOff) {
  ErrorRig rig({.rec = 120});
  for (int n = 0; n < 60; ++n) {
    rig.play("000000 000000 0" + rep(24, "0") + rep(11, "1"));
    if (n > 0) {
      EXPECT_GE(rig.rec(), 128u) << n;
    }
    EXPECT_FALSE(rig.last().bus_off) << n;
  }
  EXPECT_EQ(rig.tec(), 0u);
}

// FC-18, TL-03, ED-16: nobody answers. 16 attempts with active flags, then passive ones for ever.
TEST(ErrorState, LoneTransmitterEndsPassiveAt128) {
  ErrorRig rig;
  rig.send(kGv1);
  const int length = static_cast<int>(kGv1Bits.size());
  for (unsigned attempt = 1; attempt <= 40; ++attempt) {
    EXPECT_EQ(rig.field(), Field::kSof) << attempt;
    rig.play(rep(length + 2, "."));
    EXPECT_EQ(rig.tec(), std::min(8 * attempt, 128u)) << attempt;
    const bool active = attempt <= 16;
    EXPECT_EQ(rig.play("......"), active ? "000000" : "111111") << attempt;
    // Suspended from attempt 16 on: the state at INT3 counts (IF-11). L+2+17 and L+2+25.
    rig.play(rep(attempt < 16 ? 11 : 19, "."));
  }
  EXPECT_EQ(rig.field(), Field::kSof);
  EXPECT_FALSE(rig.last().bus_off);
}

// FC-19, TL-11: stuck dominant, starting within a frame: passive in the end, never off.
TEST(ErrorState, StuckDominantLineMakesAReceiverPassive) {
  ErrorRig rig;
  rig.play(kGv1Bits.substr(0, 30) + rep(400, "0"));
  EXPECT_TRUE(rig.last().passive);
  EXPECT_FALSE(rig.last().bus_off);
  EXPECT_EQ(rig.tec(), 0u);
}

// FC-20, TL-12: stuck recessive: 8 a bit up to 136, then 8 a start; 15 retries after the first.
TEST(ErrorState, StuckRecessiveLineEndsInBusOff) {
  ErrorRig rig;
  rig.send(kGv1);
  for (unsigned n = 1; n <= 17; ++n) {
    EXPECT_EQ(rig.play("R"), "0") << n;
    EXPECT_EQ(rig.tec(), 8 * n) << n;
  }
  for (unsigned retry = 1; retry <= 15; ++retry) {
    EXPECT_EQ(rig.play(rep(25, "R")), rep(25, "1")) << retry;
    EXPECT_EQ(rig.play("R"), "0") << retry;
    if (retry < 15) {
      EXPECT_EQ(rig.tec(), 136 + 8 * retry) << retry;
    }
  }
  EXPECT_TRUE(rig.last().bus_off);
}

// FC-21: reset clears; stopping and starting again keeps the counters.
TEST(ErrorState, ResetClearsTheCountersAndStoppingKeepsThem) {
  CoreBench bench;
  bench.dut().preset_counters(77, 99);
  bench.start();
  bench.run_bits(3);
  EXPECT_EQ(bench.last().tec, 77u);
  bench.dut().stop();
  for (int n = 0; n < 30; ++n) bench.clock(Level::kRecessive);
  EXPECT_FALSE(bench.dut().running());
  bench.start();
  bench.run_bits(1);
  EXPECT_EQ(bench.last().tec, 77u);
  EXPECT_EQ(bench.last().rec, 99u);
  bench.dut().reset();
  bench.start();
  bench.run_bits(1);
  EXPECT_EQ(bench.last().tec, 0u);
  EXPECT_EQ(bench.last().rec, 0u);
}

// FC-22, MO-01, MX-24: listening, nothing moves, by errors or by good frames.
TEST(ErrorState, ListenOnlyFreezesTheCounters) {
  CoreConfig config = CoreBench::default_config();
  config.listen_only = true;
  for (const Counters counters : {Counters{.tec = 5, .rec = 7}, Counters{.tec = 128, .rec = 130}}) {
    ErrorRig rig(counters, config);
    rig.play("000000" + rep(20, "0") + rep(11, "1"));
    rig.receive(kGv1);
    rig.play("11 1");
    rig.play(whole(kGv1).substr(0, 50) + "0" + rep(24, "1"));
    EXPECT_EQ(rig.tec(), counters.tec);
    EXPECT_EQ(rig.rec(), counters.rec);
  }
}

// FC-11, FC-23: the warning level 96 is reached and left with the very step, as the counters are
// (ECR and the flags of the host follow them).
TEST(ErrorState, WarningLevelIsCrossedOnceEachWay) {
  ErrorRig t({.tec = 88});
  t.send(kGv1);
  t.play("!");
  EXPECT_EQ(t.tec(), 96u);
  t.play(rep(17, ".") + rep(44, ".") + "0" + rep(8, "."));
  EXPECT_EQ(t.tec(), 95u);
  ErrorRig r({.rec = 95});
  r.play("000000");
  EXPECT_EQ(r.rec(), 96u);
  r.play(rep(17, "."));
  r.receive(kGv1);
  EXPECT_EQ(r.rec(), 95u);
}

// FC-23: the state follows at the sample point of the step: each crossing once, in both directions.
TEST(ErrorState, EachCrossingIsReportedOnce) {
  unsigned changes = 0;
  ErrorRig rig({.rec = 127});
  bool before = false;
  rig.bench.on_bit = [&, then = rig.bench.on_bit](unsigned i, const DutBit &bit) {
    changes += bit.passive != before;
    before = bit.passive;
    then(i, bit);
  };
  rig.play("000000" + rep(17, "."));
  EXPECT_EQ(changes, 1u);
  rig.receive(kGv1);
  rig.play("11111");
  EXPECT_EQ(changes, 2u);
}

}  // namespace
}  // namespace vericansim
