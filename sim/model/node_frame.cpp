// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeModel within a frame: arbitration, bit check, acknowledge, end of frame (rule book 1-4, 6, 8,
// 15).
#include "model/node_model.hpp"

namespace vericansim {
namespace {

/// AR-01: the fields where an own recessive bit may be overwritten. The base IDE is outside too,
/// but a node that sends it recessive has an extended frame, for which it is inside.
bool in_arbitration(Field field) { return field >= Field::kId && field <= Field::kExRtr; }

/// AR-12: 0 = ID28 .. 31 = extended RTR.
std::uint8_t arbitration_position(const BitPlace &place) {
  switch (place.field) {
    case Field::kId: return place.index;
    case Field::kRtr: return 11;
    case Field::kIde: return 12;
    case Field::kExId: return static_cast<std::uint8_t>(13 + place.index);
    default: return 31;
  }
}

Level bit_of(std::uint32_t value, unsigned number) {
  return ((value >> number) & 1u) != 0 ? Level::kRecessive : Level::kDominant;
}

Level recessive_if(bool value) { return value ? Level::kRecessive : Level::kDominant; }

}  // namespace

/// The transmitter's next bit: a stuff bit, or the frame's bit at the parser's place
/// (FF-01..FF-04).
Level NodeModel::frame_level() const {
  if (place_.is_stuff) return !parser_.run_level();
  const unsigned index = place_.index;
  switch (place_.field) {
    case Field::kSof: return Level::kDominant;
    case Field::kId: return bit_of(active_.extended ? active_.id >> 18 : active_.id, 10 - index);
    case Field::kRtr: return recessive_if(active_.extended || active_.remote);
    case Field::kIde: return recessive_if(active_.extended);
    case Field::kExId: return bit_of(active_.id, 17 - index);
    case Field::kExRtr: return recessive_if(active_.remote);
    case Field::kR1:
    case Field::kR0: return Level::kDominant;
    case Field::kDlc: return bit_of(active_.dlc, 3 - index);
    case Field::kData: return bit_of(active_.data[index / 8], 7 - index % 8);
    case Field::kCrc: return bit_of(parser_.crc(), 14 - index);
    default: return Level::kRecessive;
  }
}

/// Own SOF on the bus (ED-13).
void NodeModel::sample_sof(Level level) {
  if (level == Level::kRecessive) return error(NodeError::kBit0);
  parser_.start();
  events_.started = true;
  place_ = parser_.place();
}

/// kId..kCrcDel with all stuff bits.
void NodeModel::sample_stuffed(Level level) {
  if (place_.field == Field::kCrcDel && !place_.is_stuff) {
    if (level == Level::kDominant) return error(NodeError::kForm);
    return go(Field::kAck);
  }
  if (role_ == Role::kTransmitter && level != sent_ && transmitter_mismatch(level)) return;
  if (!parser_.take(level)) return error(NodeError::kStuff);
  // FF-06: FDF is the bit after a base IDE, or extended r1.
  const bool fdf = !place_.is_stuff && (place_.field == Field::kR1 ||
                                        (place_.field == Field::kR0 && !parser_.frame().extended));
  if (fdf && config_.fd_tolerant && level == Level::kRecessive) {
    events_.fd_exception = true;
    return integrate();
  }
  place_ = parser_.place();
}

/// Sent and sampled level differ. False if that is lost arbitration, where the node goes on as
/// receiver.
bool NodeModel::transmitter_mismatch(Level level) {
  if (level == Level::kRecessive) {  // AR-03, AR-05
    error(NodeError::kBit0);
    return true;
  }
  if (!in_arbitration(place_.field)) {
    error(NodeError::kBit1);
    return true;
  }
  if (place_.is_stuff) {  // AR-04; FC-05 exception 2
    error(NodeError::kStuff, true);
    return true;
  }
  lose_arbitration();
  return false;
}

/// AR-02, AR-09.
void NodeModel::lose_arbitration() {
  events_.lost_arbitration = true;
  events_.lost_position = arbitration_position(place_);
  end_attempt(false);
  role_ = Role::kReceiver;
}

/// AK-01..AK-03, ED-07, FC-10. A listen-only node does not judge the slot (MO-01, MO-03).
void NodeModel::sample_ack(Level level) {
  if (role_ == Role::kTransmitter) {
    if (level == Level::kRecessive && !config_.loop_back) return error(NodeError::kAck);
  } else if (sent_ == Level::kDominant) {
    if (level == Level::kRecessive) return error(NodeError::kBit0);
    confinement_.received();
  }
  go(Field::kAckDel);
}

/// ED-09, ED-14, ED-15, ED-20.
void NodeModel::sample_ack_delimiter(Level level) {
  if (level == Level::kDominant) return error(NodeError::kForm);
  if (role_ == Role::kReceiver && !parser_.crc_matches()) return error(NodeError::kCrc);
  go(Field::kEof);
}

/// ED-09..ED-11, VA-01, VA-02.
void NodeModel::sample_eof(Level level) {
  const bool transmitter = role_ == Role::kTransmitter;
  const bool last = place_.index == 6;
  if (level == Level::kDominant) {
    if (last && !transmitter) return overload();
    return error(NodeError::kForm);
  }
  if (place_.index == 5) {
    events_.delivered = !transmitter || config_.loop_back || config_.self_reception;
  }
  if (!last) {
    ++place_.index;
    return;
  }
  if (transmitter) {
    confinement_.sent();
    events_.sent_ok = true;
    end_attempt(true);
  }
  go(Field::kInt);
}

/// The own frame succeeded or failed; a failed one stays pending unless one-shot (RO-03, MO-09).
void NodeModel::end_attempt(bool success) {
  sending_ = false;
  events_.tx_fail = !success;
  if (active_is_pending_ && (success || config_.one_shot)) pending_.reset();
  active_is_pending_ = false;
}

}  // namespace vericansim
