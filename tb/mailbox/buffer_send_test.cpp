// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Transmission against the model of the buffers: the order among many buffers, one-shot, automatic
// answers, requests that turn into receive buffers (flexcan.md 3.3, 3.7; one-shot: MO-09).
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

// LBUF and LPRIO_EN as the bits of a number.
class SendOrder : public ::testing::TestWithParam<unsigned> {};

// FX-3.3.a, FX-3.3.b, FX-3.3.c, FX-3.3.d, FX-3.3.e, FX-CTRL1.LBUF, FX-MCR.LPRIO_EN, AR-13: random
// sets of buffers with equal identifiers, formats and PRIO among them. FX-3.3.g, FX-3.3.h,
// FX-3.2.l: each is sent, with its stamp. FX-3.2.f, FX-3.2.g, FX-3.7.a. FX-MCR.MAXMB.
TEST_P(SendOrder, RandomSets) {
  for (const unsigned num_mb : {16u, 32u, 64u}) {
    const unsigned seed = 100 * num_mb + GetParam();
    SCOPED_TRACE(testing::Message() << num_mb << " buffers, seed " << seed);
    std::mt19937 rng{seed};
    BufferRig rig{{.num_mb = num_mb,
                   .maxmb = num_mb - 2,
                   .lprio_en = (GetParam() & 2) != 0,
                   .lbuf = (GetParam() & 1) != 0}};
    for (unsigned round = 0; round < 4 && !HasFailure(); ++round) {
      for (unsigned mb = 0; mb < num_mb; ++mb) {
        const bool extended = rng() % 2 != 0;
        const std::uint32_t base = 0x100 + (rng() & 3u);
        const std::uint32_t low = rng() & 3u;
        MbWords words = mb_words({.id = extended ? (base << 18) | low : base,
                                  .extended = extended,
                                  .remote = rng() % 4 == 0,
                                  .dlc = static_cast<std::uint8_t>(mb % 3),
                                  .data = {static_cast<std::uint8_t>(mb % 3 > 0 ? mb : 0)}},
                                 kTxActive);
        words.id |= static_cast<std::uint32_t>(rng() % 3) << 29;
        rig.put(mb, words);
      }
      rig.go();
      rig.quiet();
      rig.compare();
      EXPECT_EQ(rig.sent().size(), (round + 1) * (num_mb - 1));
      ASSERT_TRUE(rig.freeze());
      rig.write(reg::kIflag1, 0xFFFFFFFF);
      if (num_mb > 32) rig.write(reg::kIflag2, 0xFFFFFFFF);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LbufAndPrio, SendOrder, ::testing::Range(0u, 4u));

// Global one-shot, or by buffer.
class OneShot : public ::testing::TestWithParam<bool> {
 protected:
  OneShot() : rig_{{.num_mb = 16, .maxmb = 15, .one_shot = !GetParam(), .osmb = GetParam()}} {
    rig_.go();
  }
  void send(unsigned mb, const Frame &frame, bool once) {
    MbWords words = mb_words(frame, kTxActive);
    if (once && GetParam()) words.cs |= reg::kCsOneShot;
    rig_.put(mb, words);
  }
  void forget_errors() {
    ASSERT_TRUE(rig_.freeze());
    rig_.write(reg::kEcr, 0);
    rig_.go();
    rig_.peer().preset_counters(0, 0);
    rig_.disturb(0, 0);
    rig_.write(reg::kIflag1, 0xFFFF);
  }
  BufferRig rig_;
};

// MO-09, PF-19: an error in any bit, exactly one start, and the failure is told.
TEST_P(OneShot, AnErrorInAnyBit) {
  const Frame frame{.id = 0x2AA, .dlc = 1, .data = {0x33}};
  for (unsigned bit = 1; bit < encode_frame(frame).bits.size() && !HasFailure(); ++bit) {
    SCOPED_TRACE(testing::Message() << "bit " << bit);
    const std::uint64_t sent = rig_.sent().size();
    const std::uint64_t starts = rig_.frames_started();
    rig_.disturb(bit);
    send(4, frame, true);
    rig_.quiet();
    rig_.compare();
    const std::uint32_t code = (rig_.read(reg::mb(4)) >> 24) & 0xF;
    EXPECT_EQ(rig_.frames_started(), starts + 1);
    EXPECT_EQ(code, rig_.sent().size() > sent ? kTxInactive : kTxAbort);
    EXPECT_EQ(rig_.read(reg::kIflag1), 1u << 4);
    forget_errors();
  }
}

// MO-09: arbitration lost at each bit of the identifier, ID28 included.
TEST_P(OneShot, ALossInAnyIdentifierBit) {
  for (unsigned bit = 0; bit < 11 && !HasFailure(); ++bit) {
    SCOPED_TRACE(testing::Message() << "bit " << bit);
    rig_.peer_sends({.id = 0x7FF ^ (1u << bit), .dlc = 0});
    rig_.peer_sends({.id = 0x7FF ^ (1u << bit), .dlc = 0});
    rig_.run_bits(20);  // during the first of these
    send(4, {.id = 0x7FF, .dlc = 2, .data = {1, 2}}, true);
    const std::uint64_t sent = rig_.sent().size();
    rig_.quiet();
    rig_.compare();
    EXPECT_EQ(rig_.sent().size(), sent);
    EXPECT_EQ((rig_.read(reg::mb(4)) >> 24) & 0xF, static_cast<unsigned>(kTxAbort));
    rig_.write(reg::kIflag1, 0xFFFF);
  }
}

// By buffer: another one without the bit is tried again; C/S bit 28 reads 0.
TEST_P(OneShot, OthersAreTriedAgain) {
  rig_.disturb(30, 2);
  send(4, {.id = 0x100, .dlc = 0}, true);
  send(6, {.id = 0x200, .dlc = 0}, false);
  rig_.quiet();
  rig_.compare();
  EXPECT_EQ((rig_.read(reg::mb(4)) >> 24), static_cast<unsigned>(kTxAbort));
  const auto expected = GetParam() ? kTxInactive : kTxAbort;
  EXPECT_EQ((rig_.read(reg::mb(6)) >> 24), static_cast<unsigned>(expected));
}

INSTANTIATE_TEST_SUITE_P(GlobalAndByBuffer, OneShot, ::testing::Bool());

class Answer : public ::testing::TestWithParam<unsigned> {
 protected:
  Answer() : rig_{{.num_mb = GetParam(), .maxmb = GetParam() - 1}} {}
  BufferRig rig_;
};

// FX-3.7.b, FX-3.2.h, FX-3.2.i, FX-3.5.d: the answer has the DLC of its buffer, follows the request
// at once, without an overload frame, and the buffer waits for the next one.
TEST_P(Answer, FollowsTheRequest) {
  const unsigned mb = GetParam() - 1;
  const Frame answer{.id = 0x321, .dlc = 4, .data = {9, 8, 7, 6}};
  rig_.put_tx(mb, answer, kTxAnswerWaits);
  rig_.go();
  for (unsigned round = 1; round <= 3; ++round) {
    const std::uint64_t frames = rig_.frames_started();
    rig_.peer_sends({.id = 0x321, .remote = true, .dlc = 1});
    ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 200));
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field() == Field::kInt; }, 1000));
    const std::uint64_t gap = rig_.clocks();
    ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() == frames + 2; }, 200));
    EXPECT_LE(rig_.clocks() - gap, 3u * BufferRig::kBit + 1) << "not in the first bit after INT3";
    rig_.quiet();
    rig_.compare();
    ASSERT_EQ(rig_.sent().size(), round);
    EXPECT_EQ(rig_.sent().back(), answer);
    EXPECT_EQ((rig_.read(reg::mb(mb)) >> 24) & 0xF, static_cast<unsigned>(kTxAnswerWaits));
  }
}

