// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults and their causes: see cause_cases.hpp.
#include "report/cause_cases.hpp"

namespace vericansim {
namespace {

// Identifier 0x078: SOF and ID28..25 are five dominant bits, a recessive stuff bit and ID24..21
// five recessive ones, so stuff bits of both levels stand in it.
constexpr Frame kStuffed{.id = 0x078, .dlc = 2, .data = {0x00, 0x55}};
constexpr Frame kPlain{.id = 0x2AA, .dlc = 1, .data = {0x55}};
constexpr Frame kExtended{.id = 0x0AAAAAAA, .extended = true, .dlc = 1, .data = {0x55}};
/// The CRC ends with five dominant bits: a recessive stuff bit follows it (golden vector GV-3).
constexpr Frame kLastStuff{.id = 0x009};

constexpr Disturbance sender(Field field, unsigned index = 0, bool stuff = false) {
  return {kSenderNode, field, index, stuff, kSenderNode};
}
constexpr Disturbance receiver(Field field, unsigned index = 0, bool stuff = false) {
  return {kReceiverNode, field, index, stuff, kReceiverNode};
}

std::vector<CauseCase> transmitter_cases() {
  return {
      {"OwnSof", kPlain, {sender(Field::kSof)}, "ED-13", "sent its SOF and saw recessive"},
      {"DominantIdBit",
       kStuffed,
       {sender(Field::kId, 1)},
       "AR-03",
       "sent dominant and saw recessive in the identifier"},
      {"DominantRtr", kPlain, {sender(Field::kRtr)}, "AR-03", "in the RTR or SRR bit"},
      {"DominantExtendedId",
       kExtended,
       {sender(Field::kExId, 1)},
       "AR-03",
       "in the identifier extension"},
      {"RecessiveStuffBit",
       kStuffed,
       {sender(Field::kId, 4, true)},
       "AR-04",
       "recessive stuff bit and saw dominant in the identifier"},
      {"DominantStuffBit",
       kStuffed,
       {sender(Field::kId, 8, true)},
       "AR-05",
       "dominant stuff bit and saw recessive in the identifier"},
      {"ReservedBit",
       kPlain,
       {sender(Field::kR0)},
       "ED-01",
       "sent dominant and saw recessive in the reserved bit r0"},
      {"BaseIde",
       kPlain,
       {sender(Field::kIde)},
       "ED-01",
       "sent dominant and saw recessive in the IDE bit"},
      {"DominantDataBit",
       kPlain,
       {sender(Field::kData, 0)},
       "ED-01",
       "sent dominant and saw recessive in the data field"},
      {"RecessiveDataBit",
       kPlain,
       {sender(Field::kData, 1)},
       "ED-01",
       "sent recessive and saw dominant in the data field"},
      {"StuffBitInData",
       kStuffed,
       {sender(Field::kData, 4, true)},
       "ED-08",
       "the complement of its stuff bit in the data field"},
      {"NoAcknowledge", kPlain, {sender(Field::kAck)}, "AK-03", "no node acknowledged the frame"},
      {"CrcDelimiter",
       kPlain,
       {sender(Field::kCrcDel)},
       "ED-09",
       "the transmitter saw dominant in the CRC delimiter"},
      {"AckDelimiter",
       kPlain,
       {sender(Field::kAckDel)},
       "ED-09",
       "the transmitter saw dominant in the ACK delimiter"},
      {"EndOfFrame",
       kPlain,
       {sender(Field::kEof, 3)},
       "ED-09",
       "the transmitter saw dominant in the end of frame"},
      {"LastEndOfFrame",
       kPlain,
       {sender(Field::kEof, 6)},
       "ED-10",
       "the transmitter saw dominant in the last bit of the end of frame",
       kSenderNode,
       1},
  };
}

std::vector<CauseCase> receiver_cases() {
  return {
      {"StuffError",
       kStuffed,
       {receiver(Field::kId, 4, true)},
       "ST-06",
       "a receiver saw six equal bits in the identifier",
       kReceiverNode},
      {"LastStuffBit",
       kLastStuff,
       {receiver(Field::kCrcDel, 0, true)},
       "ST-04",
       "six equal bits at the stuff bit behind the CRC",
       kReceiverNode},
      {"WrongCrc",
       kPlain,
       {receiver(Field::kData, 3)},
       "ED-14",
       "calculated another CRC than it received",
       kReceiverNode},
      {"CrcDelimiterReceiver",
       kPlain,
       {receiver(Field::kCrcDel)},
       "ED-09",
       "a receiver saw dominant in the CRC delimiter",
       kReceiverNode},
      {"AckDelimiterReceiver",
       kPlain,
       {receiver(Field::kAckDel)},
       "ED-09",
       "a receiver saw dominant in the ACK delimiter",
       kReceiverNode},
      {"EndOfFrameReceiver",
       kPlain,
       {receiver(Field::kEof, 2)},
       "ED-09",
       "a receiver saw dominant in the end of frame",
       kReceiverNode},
      {"OwnAcknowledge",
       kPlain,
       {receiver(Field::kAck)},
       "ED-07",
       "sent its acknowledge and saw recessive",
       kReceiverNode},
  };
}

std::vector<CauseCase> flag_cases() {
  const Disturbance error = sender(Field::kData, 1);
  return {
      // Recessive, not flipped: the flag becomes a passive one at last, and ends.
      {"ErrorFlag",
       kPlain,
       {error, {kSenderNode, Field::kErrFlag, 2, false, kSenderNode, Effect::kRecessive}},
       "ED-01",
       "then a node saw recessive in its own error flag and begins another (EF-06)"},
      {"ErrorDelimiter",
       kPlain,
       {error, receiver(Field::kDel, 2)},
       "EF-09",
       "saw dominant within an error delimiter",
       kReceiverNode,
       0,
       1},
      {"FirstIntermissionBit",
       kPlain,
       {receiver(Field::kInt, 0)},
       "IF-04",
       "in the first two bits of the intermission",
       kReceiverNode,
       1},
      // The overload flag begins in the third bit, where all others take it for a SOF (OV-08).
      {"SecondIntermissionBit",
       kPlain,
       {receiver(Field::kInt, 1)},
       "IF-04",
       "in the first two bits of the intermission",
       kReceiverNode},
      {"LastEofReceiver",
       kPlain,
       {receiver(Field::kEof, 6)},
       "ED-11",
       "a receiver saw dominant in the last bit of the end of frame: the frame is valid",
       kReceiverNode,
       1},
      {"OverloadFlag",
       kPlain,
       {receiver(Field::kInt, 0), receiver(Field::kOvlFlag, 3)},
       "IF-04",
       "then a node saw recessive in its own overload flag (ED-21)",
       kReceiverNode,
       1},
      {"OverloadDelimiter",
       kPlain,
       {receiver(Field::kInt, 0), receiver(Field::kDel, 2)},
       "ED-21",
       "saw dominant within an overload delimiter",
       kReceiverNode,
       0,
       1},
  };
}

}  // namespace

std::vector<CauseCase> cause_cases() {
  std::vector<CauseCase> all = transmitter_cases();
  for (const auto &list : {receiver_cases(), flag_cases()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace vericansim
