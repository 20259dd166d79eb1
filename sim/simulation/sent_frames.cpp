// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SentFrames: see sent_frames.hpp.
#include "simulation/sent_frames.hpp"

#include <algorithm>

namespace vericansim {

void SentFrames::told(const Frame &frame, Time time) {
  const auto seen = std::find(seen_.begin(), seen_.end(), frame);
  if (seen == seen_.end())
    told_.push_back({frame, time});
  else
    seen_.erase(seen);
}

void SentFrames::seen(const Frame &frame, Time end) {
  if (!told_.empty() && told_.back().frame == frame && end - told_.back().time < near_)
    return told_.pop_back();
  seen_.push_back(frame);
  if (seen_.size() > kMost) seen_.pop_front();
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
