// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AhbMaster: see ahb_master.hpp.
#include "node/ahb_master.hpp"

#include <stdexcept>
#include <utility>

#include "node/byte_lanes.hpp"

namespace vericansim {

AhbMaster::Ticket AhbMaster::enqueue(const AhbTransfer &transfer, std::coroutine_handle<> waiter) {
  if (transfer.lanes >= 0) throw std::invalid_argument("AHB has no byte lanes of its own");
  announce();
  queue_.push_back({transfer, waiter});
  if (!driving_) next_address_phase();
  return submitted_++;
}

AhbMaster::Ticket AhbMaster::submit_burst(std::uint32_t address, AhbBurst burst, bool write,
                                          const std::vector<std::uint32_t> &data) {
  const Ticket first = submitted_;
  AhbTransfer beat{.address = address, .write = write, .burst = burst};
  for (const std::uint32_t word : data) {
    beat.data = word;
    submit(beat);
    beat.trans = AhbTrans::kSeq;
    beat.address = ahb_next_address(beat.address, beat.size, burst);
  }
  return first;
}

void AhbMaster::reset() {
  queue_.clear();
  in_data_phase_ = false;
  driving_ = false;
  request_ = {};
  completed_ = submitted_;
  checker_.reset();
}

// Shows the front of the queue, or BUSY, or IDLE, in the coming cycle.
void AhbMaster::next_address_phase() {
  driving_ = false;
  request_.htrans = AhbTrans::kIdle;
  if (queue_.empty()) return;
  AhbTransfer &next = queue_.front().transfer;
  request_.haddr = next.address;
  request_.hwrite = next.write;
  request_.hsize = next.size;
  request_.hburst = next.burst;
  request_.hprot = next.hprot;
  if (next.pause != 0) {
    --next.pause;
    if (next.trans == AhbTrans::kSeq) request_.htrans = AhbTrans::kBusy;
    return;
  }
  request_.htrans = next.trans;
  driving_ = true;
}

void AhbMaster::clock(const AhbResponse &response) {
  checker_.clock(request_, response);
  if (watcher_) watcher_(request_, response);
  if (!response.hready) {
    if (!response.hresp) ++waits_;
    return;
  }
  const bool finished = in_data_phase_;
  const Pending ended = data_phase_;
  const unsigned waits = std::exchange(waits_, 0);
  in_data_phase_ = driving_;
  if (driving_) {
    data_phase_ = queue_.front();
    queue_.pop_front();
    if (data_phase_.transfer.write) request_.hwdata = to_lanes(data_phase_.transfer);
  }
  next_address_phase();
  if (!finished) return;
  slot(completed_) = {from_lanes(ended.transfer, response.hrdata), response.hresp, waits};
  ++completed_;
  if (ended.waiter) ended.waiter.resume();
}

}  // namespace vericansim
