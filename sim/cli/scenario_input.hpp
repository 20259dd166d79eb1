// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files of the command line.
#pragma once

#include <string>

#include "scenario/scenario.hpp"

namespace vericansim::cli {

/// read_scenario(), with its warnings on standard error.
[[nodiscard]] Scenario scenario_input(const std::string &path);

}  // namespace vericansim::cli
