// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// World: see world.hpp. The scenes are in scenes.cpp.
#include "softerror/world.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "bus/trace.hpp"

namespace vericansim {
namespace {

// More frames than any run can send.
constexpr unsigned kEndless = 30'000;
// An order takes a frame, the set-up and an abort's wait at most.
constexpr std::uint64_t kOrderLimit = 150'000;
// After it is back on the bus a node needs 11 recessive bits; frames before them it does not get.
constexpr std::uint64_t kBackBits = 400;

BitTiming timing_of(std::uint64_t seed) {
  // One run in four has two clocks a quantum.
  if (seed / kScenes % 4 == 3) return {.prescaler = 2, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 1};
  return {.prescaler = 1, .prop = 4, .ps1 = 2, .ps2 = 3, .sjw = 1};
}

}  // namespace

World::World(std::uint64_t seed)
    : seed_{seed},
      scene_{static_cast<Scene>(seed % kScenes)},
      timing_{timing_of(seed)},
      ledger_{static_cast<unsigned>(mix(seed) % 30'000)},
      dut_{std::make_unique<FlopNode>("dut")} {
  for (unsigned n = 0; n < 2; ++n) {
    CoreConfig config;
    config.timing = timing_;
    neighbours_[n].node = std::make_unique<CoreNode>(n == 0 ? "a" : "b", config);
    neighbours_[n].node->start();
  }
  new_driver();
  if (!run_until([this] { return driver_->ready(); }, kOrderLimit))
    throw std::runtime_error("the node under test does not start");
  run(20 * bit_clocks());
  begin_ = clock_ + 2'000 + mix(seed_ + 1) % 1'000;
  plan();
}

void World::new_driver() {
  driver_.reset();  // leaves the node before the new one takes it
  driver_ = std::make_unique<SoftDriver>(*dut_, timing_, ledger_);
  driver_->on_received = [this](const Frame &frame) {
    ledger_.received(0, frame, clock_ < excused_until_);
    last_good_ = clock_;
  };
  driver_->start();
}

void World::traffic(bool on) {
  driver_->send(on ? kEndless : 0);
  for (Neighbour &neighbour : neighbours_) neighbour.quota = on ? kEndless : 0;
}

void World::send(unsigned count) {
  driver_->send(count);
  for (Neighbour &neighbour : neighbours_) neighbour.quota = count;
}

bool World::quiet() const {
  for (const Neighbour &neighbour : neighbours_) {
    if (neighbour.quota != 0 || !neighbour.waiting.empty()) return false;
  }
  return driver_->pending() == 0 && driver_->order() == Order::kNone && !dut_->irq() &&
         events_.empty();
}

bool World::run_until(const std::function<bool()> &done, std::uint64_t limit) {
  for (const std::uint64_t end = clock_ + limit; clock_ < end;) {
    step();
    if (done()) return true;
    if (ahb_hangs()) return false;
  }
  return false;
}

bool World::order(Order what) {
  ledger_.excuse();
  excused_until_ = clock_ + kOrderLimit;
  driver_->give(what);
  const bool done = run_until([this] { return driver_->order() == Order::kNone; }, kOrderLimit);
  excused_until_ = clock_ + kBackBits * bit_clocks();
  return done;
}

bool World::hard_reset() {
  ledger_.excuse();
  driver_.reset();
  dut_->reset();
  new_driver();
  excused_until_ = clock_ + kOrderLimit;
  const bool done = run_until([this] { return driver_->ready(); }, kOrderLimit);
  excused_until_ = clock_ + kBackBits * bit_clocks();
  return done;
}

// The neighbours' clocks are 0.1 % slower and faster: one leaves out an edge now and then, the
// other has one more.
void World::step() {
  while (!events_.empty() && events_.front().first <= clock_) {
    const auto action = std::move(events_.front().second);
    events_.pop_front();
    action();
  }
  level_ = dut_->tx() & neighbours_[0].node->tx() & neighbours_[1].node->tx();
  dut_->clock(dut_level(level_));
  if (clock_ % 1009 != 0) clock_neighbour(0, level_);
  clock_neighbour(1, level_);
  if (clock_ % 1013 == 0) clock_neighbour(1, level_);
  ++clock_;
  watch();
  if (on_clock) on_clock();
}

void World::clock_neighbour(unsigned n, Level rx) {
  Neighbour &neighbour = neighbours_[n];
  CoreNode &node = *neighbour.node;
  if (neighbour.waiting.empty() && neighbour.quota != 0) {
    --neighbour.quota;
    neighbour.waiting.push_back(ledger_.next(n + 1));
    node.request(make_frame(neighbour.waiting.back()));
  }
  node.clock(rx);
  for (; neighbour.received < node.received().size(); ++neighbour.received) {
    ledger_.received(n + 1, node.received()[neighbour.received]);
    last_good_ = clock_;
  }
  for (; neighbour.sent < node.sent().size(); ++neighbour.sent) {
    ledger_.sent(neighbour.waiting.front(), clock_ < excused_until_);
    neighbour.waiting.pop_front();
    last_good_ = clock_;
  }
  if (((node.trace() >> 26) & 0x3F) != 0) {
    ++sight_.errors;
    sight_.last_error = clock_;
  }
}

void World::watch() {
  const std::uint64_t trace = dut_->trace();
  if (((trace >> 26) & 0x3F) != 0) {
    ++sight_.errors;
    ++run_errors_;
    sight_.last_error = clock_;
  }
  const bool off = ((trace >> 16) & 1) != 0;
  if (off && !was_off_) ++sight_.bus_offs;
  was_off_ = off;
  if (off || (clock_ >= deaf_from_ && clock_ < deaf_until_)) {
    excused_until_ = std::max(excused_until_, clock_ + kBackBits * bit_clocks());
  }
  // A passive node that sees a bit wrong cannot make the others repeat the frame.
  if (clock_ < noise_until_ && ((trace >> 21) & 1) != 0) excused_until_ = noise_until_ + 4'000;
  const bool waits = !neighbours_[0].waiting.empty() || !neighbours_[1].waiting.empty();
  if (!waits) last_good_ = clock_;
  sight_.longest_gap = std::max(sight_.longest_gap, clock_ - last_good_);
  watch_pin(trace);
}

// The longest run of dominant bits that a node may send: five in a frame and the six of an active
// flag that follows at once; each further error inside lets a new flag of six begin, and the flip
// itself counts as one (docs/soft-errors.md). One bit more for a flip that comes inside a bit.
void World::watch_pin(std::uint64_t trace) {
  if (dut_->tx() == Level::kRecessive) {
    run_clocks_ = 0;
    run_errors_ = 0;
    return;
  }
  ++run_clocks_;
  if (trace_field(trace) == Field::kOvlFlag && trace_left(trace) == 5 && run_clocks_ > 1 &&
      (trace & kTraceSample) != 0) {
    ++run_errors_;  // an overload flag begins as an error flag does
  }
  const unsigned bit = dut_->bit_clocks();
  sight_.longest_run = std::max(sight_.longest_run, 10 * run_clocks_ / bit);
  if (run_clocks_ > (5 + 6 * (run_errors_ + 1) + 1) * bit) sight_.run_too_long = true;
}

}  // namespace vericansim
