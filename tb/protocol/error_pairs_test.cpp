// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 19.4: the mandatory pairs of disturbances in every state, with the counters that the
// rules name; and what follows. All other single and double disturbances: tb/faults.
#include <gtest/gtest.h>

#include <vector>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::whole;

// 19.1: start counters; half of them passive, by TEC, by REC or by both.
const std::vector<Counters> kCounters = {{0, 0},     {1, 1},     {95, 96},  {96, 95}, {119, 120},
                                         {120, 119}, {126, 0},   {127, 0},  {0, 127}, {128, 0},
                                         {0, 128},   {128, 128}, {247, 0},  {248, 0}, {255, 255},
                                         {0, 255},   {127, 126}, {247, 127}};

const Frame kFrame{.id = 0x123, .dlc = 1, .data = {0x55}};  // GV-1
const Frame kNext{.id = 0x2A5, .dlc = 3, .data = {0xC3, 0x00, 0x7E}};

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

class Pairs : public ::testing::TestWithParam<Counters> {};

INSTANTIATE_TEST_SUITE_P(States, Pairs, ::testing::ValuesIn(kCounters));

// MX-31, AK-03, FC-05a: no acknowledge, then dominant at the ACK delimiter (flag bit 1).
TEST_P(Pairs, NoAcknowledgeThenDominantDelimiter) {
  ErrorRig rig(GetParam());
  rig.send(kFrame);
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
  rig.receive(kFrame);
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
