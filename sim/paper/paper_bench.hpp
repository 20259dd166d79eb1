// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PaperBench: the set-up of the paper's experiments: the core under test, a second node, and every
// bit of both.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "bus/observer.hpp"
#include "paper/paper.hpp"
#include "simulation/bus_outputs.hpp"
#include "simulation/station.hpp"

namespace vericansim {

/// Keeps every bit of every node.
class BitLog : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node >= bits_.size()) bits_.resize(node + 1);
    bits_[node].push_back(bit);
  }
  [[nodiscard]] const std::vector<BitRecord> &of(NodeId node) const { return bits_.at(node); }

 private:
  std::vector<std::vector<BitRecord>> bits_;
};

/// Flips what one node sees of its own first data bit, as long as it is on: a bit error in every
/// attempt.
class DataBitFault : public Fault {
 public:
  explicit DataBitFault(NodeId node) : place_{node, first_data_bit(), Effect::kFlip} {}
  [[nodiscard]] Level level(NodeId receiver, Time t, Level level) override {
    return on ? place_.level(receiver, t, level) : level;
  }
  void clocked(NodeId node, Time t, std::uint64_t word) override { place_.clocked(node, t, word); }
  bool on = true;

 private:
  static PlaceSpec first_data_bit() {
    PlaceSpec place;
    place.field = Field::kData;
    place.index = 0;
    return place;
  }
  PlaceFault place_;
};

/// 50 kbit/s, 10 quanta of 2 us, PROP 5, PS1 2, PS2 2: sample point 80 %.
class PaperBench {
 public:
  static constexpr NodeId kIp = 0;     ///< the core under test
  static constexpr NodeId kOther = 1;  ///< the paper's commercial node
  static constexpr Time kBit = 20 * kMicrosecond;

  /// `title` is that of the page. `alone`: no second node on the bus.
  PaperBench(const PaperFiles &files, const std::string &title, bool alone);

  void send(NodeId node, const Frame &frame) { stations_[node].host->send(frame); }
  /// Before anything is sent.
  void add(Fault &fault);
  void run_bits(Time bits);
  /// Runs until `done()` or for `bits` at most; true if it was done.
  bool run_until(const std::function<bool()> &done, Time bits);
  [[nodiscard]] const std::vector<BitRecord> &bits(NodeId node) const { return log_.of(node); }
  [[nodiscard]] Station &station(NodeId node) { return stations_[node]; }
  /// Completes the files. The page shows the statements of `experiment` and, at first, the time
  /// from `from` to `to` (of the bus, ps).
  void finish(const PaperExperiment &experiment, Time from, Time to);

 private:
  Stations stations_;
  BitLog log_;
  std::unique_ptr<BusMonitor> monitor_;
  std::unique_ptr<BusOutputs> outputs_;
  Bus bus_;
};

/// The frame of all experiments: identifier 0b00000001010, one byte 0b10101010.
inline constexpr Frame kPaperFrame{0b00000001010, false, false, 1, {0b10101010}};

/// The first bit of a node for which `found` is true; the last one if there is none.
template <class Predicate>
Time time_of(const std::vector<BitRecord> &bits, Predicate found) {
  const auto bit = std::find_if(bits.begin(), bits.end(), found);
  return bit == bits.end() ? bits.back().time : bit->time;
}

/// Sample point of the first SOF that a node sees.
[[nodiscard]] Time first_sof(const std::vector<BitRecord> &bits);

[[nodiscard]] PaperExperiment paper_reception(const PaperFiles &files);
[[nodiscard]] PaperExperiment paper_transmission(const PaperFiles &files);
[[nodiscard]] PaperExperiment paper_arbitration(const PaperFiles &files);
[[nodiscard]] PaperExperiment paper_missing_ack(const PaperFiles &files);
[[nodiscard]] PaperExperiment paper_bus_off(const PaperFiles &files);

}  // namespace vericansim
