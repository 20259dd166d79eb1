// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncLoop: a master, followers with the driver's servo, oscillators, and stamps as TM-26 says
// them; no RTL and no bus. Slews are instantaneous.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "verican/servo.h"

namespace vericansim {

using Nanoseconds = long double;

/// Edges of a clock whose period may wander (random walk, density in 1/sqrt(s)).
class Oscillator {
 public:
  Oscillator(double frequency_hz, double error, double wander, std::uint64_t seed)
      : nominal_{1e9L / frequency_hz}, wander_{wander}, dice_{seed} {
    const double phase = std::uniform_real_distribution<double>{0, 1}(dice_);
    pieces_.push_back({0, phase, error});
  }
  /// Count of edges as a real number: whole at an edge.
  Nanoseconds count(Nanoseconds t) {
    while (wander_ > 0 && pieces_.back().start + kPiece <= t) grow();
    const Piece &piece = pieces_[wander_ > 0 ? static_cast<std::size_t>(t / kPiece) : 0];
    return piece.count + (t - piece.start) / nominal_ * (1 + piece.error);
  }
  /// The first edge at or after t.
  std::int64_t edge_after(Nanoseconds t) {
    return static_cast<std::int64_t>(std::ceil(count(t) - 1e-9L));
  }
  std::int64_t last_edge(Nanoseconds t) { return static_cast<std::int64_t>(std::floor(count(t))); }
  /// Time of an edge that is near t.
  Nanoseconds time_of(std::int64_t edge, Nanoseconds t) {
    for (int n = 0; n < 4; ++n) t += (static_cast<Nanoseconds>(edge) - count(t)) * nominal_;
    return t;
  }
  [[nodiscard]] Nanoseconds nominal() const { return nominal_; }

 private:
  struct Piece {
    Nanoseconds start, count;
    double error;
  };
  static constexpr Nanoseconds kPiece = 10'000'000;
  void grow() {
    const Piece &last = pieces_.back();
    const double step = wander_ * 0.1 * std::normal_distribution<double>{}(dice_);
    pieces_.push_back({last.start + kPiece, last.count + kPiece / nominal_ * (1 + last.error),
                       last.error + step});
  }

  Nanoseconds nominal_;
  double wander_;
  std::mt19937_64 dice_;
  std::vector<Piece> pieces_;
};

/// The clock register on an oscillator (TM-10), in closed form.
class ClockNode {
 public:
  ClockNode(const Oscillator &of, std::uint64_t start)
      : oscillator{of},
        increment{static_cast<std::uint64_t>(std::llround(of.nominal() * 4294967296.0L))},
        value_{Fine{start} << 32} {}

  std::uint64_t at(std::int64_t edge) const {
    return static_cast<std::uint64_t>((value_ + Fine(edge - edge_) * increment) >> 32);
  }
  void apply(std::int64_t edge, const verican_correction_t &correction) {
    value_ += Fine(edge - edge_) * increment;
    value_ += Fine(static_cast<std::uint64_t>(correction.shift)) << 32;
    edge_ = edge;
    increment = correction.increment;
  }
  /// The continuous reading of section 0, less a second one.
  Nanoseconds ahead_of(ClockNode &other, Nanoseconds t) {
    const auto whole = static_cast<std::int64_t>(at(oscillator.last_edge(t)) -
                                                 other.at(other.oscillator.last_edge(t)));
    return static_cast<Nanoseconds>(whole) + since(t) - other.since(t);
  }

  Oscillator oscillator;
  std::uint64_t increment;

