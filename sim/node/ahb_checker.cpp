// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AhbChecker: see ahb_checker.hpp. The rules are those of AMBA 3 AHB-Lite.
#include "node/ahb_checker.hpp"

namespace vericansim {
namespace {

bool is_transfer(AhbTrans trans) { return trans == AhbTrans::kNonseq || trans == AhbTrans::kSeq; }

}  // namespace

unsigned ahb_beats(AhbBurst burst) {
  switch (burst) {
    case AhbBurst::kSingle: return 1;
    case AhbBurst::kIncr: return 0;
    case AhbBurst::kWrap4:
    case AhbBurst::kIncr4: return 4;
    case AhbBurst::kWrap8:
    case AhbBurst::kIncr8: return 8;
    default: return 16;
  }
}

std::uint32_t ahb_next_address(std::uint32_t address, AhbSize size, AhbBurst burst) {
  const std::uint32_t step = 1u << static_cast<unsigned>(size);
  const bool wraps =
      burst == AhbBurst::kWrap4 || burst == AhbBurst::kWrap8 || burst == AhbBurst::kWrap16;
  if (!wraps) return address + step;
  const std::uint32_t block = step * ahb_beats(burst);
  return (address & ~(block - 1)) | ((address + step) & (block - 1));
}

void AhbChecker::reset() {
  data_phase_ = false;
  write_phase_ = false;
  error_first_ = false;
  waits_ = 0;
  previous_ = {};
  previous_response_ = {};
}

void AhbChecker::clock(const AhbRequest &request, const AhbResponse &response) {
  ++cycle_;
  check_master(request);
  check_slave(response);
  if (response.hready) {
    if (data_phase_) report_.ended(response.hresp);
    data_phase_ = is_transfer(request.htrans);
    write_phase_ = data_phase_ && request.hwrite;
    waits_ = 0;
  } else if (!response.hresp) {
    report_.waited(++waits_);
  }
  error_first_ = response.hresp && !response.hready;
  previous_ = request;
  previous_response_ = response;
}

void AhbChecker::check_master(const AhbRequest &request) {
  const bool extended = !previous_response_.hready;
  // An IDLE or BUSY may turn into a transfer while waiting, and an ERROR allows to cancel.
  if (extended && is_transfer(previous_.htrans) && !error_first_ &&
      !request.same_address_phase(previous_)) {
    violation("address phase changed while HREADY was low");
  }
  if (extended && write_phase_ && request.hwdata != previous_.hwdata) {
    violation("HWDATA changed while HREADY was low");
  }
  if (extended || request.htrans != AhbTrans::kSeq) return;
  const std::uint32_t expected =
      previous_.htrans == AhbTrans::kBusy
          ? previous_.haddr
          : ahb_next_address(previous_.haddr, previous_.hsize, previous_.hburst);
  if (previous_.htrans == AhbTrans::kIdle) violation("SEQ without a burst");
  if (request.haddr != expected) violation("SEQ address does not follow the beat before");
  if (request.hwrite != previous_.hwrite || request.hsize != previous_.hsize ||
      request.hburst != previous_.hburst) {
    violation("control signals changed within a burst");
  }
}

void AhbChecker::check_slave(const AhbResponse &response) {
  if (!data_phase_) {
    if (!response.hready) violation("wait state without a transfer in its data phase");
    if (response.hresp) violation("ERROR response without a transfer in its data phase");
    return;
  }
  if (error_first_ && !(response.hresp && response.hready)) {
    violation("second cycle of an ERROR response must have HRESP and HREADYOUT high");
  }
  if (response.hresp && response.hready && !error_first_) {
    violation("ERROR response of a single cycle");
  }
}

void AhbChecker::violation(const std::string &what) { report_.violation("AHB", cycle_, what); }

}  // namespace vericansim
