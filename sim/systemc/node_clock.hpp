// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeClock: the oscillator of a node as a SystemC signal.
#pragma once

#include <systemc>

#include "bus/clock.hpp"

namespace vericansim {

/// Drives `out`: rising edges exactly where the simulator's Clock has them (frequency, error in
/// ppm, phase, wander), falling ones half a period later. SystemC's sc_clock rounds its period to 1
/// ps and drifts by that.
class NodeClock : public sc_core::sc_module {
 public:
  NodeClock(const sc_core::sc_module_name &name, const ClockConfig &config);

  sc_core::sc_out<bool> out{"out"};

 private:
  void toggle();

  Clock clock_;
  bool high_ = false;
};

}  // namespace vericansim