// FX-3.7.b, FX-3.7.c: normal arbitration with other buffers; RTR=1 answers with a remote frame.
TEST_P(Answer, HasNoExtraPriority) {
  rig_.put_tx(3, {.id = 0x321, .remote = true, .dlc = 5}, kTxAnswerWaits);
  rig_.go();
  const std::uint64_t frames = rig_.frames_started();
  rig_.peer_sends({.id = 0x321, .remote = true, .dlc = 1});
  ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 200));
  rig_.put_tx(5, {.id = 0x100, .dlc = 0});
  rig_.put_tx(1, {.id = 0x400, .dlc = 0});
  rig_.quiet();
  rig_.compare();
  ASSERT_EQ(rig_.sent().size(), 3u);
  EXPECT_EQ(rig_.sent()[0].id, 0x100u);
  EXPECT_EQ(rig_.sent()[1], (Frame{.id = 0x321, .remote = true, .dlc = 5}));
}

// FX-3.4.e: AEN=1 does not take a waiting answer for a frame to abort: 1001 is written like any
// other code, nothing is sent for it, and another buffer can wait in its place.
TEST_P(Answer, IsWrittenNotAborted) {
  BufferConfig config = rig_.config();
  config.aen = true;
  rig_.configure(config);
  rig_.put_tx(3, {.id = 0x321, .dlc = 1}, kTxAnswerWaits);
  rig_.go();
  rig_.write(reg::mb(3), kTxAbort << 24);
  rig_.quiet();
  rig_.receive({.id = 0x321, .remote = true});
  EXPECT_TRUE(rig_.sent().empty());
  rig_.compare();
  rig_.write(reg::kIflag1, 1u << 3);
  rig_.put_tx(3, {.id = 0x321, .dlc = 1}, kTxAnswerWaits);
  rig_.receive({.id = 0x321, .remote = true});
  EXPECT_EQ(rig_.sent().size(), 1u);
  rig_.compare();
}

INSTANTIATE_TEST_SUITE_P(NumMb, Answer, ::testing::Values(16u, 64u));

}  // namespace
}  // namespace vericansim
