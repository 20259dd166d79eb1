// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeClock: see node_clock.hpp.
#include "systemc/node_clock.hpp"

#include "systemc/time.hpp"

namespace vericansim {

NodeClock::NodeClock(const sc_core::sc_module_name &name, const ClockConfig &config)
    : sc_core::sc_module{name}, clock_{config} {
  check_time_resolution();
  SC_HAS_PROCESS(NodeClock);
  SC_METHOD(toggle);
}

void NodeClock::toggle() {
  const Time now = to_ps(sc_core::sc_time_stamp());
  if (high_) {
    high_ = false;
  } else if (clock_.next() == now) {
    high_ = true;
    clock_.tick();
  }
  out.write(high_);
  const Time wait = clock_.next() - now;
  next_trigger(to_sc_time(high_ ? wait / 2 : wait));
}

}  // namespace vericansim
