// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ApbChecker: watches the pins of an APB4 slave clock by clock and names every broken rule.
#pragma once

#include <cstdint>

#include "node/bus_report.hpp"

namespace vericansim {

/// What the master drives in a cycle.
struct ApbRequest {
  bool psel = false;
  bool penable = false;
  std::uint32_t paddr = 0;
  std::uint8_t pprot = 0b001;  ///< privileged, secure, data
  bool pwrite = false;
  std::uint8_t pstrb = 0;
  std::uint32_t pwdata = 0;

  /// Same transfer: all but PENABLE.
  [[nodiscard]] bool same_transfer(const ApbRequest &o) const {
    return psel == o.psel && paddr == o.paddr && pprot == o.pprot && pwrite == o.pwrite &&
           pstrb == o.pstrb && pwdata == o.pwdata;
  }
};

/// What the slave drives in a cycle.
struct ApbResponse {
  bool pready = true;
  std::uint32_t prdata = 0;
  bool pslverr = false;
};

/// The checker; rules of ARM IHI 0024. It keeps no reference to master or slave.
class ApbChecker {
 public:
  /// One clock cycle, as settled at its end.
  void clock(const ApbRequest &request, const ApbResponse &response);
  void reset() { *this = ApbChecker{report_}; }
  ApbChecker() = default;

  [[nodiscard]] const BusReport &report() const { return report_; }

 private:
  explicit ApbChecker(BusReport report) : report_{std::move(report)} {}
  void check_master(const ApbRequest &request);

  BusReport report_;
  ApbRequest previous_;
  bool access_ = false;  // an access phase must come, or go on
  unsigned waits_ = 0;
  std::uint64_t cycle_ = 0;
};

}  // namespace vericansim
