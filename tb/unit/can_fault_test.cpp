// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_fault alone: each rule of fault confinement as one bit that is or is not counted.
#include <gtest/gtest.h>

#include "Vcan_fault.h"
#include "Vcan_fault___024root.h"
#include "bus/field.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

/// A sampled bit with what the other blocks say of it.
struct Bit {
  Field field = Field::kData;
  bool transmitter = false;
  bool error = false;
  bool seen = true;  ///< level: true is recessive
  bool sent = true;
  bool last = false;
  bool exempt = false;
  bool ack_error = false;
  bool passive_flag = false;
  bool overload_frame = false;
  unsigned after_flag = 0;  ///< in the delimiter wait: number of the bit after the flag, from 1
  bool free = false;        ///< a frame may begin after it
};

class CanFault : public testing::Test {
 protected:
  void SetUp() override {
    fault_.reset();
    preset(0, 0);
  }
  void preset(unsigned tec, unsigned rec) {
    fault_->run_i = 0;
    fault_->we_i = 1;
    fault_->wdata_i = (rec << 8) | tec;
    fault_.clock();
    fault_->we_i = 0;
    fault_->run_i = 1;
    fault_.clock();
  }
  void bit(const Bit &b) {
    sample(b);
    for (int i = 0; i < 4; ++i) fault_.clock();
  }
  /// The clock of the sample point alone: decided, and not counted yet.
  void sample(const Bit &b) {
    fault_->field_i = static_cast<unsigned>(b.field);
    fault_->transmitter_i = b.transmitter;
    fault_->error_i = b.error;
    fault_->bit_i = b.seen;
    fault_->sent_i = b.sent;
    fault_->last_i = fault_->ends_i = b.last;
    fault_->exempt_i = b.exempt;
    fault_->ack_error_i = b.ack_error;
    fault_->passive_flag_i = b.passive_flag;
    fault_->overload_frame_i = b.overload_frame;
    fault_->after_flag_i =
        b.after_flag == 0 ? 0 : (b.after_flag == 1 ? 8u : 0u) | ((8 - b.after_flag % 8) % 8);
    fault_->free_i = b.free;
    fault_->sample_i = 1;
    fault_.clock();
    fault_->sample_i = 0;
  }
  /// Changes of {TEC, REC} by a bit, from the given start.
  void expect_change(const Bit &b, int tec, int rec, unsigned from_tec = 40,
                     unsigned from_rec = 40) {
    preset(from_tec, from_rec);
    bit(b);
    EXPECT_EQ(static_cast<int>(fault_->tec_o) - static_cast<int>(from_tec), tec);
    EXPECT_EQ(static_cast<int>(fault_->rec_o) - static_cast<int>(from_rec), rec);
  }
  LeafModel<Vcan_fault> fault_;
};

// FC-01, FC-02, FC-03, FC-05: an error counts once, for the role of the node.
TEST_F(CanFault, ErrorCountsForTheRole) {
  expect_change({.transmitter = true, .error = true}, 8, 0);
  expect_change({.transmitter = false, .error = true}, 0, 1);
  expect_change({.transmitter = true}, 0, 0);
}

// TH-06, FC-08: the role in the bit decides, though the engine stops in the clock behind it.
TEST_F(CanFault, RoleInTheBitDecidesWhereTheEngineStops) {
  preset(40, 40);
  sample({.field = Field::kWait, .transmitter = true, .seen = false, .after_flag = 8});
  fault_->transmitter_i = 0;
  fault_->run_i = 0;
  for (int i = 0; i < 4; ++i) fault_.clock();
  EXPECT_EQ(fault_->tec_o, 48);
  EXPECT_EQ(fault_->rec_o, 40);
}

// FC-06, FC-07: bit errors in the own active or overload flag are 8 for both roles.
TEST_F(CanFault, BitErrorInOwnFlagIsEight) {
  for (const Field flag : {Field::kErrFlag, Field::kOvlFlag}) {
    expect_change({.field = flag, .error = true, .sent = false}, 0, 8);
    expect_change({.field = flag, .transmitter = true, .error = true, .sent = false}, 8, 0);
  }
}

// FC-04, FC-08, OV-05: dominant bits after a flag: the first (receiver, error flag), each eighth.
TEST_F(CanFault, DominantBitsAfterAFlag) {
  for (const bool transmitter : {false, true}) {
    for (const bool overload : {false, true}) {
      for (unsigned n = 1; n <= 24; ++n) {
        const bool first = n == 1 && !transmitter && !overload;
        const int step = first || n % 8 == 0 ? 8 : 0;
        expect_change({.field = Field::kWait,
                       .transmitter = transmitter,
                       .seen = false,
                       .overload_frame = overload,
                       .after_flag = n},
                      transmitter ? step : 0, transmitter ? 0 : step);
      }
      expect_change({.field = Field::kWait,
                     .transmitter = transmitter,
                     .overload_frame = overload,
                     .after_flag = 1},
                    0, 0);
    }
  }
}

