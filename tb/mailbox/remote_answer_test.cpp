// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Automatic answers to remote frames: code 1010 waits, 1110 answers (flexcan.md 3.2, 3.5, 3.7).
#include <gtest/gtest.h>

#include <cstdint>

#include "mailbox/buffer_rig.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kAsker = 0, kAnswerer = 1;
constexpr unsigned kAsk = 10, kWait = 20, kOther = 30;  // buffers
constexpr unsigned kRanswer = 0xA, kTanswer = 0xE;

Frame frame_of(std::uint32_t id, unsigned dlc, bool extended = false) {
  Frame frame;
  frame.id = id;
  frame.extended = extended;
  frame.dlc = static_cast<std::uint8_t>(dlc);
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(0xC0 + 3 * i + dlc);
  return frame;
}

Frame request_of(const Frame &frame, unsigned dlc) {
  Frame request;
  request.id = frame.id;
  request.extended = frame.extended;
  request.remote = true;
  request.dlc = static_cast<std::uint8_t>(dlc);
  return request;
}

class RemoteAnswer : public ::testing::Test {
 protected:
  RemoteAnswer() : rig_{2} {
    for (unsigned n : {kAsker, kAnswerer}) rig_.configure(n);
  }

  void join() {
    for (unsigned n : {kAsker, kAnswerer}) rig_.go(n);
  }
  void wait_with(unsigned mb, const Frame &answer) {
    rig_.put(kAnswerer, mb, mb_words(answer, kRanswer));
  }
  /// Sends a request; its buffer then is an EMPTY one for the answer.
  void ask(const Frame &request) {
    rig_.put_tx(kAsker, kAsk, request);
    ASSERT_TRUE(rig_.wait_flag(kAsker, kAsk));
    rig_.clear_flag(kAsker, kAsk);
    EXPECT_EQ(code(kAsker, kAsk), 4u);
  }
  /// The answer in the buffer that asked; nothing within the time of three frames: none.
  std::optional<Frame> answer() {
    if (!rig_.wait_flag(kAsker, kAsk, 3 * 160 * 8)) return std::nullopt;
    const MbWords words = rig_.get(kAsker, kAsk);
    rig_.clear_flag(kAsker, kAsk);
    rig_.read(kAsker, reg::kTimer);
    return mb_frame(words);
  }
  unsigned code(unsigned n, unsigned mb) { return (rig_.read(n, reg::mb(mb)) >> 24) & 0xF; }

  MailboxRig rig_;
};

TEST_F(RemoteAnswer, ComesFromTheBufferWithItsOwnLength) {  // FX-3.7.b, FX-3.7.a
  for (bool extended : {false, true}) {
    const Frame frame = frame_of(extended ? 0x1ABCDE5 : 0x2A5, 3, extended);
    wait_with(kWait, frame);
    if (!extended) join();
    ask(request_of(frame, 8));
    EXPECT_EQ(rig_.flags(kAnswerer), 0u) << "the request sets no flag";
    EXPECT_EQ(code(kAnswerer, kWait), kTanswer);
    EXPECT_EQ(answer(), frame);
    EXPECT_EQ(rig_.flags(kAnswerer), std::uint64_t{1} << kWait);
    const MbWords words = rig_.get(kAnswerer, kWait);
    EXPECT_EQ(words.code(), kRanswer) << "it waits again";
    EXPECT_EQ(mb_frame(words), frame);
    rig_.clear_flag(kAnswerer, kWait);
  }
}

TEST_F(RemoteAnswer, OnlyTheCodeIsWrittenByTheRequest) {  // FX-3.5.d
  const Frame frame = frame_of(0x555, 5);
  rig_.put(kAnswerer, kWait, mb_words(frame, kRanswer));
  rig_.write(kAnswerer, reg::mb(kWait), mb_words(frame, kRanswer).cs | 0xBEEF);
  join();
  rig_.put_tx(kAsker, kAsk, request_of(frame, 1));
  ASSERT_TRUE(rig_.run_until([&] { return code(kAnswerer, kWait) == kTanswer; }, 2000));
  MbWords words = rig_.get(kAnswerer, kWait);
  EXPECT_EQ(words, (MbWords{mb_words(frame, kTanswer).cs | 0xBEEF, mb_words(frame, 0).id,
                            mb_words(frame, 0).low, mb_words(frame, 0).high}));
}

