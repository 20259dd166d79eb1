// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeModel: interface, choice of the rule set by place, and everything between frames (rule book
// 5, 7, 12).
#include "model/node_model.hpp"

#include <algorithm>
#include <stdexcept>

namespace vericansim {

void NodeModel::sample(Level bus) {
  const Level level = config_.loop_back ? sent_ : bus;
  events_ = NodeEvents{};
  events_.at = place_;
  events_.level = level;
  recessive_bits_ = level == Level::kRecessive ? std::min(recessive_bits_ + 1, 11) : 0;
  confinement_.freeze(config_.listen_only);  // FC-22
  dispatch(level);
  if (confinement_.off() && place_.field != Field::kBusOff) enter_bus_off();
  sent_ = next_level();
}

void NodeModel::dispatch(Level level) {
  switch (place_.field) {
    case Field::kInteg: return sample_integration(level);
    case Field::kBusOff: return sample_bus_off(level);
    case Field::kIdle: return level == Level::kDominant ? foreign_sof(true) : may_start();
    case Field::kInt: return sample_intermission(level);
    case Field::kSuspend: return sample_suspend(level);
    case Field::kSof: return sample_sof(level);
    case Field::kAck: return sample_ack(level);
    case Field::kAckDel: return sample_ack_delimiter(level);
    case Field::kEof: return sample_eof(level);
    case Field::kErrFlag:
    case Field::kOvlFlag: return silent_flag_ ? sample_silent_flag(level) : sample_flag(level);
    case Field::kWait: return sample_wait(level);
    case Field::kDel: return sample_delimiter(level);
    default: return sample_stuffed(level);
  }
}

Level NodeModel::next_level() const {
  switch (place_.field) {
    case Field::kInteg:
    case Field::kBusOff:
    case Field::kIdle:
    case Field::kInt:
    case Field::kSuspend:
    case Field::kAckDel:
    case Field::kEof:
    case Field::kWait:
    case Field::kDel: return Level::kRecessive;
    case Field::kErrFlag:
    case Field::kOvlFlag: return silent_flag_ ? Level::kRecessive : Level::kDominant;
    case Field::kAck:  // AK-01: whatever the filters and the error state say.
      return role_ == Role::kReceiver && parser_.crc_matches() && !config_.listen_only
                 ? Level::kDominant
                 : Level::kRecessive;
    default: return role_ == Role::kTransmitter ? frame_level() : Level::kRecessive;
  }
}

void NodeModel::request(const Frame &frame) {
  frame.validate();
  pending_ = frame;
  active_is_pending_ = false;
}

void NodeModel::cancel() {
  pending_.reset();
  active_is_pending_ = false;
}

void NodeModel::preset_counters(int tec, int rec) {
  if (tec < 0 || tec > 255 || rec < 0 || rec > 255) {
    throw std::invalid_argument("error counters take 0..255");
  }
  confinement_.preset(tec, rec);
}

ErrorState NodeModel::error_state() const {
  if (place_.field == Field::kBusOff) return ErrorState::kBusOff;
  return confinement_.passive() ? ErrorState::kPassive : ErrorState::kActive;
}

unsigned NodeModel::left() const {
  unsigned length = place_.index + 1u;
  switch (place_.field) {
    case Field::kInt: length = 3; break;
    case Field::kSuspend: length = 8; break;
    case Field::kId: length = 11; break;
    case Field::kExId: length = 18; break;
    case Field::kDlc: length = 4; break;
    case Field::kData: length = 8 * parser_.frame().payload_size(); break;
    case Field::kCrc: length = 15; break;
    case Field::kEof:
    case Field::kDel: length = 7; break;
    case Field::kErrFlag:
    case Field::kOvlFlag: length = 6; break;
    default: break;
  }
  return length - 1u - place_.index;
}

void NodeModel::restart() {
  sending_ = false;
  events_ = NodeEvents{};
  if (confinement_.off() && place_.field == Field::kBusOff) {
    recessive_run_ = 0;  // the recovery sequences so far count
  } else if (confinement_.off()) {
    enter_bus_off();
  } else {
    integrate();
  }
  sent_ = Level::kRecessive;
}

void NodeModel::preset_idle() {
  sending_ = false;
  role_ = Role::kNone;
  go(Field::kIdle);
  sent_ = Level::kRecessive;
}

void NodeModel::integrate() {
  role_ = Role::kNone;
  recessive_run_ = 0;
  go(Field::kInteg);
}

/// IN-01, IN-03, IN-04.
void NodeModel::sample_integration(Level level) {
  recessive_run_ = level == Level::kRecessive ? recessive_run_ + 1 : 0;
  if (recessive_run_ == 11) may_start();
}

/// BO-01. Counting begins with the bit after this sample point.
void NodeModel::enter_bus_off() {
  events_.bus_off_entered = place_.field != Field::kBusOff;
  role_ = Role::kNone;
  recessive_run_ = 0;
  sequences_ = 0;
  hold_bus_off_ = config_.boff_rec;
  go(Field::kBusOff);
}

/// BO-02, BO-03, BO-05; sequences do not overlap.
void NodeModel::sample_bus_off(Level level) {
  if (!config_.boff_rec) hold_bus_off_ = false;
  recessive_run_ = level == Level::kRecessive ? recessive_run_ + 1 : 0;
  if (recessive_run_ < 11) return;
  recessive_run_ = 0;
  if (sequences_ < 128) ++sequences_;
  if (sequences_ < 128 || hold_bus_off_) return;
  confinement_.preset(0, 0);
  events_.recovered = true;
  may_start();
}

/// IF-02..IF-06, IF-08..IF-11.
void NodeModel::sample_intermission(Level level) {
  if (place_.index < 2) {
    if (level == Level::kDominant) return overload();  // IF-04
    ++place_.index;
    return;
  }
  const bool suspend = role_ == Role::kTransmitter && confinement_.passive();
  if (level == Level::kDominant) return foreign_sof(!suspend);
  if (suspend) return go(Field::kSuspend);
  may_start();
}

/// IF-08, IF-10: no joining from here.
void NodeModel::sample_suspend(Level level) {
  if (level == Level::kDominant) return foreign_sof(false);
  if (++place_.index == 8) may_start();
}

/// The bus is free from the next bit on: own SOF if a frame waits, else idle (IF-03, IF-12).
void NodeModel::may_start() {
  if (may_send()) {
    begin_transmission();
    go(Field::kSof);
  } else {
    role_ = Role::kNone;
    go(Field::kIdle);
  }
}

/// A dominant bit was sampled as SOF without sending one (IF-05, IF-06, IF-10, IF-14).
void NodeModel::foreign_sof(bool may_join) {
  if (may_join && may_send()) {
    begin_transmission();
  } else {
    role_ = Role::kReceiver;
  }
  parser_.start();
  events_.started = true;
  place_ = parser_.place();
}

void NodeModel::begin_transmission() {
  active_ = *pending_;
  active_is_pending_ = true;
  sending_ = true;
  role_ = Role::kTransmitter;
}

}  // namespace vericansim