// FC-05: exception 1 for a passive transmitter only (FC-05c); exception 2 exempts one step.
TEST_F(CanFault, ExceptionsOfTheTransmitter) {
  const Bit no_ack{.field = Field::kAck, .transmitter = true, .error = true, .ack_error = true};
  expect_change(no_ack, 8, 0, 40);
  expect_change(no_ack, 8, 0, 127);
  expect_change(no_ack, 0, 0, 128);
  expect_change(no_ack, 0, 0, 40, 128);  // passive by REC
  expect_change({.field = Field::kId, .transmitter = true, .error = true, .exempt = true}, 0, 0);
}

// FC-05a: the withheld step is added once, at the first dominant bit of the passive flag.
TEST_F(CanFault, WithheldStepIsAddedOnceInThePassiveFlag) {
  preset(128, 0);
  bit({.field = Field::kAck, .transmitter = true, .error = true, .ack_error = true});
  const Bit flag_r{.field = Field::kErrFlag, .transmitter = true, .passive_flag = true};
  Bit flag_d = flag_r;
  flag_d.seen = false;
  for (int i = 0; i < 5; ++i) bit(flag_r);
  EXPECT_EQ(fault_->tec_o, 128);
  bit(flag_d);
  EXPECT_EQ(fault_->tec_o, 136);
  bit(flag_d);
  EXPECT_EQ(fault_->tec_o, 136);
}

// EF-04, PF-33: after any other error a dominant bit in the passive flag counts nothing.
TEST_F(CanFault, OnlyAMissingAcknowledgeWithholdsAStep) {
  preset(128, 0);
  bit({.transmitter = true, .error = true});
  bit({.field = Field::kErrFlag, .transmitter = true, .seen = false, .passive_flag = true});
  EXPECT_EQ(fault_->tec_o, 136);
}

// FC-05a: a dominant bit after the flag does not bring it back.
TEST_F(CanFault, WithheldStepIsGoneAfterTheFlag) {
  preset(128, 0);
  bit({.field = Field::kAck, .transmitter = true, .error = true, .ack_error = true});
  for (int i = 0; i < 6; ++i)
    bit({.field = Field::kErrFlag, .transmitter = true, .passive_flag = true});
  bit({.field = Field::kWait, .transmitter = true, .seen = false, .after_flag = 1});
  bit({.field = Field::kErrFlag, .transmitter = true, .seen = false, .passive_flag = true});
  EXPECT_EQ(fault_->tec_o, 128);
}

// FC-09: success of a transmitter, not below zero; FC-01: REC untouched.
TEST_F(CanFault, SuccessOfATransmitterTakesOneOff) {
  const Bit success{.field = Field::kEof, .transmitter = true, .last = true};
  expect_change(success, -1, 0);
  expect_change(success, -1, 0, 128);
  expect_change(success, 0, 0, 0);
  expect_change({.field = Field::kEof, .transmitter = true}, 0, 0);
  expect_change({.field = Field::kEof, .last = true}, 0, 0);
}

// FC-10, FC-12, PF-50: an acknowledged reception counts in the ACK slot; from above 127 to
// 119..127.
TEST_F(CanFault, SuccessOfAReceiverTakesOneOffInTheAckSlot) {
  const Bit success{.field = Field::kAck, .seen = false, .sent = false};
  expect_change(success, 0, -1);
  expect_change(success, 0, -1, 40, 1);
  expect_change(success, 0, 0, 40, 0);
  expect_change({.field = Field::kAck, .seen = false, .sent = true}, 0, 0);
  for (const unsigned rec : {128u, 129u, 200u, 255u}) {
    preset(0, rec);
    EXPECT_TRUE(fault_->passive_o);
    bit(success);
    EXPECT_GE(fault_->rec_o, 119);
    EXPECT_LE(fault_->rec_o, 127);
    EXPECT_FALSE(fault_->passive_o);
  }
}

// FC-11, FC-12, PF-46: passive from 128 on, active at 127, by either counter.
TEST_F(CanFault, PassiveFrom128On) {
  const struct {
    unsigned tec, rec;
    bool passive;
  } kCases[] = {{127, 127, false}, {128, 0, true}, {0, 128, true}, {255, 0, true}, {0, 0, false}};
  for (const auto &c : kCases) {
    preset(c.tec, c.rec);
    EXPECT_EQ(fault_->passive_o != 0, c.passive) << c.tec << " " << c.rec;
  }
}

