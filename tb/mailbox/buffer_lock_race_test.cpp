// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The CPU against a frame that moves in: every kind of access at every clock around the end of the
// frame, from every state of the buffer; the model says which outcomes are allowed.
#include <gtest/gtest.h>

#include <string>

#include "harness/depth.hpp"
#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 5, kOtherMb = 9;
constexpr Frame kFirst{.id = 0x123, .dlc = 2, .data = {0x11, 0x12}};
constexpr Frame kSecond{.id = 0x123, .dlc = 2, .data = {0x21, 0x22}};
constexpr Frame kThird{.id = 0x123, .dlc = 2, .data = {0x31, 0x32}};
constexpr std::uint32_t kOtherId = 0x2BC;

/// Clocks before EOF6 at which the sweep begins: the CRC field of the frame, so that the match is
/// under way; and after it.
constexpr int kBefore = 200, kAfter = 60;
/// Clocks around EOF6 in which buffers change: the match is over by then, and the frame moves in.
constexpr int kMovesFrom = -16, kMovesTo = 40;

/// Whether an access at this clock from EOF6 is part of the test: in `make test` beside the move
/// every fourth clock is, another one for each setting.
bool is_tried(int offset, unsigned setting) {
  if (offset >= kMovesFrom && offset <= kMovesTo) return true;
  return (static_cast<unsigned>(offset + kBefore) % depth(4U, 1U)) == setting % depth(4U, 1U);
}

/// State of kMb before the frame of the race.
enum class State : unsigned { kEmpty, kFull, kServiced, kOverrun, kLocked, kLockedWaiting, kCount };
/// What the CPU does.
enum class Action : unsigned {
  kReadCs,
  kReadTimer,
  kReadOtherCs,
  kReadCsAndTimer,
  kWriteEmpty,
  kWriteExtended,
  kWriteOtherId,
  kWriteInactive,
  kWriteFull,
  kWriteOther,
  kClearFlag,
  kCount
};

const char *const kStates[] = {"Empty", "Full", "Serviced", "Overrun", "Locked", "LockedWaiting"};
const char *const kActions[] = {"ReadCs",     "ReadTimer",     "ReadOtherCs",  "ReadCsAndTimer",
                                "WriteEmpty", "WriteExtended", "WriteOtherId", "WriteInactive",
                                "WriteFull",  "WriteOther",    "ClearFlag"};

void prepare(BufferRig &rig, State state) {
  rig.write(reg::mb(kMb), 0);
  rig.write(reg::mb(kOtherMb), 0);
  rig.write(reg::kIflag1, 0xFFFF);
  rig.put_rx(kMb, kFirst);
  if (state == State::kEmpty) return;
  rig.receive(kFirst);
  if (state == State::kOverrun) rig.receive(kSecond);
  if (state == State::kServiced) {
    rig.read_cs(kMb);
    rig.read(reg::kTimer);
  }
  if (state == State::kLocked || state == State::kLockedWaiting) rig.read_cs(kMb);
  if (state == State::kLockedWaiting) rig.receive(kSecond);
}

void act(BufferRig &rig, Action action, std::uint64_t clock) {
  const auto read = [&](std::uint32_t address) { rig.at(clock, {.address = address}); };
  const auto write = [&](std::uint32_t address, std::uint32_t data) {
    rig.at(clock, {.address = address, .write = true, .data = data});
  };
  switch (action) {
    case Action::kReadCs: read(reg::mb(kMb)); break;
    case Action::kReadTimer: read(reg::kTimer); break;
    case Action::kReadOtherCs: read(reg::mb(kOtherMb)); break;
    case Action::kReadCsAndTimer:
      read(reg::mb(kMb));
      read(reg::kTimer);
      break;
    case Action::kWriteEmpty: write(reg::mb(kMb), kRxEmpty << 24); break;
    case Action::kWriteExtended: write(reg::mb(kMb), kRxEmpty << 24 | reg::kCsIde); break;
    case Action::kWriteOtherId:
      write(reg::mb(kMb, 1), kOtherId << 18);
      write(reg::mb(kMb), kRxEmpty << 24);
      break;
    case Action::kWriteInactive: write(reg::mb(kMb), 0); break;
    case Action::kWriteFull: write(reg::mb(kMb), kRxFull << 24); break;
    case Action::kWriteOther: write(reg::mb(kOtherMb), kRxEmpty << 24); break;
    case Action::kClearFlag: write(reg::kIflag1, 1u << kMb); break;
    case Action::kCount: break;
  }
}

// BCC, and whether a second buffer fits as well.
using Parameter = std::tuple<unsigned, unsigned, unsigned>;

