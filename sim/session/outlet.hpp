// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Outlet: the programs of the host at one node, as a session deals with them.
#pragma once

#include <poll.h>

#include <span>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

struct RunReport;

/// One thread; nothing blocks. The session polls the descriptors of all its outlets between two
/// stretches of simulation.
class Outlet {
 public:
  virtual ~Outlet() = default;

  /// What users call it, for example "vcan0".
  [[nodiscard]] virtual const std::string &name() const = 0;
  /// Simulated time is now `now`; called once a round, before poll_set().
  virtual void tick(Time now) = 0;
  /// Appends what to poll for. `wants_room`: a message was refused.
  virtual void poll_set(std::vector<pollfd> &set, bool wants_room) = 0;
  /// Looks after connections, with what poll() said of its part of the set.
  virtual void service(std::span<const pollfd> ready) = 0;
  /// Gives messages to the programs; false if they have no room for one now.
  virtual bool give() = 0;
  /// Takes messages of programs as long as the node has room.
  virtual void take() = 0;
  /// True while so much waits for the programs that simulated time has to stand still.
  [[nodiscard]] virtual bool stalled() const = 0;
  /// True: the programs have planned something for a later simulated time, so time has to go on.
  [[nodiscard]] virtual bool awaits_time() const = 0;
  /// False while nobody can be reached (interface down or gone).
  [[nodiscard]] virtual bool up() const = 0;
  /// True: the session is over when it goes down.
  [[nodiscard]] virtual bool ends_when_down() const { return false; }
  /// Lets a bus-off node recover.
  virtual void restart() {}
  /// The session is over and all has been given: last words to the programs, and what is known only
  /// then.
  virtual void close(RunReport &report) { (void)report; }
};

}  // namespace vericansim
