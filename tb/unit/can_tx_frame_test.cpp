// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_tx_frame alone: the level that each place of the bit stream asks for.
#include <gtest/gtest.h>

#include "Vcan_tx_frame.h"
#include "Vcan_tx_frame___024root.h"
#include "bus/field.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr Field kAllFields[] = {Field::kInteg,   Field::kBusOff, Field::kIdle,   Field::kInt,
                                Field::kSuspend, Field::kSof,    Field::kId,     Field::kRtr,
                                Field::kIde,     Field::kExId,   Field::kExRtr,  Field::kR1,
                                Field::kR0,      Field::kDlc,    Field::kData,   Field::kCrc,
                                Field::kCrcDel,  Field::kAck,    Field::kAckDel, Field::kEof,
                                Field::kErrFlag, Field::kWait,   Field::kDel,    Field::kOvlFlag};

constexpr Field kStuffed[] = {Field::kSof,  Field::kId,    Field::kRtr, Field::kIde,
                              Field::kExId, Field::kExRtr, Field::kR1,  Field::kR0,
                              Field::kDlc,  Field::kData,  Field::kCrc};

class CanTxFrame : public testing::Test {
 protected:
  void SetUp() override {
    tx_.reset();
    tx_->run_i = 1;
    tx_->active_i = 1;
  }
  /// Every bit source at `level`.
  void sources(bool level) {
    tx_->id_bit_i = tx_->ex_id_bit_i = tx_->data_bit_i = tx_->crc_bit_i = level;
    tx_->ide_i = tx_->rtr_i = tx_->dlc_bit_i = level;
  }
  /// The level of a bit in this field, as the pin shows it.
  bool level(Field field) {
    tx_->field_i = static_cast<unsigned>(field);
    tx_->boundary_i = 1;
    tx_.clock();
    tx_->boundary_i = 0;
    EXPECT_TRUE(tx_->tx_o == tx_->can_tx_o || tx_->mute_i);
    return tx_->tx_o != 0;
  }
  LeafModel<Vcan_tx_frame> tx_;
};

// FF-01, FF-02, FF-04: a transmitter's frame takes each level from its source; reserved bits and
// SOF are dominant, SRR is recessive.
TEST_F(CanTxFrame, TransmitterSendsTheBitsOfItsFrame) {
  tx_->transmitter_i = 1;
  for (const bool value : {false, true}) {
    sources(value);
    for (const Field field : {Field::kId, Field::kRtr, Field::kIde, Field::kExId, Field::kExRtr,
                              Field::kDlc, Field::kData, Field::kCrc}) {
      EXPECT_EQ(level(field), value) << field_name(field);
    }
    for (const Field field : {Field::kSof, Field::kR1, Field::kR0})
      EXPECT_FALSE(level(field)) << field_name(field);
    for (const Field field : {Field::kCrcDel, Field::kAckDel, Field::kEof})
      EXPECT_TRUE(level(field)) << field_name(field);
  }
  sources(false);
  tx_->ide_i = 1;
  EXPECT_TRUE(level(Field::kRtr)) << "SRR of an extended data frame";
  EXPECT_FALSE(level(Field::kExRtr)) << "RTR of an extended data frame";
}

// ST-01, ST-03: a stuff bit is the complement of the bit before it, the last one included.
TEST_F(CanTxFrame, StuffBitIsTheComplement) {
  tx_->transmitter_i = 1;
  tx_->stuff_i = 1;
  for (const bool before : {false, true}) {
    tx_->prev_i = before;
    sources(before);
    for (const Field field : kStuffed) EXPECT_EQ(level(field), !before) << field_name(field);
    EXPECT_EQ(level(Field::kCrcDel), !before);
  }
}

// RO-02, AR-02: who does not transmit sends nothing of a frame, whatever the sources say.
TEST_F(CanTxFrame, ReceiverSendsNothingOfAFrame) {
  sources(false);
  for (const bool stuff : {false, true}) {
    tx_->stuff_i = stuff;
    tx_->prev_i = 1;
    for (const Field field : kStuffed) EXPECT_TRUE(level(field)) << field_name(field);
    EXPECT_TRUE(level(Field::kCrcDel));
  }
}

// AK-01, AK-02, EF-01, EF-02, OV-01: the dominant levels besides a frame's.
TEST_F(CanTxFrame, AcknowledgeAndFlags) {
  for (const bool transmitter : {false, true}) {
    tx_->transmitter_i = transmitter;
    tx_->ack_i = 1;
    EXPECT_FALSE(level(Field::kAck));
    tx_->ack_i = 0;
    EXPECT_TRUE(level(Field::kAck));
    tx_->passive_flag_i = 0;
    EXPECT_FALSE(level(Field::kErrFlag));
    tx_->passive_flag_i = 1;
    EXPECT_TRUE(level(Field::kErrFlag));
    EXPECT_FALSE(level(Field::kOvlFlag)) << "dominant from passive nodes too";
  }
}

// IF-17, AK-05, EF-08, BO-01: everywhere else the level is recessive.
TEST_F(CanTxFrame, RecessiveEverywhereElse) {
  sources(false);
  tx_->ack_i = 1;
  for (const bool transmitter : {false, true}) {
    tx_->transmitter_i = transmitter;
    for (const Field field : kAllFields) {
      const bool frame = field >= Field::kSof && field <= Field::kCrc;
      if (frame || field == Field::kAck || field == Field::kErrFlag || field == Field::kOvlFlag) {
        continue;
      }
      EXPECT_TRUE(level(field)) << field_name(field);
    }
  }
}

// BT-05: the level changes at the boundary of a bit and nowhere else.
TEST_F(CanTxFrame, LevelHoldsForTheWholeBit) {
  EXPECT_FALSE(level(Field::kOvlFlag));
  tx_->field_i = static_cast<unsigned>(Field::kIdle);
  for (int i = 0; i < 20; ++i) {
    tx_.clock();
    EXPECT_FALSE(tx_->can_tx_o);
  }
  EXPECT_TRUE(level(Field::kIdle));
}

// MO-01, MO-04: muted, the node takes its own level for sent, but the pin stays recessive.
TEST_F(CanTxFrame, MutedPinStaysRecessive) {
  tx_->mute_i = 1;
  EXPECT_FALSE(level(Field::kOvlFlag));
  EXPECT_TRUE(tx_->can_tx_o);
}

// MO-13, IF-17: a stopped node sends recessive from the next bit on; reset does it at once.
TEST_F(CanTxFrame, StoppedNodeSendsRecessive) {
  EXPECT_FALSE(level(Field::kOvlFlag));
  tx_->run_i = 0;
  EXPECT_FALSE(tx_->can_tx_o);
  EXPECT_TRUE(level(Field::kOvlFlag));
  tx_->run_i = 1;
  EXPECT_FALSE(level(Field::kOvlFlag));
  tx_->rst_ni = 0;
  tx_.settle();
  EXPECT_TRUE(tx_->can_tx_o);
}

// MO-13, TH-06: an engine that stands has no bit boundaries; a level that an upset flip-flop left
// there must not stay.
TEST_F(CanTxFrame, EngineThatStandsSendsRecessiveWithoutABoundary) {
  ASSERT_FALSE(level(Field::kOvlFlag));
  tx_->active_i = 0;
  tx_.clock();
  EXPECT_TRUE(tx_->tx_o);
  EXPECT_TRUE(tx_->can_tx_o);
}

}  // namespace
}  // namespace vericansim
