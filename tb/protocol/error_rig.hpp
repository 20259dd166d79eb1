// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ErrorRig: one engine, LT as a script of bits, the lockstep judge and the assertions beside it.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "protocol/assertions.hpp"
#include "protocol/core_bench.hpp"
#include "protocol/lockstep.hpp"
#include "unit/model_bench.hpp"

namespace vericansim {

/// Error counters that a DUT starts with.
struct Counters {
  std::uint8_t tec = 0;
  std::uint8_t rec = 0;
  [[nodiscard]] bool passive() const { return tec >= 128 || rec >= 128; }
};

/// The error states: active, passive through TEC, passive through REC alone.
inline constexpr Counters kActive{};
inline constexpr Counters kPassive{.tec = 128};
inline constexpr Counters kPassiveByRec{.rec = 128};

inline void PrintTo(const Counters &c, std::ostream *out) {
  *out << "TEC" << unsigned{c.tec} << "_REC" << unsigned{c.rec};
}

/// What a node in that state sends as an error flag, and what follows flags.
[[nodiscard]] inline std::string flag_of(const Counters &c) {
  return c.passive() ? "111111" : "000000";
}
inline const std::string kOverloadFlag = "000000";
inline const std::string kDelimiter = "11111111";
inline const std::string kIntermission = "111";
/// The suspend time of a transmitter in that state: of a passive one alone (IF-08).
[[nodiscard]] inline std::string suspend_of(const Counters &c) {
  return c.passive() ? "11111111" : "";
}

/// A script without the blanks that make it readable; for expected levels too.
[[nodiscard]] std::string bits(std::string_view text);
/// `count` times `text`.
using model_bench::rep;

/// One DUT in idle. Every bit is also compared with the node model and watched by the assertions;
/// the destructor reports what they found as test failures.
class ErrorRig {
 public:
  explicit ErrorRig(Counters counters = kActive,
                    const CoreConfig &config = CoreBench::default_config());
  ~ErrorRig();
  ErrorRig(const ErrorRig &) = delete;
  ErrorRig &operator=(const ErrorRig &) = delete;

  /// One bit a character: '0' LT is dominant; '1' or '.' LT is recessive; '!' LT is recessive and
  /// the DUT sees the opposite of what is on the wire; 'R' the DUT sees recessive whatever is on
  /// the wire. Blanks are ignored. Returns what the DUT drove.
  std::string play(std::string_view script);
  /// Requests `frame` on an idle bus: the bit that comes next is its SOF.
  void send(const Frame &frame);
  /// Queues `frame`; it starts when the rules allow.
  void request(const Frame &frame) { judge.request(0, frame); }
  /// Lets the DUT go on with LT quiet until the coming bit is at `place`; a failure if it is not
  /// reached within 200 bits.
  void run_to(const PlaceSpec &place);
  /// LT sends `frame` from SOF to EOF7, and the DUT acknowledges. Returns what the DUT drove.
  std::string receive(const Frame &frame);
  /// The DUT sends `frame` and LT acknowledges, SOF to EOF7. Returns what the DUT drove.
  std::string transmit(const Frame &frame);

  [[nodiscard]] CoreNode &dut() { return bench.dut(); }
  [[nodiscard]] const DutBit &last() const { return bench.last(); }
  [[nodiscard]] unsigned tec() const { return bench.last().tec; }
  [[nodiscard]] unsigned rec() const { return bench.last().rec; }
  [[nodiscard]] Field field() const { return bench.place().field(); }  ///< of the coming bit
  [[nodiscard]] std::size_t delivered() { return bench.dut().received().size(); }
  [[nodiscard]] std::size_t sent() { return bench.dut().sent().size(); }
  /// REC is `start` plus `step`; from 128 on only that it is at least 128 (FC-14).
  void expect_rec(unsigned start, unsigned step);
  /// The model does not know what comes (one-shot, stop, reset): only the assertions go on.
  void without_judge() { judged_ = false; }

  CoreBench bench;
  Lockstep judge;
  Assertions assertions;

 private:
  bool judged_ = true;
};

}  // namespace vericansim
