// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CoreBench: see core_bench.hpp.
#include "protocol/core_bench.hpp"

#include <stdexcept>

namespace vericansim {
namespace {

// Integration and 128 x 11 bits of recovery are the longest waits of start().
constexpr unsigned kStartLimit = 2000;
// No bit is longer than 256 clocks x (25 + 4) quanta, and a bit of another DUT may be one behind.
constexpr unsigned kClockLimit = 2 * 256 * 29;

char to_char(Level level) { return level == Level::kDominant ? '0' : '1'; }

}  // namespace

CoreBench::CoreBench(unsigned duts, const CoreConfig &config) : acknowledged_(duts, false) {
  duts_.resize(duts);
  for (unsigned i = 0; i < duts; ++i) {
    duts_[i].node = std::make_unique<CoreNode>("dut" + std::to_string(i), config);
  }
  std::vector<const Node *> nodes;
  for (const Dut &dut : duts_) nodes.push_back(dut.node.get());
  wave_.emplace(nodes);
}

void CoreBench::start() {
  for (Dut &dut : duts_) dut.node->start();
  const auto integrated = [this] {
    for (const Dut &dut : duts_) {
      if (!dut.node->idle()) return false;
    }
    return true;
  };
  if (!run_until(integrated, kStartLimit)) throw std::runtime_error("a DUT does not become idle");
  clear_history();
}

void CoreBench::lt(std::string_view bits) {
  for (const char c : bits) {
    if (c == '0' || c == 'd') lt_bits_.push_back(Level::kDominant);
    if (c == '1' || c == 'r') lt_bits_.push_back(Level::kRecessive);
  }
}

void CoreBench::lt_acknowledges(bool on, unsigned i) { acknowledged_[i] = on; }

void CoreBench::invert(unsigned i, const PlaceSpec &place, unsigned times) {
  force(i, place, Effect::kFlip, times);
}

void CoreBench::force(unsigned i, const PlaceSpec &place, Effect effect, unsigned times) {
  duts_[i].disturbances.push_back({place, effect, times});
}

// Between two steps DUT 0 has begun its coming bit; a DUT whose boundary is a clock later has not.
void CoreBench::force_next(unsigned i, Effect effect) {
  Dut &dut = duts_[i];
  (dut.boundary ? dut.next : dut.effect) = effect;
}

void CoreBench::clear_disturbances() {
  for (Dut &dut : duts_) {
    dut.disturbances.clear();
    dut.next.reset();
  }
}

void CoreBench::clear_history() {
  for (Dut &dut : duts_) {
    dut.tx_history.clear();
    dut.rx_history.clear();
  }
}

Level CoreBench::next_lt_level() {
  Level level = lt_default_;
  if (!lt_bits_.empty()) {
    level = lt_bits_.front();
    lt_bits_.pop_front();
  } else if (lt_source_) {
    level = lt_source_(*this);
  }
  for (unsigned i = 0; i < size(); ++i) {
    const PlaceTracker &at = duts_[i].tracker;
    const bool slot = at.field() == Field::kAck && duts_[i].last.transmitter;
    if (acknowledged_[i] && slot) level = Level::kDominant;
  }
  return level;
}

Level CoreBench::bus() const {
  Level level = lt_level_;
  for (const Dut &dut : duts_) level = level & dut.node->tx();
  return level;
}

void CoreBench::begin_bit(Dut &dut) {
  dut.effect = dut.next;
  dut.next.reset();
  for (Disturbance &disturbance : dut.disturbances) {
    if (disturbance.times == 0 || !disturbance.place.matches(dut.tracker)) continue;
    --disturbance.times;
    dut.effect = disturbance.effect;
  }
}

void CoreBench::clock(Level level) {
  lt_level_ = level;
  const Level wire = bus();
  wave_->clock(wire);
  for (unsigned i = 0; i < size(); ++i) {
    const Dut &dut = duts_[i];
    const Level rx = dut.effect ? apply_effect(*dut.effect, wire) : wire;
    dut.node->clock(rx);
    wave_->node(i, rx);
  }
  ++clock_count_;
  for (unsigned i = 0; i < size(); ++i) after_clock(i);
}

void CoreBench::after_clock(unsigned i) {
  Dut &dut = duts_[i];
  const std::uint64_t word = dut.node->trace();
  dut.tracker.clocked(word);
  if (dut.boundary) begin_bit(dut);
  dut.boundary = (word & kTraceBoundary) != 0;
  if ((word & kTraceSample) != 0) dut.tx = dut.node->tx();
  if (!dut.recorder.clocked(word, 0)) return;
  dut.last = node_bit(dut.recorder.record(), dut.tx);
  ++dut.samples;
  dut.tx_history.push_back(to_char(dut.last.tx));
  dut.rx_history.push_back(to_char(dut.last.rx));
  if (on_bit) on_bit(i, dut.last);
}

void CoreBench::step() {
  ++bit_count_;
  const Level level = next_lt_level();
  const std::uint64_t sampled = duts_[0].samples;
  for (unsigned n = 0; n < kClockLimit; ++n) {
    clock(level);
    if (duts_[0].samples > sampled && duts_[0].tracker.fresh()) return;
  }
  throw std::runtime_error("DUT 0 has no sample point: is it running?");
}

void CoreBench::run_bits(unsigned bits) {
  for (unsigned i = 0; i < bits; ++i) step();
}

bool CoreBench::run_until(const std::function<bool()> &done, unsigned limit) {
  for (unsigned i = 0; i <= limit; ++i) {
    if (done()) return true;
    if (i < limit) step();
  }
  return false;
}

}  // namespace vericansim
