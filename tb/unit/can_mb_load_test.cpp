// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_load alone, with AEN = 1 (flexcan.md 3.3, 3.4): the engine gets what was written last,
// whole, and every request to send has one end, whenever the CPU writes and slots are granted.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <vector>

#include "Vcan_mb_load.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBuffers = 4, kBit = 8;
constexpr unsigned kActive = 0xC, kInactive = 0x8, kAborted = 0x9, kAnswer = 0xE, kAnswers = 0xA;

struct Buffer {
  std::uint32_t cs = 0, id = 0, low = 0, high = 0;
  bool pending = false, abort = false;
  [[nodiscard]] unsigned code() const { return (cs >> 24) & 0xF; }
  [[nodiscard]] bool active() const { return code() == kActive || code() == kAnswer; }
};

// RAM, arbitration by index, guard and engine around the block, each as simple as can be.
class MbLoad : public ::testing::Test {
 protected:
  void SetUp() override {
    top_.reset();
    top_->running_i = 1;
    top_->aen_i = 1;
  }

  // A write has one clock here; its command comes in the one before.
  void clock(std::optional<unsigned> write = {}, unsigned code = 0) {
    if (write) step({}, 0, *write);
    step(write, code, rng_() % kBuffers);
  }

  void step(std::optional<unsigned> write, unsigned code, unsigned command) {
    top_->cmd_i = 1;
    top_->cmd_mb_i = command;
    engine();
    arbitrate();
    top_.settle();
    const bool accepted = write && cpu(*write, code);
    top_.settle();
    const Step next = grant();
    finish();
    if (!on_bus_ && now_ % kBit == 0 && now_ >= free_at_ && top_->tx_req_o != 0) take();
    ++now_;
    if (accepted) rewrite(*write, code);
    top_.clock();
    after(next);
    top_->cs_written_i = accepted;
    if (accepted) top_->cs_written_idx_i = *write;
    top_->cs_written_act_i = code == kActive || code == kAnswer;
    top_->cs_wr_i = top_->abort_i = 0;
  }

  struct Step {
    bool data = false;
    unsigned step = 0;
    Buffer read;
    std::uint32_t word = 0;
  };

  void arbitrate() {
    top_->settled_i = 0;
    for (unsigned i = kBuffers; i-- > 0;) {
      if (!buffers_[i].active() || (top_->off_o != 0 && top_->cur_idx_o == i)) continue;
      top_->settled_i = 1;
      top_->best_idx_i = i;
    }
    top_->gap_i = !on_bus_;
  }

  // What can_mb_guard does; true if the word is written.
  bool cpu(unsigned i, unsigned code) {
    const bool cur = top_->cur_idx_o == i;
    top_->cs_wr_i = 1;
    top_->cs_wr_idx_i = i;
    if (!cur || top_->out_o == 0) return true;
    if (code == kAborted && top_->done_o == 0) {
      EXPECT_TRUE(buffers_[i].pending);
      top_->abort_i = 1;
      buffers_[i].abort = true;
      starts_at_abort_ = starts_;
    }
    return false;
  }

  void rewrite(unsigned i, unsigned code) {
    Buffer &b = buffers_[i];
    b.cs = (code << 24) | (rng_() & 0x3F0000);
    b.pending = b.active();
    if (!b.pending) return;
    b.id = rng_() & 0x1FFFFFFF;
    b.low = rng_();
    b.high = rng_();
  }

  // A read slot: the buffer as it is before this clock's write.
  Step grant() {
    Step next;
    if (top_->req_o == 0 || step_.data || rng_() % 3 == 0) return next;
    next = {true, top_->step_o, buffers_[top_->ld_idx_o], 0};
    if (next.step == 0) next.word = hidden_[top_->row_o == 0][top_->word_o];
    if (next.step == 1) next.read = buffers_[top_->cur_idx_o];
    return next;
  }

  // Second half of the step under way.
  void finish() {
    if (!step_.data) return;
    if (step_.step == 2) hidden_[top_->row_o][0] = step_.read.low;
    if (step_.step == 3) hidden_[top_->row_o][1] = step_.read.high;
    if (step_.step == 1 && top_->cancel_o == 0) end(buffers_[top_->cur_idx_o]);
  }

