// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the checks of a whole scenario share (check_faults(), check_traffic()).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "scenario/scenario.hpp"

namespace vericansim {

/// A time as a scenario would write it.
inline std::string ms_text(Time time) {
  return fmt::format("{:.10g} ms", static_cast<double>(time) / kMillisecond);
}

/// Whether accesses of its CPU are given, which may take the node out of any mode.
inline bool has_accesses(const Scenario &scenario, NodeId node) {
  return std::any_of(scenario.accesses.begin(), scenario.accesses.end(),
                     [node](const AccessSpec &access) { return access.node == node; });
}

}  // namespace vericansim
