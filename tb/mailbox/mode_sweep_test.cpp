// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Every way off the bus, asked for in every clock of a frame, by its transmitter and by a receiver
// (flexcan.md 2.1 to 2.3, 2.9, 8.2; MO-13, ERR008341): acknowledged in time, nothing dominant
// afterwards, the frame whole where it must be, the others undisturbed, and back on the bus.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "mailbox/mode_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = ModeRig::kBit;
// SOF to INT3 of a base frame with one byte, 44 + 8 + 3 bits, and the stuff bits of the worst one.
constexpr unsigned kFrameBits = 55 + 10;
// A read of MCR comes back within this, and that many later the request itself has arrived.
constexpr unsigned kAccess = 8;

Frame first_frame(unsigned k) {
  return {.id = 0x155, .dlc = 1, .data = {static_cast<std::uint8_t>(k)}};
}
Frame second_frame(unsigned k) {
  return {.id = 0x2AA, .dlc = 1, .data = {static_cast<std::uint8_t>(~k)}};
}

using Case = std::tuple<Leave, bool>;

class ModeSweep : public ::testing::TestWithParam<Case> {
 protected:
  const Leave how_ = std::get<0>(GetParam());
  const bool transmitter_ = std::get<1>(GetParam());
  ModeRig mode_;
  MailboxRig &rig_ = mode_.rig();

  // A transmitter ends its frame except in a soft reset; so does a receiver, for freeze mode.
  [[nodiscard]] bool waits_for_frame() const {
    return how_ == Leave::kFreeze || (how_ != Leave::kSoftReset && transmitter_);
  }
  [[nodiscard]] bool cuts_own_frame() const { return how_ == Leave::kSoftReset && transmitter_; }

  // The others: no error, unless the subject cut its own frame; that counts as theirs once.
  void others_are_undisturbed() {
    for (unsigned n : {ModeRig::kPeer, ModeRig::kWitness}) {
      const std::uint32_t ecr = rig_.read(n, reg::kEcr), esr = rig_.read(n, reg::kEsr);
      EXPECT_EQ(ecr & 0xFF, 0u);
      EXPECT_LE(ecr >> 8, cuts_own_frame() ? 9u : 0u);
      EXPECT_TRUE((esr & 0xFC02) == 0 || cuts_own_frame());
      rig_.write(n, reg::kEsr, reg::kEsrInterrupts);
    }
  }

  void leave_and_return(unsigned k, bool in_frame) {
    mode_.ask(how_);
    const unsigned bound = (waits_for_frame() ? kFrameBits + 1 : 2) * kBit + kAccess;
    ASSERT_LT(mode_.left(how_, bound + 1), bound + 1) << "acknowledge";
    const unsigned before = mode_.dominant_clocks();
    mode_.run(3 * kBit + k % kBit);
    ASSERT_EQ(mode_.dominant_clocks(), before) << "dominant after the acknowledge";
    const std::uint32_t flags = mode_.read(reg::kIflag1);
    if (in_frame && waits_for_frame()) {
      EXPECT_EQ(flags, transmitter_ ? 1u << 8 : 1u << ModeRig::kRxMb) << "the frame is complete";
    }
    mode_.come_back(how_);
  }

  // After it all: sent once, and a frame in the other direction arrives.
  void back_on_the_bus(unsigned k) {
    ASSERT_TRUE(mode_.quiet());
    const unsigned sender = transmitter_ ? ModeRig::kSubject : ModeRig::kPeer;
    EXPECT_EQ(rig_.read(sender, reg::mb(8)) >> 24, 0x8u) << "sent";
    const unsigned seen = mode_.valid_frames(ModeRig::kWitness);
    // A soft reset between the sixth and the seventh bit of EOF: valid for the receivers only.
    EXPECT_TRUE(seen == 1 || (cuts_own_frame() && seen == 2)) << seen;
    EXPECT_EQ(mb_frame(rig_.get(ModeRig::kWitness, ModeRig::kRxMb)), first_frame(k));
    // MCR.SRX_DIS: nobody receives what it has sent itself, nor half of it.
    if (transmitter_) {
      EXPECT_NE(mb_frame(rig_.get(ModeRig::kSubject, ModeRig::kRxMb)), first_frame(k));
      rig_.read(ModeRig::kSubject, reg::kTimer);  // unlocks
    }
    const unsigned other = transmitter_ ? ModeRig::kPeer : ModeRig::kSubject;
    rig_.put_tx(other, 9, second_frame(k));
    ASSERT_TRUE(rig_.wait_flag(sender, ModeRig::kRxMb));
    EXPECT_EQ(mb_frame(rig_.get(sender, ModeRig::kRxMb)), second_frame(k));
    ASSERT_TRUE(mode_.quiet());
  }

