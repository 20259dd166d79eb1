// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PairSource: a master whose clock is the simulation's, and whose frames are put on the bus bit by
// bit. It does not listen: nobody else may send meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bus/bus.hpp"
#include "time/tsyn_frames.hpp"

namespace vericansim {

class PairSource : public Node {
 public:
  /// `bitrate`, bit/s; `epoch_ns`: its time when the bus begins.
  PairSource(double bitrate, std::uint64_t epoch_ns)
      : Node{"master", {.frequency_hz = bitrate}}, epoch_{epoch_ns} {}

  /// The master's time, ns, at bus time `at`, ps.
  [[nodiscard]] std::uint64_t time(Time at) const {
    return epoch_ + static_cast<std::uint64_t>(at / kNanosecond);
  }

  /// A frame, from the next bit on.
  void send(const Frame &frame) {
    disturbed();
    const EncodedFrame encoded = encode_unacknowledged(frame);
    levels_ = levels_of(encoded.bits);
    reference_bit_ = reference_bit(encoded.bits);
    next_ = 0;
  }
  void sync() { send(pairs_.sync(time(bus()->now()))); }
  void follow_up() { send(pairs_.follow_up(time(reference()))); }
  /// When the reference edge of the last frame left; it has.
  [[nodiscard]] Time reference() const { return reference_; }

  void clock(Level) override {
    if (next_ == levels_.size()) return drive(Level::kRecessive);
    if (next_ == reference_bit_) reference_ = bus()->now();
    drive(levels_[next_++]);
  }
  [[nodiscard]] std::uint64_t quiet() const override {
    return next_ == levels_.size() && tx() == Level::kRecessive ? ~0ULL : 0;
  }

 private:
  std::uint64_t epoch_;
  TsynPairs pairs_;
  std::vector<Level> levels_;
  std::size_t next_ = 0, reference_bit_ = 0;
  Time reference_ = 0;
};

}  // namespace vericansim
