// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run has shown of its remote nodes (RN-97, RN-98).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

struct RemoteNodeReport {
  std::string name;
  bool rtl = false;  ///< false: the model on a Verilated engine
  unsigned number = 0;
  std::string state;                        ///< at the end
  std::uint64_t went_safe = 0;              ///< times it left OPERATE
  Time last_safe = 0;                       ///< when, from the start of the scenario
  std::uint64_t accepted = 0, refused = 0;  ///< requests
  std::uint64_t applied = 0;                ///< TRIGGERs that made staged bytes visible
  std::uint64_t awaited = 0;                ///< TRIGGERs that had to: it was in OPERATE
  std::uint64_t lost_set_points = 0;  ///< TRIGGERs that did not, or showed others than were written
  std::uint64_t statements = 0;       ///< measurements of its user logic that were on the bus
  std::uint64_t late_statements = 0;  ///< and those that were not before the next TRIGGER
  /// From the action upon a TRIGGER to the end of the measurement's frame, ps.
  Time shortest = 0, longest = 0, sum = 0;
  std::optional<Time> bound;  ///< analytic worst case of that
};

/// A frame on a bus of remote nodes.
struct RemoteFrameReport {
  Time start = 0;     ///< from the start of the scenario, ps
  std::string words;  ///< "3: write 020 <- 5A"; empty: nothing to such nodes
};

struct RemoteReport {
  std::vector<RemoteNodeReport> nodes;
  std::uint64_t triggers = 0;            ///< on the bus
  std::uint64_t compared = 0;            ///< TRIGGERs upon which two nodes or more have acted
  Time skew_mean = 0, skew_longest = 0;  ///< first to last node, ps
  Time skew_bound = 0;                   ///< largest bound of a pair (RN-47)
  std::uint64_t above_bound = 0;         ///< TRIGGERs after which a pair was further apart
  Time period_shortest = 0, period_longest = 0;  ///< from action to action
  /// For how long the bus was held from one TRIGGER to the next, ps; the part of the time that is.
  Time traffic_shortest = 0, traffic_longest = 0, traffic_mean = 0;
  double cycle_load = 0;
  /// From when a host had nothing else to send than a TRIGGER to the last node's action, ps.
  Time latency_shortest = 0, latency_longest = 0;
  std::vector<std::string> hosts;         ///< nodes with commands; there should be one
  std::uint64_t commands = 0;             ///< steps of hosts that are done
  std::vector<RemoteFrameReport> frames;  ///< the first ones
  std::uint64_t more_frames = 0;          ///< that `frames` leaves out
  [[nodiscard]] bool empty() const { return nodes.empty(); }
  /// Sums over the nodes: refused, lost_set_points, late_statements; or triggers.
  [[nodiscard]] std::uint64_t total(const std::string &key) const;
  /// Why none could be counted there, as nothing happened of which it is a part; empty: some could.
  [[nodiscard]] std::string unseen(const std::string &key) const;
};

/// Tables for people; ends with an empty line.
[[nodiscard]] std::string to_text(const RemoteReport &report);
/// Everything, times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const RemoteReport &report);

}  // namespace vericansim
