// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimingBench: one engine under test and one partner on a wire, clock by clock.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bus/faults.hpp"
#include "bus/trace.hpp"
#include "harness/test_wave.hpp"
#include "node/core_node.hpp"

namespace vericansim {

/// Time is counted in clock periods: period p is the one after p clock edges. The pin's level in
/// period p is judged in period p + 2, for it passes the synchroniser.
class TimingBench {
 public:
  static constexpr unsigned kSynchroniser = 2;

  /// A sample point of the DUT: the period whose final edge takes the sample.
  struct Sample {
    std::uint64_t period = 0;
    Level value = Level::kRecessive;
    Field field = Field::kInteg;
    bool transmitter = false;
  };
  /// A new level at the DUT's TX pin, from the start of the period on.
  struct TxEdge {
    std::uint64_t period = 0;
    Level level = Level::kRecessive;
  };

  /// The partner has the same configuration, but is never passive or listen-only by it.
  explicit TimingBench(const CoreConfig &config);

  [[nodiscard]] CoreNode &dut() { return dut_; }
  [[nodiscard]] CoreNode &partner() { return partner_; }
  [[nodiscard]] const BitTiming &timing() const { return dut_.config().timing; }

  /// Starts both nodes and lets them integrate; afterwards a bit of the DUT has just begun.
  void start();
  /// One clock period.
  void clock();
  void run(std::uint64_t clocks);
  void run_until(std::uint64_t period);
  void run_bits(unsigned bits) { run(std::uint64_t{bits} * timing().clocks_per_bit()); }
  /// Runs to the first clock of the next bit of the DUT for which `there` is true; throws
  /// std::runtime_error after 2000 bits.
  void run_to(const std::function<bool(const TimingBench &)> &there);
  void run_to(Field field, unsigned index);
  /// Runs until `done`; false after `bits`.
  bool run_while_not(const std::function<bool()> &done, unsigned bits);

  /// From period `when` on the DUT's pin has this level whatever the wire says (nothing: the wire).
  void pin(std::uint64_t when, std::optional<Level> level) { pin_plan_[when] = level; }
  void pin(std::optional<Level> level) { pin(now_, level); }
  /// Period in which a new pin level must begin to lie in quantum `quantum` of the bit that begins
  /// in `bit_start`; in the middle of it.
  [[nodiscard]] std::uint64_t in_quantum(std::uint64_t bit_start, unsigned quantum) const;
  /// From the DUT's TX pin to its RX pin, in clocks, besides the synchroniser; for edges to
  /// dominant and to recessive.
  void loop_delay(unsigned fall, unsigned rise);

  [[nodiscard]] std::uint64_t now() const { return now_; }
  [[nodiscard]] std::uint64_t bit_start() const { return bit_starts_.back(); }
  [[nodiscard]] const PlaceTracker &place() const { return tracker_; }
  /// The DUT's last sample, and the level that it sends now.
  [[nodiscard]] Level last_sample() const { return samples_.back().value; }
  [[nodiscard]] Level sent() const { return decode_trace(dut_.trace()).tx; }
  [[nodiscard]] Trace trace() const { return decode_trace(dut_.trace()); }

  [[nodiscard]] const std::vector<Sample> &samples() const { return samples_; }
  [[nodiscard]] const std::vector<std::uint64_t> &bit_starts() const { return bit_starts_; }
  [[nodiscard]] const std::vector<TxEdge> &tx_edges() const { return tx_edges_; }
  /// Level at the DUT's pin in the period before now().
  [[nodiscard]] Level last_pin() const { return last_pin_; }
  /// Forgets what has been recorded, except where the bit under way began.
  void clear_records();

 private:
  [[nodiscard]] Level looped();
  void record();

  CoreNode dut_;
  CoreNode partner_;
  PlaceTracker tracker_;
  std::map<std::uint64_t, std::optional<Level>> pin_plan_;
  std::optional<Level> pin_;
  std::map<std::uint64_t, Level> loop_plan_;  // arrivals of own edges
  Level loop_level_ = Level::kRecessive;
  unsigned fall_ = 0;
  unsigned rise_ = 0;
  std::uint64_t now_ = 0;
  Level last_tx_ = Level::kRecessive;
  Level last_pin_ = Level::kRecessive;
  std::vector<Sample> samples_;
  std::vector<std::uint64_t> bit_starts_;
  std::vector<TxEdge> tx_edges_;
  TestWave wave_{{&dut_, &partner_}};
};

/// Short text of a timing, for SCOPED_TRACE.
std::string describe(const BitTiming &timing);

}  // namespace vericansim