TEST_F(RemoteAnswer, EveryRequestIsAnsweredOnce) {  // FX-3.7.b
  const Frame frame = frame_of(0x100, 8);
  wait_with(kWait, frame);
  join();
  for (unsigned i = 0; i < 10; ++i) {
    ask(request_of(frame, 8));
    EXPECT_EQ(answer(), frame);
    EXPECT_FALSE(answer()) << "no second one";
    rig_.clear_flag(kAnswerer, kWait);
  }
}

TEST_F(RemoteAnswer, NeedsTheExactIdentifierWhateverTheMask) {  // FX-3.5.d, FX-3.5.h
  for (std::uint32_t eacen : {0u, reg::kCtrl2Eacen}) {
    for (bool extended : {false, true}) {
      const Frame frame = frame_of(extended ? 0x0F0F0F0F : 0x30F, 2, extended);
      rig_.freeze(kAnswerer);
      rig_.write(kAnswerer, reg::kCtrl2, eacen);
      rig_.write(kAnswerer, reg::rximr(kWait), 0);
      for (std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask, reg::kRxfgmask})
        rig_.write(kAnswerer, mask, 0);
      wait_with(kWait, frame);
      join();
      for (unsigned bit = 0; bit < (extended ? 29 : 11); bit += 3) {
        Frame near = frame;
        near.id ^= 1u << bit;
        ask(request_of(near, 2));
        EXPECT_FALSE(answer()) << "bit " << bit;
        EXPECT_EQ(rig_.flags(kAnswerer), 0u) << "not sent either, bit " << bit;
      }
      ask(request_of(frame, 2));
      EXPECT_EQ(answer(), frame);
      rig_.clear_flag(kAnswerer, kWait);
    }
  }
}

TEST_F(RemoteAnswer, NeedsTheSameKindOfIdentifier) {  // FX-3.5.d
  const Frame frame = frame_of(0x30F, 2);
  rig_.write(kAnswerer, reg::kCtrl2, reg::kCtrl2Eacen);
  rig_.write(kAnswerer, reg::rximr(kWait), 0);
  wait_with(kWait, frame);
  join();
  ask(request_of(frame_of(0x30F << 18, 2, true), 2));
  EXPECT_FALSE(answer());
  EXPECT_EQ(code(kAnswerer, kWait), kRanswer);
}

// With nothing else to send it follows after the three bits of intermission, from any buffer.
TEST_F(RemoteAnswer, FollowsTheRequestAtOnce) {  // FX-3.3.g, FX-3.7.b, IF-03
  join();
  for (unsigned mb : {2u, 20u, 62u, 33u, 4u}) {
    const Frame frame = frame_of(0x300 + mb, 1);
    wait_with(mb, frame);
    rig_.put_tx(kAsker, kAsk, request_of(frame, 1));
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(kAnswerer) == Field::kEof; }, 2000));
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(kAnswerer) == Field::kInt; }, 100));
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(kAnswerer) != Field::kInt; }, 100));
    EXPECT_EQ(field_name(rig_.field(kAnswerer)), field_name(Field::kSof)) << mb;
    ASSERT_TRUE(rig_.wait_flag(kAnswerer, mb));
    rig_.clear_flag(kAnswerer, mb);
    rig_.run(200);
    rig_.write(kAnswerer, reg::mb(mb), 0);
  }
}

