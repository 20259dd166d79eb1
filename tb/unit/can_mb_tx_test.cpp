// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_tx: the winner against a model that sorts (flexcan.md 3.3), with buffers activated, taken
// away, sent and retried in every clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "Vcan_mb_tx.h"
#include "verilated.h"

namespace vericansim {
namespace {

constexpr unsigned kBuffers = 64, kPass = 2 * kBuffers;  // a read in every second clock
constexpr std::uint32_t kActive = 0xC, kAnswer = 0xE, kIde = 1u << 21, kRtr = 1u << 20;

bool is_active(std::uint32_t cs) { return (cs >> 24) == kActive || (cs >> 24) == kAnswer; }

struct Buffer {
  std::uint32_t cs = 0, id = 0;
};

struct Mode {
  unsigned lbuf, lprio;
};

class MbTx : public ::testing::TestWithParam<Mode> {
 protected:
  MbTx() {
    top_.rst_ni = 1;
    top_.eval();
    top_.rst_ni = 0;
    top_.eval();
    top_.rst_ni = 1;
    top_.maxmb_i = 63;
    top_.running_i = 1;
    top_.lbuf_i = GetParam().lbuf;
    top_.lprio_en_i = GetParam().lprio;
  }

  // Bits as they go over the bus, as a string: the smaller string wins arbitration (AR-01); PRIO
  // comes before them.
  std::string bits(const Buffer &buffer) const {
    const auto field = [](std::uint32_t value, unsigned width) {
      std::string text;
      for (unsigned i = width; i-- > 0;) text += ((value >> i) & 1) != 0 ? '1' : '0';
      return text;
    };
    const std::string rtr = (buffer.cs & kRtr) != 0 ? "1" : "0";
    const std::string prio = top_.lprio_en_i != 0 ? field(buffer.id >> 29, 3) : "";
    const std::string base = prio + field((buffer.id >> 18) & 0x7FF, 11);
    if ((buffer.cs & kIde) == 0) return base + rtr + "0";
    return base + "11" + field(buffer.id & 0x3FFFF, 18) + rtr;
  }

  std::optional<unsigned> expected() const {
    std::vector<std::tuple<std::string, unsigned>> active;
    for (unsigned i = top_.first_i; i < kBuffers && i <= top_.maxmb_i; ++i) {
      if (!is_active(buffers_[i].cs) || (top_.off_i != 0 && i == top_.cur_idx_i)) continue;
      active.emplace_back(top_.lbuf_i != 0 ? "" : bits(buffers_[i]), i);
    }
    if (active.empty()) return {};
    return std::get<1>(*std::min_element(active.begin(), active.end()));
  }

  // One clock: `write` is the buffer whose C/S word the CPU writes in it; slots are granted at
  // random.
  void clock(std::optional<unsigned> write, std::uint32_t cs, unsigned grant_percent) {
    top_.eval();
    const bool ins = top_.ins_req_o != 0;
    const bool scan = !ins && top_.scan_req_o != 0 && rng_() % 100 < grant_percent;
    top_.ins_gnt_i = ins;
    top_.scan_gnt_i = scan;
    top_.eval();
    const Buffer read = buffers_[ins ? top_.ins_idx_o : top_.scan_idx_o];
    if (write) buffers_[*write].cs = cs;
    top_.clk_i = 1;
    top_.eval();
    top_.clk_i = 0;
    if (ins || scan) {
      top_.cs_i = read.cs;
      top_.id_i = read.id;
    }
    top_.cs_written_i = write.has_value();
    top_.cs_written_act_i = write && is_active(cs);
    if (write) top_.cs_written_idx_i = *write;
    top_.start_i = 0;
    top_.retry_i = 0;
  }

