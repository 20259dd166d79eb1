// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Trigger skew: how far apart nodes act on one command, against the bound of RN-47.
#pragma once

#include <string>

#include "bus/types.hpp"

namespace vericansim {

/// What was measured on one or several buses.
struct TriggerSkew {
  unsigned triggers = 0;
  unsigned pairs = 0;  ///< of nodes, over all triggers
  unsigned lost = 0;   ///< triggers that some node did not act on exactly once
  unsigned above = 0;  ///< pairs beyond their bound
  Time largest = 0;    ///< skew, ps
  double part = 0;     ///< largest part of its bound that a pair needed
  std::string worst;   ///< and on which bus

  TriggerSkew &operator+=(const TriggerSkew &other);
};

/// `triggers` TRIGGER frames on a random bus: 2 to 16 nodes of `profile` on a line of up to 40 m,
/// clocks of 8 to 48 MHz with errors of up to 100 or 1,000 ppm, 125 kbit/s to 1 Mbit/s, sample
/// points at 75 %.
TriggerSkew measure_triggers(const std::string &profile, unsigned seed, unsigned triggers);

}  // namespace vericansim
