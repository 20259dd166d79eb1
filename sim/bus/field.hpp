// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Field: the names of the places in the bit stream, shared by the judges and by observers of the
// core.
#pragma once

#include <cstdint>
#include <string_view>

namespace vericansim {

/// Where a bit stands. Names and encodings are those of the core's trace (can_pkg Fld*), so that a
/// trace field casts to a Field.
///
/// A stuff bit belongs to the field whose bit was due when it was inserted: a stuff bit between
/// ID18 and RTR stands at kRtr, the last one between CRC0 and the CRC delimiter at kCrcDel (ST-03).
enum class Field : std::uint8_t {
  kInteg = 0,     ///< waits for eleven recessive bits (IN-01)
  kBusOff = 1,    ///< bus-off, counts 128 x 11 recessive bits (BO-02)
  kIdle = 2,      ///< bus idle (IF-12)
  kInt = 3,       ///< INT1..INT3 (IF-01)
  kSuspend = 4,   ///< suspend transmission, 8 bits (IF-08)
  kSof = 8,       ///< start of frame
  kId = 9,        ///< ID28..ID18
  kRtr = 10,      ///< RTR (base) or SRR (extended)
  kIde = 11,      ///< IDE
  kExId = 12,     ///< ID17..ID0
  kExRtr = 13,    ///< RTR (extended)
  kR1 = 16,       ///< r1 (extended only)
  kR0 = 17,       ///< r0
  kDlc = 18,      ///< DLC3..DLC0
  kData = 19,     ///< 8 bits a byte
  kCrc = 20,      ///< CRC14..CRC0
  kCrcDel = 24,   ///< CRC delimiter
  kAck = 25,      ///< ACK slot
  kAckDel = 26,   ///< ACK delimiter
  kEof = 27,      ///< EOF1..EOF7
  kErrFlag = 28,  ///< active or passive error flag (EF-01, EF-02)
  kWait = 29,     ///< after a flag: until the first recessive bit, DEL1 (EF-08)
  kDel = 30,      ///< DEL2..DEL8 of an error or overload delimiter
  kOvlFlag = 31,  ///< overload flag (OV-01)
};

/// Short name for reports and wave files, for example "CRC"; "?" for a value that names no field.
constexpr std::string_view field_name(Field field) {
  constexpr std::string_view kNames[32] = {
      "INTEGRATING", "BUS_OFF",  "IDLE",      "INT",          "SUSPEND", "?",       "?",
      "?",           "SOF",      "ID",        "RTR",          "IDE",     "EXID",    "EXRTR",
      "?",           "?",        "R1",        "R0",           "DLC",     "DATA",    "CRC",
      "?",           "?",        "?",         "CRC_DEL",      "ACK",     "ACK_DEL", "EOF",
      "ERROR_FLAG",  "DEL_WAIT", "DELIMITER", "OVERLOAD_FLAG"};
  return kNames[static_cast<std::uint8_t>(field) & 31u];
}

/// Whether a bit with `left` bits of its field behind it goes on with the field of the bit before
/// it; else the field begins there. A flag in which a bit is wrong is sent anew (EF-06).
constexpr bool goes_on(Field field, unsigned left, Field before, unsigned left_before) {
  constexpr unsigned kBehindFirst = 5;  // of the six bits of a flag
  const bool new_flag = field == Field::kErrFlag && left == kBehindFirst;
  return field == before && left <= left_before && !new_flag;
}

}  // namespace vericansim
