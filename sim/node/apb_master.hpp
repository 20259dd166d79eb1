// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ApbMaster: an APB4 master that queues transfers and runs them clock by clock.
#pragma once

#include <functional>
#include <utility>

#include "node/apb_checker.hpp"
#include "node/lane_master.hpp"

namespace vericansim {

/// The master: setup phase, access phase until PREADY, and the next setup phase at once.
class ApbMaster final : public LaneMaster {
 public:
  using LaneMaster::LaneMaster;

  [[nodiscard]] bool active() const override { return request_.psel || waiting(); }
  [[nodiscard]] const ApbRequest &request() const { return request_; }
  /// End of a clock cycle in which request() was driven. May resume waiting coroutines.
  void clock(const ApbResponse &response);
  void reset() override;

  /// Called at the end of each clock cycle in which the master is active.
  using Watcher = std::function<void(const ApbRequest &, const ApbResponse &)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  [[nodiscard]] const BusReport &report() const override { return checker_.report(); }

 private:
  void queued() override;
  void setup();

  ApbRequest request_;
  Access access_;  // if request_.psel
  ApbChecker checker_;
  Watcher watcher_;
};

}  // namespace vericansim
