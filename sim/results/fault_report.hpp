// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FaultReport: what became of a fault of the scenario, for people, for machines, for the page.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "bus/fault_log.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// A fault and how often it took effect (FaultLog).
struct FaultReport {
  std::string name;
  std::string kind;           ///< the word in the file
  std::string node;           ///< victim, "all", or "wire" for the observation point
  NodeId id = kAllNodes;      ///< the same
  std::string text;           ///< what it does, where and when
  std::size_t line = 0;       ///< in the file; 0: in none
  bool unsaid = false;        ///< it never took effect, and no check says so
  std::uint64_t hits = 0;     ///< bit times
  std::vector<Window> times;  ///< from the start of the scenario, ps: FaultLog::stretches()
  bool more = false;          ///< there are more times
};

/// A table for people, as lines; empty without faults.
[[nodiscard]] std::string faults_text(const std::vector<FaultReport> &faults);
/// Everything, times in picoseconds.
[[nodiscard]] nlohmann::ordered_json faults_json(const std::vector<FaultReport> &faults);
/// `meta.faults` of a page (docs/report-format.md), times in nanoseconds.
[[nodiscard]] nlohmann::ordered_json faults_meta(const std::vector<FaultReport> &faults);

}  // namespace vericansim