  void end(Buffer &b) {
    const unsigned code = top_->code_o;
    ASSERT_TRUE(b.pending) << "a second end";
    ASSERT_FALSE(on_bus_);
    if (result_ok_) {
      const bool rtr = (b.cs & (1u << 20)) != 0;
      ASSERT_EQ(code, b.code() == kAnswer ? kAnswers : rtr ? 4u : kInactive);
    } else {
      ASSERT_EQ(code, kAborted);
      ASSERT_TRUE(b.abort);
      ++aborted_;
    }
    if (b.abort) {
      ASSERT_LE(starts_, starts_at_abort_ + 1) << "tried again after the request";
    }
    b.cs = (b.cs & 0x00FFFFFF) | (code << 24);
    b.pending = b.abort = result_ok_ = false;
    ++ends_;
  }

  // A frame starts at a sample point, takes its words in time, and ends some way or other.
  void engine() {
    top_->start_i = top_->tx_next_i = top_->tx_ok_i = top_->tx_fail_i = 0;
    top_->transmitter_i = on_bus_;
    top_->tick_i = top_->tick_req_o != 0 && now_ % kBit == 0;
    if (taken_) {
      top_->start_i = top_->tx_next_i = 1;
      taken_ = false;
    } else if (on_bus_) {
      body();
    }
  }

  void take() {
    on_bus_ = taken_ = true;
    began_ = now_;
    ++starts_;
    sending_ = buffers_[top_->cur_idx_o];
    ASSERT_TRUE(sending_.pending);
    const bool ide = (sending_.cs & (1u << 21)) != 0;
    ASSERT_EQ(top_->tx_word_o, sending_.id & (ide ? 0x1FFFFFFFu : 0x1FFC0000u));
    ASSERT_EQ((top_->tx_ide_o << 5) | (top_->tx_rtr_o << 4) | top_->tx_dlc_o,
              (sending_.cs >> 16) & 0x3F);
  }

  void body() {
    const unsigned at = now_ - began_;
    if (at == 60 || at == 150) {  // the first word was asked for with the start
      ASSERT_EQ(top_->tx_word_o, at == 60 ? sending_.low : sending_.high);
      top_->tx_next_i = at == 60;
    }
    const bool fail = at % kBit == 0 && rng_() % 12 == 0;
    if (!fail && at < 160) return;
    on_bus_ = false;
    free_at_ = now_ + 3 * kBit;
    result_ok_ = !fail;
    (fail ? top_->tx_fail_i : top_->tx_ok_i) = 1;
  }

  void after(const Step &next) {
    step_ = next;
    top_->data_i = top_->flight_i = next.data;
    top_->data_step_i = next.step;
    if (!next.data) return;
    top_->cs_i = next.read.cs;
    top_->msg_i = next.step == 0 ? next.word : next.step == 4 ? next.read.id : 0;
  }

  LeafModel<Vcan_mb_load> top_;
  std::array<Buffer, kBuffers> buffers_{};
  std::array<std::array<std::uint32_t, 2>, 2> hidden_{};
  Buffer sending_;
  Step step_;
  bool on_bus_ = false, taken_ = false, result_ok_ = false;
  unsigned now_ = 0, began_ = 0, free_at_ = 0, starts_ = 0, ends_ = 0, aborted_ = 0;
  unsigned starts_at_abort_ = 0;
  std::mt19937 rng_{11};
};

// MO-10, FX-3.4.b, FX-3.4.c, FX-9.ERR006032
TEST_F(MbLoad, EveryRequestHasOneEndAndItsOwnContent) {
  for (unsigned i = 0; i < 400000; ++i) {
    const bool busy = (i >> 12) % 2 != 0;
    if (rng_() % (busy ? 4 : 90) != 0) {
      clock();
    } else {
      constexpr std::array<unsigned, 6> kCodes{kActive,   kActive,  kAnswer,
                                               kInactive, kAborted, kAborted};
      clock(rng_() % kBuffers, kCodes[rng_() % kCodes.size()]);
    }
    ASSERT_FALSE(HasFatalFailure()) << "clock " << i;
  }
  EXPECT_GT(ends_, 500u);
  EXPECT_GT(aborted_, 50u);
  // Left alone, everything ends.
  for (unsigned i = 0; i < 20000; ++i) clock();
  for (const Buffer &b : buffers_) EXPECT_FALSE(b.pending);
}

// FX-3.4.a: in bus-off and listen-only nothing moves out.
TEST_F(MbLoad, NothingIsPresentedWhileTheEngineStartsNoFrame) {
  top_->mute_i = 1;
  clock(2, kActive);
  for (unsigned i = 0; i < 100; ++i) {
    clock();
    ASSERT_EQ(top_->tx_req_o, 0);
    ASSERT_EQ(top_->out_o, 0);
  }
  top_->mute_i = 0;
  for (unsigned i = 0; i < 2000 && buffers_[2].pending; ++i) clock();
  EXPECT_FALSE(buffers_[2].pending);
}

