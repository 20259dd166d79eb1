// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Disturbances: when and where a bus is disturbed from outside, so that a judge of the whole bus
// knows what it may demand.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "bus/faults.hpp"

namespace vericansim {

/// The disturbances of a run: planned faults, and nodes that are stopped by their software.
class Disturbances {
 public:
  /// `node` (kAllNodes: everybody) is disturbed in `window`.
  void add(NodeId node, Window window) {
    first_ = std::min(first_, window.from);
    longest_ = std::max(longest_, window.to - window.from);
    const auto later = [](const Entry &e, Time from) { return e.window.from < from; };
    list_.insert(std::lower_bound(list_.begin(), list_.end(), window.from, later), {node, window});
  }

  /// There is none before `time`.
  [[nodiscard]] bool none_before(Time time) const { return first_ >= time; }
  /// Somebody is disturbed between `from` and `to`.
  [[nodiscard]] bool any(Time from, Time to) const {
    return find(from, to, [](const Entry &) { return true; });
  }
  /// This node is disturbed between `from` and `to`.
  [[nodiscard]] bool of(NodeId node, Time from, Time to) const {
    return find(from, to, [node](const Entry &e) { return e.node == node || e.node == kAllNodes; });
  }

 private:
  struct Entry {
    NodeId node;
    Window window;
  };

  // The list is in the order of the beginnings; none that began earlier than the longest lasts
  // reaches into the span.
  template <typename Wanted>
  bool find(Time from, Time to, Wanted wanted) const {
    const auto earlier = [](const Entry &e, Time time) { return e.window.from < time; };
    const Time earliest = longest_ > from ? std::numeric_limits<Time>::min() : from - longest_;
    for (auto e = std::lower_bound(list_.begin(), list_.end(), earliest, earlier);
         e != list_.end() && e->window.from < to; ++e) {
      if (e->window.to > from && wanted(*e)) return true;
    }
    return false;
  }

  std::vector<Entry> list_;
  Time first_ = std::numeric_limits<Time>::max();
  Time longest_ = 0;
};

}  // namespace vericansim
