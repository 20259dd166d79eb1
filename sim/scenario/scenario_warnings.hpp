// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scenario may say, but hardly anybody means.
#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace vericansim {

/// Remote nodes that share a number or a serial number (RN-11), and filters that do not stay what
/// they are, a line each.
[[nodiscard]] std::vector<std::string> warnings_of(const Scenario &scenario);

}  // namespace vericansim
