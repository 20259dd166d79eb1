// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WbChecker: watches the pins of a Wishbone B4 slave clock by clock and names every broken rule.
#pragma once

#include <cstdint>
#include <deque>

#include "node/bus_report.hpp"

namespace vericansim {

/// What the master drives in a cycle.
struct WbRequest {
  bool cyc = false;
  bool stb = false;
  bool we = false;
  std::uint32_t adr = 0;  ///< bits 31:2, a word's number
  std::uint8_t sel = 0;
  std::uint32_t dat = 0;

  [[nodiscard]] bool same_transfer(const WbRequest &o) const {
    return we == o.we && adr == o.adr && sel == o.sel && (!we || dat == o.dat);
  }
};

/// What the slave drives in a cycle.
struct WbResponse {
  std::uint32_t dat = 0;
  bool ack = false;
  bool err = false;
  bool stall = false;

  [[nodiscard]] bool answers() const { return ack || err; }
};

/// The checker; rules of Wishbone B4. It keeps no reference to master or slave.
class WbChecker {
 public:
  /// `pipelined`: a strobe without STALL is taken; else it lasts until its answer.
  explicit WbChecker(bool pipelined = false) : pipelined_{pipelined} {}
  /// One clock cycle, as settled at its end.
  void clock(const WbRequest &request, const WbResponse &response);
  void reset();

  [[nodiscard]] const BusReport &report() const { return report_; }

 private:
  void check_slave(const WbRequest &request, const WbResponse &response);

  bool pipelined_;
  BusReport report_;
  WbRequest previous_;
  bool held_ = false;              // a strobe that is not taken, or not answered, must stay
  std::uint64_t since_ = 0;        // cycle in which the strobe was first shown
  std::deque<std::uint64_t> due_;  // the same of those that wait for their answers
  std::uint64_t cycle_ = 0;
};

}  // namespace vericansim
