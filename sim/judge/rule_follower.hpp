// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RuleFollower: the rule-based node model beside a node, bit by bit (rule 19.5).
#pragma once

#include <string>
#include <vector>

#include "judge/node_bit.hpp"
#include "model/node_model.hpp"

namespace vericansim {

/// One model that goes through the bits of one node. Who uses it tells the model what the node has
/// to send, before the bit in which that matters.
class RuleFollower {
 public:
  [[nodiscard]] NodeModel &model() { return model_; }
  [[nodiscard]] const NodeModel &model() const { return model_; }

  /// The model takes the bit. Returns one sentence for each way in which the node differs: level
  /// sent, place in the frame, role, bits left of the field, kind of error, success, end of an
  /// attempt, delivery, TEC, REC, recovery sequences, error state. Tolerated is what 19.5 item 5
  /// leaves open (rule_tolerance.hpp). Nothing that follows a difference is worth anything.
  [[nodiscard]] std::vector<std::string> follow(const NodeBit &bit);

 private:
  using Differences = std::vector<std::string>;

  void compare_place(const NodeBit &bit, Differences &found) const;
  void compare_events(const NodeBit &bit, Differences &found) const;
  void compare_counters(const NodeBit &bit, int last_rec, Differences &found);

  NodeModel model_;
  bool crc_step_ = false;  // REC differs since the last bit because of a CRC error
};

}  // namespace vericansim
