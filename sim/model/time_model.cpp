// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See time_model.hpp.
#include "model/time_model.hpp"

namespace vericansim {

// TM-15: 1 ns towards nothing left; not if TIME could then stand or go back (TM-17).
int TimeModel::slew_step() const {
  const bool changed = ((ns_[3] ^ ns_[4]) >> slew_bit_ & 1) != 0;
  if (left_ == 0 || !changed || inc_ns_ < 2) return 0;
  return left_ < 0 ? -1 : 1;
}

void TimeModel::clock(const TimeCommand &command) {
  using Kind = TimeCommand::Kind;
  if (command.kind == Kind::kRate) {
    inc_ns_ = command.inc_ns;
    inc_frac_ = command.inc_frac;
  }
  const int step = slew_step();
  left_ = command.kind == Kind::kSlew ? command.slew : left_ - step;
  std::uint64_t next = ns_[0] + inc_ns_ + (carry_ ? 1 : 0) + static_cast<std::uint64_t>(step);
  if (command.kind == Kind::kShift) next += command.ns;
  const std::uint64_t sum = std::uint64_t{fraction_} + inc_frac_;
  carry_ = (sum >> 32) != 0;
  fraction_ = static_cast<std::uint32_t>(sum);
  if (command.kind == Kind::kSet) {
    next = command.ns;
    carry_ = false;
    fraction_ = 0;
  }
  ns_ = {next, ns_[0], ns_[1], ns_[2], ns_[3]};
}

}  // namespace vericansim
