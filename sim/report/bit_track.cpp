// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BitTrack: see bit_track.hpp.
#include "report/bit_track.hpp"

#include <algorithm>
#include <cmath>

namespace vericansim {

const TrackedBit &BitTrack::take(const BitRecord &record) {
  const TrackedBit before = bit_;
  bit_ = TrackedBit{};
  bit_.time = record.time;
  bit_.tq = clock_->period_ps() * timing_.prescaler;
  bit_.quanta = timing_.quanta();
  bit_.rx = record.at.rx;
  bit_.tx = record.at.tx;
  bit_.transmitter = record.at.transmitter;
  bit_.stuff = record.at.stuff;
  // An own SOF is announced one bit before it.
  bit_.begins =
      record.at.field == Field::kSof || (record.after.start && record.at.rx == Level::kDominant);
  place(record, before);
  measure(before);
  return bit_;
}

// A receiver waits for a SOF in idle or intermission; the trace names that field.
void BitTrack::place(const BitRecord &record, const TrackedBit &before) {
  bit_.field = bit_.begins ? Field::kSof : record.at.field;
  const bool same_run = goes_on(bit_.field, record.at.left, before.field, left_);
  left_ = record.at.left;
  if (!same_run) return;
  bit_.index =
      before.stuff ? before.index : static_cast<std::uint8_t>(std::min<int>(before.index + 1, 255));
}

void BitTrack::measure(const TrackedBit &before) {
  const double to_sample = bit_.tq * sample_quanta();
  bit_.start = static_cast<double>(bit_.time) - to_sample;
  if (before.tq == 0) return;
  const double distance = static_cast<double>(bit_.time - before.time) / bit_.tq;
  const int change =
      static_cast<int>(std::lround(std::min(distance, 1e6))) - static_cast<int>(timing_.quanta());
  if (change == 0) return;
  const bool hard = bit_.begins || change > static_cast<int>(timing_.sjw);
  if (change < 0 || hard) {
    bit_.previous_changed = change;
  } else {
    bit_.lengthened = change;
    bit_.start -= change * bit_.tq;
  }
}

}  // namespace vericansim