 private:
  __extension__ using Fine = unsigned __int128;
  Nanoseconds since(Nanoseconds t) {
    const Nanoseconds edges = oscillator.count(t);
    return (edges - std::floor(edges)) * static_cast<Nanoseconds>(increment) / 4294967296.0L;
  }
  Fine value_;
  std::int64_t edge_ = 0;
};

struct SyncCase {
  double frequency_hz = 16e6;
  double spread = 100e-6;   ///< of the clocks' errors
  double wander = 0;        ///< 1/sqrt(s)
  double interval_s = 1;    ///< R
  std::uint8_t filter = 8;  ///< N, 0: automatic
  double displaced = 0;     ///< share of edges that come up to 300 ns early
  bool own_pin = false;     ///< the master stamps at its receive pin
  double late = 0;          ///< ns: the master stamps behind the edge, as at the end of the frame
  double uneven = 0;        ///< ns: and by up to so much more
  unsigned followers = 8;
  unsigned intervals = 260;
  std::uint64_t seed = 1;
};

/// Errors of all followers while they are locked, ns.
struct SyncErrors {
  double sum = 0, squares = 0, max = 0;
  std::uint64_t count = 0;
  void add(double error) {
    sum += error;
    squares += error * error;
    max = std::max(max, std::abs(error));
    ++count;
  }
  [[nodiscard]] double sd() const {
    const double n = static_cast<double>(count), mean = sum / n;
    return std::sqrt(squares / n - mean * mean);
  }
};

class SyncLoop {
 public:
  explicit SyncLoop(const SyncCase &setting) : setting_{setting}, dice_{setting.seed} {
    for (unsigned n = 0; n <= setting.followers; ++n) nodes.push_back(make_node());
    verican_servo_config_t config{};
    verican_servo_config_default(&config);
    config.interval_us = static_cast<std::uint32_t>(setting.interval_s * 1e6);
    config.filter = setting.filter;
    config.delay_ns = -static_cast<std::int32_t>(setting.late);
    servos.resize(setting.followers);
    for (verican_servo_t &servo : servos) verican_servo_init(&servo, &config);
  }

  /// All intervals, one after the other.
  SyncErrors run() {
    for (unsigned n = 0; n < setting_.intervals; ++n) sync(setting_.interval_s);
    return errors;
  }

  /// `interval_s` later the master sends; followers of which lost() is true miss the pair.
  void sync(double interval_s, const std::function<bool(unsigned)> &lost = {}) {
    const Nanoseconds before = now;
    now += interval_s * 1e9;
    ClockNode &master = nodes[0];
    const std::int64_t sent = master.oscillator.edge_after(now + uniform(0, kFrame));
    const Nanoseconds edge = master.oscillator.time_of(sent, now);
    const std::uint64_t stamp = setting_.own_pin      ? own_pin_stamp(master, edge)
                                : setting_.uneven > 0 ? late_stamp(master, edge)
                                                      : master.at(sent);
    const Nanoseconds handled = edge + uniform(1e6, 2e6);
    look((before + now) / 2);
    look(handled);
    for (unsigned n = 0; n < setting_.followers; ++n)
      if (!lost || !lost(n)) follow(n, edge, stamp, handled);
    look(handled + 1e3);
  }

  std::vector<ClockNode> nodes;  ///< the first is the master
  std::vector<verican_servo_t> servos;
  SyncErrors errors;
  Nanoseconds now = 1e6;
  std::function<void(unsigned follower, const verican_correction_t &)> on_correction;

 private:
  // SYNC waits for a frame that is on the bus: 130 bits at 500 kbit/s.
  static constexpr double kFrame = 260'000;

  ClockNode make_node() {
    const double error = uniform(-setting_.spread, setting_.spread);
    return {Oscillator{setting_.frequency_hz, error, setting_.wander, dice_()}, dice_() >> 3};
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(dice_);
  }
  // Two synchroniser flip-flops: 1.5 clocks on average; software knows 3 half clocks (TM-26).
  static std::uint64_t receive_stamp(ClockNode &node, Nanoseconds edge) {
    return node.at(node.oscillator.edge_after(edge) + 1);
  }
  static std::uint64_t own_pin_stamp(ClockNode &node, Nanoseconds edge) {
    const std::uint64_t latency = (std::uint64_t{128} * 3 * node.increment >> 32) / 256;
    return receive_stamp(node, edge) - latency;
  }

  std::uint64_t late_stamp(ClockNode &node, Nanoseconds edge) {
    return node.at(node.oscillator.last_edge(edge + setting_.late + uniform(0, setting_.uneven)));
  }

  void follow(unsigned n, Nanoseconds edge, std::uint64_t master, Nanoseconds handled) {
    ClockNode &node = nodes[n + 1];
    if (setting_.displaced > 0 && uniform(0, 1) < setting_.displaced) edge -= uniform(0, 300);
    const std::int64_t last = node.oscillator.last_edge(handled);
    const verican_sync_pair_t pair{receive_stamp(node, edge), master, node.at(last), node.increment,
                                   3};
    verican_correction_t correction{};
    verican_servo_pair(&servos[n], &pair, &correction);
    node.apply(last, correction);
    if (on_correction) on_correction(n, correction);
  }

  void look(Nanoseconds t) {
    for (unsigned n = 0; n < setting_.followers; ++n)
      if (servos[n].state == VERICAN_SYNC_LOCKED)
        errors.add(static_cast<double>(nodes[n + 1].ahead_of(nodes[0], t)));
  }

  SyncCase setting_;
  std::mt19937_64 dice_;
};

}  // namespace vericansim
