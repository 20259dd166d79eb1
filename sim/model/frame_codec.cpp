// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame codec: encoding, CRC and text forms. The reverse way is in frame_decode.cpp.
#include "model/frame_codec.hpp"

#include <stdexcept>

namespace vericansim {
namespace {

/// Frame without stuff bits, SOF..last data bit, then the CRC.
class PlainBits {
 public:
  PlainBits(const Frame &frame, const EncodeOptions &options) {
    add(Field::kSof, 0, 1);
    if (frame.extended) {
      add(Field::kId, frame.id >> 18, 11);
      add(Field::kRtr, bit(options.srr), 1);
      add(Field::kIde, 1, 1);
      add(Field::kExId, frame.id & 0x3FFFF, 18);
      add(Field::kExRtr, frame.remote ? 1 : 0, 1);
      add(Field::kR1, bit(options.r1), 1);
    } else {
      add(Field::kId, frame.id, 11);
      add(Field::kRtr, frame.remote ? 1 : 0, 1);
      add(Field::kIde, 0, 1);
    }
    add(Field::kR0, bit(options.r0), 1);
    add(Field::kDlc, frame.dlc, 4);
    for (unsigned i = 0; i < frame.payload_size(); ++i) {
      add(Field::kData, frame.data[i], 8, static_cast<std::uint8_t>(8 * i));
    }
    crc_ = crc15(values());
    add(Field::kCrc, crc_, 15);
  }

  [[nodiscard]] const std::vector<WireBit> &bits() const { return bits_; }
  [[nodiscard]] std::uint16_t crc() const { return crc_; }

 private:
  static std::uint32_t bit(Level level) { return level == Level::kRecessive ? 1 : 0; }

  void add(Field field, std::uint32_t value, unsigned width, std::uint8_t first_index = 0) {
    for (unsigned i = 0; i < width; ++i) {
      const bool recessive = ((value >> (width - 1 - i)) & 1u) != 0;
      bits_.push_back({recessive ? Level::kRecessive : Level::kDominant, field,
                       static_cast<std::uint8_t>(first_index + i), false});
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> values() const {
    std::vector<std::uint8_t> out;
    out.reserve(bits_.size());
    for (const WireBit &b : bits_) out.push_back(static_cast<std::uint8_t>(bit(b.level)));
    return out;
  }

  std::vector<WireBit> bits_;
  std::uint16_t crc_ = 0;
};

/// The bits of `plain` with a complement after every five equal ones (ST-01, ST-03).
std::vector<WireBit> stuffed(const std::vector<WireBit> &plain) {
  std::vector<WireBit> out;
  out.reserve(plain.size() + plain.size() / 4 + 16);
  unsigned run = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    run = (i > 0 && out.back().level == plain[i].level) ? run + 1 : 1;
    out.push_back(plain[i]);
    if (run < 5) continue;
    const bool last = i + 1 == plain.size();
    out.push_back({!plain[i].level, last ? Field::kCrcDel : plain[i + 1].field,
                   last ? std::uint8_t{0} : plain[i + 1].index, true});
    run = 1;
  }
  return out;
}

}  // namespace

std::uint16_t crc15(std::span<const std::uint8_t> bits) {
  // x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1, highest power first.
  constexpr std::uint8_t kDivisor[16] = {1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
  std::vector<std::uint8_t> rest(bits.begin(), bits.end());
  rest.resize(bits.size() + 15, 0);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (rest[i] == 0) continue;
    for (std::size_t k = 0; k < 16; ++k) rest[i + k] ^= kDivisor[k];
  }
  std::uint16_t crc = 0;
  for (std::size_t i = bits.size(); i < rest.size(); ++i) {
    crc = static_cast<std::uint16_t>((crc << 1) | rest[i]);
  }
  return crc;
}

EncodedFrame encode_frame(const Frame &frame, const EncodeOptions &options) {
  frame.validate();
  const PlainBits plain(frame, options);
  EncodedFrame out;
  out.bits = stuffed(plain.bits());
  out.crc = plain.crc();
  out.stuffed_length = out.bits.size();
  out.stuff_count = out.bits.size() - plain.bits().size();
  out.bits.push_back({Level::kRecessive, Field::kCrcDel, 0, false});
  out.bits.push_back({options.ack_slot, Field::kAck, 0, false});
  out.bits.push_back({Level::kRecessive, Field::kAckDel, 0, false});
  for (std::uint8_t i = 0; i < 7; ++i)
    out.bits.push_back({Level::kRecessive, Field::kEof, i, false});
  return out;
}

std::vector<Level> levels_of(std::span<const WireBit> bits) {
  std::vector<Level> out;
  out.reserve(bits.size());
  for (const WireBit &b : bits) out.push_back(b.level);
  return out;
}

std::string to_string(std::span<const Level> bits) {
  std::string out;
  out.reserve(bits.size());
  for (const Level level : bits) out.push_back(level == Level::kRecessive ? '1' : '0');
  return out;
}

std::vector<Level> levels_from_string(std::string_view text) {
  std::vector<Level> out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c != '0' && c != '1') throw std::invalid_argument("levels are written as 0 and 1");
    out.push_back(c == '1' ? Level::kRecessive : Level::kDominant);
  }
  return out;
}

}  // namespace vericansim
