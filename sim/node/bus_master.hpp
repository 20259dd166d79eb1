// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusMaster: whatever drives a bus of the core: it queues transfers and runs them clock by clock.
#pragma once

#include <coroutine>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "node/ahb_checker.hpp"
#include "node/bus_report.hpp"

namespace vericansim {

/// One transfer (one beat). Byte lanes are the master's work: `data` is right-aligned.
struct AhbTransfer {
  std::uint32_t address = 0;
  bool write = false;
  AhbSize size = AhbSize::kWord;
  std::uint32_t data = 0;
  std::uint8_t hprot = 0b0011;  ///< bit 1: privileged, on the buses that tell it
  AhbBurst burst = AhbBurst::kSingle;
  AhbTrans trans = AhbTrans::kNonseq;  ///< kSeq for the later beats of a burst
  unsigned pause = 0;                  ///< cycles before it: BUSY before kSeq, IDLE before kNonseq
  /// Byte lanes, bit 0: bits 7:0, in place of `size`; `data` and what is read are then whole words.
  /// -1: by size and address. Not on AHB.
  int lanes = -1;
};

/// How a transfer ended.
struct AhbResult {
  std::uint32_t data = 0;  ///< read data, right-aligned
  bool error = false;      ///< error answer
  unsigned waits = 0;      ///< wait states: clocks beyond the fewest that the bus needs
  unsigned late = 0;       ///< clocks between the data phase of the core and the end
};

/// The master. In each clock cycle its request is driven, and at its end the slave's response is
/// handed to it (clock() of the classes derived from it). Transfers take effect in the order in
/// which they were submitted.
class BusMaster {
 public:
  /// Identifies a submitted transfer; its result stays available while the next 255 are submitted.
  using Ticket = std::uint64_t;

  /// `announce` is called before a transfer is queued.
  explicit BusMaster(std::function<void()> announce = {}) : announce_{std::move(announce)} {}
  virtual ~BusMaster() = default;
  BusMaster(const BusMaster &) = delete;
  BusMaster &operator=(const BusMaster &) = delete;

  Ticket submit(const AhbTransfer &transfer) { return enqueue(transfer, nullptr); }
  [[nodiscard]] bool done(Ticket ticket) const { return ticket < completed_; }
  [[nodiscard]] const AhbResult &result(Ticket ticket) const { return results_[ticket % kKept]; }

  /// True if there is a transfer to drive, or one that is not answered.
  [[nodiscard]] virtual bool active() const = 0;
  /// Forgets queued transfers and who waits for them (reset).
  virtual void reset() = 0;
  /// Statistics of the accesses and the protocol violations seen.
  [[nodiscard]] virtual const BusReport &report() const = 0;

  /// `co_await master.access(transfer)` yields the AhbResult.
  struct Awaiter {
    BusMaster &master;
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

 protected:
  static constexpr std::size_t kKept = 256;

  /// Queues a transfer; `waiter` goes on when it has ended.
  virtual Ticket enqueue(const AhbTransfer &transfer, std::coroutine_handle<> waiter) = 0;
  void announce() const {
    if (announce_) announce_();
  }
  [[nodiscard]] AhbResult &slot(Ticket ticket) { return results_[ticket % kKept]; }

  Ticket submitted_ = 0;
  Ticket completed_ = 0;

 private:
  std::vector<AhbResult> results_ = std::vector<AhbResult>(kKept);
  std::function<void()> announce_;
};

}  // namespace vericansim