  // The CPU prepares a buffer that is not active, then writes its C/S word; or takes one away.
  void random_write(unsigned grant_percent) {
    const unsigned i = rng_() % kBuffers;
    Buffer &buffer = buffers_[i];
    const bool was_active = is_active(buffer.cs);
    const std::uint32_t code = rng_() % 4 == 0 ? kAnswer : kActive;
    std::uint32_t cs = (was_active || rng_() % 4 == 0) ? 0x08000000u : code << 24;
    if (!was_active) {
      // Few different identifiers: ties and near ties are what is hard.
      buffer.id =
          ((rng_() % 4) << 18) | (rng_() % 3 == 0 ? rng_() & 0x3FFFF : rng_() % 3) | (rng_() << 29);
      cs |= (rng_() % 2 != 0 ? kIde : 0) | (rng_() % 2 != 0 ? kRtr : 0);
    }
    if (top_.off_i != 0 && i == top_.cur_idx_i) return clock({}, 0, grant_percent);
    clock(i, cs, grant_percent);
  }

  void settle() {
    for (unsigned i = 0; i < 800; ++i) clock({}, 0, 50);
    top_.eval();
  }

  // Starts anew with buffers 1, which TTXMB holds and which would win, and 2, which therefore is
  // the winner.
  void settle_beside_a_held_one() {
    top_.running_i = 0;
    buffers_ = {};
    buffers_[1] = {kActive << 24, 0x020u << 18};
    buffers_[2] = {kActive << 24, 0x400u << 18};
    top_.held_i = 1;
    top_.held_idx_i = 1;
    clock({}, 0, 100);
    top_.running_i = 1;
    settle();
    ASSERT_TRUE(top_.settled_o != 0 && top_.best_idx_o == 2);
  }

  void check() {
    const std::optional<unsigned> winner = expected();
    ASSERT_EQ(top_.settled_o != 0, winner.has_value());
    ASSERT_EQ(winner.value_or(top_.best_idx_o), top_.best_idx_o);
  }

