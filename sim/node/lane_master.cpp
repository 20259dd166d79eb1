// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LaneMaster: see lane_master.hpp.
#include "node/lane_master.hpp"

#include "node/byte_lanes.hpp"

namespace vericansim {

LaneMaster::Ticket LaneMaster::enqueue(const AhbTransfer &transfer,
                                       std::coroutine_handle<> waiter) {
  announce();
  queue_.push_back({transfer, waiter, submitted_});
  queued();
  return submitted_++;
}

LaneMaster::Access LaneMaster::take() {
  const Access access = queue_.front();
  queue_.pop_front();
  return access;
}

void LaneMaster::idle() {
  if (!queue_.empty() && queue_.front().transfer.pause != 0) --queue_.front().transfer.pause;
}

void LaneMaster::finish(const Access &access, std::uint32_t word, bool error) {
  slot(access.ticket) = {from_lanes(access.transfer, word), error, access.waits, access.late};
  ahead_.insert(access.ticket);
  while (ahead_.erase(completed_) != 0) ++completed_;
  if (access.waiter) access.waiter.resume();
}

void LaneMaster::forget() {
  queue_.clear();
  ahead_.clear();
  completed_ = submitted_;
}

}  // namespace vericansim
