// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ApbMaster: see apb_master.hpp.
#include "node/apb_master.hpp"

#include "node/byte_lanes.hpp"

namespace vericansim {

void ApbMaster::queued() {
  if (!request_.psel) setup();
}

// Shows the front of the queue, or nothing, in the coming cycle.
void ApbMaster::setup() {
  request_.psel = request_.penable = false;
  if (front() == nullptr) return;
  access_ = take();
  const AhbTransfer &transfer = access_.transfer;
  request_.psel = true;
  request_.paddr = transfer.address;
  request_.pprot = (transfer.hprot & 0b10) != 0 ? 0b001 : 0b000;
  request_.pwrite = transfer.write;
  request_.pstrb = transfer.write ? lanes_of(transfer) : 0;
  if (transfer.write) request_.pwdata = to_lanes(transfer);
}

void ApbMaster::clock(const ApbResponse &response) {
  checker_.clock(request_, response);
  if (watcher_) watcher_(request_, response);
  if (!request_.psel) {
    idle();
    setup();
  } else if (!request_.penable) {
    request_.penable = true;
  } else if (!response.pready) {
    ++access_.waits;
  } else {
    const Access ended = access_;
    setup();
    finish(ended, response.prdata, response.pslverr);
  }
}

void ApbMaster::reset() {
  forget();
  request_ = {};
  checker_.reset();
}

}  // namespace vericansim