  std::array<Buffer, kBuffers> buffers_{};
  std::mt19937 rng_{7};
  Vcan_mb_tx top_;
};

TEST_P(MbTx, WinnerIsThatOfTheModel) {
  settle();
  for (unsigned round = 0; round < 1500; ++round) {
    const unsigned writes = rng_() % 40, gap = 1 + rng_() % 6, grant = 20 + rng_() % 81;
    for (unsigned i = 0; i < writes; ++i) {
      random_write(grant);
      for (unsigned j = rng_() % gap; j > 0; --j) clock({}, 0, grant);
    }
    settle();
    check();
    if (HasFatalFailure()) FAIL() << "round " << round;
    if (top_.off_i != 0) {  // the frame ends: sent, or to be tried again
      top_.off_i = 0;
      if (rng_() % 2 == 0)
        top_.retry_i = 1;
      else
        buffers_[top_.cur_idx_i].cs = 0x08000000;
    } else if (top_.settled_o != 0) {  // the winner goes on the bus
      top_.cur_idx_i = top_.best_idx_o;
      top_.start_i = 1;
      clock({}, 0, grant);
      top_.off_i = 1;
    }
  }
}

TEST_P(MbTx, OneActivationIsEnough) {  // erratum ERR005829: at every moment of a pass
  for (unsigned moment = 0; moment < kPass + 16; ++moment) {
    top_.running_i = 0;
    clock({}, 0, 100);
    buffers_ = {};
    top_.running_i = 1;
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    buffers_[20].id = 0x100 << 18;
    clock(20, kActive << 24, 100);
    settle();
    check();
  }
}

TEST_P(MbTx, BuffersBeyondMaxmbAreNotSent) {
  top_.maxmb_i = 15;
  settle();
  clock(16, kActive << 24, 100);
  settle();
  check();
  clock(15, kActive << 24, 100);
  settle();
  check();
}

TEST_P(MbTx, BuffersOfTheRxFifoAreNotSent) {  // flexcan.md section 4
  top_.first_i = 12;
  settle();
  clock(11, kActive << 24, 100);
  settle();
  check();
  clock(12, kActive << 24, 100);
  settle();
  check();
}

TEST_P(MbTx, AnswerTakesPartAtEveryMomentOfAPass) {  // flexcan.md 3.7: as if written by the CPU
  buffers_[20].id = 0x100 << 18;
  buffers_[40] = {kActive << 24, 0x200 << 18};
  for (unsigned moment = 0; moment < kPass + 16; ++moment) {
    top_.running_i = 0;
    buffers_[20].cs = 0xAu << 24;
    clock({}, 0, 100);
    top_.running_i = 1;
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    buffers_[20].cs = kAnswer << 24;
    top_.ans_i = 1;
    top_.ans_idx_i = 20;
    clock(41, 0x08000000, 100);
    top_.ans_i = 0;
    top_.ans_idx_i = 0;
    settle();
    check();
  }
}

// Other codes are inactive, 1101 and 1111 too, whatever their priority: in a pass that finds one,
// in those that the writes of it and of its rival start.
TEST_P(MbTx, OtherCodesNeverWin) {  // FX-3.2.m
  for (unsigned code = 0; code < 16; ++code) {
    if (code == kActive || code == kAnswer) continue;
    top_.running_i = 0;
    buffers_[20] = {code << 24, 0};
    buffers_[40] = {kActive << 24, 0x200 << 18};
    clock({}, 0, 100);
    top_.running_i = 1;
    for (unsigned i = 0; i < 1200; ++i) {
      const unsigned written = i < 400 ? 20 : 40;
      if (i % 400 == 200)
        clock(written, buffers_[written].cs, 100);
      else
        clock({}, 0, 100);
      top_.eval();
      ASSERT_FALSE(top_.settled_o != 0 && top_.best_idx_o != 40) << code;
      ASSERT_FALSE(top_.seen_o != 0 && top_.seen_worst_o != 0 && top_.seen_idx_o == 20) << code;
    }
    check();
  }
}

// FX-3.3.f: who waits for a retry waits until it is in the winner.
TEST_P(MbTx, RetryIsToldUntilItIsInTheWinner) {
  buffers_[7] = {kActive << 24, 0};
  buffers_[9] = {kActive << 24, 5u << 18};
  top_.cur_idx_i = 7;
  top_.off_i = 1;
  settle();
  ASSERT_EQ(top_.best_idx_o, 9);
  top_.off_i = 0;
  top_.retry_i = 1;
  unsigned clocks = 0;
  do {
    clock({}, 0, 50);
    top_.eval();
    ASSERT_LT(++clocks, 20u);
  } while (top_.retry_o != 0);
  EXPECT_EQ(top_.best_idx_o, 7);
  EXPECT_GT(clocks, 1u);
}

// C/S writes in a row shut out neither a retry nor an answer.
TEST_P(MbTx, RetriesAndAnswersHaveTheirTurnsBesideWrites) {  // FX-3.3.f
  for (const bool answer : {false, true}) {
    settle();
    const unsigned waits = answer ? 9 : 7;  // the winner before keeps its index
    buffers_[waits] = {(answer ? kAnswer : kActive) << 24, 0};
    top_.cur_idx_i = answer ? 0 : waits;
    top_.retry_i = !answer;
    top_.ans_i = answer;
    top_.ans_idx_i = waits;
    unsigned clocks = 0;
    do {
      clock(clocks % 2 == 0 ? std::optional{20u} : std::nullopt, kActive << 24, 100);
      top_.ans_i = 0;
      top_.eval();
      ASSERT_LT(++clocks, 40u) << answer;
    } while (top_.best_idx_o != waits);
    buffers_ = {};
    for (unsigned i = 0; i < kBuffers; ++i) clock(i, 0x08000000, 100);
  }
}

// TM-40: a released buffer is an ordinary one. Neither it nor the answer that comes before it has
// had its slot is passed over.
TEST_P(MbTx, AnswerInEveryClockBehindARelease) {  // TM-40, flexcan.md 3.7
  for (const bool better : {false, true}) {
    for (unsigned behind = 0; behind < 12; ++behind) {
      SCOPED_TRACE(testing::Message() << behind << " clocks behind the release");
      ASSERT_NO_FATAL_FAILURE(settle_beside_a_held_one());
      const unsigned answer = better ? 0 : 7;
      buffers_[answer].id = (better ? 0x010u : 0x7F0u) << 18;
      for (unsigned i = 0; i <= behind; ++i) {
        top_.held_i = 0;
        if (i == behind) {
          buffers_[answer].cs = kAnswer << 24;
          top_.ans_i = 1;
          top_.ans_idx_i = answer;
        }
        clock({}, 0, 100);
        top_.ans_i = 0;
        top_.ans_idx_i = 0;
      }
      settle();
      check();
    }
  }
}

// TM-40: nor is it when TTXMB names another buffer, in any clock from the release on.
TEST_P(MbTx, AnotherNameInEveryClockBehindARelease) {  // TM-40
  for (const bool held : {false, true}) {
    for (unsigned behind = 0; behind < 12; ++behind) {
      SCOPED_TRACE(testing::Message() << behind << " clocks behind the release");
      ASSERT_NO_FATAL_FAILURE(settle_beside_a_held_one());
      for (unsigned i = 0; i <= behind; ++i) {
        top_.held_i = 0;
        if (i == behind) {
          top_.held_idx_i = 9;  // an inactive one
          top_.held_i = held;
        }
        clock({}, 0, 100);
      }
      settle();
      check();
    }
  }
}

// Writes of C/S words that follow an activation too fast for its comparison, as in the drivers'
// workaround of ERR005829, leave the winner what it is: it has been compared with all others.
TEST_P(MbTx, WritesInARowDoNotUnsettleTheWinner) {  // FX-9.ERR005829, FX-3.3.g
  for (const bool inactive : {true, false}) {
    for (unsigned pause = 0; pause < 6; ++pause) {
      top_.running_i = 0;
      buffers_ = {};
      buffers_[2] = {kActive << 24, 0x100u << 18};
      buffers_[7].id = 0x300u << 18;
      buffers_[9].id = 0x200u << 18;
      clock({}, 0, 100);
      top_.running_i = 1;
      settle();
      for (unsigned i = 0; i < 40; ++i) {
        std::optional<unsigned> write;
        if (i == 0) write = 7;
        if (i == pause + 1 || i == pause + 3) write = 9;
        clock(write, (i == 0 || !inactive ? kActive : 8u) << 24, 50);
        top_.eval();
        ASSERT_TRUE(top_.settled_o != 0 && top_.best_idx_o == 2) << pause << ' ' << i;
      }
      settle();
      check();
      clock(2, 8u << 24, 100);  // nor is what was overtaken forgotten
      settle();
      check();
    }
  }
}

// Read slots are for others: an answer or a retry waits, also behind a buffer that the CPU has
// written.
TEST_P(MbTx, AnswersAndRetriesWaitForTheirSlot) {  // flexcan.md 3.7
  for (const bool answer : {false, true}) {
    top_.running_i = 0;  // there is no winner, which would be read again first
    buffers_ = {};
    clock({}, 0, 100);
    top_.running_i = 1;
    settle();
    buffers_[20] = {kAnswer << 24, 0x100 << 18};
    top_.cur_idx_i = 20;
    for (unsigned i = 0; i < 30; ++i) {
      top_.ans_i = answer && i == 0;
      top_.ans_idx_i = i == 0 ? 20 : 0;
      top_.retry_i = !answer && i == 0;
      top_.cs_written_i = top_.cs_written_act_i = i == 5;
      top_.cs_written_idx_i = 41;
      top_.ins_gnt_i = i == 10;
      top_.scan_gnt_i = 0;
      top_.clk_i = 1;
      top_.eval();
      top_.clk_i = 0;
      top_.ins_gnt_i = 0;
      top_.eval();
      ASSERT_EQ(top_.ins_req_o != 0, i != 10) << i << ": not right behind a slot";
      ASSERT_EQ(top_.ins_idx_o, i >= 5 && i < 10 ? 41 : 20) << i;
      top_.cs_written_i = 0;
    }
  }
}

// A winner that can_mb_load has found not to be active, as an upset flip-flop makes one, does not
// stand: all buffers are looked at anew.
TEST_P(MbTx, WinnerThatIsNotActiveIsDropped) {
  buffers_[20] = {kActive << 24, 0x100 << 18};
  buffers_[30] = {kActive << 24, 0x200 << 18};
  settle();
  ASSERT_TRUE(top_.settled_o != 0 && top_.best_idx_o == 20);
  buffers_[20].cs = 0x08000000;  // without a C/S write
  top_.inactive_i = 1;
  clock({}, 0, 100);
  top_.inactive_i = 0;
  top_.eval();
  EXPECT_FALSE(top_.settled_o);
  settle();
  check();
}

// ESR2 (flexcan.md 1.7): a pass that changes of the buffers ask for is announced once; one that
// only looks for what an upset may have lost is not.
TEST_P(MbTx, PassesThatNobodyAskedForAreQuiet) {
  unsigned begun = 0, ended = 0, seen = 0, looks = 0;
  const auto run = [&](bool fresh) {
    for (unsigned i = 0; i < 800; ++i) {
      top_.fresh_i = fresh && i < 8;
      top_.eval();
      const bool wanted = top_.pass_o != 0;
      looks += top_.scan_req_o;
      clock({}, 0, 100);
      top_.eval();
      begun += !wanted && top_.pass_o != 0;
      ended += top_.pass_end_o;
      seen += top_.seen_o;
    }
  };
  run(false);
  EXPECT_EQ(ended, 1u);
  EXPECT_EQ(seen, kBuffers);
  EXPECT_EQ(std::exchange(looks, 0u), 2 * kBuffers);
  run(true);
  EXPECT_EQ(begun, 0u);
  EXPECT_EQ(ended, 1u);
  EXPECT_EQ(seen, kBuffers);
  EXPECT_EQ(std::exchange(looks, 0u), kBuffers);
  clock(3, 0x08000000, 100);
  run(false);
  EXPECT_EQ(begun, 1u);
  EXPECT_EQ(ended, 2u);
}

// A frame that has failed is a buffer among others again: a pass for ESR2 counts it.
TEST_P(MbTx, FrameThatFailsCountsInTheStatusAgain) {  // FX-ESR2.LPTM
  buffers_[20] = {kActive << 24, 0x300 << 18};
  buffers_[30] = {kActive << 24, 0x200 << 18};
  top_.cur_idx_i = 20;
  top_.off_i = 1;
  settle();
  clock(50, 0x08000000, 100);
  settle();
  ASSERT_EQ(top_.pass_o, 0);
  top_.off_i = 0;
  top_.retry_i = 1;
  std::optional<unsigned> worst;
  unsigned ended = 0;
  for (unsigned i = 0; i < 800; ++i) {
    clock({}, 0, 60);
    top_.eval();
    if (top_.seen_o != 0 && top_.seen_idx_o == 0) worst.reset();
    if (top_.seen_o != 0 && top_.seen_worst_o != 0) worst = top_.seen_idx_o;
    ended += top_.pass_end_o;
  }
  EXPECT_EQ(ended, 1u);
  EXPECT_EQ(worst, top_.lbuf_i != 0 ? 30u : 20u);
  check();
}

// The buffer of a frame that is sent has a new code: a pass under way begins anew, in any clock of
// it; where there is none can_mb_status knows enough.
TEST_P(MbTx, FrameThatIsSentRestartsAPass) {  // FX-ESR2.LPTM
  settle();
  top_.sent_i = 1;
  clock({}, 0, 100);
  top_.sent_i = 0;
  top_.eval();
  EXPECT_EQ(top_.pass_o, 0);
  unsigned moment = 0;
  while (true) {
    clock(50, 0x08000000, 100);
    ++moment;
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    top_.eval();
    if (top_.pass_o == 0) break;
    top_.sent_i = 1;
    clock({}, 0, 100);
    top_.sent_i = 0;
    top_.eval();
    unsigned seen = 0, clocks = 0;
    while (top_.pass_end_o == 0) {
      ASSERT_LT(++clocks, 4 * kPass);
      clock({}, 0, 100);
      top_.eval();
      // A buffer that had been read before may still be told of.
      seen = top_.seen_o != 0 ? (top_.seen_idx_o == 0 ? 1 : seen + 1) : seen;
    }
    ASSERT_EQ(seen, kBuffers) << moment;
    settle();
  }
  EXPECT_GT(moment, kPass);
}

// ESR2.LPTM: what a pass finds to be sent last, whatever came before it; of two equal buffers the
// later one.
TEST_P(MbTx, WorstIsThatOfTheModel) {  // FX-ESR2.LPTM
  unsigned found = 0;
  for (unsigned round = 0; round < 600; ++round) {
    for (unsigned i = rng_() % 12; i > 0; --i) random_write(100);
    std::optional<unsigned> worst;
    bool ended = false;
    for (unsigned i = 0; i < 800; ++i) {
      clock({}, 0, 60);
      top_.eval();
      if (top_.seen_o != 0 && top_.seen_idx_o == 0) worst.reset();
      if (top_.seen_o != 0 && top_.seen_worst_o != 0) worst = top_.seen_idx_o;
      ended = ended || top_.pass_end_o != 0;
    }
    if (round > 0 && !ended) continue;  // no write
    std::optional<unsigned> last;
    for (unsigned i = 0; i < kBuffers; ++i) {
      if (!is_active(buffers_[i].cs)) continue;
      if (!last || top_.lbuf_i != 0 || bits(buffers_[i]) >= bits(buffers_[*last])) last = i;
    }
    ASSERT_EQ(worst, last) << "round " << round;
    found += last.has_value();
    check();
  }
  EXPECT_GT(found, 300u);
}

// A pass for ESR2 takes the place of the winner's value: a better buffer is the winner within a few
// clocks all the same, a worse one is not, and nobody needs a pass.
TEST_P(MbTx, InsertionInEveryClockOfAPassForTheStatus) {
  buffers_[20] = {kActive << 24, 0x200 << 18};
  for (const unsigned i : {30u, 60u}) buffers_[i] = {kActive << 24, 0x300 << 18};
  for (unsigned moment = 0; moment < kPass + 8; ++moment) {
    for (const unsigned written : {10u, 40u}) {
      settle();
      check();
      clock(50, 0x08000000, 100);  // a pass begins
      for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
      buffers_[written].id = (written == 10 ? 0x100u : 0x280u) << 18;
      clock(written, kActive << 24, 100);
      for (unsigned i = 0; i < 8; ++i) clock({}, 0, 100);
      check();
      ASSERT_TRUE(top_.settled_o && top_.scan_lazy_o) << written << " in clock " << moment;
      buffers_[written].cs = 0;
      clock(written, 0x08000000, 100);
    }
  }
}

// A frame that has failed is there for the first opportunity behind its error, 17 bits on: a pass
// that is just looking at its buffer takes it for none that nobody knows, and needs no other pass.
TEST_P(MbTx, RetryInEveryClockOfAPassForTheStatus) {  // FX-3.3.f
  buffers_[20] = {kActive << 24, 0x200 << 18};
  top_.cur_idx_i = 20;
  for (unsigned moment = 0; moment < kPass + 8; ++moment) {
    top_.off_i = 1;
    settle();
    clock(50, 0x08000000, 100);  // a pass begins
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    top_.off_i = 0;
    top_.retry_i = 1;
    for (unsigned i = 0; i < 8; ++i) clock({}, 0, 100);
    check();
    ASSERT_TRUE(top_.settled_o && top_.scan_lazy_o) << "in clock " << moment;
  }
}

// What such a pass was just looking at is no candidate: the winner is still known as such when it
// is taken away in the next clocks.
TEST_P(MbTx, WinnerLostBehindAnInsertionInAPassForTheStatus) {
  for (unsigned i = 1; i < kBuffers; ++i) buffers_[i] = {kActive << 24, (0x400 - i) << 18};
  buffers_[1].id = 0x500 << 18;  // the worst
  buffers_[40].id = 0x080 << 18;
  for (unsigned moment = 0; moment < kPass + 8; moment += 3) {
    for (unsigned gap = 0; gap < 4; ++gap) {
      buffers_[20] = {0x8u << 24, 0x100 << 18};
      clock(20, kActive << 24, 100);
      settle();
      clock(0, 0x08000000, 100);  // a pass begins
      for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
      clock(63, kActive << 24, 100);
      for (unsigned i = 0; i < gap; ++i) clock({}, 0, 100);
      clock(40, 0x08000000, 100);
      settle();
      check();
      clock(40, kActive << 24, 100);
      settle();
      check();
    }
  }
}

// Two C/S words written in a row while the winner's value is not there: the first one is found by a
// pass.
TEST_P(MbTx, InsertionsInARowInAPassForTheStatus) {
  buffers_[20] = {kActive << 24, 0x200 << 18};
  buffers_[30] = {kActive << 24, 0x300 << 18};
  for (unsigned moment = 0; moment < kPass + 8; ++moment) {
    settle();
    clock(50, 0x08000000, 100);
    for (unsigned i = 0; i < moment; ++i) clock({}, 0, 100);
    buffers_[10].id = 0x100 << 18;
    buffers_[11].id = 0x180 << 18;
    clock(10, kActive << 24, 100);
    clock(11, kActive << 24, 100);
    settle();
    check();
    clock(10, 0x08000000, 100);
    clock(11, 0x08000000, 100);
  }
}

TEST_P(MbTx, BufferThatEndsWithoutHavingStartedIsNoWinner) {  // an abort request, flexcan.md 3.4
  buffers_[7] = {kActive << 24, 0x100 << 18};
  buffers_[9] = {kActive << 24, 0x200 << 18};
  settle();
  check();
  top_.cur_idx_i = 7;
  top_.off_i = 1;
  settle();
  check();
  buffers_[7].cs = 0x09000000;
  top_.off_i = 0;
  settle();
  check();
}

// A winner that is lost during a pass may have beaten a frame that the pass has looked at already:
// none is settled until a pass from the first buffer on has ended.
TEST_P(MbTx, LossOfAWinnerStartsThePassAnew) {
  buffers_[2] = {kActive << 24, 0x200 << 18};
  buffers_[50] = {kActive << 24, 0x300 << 18};
  settle();
  for (unsigned spoils = 0; spoils < 3; ++spoils) {
    buffers_[0].id = 0x100 << 18;
    clock(0, kActive << 24, 100);
    settle();
    clock(0, 0x08000000, 100);  // the winner is lost: a pass
    for (unsigned spoil = 0; spoil < spoils; ++spoil) {
      clock(0, kActive << 24, 100);
      for (unsigned i = 0; i < 10; ++i) clock({}, 0, 100);
      clock(0, 0x08000000, 100);  // lost again when buffer 2 has been looked at
    }
    for (unsigned i = 0; i < kPass; ++i) {
      if (i == 0) clock({}, 0, 100);
      ASSERT_FALSE(top_.settled_o) << spoils << " spoilt, clock " << i;
      clock({}, 0, 100);
    }
    for (unsigned i = 0; i < 6; ++i) clock({}, 0, 100);
    ASSERT_EQ(top_.settled_o, 1) << spoils << " spoilt";
    check();
  }
}

// A pass spoilt too often lets the best so far be sent; the next one is waited for again.
TEST_P(MbTx, PassIsWaitedForAgainAfterASpoiledOne) {
  for (const unsigned i : {0u, 7u, 9u, 40u, 50u}) buffers_[i] = {kActive << 24, i << 18};
  settle();
  check();
  for (unsigned loss = 0; loss < 5; ++loss) {
    clock(0, 0x08000000, 100);
    for (unsigned i = 0; i < 55; ++i) clock({}, 0, 100);
    ASSERT_EQ(top_.settled_o, loss > 2) << loss;
    clock(0, kActive << 24, 100);
    for (unsigned i = 0; i < 6; ++i) clock({}, 0, 100);
  }
  EXPECT_TRUE(top_.settled_o) << "spoiled";
  settle();
  check();
  top_.cur_idx_i = top_.best_idx_o;
  top_.start_i = 1;
  clock({}, 0, 100);
  top_.off_i = 1;
  for (unsigned i = 0; i < kPass - 2; ++i) {
    top_.eval();
    ASSERT_FALSE(top_.settled_o) << i;
    clock({}, 0, 100);
  }
  settle();
  check();
}

// In which clock of a pass a winner is lost makes no difference, whether the pass is spoilt or not.
TEST_P(MbTx, WinnerLostInEveryClockOfAPass) {
  buffers_[0].id = 0x100 << 18;
  buffers_[2] = {kActive << 24, 0x200 << 18};
  buffers_[1] = {kActive << 24, 0x300 << 18};
  buffers_[50] = {kActive << 24, 0x400 << 18};
  for (const unsigned losses : {1u, 5u}) {
    for (unsigned when = 0; when < kPass + 8; ++when) {
      settle();
      clock(2, 0x08000000, 100);  // a pass begins
      for (unsigned loss = 0; loss < losses; ++loss) {
        clock(0, kActive << 24, 100);
        const unsigned wait = loss + 1 < losses ? 10 : when;
        for (unsigned i = 0; i < wait + 4; ++i) clock({}, 0, 100);
        clock(0, 0x08000000, 100);
      }
      clock({}, 0, 100);
      for (unsigned i = 0; i < 600; ++i) {
        const bool passing = top_.scan_lazy_o == 0;
        if (top_.settled_o != 0 && !passing) check();
        clock({}, 0, 100);
        top_.eval();
      }
      ASSERT_EQ(top_.settled_o, 1) << losses << " losses, the last in clock " << when;
      check();
      clock(2, kActive << 24, 100);
    }
  }
}

// A loss in every pass: once spoilt, hardly a pass goes by that lets nobody be sent.
TEST_P(MbTx, SpoiltPassesAreNotWaitedForOneByOne) {
  buffers_[1] = {kActive << 24, 0x300 << 18};
  settle();
  unsigned barren = 0;  // losses in a row without a settled clock between
  for (unsigned loss = 0; loss < 20; ++loss) {
    clock(0, kActive << 24, 100);
    for (unsigned i = 0; i < 4; ++i) clock({}, 0, 100);
    clock(0, 0x08000000, 100);
    unsigned settled = 0;
    for (unsigned i = 0; i < kPass - 16; ++i) {
      clock({}, 0, 100);
      top_.eval();
      settled += top_.settled_o;
    }
    barren = settled != 0 ? 0 : barren + 1;
    // Buffer 1 may have been looked at just before the loss, and so in the next pass.
    if (loss >= 3) {
      ASSERT_LE(barren, 2u) << loss;
    }
  }
}

TEST_P(MbTx, WritingForEverStarvesNobody) {
  buffers_[40] = {kActive << 24, 0x7FF << 18};
  settle();
  // Buffer 3 would win; it is activated and taken back all the time.
  unsigned seen = 0;
  for (unsigned i = 0; i < 4000; ++i) {
    clock(3, (i % 2 != 0 ? 0x8u : kActive) << 24, 50);
    seen += top_.settled_o != 0 && top_.best_idx_o == 40;
    for (unsigned j = i % 5; j > 0; --j) clock({}, 0, 50);
  }
  EXPECT_GT(seen, 20u);
}

INSTANTIATE_TEST_SUITE_P(Modes, MbTx,
                         ::testing::Values(Mode{0, 0}, Mode{1, 0}, Mode{0, 1}, Mode{1, 1}));

}  // namespace
}  // namespace vericansim
