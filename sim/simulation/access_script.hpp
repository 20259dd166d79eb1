// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AccessScript: does a node's register accesses of a scenario when they are due.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/rtl_node.hpp"
#include "node/task.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// The accesses of one node, in the order of their times, one at a time; other software on the node
/// may have its own in between. Must outlive the bus's actions, and be gone before the node.
class AccessScript {
 public:
  AccessScript(RtlNode &node, Bus &bus) : node_{node}, bus_{bus} {}
  ~AccessScript();
  AccessScript(const AccessScript &) = delete;
  AccessScript &operator=(const AccessScript &) = delete;

  /// `when`: on the bus's clock, not in the past.
  void add(const AccessSpec &spec, Time when);

  /// One for each `check` that failed, each `until` that has not come true, and what was to be
  /// checked or awaited and has not been; all of a spec whose time has not come, too.
  [[nodiscard]] std::vector<CheckResult> failures() const;
  /// Accesses done.
  [[nodiscard]] std::uint64_t accesses() const { return accesses_; }

 private:
  Task<> serve();
  Task<> run(const AccessSpec *spec);
  Task<bool> step(AccessStep step);
  Task<std::uint32_t> read(std::uint32_t address);
  Task<> write(std::uint32_t address, std::uint32_t data);
  void failed(const AccessStep &step, std::uint32_t seen);
  void add_undone(const AccessStep &step, std::vector<CheckResult> &all) const;

  RtlNode &node_;
  Bus &bus_;
  std::vector<const AccessSpec *> ahead_;  // their time has not come
  std::deque<const AccessSpec *> due_;     // the first one is under way
  std::size_t steps_done_ = 0;             // of that one
  std::vector<CheckResult> failures_;
  std::uint64_t accesses_ = 0;
  bool serving_ = false;
  Task<> task_;
};

}  // namespace vericansim
