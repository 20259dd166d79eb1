// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeModel: the clock of the time unit as its rule says it (docs/time-spec.md, TM-10 to TM-17),
// without the registers between its adders.
#pragma once

#include <array>
#include <cstdint>

namespace vericansim {

/// What software asks of the clock in one clock; at most one of the four.
struct TimeCommand {
  enum class Kind : std::uint8_t { kNone, kSet, kShift, kRate, kSlew };
  Kind kind = Kind::kNone;
  std::uint64_t ns = 0;        ///< kSet: time; kShift: signed offset
  std::uint8_t inc_ns = 0;     ///< kRate: whole ns a clock ...
  std::uint32_t inc_frac = 0;  ///< ... and 2^-32 ns
  std::int32_t slew = 0;       ///< kSlew: ns
};

/// State after a clock edge, and the step to the next.
class TimeModel {
 public:
  TimeModel(std::uint8_t inc_ns, std::uint32_t inc_frac) : inc_ns_{inc_ns}, inc_frac_{inc_frac} {}

  /// TIME, ns.
  [[nodiscard]] std::uint64_t time() const { return ns_[0]; }
  /// What is left of a slew, ns.
  [[nodiscard]] std::int32_t slew_left() const { return left_; }
  /// TCTRL.SLEWR: a step whenever bit 13 - slewr of TIME has changed.
  void set_slewr(unsigned slewr) { slew_bit_ = 13 - slewr; }

  /// One clock, in which `command` takes effect.
  void clock(const TimeCommand &command = {});

 private:
  [[nodiscard]] int slew_step() const;

  // TIME now and before: the change of a bit is seen three clocks later.
  std::array<std::uint64_t, 5> ns_{};
  std::uint32_t fraction_ = 0;
  bool carry_ = false;
  std::uint8_t inc_ns_;
  std::uint32_t inc_frac_;
  std::int32_t left_ = 0;
  unsigned slew_bit_ = 10;
};

}  // namespace vericansim
