// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Replay: recorded traffic to a bus of Verilated cores; every node must receive every frame,
// bit-exact and in order.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/bus_monitor.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"
#include "trace/log.hpp"

namespace vericansim {

struct ReplayOptions {
  unsigned nodes = 2;      ///< 2..64
  unsigned senders = 1;    ///< 1..nodes: identifiers are shared out among the first ones
  double bitrate = 500e3;  ///< bit/s
  double clock_hz = 8e6;   ///< of every node
  double ppm = 100;        ///< clocks are spread evenly over +-ppm
  double cable_m = 0;      ///< between the two ends of the bus; nodes sit evenly between
  unsigned num_mb = 64;
  bool fast = false;      ///< as fast as the bus allows instead of as recorded
  std::size_t limit = 0;  ///< frames to take from the log, 0: all
  Outputs outputs = {};
  Fault *fault = nullptr;  ///< put on the bus, to see that a lost frame is noticed
  std::string file = {};   ///< name of the recording, for people; may be empty
};

/// What one node has received.
struct ReplayNode {
  std::string name;
  NodeCounts counts;
  std::uint64_t to_send = 0;   ///< frames of the log that it had to send
  std::uint64_t sent = 0;      ///< of these, on the bus and acknowledged
  std::uint64_t expected = 0;  ///< frames of the others
  std::uint64_t received = 0;
  bool complete = false;  ///< all of them, bit-exact; those of one sender in the order of the log
  std::string first_difference;  ///< empty if complete
};

struct ReplayReport {
  std::size_t frames = 0;  ///< to be sent
  std::size_t on_bus = 0;  ///< seen on the bus by the passive decoder
  std::uint64_t error_frames = 0;
  std::size_t skipped = 0;  ///< entries of the log that are no classical frames
  Time recorded = 0;        ///< time between the first and the latest frame in the log
  Time duration = 0;        ///< simulated
  double load = 0;
  double wall_seconds = 0;
  std::uint64_t node_cycles = 0;
  bool interrupted = false;  ///< the user has ended it; what had not come by then is not missing
  std::string failure;       ///< why not all was sent; empty: all was
  Time longest_gap = 0;      ///< between two frames of the log
  std::vector<ReplayNode> nodes;
  RunReport run;  ///< the same run, as that of any scenario
  [[nodiscard]] bool ok() const;
};

/// The scenario that `options` stand for: plain nodes, of which the first ones send the log.
/// Throws InputError if no bit timing fits; std::invalid_argument for a number of nodes or senders
/// that a bus cannot have.
[[nodiscard]] Scenario replay_scenario(const CanLog &log, const ReplayOptions &options);

/// The scenario `bus` with nodes that send the log: `replay`, `replay2`..., which it may have or
/// not. Its traffic goes on until all is sent and firmware has ended; its own duration does not
/// count. Of `options` only clock, senders, limit, pace and name count. Throws InputError if
/// traffic is that of such a node, or the bus is full.
[[nodiscard]] Scenario replay_scenario(Scenario bus, const CanLog &log,
                                       const ReplayOptions &options);

/// Simulates, or ends early when the user wants it (stop_request.hpp). Throws InputError if no bit
/// timing fits or an output cannot be written.
[[nodiscard]] ReplayReport replay(const CanLog &log, const ReplayOptions &options,
                                  const std::function<void(double)> &progress = {});

}  // namespace vericansim
