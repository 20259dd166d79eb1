// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame codec: bits on the wire to a frame, with the first error and its place.
#include <algorithm>

#include "model/frame_codec.hpp"

namespace vericansim {
namespace {

/// Thrown inside this file only, to leave a parse at the offending bit.
struct Stop {};

/// Reads a frame field by field; each read names the place of its bits.
class Reader {
 public:
  explicit Reader(std::span<const Level> bits) : bits_(bits) {}

  DecodeResult run() {
    try {
      read_frame();
    } catch (const Stop &) {
      // out_ holds the error already.
    }
    return out_;
  }

 private:
  [[noreturn]] void fail(DecodeError error, std::size_t position, Field field, std::size_t index) {
    out_.error = error;
    out_.position = position;
    out_.field = field;
    out_.index = static_cast<std::uint8_t>(index);
    throw Stop{};
  }

  Level next(Field field, std::size_t index) {
    if (at_ >= bits_.size()) fail(DecodeError::kTruncated, at_, field, index);
    return bits_[at_++];
  }

  /// True if the five bits before the next one are equal, none of them before the last stuff bit's
  /// run.
  [[nodiscard]] bool stuff_due() const { return at_ - run_start_ == 5; }

  void skip_stuff_bit(Field field, std::size_t index) {
    const std::size_t position = at_;
    const Level level = next(field, index);
    if (level == bits_[position - 1]) fail(DecodeError::kStuff, position, field, index);
    run_start_ = position;
  }

  /// One bit of the stuffed region; a stuff bit before it is checked and dropped.
  bool stuffed_bit(Field field, std::size_t index) {
    if (stuff_due()) skip_stuff_bit(field, index);
    const std::size_t position = at_;
    const Level level = next(field, index);
    if (position > 0 && level != bits_[position - 1]) run_start_ = position;
    const bool value = level == Level::kRecessive;
    plain_.push_back(value ? 1 : 0);
    return value;
  }

  std::uint32_t number(Field field, std::size_t width, std::size_t first_index = 0) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < width; ++i) {
      value = (value << 1) | (stuffed_bit(field, first_index + i) ? 1u : 0u);
    }
    return value;
  }

  Level level(Field field) { return stuffed_bit(field, 0) ? Level::kRecessive : Level::kDominant; }

  void recessive(Field field, std::size_t index) {
    const std::size_t position = at_;
    if (next(field, index) == Level::kDominant) fail(DecodeError::kForm, position, field, index);
  }

  void read_frame() {
    if (stuffed_bit(Field::kSof, 0)) fail(DecodeError::kNoSof, 0, Field::kSof, 0);
    read_header();
    for (std::size_t i = 0; i < frame_.payload_size(); ++i) {
      frame_.data[i] = static_cast<std::uint8_t>(number(Field::kData, 8, 8 * i));
    }
    const std::uint16_t expected = crc15(plain_);
    out_.crc = static_cast<std::uint16_t>(number(Field::kCrc, 15));
    const std::size_t crc_end = at_ - 1;
    if (stuff_due()) skip_stuff_bit(Field::kCrcDel, 0);
    out_.stuffed_length = at_;
    recessive(Field::kCrcDel, 0);
    out_.levels.ack_slot = next(Field::kAck, 0);
    recessive(Field::kAckDel, 0);
    if (out_.crc != expected) fail(DecodeError::kCrc, crc_end, Field::kCrc, 14);
    for (std::size_t i = 0; i < 6; ++i) recessive(Field::kEof, i);
    out_.frame = frame_;
    recessive(Field::kEof, 6);
  }

  void read_header() {
    frame_.id = number(Field::kId, 11);
    const Level rtr = level(Field::kRtr);
    frame_.extended = stuffed_bit(Field::kIde, 0);
    if (frame_.extended) {
      out_.levels.srr = rtr;
      frame_.id = (frame_.id << 18) | number(Field::kExId, 18);
      frame_.remote = stuffed_bit(Field::kExRtr, 0);
      out_.levels.r1 = level(Field::kR1);
    } else {
      frame_.remote = rtr == Level::kRecessive;
    }
    out_.levels.r0 = level(Field::kR0);
    frame_.dlc = static_cast<std::uint8_t>(number(Field::kDlc, 4));
  }

  std::span<const Level> bits_;
  std::size_t at_ = 0;         ///< next bit
  std::size_t run_start_ = 0;  ///< first bit of the run of equal bits that ends before at_
  std::vector<std::uint8_t> plain_;
  Frame frame_;
  DecodeResult out_;
};

}  // namespace

DecodeResult decode_frame(std::span<const Level> bits) { return Reader(bits).run(); }

}  // namespace vericansim
