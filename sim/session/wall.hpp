// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Wall: the real time in which the programs of the host live; tests put one of their own in place.
#pragma once

#include <poll.h>

#include <optional>
#include <vector>

#include "session/pacer.hpp"
#include "simulation/stop_request.hpp"

namespace vericansim {

/// Real time, and waiting in it.
class Wall {
 public:
  virtual ~Wall() = default;
  [[nodiscard]] virtual WallTime now() = 0;
  /// Waits until a descriptor of `set` is ready (revents say which), `timeout` ns have passed
  /// (unset: for ever), or somebody wants the end.
  virtual void wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) = 0;
  /// True once the user wants the end.
  [[nodiscard]] virtual bool stop_requested() = 0;
  /// True once since the last call if the user has asked for a restart of bus-off nodes.
  [[nodiscard]] virtual bool restart_requested() { return false; }
};

/// The steady clock and poll(); the end is wanted when stop_requested() of stop_request.hpp says
/// so.
class SteadyWall : public Wall {
 public:
  [[nodiscard]] WallTime now() override;
  void wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) override;
  [[nodiscard]] bool stop_requested() override;
};

/// The steady clock, poll(), and signals: SIGINT and SIGTERM ask for the end (StopSignals), SIGUSR1
/// restarts bus-off nodes. One at a time; the destructor puts back what the signals did before.
class HostWall : public SteadyWall {
 public:
  HostWall();
  ~HostWall() override;
  HostWall(const HostWall &) = delete;
  HostWall &operator=(const HostWall &) = delete;
  void wait(std::vector<pollfd> &set, std::optional<WallTime> timeout) override;
  [[nodiscard]] bool restart_requested() override;

 private:
  StopSignals signals_;
};

}  // namespace vericansim
