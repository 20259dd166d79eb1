// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FrameParser: destuffing, CRC and field sequence of the node model.
#include "model/node_receive.hpp"

namespace vericansim {
namespace {

/// One step of the shift register of CR-01.
std::uint16_t crc_step(std::uint16_t crc, bool bit) {
  const bool feedback = bit != ((crc & 0x4000u) != 0);
  crc = static_cast<std::uint16_t>((crc << 1) & 0x7FFFu);
  return feedback ? static_cast<std::uint16_t>(crc ^ 0x4599u) : crc;
}

}  // namespace

void FrameParser::start() {
  frame_ = Frame{};
  field_ = Field::kId;
  index_ = 0;
  run_ = 1;
  run_level_ = Level::kDominant;
  crc_ = crc_step(0, false);
  received_crc_ = 0;
}

bool FrameParser::take(Level level) {
  const bool stuff = stuff_due();
  if (stuff && level == run_level_) return false;
  run_ = level == run_level_ ? run_ + 1 : 1;
  run_level_ = level;
  if (!stuff) take_field_bit(level);
  return true;
}

void FrameParser::go(Field field) {
  field_ = field;
  index_ = 0;
}

void FrameParser::take_field_bit(Level level) {
  const bool bit = level == Level::kRecessive;
  if (field_ != Field::kCrc) crc_ = crc_step(crc_, bit);
  switch (field_) {
    case Field::kId:
    case Field::kExId: take_identifier_bit(bit); break;
    case Field::kRtr:
      substitute_ = bit;
      go(Field::kIde);
      break;
    case Field::kIde:  // FF-13: the sampled IDE alone decides the format.
      frame_.extended = bit;
      frame_.remote = !bit && substitute_;
      go(bit ? Field::kExId : Field::kR0);
      break;
    case Field::kExRtr:
      frame_.remote = bit;
      go(Field::kR1);
      break;
    case Field::kR1:  // FF-05: either level.
      go(Field::kR0);
      break;
    case Field::kR0: go(Field::kDlc); break;
    case Field::kDlc: take_length_bit(bit); break;
    case Field::kData: take_data_bit(bit); break;
    case Field::kCrc:
      received_crc_ = static_cast<std::uint16_t>((received_crc_ << 1) | (bit ? 1u : 0u));
      if (++index_ == 15) go(Field::kCrcDel);
      break;
    default:  // kCrcDel is taken only as a stuff bit; NodeModel judges the delimiter itself.
      break;
  }
}

void FrameParser::take_identifier_bit(bool bit) {
  frame_.id = (frame_.id << 1) | (bit ? 1u : 0u);
  ++index_;
  if (field_ == Field::kId && index_ == 11) go(Field::kRtr);
  if (field_ == Field::kExId && index_ == 18) go(Field::kExRtr);
}

void FrameParser::take_length_bit(bool bit) {
  frame_.dlc = static_cast<std::uint8_t>((frame_.dlc << 1) | (bit ? 1u : 0u));
  if (++index_ == 4) go(frame_.payload_size() > 0 ? Field::kData : Field::kCrc);
}

void FrameParser::take_data_bit(bool bit) {
  std::uint8_t &byte = frame_.data[index_ / 8];
  byte = static_cast<std::uint8_t>((byte << 1) | (bit ? 1u : 0u));
  if (++index_ == 8 * frame_.payload_size()) go(Field::kCrc);
}

}  // namespace vericansim
