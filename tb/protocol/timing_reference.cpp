// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimingReference: see timing_reference.hpp.
#include "protocol/timing_reference.hpp"

#include <algorithm>

namespace vericansim {

void TimingReference::begin_bit() {
  position_ = 0;
  ps1_ = static_cast<int>(timing_.ps1);  // the next bit uses nominal lengths (SY-16)
  ps2_ = static_cast<int>(timing_.ps2);
}

// Edge in quantum e after SYNC_SEG: phase error +e (SY-07).
void TimingReference::synchronise_before_sample(Level sent, bool hard) {
  if (hard) {
    begin_bit();                                                 // this quantum is SYNC_SEG (SY-06)
  } else if (sent == Level::kRecessive) {                        // SY-10
    ps1_ += std::min(position_, static_cast<int>(timing_.sjw));  // SY-08
  }
}

// Edge in quantum k of PHASE_SEG2: phase error -(PS2 - k + 1). True if this quantum becomes the
// next SYNC_SEG.
bool TimingReference::synchronise_after_sample(bool hard) {
  const int k = position_ - sample_position();
  const int error = static_cast<int>(timing_.ps2) - k + 1;
  const int sjw = static_cast<int>(timing_.sjw);
  if (hard || error <= sjw) return true;
  ps2_ -= sjw;
  return false;
}

Level TimingReference::majority(Level bus) const {
  const int recessive =
      static_cast<int>(bus) + static_cast<int>(before_) + static_cast<int>(before_that_);
  return recessive >= 2 ? Level::kRecessive : Level::kDominant;
}

TimingReference::Quantum TimingReference::step(Level bus, Level sent, bool hard) {
  Quantum result;
  bool became_sync = false;
  if (before_ == Level::kRecessive && bus == Level::kDominant && armed_) {  // SY-01, SY-02
    result.edge = true;
    armed_ = false;  // SY-03
    if (position_ <= sample_position()) {
      synchronise_before_sample(sent, hard);
    } else {
      became_sync = synchronise_after_sample(hard);
    }
  }
  if (became_sync) {
    begin_bit();
    result.last = true;  // the edge is known at the end of its quantum, and so the level goes out
  } else if (position_ == sample_position()) {
    result.sample = true;
    result.bit = triple_ ? majority(bus) : bus;
    armed_ = result.bit == Level::kRecessive;
  }
  before_that_ = before_;
  before_ = bus;
  if (!became_sync && position_ == sample_position() + ps2_) {
    result.last = true;
    begin_bit();
  } else {
    ++position_;
  }
  return result;
}

}  // namespace vericansim
