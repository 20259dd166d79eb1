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

#include "node/ahb_checker.hpp"

namespace vericansim {

/// One transfer (one beat). Byte lanes are the master's work: `data` is right-aligned.
struct AhbTransfer {
  std::uint32_t address = 0;
  bool write = false;
  AhbSize size = AhbSize::kWord;
  std::uint32_t data = 0;
  std::uint8_t hprot = 0b0011;
  AhbBurst burst = AhbBurst::kSingle;
  AhbTrans trans = AhbTrans::kNonseq;  ///< kSeq for the later beats of a burst
  unsigned pause = 0;                  ///< cycles before it: BUSY before kSeq, IDLE before kNonseq
};

/// How a transfer ended.
struct AhbResult {
  std::uint32_t data = 0;  ///< read data, right-aligned
  bool error = false;      ///< ERROR response
  unsigned waits = 0;      ///< wait states of the data phase
};

/// The master. In each clock cycle request() is driven, and at its end the slave's response is
/// handed to clock(). Queued transfers follow each other back to back, address phase over data
/// phase.
class AhbMaster {
 public:
  /// Identifies a submitted transfer; its result stays available while the next 255 are submitted.
  using Ticket = std::uint64_t;

  /// `announce` is called before a transfer is queued.
  explicit AhbMaster(std::function<void()> announce = {}) : announce_{std::move(announce)} {}

  Ticket submit(const AhbTransfer &transfer) { return enqueue(transfer, nullptr); }
  /// Submits a burst of words; `data` is written, or only gives the number of beats if `write` is
  /// false. Returns the ticket of the first beat, those of the others follow it.
  Ticket submit_burst(std::uint32_t address, AhbBurst burst, bool write,
                      const std::vector<std::uint32_t> &data);
  [[nodiscard]] bool done(Ticket ticket) const { return ticket < completed_; }
  [[nodiscard]] const AhbResult &result(Ticket ticket) const { return results_[ticket % kKept]; }

  /// True if there is a transfer to drive or in its data phase.
  [[nodiscard]] bool active() const { return in_data_phase_ || !queue_.empty(); }
  [[nodiscard]] const AhbRequest &request() const { return request_; }
  /// End of a clock cycle in which request() was driven. May resume waiting coroutines.
  void clock(const AhbResponse &response);
  /// Forgets queued transfers and who waits for them (reset).
  void reset();

  /// Called at the end of each clock cycle in which the master is active, with what it drove and
  /// what it got; an empty function ends it.
  using Watcher = std::function<void(const AhbRequest &, const AhbResponse &)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  [[nodiscard]] const AhbChecker &checker() const { return checker_; }
  /// Statistics of the accesses and the protocol violations seen.
  [[nodiscard]] const AhbReport &report() const { return checker_.report(); }

  /// `co_await master.access(transfer)` yields the AhbResult.
  struct Awaiter {
    AhbMaster &master;
    AhbTransfer transfer;
    Ticket ticket = 0;
    [[nodiscard]] bool await_ready() const { return false; }
    void await_suspend(std::coroutine_handle<> handle) {
      ticket = master.enqueue(transfer, handle);
    }
    [[nodiscard]] AhbResult await_resume() const { return master.result(ticket); }
  };
  [[nodiscard]] Awaiter access(const AhbTransfer &transfer) { return Awaiter{*this, transfer}; }
  [[nodiscard]] Awaiter read(std::uint32_t address) { return access({.address = address}); }
  [[nodiscard]] Awaiter write(std::uint32_t address, std::uint32_t data) {
    return access({.address = address, .write = true, .data = data});
  }

 private:
  static constexpr std::size_t kKept = 256;

  struct Pending {
    AhbTransfer transfer;
    std::coroutine_handle<> waiter = nullptr;
  };

  Ticket enqueue(const AhbTransfer &transfer, std::coroutine_handle<> waiter);
  void next_address_phase();

  std::deque<Pending> queue_;  // the front one is in its address phase if driving_
  Pending data_phase_;
  bool in_data_phase_ = false;
  bool driving_ = false;
  unsigned waits_ = 0;
  AhbRequest request_;
  Ticket submitted_ = 0;
  Ticket completed_ = 0;
  std::vector<AhbResult> results_ = std::vector<AhbResult>(kKept);
  AhbChecker checker_;
  Watcher watcher_;
  std::function<void()> announce_;
};

}  // namespace vericansim