  void tidy_up() {
    for (unsigned n = 0; n < 3; ++n) {
      rig_.write(n, reg::kIflag1, ~0u);
      rig_.read(n, reg::kTimer);  // unlocks
    }
    mode_.clear_counts();
  }
};

// FX-2.1.a, FX-2.2.a, FX-2.2.c, FX-2.2.d, FX-2.3.a, FX-2.3.f, FX-2.9.a, FX-9.ERR008341, MO-13.
TEST_P(ModeSweep, InEveryClockOfAFrame) {
  const unsigned sender = transmitter_ ? ModeRig::kSubject : ModeRig::kPeer;
  for (unsigned k = 0; k < (kFrameBits + 2) * kBit; ++k) {
    SCOPED_TRACE("clock " + std::to_string(k));
    tidy_up();
    rig_.put_tx(sender, 8, first_frame(k));
    mode_.run(k);
    const Field field = rig_.field(ModeRig::kSubject);
    ASSERT_NO_FATAL_FAILURE(leave_and_return(k, field >= Field::kSof && field <= Field::kEof));
    ASSERT_NO_FATAL_FAILURE(back_on_the_bus(k));
    others_are_undisturbed();
    if (HasFailure()) return;
  }
}

// A request taken back before, while or after it is acknowledged. Not so a soft reset.
class TakenBack : public ModeSweep {};

TEST_P(TakenBack, InEveryClockOfAFrame) {
  const unsigned sender = transmitter_ ? ModeRig::kSubject : ModeRig::kPeer;
  for (unsigned k = 0; k < (kFrameBits + 2) * kBit; ++k) {
    SCOPED_TRACE("clock " + std::to_string(k));
    tidy_up();
    rig_.put_tx(sender, 8, first_frame(k));
    mode_.run(k);
    mode_.ask(how_);
    mode_.run(1 + k % 13);
    mode_.come_back(how_);
    ASSERT_NO_FATAL_FAILURE(back_on_the_bus(k));
    EXPECT_EQ(mode_.read(reg::kMcr) & (reg::kMcrFrzAck | reg::kMcrLpmAck), 0u);
    others_are_undisturbed();
    if (HasFailure()) return;
  }
}

// flexcan.md 2.1, 2.2: the acknowledge comes when moves are over, of the frame that the core
// receives or of its own (SRX_DIS = 0): what the CPU finds with it is whole and stays, back on the
// bus too. The CPU uses every clock; a third of its accesses are to the memory of the buffers.
class MovesAreOver : public ModeSweep {
 protected:
  static constexpr unsigned kOwnMb = 8, kOtherMb = 12;
  const unsigned sender_ = transmitter_ ? ModeRig::kSubject : ModeRig::kPeer;
  Frame stored_;  // in buffer kRxMb before the frame
  Frame found_;   // in buffer kRxMb once the mode is acknowledged

  void SetUp() override {
    ASSERT_TRUE(rig_.freeze(ModeRig::kSubject));
    return_to_the_bus();
  }

  void return_to_the_bus() {
    rig_.node(ModeRig::kSubject).request_stop(false);
    for (const std::uint32_t freeze : {reg::kMcrFrz | reg::kMcrHalt, 0u})
      rig_.write(ModeRig::kSubject, reg::kMcr, (ModeRig::kRunMcr & ~reg::kMcrSrxDis) | freeze);
    ASSERT_TRUE(mode_.quiet());
    stored_ = received();
    tidy_up();
  }

