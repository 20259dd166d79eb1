// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame codec: a whole frame to the bits on the wire and back, as tables of bits (rule book 1, 2,
// 3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/field.hpp"
#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// One bit of a frame on the wire.
struct WireBit {
  Level level = Level::kRecessive;
  Field field = Field::kSof;
  std::uint8_t index = 0;  ///< place in the field, counted from 0 in the order on the wire
  bool is_stuff =
      false;  ///< inserted bit; field and index are those of the bit that was due (ST-01)
};

/// Levels that a Frame leaves open. A CAN 2.0 transmitter uses the defaults (FF-04); receivers must
/// accept all others too (FF-05).
struct EncodeOptions {
  Level r0 = Level::kDominant;
  Level r1 = Level::kDominant;    ///< extended frames only
  Level srr = Level::kRecessive;  ///< extended frames only
  Level ack_slot =
      Level::kDominant;  ///< the slot as seen on an acknowledged bus; transmitters send r
};

/// A frame from SOF to EOF7.
struct EncodedFrame {
  std::vector<WireBit> bits;
  std::size_t stuffed_length = 0;  ///< bits SOF..CRC0 with all stuff bits, the last one included
  std::size_t stuff_count = 0;
  std::uint16_t crc = 0;
};

/// CRC15 of a list of bits by long division with 0xC599, first bit first (CR-01). `bits` are 0
/// or 1.
[[nodiscard]] std::uint16_t crc15(std::span<const std::uint8_t> bits);

/// Bits of `frame` as they travel. Throws std::invalid_argument if the identifier does not fit its
/// format or dlc > 15.
[[nodiscard]] EncodedFrame encode_frame(const Frame &frame, const EncodeOptions &options = {});

/// What decode_frame() found wrong, at DecodeResult::position.
enum class DecodeError : std::uint8_t {
  kNone,
  kTruncated,  ///< the bits end before EOF7
  kNoSof,      ///< first bit is recessive
  kStuff,      ///< sixth equal bit (ST-06)
  kCrc,        ///< CRC differs; position is CRC0
  kForm,       ///< dominant delimiter or EOF bit (ED-09)
};

/// Result of decode_frame(). `frame` is set when the frame is valid for a receiver: no error up to
/// EOF6 (VA-01); a dominant EOF7 then leaves `error` at kForm but the frame set.
struct DecodeResult {
  std::optional<Frame> frame;
  DecodeError error = DecodeError::kNone;
  std::size_t position = 0;   ///< index of the offending bit in the input
  Field field = Field::kSof;  ///< its place
  std::uint8_t index = 0;
  EncodeOptions levels;            ///< reserved bits, SRR and ACK slot as received
  std::size_t stuffed_length = 0;  ///< bits SOF..CRC0 with all stuff bits
  std::uint16_t crc = 0;           ///< as received
};

/// Frame of the bits SOF..EOF7 (further bits are ignored).
[[nodiscard]] DecodeResult decode_frame(std::span<const Level> bits);

/// Levels of an encoded frame, for decode_frame() or a driver.
[[nodiscard]] std::vector<Level> levels_of(std::span<const WireBit> bits);

/// "0" for dominant, "1" for recessive; and back. Throws std::invalid_argument on another
/// character.
[[nodiscard]] std::string to_string(std::span<const Level> bits);
[[nodiscard]] std::vector<Level> levels_from_string(std::string_view text);

}  // namespace vericansim
