// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares the signals of a run with what its scenario expects.
#pragma once

#include <vector>

#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// One result for each expectation of a signal. A signal that was never there fails all but a count
/// of 0.
[[nodiscard]] std::vector<CheckResult> check_signals(const std::vector<SignalExpectation> &expect,
                                                     const SignalReport &seen);

}  // namespace vericansim
