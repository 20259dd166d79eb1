// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RunReport: what a simulation has shown, for people and for machines.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/types.hpp"
#include "judge/bus_judge.hpp"
#include "model/bus_monitor.hpp"
#include "results/board_report.hpp"
#include "results/fault_report.hpp"
#include "results/port_report.hpp"
#include "results/remote_report.hpp"
#include "results/replay_result.hpp"
#include "signals/signal_statistics.hpp"
#include "trace/identifiers.hpp"

namespace vericansim {

/// A message of the scenario: how often it went out and how long it took.
struct MessageReport {
  std::string name;
  std::string node;
  std::uint64_t queued = 0;
  std::uint64_t sent = 0;
  Time shortest = 0, longest = 0,
       sum = 0;      ///< response times: from the event to the end of the frame, ps
  Time waiting = 0;  ///< since the event of the frame that has waited longest and not left, ps
  std::optional<Time> bound;  ///< analytic worst case
  bool unsaid = false;        ///< never queued, and no check says so
  [[nodiscard]] Time mean() const { return sent == 0 ? 0 : sum / static_cast<Time>(sent); }
};

struct NodeReport {
  std::string name;
  NodeCounts counts;
  std::uint64_t received = 0;  ///< by the software; valid frames if it is not ours
  std::uint64_t overruns = 0;
  std::uint64_t bus_transfers = 0;  ///< AHB
  unsigned max_wait_states = 0;
  std::vector<std::string> ahb_violations;
  bool own_software = true;  ///< false: firmware drives the core
  /// "active", "passive" or "bus-off".
  [[nodiscard]] std::string state() const;
};

/// One expectation.
struct CheckResult {
  std::string what;
  std::string wanted;
  std::string seen;
  bool ok = true;
};

/// A script keeps so many of its failures: the first ones tell what is wrong.
inline constexpr std::size_t kMostFailures = 20;

struct RunReport {
  std::string name;
  double bitrate = 0;
  Time duration = 0;                 ///< simulated, from the moment when all nodes are on the bus
  std::uint64_t frames = 0;          ///< acknowledged
  std::uint64_t unacknowledged = 0;  ///< complete, but nobody is there to say so
  std::uint64_t error_frames = 0, overload_frames = 0;
  std::uint64_t pending = 0;  ///< frames that were queued and have not left
  double load = 0;            ///< 0..1
  double analytic_load = 0;   ///< worst-case bits, 0 without analysis
  double wall_seconds = 0;
  std::uint64_t node_cycles = 0;
  std::vector<MessageReport> messages;
  std::string no_bound;  ///< why no message has a bound that was asked for; empty: they have
  std::vector<NodeReport> nodes;
  std::vector<firmware::BoardReport> boards;
  std::vector<ReplayResult> replays;
  std::vector<PortReport> ports;          ///< with programs of the host as nodes
  std::vector<SocketcandCounts> servers;  ///< one for each address
  std::optional<PaceReport> pace;         ///< held to real time, or with programs of the host
  std::vector<FaultReport> faults;
  RemoteReport remote;  ///< with remote nodes
  std::vector<CheckResult> checks;
  bool interrupted = false;   ///< the user has ended it before its time; nothing was checked then
  bool show_signals = false;  ///< in the text
  SignalReport signals;       ///< with databases
  bool show_identifiers = false;  ///< in the text
  IdentifierTable identifiers;    ///< of the acknowledged frames; times since the scenario's start
  std::optional<JudgeCounts> judged;  ///< with `judge: lockstep`
  /// Not interrupted, and all checks are well.
  [[nodiscard]] bool ok() const;
};

/// The tables that the user has asked for: signals, identifiers. Each ends with an empty line.
[[nodiscard]] std::string tables_text(const RunReport &report);
/// A table for people, as lines.
[[nodiscard]] std::string to_text(const RunReport &report);
/// Everything, times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const RunReport &report);

}  // namespace vericansim