// One buffer after the other, signal by signal.
class MbLoadSteps : public ::testing::Test {
 protected:
  MbLoadSteps() {
    load_->rst_ni = load_->running_i = load_->aen_i = load_->gap_i = 1;
    // The CPU's accesses are to buffer 2.
    load_->cmd_i = 1;
    load_->cmd_mb_i = load_->cs_wr_idx_i = 2;
    load_.reset();
    load_.settle();
  }
  /// One clock; every step is granted unless the slot is another's, the buffer that is read is
  /// active.
  void clock(unsigned code = kActive, bool slot = true) {
    load_.settle();
    const bool step = slot && load_->req_o != 0 && load_->data_i == 0;
    const unsigned number = load_->step_o;
    load_.clock();
    load_->data_i = load_->flight_i = step;
    load_->data_step_i = number;
    load_->cs_i = code << 24;
    load_->start_i = load_->tx_ok_i = load_->tx_fail_i = load_->cs_written_i = 0;
    load_.settle();
    if (load_->data_i != 0) steps_.push_back(number);
    retries_ += load_->retry_o;
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  void winner(unsigned buffer, bool settled = true) {
    load_->best_idx_i = buffer;
    load_->settled_i = settled;
  }
  void present(unsigned buffer) {
    winner(buffer);
    for (unsigned i = 0; i < 20 && load_->tx_req_o == 0; ++i) clock();
    ASSERT_TRUE(load_->tx_req_o);
    ASSERT_EQ(load_->cur_idx_o, buffer);
  }
  void start() {
    load_->start_i = load_->transmitter_i = 1;
    load_->gap_i = 0;
    clock();
    winner(0, false);
    clocks(10);
  }
  LeafModel<Vcan_mb_load> load_;
  std::vector<unsigned> steps_;
  unsigned retries_ = 0;
};

// FX-3.4.a: the write before has taken the frame back; the next one finds nothing moved out.
TEST_F(MbLoadSteps, FrameThatIsTakenBackHasNotMovedOut) {
  load_->gap_i = 0;
  present(2);
  EXPECT_FALSE(load_->out_o);
  clock();  // one that is being written is not presented
  load_->cs_written_i = 1;
  load_->cs_written_idx_i = 2;
  load_->cs_written_act_i = 0;
  load_->gap_i = 1;
  load_.settle();
  EXPECT_FALSE(load_->out_o) << "it is being taken back in this clock";
  clock();
  EXPECT_FALSE(load_->tx_req_o || load_->out_o);
  present(2);
  EXPECT_TRUE(load_->out_o);
}

// FX-3.2.f, FX-3.3.f: what was sent is not tried again; what was not is, if its end is seen or not.
// A frame with one attempt only ends with it, also if the node goes bus-off: no frame is on its bus
// in the same clock.
TEST_F(MbLoadSteps, OnlyWhatWasNotSentIsTriedAgain) {
  for (const unsigned end : {0u, 1u, 2u, 3u}) {
    load_->oneshot_i = end == 3;
    present(2);
    start();
    retries_ = 0;
    load_->gap_i = 1;
    load_->tx_ok_i = end == 0;
    load_->tx_fail_i = end == 1 || end == 3;
    unsigned flags = 0;
    for (unsigned i = 0; i < 10; ++i) {
      clock();
      flags += load_->flag_o;
    }
    const bool over = end == 0 || end == 3;
    EXPECT_EQ(retries_, over ? 0u : 1u) << end;
    EXPECT_EQ(flags, over ? 1u : 0u) << end;
  }
}

// FX-3.3.g: a CPU that writes the C/S word of the buffer that was sent over and over, one write
// behind the other, asks for no retry with that, and holds up no other buffer's frame. The slots of
// the engine are the second clocks of the writes, each told of in the clock after.
TEST_F(MbLoadSteps, WritesOfTheBufferThatWasSentHoldNobodyUp) {
  present(2);
  start();
  load_->gap_i = load_->tx_ok_i = 1;
  clock();
  clocks(10);
  retries_ = 0;
  winner(3);
  for (unsigned i = 0; i < 40; ++i) {
    load_->cs_wr_i = 1;
    load_->cs_written_i = i % 2 == 0;
    load_->cs_written_idx_i = 2;
    clock(kActive, i % 2 != 0);
  }
  EXPECT_TRUE(load_->tx_req_o);
  EXPECT_EQ(load_->cur_idx_o, 3);
  EXPECT_EQ(retries_, 0u);
}

// FX-3.3.f: a frame that is loaded while another is sent makes way for a better one; what is still
// being looked for is none.
TEST_F(MbLoadSteps, BetterFrameReplacesTheOneThatIsLoadedAhead) {
  present(2);
  start();
  winner(3);
  clocks(10);
  EXPECT_EQ(load_->ld_idx_o, 3);
  steps_.clear();
  winner(1, false);
  clocks(10);
  EXPECT_EQ(load_->ld_idx_o, 3);
  winner(3);
  clocks(10);
  EXPECT_TRUE(steps_.empty()) << "loaded already";
  winner(1);
  clocks(10);
  EXPECT_EQ(load_->ld_idx_o, 1);
  load_->gap_i = load_->tx_fail_i = 1;
  clock();
  present(1);
}

// FX-3.3.f: also one that comes while another is copied to be presented, in any clock of that; but
// not a second one, or writing one buffer over and over would keep all others off the bus.
TEST_F(MbLoadSteps, BetterFrameIsCopiedInsteadOnce) {
  for (const bool twice : {false, true}) {
    for (unsigned k = 1; k < 5; ++k) {
      load_->running_i = 0;
      clocks(2);
      load_->running_i = 1;
      winner(3);
      clocks(k);
      ASSERT_FALSE(load_->tx_req_o);
      winner(2);
      clocks(4);
      EXPECT_EQ(load_->ld_idx_o, 2) << k;
      if (twice) winner(1);
      for (unsigned i = 0; i < 20 && load_->tx_req_o == 0; ++i) clock();
      ASSERT_TRUE(load_->tx_req_o);
      EXPECT_EQ(load_->cur_idx_o, 2) << k;
    }
  }
}

// FX-3.3.f: a frame that has just gone on the bus may be the winner for a clock (can_mb_tx): the
// next one, which is being copied then, is not copied twice for it.
TEST_F(MbLoadSteps, FrameThatStartsReplacesNothing) {
  for (unsigned k = 1; k < 5; ++k) {
    present(2);
    steps_.clear();
    winner(3);
    clocks(k);
    load_->start_i = load_->transmitter_i = 1;
    load_->gap_i = 0;
    clock();
    winner(2);
    clock();
    winner(3);
    clocks(10);
    EXPECT_EQ(load_->ld_idx_o, 3) << k;
    EXPECT_EQ(std::ranges::count(steps_, 2U), 1) << k;
    EXPECT_EQ(std::ranges::count(steps_, 3U), 1) << k;
    load_->gap_i = load_->tx_ok_i = 1;
    clock();
    winner(0, false);
    load_->running_i = 0;
    clocks(5);
    load_->running_i = 1;
  }
}

// FX-3.3.f: but what a pass that is not over has seen so far is no better frame: the one that is
// being copied is presented, in one go.
TEST_F(MbLoadSteps, UnfinishedPassReplacesNothing) {
  for (unsigned k = 1; k < 5; ++k) {
    load_->running_i = 0;
    clocks(2);
    load_->running_i = 1;
    steps_.clear();
    winner(3);
    clocks(k);
    ASSERT_FALSE(load_->tx_req_o);
    winner(2, false);
    for (unsigned i = 0; i < 20 && load_->tx_req_o == 0; ++i) clock();
    ASSERT_TRUE(load_->tx_req_o) << k;
    EXPECT_EQ(load_->cur_idx_o, 3) << k;
    EXPECT_EQ(steps_, (std::vector<unsigned>{2, 3, 4})) << "copied once, " << k;
  }
}

// FX-3.4.g: what the CPU has written while the end of the frame was on its way stays.
TEST_F(MbLoadSteps, EndOfARewrittenFrameIsNotWritten) {
  for (const bool rewritten : {false, true}) {
    present(2);
    start();
    load_->gap_i = load_->tx_ok_i = 1;
    clock();
    for (unsigned i = 0; i < 5 && load_->data_i == 0; ++i) clock();
    ASSERT_TRUE(load_->data_i);
    load_->cs_written_i = rewritten;
    load_->cs_written_idx_i = 2;
    load_.settle();
    EXPECT_EQ(load_->cancel_o != 0, rewritten);
    clock();
    EXPECT_EQ(load_->flag_o != 0, !rewritten);
    clocks(5);
  }
}

// The same before that step has its slot: nothing is written, and the buffer contends again.
TEST_F(MbLoadSteps, FrameThatIsRewrittenBeforeItsEndContendsAgain) {
  present(2);
  start();
  load_->gap_i = load_->tx_ok_i = 1;
  clock();
  retries_ = 0;
  load_->cs_written_i = 1;
  load_->cs_written_idx_i = 2;
  clock();
  unsigned flags = load_->flag_o;
  for (unsigned i = 0; i < 6; ++i, flags += load_->flag_o) clock();
  EXPECT_EQ(retries_, 1u);
  EXPECT_EQ(flags, 0u);
}

// FX-3.4.a: a presented frame that was rewritten is taken back once; a second time it stays, and is
// replaced by the new one at the next sample point. With MCR.AEN it is taken back each time: no
// frame is sent that its buffer does not tell of.
TEST_F(MbLoadSteps, FrameThatIsRewrittenAgainIsReplaced) {
  load_->gap_i = 0;
  for (const bool aen : {false, true}) {
    load_->aen_i = aen;
    for (const bool again : {false, true}) {
      present(2);
      clock();
      load_->cs_written_i = load_->cs_written_act_i = 1;
      load_->cs_written_idx_i = 2;
      clock();
      EXPECT_EQ(load_->tx_req_o != 0, again && !aen);
      load_->cs_written_i = load_->cs_written_act_i = 0;
    }
    if (!aen) {
      unsigned loads = 0;
      for (unsigned i = 0; i < 20; ++i) {
        load_->tick_i = load_->tick_req_o;
        clock();
        loads += load_->take_o;
      }
      EXPECT_EQ(loads, 1u) << "loaded once more, and only once";
      EXPECT_TRUE(load_->tx_req_o);
    }
    load_->running_i = 0;
    clock();
    load_->running_i = 1;
  }
}

// A winner that is not active, as an upset flip-flop makes it, is told of once; an active one not.
TEST_F(MbLoadSteps, WinnerThatIsNotActiveIsDropped) {
  for (const unsigned code : {0x8u, 0x9u, 0xAu, kActive, kAnswer}) {
    winner(3);
    unsigned bad = 0;
    for (unsigned i = 0; i < 12; ++i) {
      clock(code);
      bad += load_->inactive_o;
      if (load_->inactive_o != 0) winner(0, false);
    }
    const bool active = code == kActive || code == kAnswer;
    EXPECT_EQ(bad, active ? 0u : 1u) << code;
    EXPECT_EQ(load_->tx_req_o != 0, active) << code;
    load_->running_i = 0;
    clock();
    load_->running_i = 1;
  }
}

// FX-3.4.a: with AEN = 1 the frame that is presented is not replaced in the clock in which the CPU
// writes its C/S word, for that may ask to abort it.
TEST_F(MbLoadSteps, FrameThatIsWrittenIsNotReplaced) {
  for (const bool aen : {false, true}) {
    load_->aen_i = aen;
    present(2);
    EXPECT_FALSE(load_->tick_req_o) << "nobody waits for a sample point";
    winner(3);
    clocks(10);
    EXPECT_TRUE(load_->tick_req_o);
    load_->tick_i = 1;
    clock();
    load_->tick_i = 0;
    clock();
    ASSERT_TRUE(load_->data_i);
    ASSERT_EQ(load_->data_step_i, 4);
    load_->cs_wr_i = 1;
    load_->cs_wr_idx_i = 2;
    clock();
    load_->cs_wr_i = 0;
    EXPECT_EQ(load_->cur_idx_o, aen ? 2 : 3);
    winner(0, false);
    load_->running_i = 0;
    clocks(5);
    load_->running_i = 1;
  }
}

// A step that was granted is over when its data is there, not before: the copy may be held up.
TEST_F(MbLoadSteps, StepsWaitForTheirData) {
  winner(3);
  for (const unsigned step : {2u, 3u, 4u}) {
    for (unsigned i = 0; i < 5 && load_->step_o != step; ++i) clock();
    load_->data_i = 0;
    load_->flight_i = 1;
    load_->data_step_i = step;
    for (unsigned i = 0; i < 5; ++i) {
      load_.settle();
      EXPECT_EQ(load_->step_o, step);
      EXPECT_FALSE(load_->tx_req_o);
      load_.clock();
    }
    load_->data_i = 1;
    load_.clock();
    load_->data_i = load_->flight_i = 0;
    load_.settle();
  }
  EXPECT_TRUE(load_->tx_req_o);
}

TEST_F(MbLoadSteps, NothingIsPresentedInReset) {
  present(2);
  load_->rst_ni = 0;
  load_.settle();
  EXPECT_FALSE(load_->tx_req_o || load_->req_o || load_->out_o || load_->busy_o);
}

}  // namespace
}  // namespace vericansim
