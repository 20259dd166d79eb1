// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AxilChecker: watches the pins of an AXI4-Lite slave clock by clock and names every broken rule.
#pragma once

#include <cstdint>

#include "node/bus_report.hpp"

namespace vericansim {

/// What the master drives in a cycle.
struct AxilRequest {
  bool awvalid = false;
  std::uint32_t awaddr = 0;
  std::uint8_t awprot = 0b001;  ///< privileged, secure, data; so is arprot
  bool wvalid = false;
  std::uint32_t wdata = 0;
  std::uint8_t wstrb = 0;
  bool bready = true;
  bool arvalid = false;
  std::uint32_t araddr = 0;
  std::uint8_t arprot = 0b001;
  bool rready = true;
};

/// What the slave drives in a cycle.
struct AxilResponse {
  bool awready = false;
  bool wready = false;
  bool bvalid = false;
  std::uint8_t bresp = 0;
  bool arready = false;
  bool rvalid = false;
  std::uint32_t rdata = 0;
  std::uint8_t rresp = 0;
};

/// The checker; rules of ARM IHI 0022, and the bounds that can_axil promises. It keeps no reference
/// to master or slave. Waits: clocks of ARVALID beyond one, of AWVALID with WVALID beyond two.
class AxilChecker {
 public:
  /// Most clocks from VALID to READY while the answer's channel is open.
  static constexpr unsigned kReadBound = 7, kWriteBound = 8;

  /// One clock cycle, as settled at its end.
  void clock(const AxilRequest &request, const AxilResponse &response);
  void reset();

  [[nodiscard]] const BusReport &report() const { return report_; }

 private:
  void check_master(const AxilRequest &request);
  void check_slave(const AxilRequest &request, const AxilResponse &response);
  void count(const AxilRequest &request, const AxilResponse &response);
  void require(bool kept, const char *rule) {
    if (!kept) report_.violation("AXI4-Lite", cycle_, rule);
  }

  BusReport report_;
  AxilRequest previous_;
  AxilResponse answered_;                          // in the cycle before
  unsigned reads_ = 0, addresses_ = 0, data_ = 0;  // taken and not answered
  unsigned read_clocks_ = 0, write_clocks_ = 0;    // since VALID, with an open channel
  std::uint64_t cycle_ = 0;
};

}  // namespace vericansim
