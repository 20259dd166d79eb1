// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AhbMaster: an AHB-Lite master that queues transfers and runs them clock by clock.
#pragma once

#include <coroutine>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "node/bus_master.hpp"

namespace vericansim {

/// The master. In each clock cycle request() is driven, and at its end the slave's response is
/// handed to clock(). Queued transfers follow each other back to back, address phase over data
/// phase.
class AhbMaster final : public BusMaster {
 public:
  using BusMaster::BusMaster;

  /// Submits a burst of words; `data` is written, or only gives the number of beats if `write` is
  /// false. Returns the ticket of the first beat, those of the others follow it.
  Ticket submit_burst(std::uint32_t address, AhbBurst burst, bool write,
                      const std::vector<std::uint32_t> &data);

  [[nodiscard]] bool active() const override { return in_data_phase_ || !queue_.empty(); }
  [[nodiscard]] const AhbRequest &request() const { return request_; }
  /// End of a clock cycle in which request() was driven. May resume waiting coroutines.
  void clock(const AhbResponse &response);
  void reset() override;

  /// Called at the end of each clock cycle in which the master is active, with what it drove and
  /// what it got; an empty function ends it.
  using Watcher = std::function<void(const AhbRequest &, const AhbResponse &)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  [[nodiscard]] const AhbChecker &checker() const { return checker_; }
  [[nodiscard]] const BusReport &report() const override { return checker_.report(); }

 private:
  struct Pending {
    AhbTransfer transfer;
    std::coroutine_handle<> waiter = nullptr;
  };

  Ticket enqueue(const AhbTransfer &transfer, std::coroutine_handle<> waiter) override;
  void next_address_phase();

  std::deque<Pending> queue_;  // the front one is in its address phase if driving_
  Pending data_phase_;
  bool in_data_phase_ = false;
  bool driving_ = false;
  unsigned waits_ = 0;
  AhbRequest request_;
  AhbChecker checker_;
  Watcher watcher_;
};

}  // namespace vericansim
