// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Cause: why there is an error or overload frame, as a sentence and the rule of the rule book.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "bus/node.hpp"
#include "model/bus_decoder.hpp"
#include "report/bit_track.hpp"

namespace vericansim {

/// The bit in which a node found an error, or a dominant level that asks for an overload frame.
struct Finding {
  NodeId node = 0;
  TrackedBit bit;
  std::uint8_t errors = 0;      ///< TraceError; 0: overload condition
  bool after_overload = false;  ///< in the flag or the delimiter of an overload frame
  bool passive = false;         ///< error passive when it was found (EF-05)
  bool to_bus_off = false;      ///< the error made the node bus-off
  double end = 0;               ///< ps, end of the node's delimiter; 0: not known (yet)
};

/// Kinds of causes; each has one sentence and one rule.
enum class CauseKind : std::uint8_t {
  kOwnSof,              ///< T: SOF overwritten
  kArbitrationBit,      ///< T: dominant bit of the arbitration field lost
  kArbitrationStuff,    ///< T: dominant stuff bit of the arbitration field lost
  kArbitrationStuffed,  ///< T: recessive stuff bit of the arbitration field overwritten
  kBit0,                ///< T: dominant bit behind the arbitration field lost
  kBit1,                ///< T: recessive bit behind it overwritten
  kStuffBit,            ///< T: stuff bit behind it disturbed
  kNoAck,               ///< T: ACK slot recessive
  kFormTransmitter,     ///< T: delimiter or EOF1..EOF6 dominant
  kLastEofTransmitter,  ///< T: EOF7 dominant
  kStuff,               ///< R: six equal bits
  kLastStuff,           ///< R: six equal bits at the stuff bit that follows CRC0
  kCrc,                 ///< R: wrong CRC
  kFormReceiver,        ///< R: delimiter or EOF1..EOF6 dominant
  kOwnAck,              ///< R: acknowledge overwritten
  kErrorFlag,           ///< recessive in the own active error flag
  kOverloadFlag,        ///< recessive in the own overload flag
  kErrorDelimiter,      ///< dominant in DEL2..DEL7 of an error delimiter
  kOverloadDelimiter,   ///< dominant in DEL2..DEL7 of an overload delimiter
  kOverloadEof,         ///< R: EOF7 dominant
  kOverloadInt,         ///< INT1, INT2 dominant
  kOverloadDel,         ///< DEL8 dominant
  kWireStuff,           ///< the decoder alone: six equal bits
  kWireForm,            ///< the decoder alone: dominant bit of fixed form
  kWireCrc,             ///< the decoder alone: wrong CRC
  kWireOverload,        ///< the decoder alone: overload frame
};

/// The sentence of a kind, with "{}" where the field is named, and its rule.
struct CauseRule {
  CauseKind kind;
  std::string_view rule;
  std::string_view text;
};

/// All kinds, in their order.
[[nodiscard]] std::span<const CauseRule> cause_rules();

struct Cause {
  CauseKind kind = CauseKind::kWireForm;
  std::string text;
  std::string_view rule;
};

/// Why a node began a flag. `others` are later findings of the same error or overload frame, of any
/// node: errors in a flag are told, and that one made its node bus-off; answers to the flag are
/// not.
[[nodiscard]] Cause cause_of(const Finding &finding, std::span<const Finding> others = {});
/// What the wire shows, if no node says why: an error or overload frame, or a frame with a wrong
/// CRC.
[[nodiscard]] Cause cause_of(const BusEvent &event);

/// The rule of an error that makes its node bus-off, which takes the place of the error's own.
inline constexpr std::string_view kBusOffRule = "BO-01";

}  // namespace vericansim
