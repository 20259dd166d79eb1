// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimingBench: see timing_bench.hpp.
#include "protocol/timing_bench.hpp"

#include <stdexcept>

namespace vericansim {
namespace {

constexpr unsigned kPlaceLimit = 2000;

}  // namespace

std::string describe(const BitTiming &t) {
  return "BRP " + std::to_string(t.prescaler) + " PROP " + std::to_string(t.prop) + " PS1 " +
         std::to_string(t.ps1) + " PS2 " + std::to_string(t.ps2) + " SJW " + std::to_string(t.sjw);
}

TimingBench::TimingBench(const CoreConfig &config)
    : dut_{"dut", config},
      partner_{"partner", {.timing = config.timing, .triple_sampling = config.triple_sampling}} {}

void TimingBench::start() {
  partner_.start();
  dut_.start();
  run_to([](const TimingBench &bench) {
    return bench.dut_.idle() && bench.partner_.idle() && bench.samples_.size() > 12;
  });
}

// Own edges arrive after their delay; the later arrival wins if they overtake each other.
Level TimingBench::looped() {
  if (fall_ == 0 && rise_ == 0) return dut_.tx();
  while (!loop_plan_.empty() && loop_plan_.begin()->first <= now_) {
    loop_level_ = loop_plan_.begin()->second;
    loop_plan_.erase(loop_plan_.begin());
  }
  return loop_level_;
}

void TimingBench::clock() {
  while (!pin_plan_.empty() && pin_plan_.begin()->first <= now_) {
    pin_ = pin_plan_.begin()->second;
    pin_plan_.erase(pin_plan_.begin());
  }
  const Level wire = looped() & partner_.tx();
  last_pin_ = pin_.value_or(wire);
  const Level partner_pin = dut_.tx() & partner_.tx();
  dut_.clock(last_pin_);
  partner_.clock(partner_pin);
  wave_.clock(wire);
  wave_.node(0, last_pin_);
  wave_.node(1, partner_pin);
  ++now_;
  record();
}

void TimingBench::record() {
  const std::uint64_t word = dut_.trace();
  tracker_.clocked(word);
  if (tracker_.fresh()) bit_starts_.push_back(now_);
  if ((word & kTraceSample) != 0) {
    const Trace t = decode_trace(word);
    samples_.push_back({now_, t.rx, t.field, t.transmitter});
  }
  if (dut_.tx() == last_tx_) return;
  last_tx_ = dut_.tx();
  tx_edges_.push_back({now_, last_tx_});
  loop_plan_[now_ + (last_tx_ == Level::kDominant ? fall_ : rise_)] = last_tx_;
}

void TimingBench::run(std::uint64_t clocks) { run_until(now_ + clocks); }

void TimingBench::run_until(std::uint64_t period) {
  while (now_ < period) clock();
}

void TimingBench::run_to(const std::function<bool(const TimingBench &)> &there) {
  const std::uint64_t limit = now_ + std::uint64_t{kPlaceLimit} * timing().clocks_per_bit();
  do {
    if (now_ > limit) throw std::runtime_error("the DUT does not get to the place");
    clock();
  } while (!tracker_.fresh() || samples_.empty() || !there(*this));
}

void TimingBench::run_to(Field field, unsigned index) {
  run_to([=](const TimingBench &bench) {
    return bench.tracker_.field() == field && bench.tracker_.index() == index;
  });
}

bool TimingBench::run_while_not(const std::function<bool()> &done, unsigned bits) {
  const std::uint64_t limit = now_ + std::uint64_t{bits} * timing().clocks_per_bit();
  while (!done()) {
    if (now_ >= limit) return false;
    clock();
  }
  return true;
}

std::uint64_t TimingBench::in_quantum(std::uint64_t start, unsigned quantum) const {
  const unsigned clocks = timing().prescaler;
  return start + std::uint64_t{quantum} * clocks + clocks / 2 - kSynchroniser;
}

void TimingBench::loop_delay(unsigned fall, unsigned rise) {
  fall_ = fall;
  rise_ = rise;
}

void TimingBench::clear_records() {
  samples_.clear();
  tx_edges_.clear();
  if (bit_starts_.size() > 1) bit_starts_.erase(bit_starts_.begin(), bit_starts_.end() - 1);
}

}  // namespace vericansim
