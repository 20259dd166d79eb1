// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CycleMeter: what each cycle of a bus of remote nodes costs, and how soon its TRIGGER acts.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "model/bus_monitor.hpp"
#include "results/remote_report.hpp"

namespace vericansim {

/// A cycle is from one TRIGGER to the next.
class CycleMeter {
 public:
  /// A host wants to send `trigger` as soon as its frames before are gone.
  void commanded(const Frame &trigger, Time now) { asked_.push_back({trigger, now}); }
  /// A frame has ended on the bus, which has been held for `busy` up to then, its intermission
  /// included.
  void on_frame(const BusFrame &frame, bool trigger, Time busy);
  /// The last of the nodes has acted upon the last TRIGGER.
  void acted(Time last);
  /// Enters times, ps, and load of the cycles that are over; of none: 0.
  void describe(RemoteReport &report) const;

 private:
  struct Spread {
    Time shortest = 0, longest = 0, sum = 0;
    std::int64_t count = 0;
    void add(Time value);
  };
  struct Asked {
    Frame frame;
    Time time;
  };
  struct Cycle {
    Time end;  // of the TRIGGER's frame
    Time busy;
  };

  void begin_cycle(const BusFrame &frame, Time busy);

  std::deque<Asked> asked_;
  std::map<NodeId, Time> free_;  // when the last frame of a node had gone
  std::optional<Time> wanted_;   // since when the last TRIGGER could have been sent
  std::optional<Cycle> cycle_;   // under way
  Spread traffic_, period_, latency_;
};

}  // namespace vericansim
