// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncLoop: a case without RTL (TM-121, model): oscillators, clock registers and stamps in closed
// form, frames with arbitration delays; messages and servo are those of the C driver.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "timesync/bus_traffic.hpp"
#include "timesync/clock_node.hpp"
#include "timesync/hardware_follower.hpp"
#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"
#include "verican/servo.h"
#include "verican/tsyn.h"

namespace vericansim {

/// One seed of a case, interval by interval.
class SyncLoop {
 public:
  SyncLoop(const SyncCase &setting, std::uint64_t seed);

  /// All intervals of the case, one after the other.
  const SyncRun &run();
  /// `interval_s` later the master sends; followers of which lost() is true miss the pair.
  void sync(double interval_s, const std::function<bool(unsigned)> &lost = {});

  std::vector<ClockNode> nodes;  ///< the first is the master, until it is cut off
  std::vector<verican_servo_t> servos;
  SyncRun result;
  Nanoseconds now = 1e6;  ///< when the last SYNC was due, or could go out
  std::function<void(unsigned follower, const verican_correction_t &)> on_correction;

 private:
  /// A SYNC and its FUP on the bus.
  struct Pair {
    std::uint8_t sync[8], fup[8];
    bool has_sync, has_fup;
    Nanoseconds edge;     ///< the reference edge of SYNC, at the master's transmit flip-flop
    Nanoseconds handled;  ///< when the followers correct their clocks
  };
  void cut_master();
  [[nodiscard]] OscillatorError error_of(unsigned node);
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] Pair send();
  [[nodiscard]] std::uint64_t master_stamp(std::int64_t sent, Nanoseconds edge);
  void follow(unsigned n, const Pair &pair);
  void follow_in_hardware(unsigned n, const Pair &pair, std::uint64_t stamp);
  verican_tsyn_heard_t receive(unsigned n, const std::uint8_t (&data)[8], std::uint64_t stamp,
                               verican_sync_pair_t &pair);
  void correct(unsigned n, verican_sync_pair_t &pair, std::int64_t edge, Nanoseconds t);
  [[nodiscard]] std::uint8_t state_of(unsigned n, std::uint64_t clock);
  void look(Nanoseconds t);

  SyncCase setting_;
  std::mt19937_64 dice_;
  BusTraffic traffic_;
  verican_tsyn_rules_t rules_{};
  verican_tsyn_sender_t sender_{};
  std::vector<verican_tsyn_receiver_t> receivers_;
  std::vector<HardwareFollower> hardware_;  // instead of servos, or empty
  Nanoseconds looked_ = 0;                  // the last look, nothing is before it
  unsigned master_ = 0;                     // of nodes
};

/// Runs a seed of a case by the model.
[[nodiscard]] SyncRun run_by_model(const SyncCase &setting, std::uint64_t seed);

}  // namespace vericansim
