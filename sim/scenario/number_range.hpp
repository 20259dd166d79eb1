// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Range: limits of a number that a scenario expects.
#pragma once

#include <limits>

namespace vericansim {

/// Inclusive limits of a number.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool whole = false;  ///< it counts things
  [[nodiscard]] bool contains(double value) const { return value >= least && value <= most; }
};

}  // namespace vericansim