class LockRace : public ::testing::TestWithParam<Parameter> {};

// FX-3.6.a to FX-3.6.i: FX-3.6.c, FX-3.6.d, FX-3.6.e, FX-3.6.f, FX-3.6.h: lock and unlock at every
// clock around a move-in. FX-3.5.o: the frame waits, a later one replaces it. FX-3.5.r, FX-3.4.g: a
// C/S write cancels what was to come. FX-1.5.e, FX-5.a: flags set and cleared in the same clock.
// VA-05: a frame is stored whole or not at all.
TEST_P(LockRace, EveryClock) {
  const auto [state, action, setting] = GetParam();
  BufferRig rig{{.num_mb = 16, .maxmb = 15, .bcc = (setting & 1) != 0}};
  rig.go();
  prepare(rig, State::kEmpty);
  rig.receive(kThird);
  const std::uint64_t length = rig.end_clock() - rig.start_clock();
  for (int offset = -kBefore; offset <= kAfter && !HasFailure(); ++offset) {
    if (!is_tried(offset, setting)) continue;
    SCOPED_TRACE(testing::Message() << "clock " << offset << " from EOF6");
    prepare(rig, static_cast<State>(state));
    rig.put(kOtherMb, {.cs = (setting & 2) != 0 ? kRxEmpty << 24 : 0, .id = 0x123u << 18});
    const std::uint64_t frames = rig.frames_started();
    rig.peer_sends(kThird);
    ASSERT_TRUE(rig.run_until([&] { return rig.frames_started() > frames; }, 400));
    act(rig, static_cast<Action>(action), rig.start_clock() + length + offset - 2);
    rig.quiet();
    rig.compare_quietly();
    rig.read(reg::kTimer);  // what still waits moves in
    rig.run(20);
    rig.compare();
    // A move that the C/S write cut short may have written its identifier over that of the CPU.
    if (static_cast<Action>(action) == Action::kWriteOtherId) continue;
    rig.receive(kFirst);  // and the next frame finds everything in order
    rig.compare();
  }
}

std::string race_name(const ::testing::TestParamInfo<Parameter> &test) {
  const auto [state, action, setting] = test.param;
  return std::string{kStates[state]} + "_" + kActions[action] +
         ((setting & 1) != 0 ? "_Queue" : "_NoQueue") + ((setting & 2) != 0 ? "_Two" : "_One");
}

INSTANTIATE_TEST_SUITE_P(
    All, LockRace,
    ::testing::Combine(::testing::Range(0u, static_cast<unsigned>(State::kCount)),
                       ::testing::Range(0u, static_cast<unsigned>(Action::kCount)),
                       ::testing::Range(0u, 4u)),
    race_name);

// Whether BCC is set, and the word of the buffer that the CPU reads.
class MoveRace : public ::testing::TestWithParam<std::tuple<bool, unsigned>> {};