// FC-14: REC holds above 127 and never wraps.
TEST_F(CanFault, ReceiveCounterNeverWraps) {
  preset(0, 126);
  for (int i = 0; i < 300; ++i) {
    bit({.field = Field::kErrFlag, .error = true, .sent = false});
    EXPECT_GE(fault_->rec_o, 128);
    EXPECT_FALSE(fault_->boff_o);
  }
}

// FC-13, PF-44: 248 -> 247 -> 255 is passive; 256 is bus-off, reported once.
TEST_F(CanFault, BusOffAt256AndNotBefore) {
  preset(248, 0);
  bit({.field = Field::kEof, .transmitter = true, .last = true});
  EXPECT_EQ(fault_->tec_o, 247);
  bit({.transmitter = true, .error = true});
  EXPECT_EQ(fault_->tec_o, 255);
  EXPECT_TRUE(fault_->passive_o);
  EXPECT_FALSE(fault_->boff_o);
  bit({.transmitter = true, .error = true});
  EXPECT_TRUE(fault_->boff_o);
  EXPECT_FALSE(fault_->passive_o);
  EXPECT_EQ(fault_->tec_o, 256) << "bus-off, no sequence counted yet";
}

/// Counters in bus-off, with some REC that must not move.
class CanFaultBusOff : public CanFault {
 protected:
  void SetUp() override {
    CanFault::SetUp();
    preset(255, 5);
  }
  void enter(bool wait_for_host) {
    fault_->boff_rec_i = wait_for_host;
    bit({.transmitter = true, .error = true});
    ASSERT_TRUE(fault_->boff_o);
  }
  /// Eleven recessive bits; true if the last of them would complete the recovery.
  bool sequence() {
    for (int i = 0; i < 10; ++i) bit({.field = Field::kBusOff});
    fault_->ends_i = 1;
    fault_.settle();
    const bool end = fault_->boff_end_o != 0;
    bit({.field = Field::kBusOff, .last = true, .free = end});
    return end;
  }
};

// BO-02, BO-05, BO-06, FC-21: 128 sequences, then everything is zero; REC does not move before.
TEST_F(CanFaultBusOff, RecoversAfter128Sequences) {
  enter(false);
  for (unsigned n = 1; n < 128; ++n) {
    ASSERT_FALSE(sequence()) << n;
    ASSERT_EQ(fault_->tec_o, 256 + n);
    ASSERT_EQ(fault_->rec_o, 5);
  }
  EXPECT_TRUE(sequence());
  EXPECT_FALSE(fault_->boff_o);
  EXPECT_EQ(fault_->tec_o, 0);
  EXPECT_EQ(fault_->rec_o, 0);
}

// BO-03: without automatic recovery the end waits for the host's leave.
TEST_F(CanFaultBusOff, WaitsForTheHostIfToldSo) {
  enter(true);
  for (int n = 0; n < 140; ++n) ASSERT_FALSE(sequence()) << n;
  fault_->boff_rec_i = 0;
  fault_.clock();
  EXPECT_TRUE(sequence());
  EXPECT_FALSE(fault_->boff_o);
}

// FC-21: soft reset leaves bus-off, only while the node is stopped.
TEST_F(CanFaultBusOff, SoftResetClearsWhileStopped) {
  enter(false);
  fault_->clear_i = 1;
  fault_.clock();
  EXPECT_TRUE(fault_->boff_o);
  fault_->run_i = 0;
  fault_.clock();
  EXPECT_FALSE(fault_->boff_o);
  EXPECT_EQ(fault_->tec_o, 0);
}

// FC-22, MO-01: listen-only freezes both counters.
TEST_F(CanFault, ListenOnlyCountsNothing) {
  fault_->lom_i = 1;
  expect_change({.error = true}, 0, 0);
  expect_change({.field = Field::kWait, .seen = false, .after_flag = 1}, 0, 0);
  expect_change({.field = Field::kAck, .seen = false, .sent = false}, 0, 0);
}

// FC-21: what was decided when a hard reset came is not counted, neither then nor later.
TEST_F(CanFault, HardResetForgetsWhatWasDecided) {
  for (const bool transmitter : {false, true}) {
    for (const Field field : {Field::kData, Field::kOvlFlag}) {
      preset(40, 40);
      sample({.field = field, .transmitter = transmitter, .error = true, .sent = false});
      fault_.reset();
      for (int i = 0; i < 4; ++i) fault_.clock();
      EXPECT_EQ(fault_->tec_o, 0);
      EXPECT_EQ(fault_->rec_o, 0);
    }
  }
}

// TH-02: the host's write takes effect only while the node is stopped.
TEST_F(CanFault, HostWritesOnlyWhileStopped) {
  preset(10, 20);
  fault_->we_i = 1;
  fault_->wdata_i = 0x6363;
  fault_.clock();
  EXPECT_EQ(fault_->tec_o, 10);
  EXPECT_EQ(fault_->rec_o, 20);
}

}  // namespace
}  // namespace vericansim
