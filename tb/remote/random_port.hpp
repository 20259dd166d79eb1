// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random commands, errors and accesses at the engine's port of a remote node (RN-101).
#pragma once

#include "remote/port_lockstep.hpp"
#include "remote/random_host.hpp"

namespace vericansim {

/// One of them, for RTL and model alike. True: it was a command.
inline bool random_port_step(PortLockstep &pair, RandomHost &host) {
  switch (host.upto(16)) {
    case 0: pair.ms(); return false;
    case 1: pair.user_write(host.upto(1024), host.upto(~0U), host.upto(16)); return false;
    case 2: pair.turn(FramePort::End::kError); return false;
    case 3:
      if (!pair.turn(FramePort::End::kLost)) return false;
      pair.receive(host.frame());
      return true;
    case 4: pair.receive_broken(host.frame(), host.upto(9)); return false;
    case 5: pair.set_counters(host.upto(200), host.upto(200)); return false;
    case 6:
    case 7:
    case 8: pair.turn(); return false;
    default: pair.receive(host.frame()); return true;
  }
}

}  // namespace vericansim
