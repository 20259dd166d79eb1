// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncFigures: see sync_run.hpp.
#include "timesync/sync_run.hpp"

#include <algorithm>
#include <cmath>

namespace vericansim {

void SyncFigures::add(const SyncLook &look) {
  double least = 0, most = 0;
  bool any = false;
  for (std::size_t n = 0; n < look.followers.size(); ++n) {
    const SyncReading &reading = look.followers[n];
    if (!counts(n, reading)) continue;
    const double error = static_cast<double>(reading.error) / 1e3;
    sum_ += error;
    squares_ += error * error;
    max_ = std::max(max_, std::abs(error));
    least = any ? std::min(least, error) : error;
    most = any ? std::max(most, error) : error;
    any = true;
    ++count_;
  }
  between_ = std::max(between_, most - least);
}

bool SyncFigures::counts(std::size_t follower, const SyncReading &reading) {
  if (!throughout_) return reading.locked();
  if (reading.locked()) was_locked_[follower] = true;
  return was_locked_[follower];
}

void SyncFigures::add(const SyncRun &run) {
  was_locked_.assign(run.looks.empty() ? 0 : run.looks.front().followers.size(), false);
  for (const SyncLook &look : run.looks) add(look);
  ++runs_;
  const auto locked = [](const SyncReading &reading) { return reading.locked(); };
  locked_ =
      locked_ && !run.looks.empty() &&
      std::all_of(run.looks.back().followers.begin(), run.looks.back().followers.end(), locked);
}

double SyncFigures::mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }

double SyncFigures::sd() const {
  if (count_ == 0) return 0;
  return std::sqrt(std::max(0.0, squares_ / static_cast<double>(count_) - mean() * mean()));
}

}  // namespace vericansim
