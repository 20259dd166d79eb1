// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CoreBench: one or more engines (DUTs) and "LT", the bench as the rest of the bus, bit by bit.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/faults.hpp"
#include "bus/trace.hpp"
#include "harness/test_wave.hpp"
#include "judge/node_bit.hpp"
#include "node/core_node.hpp"

namespace vericansim {

/// One bit of one DUT.
using DutBit = NodeBit;

/// The bench. All DUTs have one clock. Time advances by bits of DUT 0: a bit of LT lasts from one
/// of its bit boundaries to the next, so LT is always in step with it and needs no bit timing of
/// its own.
///
/// Everything at the pins is late by the two clocks of the synchroniser. With a prescaler of 1 an
/// edge of LT therefore lies in the second quantum and makes the bit one quantum longer; no level
/// changes by that.
class CoreBench {
 public:
  /// Ten clocks a bit: short, and room in PROP_SEG for the synchronisers.
  static constexpr BitTiming kTiming{.prescaler = 1, .prop = 4, .ps1 = 3, .ps2 = 2, .sjw = 1};
  static CoreConfig default_config() { return {.timing = kTiming}; }

  explicit CoreBench(unsigned duts = 1, const CoreConfig &config = default_config());

  [[nodiscard]] CoreNode &dut(unsigned i = 0) { return *duts_[i].node; }
  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(duts_.size()); }
  /// Starts all DUTs and lets them integrate: afterwards they are idle (IN-01). Counters may be
  /// preset before, with dut().preset_counters().
  void start();

  // ---- LT

  /// Level of LT from the next bit on.
  void lt(Level level) { lt_default_ = level; }
  /// Appends bits of LT, one a bit of DUT 0, from the next bit on; '0'/'d' dominant, '1'/'r'
  /// recessive, others are ignored. When they have run out LT is as set by lt(Level) (recessive at
  /// first).
  void lt(std::string_view bits);
  /// Asks `source` at the start of every bit, unless bits are queued; empty function: back to the
  /// level.
  void lt(std::function<Level(const CoreBench &)> source) { lt_source_ = std::move(source); }
  [[nodiscard]] bool lt_done() const { return lt_bits_.empty(); }
  /// LT acknowledges every frame that DUT `i` sends (drives its ACK slot dominant).
  void lt_acknowledges(bool on, unsigned i = 0);

  // ---- Disturbances

  /// Inverts what DUT `i` sees while DUT `watched` (default: itself) is at a place; `times` bits at
  /// most.
  void invert(unsigned i, const PlaceSpec &place, unsigned times = 1);
  /// Forces the level that DUT `i` sees at a place.
  void force(unsigned i, const PlaceSpec &place, Effect effect, unsigned times = 1);
  /// Forces or inverts the coming bit of DUT `i`, the one that the next step() runs.
  void force_next(unsigned i, Effect effect);
  void clear_disturbances();

  // ---- Time

  /// Runs one bit: until every DUT has passed one more sample point, and to DUT 0's bit boundary.
  void step();
  void run_bits(unsigned bits);
  /// Steps until `done()`; false if that took more than `limit` bits.
  bool run_until(const std::function<bool()> &done, unsigned limit);
  /// Runs one clock with LT at `level`, for tests at clock or quantum resolution; such clocks may
  /// be mixed with step().
  void clock(Level level);

  [[nodiscard]] std::uint64_t bits() const { return bit_count_; }
  [[nodiscard]] std::uint64_t clocks() const { return clock_count_; }
  /// The last bit of DUT `i`.
  [[nodiscard]] const DutBit &last(unsigned i = 0) const { return duts_[i].last; }
  /// Level that LT drives in the current bit.
  [[nodiscard]] Level lt_level() const { return lt_level_; }
  /// AND of all drivers now.
  [[nodiscard]] Level bus() const;
  /// Place of the bit that DUT `i` is in; valid at the start of a bit, for LT functions too.
  [[nodiscard]] const PlaceTracker &place(unsigned i = 0) const { return duts_[i].tracker; }
  /// TX of DUT `i`, one character a bit ('0', '1') since start() or the last clear_history().
  [[nodiscard]] const std::string &tx_history(unsigned i = 0) const { return duts_[i].tx_history; }
  [[nodiscard]] const std::string &rx_history(unsigned i = 0) const { return duts_[i].rx_history; }
  void clear_history();

  /// Called after every bit of every DUT (index, bit); the lockstep judge hangs here.
  std::function<void(unsigned, const DutBit &)> on_bit;

 private:
  struct Disturbance {
    PlaceSpec place;
    Effect effect;
    unsigned times;
  };

  struct Dut {
    std::unique_ptr<CoreNode> node;
    PlaceTracker tracker;
    std::vector<Disturbance> disturbances;
    std::optional<Effect> next;    // for the coming bit
    std::optional<Effect> effect;  // in this bit
    BitRecorder recorder;
    bool boundary = false;         // the last clock ended a bit
    Level tx = Level::kRecessive;  // pin at the last sample point
    std::uint64_t samples = 0;
    DutBit last;
    std::string tx_history;
    std::string rx_history;
  };

  void begin_bit(Dut &dut);
  void after_clock(unsigned i);
  [[nodiscard]] Level next_lt_level();

  std::vector<Dut> duts_;
  std::deque<Level> lt_bits_;
  std::function<Level(const CoreBench &)> lt_source_;
  Level lt_default_ = Level::kRecessive;
  Level lt_level_ = Level::kRecessive;
  std::vector<bool> acknowledged_;
  std::uint64_t bit_count_ = 0;
  std::uint64_t clock_count_ = 0;
  std::optional<TestWave> wave_;
};

}  // namespace vericansim
