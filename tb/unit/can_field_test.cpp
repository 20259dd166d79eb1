// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_field alone: it must walk through frames, delimiters and gaps as the frame format says.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "Vcan_field.h"
#include "Vcan_field___024root.h"
#include "model/frame_codec.hpp"
#include "unit/leaf_model.hpp"

// Verilator's own (5.006): evaluates all logic that is not clocked. A register that a test
// overwrites is nothing that eval() looks at.
void Vcan_field___024root___eval_settle(Vcan_field___024root *root);

namespace vericansim {
namespace {

/// Overwrites registers as upset flip-flops do. Not in a netlist of cells, which has no variables
/// for them: false. (tb/netlist/equal.py proves that such a netlist is equal in every state.)
template <typename Root>
bool upset(Root *root, unsigned field, unsigned left, bool transmitter) {
  if constexpr (requires { root->can_field__DOT__field_q; }) {
    root->can_field__DOT__field_q = field;
    root->can_field__DOT__left_q = left;
    root->can_field__DOT__tx_q = transmitter;
    Vcan_field___024root___eval_settle(root);
    return true;
  } else {
    static_assert(!kHasRegisters<Root>, "the register has another name");
    return false;
  }
}

/// What can_error says of a bit.
struct Finding {
  bool error = false;
  bool lost = false;
  bool overload = false;
};

class CanField : public testing::Test {
 protected:
  void SetUp() override {
    field_.reset();
    field_.clock();
    field_->run_i = 1;
  }
  void bit(bool recessive, const Finding &finding = {}, bool stuff = false) {
    field_->stuff_i = stuff;
    field_->judge_i = 1;
    field_.clock();
    field_->judge_i = 0;
    field_->error_i = finding.error;
    field_->lost_i = finding.lost;
    field_->overload_i = finding.overload;
    field_->flag_r_i = field_->flag_d_i = finding.error || finding.overload;
    field_->bit_i = recessive;
    field_->sample_i = 1;
    field_.clock();
    field_->sample_i = 0;
    field_->error_i = field_->lost_i = field_->overload_i = 0;
    field_->flag_r_i = field_->flag_d_i = 0;
    field_->prev_i = recessive;
  }
  void bits(int count, bool recessive = true) {
    for (int i = 0; i < count; ++i) bit(recessive);
  }
  [[nodiscard]] Field at() { return static_cast<Field>(field_->field_o); }
  /// Bits until the place changes, recessive ones.
  unsigned bits_here() {
    const Field start = at();
    unsigned count = 0;
    while (at() == start && count < 100) {
      bit(true);
      ++count;
    }
    return count;
  }
  void to_idle() {
    bits(11);
    ASSERT_EQ(at(), Field::kIdle);
  }
  /// Walks SOF to EOF7 of a frame and compares the place of each bit; `sof`: place of its SOF.
  void walk(const Frame &frame, Field sof) {
    unsigned dlc = 0;
    std::map<Field, unsigned> left;
    const auto wire = encode_frame(frame).bits;
    for (const WireBit &b : wire) left[b.field] += b.is_stuff ? 0 : 1;
    for (const WireBit &b : wire) {
      const Field want = b.field == Field::kSof ? sof : b.field;
      ASSERT_EQ(field_name(at()), field_name(want)) << +b.index;
      if (!b.is_stuff) {
        ASSERT_EQ(field_->left_o, --left[b.field]) << field_name(want);
      }
      const bool recessive = b.level == Level::kRecessive;
      if (b.field == Field::kDlc && b.index == 3 && !b.is_stuff) field_->dlc_i = dlc & 7;
      bit(recessive, {}, b.is_stuff);
      if (b.is_stuff) continue;
      if (b.field == Field::kIde) field_->ide_i = recessive;
      const bool rtr = b.field == Field::kExRtr || (b.field == Field::kRtr && !frame.extended);
      if (rtr) field_->rtr_i = recessive;
      if (b.field == Field::kDlc) dlc = (dlc << 1) | (recessive ? 1 : 0);
    }
    ASSERT_EQ(at(), Field::kInt);
  }
  LeafModel<Vcan_field> field_;
};

Frame random_frame(std::mt19937 &rng) {
  Frame frame{.extended = (rng() & 1) != 0, .remote = (rng() & 3) == 0};
  frame.id = static_cast<std::uint32_t>(rng()) & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
  frame.dlc = rng() & 15;
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(rng());
  return frame;
}

// IN-01, IN-03, PF-27: eleven recessive bits in a row, any dominant one starts again.
TEST_F(CanField, IntegratesAfterElevenRecessiveBits) {
  for (int round = 0; round < 2; ++round) {
    bits(10);
    EXPECT_EQ(at(), Field::kInteg);
    bit(false);
  }
  bits(10);
  EXPECT_EQ(at(), Field::kInteg);
  bit(true);
  EXPECT_EQ(at(), Field::kIdle);
}

// FF-01, FF-02, FF-03, FF-07, FF-08, FF-09, FF-11, ST-09: received frames of every format.
TEST_F(CanField, WalksThroughReceivedFrames) {
  std::mt19937 rng{2};
  to_idle();
  for (int round = 0; round < 300; ++round) {
    walk(random_frame(rng), Field::kIdle);
    EXPECT_FALSE(field_->transmitter_o);
    EXPECT_EQ(bits_here(), 3u);
  }
}

// IF-02, IF-03, RO-01: own frames, the next one right after INT3.
TEST_F(CanField, WalksThroughOwnFramesThreeBitsApart) {
  std::mt19937 rng{3};
  to_idle();
  field_->tx_req_i = 1;
  bit(true);
  for (int round = 0; round < 100; ++round) {
    const Frame frame = random_frame(rng);
    field_->ide_i = frame.extended;
    field_->rtr_i = frame.remote;
    walk(frame, Field::kSof);
    EXPECT_TRUE(field_->transmitter_o);
    EXPECT_EQ(bits_here(), 3u);
    EXPECT_EQ(at(), Field::kSof);
  }
}

// IF-05, IF-06, IF-10: dominant INT3: join with a frame pending, receive without.
TEST_F(CanField, DominantThirdIntermissionBitIsAStartOfFrame) {
  for (const bool pending : {false, true}) {
    to_idle();
    walk({.id = 0x123}, Field::kIdle);
    bits(2);
    field_->tx_req_i = pending;
    bit(false);
    EXPECT_EQ(at(), Field::kId);
    EXPECT_EQ(field_->transmitter_o != 0, pending);
    field_->run_i = 0;
    field_.clock();
    field_->run_i = 1;
    field_->tx_req_i = 0;
  }
}

// IF-14: a frame that was pending when another node begins in idle joins it.
TEST_F(CanField, PendingFrameJoinsAStartOfFrameInIdle) {
  for (const bool pending : {false, true}) {
    to_idle();
    bits(3);
    field_->tx_req_i = pending;
    bit(false);
    EXPECT_EQ(at(), Field::kId);
    EXPECT_EQ(field_->transmitter_o != 0, pending);
    field_->run_i = field_->tx_req_i = 0;
    field_.clock();
    field_->run_i = 1;
  }
}

// IF-08, IF-10: a passive transmitter waits eight bits more, and does not join.
TEST_F(CanField, PassiveTransmitterSuspends) {
  to_idle();
  field_->tx_req_i = 1;
  bit(true);
  walk({.id = 0x123}, Field::kSof);
  field_->passive_i = 1;
  EXPECT_EQ(bits_here(), 3u);
  ASSERT_EQ(at(), Field::kSuspend);
  EXPECT_EQ(bits_here(), 8u);
  EXPECT_EQ(at(), Field::kSof);
}

// AR-02, AR-08, IF-09: after a lost bit the node receives, and suspends no more.
TEST_F(CanField, LostArbitrationChangesTheRole) {
  to_idle();
  field_->tx_req_i = 1;
  bit(true);
  bit(false);
  bit(false, {.lost = true});
  EXPECT_FALSE(field_->transmitter_o);
  EXPECT_EQ(at(), Field::kId);
}

// IF-16, IN-01: in reset the node takes no part, and eleven bits are to come.
TEST_F(CanField, HardResetEndsWhateverIsUnderWay) {
  to_idle();
  field_->tx_req_i = 1;
  bit(true);
  bits(4, false);
  ASSERT_TRUE(field_->transmitter_o);
  field_->rst_ni = 0;
  field_.settle();
  EXPECT_EQ(at(), Field::kInteg);
  EXPECT_EQ(field_->left_o, 10);
  EXPECT_FALSE(field_->transmitter_o);
}

// EF-01, EF-08, EF-10, OV-01, OV-07: six flag bits, delimiter of eight, three of intermission.
TEST_F(CanField, ErrorAndOverloadFrames) {
  for (const bool overload : {false, true}) {
    to_idle();
    bit(false);
    bit(true, {.error = !overload, .overload = overload});
    EXPECT_EQ(at(), overload ? Field::kOvlFlag : Field::kErrFlag);
    EXPECT_EQ(field_->overload_frame_o != 0, overload);
    for (unsigned left = 6; left-- > 0; bit(false)) EXPECT_EQ(field_->left_o, left);
    EXPECT_EQ(at(), Field::kWait);
    bits(20, false);
    EXPECT_EQ(at(), Field::kWait);
    bit(true);  // DEL1
    EXPECT_EQ(at(), Field::kDel);
    EXPECT_EQ(bits_here(), 7u);
    EXPECT_EQ(at(), Field::kInt);
    EXPECT_EQ(bits_here(), 3u);
    EXPECT_EQ(at(), Field::kIdle);
    field_->run_i = 0;
    field_.clock();
    field_->run_i = 1;
  }
}

// MO-02: listen-only integrates instead, with the recessive bits that it has just seen.
TEST_F(CanField, ListenOnlyIntegratesAfterErrorAndOverload) {
  field_->lom_i = 1;
  for (const bool overload : {false, true}) {
    for (const unsigned seen : {0U, 1U, 6U}) {
      to_idle();
      bit(false);
      field_->ones_i = seen == 0 ? 3 : seen - 1;  // before this bit
      bit(seen != 0, {.error = !overload, .overload = overload});
      EXPECT_EQ(at(), Field::kInteg);
      EXPECT_EQ(bits_here(), 11 - seen);
      EXPECT_EQ(at(), Field::kIdle);
      field_->run_i = 0;
      field_.clock();
      field_->run_i = 1;
    }
  }
}

// EF-02, EF-03, PF-48: a passive flag ends after six equal bits.
TEST_F(CanField, PassiveFlagEndsAfterSixEqualBits) {
  to_idle();
  bit(false);
  field_->passive_i = 1;
  bit(true, {.error = true});
  EXPECT_TRUE(field_->passive_flag_o);
  for (const char level : std::string{"0000011111000000"}) {
    EXPECT_EQ(at(), Field::kErrFlag);
    bit(level == '1');
  }
  EXPECT_EQ(at(), Field::kWait);
}

// BO-01, BO-02: bus-off ends whatever was under way; a dominant bit starts the eleven again.
TEST_F(CanField, BusOffCountsElevenBits) {
  to_idle();
  bit(false);
  field_->boff_i = 1;
  field_->boff_enter_i = 1;
  field_.clock();
  field_->boff_enter_i = 0;
  EXPECT_EQ(at(), Field::kBusOff);
  bits(10);
  EXPECT_TRUE(field_->ends_o);
  bit(false);
  EXPECT_FALSE(field_->ends_o);
  bits(10);
  EXPECT_TRUE(field_->ends_o);
}

// FF-06, IN-02, PF-20: FD-tolerant, a recessive FDF bit: the node integrates anew.
TEST_F(CanField, FdFrameIsLeftAlone) {
  field_->fd_tolerant_i = 1;
  to_idle();
  bit(false);
  bits(11, false);
  bit(false);  // RTR
  bit(false);  // IDE
  ASSERT_EQ(at(), Field::kR0);
  bit(true);
  EXPECT_EQ(at(), Field::kInteg);
  to_idle();
}

// IN-02: an edge between samples restarts the count of an FD-tolerant node, in the first clock of
// a bit as in any other, in the last of the eleven bits as in any other.
TEST_F(CanField, EdgeRestartsIntegrationOfATolerantNode) {
  field_->fd_tolerant_i = 1;
  for (const bool first_clock : {false, true}) {
    bits(10);
    ASSERT_EQ(at(), Field::kInteg);
    field_->judge_i = 1;
    field_->edge_i = first_clock;
    field_.clock();
    field_->judge_i = 0;
    field_->edge_i = !first_clock;
    field_.clock();
    field_->edge_i = 0;
    field_->bit_i = 1;
    field_->sample_i = 1;
    field_.clock();
    field_->sample_i = 0;
    EXPECT_EQ(at(), Field::kInteg) << (first_clock ? "edge in the first clock" : "edge later");
    // That bit was the first of eleven.
    bits(9);
    EXPECT_EQ(at(), Field::kInteg);
    bit(true);
    EXPECT_EQ(at(), Field::kIdle);
    field_->run_i = 0;
    field_.clock();
    field_->run_i = 1;
  }
}

// IN-01: a code that stands for no field, as an upset flip-flop leaves it, leads to integration,
// whatever the other registers hold; then the node is on the bus again.
TEST_F(CanField, CodesOfNoFieldLeadToIntegration) {
  for (const unsigned code : {0x05, 0x06, 0x07, 0x0E, 0x0F, 0x15, 0x16, 0x17}) {
    for (const bool recessive : {false, true}) {
      for (const unsigned left : {0u, 1u, 63u}) {
        SCOPED_TRACE(testing::Message() << "code " << code << " left " << left);
        to_idle();
        if (!upset(field_->rootp, code, left, true)) GTEST_SKIP();
        bit(recessive);
        ASSERT_EQ(at(), Field::kInteg);
        ASSERT_FALSE(field_->transmitter_o);
        bits(10);
        ASSERT_EQ(at(), Field::kInteg) << "all eleven bits";
        bit(true);
        ASSERT_EQ(at(), Field::kIdle);
        field_->run_i = 0;
        field_.clock();
        field_->run_i = 1;
      }
    }
  }
}

// IN-01: bus-off recovery without bus-off, as an upset flip-flop leaves it: no sequence would be
// counted, so nothing would ever end it; the node integrates.
TEST_F(CanField, RecoveryWithoutBusOffLeadsToIntegration) {
  for (const bool recessive : {false, true}) {
    to_idle();
    if (!upset(field_->rootp, static_cast<unsigned>(Field::kBusOff), 10, false)) GTEST_SKIP();
    bit(recessive);
    ASSERT_EQ(at(), Field::kInteg);
    bits(11);
    ASSERT_EQ(at(), Field::kIdle);
    field_->run_i = 0;
    field_.clock();
    field_->run_i = 1;
  }
}

}  // namespace
}  // namespace vericansim
