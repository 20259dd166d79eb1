// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AxilMaster: an AXI4-Lite master that queues transfers and runs them clock by clock.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "node/axil_checker.hpp"
#include "node/lane_master.hpp"

namespace vericansim {

/// The master. Reads follow each other, and writes, with one waiting for its answer while the next
/// is shown; a read waits for the answers of the writes before it and a write for those of the
/// reads, unless they may overlap.
class AxilMaster final : public LaneMaster {
 public:
  using LaneMaster::LaneMaster;

  /// Clocks before a VALID or a READY: called for each channel of each transfer. Empty: none.
  void delay(std::function<unsigned()> clocks) { delay_ = std::move(clocks); }
  /// A read and a write that follow each other may be open at the same time.
  void overlap(bool allowed) { overlap_ = allowed; }

  [[nodiscard]] bool active() const override {
    return waiting() || read_ || write_ || !reads_.empty() || !writes_.empty();
  }
  [[nodiscard]] const AxilRequest &request() const { return request_; }
  /// End of a clock cycle in which request() was driven. May resume waiting coroutines.
  void clock(const AxilResponse &response);
  void reset() override;

  /// Called at the end of each clock cycle in which the master is active.
  using Watcher = std::function<void(const AxilRequest &, const AxilResponse &)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  [[nodiscard]] const BusReport &report() const override { return checker_.report(); }

 private:
  void queued() override { show(); }
  void fetch();
  void show();
  void take_requests(const AxilResponse &response);
  [[nodiscard]] unsigned some() const { return delay_ ? delay_() : 0; }

  AxilRequest request_;
  std::optional<Access> read_, write_;  // whose request is shown, or will be
  std::deque<Access> reads_, writes_;   // which wait for their answers
  unsigned ar_delay_ = 0, aw_delay_ = 0, w_delay_ = 0, r_delay_ = 0, b_delay_ = 0;
  bool aw_done_ = false, w_done_ = false;  // of write_
  bool overlap_ = false;
  std::function<unsigned()> delay_;
  AxilChecker checker_;
  Watcher watcher_;
};

}  // namespace vericansim
