// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WbMaster: a Wishbone B4 master that queues transfers and runs them clock by clock.
#pragma once

#include <deque>
#include <functional>
#include <utility>

#include "node/lane_master.hpp"
#include "node/wb_checker.hpp"

namespace vericansim {

/// The master, for standard or pipelined cycles. CYC stays while there is something to do.
class WbMaster : public LaneMaster {
 public:
  explicit WbMaster(bool pipelined, std::function<void()> announce = {})
      : LaneMaster{std::move(announce)}, pipelined_{pipelined}, checker_{pipelined} {}

  [[nodiscard]] bool active() const override { return request_.cyc || waiting(); }
  [[nodiscard]] const WbRequest &request() const { return request_; }
  /// End of a clock cycle in which request() was driven. May resume waiting coroutines.
  void clock(const WbResponse &response);
  void reset() override;
  /// Ends the cycle in the coming clock: what has no answer yet ends with an error and no data.
  void drop();

  /// Called at the end of each clock cycle in which the master is active.
  using Watcher = std::function<void(const WbRequest &, const WbResponse &)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  [[nodiscard]] const BusReport &report() const override { return checker_.report(); }

 private:
  void queued() override;
  void strobe();

  bool pipelined_;
  WbRequest request_;
  bool dropped_ = false;      // the coming clock has CYC low
  Access access_;             // of the strobe, if request_.stb
  std::deque<Access> taken_;  // pipelined: those that wait for their answers
  WbChecker checker_;
  Watcher watcher_;
};

}  // namespace vericansim
