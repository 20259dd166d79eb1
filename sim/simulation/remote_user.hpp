// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteUser: what the user logic of a remote node does in a scenario.
#pragma once

#include <cstdint>
#include <functional>

#include "bus/bus.hpp"
#include "node/remote_unit.hpp"
#include "scenario/remote_spec.hpp"

namespace vericansim {

/// One item of `user`. Must outlive the bus's actions.
class RemoteUser {
 public:
  /// `spec` must outlive it.
  RemoteUser(const UserSpec &spec, RemoteUnit &unit, Bus &bus)
      : spec_{spec}, unit_{unit}, bus_{bus} {}
  RemoteUser(const RemoteUser &) = delete;
  RemoteUser &operator=(const RemoteUser &) = delete;

  /// Begins at `start`; nothing new from `stop` on.
  void start(Time start, Time stop);
  /// apply_o has pulsed.
  void applied();
  /// Its time is behind the end, or the staged bytes that it waits for never came.
  [[nodiscard]] bool never_acts() const {
    return never_acts_ || (spec_.after_apply && times_ == 0);
  }

  [[nodiscard]] const UserSpec &spec() const { return spec_; }
  /// Called with the four bytes of each measurement of a plant when they are written.
  std::function<void(std::uint32_t)> on_measured;
  /// Called each time what it writes is in the memory.
  std::function<void()> on_written;

 private:
  void schedule(Time when);
  void act();
  void write(unsigned address, unsigned length, std::uint64_t bytes);
  void step_plant(const PlantSpec &plant);

  const UserSpec &spec_;
  RemoteUnit &unit_;
  Bus &bus_;
  Time stop_ = 0;
  bool never_acts_ = false;
  std::uint64_t times_ = 0;
  std::uint32_t current_ = 0;  // of the plant
};

}  // namespace vericansim
