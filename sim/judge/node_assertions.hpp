// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeAssertions: what must hold in every bit of every node, whatever the stimulus (rules TH-06,
// TH-07).
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "judge/node_bit.hpp"

namespace vericansim {

/// Watches one node bit by bit. It needs no model: it looks at levels, places and counters alone.
class NodeAssertions {
 public:
  /// Modes that some of the assertions depend on.
  struct Mode {
    bool listen_only = false;
    bool loop_back = false;
  };

  /// `broken` is told one clause for each broken assertion, as in "delivers elsewhere than at
  /// EOF6".
  explicit NodeAssertions(std::function<void(const std::string &)> broken)
      : broken_{std::move(broken)} {}

  /// The next bit. `pending`: a frame waits to be sent and has waited long enough to be seen.
  void look(const NodeBit &bit, const Mode &mode, bool pending);
  /// The counters were set from outside: the next difference is no step.
  void counters_preset() { first_ = true; }
  /// The node was stopped and begins anew.
  void restarted();

 private:
  void look_at_run(const NodeBit &bit);
  void look_at_dominant(const NodeBit &bit, const Mode &mode);
  void look_at_counters(const NodeBit &bit);
  void look_at_events(const NodeBit &bit);
  void look_at_own_frame(const NodeBit &bit);
  void look_at_liveness(const NodeBit &bit, const Mode &mode, bool pending);

  std::function<void(const std::string &)> broken_;
  NodeBit before_;     // the bit before
  bool first_ = true;  // there is none yet
  unsigned run_ = 0;   // equal bits sent in the own frame, up to the last bit
  Level run_level_ = Level::kDominant;
  bool flag_active_ = false;      // the flag under way is dominant
  unsigned silence_ = 0;          // TH-07: recessive bits between frames while a request waits
  std::vector<Level> own_frame_;  // bits of the own frame as seen, SOF..EOF7
};

}  // namespace vericansim
