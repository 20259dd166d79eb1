// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteBench: everything of a simulation that has to do with remote nodes.
#pragma once

#include <memory>
#include <vector>

#include "results/report.hpp"
#include "scenario/scenario.hpp"
#include "simulation/remote_script.hpp"
#include "simulation/remote_story.hpp"
#include "simulation/remote_user.hpp"
#include "simulation/remote_watch.hpp"
#include "simulation/station.hpp"

namespace vericansim {

/// Hosts' commands, nodes' user logic, and what is seen of them. Must outlive the bus's actions.
class RemoteBench {
 public:
  RemoteBench(const Scenario &scenario, Stations &stations, Bus &bus);
  RemoteBench(const RemoteBench &) = delete;
  RemoteBench &operator=(const RemoteBench &) = delete;

  /// Times of the scenario count from `start`; nothing new begins at `stop` or later.
  void start(Time start, Time stop);
  void on_received(NodeId node, const Frame &frame);
  /// A frame has ended on the bus, which has been held for `busy` up to then.
  void on_frame(const BusFrame &frame, Time busy);
  /// Adds nodes and messages to the report; to be called once the run is over.
  void describe(RunReport &report);
  /// Adds what was expected, and commands that have failed.
  void check(RunReport &report) const;
  /// For the page of a report; nullptr without remote nodes.
  [[nodiscard]] const RemoteColumns *columns() const {
    return story_ ? &story_->columns() : nullptr;
  }

 private:
  void watch(Bus &bus);
  void add_user(const UserSpec &spec, Bus &bus);
  [[nodiscard]] std::size_t unit_of(NodeId node) const;
  void check_numbers(RunReport &report) const;
  void check_bytes(RunReport &report) const;
  void add_bounds(RemoteReport &report, Time bit_time) const;

  const Scenario &scenario_;
  Stations &stations_;
  std::vector<NodeId> nodes_;  // of the units, in the order of the watch
  std::vector<std::unique_ptr<RemoteScript>> scripts_;
  std::vector<std::unique_ptr<RemoteUser>> users_;
  std::unique_ptr<RemoteWatch> watch_;
  std::unique_ptr<RemoteStory> story_;  // if there are remote nodes
};

}  // namespace vericansim
