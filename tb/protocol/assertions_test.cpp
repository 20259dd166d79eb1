// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Always-on assertions where they need a finer look than a bit, or a scenario of their own; and
// that the observer itself sees what it is there for.
#include <gtest/gtest.h>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::whole;

// TH-06, BT-05: the pin changes at the start of a bit and nowhere else, in frames, acknowledges,
// flags of all kinds and at arbitration.
TEST(Always, PinChangesAtTheStartOfABitOnly) {
  CoreBench bench(2);
  bench.dut(1).preset_counters(120, 0);
  bench.start();
  for (unsigned n = 0; n < 6; ++n) {
    bench.dut(0).request({.id = 0x155 + n, .dlc = 8, .data = {0x0F, 0x00, 0xAA, 0xFF}});
    bench.dut(1).request({.id = 0x15A - n, .dlc = 2, .data = {0xF0, 0x0F}});
  }
  const unsigned places[] = {3, 5, 7};
  for (const unsigned index : places) {
    bench.invert(0, {.field = Field::kData, .index = index});
    bench.invert(1, {.field = Field::kCrc, .index = index});
    bench.invert(0, {.field = Field::kErrFlag, .index = 2});
  }
  bool boundary[2] = {false, false};
  Level before[2] = {bench.dut(0).tx(), bench.dut(1).tx()};
  unsigned edges = 0;
  for (unsigned clock = 0; clock < 40'000; ++clock) {
    bench.clock(Level::kRecessive);
    for (unsigned i = 0; i < 2; ++i) {
      if (bench.dut(i).tx() != before[i]) {
        EXPECT_TRUE(boundary[i]) << "DUT " << i << " clock " << clock;
        ++edges;
      }
      before[i] = bench.dut(i).tx();
      boundary[i] = (bench.dut(i).trace() & kTraceBoundary) != 0;
    }
  }
  EXPECT_GT(edges, 500u);
  EXPECT_EQ(bench.dut(0).sent().size(), 6u);
  EXPECT_EQ(bench.dut(1).sent().size(), 6u);
}

// TH-06, IF-17: recessive in reset, while stopped, integrating and in idle, clock by clock.
TEST(Always, PinIsRecessiveWhenNothingIsSent) {
  CoreBench bench;
  for (unsigned clock = 0; clock < 50; ++clock) {
    bench.clock(clock % 7 < 3 ? Level::kDominant : Level::kRecessive);
    EXPECT_EQ(bench.dut().tx(), Level::kRecessive);
  }
  bench.dut().start();
  for (unsigned clock = 0; clock < 400; ++clock) {
    bench.clock(clock < 100 && clock % 40 < 20 ? Level::kDominant : Level::kRecessive);
    EXPECT_EQ(bench.dut().tx(), Level::kRecessive);
  }
  EXPECT_TRUE(bench.dut().idle());
}

class Liveness : public ::testing::TestWithParam<Counters> {};

INSTANTIATE_TEST_SUITE_P(States, Liveness, ::testing::Values(kActive, kPassive, kPassiveByRec));

// TH-07: the bus turns quiet at any moment of a broken frame and of what follows it: the frame that
// waits starts within 26 bits once no frame is under way.
TEST_P(Liveness, PendingFrameStartsOnAQuietBus) {
  for (const bool transmitter : {false, true}) {
    for (int n = 0; n < 40; ++n) {
      ErrorRig rig(GetParam());
      if (transmitter) rig.send(kGv1);
      rig.play(transmitter ? "!" : "000000");
      std::string noise;
      for (int k = 0; k < n; ++k) noise += (k * 5 + n) % 7 < 3 ? "0" : "1";
      rig.play(noise);
      rig.request({.id = 0x0F0});
      const auto in_frame = [&] {
        return rig.field() >= Field::kSof && rig.field() <= Field::kEof && !rig.last().transmitter;
      };
      for (int k = 0; k < 80 && in_frame(); ++k) rig.play(".");
      const unsigned started = rig.dut().events().started;
      int bits = 0;
      while (rig.dut().events().started == started && rig.field() != Field::kSof && bits < 40) {
        rig.play(".");
        ++bits;
      }
      EXPECT_LE(bits, 26) << n;
    }
  }
}

// TH-07, IN-04: twelve when integrating.
TEST(LivenessOfANewNode, StartsInTheTwelfthBit) {
  CoreBench bench;
  bench.dut().request(kGv1);
  bench.lt("0000");
  bench.dut().start();
  bench.run_bits(4);
  unsigned bits = 0;
  while (bench.place().field() != Field::kSof && bits < 30) {
    bench.step();
    ++bits;
  }
  EXPECT_LE(bits, 12u);
}

// The observer must notice: bits that no engine would ever show are handed to it.
class Observer : public ::testing::Test {
 protected:
  [[nodiscard]] bool notices(const DutBit &first, const DutBit &second) {
    CoreBench bench;
    Assertions assertions{bench};
    bench.on_bit(0, first);
    bench.on_bit(0, second);
    return !assertions.hold();
  }
  static constexpr Level kD = Level::kDominant;
};

// TH-06
TEST_F(Observer, SeesDominantBitsWhereNoneMayBe) {
  const DutBit idle{.field = Field::kIdle};
  for (const Field field : {Field::kIdle, Field::kInteg, Field::kBusOff, Field::kInt, Field::kWait,
                            Field::kDel, Field::kSuspend, Field::kEof, Field::kAckDel}) {
    EXPECT_TRUE(notices(idle, {.tx = kD, .sent_level = kD, .rx = kD, .field = field}));
  }
  EXPECT_TRUE(notices(idle, {.tx = kD, .sent_level = kD, .field = Field::kData}));  // as receiver
  EXPECT_FALSE(notices(idle, {.tx = kD, .sent_level = kD, .rx = kD, .field = Field::kAck}));
  EXPECT_FALSE(notices(idle, {.tx = kD, .sent_level = kD, .rx = kD, .field = Field::kOvlFlag}));
}

// TH-06, FC-01
TEST_F(Observer, SeesIllegalStepsOfTheCounters) {
  const DutBit before{.field = Field::kData, .transmitter = true, .tec = 50, .rec = 50};
  DutBit after = before;
  after.tec = 58;
  EXPECT_FALSE(notices(before, after));
  after.rec = 51;
  EXPECT_TRUE(notices(before, after));
  after = before;
  after.rec = 51;
  EXPECT_TRUE(notices(before, after));
  after = before;
  after.tec = 66;
  EXPECT_TRUE(notices(before, after));
  after = before;
  after.transmitter = false;
  after.tec = 58;
  EXPECT_TRUE(notices(before, after));
}

// TH-06
TEST_F(Observer, SeesMisplacedEvents) {
  const DutBit idle{.field = Field::kIdle};
  EXPECT_TRUE(notices(idle, {.field = Field::kEof, .left = 0, .delivered = true}));
  EXPECT_FALSE(notices(idle, {.field = Field::kEof, .left = 1, .delivered = true}));
  EXPECT_TRUE(notices(idle, {.field = Field::kEof, .left = 1, .transmitter = true, .sent = true}));
  EXPECT_TRUE(notices(idle, {.field = Field::kEof, .left = 0, .transmitter = true, .sent = true}))
      << "there was no frame on the wire";
}

}  // namespace
}  // namespace vericansim