  Frame received() {
    const Frame frame = mb_frame(rig_.get(ModeRig::kSubject, ModeRig::kRxMb));
    mode_.read(reg::kTimer);  // unlocks
    return frame;
  }

  // IFLAG1 as the access after the one that shows the acknowledge reads it.
  std::uint32_t flags_with_acknowledge() {
    std::vector<AhbTransfer> poll;
    for (unsigned i = 0; i < 40; ++i)
      for (const std::uint32_t address : {reg::mb(kOtherMb, 2), reg::kMcr, reg::kIflag1})
        poll.push_back({.address = address});
    const std::vector<AhbResult> results = rig_.burst(ModeRig::kSubject, poll);
    for (unsigned i = 1; i < results.size(); i += 3)
      if ((results[i].data & (reg::kMcrFrzAck | reg::kMcrLpmAck)) != 0) return results[i + 1].data;
    ADD_FAILURE() << "no acknowledge";
    return 0;
  }

  void expect_whole(std::uint32_t flags, const Frame &sent) {
    constexpr std::uint32_t kReceived = 1u << ModeRig::kRxMb;
    const Frame found = received();
    if (how_ == Leave::kSoftReset) {
      EXPECT_EQ(flags, 0u);
      EXPECT_TRUE(found == sent || found == stored_) << "a mixture";
    } else {
      EXPECT_EQ(found, (flags & kReceived) != 0 ? sent : stored_);
    }
    if (waits_for_frame()) {
      EXPECT_EQ(flags, kReceived | (transmitter_ ? 1u << kOwnMb : 0u));
    }
    mode_.run(2 * kBit);
    EXPECT_EQ(mode_.read(reg::kIflag1), flags) << "after the acknowledge";
    EXPECT_EQ(received(), found);
    found_ = found;
  }

  void leave_at_the_end(unsigned k) {
    const Frame frame = k % 2 != 0 ? first_frame(k) : second_frame(k);
    rig_.put_tx(sender_, kOwnMb, frame);
    const auto ending = [&] { return rig_.field(ModeRig::kSubject) == Field::kEof; };
    ASSERT_TRUE(rig_.run_until(ending, kFrameBits * kBit));
    rig_.run(k);
    mode_.ask(how_);
    expect_whole(flags_with_acknowledge(), frame);
    rig_.write(sender_, reg::mb(kOwnMb), reg::kCodeTxInactive);  // cut by a soft reset
  }
};

// FX-2.1.a, FX-2.2.a, FX-2.3.a.
TEST_P(MovesAreOver, InEveryClockOfTheEnd) {
  for (unsigned k = 0; k < 9 * kBit; ++k) {
    SCOPED_TRACE("clock " + std::to_string(k) + " of EOF");
    ASSERT_NO_FATAL_FAILURE(leave_at_the_end(k));
    ASSERT_NO_FATAL_FAILURE(return_to_the_bus());
    EXPECT_EQ(stored_, found_) << "a frame that came late";
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MovesAreOver,
                         ::testing::Combine(::testing::ValuesIn(kAllWays), ::testing::Bool()),
                         [](const auto &each) {
                           return to_string(std::get<0>(each.param)) +
                                  (std::get<1>(each.param) ? "AsTransmitter" : "AsReceiver");
                         });

INSTANTIATE_TEST_SUITE_P(All, TakenBack,
                         ::testing::Combine(::testing::Values(Leave::kFreeze, Leave::kDisable,
                                                              Leave::kStop),
                                            ::testing::Bool()),
                         [](const auto &each) {
                           return to_string(std::get<0>(each.param)) +
                                  (std::get<1>(each.param) ? "AsTransmitter" : "AsReceiver");
                         });

INSTANTIATE_TEST_SUITE_P(All, ModeSweep,
                         ::testing::Combine(::testing::ValuesIn(kAllWays), ::testing::Bool()),
                         [](const auto &each) {
                           return to_string(std::get<0>(each.param)) +
                                  (std::get<1>(each.param) ? "AsTransmitter" : "AsReceiver");
                         });

}  // namespace
}  // namespace vericansim
