// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FieldBits: which bits a field of the bit stream can have, for places of faults.
#pragma once

#include "bus/field.hpp"

namespace vericansim {

/// Bits of a field. Those before the current one and those after it add up to one less than its
/// length, if that is fixed.
struct FieldBits {
  static constexpr unsigned kNoEnd = 127;
  unsigned most_before = 0;  ///< kNoEnd: as many as the field lasts
  unsigned most_after = 0;
  bool fixed = true;          ///< always of the same length
  bool stuffed = false;       ///< may have stuff bits
  unsigned before_stuff = 0;  ///< bits of it before the first that a stuff bit can delay
};

/// The bits of `field`. Fields that last as long as the bus makes them count what is left anew
/// after each disturbance (IN-01, EF-03, BO-02), so that only one side has a limit.
constexpr FieldBits field_bits(Field field) {
  switch (field) {
    case Field::kInteg:
    case Field::kBusOff: return {FieldBits::kNoEnd, 10, false};
    case Field::kIdle: return {FieldBits::kNoEnd, 0, false};
    case Field::kErrFlag: return {FieldBits::kNoEnd, 5, false};
    case Field::kWait: return {7, 39, false};  // dominant bits after a flag are counted by eights
    case Field::kInt: return {2, 2};
    case Field::kSuspend: return {7, 7};
    case Field::kEof:
    case Field::kDel: return {6, 6};
    case Field::kOvlFlag: return {5, 5};
    case Field::kId: return {10, 10, true, true, 4};  // SOF is the first of five equal bits
    case Field::kExId: return {17, 17, true, true};
    case Field::kDlc: return {3, 3, true, true};
    case Field::kData: return {63, 63, false, true};
    case Field::kCrc: return {14, 14, true, true};
    case Field::kSof:
    case Field::kAck:
    case Field::kAckDel: return {0, 0};
    default: return {0, 0, true, true};  // one bit; that behind CRC0 stands at CRC_DEL (ST-03)
  }
}

}  // namespace vericansim
