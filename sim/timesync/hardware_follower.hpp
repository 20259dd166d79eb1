// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HardwareFollower: a node of SyncLoop that follows without software, can_time_sync as its rules
// say it (docs/time-spec.md, section 9), on a clock in closed form.
#pragma once

#include <cstdint>
#include <optional>

#include "model/time_sync_model.hpp"
#include "timesync/clock_node.hpp"
#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim {

/// TSCTRL.KI and KD of a case; a core takes KD up to KI.
struct FollowerGains {
  unsigned ki, kd;
};
/// KI as TM-103 has it, KD by SyncCase::restless.
[[nodiscard]] FollowerGains gains_of(const SyncCase &setting);

class HardwareFollower {
 public:
  /// Clocks from the end of FUP to the correction: rounds of 64, five of them on average.
  static constexpr std::int64_t kWorkedOff = 320;

  /// With gains_of() the case, PHALF by SyncCase::restless; domain 0.
  HardwareFollower(const SyncCase &setting, std::uint32_t id);

  /// A SYNC or FUP with its stamp; what it does to the clock it does at `edge`, and `clock` has it
  /// then. An action if it was a pair that is not ignored.
  std::optional<SyncAction> frame(const std::uint8_t (&data)[8], std::uint64_t stamp,
                                  std::int64_t edge, ClockNode &clock);
  /// TSSTAT.STATE, with the numbers of verican_sync_state_t; `now`: the clock.
  [[nodiscard]] std::uint8_t state(std::uint64_t now);

 private:
  TimeSyncSetting setting_;
  TimeSyncModel model_;
  std::uint64_t last_ = 0;  // of its clock, when the last pair came
};

}  // namespace vericansim
