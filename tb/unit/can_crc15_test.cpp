// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_crc15 alone: against the published check value and vectors, and long division.
#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

#include "Vcan_crc15.h"
#include "Vcan_crc15___024root.h"
#include "bus/field.hpp"
#include "model/frame_codec.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class CanCrc15 : public testing::Test {
 protected:
  void SetUp() override { crc_.reset(); }
  void bit(unsigned level, Field field, bool stuff = false) {
    crc_->bit_i = level;
    crc_->field_i = static_cast<unsigned>(field);
    crc_->stuff_i = stuff;
    crc_->sample_i = 1;
    crc_.clock();
    crc_->sample_i = 0;
    crc_.clock();
  }
  /// The CRC as it would be sent, received right or with one bit inverted (0..14; -1: none).
  unsigned shift_out(int inverted = -1) {
    unsigned value = 0;
    for (int i = 14; i >= 0; --i) {
      const unsigned out = crc_->crc_bit_o;
      value = (value << 1) | out;
      bit(i == inverted ? !out : out, Field::kCrc);
    }
    return value;
  }
  LeafModel<Vcan_crc15> crc_;
};

// CR-01: check value of the catalogues.
TEST_F(CanCrc15, CheckValueOfTheDigits) {
  bit(1, Field::kIdle);
  for (const char c : std::string_view{"123456789"}) {
    for (int i = 7; i >= 0; --i) bit((static_cast<unsigned>(c) >> i) & 1, Field::kData);
  }
  EXPECT_EQ(shift_out(), 0x059Eu);
  EXPECT_FALSE(crc_->mismatch_o);
}

// CR-01, CR-02, GV-1, GV-2, GV-3, GV-4, GV-5, GV-6, GV-8, GV-9: stuff bits are left out.
TEST_F(CanCrc15, GoldenVectors) {
  const struct {
    Frame frame;
    unsigned crc;
  } kVectors[] = {
      {{.id = 0x123, .dlc = 1, .data = {0x55}}, 0x2363},
      {{.id = 0x555}, 0x674C},
      {{.id = 0x009}, 0x7C20},
      {{.id = 0x017}, 0x521F},
      {{.id = 0x123, .remote = true, .dlc = 5}, 0x06CB},
      {{.id = 0, .extended = true, .remote = true}, 0x35D5},
      {{.id = 0x2AA, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}}, 0x248C},
      {{.id = 0x2AA, .dlc = 15, .data = {1, 2, 3, 4, 5, 6, 7, 8}}, 0x318F},
      {{.id = 0x000, .dlc = 8}, 0x145B},
  };
  for (const auto &vector : kVectors) {
    bit(1, Field::kInt);  // between frames the register is cleared (CR-05)
    for (const WireBit &b : encode_frame(vector.frame).bits) {
      if (b.field == Field::kCrc) break;
      bit(static_cast<unsigned>(b.level), b.field, b.is_stuff);
    }
    EXPECT_EQ(shift_out(), vector.crc) << vector.frame.id;
  }
}

// CR-02: random bits against long division.
TEST_F(CanCrc15, AgreesWithLongDivision) {
  std::mt19937 rng{7};
  for (unsigned round = 0; round < 200; ++round) {
    bit(1, Field::kIdle);
    std::vector<std::uint8_t> bits;
    for (unsigned i = 0; i < 20 + round % 64; ++i) {
      bits.push_back(rng() & 1);
      bit(bits.back(), Field::kData);
    }
    ASSERT_EQ(shift_out(), crc15(bits));
  }
}

// CR-03: every single inverted CRC bit is a mismatch, which stays until the frame is over (CR-05).
TEST_F(CanCrc15, EachInvertedCrcBitIsAMismatch) {
  for (int inverted = 0; inverted < 15; ++inverted) {
    bit(1, Field::kIdle);
    for (int i = 0; i < 30; ++i) bit((i * 7 / 3) & 1, Field::kId);
    shift_out(inverted);
    EXPECT_TRUE(crc_->mismatch_o) << inverted;
    bit(1, Field::kAckDel);
    EXPECT_TRUE(crc_->mismatch_o);
    bit(1, Field::kInt);
    EXPECT_FALSE(crc_->mismatch_o);
  }
}

// CR-05, BO-07: whatever an aborted frame left, the next one starts from zero.
TEST_F(CanCrc15, StartsFromZeroAfterAnAbortedFrame) {
  for (int i = 0; i < 50; ++i) bit(i & 1, Field::kData);
  for (int i = 0; i < 6; ++i) bit(0, Field::kErrFlag);
  bit(1, Field::kInt);
  EXPECT_EQ(shift_out(), 0u);
}

}  // namespace
}  // namespace vericansim