TEST_F(RemoteAnswer, DataFramesAreNoRequests) {  // FX-3.5.a
  const Frame frame = frame_of(0x30F, 2);
  wait_with(kWait, frame);
  join();
  rig_.put_tx(kAsker, kAsk, frame);
  ASSERT_TRUE(rig_.wait_flag(kAsker, kAsk));
  rig_.run(1000);
  EXPECT_EQ(code(kAnswerer, kWait), kRanswer);
  EXPECT_EQ(rig_.flags(kAnswerer), 0u);
}

TEST_F(RemoteAnswer, RequestsAreStoredInsteadWithRrs) {  // FX-3.5.e, FX-CTRL2.RRS
  const Frame frame = frame_of(0x30F, 2);
  rig_.write(kAnswerer, reg::kCtrl2, reg::kCtrl2Rrs);
  wait_with(kWait, frame);
  rig_.put_rx(kAnswerer, kOther, frame);
  join();
  ask(request_of(frame, 7));
  EXPECT_FALSE(answer());
  EXPECT_EQ(code(kAnswerer, kWait), kRanswer);
  EXPECT_EQ(rig_.flags(kAnswerer), std::uint64_t{1} << kOther);
  EXPECT_EQ(mb_frame(rig_.get(kAnswerer, kOther)), request_of(frame, 7));
}

TEST_F(RemoteAnswer, IsARemoteFrameIfTheBufferSaysSo) {  // FX-3.7.c
  const Frame frame = request_of(frame_of(0x30F, 0), 6);
  wait_with(kWait, frame);
  rig_.write(kAsker, reg::kCtrl2, reg::kCtrl2Rrs);
  join();
  ask(request_of(frame, 1));
  EXPECT_EQ(answer(), frame);
}

TEST_F(RemoteAnswer, HasNoPriorityOfItsOwn) {  // FX-3.7.b
  const Frame frame = frame_of(0x500, 1), urgent = frame_of(0x400, 2);
  wait_with(kWait, frame);
  rig_.put_rx(kAsker, kOther, urgent);
  join();
  rig_.put_tx(kAsker, kAsk, request_of(frame, 1));
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(kAnswerer) == Field::kCrc; }, 2000));
  rig_.put_tx(kAnswerer, kOther, urgent);
  ASSERT_TRUE(rig_.wait_flag(kAsker, kOther));
  EXPECT_EQ(code(kAnswerer, kWait), kTanswer) << "waits for its turn";
  rig_.clear_flag(kAsker, kAsk);
  EXPECT_EQ(answer(), frame);
}

// Bit 28 of C/S asks for one-shot along with code 1100 only: an answer that loses comes later.
TEST_F(RemoteAnswer, IsNoOneShotWhateverIsWrittenWithItsCode) {  // FX-3.7.b, RO-03, MO-09
  const Frame frame = frame_of(0x500, 1), urgent = frame_of(0x400, 2);
  rig_.write(kAnswerer, reg::kExtControl, reg::kXctrlOsmb);
  MbWords words = mb_words(frame, kRanswer);
  words.cs |= reg::kCsOneShot;
  rig_.put(kAnswerer, kWait, words);
  join();
  rig_.put_tx(kAsker, kAsk, request_of(frame, 1));
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(kAsker) == Field::kCrc; }, 2000));
  rig_.put_tx(kAsker, kOther, urgent);
  ASSERT_TRUE(rig_.wait_flag(kAsker, kOther));
  rig_.clear_flag(kAsker, kAsk);
  EXPECT_EQ(answer(), frame);
}

TEST_F(RemoteAnswer, ComesFromTheLowestBufferUpToMaxmb) {  // FX-3.5.a
  const Frame first = frame_of(0x123, 1), second = frame_of(0x123, 2);
  wait_with(kWait, first);
  wait_with(kWait + 1, second);
  join();
  ask(request_of(first, 0));
  EXPECT_EQ(answer(), first);
  ASSERT_TRUE(rig_.freeze(kAnswerer));
  rig_.write(kAnswerer, reg::mb(kWait), 0);
  rig_.write(kAnswerer, reg::kMcr,
             reg::kMcrFrz | reg::kMcrHalt | reg::kMcrBcc | reg::kMcrSrxDis | kWait);
  rig_.go(kAnswerer);
  ask(request_of(first, 0));
  EXPECT_FALSE(answer());
  EXPECT_EQ(code(kAnswerer, kWait + 1), kRanswer);
}

