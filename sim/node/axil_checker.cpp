// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AxilChecker: see axil_checker.hpp.
#include "node/axil_checker.hpp"

namespace vericansim {

void AxilChecker::reset() {
  previous_ = {};
  answered_ = {};
  reads_ = addresses_ = data_ = 0;
  read_clocks_ = write_clocks_ = 0;
}

void AxilChecker::clock(const AxilRequest &request, const AxilResponse &response) {
  ++cycle_;
  check_master(request);
  check_slave(request, response);
  count(request, response);
  previous_ = request;
  answered_ = response;
}

void AxilChecker::check_master(const AxilRequest &request) {
  const AxilRequest &old = previous_;
  if (old.arvalid && !answered_.arready)
    require(request.arvalid && request.araddr == old.araddr && request.arprot == old.arprot,
            "AR changed before ARREADY");
  if (old.awvalid && !answered_.awready)
    require(request.awvalid && request.awaddr == old.awaddr && request.awprot == old.awprot,
            "AW changed before AWREADY");
  if (old.wvalid && !answered_.wready)
    require(request.wvalid && request.wdata == old.wdata && request.wstrb == old.wstrb,
            "W changed before WREADY");
}

void AxilChecker::check_slave(const AxilRequest &request, const AxilResponse &response) {
  const AxilResponse &old = answered_;
  if (old.rvalid && !previous_.rready)
    require(response.rvalid && response.rdata == old.rdata && response.rresp == old.rresp,
            "R changed before RREADY");
  if (old.bvalid && !previous_.bready)
    require(response.bvalid && response.bresp == old.bresp, "B changed before BREADY");
  require(!response.rvalid || reads_ != 0, "RVALID without a read");
  require(!response.bvalid || (addresses_ != 0 && data_ != 0), "BVALID without a write");
  require(!response.rvalid || response.rresp == 0 || response.rresp == 2,
          "RRESP is neither OKAY nor SLVERR");
  require(!response.bvalid || response.bresp == 0 || response.bresp == 2,
          "BRESP is neither OKAY nor SLVERR");
  if (response.rvalid && request.rready && reads_ != 0) {
    --reads_;
    report_.ended(response.rresp != 0);
  }
  if (response.bvalid && request.bready && addresses_ != 0 && data_ != 0) {
    --addresses_;
    --data_;
    report_.ended(response.bresp != 0);
  }
  if (request.arvalid && response.arready) ++reads_;
  if (request.awvalid && response.awready) ++addresses_;
  if (request.wvalid && response.wready) ++data_;
}

void AxilChecker::count(const AxilRequest &request, const AxilResponse &response) {
  const bool r_open = !response.rvalid || request.rready;
  const bool b_open = !response.bvalid || request.bready;
  const bool read = request.arvalid && !response.arready && r_open;
  const bool write = request.awvalid && request.wvalid && !response.awready && b_open;
  read_clocks_ = read ? read_clocks_ + 1 : 0;
  write_clocks_ = write ? write_clocks_ + 1 : 0;
  if (read_clocks_ > 1) report_.waited(read_clocks_ - 1);
  if (write_clocks_ > 2) report_.waited(write_clocks_ - 2);
  require(read_clocks_ <= kReadBound, "ARREADY is late");
  require(write_clocks_ <= kWriteBound, "AWREADY is late");
}

}  // namespace vericansim
