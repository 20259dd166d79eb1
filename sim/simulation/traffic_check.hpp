// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Traffic that can never be sent, as far as the whole scenario shows it.
#pragma once

#include "scenario/scenario.hpp"

namespace vericansim {

/// Refuses the first message that can never be sent: its node only listens, or it begins when
/// nothing is queued any more. Throws InputError with file, line, reason and what is allowed.
void check_traffic(const Scenario &scenario);

}  // namespace vericansim
