// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rx_frame alone: bits of a frame go in, the frame comes out; loaded words come out as bits.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "Vcan_rx_frame.h"
#include "Vcan_rx_frame___024root.h"
#include "model/frame_codec.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class CanRxFrame : public testing::Test {
 protected:
  void SetUp() override { rx_.reset(); }

  /// Samples one bit; `index` and `count`: its place in the field and the field's length.
  void bit(const WireBit &b, unsigned count, bool word_end = false) {
    rx_->field_i = static_cast<unsigned>(b.field);
    rx_->bit_i = static_cast<unsigned>(b.level);
    rx_->stuff_i = b.is_stuff;
    rx_->last_i = b.index + 1u == count;
    rx_->byte_end_i = b.index % 8 == 7;
    rx_->ends_i = rx_->last_i;
    rx_->word_end_i = word_end;
    rx_->judge_i = 1;
    rx_.clock();
    rx_->judge_i = 0;
    rx_->sample_i = 1;
    rx_.clock();
    rx_->sample_i = 0;
    if (rx_->byte_we_o) bytes_.push_back(rx_->byte_o);
    rx_.clock();
    EXPECT_FALSE(rx_->byte_we_o) << "a pulse of one clock";
  }

  static unsigned length(Field field, const Frame &frame) {
    switch (field) {
      case Field::kId: return 11;
      case Field::kExId: return 18;
      case Field::kDlc: return 4;
      case Field::kData: return frame.payload_size() * 8;
      case Field::kCrc: return 15;
      default: return 1;
    }
  }

  void receive(const Frame &frame, const EncodeOptions &options = {}) {
    bytes_.clear();
    for (const WireBit &b : encode_frame(frame, options).bits) {
      if (b.field == Field::kCrcDel) break;
      bit(b, length(b.field, frame));
    }
  }

  void expect_frame(const Frame &frame) {
    EXPECT_EQ(rx_->ide_o, frame.extended);
    EXPECT_EQ(rx_->rtr_o, frame.remote);
    EXPECT_EQ(rx_->dlc_o, frame.dlc);
    EXPECT_EQ(bytes_, std::vector<std::uint8_t>(frame.data.begin(),
                                                frame.data.begin() + frame.payload_size()));
  }

  /// The bit that a sender would send next in this field; fields of one level need no register.
  bool next_bit(Field field) {
    switch (field) {
      case Field::kId: return rx_->id_bit_o != 0;
      case Field::kExId: return rx_->ex_id_bit_o != 0;
      case Field::kIde: return rx_->ide_o != 0;
      case Field::kExRtr: return rx_->rtr_o != 0;
      case Field::kDlc: return (rx_->dlc_o & 8) != 0;
      case Field::kData: return rx_->data_bit_o != 0;
      default: return field == Field::kRtr;  // SRR
    }
  }

  LeafModel<Vcan_rx_frame> rx_;
  std::vector<std::uint8_t> bytes_;
};

Frame random_frame(std::mt19937 &rng) {
  Frame frame{.extended = (rng() & 1) != 0, .remote = (rng() & 3) == 0};
  frame.id = static_cast<std::uint32_t>(rng()) & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
  frame.dlc = rng() & 15;
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>((rng() & 1) != 0 ? 0 : rng());
  return frame;
}

// FF-08, FF-09, FF-13, ST-09, PF-18: random frames of all formats, stuff bits in all places.
TEST_F(CanRxFrame, FrameComesOutAsItWentIn) {
  std::mt19937 rng{5};
  for (int round = 0; round < 300; ++round) {
    const Frame frame = random_frame(rng);
    receive(frame);
    expect_frame(frame);
  }
}

// FF-05, FF-13: the identifier as it stands when the header is complete; SRR as sampled.
TEST_F(CanRxFrame, IdentifierIsCompleteAtTheReservedBit) {
  std::mt19937 rng{6};
  for (int round = 0; round < 200; ++round) {
    const Frame frame = random_frame(rng);
    const Level srr = (rng() & 1) != 0 ? Level::kRecessive : Level::kDominant;
    for (const WireBit &b : encode_frame(frame, {.srr = srr}).bits) {
      if (b.field == Field::kDlc) break;
      bit(b, length(b.field, frame));
    }
    EXPECT_EQ(rx_->rx_id_o, frame.extended ? frame.id : frame.id << 18);
    EXPECT_EQ(rx_->ide_o, frame.extended);
    EXPECT_EQ(rx_->rtr_o, frame.remote);
    EXPECT_EQ(rx_->srr_o, frame.extended ? srr == Level::kRecessive : frame.remote);
  }
}

// FF-01, FF-02, FF-12: a loaded frame comes out bit by bit, data words at their moments.
TEST_F(CanRxFrame, LoadedWordsComeOutInOrder) {
  const Frame frame{.id = 0x12345678,
                    .extended = true,
                    .dlc = 8,
                    .data = {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF}};
  rx_->tx_ide_i = 1;
  rx_->tx_rtr_i = 0;
  rx_->tx_dlc_i = frame.dlc;
  rx_->tx_word_i = frame.id;
  rx_->take_i = rx_->free_i = 1;
  bit({Level::kRecessive, Field::kIdle, 0, false}, 1);
  rx_->take_i = rx_->free_i = 0;
  rx_->tx_word_i = 0x01234567;
  for (const WireBit &b : encode_frame(frame).bits) {
    if (b.field == Field::kCrc) break;
    if (!b.is_stuff) {
      const bool want = b.level == Level::kRecessive;
      EXPECT_EQ(next_bit(b.field), want) << field_name(b.field) << +b.index;
    }
    const bool word_end = b.field == Field::kData && b.index == 31;
    bit(b, length(b.field, frame), word_end);
    if (b.field == Field::kDlc && b.index == 3 && !b.is_stuff) rx_->tx_word_i = 0x89ABCDEF;
  }
}

// AR-07: at a lost arbitration the register already holds what the winner sent so far.
TEST_F(CanRxFrame, LoserHoldsTheWinnersBits) {
  for (unsigned lost = 0; lost < 11; ++lost) {
    const Frame winner{.id = 0x7FFu & ~(1u << lost), .dlc = 1, .data = {0x5A}};
    rx_->tx_ide_i = 0;
    rx_->tx_dlc_i = 15;
    rx_->tx_word_i = 0x7FFu << 18;
    rx_->take_i = rx_->free_i = 1;
    bit({Level::kRecessive, Field::kIdle, 0, false}, 1);
    rx_->take_i = rx_->free_i = 0;
    receive(winner);
    expect_frame(winner);
  }
}

}  // namespace
}  // namespace vericansim