// A C/S write around the move 1010 -> 1110, in every clock: what the CPU wrote is what is read.
TEST_F(RemoteAnswer, NeverOverwritesWhatTheCpuWrites) {  // FX-3.4.g
  const Frame frame = frame_of(0x333, 1);
  join();
  unsigned answered = 0;
  for (unsigned n = 0; n < 200; ++n) {
    const unsigned wait = n / 2;
    const std::uint32_t written = n % 2 == 0 ? 0x08020000 : 0x04020000;
    wait_with(kWait, frame);
    rig_.put_tx(kAsker, kAsk, request_of(frame, 1));
    // From the last bits of EOF on.
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(kAnswerer) == Field::kEof; }, 2000));
    rig_.run(wait);
    rig_.write(kAnswerer, reg::mb(kWait), written);
    rig_.run(1200);
    EXPECT_EQ(rig_.read(kAnswerer, reg::mb(kWait)) & 0x0F7F0000, written) << wait;
    if (((rig_.flags(kAsker) >> kAsk) & 1) != 0 && code(kAsker, kAsk) == 2) ++answered;
    rig_.clear_flag(kAsker, kAsk);
    rig_.clear_flag(kAnswerer, kWait);
    rig_.write(kAsker, reg::mb(kAsk), 0x08000000);
  }
  EXPECT_GT(answered, 0u) << "late writes find the answer on the bus";
  EXPECT_LT(answered, 120u);
}

// Frames for the FIFO, which takes everything (format C, masks 0) or nothing (D).
TEST_F(RemoteAnswer, FramesThatTheFifoTakesAreNotAnswered) {  // FX-3.7.d, FX-4.k, FX-4.l
  const Frame frame = frame_of(0x123, 4);
  struct {
    unsigned format;
    std::uint32_t ctrl2;
    unsigned fill;
    bool answers;
  } cases[] = {{2, 0, 0, false}, {3, 0, 0, true}, {2, 0, 6, true}, {2, reg::kCtrl2Mrp, 0, true}};
  bool first = true;
  for (const auto &[format, ctrl2, fill, answers] : cases) {
    rig_.freeze(kAnswerer);
    const std::uint32_t mcr =
        reg::kMcrFrz | reg::kMcrHalt | reg::kMcrBcc | reg::kMcrSrxDis | reg::mcr_idam(format) | 63;
    rig_.write(kAnswerer, reg::kMcr, mcr);
    rig_.write(kAnswerer, reg::kMcr, mcr | reg::kMcrFen);
    rig_.write(kAnswerer, reg::kCtrl2, ctrl2);
    for (unsigned k = 0; k < 8; ++k) rig_.write(kAnswerer, reg::rximr(k), 0);
    wait_with(kWait, frame);
    rig_.go(kAnswerer);
    if (first) rig_.go(kAsker);
    first = false;
    for (unsigned i = 0; i < fill; ++i) ask(request_of(frame_of(0x321, 0), i));
    ask(request_of(frame, 4));
    EXPECT_EQ(answer().has_value(), answers) << format << ' ' << ctrl2 << ' ' << fill;
    const std::uint32_t flags = rig_.read(kAnswerer, reg::kIflag1);
    EXPECT_EQ((flags & reg::kIflagFifo) != 0, fill != 0 || !answers);
    EXPECT_EQ(flags & reg::kIflagFifoOvf, 0u);
    EXPECT_EQ(code(kAnswerer, kWait), kRanswer);
    rig_.clear_flag(kAnswerer, kWait);
  }
}

}  // namespace
}  // namespace vericansim
