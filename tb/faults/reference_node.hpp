// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReferenceNode: a whole node clock by clock, put together from the two rule-based models: bit
// timing (TimingReference) and bit stream (NodeModel).
#pragma once

#include <vector>

#include "model/node_model.hpp"
#include "protocol/timing_reference.hpp"

namespace vericansim {

/// One node. Stands in idle at the first clock of a bit. Per clock: level = tx(); then clock(AND of
/// all levels). The pin is judged two clocks late, as behind a synchroniser (BT-06).
class ReferenceNode {
 public:
  explicit ReferenceNode(const BitTiming &timing);

  /// Level at the TX pin in the coming clock period.
  [[nodiscard]] Level tx() const { return sent_; }
  /// One clock period with this level at the RX pin. True if it ended with a sample point.
  bool clock(Level pin);
  /// The period ended a bit: the next one begins.
  [[nodiscard]] bool bit_ended() const { return ended_; }
  /// With clock() true: the value sampled, and the place it had.
  [[nodiscard]] Level sampled() const { return model_.events().level; }
  [[nodiscard]] BitPlace sampled_at() const { return model_.events().at; }

  [[nodiscard]] NodeModel &model() { return model_; }
  [[nodiscard]] const std::vector<Frame> &received() const { return received_; }
  [[nodiscard]] unsigned sent_frames() const { return sent_frames_; }

 private:
  void take(Level bit);

  TimingReference timing_;
  NodeModel model_;
  unsigned prescaler_;
  unsigned phase_ = 0;
  bool hard_ = true;
  bool ended_ = false;
  Level sent_ = Level::kRecessive;
  Level before_ = Level::kRecessive;       // at the pin one period ago
  Level before_that_ = Level::kRecessive;  // two periods ago
  std::vector<Frame> received_;
  unsigned sent_frames_ = 0;
};

}  // namespace vericansim
