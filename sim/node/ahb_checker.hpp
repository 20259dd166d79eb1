// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AhbChecker: watches the pins of an AHB-Lite slave clock by clock and names every broken rule.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "node/bus_report.hpp"

namespace vericansim {

/// HTRANS.
enum class AhbTrans : std::uint8_t { kIdle = 0, kBusy = 1, kNonseq = 2, kSeq = 3 };
/// HSIZE; wider ones than a word exist for tests of the slave's ERROR response.
enum class AhbSize : std::uint8_t { kByte = 0, kHalf = 1, kWord = 2, kDouble = 3 };
/// HBURST.
enum class AhbBurst : std::uint8_t {
  kSingle = 0,
  kIncr = 1,
  kWrap4 = 2,
  kIncr4 = 3,
  kWrap8 = 4,
  kIncr8 = 5,
  kWrap16 = 6,
  kIncr16 = 7,
};

/// What the master drives in a cycle. HREADY is not here: with one slave it is that slave's
/// HREADYOUT.
struct AhbRequest {
  std::uint32_t haddr = 0;
  AhbTrans htrans = AhbTrans::kIdle;
  bool hwrite = false;
  AhbSize hsize = AhbSize::kWord;
  AhbBurst hburst = AhbBurst::kSingle;
  std::uint8_t hprot = 0b0011;  ///< privileged data access
  std::uint32_t hwdata = 0;

  /// Same address phase (HWDATA belongs to the data phase).
  [[nodiscard]] bool same_address_phase(const AhbRequest &o) const {
    return haddr == o.haddr && htrans == o.htrans && hwrite == o.hwrite && hsize == o.hsize &&
           hburst == o.hburst && hprot == o.hprot;
  }
};

/// What the slave drives in a cycle.
struct AhbResponse {
  std::uint32_t hrdata = 0;
  bool hready = true;
  bool hresp = false;
};

/// Address of the beat after one at `address` in a burst (wrapping bursts wrap at their size).
[[nodiscard]] std::uint32_t ahb_next_address(std::uint32_t address, AhbSize size, AhbBurst burst);
/// Beats of a burst of fixed length; 0 for kIncr, 1 for kSingle.
[[nodiscard]] unsigned ahb_beats(AhbBurst burst);

/// The checker. It keeps no reference to master or slave; both are judged by what they drive.
class AhbChecker {
 public:
  /// One clock cycle, as settled at its end.
  void clock(const AhbRequest &request, const AhbResponse &response);
  void reset();

  [[nodiscard]] const BusReport &report() const { return report_; }
  [[nodiscard]] const std::vector<std::string> &violations() const { return report_.violations; }
  [[nodiscard]] std::uint64_t transfers() const { return report_.transfers; }
  [[nodiscard]] std::uint64_t errors() const { return report_.errors; }
  [[nodiscard]] std::uint64_t wait_states() const { return report_.wait_states; }
  [[nodiscard]] unsigned max_waits() const { return report_.max_waits; }

 private:
  void check_master(const AhbRequest &request);
  void check_slave(const AhbResponse &response);
  void violation(const std::string &what);

  AhbRequest previous_;
  AhbResponse previous_response_;
  bool data_phase_ = false;   // a transfer is in its data phase
  bool write_phase_ = false;  // and it is a write
  bool error_first_ = false;  // the first cycle of an ERROR response has passed
  unsigned waits_ = 0;
  std::uint64_t cycle_ = 0;
  BusReport report_;
};

}  // namespace vericansim
