// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AhbMaster: an AHB-Lite master that queues transfers, runs them clock by clock and checks the
// slave.
#pragma once

#include <coroutine>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace vericansim {

/// HTRANS.
enum class AhbTrans : std::uint8_t { kIdle = 0, kBusy = 1, kNonseq = 2, kSeq = 3 };
/// HSIZE; wider ones exist for tests of the slave's ERROR response.
enum class AhbSize : std::uint8_t { kByte = 0, kHalf = 1, kWord = 2, kDouble = 3 };
/// HBURST.
enum class AhbBurst : std::uint8_t {
  kSingle = 0,
  kIncr,
  kWrap4,
  kIncr4,
  kWrap8,
  kIncr8,
  kWrap16,
  kIncr16
};

/// What the master drives. `hready` is not here: with one slave it is that slave's HREADYOUT.
struct AhbRequest {
  std::uint32_t haddr = 0;
  AhbTrans htrans = AhbTrans::kIdle;
  bool hwrite = false;
  AhbSize hsize = AhbSize::kWord;
  AhbBurst hburst = AhbBurst::kSingle;
  std::uint8_t hprot = 0b0011;  // privileged data access
  std::uint32_t hwdata = 0;

  friend bool operator==(const AhbRequest &, const AhbRequest &) = default;
};

/// What the slave drives.
struct AhbResponse {
  std::uint32_t hrdata = 0;
  bool hready = true;
  bool hresp = false;
};

/// One transfer (one beat). Byte lanes are the master's work: `data` is right-aligned.
struct AhbTransfer {
  std::uint32_t address = 0;
  bool write = false;
  AhbSize size = AhbSize::kWord;
  std::uint32_t data = 0;
  std::uint8_t hprot = 0b0011;
  AhbBurst burst = AhbBurst::kSingle;
  AhbTrans trans = AhbTrans::kNonseq;  ///< kSeq for the later beats of a burst
  unsigned busy_before = 0;  ///< BUSY cycles before this beat (kSeq) or IDLE cycles (kNonseq)
};

/// How a transfer ended.
struct AhbResult {
  std::uint32_t data = 0;  ///< read data, right-aligned
  bool error = false;      ///< ERROR response
  unsigned waits = 0;      ///< wait states of the data phase
};

/// Statistics of the accesses and the protocol violations seen, as plain sentences.
struct AhbReport {
  std::uint64_t transfers = 0;
  std::uint64_t errors = 0;
  std::uint64_t wait_states = 0;
  unsigned max_waits = 0;
  std::vector<std::string> violations;
};

/// The master. Each clock cycle: request() is driven while the cycle lasts, and at its end the
/// slave's response is handed to clock(). Transfers are pipelined back to back as AHB-Lite allows.
class AhbMaster {
 public:
  /// Identifies a submitted transfer; its result stays available for 256 further transfers.
  using Ticket = std::uint64_t;

  Ticket submit(const AhbTransfer &transfer);
  /// Submits a burst of words; returns the ticket of its first beat, the others follow.
  Ticket submit_burst(std::uint32_t address, AhbBurst burst, bool write,
                      const std::vector<std::uint32_t> &data_or_size);
  [[nodiscard]] bool done(Ticket ticket) const { return ticket < completed_; }
  [[nodiscard]] const AhbResult &result(Ticket ticket) const { return results_[ticket % kKept]; }

  /// True if there is anything to drive or a data phase is under way.
  [[nodiscard]] bool active() const { return busy_; }
  [[nodiscard]] const AhbRequest &request() const { return request_; }
  /// End of a clock cycle in which request() was driven. May resume waiting coroutines.
  void clock(const AhbResponse &response);
  /// Forgets queued transfers and waiting coroutines (reset).
  void reset();

  [[nodiscard]] const AhbReport &report() const { return report_; }
  void clear_report() { report_ = {}; }

  /// `co_await master.access(transfer)` yields the AhbResult.
  struct Awaiter {
    AhbMaster &master;
    AhbTransfer transfer;
    Ticket ticket = 0;
    bool await_ready() const { return false; }
    void await_suspend(std::coroutine_handle<> handle);
    AhbResult await_resume() const { return master.result(ticket); }
  };
  Awaiter access(const AhbTransfer &transfer) { return Awaiter{*this, transfer}; }
  Awaiter read(std::uint32_t address) { return access({.address = address}); }
  Awaiter write(std::uint32_t address, std::uint32_t data) {
    return access({.address = address, .write = true, .data = data});
  }

 private:
  static constexpr std::size_t kKept = 256;

  struct Pending {
    AhbTransfer transfer;
    std::coroutine_handle<> waiter = nullptr;
  };

  void check(const AhbResponse &response);
  void finish(const AhbResponse &response);
  void next_address_phase();
  void violation(const std::string &what);

  std::deque<Pending> queue_;  // front: in its address phase (if driving_), then waiting
  Pending data_phase_;         // transfer in its data phase
  bool in_data_phase_ = false;
  bool driving_ = false;  // request_ shows an address phase of queue_.front()
  bool busy_ = false;
  bool error_first_ = false;  // first cycle of an ERROR response was seen
  unsigned waits_ = 0;
  AhbRequest request_;
  Ticket submitted_ = 0;
  Ticket completed_ = 0;
  std::uint64_t cycles_ = 0;
  std::vector<AhbResult> results_ = std::vector<AhbResult>(kKept);
  AhbReport report_;
};

}  // namespace vericansim
