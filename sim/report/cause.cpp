// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Cause: see cause.hpp. The ids are those of the rule book (tb/plan.yaml has their titles).
#include "report/cause.hpp"

#include <array>

namespace vericansim {
namespace {

constexpr std::array kRules = {
    CauseRule{CauseKind::kOwnSof, "ED-13", "the transmitter sent its SOF and saw recessive"},
    CauseRule{CauseKind::kArbitrationBit, "AR-03",
              "the transmitter sent dominant and saw recessive in {}"},
    CauseRule{CauseKind::kArbitrationStuff, "AR-05",
              "the transmitter sent a dominant stuff bit and saw recessive in {}"},
    CauseRule{CauseKind::kArbitrationStuffed, "AR-04",
              "the transmitter sent a recessive stuff bit and saw dominant in {}: an error, not a "
              "lost arbitration"},
    CauseRule{CauseKind::kBit0, "ED-01", "the transmitter sent dominant and saw recessive in {}"},
    CauseRule{CauseKind::kBit1, "ED-01", "the transmitter sent recessive and saw dominant in {}"},
    CauseRule{CauseKind::kStuffBit, "ED-08",
              "the transmitter saw the complement of its stuff bit in {}"},
    CauseRule{CauseKind::kNoAck, "AK-03", "no node acknowledged the frame"},
    CauseRule{CauseKind::kFormTransmitter, "ED-09", "the transmitter saw dominant in {}"},
    CauseRule{CauseKind::kLastEofTransmitter, "ED-10",
              "the transmitter saw dominant in the last bit of the end of frame"},
    CauseRule{CauseKind::kStuff, "ST-06", "a receiver saw six equal bits in {}"},
    CauseRule{CauseKind::kLastStuff, "ST-04",
              "a receiver saw six equal bits at the stuff bit behind the CRC"},
    CauseRule{CauseKind::kCrc, "ED-14", "a receiver calculated another CRC than it received"},
    CauseRule{CauseKind::kFormReceiver, "ED-09", "a receiver saw dominant in {}"},
    CauseRule{CauseKind::kOwnAck, "ED-07", "a receiver sent its acknowledge and saw recessive"},
    CauseRule{CauseKind::kErrorFlag, "EF-06",
              "a node saw recessive in its own error flag and begins another"},
    CauseRule{CauseKind::kOverloadFlag, "ED-21", "a node saw recessive in its own overload flag"},
    CauseRule{CauseKind::kErrorDelimiter, "EF-09", "a node saw dominant within an error delimiter"},
    CauseRule{CauseKind::kOverloadDelimiter, "ED-21",
              "a node saw dominant within an overload delimiter"},
    CauseRule{CauseKind::kOverloadEof, "ED-11",
              "a receiver saw dominant in the last bit of the end of frame: the frame is valid, an "
              "overload frame follows"},
    CauseRule{CauseKind::kOverloadInt, "IF-04",
              "a node saw dominant in the first two bits of the intermission"},
    CauseRule{CauseKind::kOverloadDel, "ED-12",
              "a node saw dominant in the last bit of a delimiter"},
    CauseRule{CauseKind::kWireStuff, "ST-06", "six equal bits on the wire in {}"},
    CauseRule{CauseKind::kWireForm, "ED-09", "a dominant level on the wire in {}"},
    CauseRule{CauseKind::kWireCrc, "CR-03", "the CRC on the wire is wrong"},
    CauseRule{CauseKind::kWireOverload, "OV-03", "an overload condition on the wire in {}"},
};

constexpr std::uint8_t kBitErrors = kErrBit0 | kErrBit1;

std::string_view field_words(Field field) {
  switch (field) {
    case Field::kSof: return "the SOF";
    case Field::kId: return "the identifier";
    case Field::kRtr: return "the RTR or SRR bit";
    case Field::kIde: return "the IDE bit";
    case Field::kExId: return "the identifier extension";
    case Field::kExRtr: return "the RTR bit";
    case Field::kR1: return "the reserved bit r1";
    case Field::kR0: return "the reserved bit r0";
    case Field::kDlc: return "the data length code";
    case Field::kData: return "the data field";
    case Field::kCrc: return "the CRC sequence";
    case Field::kCrcDel: return "the CRC delimiter";
    case Field::kAck: return "the ACK slot";
    case Field::kAckDel: return "the ACK delimiter";
    case Field::kEof: return "the end of frame";
    case Field::kInt: return "the intermission";
    case Field::kDel: return "a delimiter";
    default: return "a flag";
  }
}

// Base IDE is outside (AR-01): a node that sends it dominant has a base frame.
bool in_arbitration(const TrackedBit &bit) {
  if (bit.field == Field::kIde) return bit.stuff || bit.tx == Level::kRecessive;
  return bit.field >= Field::kId && bit.field <= Field::kExRtr;
}

CauseKind transmitter_kind(const Finding &finding) {
  const TrackedBit &bit = finding.bit;
  const bool dominant = bit.tx == Level::kDominant;
  if (bit.field == Field::kSof) return CauseKind::kOwnSof;
  if (in_arbitration(bit) && bit.stuff) {
    if ((finding.errors & kBitErrors) == 0) return CauseKind::kArbitrationStuffed;
    return dominant ? CauseKind::kArbitrationStuff : CauseKind::kStuffBit;
  }
  if (in_arbitration(bit)) return CauseKind::kArbitrationBit;
  if (bit.stuff) return CauseKind::kStuffBit;
  if (bit.field == Field::kAck) return CauseKind::kNoAck;
  if (bit.field == Field::kEof && bit.index == 6) return CauseKind::kLastEofTransmitter;
  if (bit.field >= Field::kCrcDel) return CauseKind::kFormTransmitter;
  return dominant ? CauseKind::kBit0 : CauseKind::kBit1;
}

CauseKind receiver_kind(const Finding &finding) {
  const TrackedBit &bit = finding.bit;
  if ((finding.errors & kErrCrc) != 0) return CauseKind::kCrc;
  if (bit.field == Field::kAck) return CauseKind::kOwnAck;
  if (bit.field == Field::kCrcDel && bit.stuff) return CauseKind::kLastStuff;
  return bit.field >= Field::kCrcDel ? CauseKind::kFormReceiver : CauseKind::kStuff;
}

CauseKind overload_kind(Field field) {
  if (field == Field::kEof) return CauseKind::kOverloadEof;
  return field == Field::kDel ? CauseKind::kOverloadDel : CauseKind::kOverloadInt;
}

CauseKind kind_of(const Finding &finding) {
  const Field field = finding.bit.field;
  if (finding.errors == 0) return overload_kind(field);
  if (field == Field::kErrFlag) return CauseKind::kErrorFlag;
  if (field == Field::kOvlFlag) return CauseKind::kOverloadFlag;
  if (field == Field::kDel)
    return finding.after_overload ? CauseKind::kOverloadDelimiter : CauseKind::kErrorDelimiter;
  return finding.bit.transmitter ? transmitter_kind(finding) : receiver_kind(finding);
}

CauseKind kind_of(const BusEvent &event) {
  if (event.kind == BusEventKind::kOverloadFrame) return CauseKind::kWireOverload;
  if (event.problem == BusProblem::kStuff) return CauseKind::kWireStuff;
  return event.problem == BusProblem::kCrc ? CauseKind::kWireCrc : CauseKind::kWireForm;
}

Cause fill(CauseKind kind, Field field) {
  const CauseRule &rule = kRules[static_cast<std::size_t>(kind)];
  Cause cause{kind, std::string{rule.text}, rule.rule};
  const std::size_t place = cause.text.find("{}");
  if (place != std::string::npos) cause.text.replace(place, 2, field_words(field));
  return cause;
}

}  // namespace

std::span<const CauseRule> cause_rules() { return kRules; }

Cause cause_of(const Finding &finding, std::span<const Finding> others) {
  Cause cause = fill(kind_of(finding), finding.bit.field);
  if (finding.passive && finding.errors != 0)
    cause.text += "; it is error passive, its flag recessive";
  bool to_bus_off = finding.to_bus_off;
  CauseKind told = cause.kind;
  for (const Finding &other : others) {
    to_bus_off = to_bus_off || other.to_bus_off;
    const CauseKind kind = kind_of(other);
    const bool in_flag = kind == CauseKind::kErrorFlag || kind == CauseKind::kOverloadFlag;
    if (!in_flag || kind == told) continue;
    told = kind;
    const CauseRule &rule = kRules[static_cast<std::size_t>(kind)];
    cause.text += "; then " + std::string{rule.text} + " (" + std::string{rule.rule} + ")";
  }
  if (to_bus_off) {
    cause.text += "; its TEC reaches 256: bus-off";
    cause.rule = kBusOffRule;
  }
  return cause;
}

Cause cause_of(const BusEvent &event) {
  Cause cause = fill(kind_of(event), event.field);
  cause.text += ", as no node reported";
  return cause;
}

}  // namespace vericansim
