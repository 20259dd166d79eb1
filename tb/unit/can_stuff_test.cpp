// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_stuff alone: after five equal bits the next one is a stuff bit.
#include <gtest/gtest.h>

#include <random>

#include "Vcan_stuff.h"
#include "Vcan_stuff___024root.h"
#include "model/frame_codec.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class CanStuff : public testing::Test {
 protected:
  void SetUp() override {
    stuff_->field_i = static_cast<unsigned>(Field::kIdle);
    stuff_.reset();
  }
  /// Is this bit, in this field, a stuff bit? Then samples it.
  bool bit(unsigned level, Field field) {
    stuff_->field_i = static_cast<unsigned>(field);
    stuff_->bit_i = level;
    stuff_->sample_i = 0;
    stuff_.settle();
    const bool is_stuff = stuff_->stuff_o != 0;
    stuff_->sample_i = 1;
    stuff_.clock();
    stuff_->sample_i = 0;
    stuff_.clock();
    EXPECT_EQ(stuff_->last_o, level);
    return is_stuff;
  }
  void idle(int bits) {
    for (int i = 0; i < bits; ++i) EXPECT_FALSE(bit(1, Field::kIdle));
  }
  /// Compares the marks of a whole frame; the SOF of others is sampled in idle.
  void check(const Frame &frame, Field sof) {
    for (const WireBit &b : encode_frame(frame).bits) {
      const Field field = b.field == Field::kSof ? sof : b.field;
      ASSERT_EQ(bit(static_cast<unsigned>(b.level), field), b.is_stuff)
          << field_name(b.field) << int{b.index};
    }
  }
  LeafModel<Vcan_stuff> stuff_;
};

// ST-01, ST-02, ST-03, ST-05, ST-09, GV-3, GV-4, GV-6, GV-7, GV-9: own frames.
TEST_F(CanStuff, MarksTheStuffBitsOfTheGoldenVectors) {
  const Frame kFrames[] = {
      {.id = 0x009},
      {.id = 0x017},
      {.id = 0, .extended = true, .remote = true},
      {.id = 0x078, .dlc = 8, .data = {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}},
      {.id = 0x1FFFFFFF,
       .extended = true,
       .dlc = 8,
       .data = {255, 255, 255, 255, 255, 255, 255, 255}},
      {.id = 0, .dlc = 8}};
  for (const Frame &frame : kFrames) {
    idle(11);
    check(frame, Field::kSof);
  }
}

// ST-02, ST-07, ST-09: the SOF of others, in idle, INT3 or suspend, is the first of the run.
TEST_F(CanStuff, ForeignSofStartsTheRun) {
  std::mt19937 rng{3};
  for (const Field sof : {Field::kIdle, Field::kInt, Field::kSuspend}) {
    for (int round = 0; round < 100; ++round) {
      Frame frame{
          .id = static_cast<std::uint32_t>(rng() & rng() & 0x1FFFFFFF), .extended = true, .dlc = 8};
      for (auto &byte : frame.data) byte = static_cast<std::uint8_t>(rng() & rng() & rng());
      idle(3);
      check(frame, sof);
    }
  }
}

// ST-05: outside the frame nothing is a stuff bit, however long the run.
TEST_F(CanStuff, NoStuffBitsInFixedForm) {
  for (const Field field : {Field::kAck, Field::kAckDel, Field::kEof, Field::kErrFlag, Field::kWait,
                            Field::kDel, Field::kOvlFlag, Field::kInt}) {
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(bit(i < 10, field)) << field_name(field);
  }
}

// MO-02: recessive bits up to the last one, from SOF to the ACK delimiter.
TEST_F(CanStuff, CountsRecessiveBitsToTheAckDelimiter) {
  bit(0, Field::kIdle);
  EXPECT_EQ(stuff_->ones_o, 0u);
  for (unsigned n = 1; n <= 4; ++n) {
    bit(1, Field::kCrc);
    EXPECT_EQ(stuff_->ones_o, n);
  }
  bit(1, Field::kCrcDel);
  bit(1, Field::kAck);
  bit(1, Field::kAckDel);
  EXPECT_EQ(stuff_->ones_o, 7u);
  bit(0, Field::kEof);
  EXPECT_EQ(stuff_->ones_o, 0u);
}

// CR-05, PF-58: a run that an error cut short does not reach into the next frame.
TEST_F(CanStuff, RunOfAnAbortedFrameIsForgotten) {
  bit(0, Field::kIdle);
  for (int i = 0; i < 4; ++i) bit(0, Field::kId);
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(bit(0, Field::kErrFlag));
  bit(1, Field::kIdle);
  bit(0, Field::kIdle);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(bit(0, Field::kId));
  EXPECT_TRUE(bit(1, Field::kId));
}

// ST-01: a run that is longer than five, as an upset flip-flop can make it, does not go on until
// the counter has wrapped: the next bit is a stuff bit in any case.
TEST_F(CanStuff, RunBeyondFiveAsksForAStuffBitToo) {
  idle(3);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(bit(0, Field::kId)) << i;
  EXPECT_TRUE(bit(0, Field::kId));
  EXPECT_TRUE(bit(0, Field::kId));
  EXPECT_TRUE(bit(1, Field::kId));
  EXPECT_FALSE(bit(1, Field::kId));
}

}  // namespace
}  // namespace vericansim
