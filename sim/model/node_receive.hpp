// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FrameParser: the stuffed part of a frame, SOF..CRC0, followed one sampled bit at a time (rule
// book 1-3).
#pragma once

#include <cstdint>

#include "bus/field.hpp"
#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// Place of a bit in the bit stream.
struct BitPlace {
  Field field = Field::kInteg;
  std::uint8_t index = 0;  ///< within the field, from 0
  bool is_stuff = false;
};

/// Destuffing, CRC and field sequence of one frame, for both roles: a transmitter parses what it
/// sends.
class FrameParser {
 public:
  /// A frame begins; its dominant SOF was just sampled, sent by whomever (ST-02, ST-07).
  void start();

  /// Takes the next bit. False: it is the sixth equal one (ST-06); nothing changes then.
  bool take(Level level);

  /// True if the coming bit is a stuff bit.
  [[nodiscard]] bool stuff_due() const { return run_ == 5; }
  /// Level of the run that ends with the last bit taken.
  [[nodiscard]] Level run_level() const { return run_level_; }
  /// Place of the coming bit: kId..kCrc, then kCrcDel.
  [[nodiscard]] BitPlace place() const { return {field_, index_, stuff_due()}; }
  /// CRC of the bits taken so far, CRC field excluded (CR-02).
  [[nodiscard]] std::uint16_t crc() const { return crc_; }
  /// Meaningful from kCrcDel on (CR-03).
  [[nodiscard]] bool crc_matches() const { return crc_ == received_crc_; }
  [[nodiscard]] const Frame &frame() const { return frame_; }

 private:
  void take_field_bit(Level level);
  void take_identifier_bit(bool bit);
  void take_length_bit(bool bit);
  void take_data_bit(bool bit);
  void go(Field field);

  Frame frame_;
  Field field_ = Field::kId;
  std::uint8_t index_ = 0;
  unsigned run_ = 0;  ///< equal bits up to the last one, 1..5
  Level run_level_ = Level::kDominant;
  bool substitute_ = false;  ///< bit after ID18: RTR or SRR, known at IDE
  std::uint16_t crc_ = 0;
  std::uint16_t received_crc_ = 0;
};

}  // namespace vericansim
