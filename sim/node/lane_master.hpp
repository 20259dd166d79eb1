// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LaneMaster: what the masters of buses with byte lanes share: queue, tickets, results.
#pragma once

#include <coroutine>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>

#include "node/bus_master.hpp"

namespace vericansim {

/// The queue. Masters take from its front what they drive next, and tell how it ended.
class LaneMaster : public BusMaster {
 public:
  using BusMaster::BusMaster;

 protected:
  /// A transfer on its way.
  struct Access {
    AhbTransfer transfer;
    std::coroutine_handle<> waiter = nullptr;
    Ticket ticket = 0;
    unsigned waits = 0;
    unsigned late = 0;
  };

  /// Something is queued.
  [[nodiscard]] bool waiting() const { return !queue_.empty(); }
  /// The next one, if there is one and its pause is over.
  [[nodiscard]] const AhbTransfer *front() const {
    return queue_.empty() || queue_.front().transfer.pause != 0 ? nullptr
                                                                : &queue_.front().transfer;
  }
  /// Takes the next one, for which front() is not null.
  Access take();
  /// A clock without a transfer.
  void idle();
  /// `access` has ended with the word `word` on the read data lines. Resumes who waits for it.
  void finish(const Access &access, std::uint32_t word, bool error);
  /// Forgets the queue; what is on its way the master forgets itself.
  void forget();
  /// Something has been queued: show it in the coming clock, if the bus is free.
  virtual void queued() = 0;

 private:
  Ticket enqueue(const AhbTransfer &transfer, std::coroutine_handle<> waiter) final;

  std::deque<Access> queue_;
  std::set<Ticket> ahead_;  // ended before one that was submitted before
};

}  // namespace vericansim
