// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FaultSet: the faults of a scenario on its bus.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "results/fault_report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// Makes the faults and keeps count of them. Scenario must outlive it, and it the bus.
class FaultSet {
 public:
  explicit FaultSet(const Scenario &scenario) : scenario_{scenario} {}

  /// Puts them on the bus; their times count from `start`. `prescaler`: clocks a quantum of a node.
  void add_to(Bus &bus, Time start, Time bit_time,
              const std::function<unsigned(NodeId)> &prescaler);
  /// What became of each fault until `end`.
  [[nodiscard]] std::vector<FaultReport> report(Time end) const;

 private:
  [[nodiscard]] std::unique_ptr<Fault> make(const FaultSpec &spec,
                                            const std::function<unsigned(NodeId)> &prescaler) const;
  [[nodiscard]] std::string victim(NodeId node) const;
  [[nodiscard]] Window on_bus(const Window &window) const;
  [[nodiscard]] Time clock_until(const FaultSpec &spec, Time end) const;

  const Scenario &scenario_;
  Time start_ = 0;
  std::vector<FaultLog> logs_;  // of each fault of the scenario
  std::vector<std::unique_ptr<Fault>> faults_;
};

}  // namespace vericansim
