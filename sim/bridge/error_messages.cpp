// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ErrorMessages: see error_messages.hpp.
#include "error_messages.hpp"

#include <algorithm>

namespace vericansim {

std::uint8_t arbitration_bit(Field field, unsigned left) {
  switch (field) {
    case Field::kId: return static_cast<std::uint8_t>(11 - left);
    case Field::kRtr: return 12;
    case Field::kIde: return 13;
    case Field::kExId: return static_cast<std::uint8_t>(31 - left);
    case Field::kExRtr: return 32;
    default: return CAN_ERR_LOSTARB_UNSPEC;
  }
}

std::uint8_t error_location(Field field, unsigned left) {
  switch (field) {
    case Field::kSof: return CAN_ERR_PROT_LOC_SOF;
    case Field::kId: return left >= 3 ? CAN_ERR_PROT_LOC_ID28_21 : CAN_ERR_PROT_LOC_ID20_18;
    case Field::kRtr: return CAN_ERR_PROT_LOC_SRTR;
    case Field::kIde: return CAN_ERR_PROT_LOC_IDE;
    case Field::kExId:
      if (left >= 13) return CAN_ERR_PROT_LOC_ID17_13;
      return left >= 5 ? CAN_ERR_PROT_LOC_ID12_05 : CAN_ERR_PROT_LOC_ID04_00;
    case Field::kExRtr: return CAN_ERR_PROT_LOC_RTR;
    case Field::kR1: return CAN_ERR_PROT_LOC_RES1;
    case Field::kR0: return CAN_ERR_PROT_LOC_RES0;
    case Field::kDlc: return CAN_ERR_PROT_LOC_DLC;
    case Field::kData: return CAN_ERR_PROT_LOC_DATA;
    case Field::kCrc: return CAN_ERR_PROT_LOC_CRC_SEQ;
    case Field::kCrcDel: return CAN_ERR_PROT_LOC_CRC_DEL;
    case Field::kAck: return CAN_ERR_PROT_LOC_ACK;
    case Field::kAckDel: return CAN_ERR_PROT_LOC_ACK_DEL;
    case Field::kEof: return CAN_ERR_PROT_LOC_EOF;
    case Field::kInt: return CAN_ERR_PROT_LOC_INTERM;
    default: return CAN_ERR_PROT_LOC_UNSPEC;
  }
}

std::optional<can_frame> bus_error_message(const BusEvent &event) {
  if (event.kind == BusEventKind::kFrame) return {};
  can_frame message{};
  message.can_id = CAN_ERR_FLAG | CAN_ERR_PROT;
  message.len = CAN_ERR_DLC;
  constexpr unsigned kIdBits = 11, kExIdBits = 18;
  const unsigned bits = event.field == Field::kExId ? kExIdBits : kIdBits;
  message.data[3] =
      error_location(event.field, bits - 1 - std::min<unsigned>(event.index, bits - 1));
  if (event.kind == BusEventKind::kOverloadFrame) {
    message.data[2] = CAN_ERR_PROT_OVERLOAD;
    return message;
  }
  message.can_id |= CAN_ERR_BUSERROR;
  if (event.problem == BusProblem::kStuff) message.data[2] = CAN_ERR_PROT_STUFF;
  if (event.problem == BusProblem::kForm) message.data[2] = CAN_ERR_PROT_FORM;
  if (event.problem == BusProblem::kCrc) message.data[3] = CAN_ERR_PROT_LOC_CRC_SEQ;
  return message;
}

std::optional<can_frame> ErrorMessages::on_bit(const BitRecord &bit) {
  if (choice_ == ErrorChoice::kNone) return {};
  can_frame message{};
  if (choice_ == ErrorChoice::kOwn) {
    if (bit.after.errors != 0) {
      add_error(message, bit);
    } else if (bit.after.tx_fail) {
      message.can_id |= CAN_ERR_LOSTARB;
      message.data[0] = arbitration_bit(bit.at.field, bit.at.left);
    }
  }
  add_state(message, bit.after);
  if (message.can_id == 0) return {};
  message.can_id |= CAN_ERR_FLAG;
  message.len = CAN_ERR_DLC;
  if (!bit.after.bus_off) {
    message.can_id |= CAN_ERR_CNT;
    message.data[6] = bit.after.tec;
    message.data[7] = bit.after.rec;
  }
  return message;
}

void ErrorMessages::add_error(can_frame &message, const BitRecord &bit) const {
  const std::uint8_t errors = bit.after.errors;
  message.can_id |= CAN_ERR_PROT | CAN_ERR_BUSERROR;
  if ((errors & kErrStuff) != 0) message.data[2] |= CAN_ERR_PROT_STUFF;
  if ((errors & kErrForm) != 0) message.data[2] |= CAN_ERR_PROT_FORM;
  if ((errors & kErrBit0) != 0) message.data[2] |= CAN_ERR_PROT_BIT0;
  if ((errors & kErrBit1) != 0) message.data[2] |= CAN_ERR_PROT_BIT1;
  if (bit.at.field == Field::kErrFlag) message.data[2] |= CAN_ERR_PROT_ACTIVE;
  if (bit.at.field == Field::kOvlFlag) message.data[2] |= CAN_ERR_PROT_OVERLOAD;
  if (bit.at.transmitter) message.data[2] |= CAN_ERR_PROT_TX;
  if ((errors & kErrAck) != 0) message.can_id |= CAN_ERR_ACK;
  // A CRC error shows later than where it is (CR-04, ED-20).
  message.data[3] =
      errors == kErrCrc ? CAN_ERR_PROT_LOC_CRC_SEQ : error_location(bit.at.field, bit.at.left);
}

ErrorMessages::State ErrorMessages::level(unsigned counter) {
  if (counter >= CAN_ERROR_PASSIVE_THRESHOLD) return State::kPassive;
  return counter >= CAN_ERROR_WARNING_THRESHOLD ? State::kWarning : State::kActive;
}

std::uint8_t ErrorMessages::controller_bits(State state, bool transmit) {
  if (state == State::kActive) return CAN_ERR_CRTL_ACTIVE;
  if (state == State::kWarning) return transmit ? CAN_ERR_CRTL_TX_WARNING : CAN_ERR_CRTL_RX_WARNING;
  return transmit ? CAN_ERR_CRTL_TX_PASSIVE : CAN_ERR_CRTL_RX_PASSIVE;
}

void ErrorMessages::add_state(can_frame &message, const Trace &after) {
  const State tx = level(after.tec), rx = level(after.rec);
  const State now = after.bus_off ? State::kBusOff : std::max(tx, rx);
  if (now == state_) return;
  if (now == State::kBusOff) {
    message.can_id |= CAN_ERR_BUSOFF;
  } else if (state_ == State::kBusOff) {
    message.can_id |= CAN_ERR_RESTARTED;
  } else {
    message.can_id |= CAN_ERR_CRTL;
    if (tx == now) message.data[1] |= controller_bits(now, true);
    if (rx == now) message.data[1] |= controller_bits(now, false);
  }
  state_ = now;
}

}  // namespace vericansim
