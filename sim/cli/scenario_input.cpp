// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See scenario_input.hpp.
#include "cli/scenario_input.hpp"

#include "cli/print_error.hpp"
#include "scenario/scenario_warnings.hpp"

namespace vericansim::cli {

Scenario scenario_input(const std::string &path) {
  Scenario scenario = read_scenario(path);
  for (const std::string &warning : warnings_of(scenario))
    print_error("verican: warning: {}: {}\n", path, warning);
  return scenario;
}

}  // namespace vericansim::cli