// FX-3.5.q: words, then code, then flag. FX-3.6.d: a read and a write, each at every clock after
// the unlock that sets a waiting frame free. FX-3.4.g: a C/S write cuts its move short.
TEST_P(MoveRace, EveryClock) {
  const auto [bcc, word] = GetParam();
  BufferRig rig{{.num_mb = 16, .maxmb = 15, .bcc = bcc}};
  rig.go();
  for (unsigned offset = 1; offset <= 20; ++offset) {
    for (unsigned pause = 1; pause <= 5 && !HasFailure(); ++pause) {
      for (const auto &[address, data] : {std::pair{reg::kIflag1, 1u << kMb}, {reg::mb(kMb), 0u}}) {
        SCOPED_TRACE(testing::Message() << "read " << offset << " clocks after the unlock, write "
                                        << pause << " after the read");
        prepare(rig, State::kLockedWaiting);
        rig.write(reg::kIflag1, 1u << kMb);
        const std::uint64_t start = rig.clocks() + 2;
        rig.at(start, {.address = reg::kTimer});
        rig.at(start + offset, {.address = reg::mb(kMb, word)});
        rig.at(start + offset + pause, {.address = address, .write = true, .data = data});
        rig.at(start + offset + pause, {.address = reg::kIflag1});
        rig.at(start + offset + pause, {.address = reg::mb(kMb, word)});
        rig.run(60);
        rig.compare_quietly();
        rig.compare();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MoveRace,
                         ::testing::Combine(::testing::Bool(), ::testing::Range(0u, 4u)));

// What the CPU does, BCC, and whether a second buffer fits as well.
class MatchRace : public ::testing::TestWithParam<std::tuple<Action, bool, bool>> {};

// FX-3.6.d, FX-3.5.a: the frame that waited moves in while the next one for the same buffer looks
// for it; the words that the move writes are the ones that the match reads.
TEST_P(MatchRace, EveryClock) {
  const auto [action, bcc, two] = GetParam();
  BufferRig rig{{.num_mb = 16, .maxmb = 15, .bcc = bcc}};
  rig.go();
  for (unsigned offset = 0; offset < 60 && !HasFailure(); ++offset) {
    SCOPED_TRACE(testing::Message() << offset << " clocks behind the start of the last ID bit");
    prepare(rig, State::kLockedWaiting);
    rig.put(kOtherMb, {.cs = two ? kRxEmpty << 24 : 0, .id = 0x123u << 18});
    const std::uint64_t frames = rig.frames_started();
    rig.peer_sends(kThird);
    ASSERT_TRUE(rig.run_until([&] { return rig.frames_started() > frames; }, 400));
    act(rig, action, rig.start_clock() + 11 * BufferRig::kBit + offset);
    rig.quiet();
    rig.compare_quietly();
    rig.compare();
  }
}

std::string match_race_name(const ::testing::TestParamInfo<std::tuple<Action, bool, bool>> &test) {
  const auto [action, bcc, two] = test.param;
  return std::string{kActions[static_cast<unsigned>(action)]} + (bcc ? "_Queue" : "_NoQueue") +
         (two ? "_Two" : "_One");
}

INSTANTIATE_TEST_SUITE_P(All, MatchRace,
                         ::testing::Combine(::testing::Values(Action::kReadTimer,
                                                              Action::kReadOtherCs,
                                                              Action::kReadCsAndTimer),
                                            ::testing::Bool(), ::testing::Bool()),
                         match_race_name);

/// A buffer that is full, has been read and is locked, while a frame for another one moves.
class MarkRace : public ::testing::Test {
 protected:
  MarkRace() {
    rig_.go();
    rig_.receive(kMoves);
    length_ = rig_.end_clock() - rig_.start_clock();
  }

  /// The unlock and `write` right behind it, from `offset` clocks behind EOF6 of the frame on.
  void unlock_and(const AhbTransfer &write, int offset) {
    prepare(rig_, State::kFull);
    rig_.put_rx(kOtherMb, kMoves);
    rig_.read_cs(kMb);
    const std::uint64_t frames = rig_.frames_started();
    rig_.peer_sends(kMoves);
    ASSERT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 400));
    const std::uint64_t clock = rig_.start_clock() + length_ + offset;
    rig_.at(clock, {.address = reg::kTimer});
    rig_.at(clock, write);
    rig_.quiet();
  }

  static constexpr Frame kMoves{.id = 0x456, .dlc = 2, .data = {0x41, 0x42}};
  BufferRig rig_{{.num_mb = 16, .maxmb = 15, .bcc = true}};
  std::uint64_t length_ = 0;
};

// FX-3.6.g: a write of bytes that hold no code, right behind the unlock, leaves the mark that the
// unlock asks for, whatever moves just then.
TEST_F(MarkRace, BytesWithoutTheCode) {
  const std::pair<unsigned, AhbSize> writes[] = {
      {0, AhbSize::kByte}, {2, AhbSize::kByte}, {0, AhbSize::kHalf}};
  for (const auto &[byte, size] : writes) {
    for (int offset = kMovesFrom; offset <= kMovesTo && !HasFailure(); ++offset) {
      SCOPED_TRACE(testing::Message() << "byte " << byte << ", clock " << offset << " from EOF6");
      unlock_and({.address = reg::mb(kMb) + byte, .write = true, .size = size, .data = 2}, offset);
      rig_.receive(kSecond);
      EXPECT_EQ(rig_.read_cs(kMb) >> 24, kRxFull);
      rig_.compare();
    }
  }
}

// A write of the code is what the buffer has from then on, though the mark comes behind it: right
// behind the unlock, whatever moves just then.
TEST_F(MarkRace, AWordWithItsCode) {
  for (const unsigned code : {kRxEmpty, kTxInactive}) {
    for (int offset = kMovesFrom; offset <= kMovesTo && !HasFailure(); ++offset) {
      SCOPED_TRACE(testing::Message() << "code " << code << ", clock " << offset << " from EOF6");
      unlock_and({.address = reg::mb(kMb), .write = true, .data = code << 24}, offset);
      EXPECT_EQ(rig_.read(reg::mb(kMb)) >> 24, code);
      rig_.compare();
    }
  }
}

}  // namespace
}  // namespace vericansim
