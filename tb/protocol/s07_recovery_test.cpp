// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 7 of the rule book: roles, and how a node gets over an error.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

const Frame kFrame = base_frame(0x2C5, {0x69, 0xC3});

// Sends kFrame up to its r0 and breaks that bit; the next bit is the first of the flag.
void break_own_frame(Scene &scene) {
  scene.send(kFrame);
  scene.play(r_bits(offset_of(kFrame, Field::kR0, 0)));
  scene.bench.force_next(0, Effect::kRecessive);
  EXPECT_EQ(scene.play("1"), "0");
}

// Lets a foreign frame break with a stuff error; the next bit is the first of the flag.
void break_foreign_frame(Scene &scene) { EXPECT_EQ(scene.play(d_bits(6)), r_bits(6)); }

class Roles : public ::testing::TestWithParam<Counters> {
 protected:
  [[nodiscard]] static const Counters &counters() { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(States, Roles, ::testing::ValuesIn(kStates),
                         [](const auto &state) { return state_name(state.param); });

// RO-01, FC-16: the transmitter stays that through flag, delimiter and the error frames that follow
// its frame: errors in its delimiters are TEC + 8, not REC + 1.
TEST_P(Roles, TransmitterStaysTransmitterThroughErrorFrames) {
  Scene scene{counters()};
  break_own_frame(scene);
  for (unsigned errors = 2; errors < 5; ++errors) {
    // The flag, DEL1..DEL3 and a form error in DEL4, which begins the next flag.
    EXPECT_EQ(scene.play(r_bits(6 + 3) + "0").substr(6), "1111");
    EXPECT_EQ(scene.events().errors & kErrForm, kErrForm);
  }
  scene.play("1");
  scene.expect_counters(counters().tec + 8u * 4, counters().rec);
}

// RO-01, FC-16: and through an overload frame after its own success.
TEST_P(Roles, TransmitterStaysTransmitterThroughOverloadFrames) {
  Scene scene{counters()};
  scene.send(kFrame);
  scene.play(flipped(r_bits(wire(kFrame).size()), ack_offset(kFrame)));
  const unsigned tec = scene.tec();
  EXPECT_EQ(scene.play("0" + r_bits(6) + "1110"), "1" + d_bits(6) + "1111");
  scene.play("1");
  scene.expect_counters(tec + 8, counters().rec);
}

// RO-02: receivers count the same errors with REC + 1.
TEST_P(Roles, ReceiverStaysReceiverThroughErrorFrames) {
  Scene scene{counters()};
  break_foreign_frame(scene);
  scene.play(r_bits(6 + 3) + "0" + "1");
  scene.expect_counters(counters().tec, counters().rec + 2u);
}

// RO-02: a node that sees a dominant bit in INT3, suspend or idle after its own frame is receiver
// of the new one: a stuff error in it counts with REC, and no suspend follows.
TEST_P(Roles, TransmitterBecomesReceiverWithTheNextForeignSof) {
  for (const unsigned wait : {2u, 3u, 7u, 10u, 11u, 20u}) {
    Scene scene{counters()};
    scene.send(kFrame);
    scene.play(flipped(r_bits(wire(kFrame).size()), ack_offset(kFrame)) + r_bits(wait));
    const unsigned tec = scene.tec();
    break_foreign_frame(scene);
    scene.play("1");
    scene.expect_counters(tec, counters().rec + 1u);
    scene.request(kFrame);
    EXPECT_EQ(scene.play(r_bits(5 + 8 + 3 + 1)).substr(5), r_bits(11) + "0") << wait;
  }
}

// RO-03, RO-04, TL-01, TL-02: a frame ended by an error is sent again by itself: SOF at n + 18, of
// a passive node at n + 26; each further dominant bit after the flag adds one. TL-09: worst cases
// with six of them: 23 and 31 bits between.
TEST_P(Roles, RetryStartsAtTheDistanceOfTheRule) {
  for (unsigned more = 0; more <= 6; ++more) {
    Scene scene{counters()};
    break_own_frame(scene);
    const bool passive = counters().passive();
    const unsigned wait = passive ? 25 : 17;
    const std::string lt = r_bits(6) + d_bits(more) + r_bits(wait - 6);
    EXPECT_EQ(scene.play(lt), flag_of(counters()) + r_bits(wait + more - 6)) << more;
    EXPECT_EQ(wait + 6, passive ? 31u : 23u);
    const std::string bits = wire(kFrame);
    EXPECT_EQ(scene.play(flipped(r_bits(bits.size()), ack_offset(kFrame))), bits);
    EXPECT_EQ(scene.events().sent, 1u);
  }
}

// RO-03: the frame stays pending through any number of errors, at whatever bit.
TEST_P(Roles, FrameIsRetriedAfterAnErrorAtEveryBit) {
  const std::string bits = wire(kFrame);
  for (std::size_t at = 0; at < bits.size(); ++at) {
    if (at == ack_offset(kFrame)) continue;
    const bool arbitration = at > 0 && at < offset_of(kFrame, Field::kIde, 0);
    if (arbitration && bits[at] == '1') continue;
    Scene scene{counters()};
    scene.send(kFrame);
    const std::string lt = flipped(r_bits(bits.size()), ack_offset(kFrame));
    scene.play(lt.substr(0, at));
    scene.bench.force_next(0, Effect::kFlip);
    EXPECT_EQ(scene.play("1" + r_bits(6)), bits[at] + flag_of(counters())) << at;
    const unsigned wait = counters().passive() ? 8 + 3 + 8 : 8 + 3;
    EXPECT_EQ(scene.play(r_bits(wait)), r_bits(wait)) << at;
    EXPECT_EQ(scene.play(lt), bits) << at;
    EXPECT_EQ(scene.dut().sent(), std::vector<Frame>{kFrame});
    scene.expect_counters(counters().tec + 8u - 1u, counters().rec);
  }
}

class BrokenReception : public ::testing::TestWithParam<Frame> {};

INSTANTIATE_TEST_SUITE_P(
    Frames, BrokenReception,
    ::testing::Values(base_frame(0x2C5, {0x69, 0xC3, 0x00, 0xFF, 0x12, 0x34, 0x56, 0x78}),
                      extended_frame(0x0B1C5A93, {0x96, 0x0F}), remote_frame(0x078, false, 8),
                      remote_frame(0x1FFFFFFF, true, 0)),
    [](const auto &frame) { return "Number" + std::to_string(frame.index); });

// RO-05, MX-08, MX-10: one bit of a foreign frame is seen inverted, any up to EOF6: nothing is
// delivered, and the next frame arrives as if nothing had been.
TEST_P(BrokenReception, LeavesNothingBehind) {
  const std::string bits = wire(GetParam());
  for (const Counters &counters : kStates) {
    for (std::size_t at = 0; at + 1 < bits.size(); ++at) {
      if (at == ack_offset(GetParam())) continue;
      Scene scene{counters};
      scene.play(flipped(bits, at) + r_bits(30));
      EXPECT_TRUE(scene.dut().received().empty()) << at;
      const Frame next = extended_frame(0x15A5F00F, {1, 2, 3, 4, 5, 6, 7, 8});
      scene.expect_reception(next);
    }
  }
}

// RO-05: an own acknowledge seen recessive is an error too (ED-07): nothing delivered.
TEST_P(BrokenReception, LostAcknowledgeDeliversNothing) {
  const std::string bits = wire(GetParam());
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    scene.play(bits.substr(0, ack_offset(GetParam())));
    scene.bench.force_next(0, Effect::kRecessive);
    EXPECT_EQ(scene.play(r_bits(1 + 6)), "0" + flag_of(counters));
    scene.play(r_bits(8 + 3));
    EXPECT_TRUE(scene.dut().received().empty());
    scene.expect_counters(counters.tec, counters.rec + 1u);
    scene.expect_reception(GetParam());
  }
}

}  // namespace
}  // namespace vericansim
