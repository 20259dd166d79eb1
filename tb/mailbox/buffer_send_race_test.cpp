// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The CPU against a frame that is sent: abort, deactivation and rewriting at every clock from the
// intermission before the frame to the end of it, for frames that succeed, lose and fail; the model
// says which outcomes are allowed, and the frames on the wire must be whole.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 5, kOtherMb = 9;
constexpr Frame kBefore{.id = 0x700, .dlc = 0};  // the peer's, so that the sweep has a clock zero
constexpr Frame kMine{.id = 0x2AA, .dlc = 1, .data = {0x5A}};
constexpr Frame kNew{.id = 0x155, .dlc = 2, .data = {0xA5, 0xC3}};
constexpr Frame kOther{.id = 0x300, .dlc = 0};

/// How the frame fares that is being sent when the CPU acts.
enum class Fate : unsigned { kSent, kLost, kFailed, kCount };
/// What the CPU does.
enum class Action : unsigned {
  kAbort,
  kDeactivate,
  kDeactivateAndWipe,
  kRewrite,
  kActivateAgain,
  kCount
};
const char *const kFates[] = {"Sent", "Lost", "Failed"};
const char *const kActions[] = {"Abort", "Deactivate", "DeactivateAndWipe", "Rewrite",
                                "ActivateAgain"};

void act(BufferRig &rig, Action action, std::uint64_t clock) {
  const auto write = [&](unsigned word, std::uint32_t data) {
    rig.at(clock, {.address = reg::mb(kMb, word), .write = true, .data = data});
  };
  const auto put = [&](const Frame &frame, unsigned code) {
    const MbWords words = mb_words(frame, code);
    write(2, words.low);
    write(3, words.high);
    write(1, words.id);
    write(0, words.cs);
  };
  switch (action) {
    case Action::kAbort: write(0, kTxAbort << 24); break;
    case Action::kDeactivate: write(0, kTxInactive << 24); break;
    case Action::kDeactivateAndWipe:  // as the SDK and Zephyr cancel a frame
      write(0, kTxInactive << 24);
      write(1, 0);
      write(2, 0);
      write(3, 0);
      break;
    case Action::kRewrite:
      write(0, kTxInactive << 24);
      put(kNew, kTxActive);
      break;
    case Action::kActivateAgain: write(0, mb_words(kMine, kTxActive).cs); break;
    case Action::kCount: break;
  }
}

using Parameter = std::tuple<unsigned, unsigned, bool>;  // fate, action, AEN

class SendRace : public ::testing::TestWithParam<Parameter> {
 protected:
  SendRace() : rig_{{.num_mb = 16, .maxmb = 15, .aen = std::get<2>(GetParam())}} { rig_.go(); }

  // The peer sends a frame, during which the core gets its own; the fate of that is set. Returns
  // the clock at which the peer's frame started.
  std::uint64_t begin(Fate fate) {
    rig_.disturb(0, 0);
    if (fate == Fate::kFailed) {  // or the errors would add up
      rig_.freeze();
      rig_.write(reg::kEcr, 0);
      rig_.go();
      rig_.peer().preset_counters(0, 0);
    }
    rig_.write(reg::kIflag1, 0xFFFF);  // AEN=1: ends the protection
    rig_.write(reg::mb(kMb), kTxInactive << 24);
    rig_.write(reg::mb(kOtherMb), kTxInactive << 24);
    const std::uint64_t frames = rig_.frames_started();
    rig_.peer_sends(kBefore);
    if (fate == Fate::kLost) rig_.peer_sends({.id = 0x2A0, .dlc = 1, .data = {0x77}});
    EXPECT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 400));
    const std::uint64_t start = rig_.start_clock();
    rig_.put_tx(kMb, kMine);
    rig_.put_tx(kOtherMb, kOther);
    return start;
  }

  void one(Fate fate, Action action, int offset) {
    SCOPED_TRACE(testing::Message() << "clock " << offset << " from the start of the peer's frame");
    const std::uint64_t start = begin(fate);
    const std::uint64_t frames = rig_.frames_started();
    act(rig_, action, start + offset);
    if (fate == Fate::kFailed) {
      rig_.run_until([&] { return rig_.frames_started() > frames; }, 600);
      rig_.disturb(30);
    }
    rig_.quiet();
    rig_.compare();
  }

  BufferRig rig_;
};

// FX-3.4.a, FX-3.4.b, FX-3.4.c, FX-3.4.d, FX-MCR.AEN, FX-3.2.j, FX-3.3.j: abort with AEN=1.
// FX-3.4.f, FX-3.4.g, FX-3.3.i: deactivation with AEN=0. FF-12: what is on the wire is whole.
// FX-3.3.f: a loser or a failed frame contends again. MO-10: never both reported or neither.
// FX-9.ERR006032, FX-9.ERR005829: no mixed frame, no lost activation, at any clock.
TEST_P(SendRace, EveryClock) {
  const auto fate = static_cast<Fate>(std::get<0>(GetParam()));
  const auto action = static_cast<Action>(std::get<1>(GetParam()));
  begin(fate);
  rig_.quiet();
  // From the EOF of the peer's frame (which is 44 bits and stuff bits long) to behind the next one.
  for (int offset = 42 * 8; offset < 108 * 8 && !HasFailure(); ++offset) one(fate, action, offset);
}

