// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults that can never hit, as far as the whole scenario shows it.
#pragma once

#include "scenario/scenario.hpp"

namespace vericansim {

/// Refuses the first fault that can never take effect at `bitrate` (bit/s). Only what is certain is
/// refused: retransmissions and misread bits can bring places about that no undisturbed frame has.
/// Throws InputError with file, line, reason and what is allowed.
void check_faults(const Scenario &scenario, double bitrate);

}  // namespace vericansim
