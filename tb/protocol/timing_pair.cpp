// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Pair: see timing_pair.hpp.
#include "protocol/timing_pair.hpp"

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "harness/test_wave.hpp"

namespace vericansim {
namespace {

constexpr unsigned kLongestFrame = 160;  // bits, with its intermission

/// Flips what a receiver sees of a stuff bit in the data field, once in every n-th frame.
class StuffBitFault : public Fault {
 public:
  StuffBitFault(NodeId victim, unsigned every) : victim_{victim}, every_{every} {}
  Level level(NodeId receiver, Time, Level level) override {
    return receiver == victim_ && active_ ? !level : level;
  }
  void clocked(NodeId node, Time, std::uint64_t word) override {
    if (node != victim_) return;
    tracker_.clocked(word);
    if (!tracker_.fresh()) return;
    const Trace trace = decode_trace(word);
    active_ = armed_ && tracker_.field() == Field::kData && trace.stuff;
    hits_ += active_;
    armed_ = armed_ && !active_;
    const bool begins = tracker_.field() == Field::kRtr && !trace.stuff && !trace.transmitter;
    if (begins) armed_ = ++frames_ % every_ == 0;
  }
  [[nodiscard]] unsigned hits() const { return hits_; }

 private:
  NodeId victim_;
  unsigned every_;
  PlaceTracker tracker_;
  bool active_ = false;  // in this bit
  bool armed_ = false;   // in the next stuff bit
  unsigned frames_ = 0;
  unsigned hits_ = 0;
};

/// The two nodes and their bus.
class Pair {
 public:
  explicit Pair(const PairConfig &config)
      : core_{.timing = config.timing, .triple_sampling = config.triple_sampling},
        slow_{"slow", core_, {.frequency_hz = config.clock_hz, .error_ppm = -config.error_ppm}},
        fast_{"fast",
              core_,
              {.frequency_hz = config.clock_hz,
               .error_ppm = config.error_ppm,
               .phase = config.phase}},
        fault_{1, std::max(1u, config.disturb_every)} {
    bus_.add(slow_);
    bus_.add(fast_);
    bus_.set_delay(0, 1, config.delay);
    bus_.set_delay(1, 0, config.delay);
    if (config.disturb_every != 0) bus_.add(fault_);
    bit_ = static_cast<Time>(config.timing.clocks_per_bit() * 1e12 / config.clock_hz);
    wave_.emplace(bus_);
    slow_.start();
    fast_.start();
    bus_.run_for(16 * bit_);
  }

  void run_until_sent(unsigned frames, unsigned limit) {
    bus_.run_until([&] { return slow_.sent().size() + fast_.sent().size() >= frames; },
                   Time{limit} * kLongestFrame * bit_);
    bus_.run_for(8 * bit_);
  }
  CoreNode &node(unsigned i) { return i == 0 ? slow_ : fast_; }

  [[nodiscard]] PairResult result() {
    PairResult r;
    for (unsigned i = 0; i < 2; ++i) {
      const auto &sent = node(i).sent();
      const auto &got = node(1 - i).received();
      r.sent += static_cast<unsigned>(sent.size());
      for (std::size_t n = 0; n < std::min(sent.size(), got.size()); ++n)
        r.received += sent[n] == got[n];
      r.failed += node(i).events().failed;
      r.errors |= node(i).events().errors;
    }
    r.disturbed = fault_.hits();
    return r;
  }

 private:
  CoreConfig core_;
  Bus bus_;
  CoreNode slow_;
  CoreNode fast_;
  StuffBitFault fault_;
  Time bit_ = 0;
  std::optional<TestWave> wave_;
};

Frame random_frame(std::mt19937 &rng) {
  Frame frame{.id = static_cast<std::uint32_t>(rng() & 0x7FF), .dlc = 8};
  for (auto &byte : frame.data) byte = static_cast<std::uint8_t>(rng());
  return frame;
}

}  // namespace

PairResult exchange(const PairConfig &config, unsigned frames) {
  Pair pair{config};
  std::mt19937 rng{1};
  for (unsigned n = 0; n < frames; ++n) {
    pair.node(n % 2).request(n % 4 < 2 ? kLongEdgesFrame : random_frame(rng));
    pair.run_until_sent(n + 1, 3);
  }
  return pair.result();
}

PairResult contend(const PairConfig &config, unsigned rounds) {
  Pair pair{config};
  std::mt19937 rng{1};
  for (unsigned n = 0; n < rounds; ++n) {
    const Frame frame = random_frame(rng);
    Frame rival = frame;
    rival.id ^= 1u << (n % 11);
    pair.node(0).request(frame);
    pair.node(1).request(rival);
    pair.run_until_sent(2 * (n + 1), 6);
  }
  return pair.result();
}

}  // namespace vericansim
