// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of a scenario in words.
#pragma once

#include <cstddef>
#include <string>

#include "scenario/scenario.hpp"

namespace vericansim {

/// The name of a fault: its own, or kind and place in the list, "flip 3".
[[nodiscard]] std::string fault_name(const Scenario &scenario, std::size_t index);
/// The word for the kind of a fault in a scenario file.
[[nodiscard]] std::string fault_kind(const FaultSpec &fault);
/// What a fault does, where and when, in words.
[[nodiscard]] std::string fault_text(const Scenario &scenario, const FaultSpec &fault);

}  // namespace vericansim