std::string race_name(const ::testing::TestParamInfo<Parameter> &test) {
  const auto [fate, action, aen] = test.param;
  return std::string{kFates[fate]} + "_" + kActions[action] + (aen ? "_Aen" : "_NoAen");
}

// With AEN=1 software must not write ID and data of a buffer before its abort is over.
std::vector<Parameter> combinations() {
  std::vector<Parameter> all;
  for (unsigned fate = 0; fate < static_cast<unsigned>(Fate::kCount); ++fate) {
    for (const Action action : {Action::kDeactivateAndWipe, Action::kRewrite})
      all.emplace_back(fate, static_cast<unsigned>(action), false);
    for (const Action action : {Action::kAbort, Action::kDeactivate, Action::kActivateAgain})
      for (const bool aen : {false, true})
        all.emplace_back(fate, static_cast<unsigned>(action), aen);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, SendRace, ::testing::ValuesIn(combinations()), race_name);

// FX-3.3.f, FX-3.3.g: a buffer is written anew while its frame is on the bus, and is the best of
// those that wait when that frame ends. C/S words of another, written in a row at every clock
// around the end, do not let a worse one go first, nor does it miss its start.
TEST(SendRaceOfOthers, EveryClockOfTheEnd) {
  constexpr Frame kWorst{.id = 0x500, .dlc = 0};
  for (const bool retry : {false, true}) {
    BufferRig rig{{.num_mb = 16, .maxmb = 15}};
    rig.go();
    std::uint64_t length = 0;  // from the start of the frame to EOF7, or to its error
    for (int offset = -40; offset <= 8 && !::testing::Test::HasFailure(); ++offset) {
      SCOPED_TRACE(testing::Message() << "clock " << offset << (retry ? " from the error" : ""));
      std::uint64_t frames = rig.frames_started();
      rig.put_tx(kMb, kMine);
      ASSERT_TRUE(rig.run_until([&] { return rig.frames_started() > frames; }, 600));
      rig.put_tx(kOtherMb, kOther);
      if (retry)
        rig.disturb(30);
      else
        rig.put_tx(kMb, kNew);
      for (unsigned i = 0; i < 3 && length != 0; ++i) {
        const MbWords words = mb_words(kWorst, i == 1 ? kTxInactive : kTxActive);
        rig.at(rig.start_clock() + length + offset,
               {.address = reg::mb(kOtherMb + 1), .write = true, .data = words.cs});
      }
      rig.write(reg::mb(kOtherMb + 1, 1), kWorst.id << 18);
      const auto ended = [&] { return rig.end_clock() > rig.start_clock(); };
      ASSERT_TRUE(rig.run_until(ended, 1000));
      if (length == 0) {
        length = rig.end_clock() - rig.start_clock();
        offset = -41;
      }
      rig.quiet();
      rig.compare();
      rig.write(reg::kIflag1, 0xFFFF);
    }
  }
}

// FX-3.4.b, FX-3.7.b: an abort request for an answer that is being sent is remembered, also while
// IFLAG still tells of the answer before: it is not tried again when the attempt fails.
TEST(AbortOfAnAnswer, WhileItsLastFlagStands) {
  constexpr Frame kRequest{.id = kMine.id, .remote = true, .dlc = 1};
  for (unsigned clock = 8; clock < 31 * BufferRig::kBit && !::testing::Test::HasFailure();
       clock += 7) {
    SCOPED_TRACE(testing::Message() << "clock " << clock);
    BufferRig rig{{.num_mb = 16, .maxmb = 15, .aen = true}};
    rig.go();
    rig.put_tx(kMb, kMine, kTxAnswerWaits);
    rig.receive(kRequest);
    ASSERT_EQ(rig.read(reg::kIflag1), 1u << kMb);
    const std::uint64_t answered = rig.frames_started() + 2;
    rig.peer_sends(kRequest);
    ASSERT_TRUE(rig.run_until([&] { return rig.frames_started() == answered; }, 2000));
    rig.disturb(30);
    rig.at(rig.start_clock() + clock,
           {.address = reg::mb(kMb), .write = true, .data = kTxAbort << 24});
    rig.quiet();
    EXPECT_EQ((rig.read_cs(kMb) >> 24) & 0xF, kTxAbort);
    EXPECT_EQ(rig.frames_started(), answered) << "tried again";
    rig.compare();
  }
}

}  // namespace
}  // namespace vericansim
