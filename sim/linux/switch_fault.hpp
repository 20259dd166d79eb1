// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SwitchFault: what a test script does to a bus while it runs: levels, cables and single bits.
#pragma once

#include <optional>

#include "bus/faults.hpp"

namespace vericansim {

/// A fault with switches, all off at first: the bus held at a level, nodes cut off, and bits of one
/// node's frames forced at that node.
class SwitchFault : public Fault {
 public:
  /// Holds the whole bus at a level; nothing: lets go.
  void hold(std::optional<Level> level) { held_ = level; }
  /// Opens or closes the cable of a node.
  void cut(NodeId node, bool open) { cut_ = open ? cut_ | (1ULL << node) : cut_ & ~(1ULL << node); }
  /// In the next `times` frames that `node` transmits or receives, from the next on, bit `index` of
  /// `field` as seen at that node gets `effect`. Replaces what was set before.
  void strike(NodeId node, Field field, unsigned index, Effect effect, unsigned times) {
    node_ = node;
    field_ = field;
    index_ = index;
    effect_ = effect;
    left_ = times;
    now_ = false;
  }
  /// Bits that strike() still has to hit.
  [[nodiscard]] unsigned strikes_left() const { return left_; }

  [[nodiscard]] std::uint64_t unheard(NodeId receiver, Time) override {
    if (cut_ == 0) return 0;
    const bool alone = receiver < 64 && ((cut_ >> receiver) & 1) != 0;
    return alone ? ~(1ULL << receiver) : cut_;
  }
  [[nodiscard]] Level level(NodeId receiver, Time, Level level) override {
    if (held_) return *held_;
    return now_ && receiver == node_ ? apply_effect(effect_, level) : level;
  }
  void clocked(NodeId node, Time, std::uint64_t word) override {
    if (node != node_) return;
    place_.clocked(word);
    const bool hit =
        left_ != 0 && place_.field() == field_ && place_.index() == index_ && !place_.stuff();
    if (now_ && !hit) --left_;
    now_ = hit && left_ != 0;
  }

 private:
  std::optional<Level> held_;
  std::uint64_t cut_ = 0;
  NodeId node_ = kAllNodes;
  Field field_ = Field::kIdle;
  unsigned index_ = 0;
  Effect effect_ = Effect::kFlip;
  unsigned left_ = 0;
  bool now_ = false;
  PlaceTracker place_;
};

}  // namespace vericansim
