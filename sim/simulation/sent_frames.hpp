// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SentFrames: frames that the software of a node has sent, held against those on the bus.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// A sender may take a frame for sent that was none on the bus, as where a disturbance looks to it
/// like an acknowledgement. Software and bus tell each frame once: the bus about when it ends, its
/// software shortly before or any time after.
class SentFrames {
 public:
  /// `bit_time` of the bus, ps.
  explicit SentFrames(Time bit_time) : near_{kNear * bit_time} {}

  /// The software has sent `frame`, and says so at `time`.
  void told(const Frame &frame, Time time);
  /// The bus has had `frame`, which has ended at `end`.
  void seen(const Frame &frame, Time end);
  /// Frames of which the software has told, and the bus, up to `time`, has had none; each once.
  [[nodiscard]] std::vector<Frame> lost(Time time);

 private:
  struct Ended {
    Frame frame;
    Time time;
  };
  static constexpr Time kNear = 20;  // bits; frames of a node end 47 apart at least
  /// Frames whose end no software tells of are forgotten: a core has no more buffers than this.
  static constexpr std::size_t kMost = 64;

  Time near_;
  std::deque<Ended> told_;  // and not seen so far
  std::deque<Frame> seen_;  // and not told of so far
};

}  // namespace vericansim
