// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeModel after an error or overload condition: flags and delimiters (rule book 9, 10, 11).
#include "model/node_model.hpp"

namespace vericansim {

/// An error other than one in an own flag. The flag's type is that of the state before the step
/// (EF-05).
void NodeModel::error(NodeError kind, bool exempt) {
  const bool passive = confinement_.passive();
  events_.error = kind;
  const bool withheld = kind == NodeError::kAck && passive;  // FC-05 exception 1
  confinement_.error(role_, exempt || withheld);
  if (sending_) end_attempt(false);
  if (config_.listen_only) return rejoin();
  start_flag(Field::kErrFlag, passive);
  withheld_ack_step_ = withheld;
}

/// OV-01, OV-03: dominant from passive nodes too, but never from a listening one (EF-13).
void NodeModel::overload() {
  if (config_.listen_only) return rejoin();
  events_.overload = true;
  start_flag(Field::kOvlFlag, false);
}

/// MO-02: no flag, no delimiter; eleven recessive bits, those just seen among them.
void NodeModel::rejoin() {
  integrate();
  recessive_run_ = recessive_bits_;
}

void NodeModel::start_flag(Field field, bool silent) {
  go(field);
  silent_flag_ = silent;
  after_error_flag_ = field == Field::kErrFlag;
  withheld_ack_step_ = false;
  dominant_after_flag_ = 0;
}

/// Six dominant bits of an active error flag or an overload flag (EF-06, ED-21, FC-06, FC-07).
void NodeModel::sample_flag(Level level) {
  if (level == Level::kRecessive) {
    const bool passive = confinement_.passive();
    events_.error = NodeError::kBit0;
    confinement_.flag_bit_error(role_);
    return start_flag(Field::kErrFlag, passive);
  }
  if (++place_.index == 6) go(Field::kWait);
}

/// Passive flag: ends after six equal bits; index counts those seen so far (EF-02..EF-04).
void NodeModel::sample_silent_flag(Level level) {
  if (withheld_ack_step_ && level == Level::kDominant) {  // FC-05a
    confinement_.withheld_ack_error();
    withheld_ack_step_ = false;
  }
  const bool equal = place_.index == 0 || level == flag_level_;
  place_.index = equal ? static_cast<std::uint8_t>(place_.index + 1) : std::uint8_t{1};
  flag_level_ = level;
  if (place_.index == 6) go(Field::kWait);
}

/// EF-08: the first recessive bit is DEL1.
void NodeModel::sample_wait(Level level) {
  if (level == Level::kRecessive) return go(Field::kDel);
  ++dominant_after_flag_;
  if (dominant_after_flag_ == 1 && after_error_flag_ && role_ != Role::kTransmitter) {
    confinement_.dominant_after_flag();
  }
  if (dominant_after_flag_ % 8 == 0) confinement_.eight_dominant_after_flag(role_);
}

/// DEL2..DEL8 (EF-09, EF-10, ED-12, FC-16).
void NodeModel::sample_delimiter(Level level) {
  const bool last = place_.index == 6;
  if (level == Level::kDominant) return last ? overload() : error(NodeError::kForm);
  if (last) return go(Field::kInt);
  ++place_.index;
}

}  // namespace vericansim
