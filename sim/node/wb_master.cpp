// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WbMaster: see wb_master.hpp.
#include "node/wb_master.hpp"

#include "node/byte_lanes.hpp"

namespace vericansim {

void WbMaster::queued() {
  if (!request_.stb && !dropped_) strobe();
}

// Shows the front of the queue, or no strobe, in the coming cycle.
void WbMaster::strobe() {
  request_.stb = false;
  if (front() != nullptr) {
    access_ = take();
    const AhbTransfer &transfer = access_.transfer;
    request_.stb = true;
    request_.we = transfer.write;
    request_.adr = transfer.address >> 2;
    request_.sel = lanes_of(transfer);
    if (transfer.write) request_.dat = to_lanes(transfer);
  }
  request_.cyc = request_.stb || !taken_.empty();
}

void WbMaster::clock(const WbResponse &response) {
  checker_.clock(request_, response);
  if (watcher_) watcher_(request_, response);
  dropped_ = false;
  if (!request_.stb) idle();
  if (request_.stb) ++access_.waits;
  for (Access &access : taken_) ++access.waits;
  const bool taken = request_.stb && (pipelined_ ? !response.stall : response.answers());
  if (taken) taken_.push_back(access_);
  const bool ended = response.answers() && !taken_.empty();
  Access access;
  if (ended) {
    access = taken_.front();
    taken_.pop_front();
    access.waits -= 2;  // that of the strobe, that of the answer
  }
  if (taken || !request_.stb) strobe();
  if (ended) finish(access, response.dat, response.err);
}

void WbMaster::drop() {
  std::deque<Access> lost = std::exchange(taken_, {});
  if (request_.stb) lost.push_back(access_);
  request_.cyc = request_.stb = false;
  dropped_ = true;
  for (const Access &access : lost) finish(access, 0, true);
}

void WbMaster::reset() {
  forget();
  taken_.clear();
  request_ = {};
  dropped_ = false;
  checker_.reset();
}

}  // namespace vericansim
