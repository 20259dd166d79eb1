// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AxilMaster: see axil_master.hpp.
#include "node/axil_master.hpp"

#include "node/byte_lanes.hpp"

namespace vericansim {

namespace {

/// Clocks of VALID without READY, less those that every transfer needs.
unsigned beyond(unsigned clocks, unsigned fewest) { return clocks > fewest ? clocks - fewest : 0; }

}  // namespace

// Takes from the queue what may be shown next.
void AxilMaster::fetch() {
  while (const AhbTransfer *next = front()) {
    const bool writing = write_ || !writes_.empty();
    const bool reading = read_ || !reads_.empty();
    if (next->write ? write_ || (reading && !overlap_) : read_ || (writing && !overlap_)) return;
    if (next->write) {
      write_ = take();
      aw_delay_ = some();
      w_delay_ = some();
      aw_done_ = w_done_ = false;
    } else {
      read_ = take();
      ar_delay_ = some();
    }
  }
}

// What the coming cycle shows: VALID when its delay is over, and READY of the answers.
void AxilMaster::show() {
  fetch();
  request_.arvalid = read_ && ar_delay_ == 0;
  request_.awvalid = write_ && !aw_done_ && aw_delay_ == 0;
  request_.wvalid = write_ && !w_done_ && w_delay_ == 0;
  request_.rready = r_delay_ == 0;
  request_.bready = b_delay_ == 0;
  if (request_.arvalid) {
    request_.araddr = read_->transfer.address;
    request_.arprot = (read_->transfer.hprot & 0b10) != 0 ? 0b001 : 0b000;
  }
  if (request_.awvalid) {
    request_.awaddr = write_->transfer.address;
    request_.awprot = (write_->transfer.hprot & 0b10) != 0 ? 0b001 : 0b000;
  }
  if (request_.wvalid) {
    request_.wdata = to_lanes(write_->transfer);
    request_.wstrb = lanes_of(write_->transfer);
  }
}

void AxilMaster::take_requests(const AxilResponse &response) {
  if (ar_delay_ != 0) --ar_delay_;
  if (aw_delay_ != 0) --aw_delay_;
  if (w_delay_ != 0) --w_delay_;
  if (request_.arvalid && response.arready) {
    read_->waits = beyond(read_->waits, 1);
    reads_.push_back(*read_);
    read_.reset();
    if (reads_.size() == 1) r_delay_ = some();
  } else if (request_.arvalid) {
    ++read_->waits;
  }
  if (request_.awvalid && response.awready) aw_done_ = true;
  if (request_.wvalid && response.wready) w_done_ = true;
  if (!write_) return;
  if (aw_done_ && w_done_) {
    write_->waits = beyond(write_->waits, 2);
    write_->late = 1;  // the data phase was in the clock before
    writes_.push_back(*write_);
    write_.reset();
    if (writes_.size() == 1) b_delay_ = some();
  } else if (request_.awvalid && request_.wvalid) {
    ++write_->waits;
  }
}

void AxilMaster::clock(const AxilResponse &response) {
  checker_.clock(request_, response);
  if (watcher_) watcher_(request_, response);
  if (!read_ && !write_) idle();
  for (Access &access : reads_) ++access.late;
  for (Access &access : writes_) ++access.late;
  std::optional<Access> read, write;
  if (response.rvalid && request_.rready && !reads_.empty()) {
    read = reads_.front();
    reads_.pop_front();
  }
  if (response.bvalid && request_.bready && !writes_.empty()) {
    write = writes_.front();
    writes_.pop_front();
  }
  if (r_delay_ != 0 && response.rvalid) --r_delay_;
  if (b_delay_ != 0 && response.bvalid) --b_delay_;
  take_requests(response);
  show();
  if (read) finish(*read, response.rdata, response.rresp != 0);
  if (write) finish(*write, 0, response.bresp != 0);
}

void AxilMaster::reset() {
  forget();
  read_.reset();
  write_.reset();
  reads_.clear();
  writes_.clear();
  ar_delay_ = aw_delay_ = w_delay_ = r_delay_ = b_delay_ = 0;
  request_ = {};
  checker_.reset();
}

}  // namespace vericansim
