// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulation: the bus of a scenario with everything on it, step by step; run_scenario() is the
// simple use of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "judge/bus_judge.hpp"
#include "model/bus_monitor.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"
#include "simulation/access_script.hpp"
#include "simulation/bus_outputs.hpp"
#include "simulation/fault_set.hpp"
#include "simulation/remote_bench.hpp"
#include "simulation/sent_frames.hpp"
#include "simulation/station.hpp"
#include "simulation/traffic_source.hpp"

namespace vericansim {

/// A simulation: construct, join(), start(), run the bus, finish(). Members are in the order of
/// their lifetimes: the bus refers to all others.
class Simulation {
 public:
  /// Builds the bus at one of the scenario's bit rates and opens its outputs. Nodes whose role says
  /// so get no software of ours: somebody else drives their registers. The scenario must outlive
  /// the simulation. Throws InputError if a node cannot have the bit rate, a fault can never
  /// hit (check_faults()), traffic never be sent (check_traffic()) or an output not be written.
  Simulation(const Scenario &scenario, double bitrate);

  /// Runs until the nodes with software are on the bus. std::runtime_error if one fails.
  void join();
  /// Runs until `when` (not in the past); the times of the scenario count from there.
  void start(Time when);
  /// Lets frames that wait go out for the scenario's drain, and the last one be received.
  void drain();
  /// The same until `limit`, a time of the bus.
  void drain(Time limit);
  /// True while nothing is under way: the nodes with software are idle, or bus-off for good, and
  /// have nothing to send. What the scenario will do later does not count: see Bus::has_actions().
  [[nodiscard]] bool quiet() const;
  /// Lets the monitor see the bus up to now, so that the last frame is told, which no edge follows.
  void settle() { monitor_->advance(bus_.now()); }
  /// Ends the waveforms and says what happened since start(). `interrupted`: before its time, so
  /// that its expectations are not judged.
  [[nodiscard]] RunReport finish(bool interrupted = false);
  /// Rethrows what went wrong in the software of a node.
  void check() { stations_.check(); }

  /// Told of each frame and each event of the bus, besides the simulation's own use (BusMonitor).
  std::function<void(const BusFrame &)> on_bus_frame;
  std::function<void(const BusEvent &)> on_bus_event;
  /// Told of each frame that the simulation's own software of a node has received, and sent.
  std::function<void(NodeId, const Frame &)> on_host_received;
  std::function<void(NodeId)> on_host_sent;
  /// Adds what others know to the report, before the expectations are checked.
  std::function<void(RunReport &)> on_report;

  [[nodiscard]] Bus &bus() { return bus_; }
  /// The core of a node; not of a remote node.
  [[nodiscard]] RtlNode &node(NodeId id) { return *stations_[id].node; }
  /// The remote node with this number; nullptr: it is a core.
  [[nodiscard]] RemoteUnit *remote(NodeId id) { return stations_[id].remote.get(); }
  /// The simulation's own software of a node that has it (NodeSpec::hosted()).
  [[nodiscard]] Host &host(NodeId id) { return *stations_[id].host; }
  [[nodiscard]] const NodeCounts &counts(NodeId id) const { return monitor_->node(id); }
  /// Acknowledged frames that the bus has seen so far, see settle().
  [[nodiscard]] std::uint64_t frames() const { return monitor_->frames(); }
  /// Whether the cores store remote frames in receive buffers; valid after join().
  [[nodiscard]] bool stores_remote() const { return stations_.stores_remote(); }
  [[nodiscard]] const Scenario &scenario() const { return scenario_; }
  [[nodiscard]] double bitrate() const { return bitrate_; }
  [[nodiscard]] Time started() const { return start_; }
  /// The judges, if the scenario wants them.
  [[nodiscard]] const BusJudge *judge() const { return judge_.get(); }

 private:
  void build_stations();
  void observe();
  void start_traffic();
  void start_accesses();
  void set_up_judge();
  void add_disturbances();
  void judge_software(NodeId id);
  void add_judgement(RunReport &report) const;
  void on_frame(const BusFrame &frame);
  [[nodiscard]] FrameOrigin origin_of(const BusFrame &frame);
  [[nodiscard]] FrameOrigin origin_at(NodeId node, const BusFrame &frame);
  [[nodiscard]] std::optional<std::size_t> message_of(NodeId node, const Frame &frame) const;
  void forget_lost(NodeId node, Time time);
  [[nodiscard]] ReportSetup report_setup() const;
  [[nodiscard]] ReportExtras report_extras(const RunReport &report) const;
  void on_sent(NodeId node, const Frame &frame);
  RunReport collect(bool interrupted);
  void check_all(RunReport &report);
  void add_bounds(RunReport &report) const;

  const Scenario &scenario_;
  double bitrate_;
  Time bit_time_;
  Stations stations_;
  std::vector<std::unique_ptr<AccessScript>> scripts_;  // one for each node that has accesses
  std::unique_ptr<BusJudge> judge_;
  FaultSet faults_;
  std::vector<SentFrames> sent_;  // of each node
  std::vector<std::unique_ptr<TrafficSource>> traffic_;
  std::unique_ptr<RemoteBench> remote_;
  std::vector<BusFrame> frames_;
  std::unique_ptr<BusMonitor> monitor_;
  std::unique_ptr<BusOutputs> outputs_;
  Bus bus_;
  Time start_ = 0;
};

}  // namespace vericansim
