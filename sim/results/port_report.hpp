// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortReport: what went between a node and the programs of the host, and in which time.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// What went through an interface.
struct PortCounts {
  std::uint64_t from_host = 0;  ///< frames of programs: sent, and to come
  std::uint64_t sent = 0;       ///< of these, on the bus and acknowledged
  std::uint64_t rejected = 0;   ///< messages of programs that are no frames of CAN 2.0
  std::uint64_t received = 0;   ///< frames of other nodes
  std::uint64_t filtered = 0;   ///< of these, kept from the programs by a filter
  std::uint64_t to_host = 0;    ///< frames given to the programs, echoes not counted
  std::uint64_t echoes = 0;
  std::uint64_t errors = 0;    ///< error messages given to the programs
  std::uint64_t away = 0;      ///< messages for the programs while nobody could be reached
  std::uint64_t overruns = 0;  ///< frames that the node's software was too slow for
  std::uint64_t bus_off = 0;
  std::uint64_t restarts = 0;
};

/// One interface.
struct PortReport {
  std::string name;
  bool monitor = false;
  bool up = true;
  bool bus_off = false;
  PortCounts counts;
  std::uint64_t lost = 0;     ///< by the operating system, on the way to the node
  std::uint64_t pending = 0;  ///< frames of programs that have not left
  std::uint64_t waiting = 0;  ///< messages that the programs have not taken
  /// No frame was lost.
  [[nodiscard]] bool ok() const { return lost == 0 && counts.overruns == 0; }
};

/// What a server did for its clients.
struct SocketcandCounts {
  std::uint64_t clients = 0;       ///< served
  std::uint64_t refused = 0;       ///< too many at once
  std::uint64_t too_slow = 0;      ///< closed because they did not read
  std::uint64_t bad_commands = 0;  ///< answered by an error
  std::uint64_t from_clients = 0;  ///< frames handed to the bus, of jobs too
  std::uint64_t to_clients = 0;    ///< frames and error messages, each client counted
  std::uint64_t undelivered = 0;   ///< messages for clients that were gone before they took them
  std::uint64_t missed = 0;        ///< periods of jobs for which the bus was too busy
  std::uint64_t given_up = 0;      ///< frames of clients that had left, too many for the server
  /// No frame was lost for a client that did not read, and none of those that have left.
  [[nodiscard]] bool ok() const { return too_slow == 0 && given_up == 0; }
};

/// Simulated time beside real time.
struct PaceReport {
  bool fast = false;                  ///< not held to real time
  double cpu_seconds = 0;             ///< of this process
  WallTime lag = 0, largest_lag = 0;  ///< ns
};

/// Tables for people, as lines.
[[nodiscard]] std::string to_text(const std::vector<PortReport> &ports);
[[nodiscard]] std::string to_text(const SocketcandCounts &counts);
/// "lag at the end 0.1 ms, largest 2.0 ms".
[[nodiscard]] std::string to_text(const PaceReport &pace);
[[nodiscard]] nlohmann::ordered_json to_json(const PortReport &port);
[[nodiscard]] nlohmann::ordered_json to_json(const SocketcandCounts &counts);
[[nodiscard]] nlohmann::ordered_json to_json(const PaceReport &pace);

}  // namespace vericansim
