// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncRun: what came out of one run of a case: samples and corrections, whichever way it was run.
#pragma once

#include <cstdint>
#include <vector>

#include "bus/types.hpp"
#include "verican/servo.h"

namespace vericansim {

/// A follower at one instant.
struct SyncReading {
  Time error = 0;  ///< its continuous reading less the master's, ps; ends of the range saturate
  std::uint8_t state = VERICAN_SYNC_UNSYNCHRONISED;  ///< verican_sync_state_t
  [[nodiscard]] bool locked() const { return state == VERICAN_SYNC_LOCKED; }
};

/// All followers at the same instant.
struct SyncLook {
  Time at = 0;
  std::vector<SyncReading> followers;
};

/// What a follower's servo did with a pair.
struct SyncAction {
  Time at = 0;
  unsigned follower = 0;
  std::int64_t shift = 0;                            ///< ns
  std::uint64_t increment = 0;                       ///< from then on, 2^-32 ns
  std::uint8_t events = 0;                           ///< VERICAN_SERVO_*
  std::uint8_t state = VERICAN_SYNC_UNSYNCHRONISED;  ///< from then on
};

/// One run. Looks and actions are in the order of time.
struct SyncRun {
  std::vector<SyncLook> looks;
  std::vector<SyncAction> actions;
  std::uint64_t frames = 0;    ///< SYNC and FUP that got through
  std::uint64_t repeated = 0;  ///< attempts that an error ended
  std::uint64_t refused = 0;   ///< pairs that a follower did not take: FUP late or missing
};

/// Errors of followers while they are locked, ns.
class SyncFigures {
 public:
  /// `throughout`: from the first time on that a follower is locked, whatever becomes of it.
  explicit SyncFigures(bool throughout = false) : throughout_{throughout} {}
  void add(const SyncRun &run);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] double mean() const;
  [[nodiscard]] double sd() const;                           ///< standard deviation
  [[nodiscard]] double max() const { return max_; }          ///< of the absolute value
  [[nodiscard]] double between() const { return between_; }  ///< largest distance of two followers
  /// At the end of each run every follower was locked.
  [[nodiscard]] bool locked() const { return runs_ > 0 && locked_; }

 private:
  void add(const SyncLook &look);
  [[nodiscard]] bool counts(std::size_t follower, const SyncReading &reading);

  bool throughout_;
  std::vector<bool> was_locked_;
  double sum_ = 0, squares_ = 0, max_ = 0, between_ = 0;
  std::uint64_t count_ = 0, runs_ = 0;
  bool locked_ = true;
};

}  // namespace vericansim
