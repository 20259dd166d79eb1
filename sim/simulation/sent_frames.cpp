// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SentFrames: see sent_frames.hpp.
#include "simulation/sent_frames.hpp"

namespace vericansim {

void SentFrames::told(const Frame &frame, Time time) {
  const bool on_bus = seen_ && seen_->frame == frame && time - seen_->time < near_;
  seen_.reset();
  if (!on_bus) told_.push_back({frame, time});
}

void SentFrames::seen(const Frame &frame, Time end) {
  seen_.reset();
  if (!told_.empty() && told_.back().frame == frame && end - told_.back().time < near_)
    told_.pop_back();
  else
    seen_ = Ended{frame, end};
}

std::vector<Frame> SentFrames::lost(Time time) {
  std::vector<Frame> frames;
  while (!told_.empty() && time - told_.front().time >= near_) {
    frames.push_back(told_.front().frame);
    told_.pop_front();
  }
  return frames;
}

}  // namespace vericansim
