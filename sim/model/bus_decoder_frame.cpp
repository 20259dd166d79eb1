// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusDecoder: from SOF to EOF7.
#include <algorithm>

#include "model/bus_decoder.hpp"

namespace vericansim {
namespace {

constexpr unsigned kIdeBit = 13;  ///< destuffed bit that decides the format, SOF is 0

/// A field of the header, and the number of destuffed bits up to its end.
struct Segment {
  Field field;
  unsigned end;
};
constexpr Segment kBase[] = {{Field::kSof, 1},  {Field::kId, 12}, {Field::kRtr, 13},
                             {Field::kIde, 14}, {Field::kR0, 15}, {Field::kDlc, 19}};
constexpr Segment kExtended[] = {{Field::kSof, 1},  {Field::kId, 12},   {Field::kRtr, 13},
                                 {Field::kIde, 14}, {Field::kExId, 32}, {Field::kExRtr, 33},
                                 {Field::kR1, 34},  {Field::kR0, 35},   {Field::kDlc, 39}};

/// `width` bits of a header of `length` bits, the first of them being bit number `first`.
std::uint32_t slice(std::uint64_t header, unsigned length, unsigned first, unsigned width) {
  return static_cast<std::uint32_t>((header >> (length - first - width)) & ((1ULL << width) - 1));
}

}  // namespace

void BusDecoder::start_frame() {
  stage_ = Stage::kStuffed;
  frame_ = BusEvent{};
  frame_.start = bit_start_;
  run_ = 1;
  run_level_ = Level::kDominant;
  stuffed_bits_ = 1;
  plain_bits_ = 1;
  header_end_ = 0;
  plain_end_ = 0;
  header_ = 0;
  crc_ = 0;  // the dominant SOF leaves a zero register as it is
}

void BusDecoder::sample_stuffed() {
  const bool equal = sampled_ == run_level_;
  ++stuffed_bits_;
  if (run_ == 5) {
    run_ = equal ? 6 : 1;
    if (equal) {
      const Place place = locate(plain_bits_);
      return condition(BusEventKind::kErrorFrame, BusProblem::kStuff, place.field, place.index);
    }
  } else {
    run_ = equal ? run_ + 1 : 1;
    frame_bit(sampled_ == Level::kRecessive);
  }
  run_level_ = sampled_;
  if (plain_bits_ == plain_end_ && run_ != 5) {  // else one more stuff bit, ST-03
    frame_.stuffed_length = stuffed_bits_;
    stage_ = Stage::kTail;
    count_ = 0;
  }
}

/// One destuffed bit. The CRC sequence runs through the register too: a good one leaves it at zero.
void BusDecoder::frame_bit(bool bit) {
  const unsigned top = crc_ >> 14;
  crc_ = static_cast<std::uint16_t>((crc_ << 1) & 0x7FFF);
  if ((top != 0) != bit) crc_ ^= 0x4599;

  const unsigned number = plain_bits_++;
  if (header_end_ == 0 || number < header_end_) {
    header_ = (header_ << 1) | (bit ? 1u : 0u);
    if (number == kIdeBit) {
      frame_.frame.extended = bit;
      header_end_ = bit ? 39 : 19;
    }
    if (plain_bits_ == header_end_) finish_header();
    return;
  }
  const unsigned place = number - header_end_;
  if (place < 8 * frame_.frame.payload_size()) {
    std::uint8_t &byte = frame_.frame.data[place / 8];
    byte = static_cast<std::uint8_t>((byte << 1) | (bit ? 1u : 0u));
  }
}

void BusDecoder::finish_header() {
  Frame &f = frame_.frame;
  const auto field = [this](unsigned first, unsigned width) {
    return slice(header_, header_end_, first, width);
  };
  f.id = field(1, 11);
  if (f.extended) f.id = (f.id << 18) | field(14, 18);
  f.remote = field(f.extended ? 32 : 12, 1) != 0;
  f.dlc = static_cast<std::uint8_t>(field(header_end_ - 4, 4));
  plain_end_ = header_end_ + 8 * f.payload_size() + 15;
}

/// Place of the destuffed bit with this number.
BusDecoder::Place BusDecoder::locate(unsigned number) const {
  const bool extended = frame_.frame.extended;
  const Segment *begin = extended ? std::begin(kExtended) : std::begin(kBase);
  const Segment *end = extended ? std::end(kExtended) : std::end(kBase);
  unsigned start = 0;
  for (const Segment *s = begin; s != end; start = s++->end) {
    if (number < s->end) return {s->field, number - start};
  }
  const unsigned data_end = plain_end_ - 15;
  if (number < data_end) return {Field::kData, number - start};
  if (number < plain_end_) return {Field::kCrc, number - data_end};
  return {Field::kCrcDel, 0};
}

/// CRC delimiter, ACK slot, ACK delimiter, EOF1..EOF7 are count_ 0..9.
void BusDecoder::sample_tail() {
  const bool dominant = sampled_ == Level::kDominant;
  const unsigned bit = count_++;
  if (bit == 1) {
    frame_.acked = dominant;
    return;
  }
  if (bit == 9) return finish_frame(dominant);
  if (!dominant) return;
  // A flag that began earlier shows as one longer dominant run.
  if (bit == 0 && run_level_ == Level::kDominant) {
    ++run_;
  } else {
    run_ = bit == 2 && frame_.acked ? 2 : 1;
  }
  const bool crc_flag = bit == 3 && crc_ != 0;  // ED-20
  const Field field = bit == 0 ? Field::kCrcDel : bit == 2 ? Field::kAckDel : Field::kEof;
  condition(BusEventKind::kErrorFrame, crc_flag ? BusProblem::kCrc : BusProblem::kForm, field,
            field == Field::kEof ? bit - 3 : 0);
}

void BusDecoder::finish_frame(bool eof7_dominant) {
  frame_.eof7_dominant = eof7_dominant;
  if (crc_ != 0) {
    frame_.kind = BusEventKind::kBadFrame;
    frame_.problem = BusProblem::kCrc;
    frame_.field = Field::kCrc;
    frame_.index = 14;
  }
  emit(frame_, bit_start_ + config_.bit_time);
  if (eof7_dominant) {
    run_ = 1;
    return condition(BusEventKind::kOverloadFrame, BusProblem::kNone, Field::kEof, 6);
  }
  stage_ = Stage::kIntermission;
  count_ = 0;
}

}  // namespace vericansim
