// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FaultLog: see fault_log.hpp.
#include "bus/fault_log.hpp"

namespace vericansim {

void FaultLog::count(Stretch &stretch) {
  ++hits_;
  stretch.bits = 1;
  stretch.place = stretches_.size();
  if (stretches_.size() < kStretches)
    stretches_.push_back({stretch.from, stretch.last});
  else
    more_ = true;
}

void FaultLog::mark(Time t, unsigned receiver) {
  if (receiver >= now_.size()) now_.resize(receiver + 1);
  Stretch &stretch = now_[receiver];
  if (!stretch.begun || 2 * (t - stretch.last) > bit_time_) stretch = {true, t, t, 0, kStretches};
  stretch.last = t;
  if (stretch.bits == 0) {
    if (t - stretch.from >= least_) count(stretch);
    return;
  }
  if (stretch.place < kStretches) stretches_[stretch.place].to = t;
  if (bit_time_ != 0 && 2 * (t - stretch.from) >= (2 * stretch.bits + 1) * bit_time_) {
    ++stretch.bits;
    ++hits_;
  }
}

}  // namespace vericansim
